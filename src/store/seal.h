/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 crashes on damaged files. So those that we write end in checksums of their pieces, which are no part of HDF5's file and which
 * other programs do not see, and HDF5 is given no piece that differs from what was written. Against accidents, not against enemies:
 * whoever can write a file can write its checksums. */
#ifndef GRIDCROSS_STORE_SEAL_H
#define GRIDCROSS_STORE_SEAL_H

#include "handle.h"

/* Adds them to a finished file that is open for reading and writing. Returns 0 or errno. */
int gx_seal_put(int descriptor);

/* Opens a file for reading. Less than 0: *wrong says why. A damaged piece fails when it is read. */
hid_t gx_seal_open(const char *path, const char **wrong);
void gx_seal_close(hid_t file);

/* What follows "is damaged". */
#define GX_SEAL_REMEDY ": copy it again from where it is whole, or run the study again"

#endif
