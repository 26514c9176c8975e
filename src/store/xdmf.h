/* SPDX-License-Identifier: GPL-3.0-or-later */
/* XDMF that describes a file of snapshots (openpmd.h), for ParaView: a temporal collection, of particles as a Polyvertex with explicit
 * connectivity or of the vertices as a structured mesh. ParaView 5.11's default reader shows nothing of coordinates in separate
 * arrays, of vectors joined from components, and of collections of both. */
#ifndef GRIDCROSS_STORE_XDMF_H
#define GRIDCROSS_STORE_XDMF_H

#include <stdio.h>

#include <gridcross/snapshot.h>

enum gx_xdmf_kind { GX_XDMF_PARTICLES, GX_XDMF_VERTICES, GX_XDMF_KINDS };

void gx_xdmf_begin(FILE *out);
/* One grid. file: name of the HDF5 file in the same directory. */
void gx_xdmf_put(FILE *out, const char *file, enum gx_xdmf_kind kind, const struct gx_snapshot *snapshot);
void gx_xdmf_end(FILE *out);

#endif
