/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sound HDF5 files that are not what we wrote. */
#ifndef GRIDCROSS_TESTS_EDIT_H
#define GRIDCROSS_TESTS_EDIT_H

#include <stddef.h>
#include <stdint.h>

/* A file of fuzz_directory() made of the good bytes and changed by way of HDF5, each eight bytes of the input one change; it has the
 * checksums of what it then is. HDF5's own structures stay whole: what becomes of them otherwise is HDF5's affair. */
void fuzz_edit(const char *name, const uint8_t *good, size_t length, const uint8_t *data, size_t size);

#endif
