/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing study.h5 piece by piece: memory does not grow with the number of rows. Equal pieces give equal bytes. */
#ifndef GRIDCROSS_STORE_HDF5_WRITE_H
#define GRIDCROSS_STORE_HDF5_WRITE_H

#include <gridcross/table.h>

#include "provenance.h"

enum gx_hdf5_kept { GX_HDF5_HISTORIES, GX_HDF5_SPECTRA, GX_HDF5_KEPT };

/* Groups of what cases keep beside the table: "histories", "spectra". */
extern const char *const gx_hdf5_write_kept_name[GX_HDF5_KEPT];

struct gx_hdf5_writer;

/* A new file at path, with the first columns of a table and so many rows to come. NULL after a message; errors, path: borrowed to the end. */
struct gx_hdf5_writer *gx_hdf5_write_begin(const char *path, const struct gx_table *table, size_t columns, size_t rows,
                                           FILE *errors);
/* The next rows: the first `rows` of a table that has these columns and perhaps more. Returns 0, or -1 after a message, and so do those below. */
int gx_hdf5_write_rows(struct gx_hdf5_writer *writer, const struct gx_table *part, size_t rows);
/* What a case keeps. */
int gx_hdf5_write_kept(struct gx_hdf5_writer *writer, enum gx_hdf5_kept what, const char *id, const struct gx_table *table);
/* Flushes the file to disk and frees the writer. provenance: NULL: the file is given up, whatever is in it. */
int gx_hdf5_write_end(struct gx_hdf5_writer *writer, const struct gx_provenance *provenance);

#endif
