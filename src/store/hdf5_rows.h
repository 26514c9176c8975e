/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading study.h5 piece by piece: memory does not grow with the number of rows. */
#ifndef GRIDCROSS_STORE_HDF5_ROWS_H
#define GRIDCROSS_STORE_HDF5_ROWS_H

#include "hdf5_write.h"

struct gx_hdf5_rows;

/* name: [columns] of those that are wanted, others are none; NULL: all. NULL after a message. path, errors: borrowed to the end. */
struct gx_hdf5_rows *gx_hdf5_rows_begin(const char *path, size_t columns, const char *const *name, FILE *errors);
/* How many there are. */
size_t gx_hdf5_rows_total(const struct gx_hdf5_rows *rows);
/* The next ones begin there. */
void gx_hdf5_rows_seek(struct gx_hdf5_rows *rows, size_t row);
/* The next ones, so many or what is left, with `more` columns without name at the end; NULL after a message. */
struct gx_table *gx_hdf5_rows_next(struct gx_hdf5_rows *rows, size_t most, size_t more);
/* Whether any case keeps something. */
bool gx_hdf5_rows_keeps(struct gx_hdf5_rows *rows, enum gx_hdf5_kept what);
/* What a case keeps; NULL with *failed 0: nothing, else after a message. */
struct gx_table *gx_hdf5_rows_kept(struct gx_hdf5_rows *rows, enum gx_hdf5_kept what, const char *id, int *failed);
/* Borrowed until the end; NULL after a message. */
const struct gx_provenance *gx_hdf5_rows_provenance(struct gx_hdf5_rows *rows);
void gx_hdf5_rows_end(struct gx_hdf5_rows *rows);

#endif
