/* SPDX-License-Identifier: GPL-3.0-or-later */
/* XDMF version 2, which both readers of ParaView take. */
#include "xdmf.h"

#include <string.h>

#include <gridcross/value.h>

#include "openpmd.h"

void gx_xdmf_begin(FILE *out)
{
  fputs("<?xml version=\"1.0\"?>\n"
        "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
        "<Xdmf Version=\"2.0\">\n"
        " <Domain>\n"
        "  <Grid Name=\"case\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
        out);
}

void gx_xdmf_end(FILE *out)
{
  fputs("  </Grid>\n </Domain>\n</Xdmf>\n", out);
}

/* An array of the HDF5 file: its path goes on with the rest. */
static void put_item(FILE *out, const char *type, const char *dimensions, const char *file, const char *path, const char *rest)
{
  fprintf(out, "<DataItem Dimensions=\"%s\" NumberType=\"%s\" Precision=\"8\" Format=\"HDF\">%s:%s%s</DataItem>", dimensions,
          type, file, path, rest);
}

/* Components as scalars: only what has an [n][3] array can be a vector. */
static void put_record(FILE *out, const char *dimensions, const char *file, const char *path, int dim,
                       const struct gx_record *record)
{
  for (int k = 0; k < gx_snapshot_components(dim, record->rank); k++) {
    char name[3], rest[80];
    gx_openpmd_component(dim, record->rank, k, name);
    snprintf(rest, sizeof rest, "/%s%s%s", record->name, *name ? "/" : "", name);
    fprintf(out, "    <Attribute Name=\"%s%s%s\" AttributeType=\"Scalar\" Center=\"Node\">", record->name, *name ? "_" : "",
            name);
    put_item(out, "Float", dimensions, file, path, rest);
    fputs("</Attribute>\n", out);
  }
}

static void put_topology(FILE *out, const char *file, enum gx_xdmf_kind kind, const char *path, const struct gx_record_set *set)
{
  char n[32];
  snprintf(n, sizeof n, "%zu", set->n);
  if (kind == GX_XDMF_VERTICES) {
    fprintf(out, "    <Topology TopologyType=\"3DSMesh\" Dimensions=\"%zu %zu %zu\"/>\n", set->shape[2], set->shape[1],
            set->shape[0]);
    return;
  }
  fprintf(out, "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%s\" NodesPerElement=\"1\">", n);
  put_item(out, "UInt", n, file, path, "/id"); /* numbers from 0: the connectivity */
  fputs("</Topology>\n", out);
}

void gx_xdmf_put(FILE *out, const char *file, enum gx_xdmf_kind kind, const struct gx_snapshot *snapshot)
{
  const bool vertices = kind == GX_XDMF_VERTICES;
  const struct gx_record_set *set = vertices ? &snapshot->vertices : &snapshot->particles;
  char path[80], triples[80], dimensions[96] = "", three[40], time[GX_NUMBER_LENGTH];
  snprintf(path, sizeof path, "/data/%.0f/%s", snapshot->step, vertices ? GX_OPENPMD_VERTICES : GX_OPENPMD_PARTICLES);
  snprintf(triples, sizeof triples, "/xdmf/%.0f/%s", snapshot->step, vertices ? "vertices" : "particles");
  snprintf(three, sizeof three, "%zu 3", set->n);
  for (int d = vertices ? snapshot->dim - 1 : 0; d >= 0; d--)
    snprintf(dimensions + strlen(dimensions), sizeof dimensions - strlen(dimensions), "%s%zu", *dimensions ? " " : "",
             set->shape[d]);
  gx_value_real(snapshot->time, time);
  fprintf(out, "   <Grid Name=\"%s\" GridType=\"Uniform\">\n    <Time Value=\"%s\"/>\n", vertices ? "grid" : "particles", time);
  put_topology(out, file, kind, path, set);
  fputs("    <Geometry GeometryType=\"XYZ\">", out);
  put_item(out, "Float", three, file, triples, "/position");
  fputs("</Geometry>\n    <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">", out);
  put_item(out, "Float", three, file, triples, "/velocity");
  fputs("</Attribute>\n", out);
  for (int i = 0; i < set->count; i++)
    if (strcmp(set->record[i].name, "position") && strcmp(set->record[i].name, "velocity"))
      put_record(out, dimensions, file, path, snapshot->dim, &set->record[i]);
  fputs("   </Grid>\n", out);
}
