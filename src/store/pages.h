/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces of files that were read last, so that many small readings in an order that is not the file's take few calls. Files must not
 * change while they are there, but may grow. */
#ifndef GRIDCROSS_STORE_PAGES_H
#define GRIDCROSS_STORE_PAGES_H

#include <stddef.h>
#include <stdint.h>

struct gx_pages;

/* NULL when memory runs out. */
struct gx_pages *gx_pages_create(void);
/* Bytes of an open file. pages: NULL: straight from the file. Returns 0, or -1 when they are not all there or cannot be read. */
int gx_pages_read(struct gx_pages *pages, int file, uint64_t offset, void *to, size_t length);
/* Before a descriptor is closed. */
void gx_pages_forget(struct gx_pages *pages, int file);
void gx_pages_free(struct gx_pages *pages);

#endif
