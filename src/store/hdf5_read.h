/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What readers of study.h5 share. */
#ifndef GRIDCROSS_STORE_HDF5_READ_H
#define GRIDCROSS_STORE_HDF5_READ_H

#include <stdio.h>

#include <gridcross/table.h>

#include "handle.h"

/* A study file of our format, to be closed, or -1 after a message. */
hid_t gx_hdf5_read_open(const char *path, FILE *errors);
/* All of a group whose members are columns; NULL when it is damaged or memory runs out. */
struct gx_table *gx_hdf5_read_group(hid_t group);

#endif
