/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file of snapshots in the base layout of openPMD 1.1, https://github.com/openPMD/openPMD-standard/blob/1.1.0/STANDARD.md:
 *   /data/<step>/particles/material_points/<record>[/<component>]   components x, y, z and xx, xy, ...
 *   /data/<step>/meshes/<record>[/<component>]                      where there is a grid, at its vertices
 *   /xdmf/<step>/{particles,vertices}/{position,velocity}           [n][3] for readers of XDMF, outside what openPMD looks at
 * All is float64 in SI units. Constant records, with the particles' id, are written once and linked to. The standard's recommended
 * attributes `date` and `author` are left out: equal runs give equal bytes. HDF5 is not thread-safe: one call at a time. */
#ifndef GRIDCROSS_STORE_OPENPMD_H
#define GRIDCROSS_STORE_OPENPMD_H

#include <gridcross/snapshot.h>

#define GX_OPENPMD_PARTICLES "particles/material_points"
#define GX_OPENPMD_VERTICES  "meshes"

struct gx_openpmd;

/* Replaces the file. NULL when that fails, errno then set where the system said why. */
struct gx_openpmd *gx_openpmd_create(const char *path, const char *id);
/* Adds a snapshot. All that follow have as many particles and the same records. Returns 0, or -1, errno then 0 or what the disk said. */
int gx_openpmd_put(struct gx_openpmd *file, const struct gx_snapshot *snapshot);
/* Returns 0, or -1 where anything failed, errno likewise. */
int gx_openpmd_close(struct gx_openpmd *file);

/* Suffix of a component: "" of a scalar, "x", "yz". */
const char *gx_openpmd_component(int dim, int rank, int component, char name[3]);

#endif
