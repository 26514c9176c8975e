/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A column of a table as a dataset. In it NaN, the attribute `null` of an integer column and the empty text stand for null; texts are as
 * wide as their column says, or as long as each is. A column of nulls takes no room. */
#ifndef GRIDCROSS_STORE_HDF5_COLUMN_H
#define GRIDCROSS_STORE_HDF5_COLUMN_H

#include <gridcross/table.h>

#include "handle.h"

/* For so many rows. To be closed, or less than 0. */
hid_t gx_hdf5_column_create(hid_t group, const struct gx_column *column, size_t rows);
/* Column c of the first `rows` of a table, as many as memory has and where `space` selects them. Returns 0 or -1. */
int gx_hdf5_column_write(hid_t dataset, const struct gx_table *part, size_t c, size_t rows, hid_t memory, hid_t space,
                         hid_t transfer);
/* Names column c of a table after a dataset, with unit, type and width. Returns 0 or -1. */
int gx_hdf5_column_name(hid_t dataset, const char *name, struct gx_table *table, size_t c);
/* Column c, named, of all rows of a table: those of the dataset from `first` on. Returns 0, or -1 when it is damaged. */
int gx_hdf5_column_read(hid_t dataset, size_t first, struct gx_table *table, size_t c);

#endif
