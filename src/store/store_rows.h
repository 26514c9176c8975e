/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What merging needs of stored rows besides gridcross/store.h. */
#ifndef GRIDCROSS_STORE_STORE_ROWS_H
#define GRIDCROSS_STORE_STORE_ROWS_H

#include "hdf5_rows.h"

/* Closes the files until they are wanted again: of many studies few can be open at once. */
void gx_store_rows_pause(struct gx_store_rows *rows);
/* The file itself, borrowed until the next pause; NULL after a message. */
struct gx_hdf5_rows *gx_store_rows_hdf5(struct gx_store_rows *rows);

#endif
