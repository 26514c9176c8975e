/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Provenance and identity of studies. */
#include "provenance.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/build.h>

#include "../core/checksum.h"
#include "journal.h"

const char *const gx_provenance_name[GX_PROVENANCE_TEXTS] = {"title", "run_file", "version", "git_revision", "compiler",
                                                             "flags", "gsl",      "fftw",    "hdf5",         "yaml"};

struct gx_provenance gx_provenance_of(const struct gx_study *study)
{
  return (struct gx_provenance){.text = {study->title, study->source, gx_build.version, gx_build.git_revision, gx_build.compiler,
                                         gx_build.flags, gx_build.gsl, gx_build.fftw, gx_build.hdf5, gx_build.yaml}};
}

void gx_provenance_add(struct gx_provenance_sum *sum, const void *bytes, size_t length)
{
  if (!sum->count++) sum->sum = GX_CHECKSUM_START;
  sum->sum = gx_checksum(sum->sum, bytes, length);
}

static void write_sum(FILE *out, const char *name, const struct gx_provenance_sum *sum)
{
  fprintf(out, "%s\t#%zu:%016" PRIx64 "\n", name, sum->count, sum->sum);
}

static void write_identity(FILE *out, const struct gx_provenance *provenance, const struct gx_provenance_sum *cases,
                           size_t repeats)
{
  struct gx_provenance_sum text = {0};
  const char *run_file = provenance->text[GX_PROVENANCE_RUN_FILE];
  gx_provenance_add(&text, run_file, strlen(run_file));
  for (int i = GX_PROVENANCE_PROGRAM; i < GX_PROVENANCE_TEXTS; i++)
    fprintf(out, "%s\t%s\n", gx_provenance_name[i], provenance->text[i]);
  write_sum(out, "text of the run file", &text);
  write_sum(out, "cases", cases);
  fprintf(out, "repeats\t%zu\n", repeats);
}

static char *finish(FILE *out, char **text)
{
  if (out && !ferror(out) && !fclose(out)) return *text;
  if (out) free(*text);
  return NULL;
}

char *gx_provenance_identity(const struct gx_provenance *provenance, const struct gx_provenance_sum *cases, size_t repeats)
{
  char *text = NULL;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  if (out) write_identity(out, provenance, cases, repeats);
  return finish(out, &text);
}

char *gx_provenance_identify(const struct gx_study *study)
{
  char *text = NULL;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  const struct gx_provenance provenance = gx_provenance_of(study);
  struct gx_provenance_sum cases = {0}, points = {0};
  for (size_t i = 0; i < study->count; i++) gx_provenance_add(&cases, study->cases[i].id, strlen(study->cases[i].id));
  for (size_t i = 0; i < study->point_lists; i++) {
    const struct gx_points *list = study->points[i];
    for (int d = 0; d < list->dim; d++) gx_provenance_add(&points, list->X[d], list->n * sizeof(double));
    gx_provenance_add(&points, list->V0, list->n * sizeof(double));
  }
  if (out) {
    write_identity(out, &provenance, &cases, study->repeats);
    write_sum(out, "lists of points", &points);
    fprintf(out, "layout of results\t%zu %zu %zu %zu\n", sizeof(struct gx_journal_body), sizeof(struct gx_sample),
            sizeof(struct gx_probe), sizeof(struct gx_budget_values));
  }
  return finish(out, &text);
}

/* The value of a name in an identity, and its length; NULL: there is none. */
static const char *value_of(const char *identity, const char *name, size_t length, size_t *size)
{
  for (const char *line = identity; *line; line += strcspn(line, "\n"), line += *line == '\n') {
    if (strncmp(line, name, length) != 0 || line[length] != '\t') continue;
    *size = strcspn(line + length + 1, "\n");
    return line + length + 1;
  }
  return NULL;
}

bool gx_provenance_equal(const char *there, const char *here, FILE *out)
{
  enum { SHOWN = 48 };
  const char *gap = "";
  for (const char *line = here; *line; line += strcspn(line, "\n"), line += *line == '\n') {
    size_t name = strcspn(line, "\t\n"), size = 0, other_size = 0;
    const char *value = value_of(here, line, name, &size), *other = value_of(there, line, name, &other_size);
    if (!value || !other || (size == other_size && !strncmp(value, other, size))) continue;
    if (out) fprintf(out, "%s%.*s", gap, (int)name, line);
    if (out && *value != '#' && size <= SHOWN && other_size <= SHOWN)
      fprintf(out, " (%.*s there, %.*s here)", (int)other_size, other, (int)size, value);
    gap = ", ";
  }
  return !*gap;
}
