/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file that HDF5 writes to and that never fails for it: HDF5 that cannot write to a full disk can neither close its file nor let it
 * be. What went wrong is told afterwards. */
#ifndef GRIDCROSS_STORE_DISK_H
#define GRIDCROSS_STORE_DISK_H

#include "handle.h"

struct gx_disk {
  int file;     /* descriptor, open for reading and writing, borrowed */
  int failed;   /* errno of the first failure, 0: none. From then on nothing is written. */
  hid_t driver; /* owned */
};

/* Properties of access to it for H5Fcreate, whose file name then is but a name; to be closed. Less than 0 when HDF5 fails. disk:
 * borrowed until the file is closed; ended by gx_disk_end. */
hid_t gx_disk_access(struct gx_disk *disk, int file);
void gx_disk_end(struct gx_disk *disk);

#endif
