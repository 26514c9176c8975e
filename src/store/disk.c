/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A driver of HDF5's virtual file layer over a file descriptor. */
#include "disk.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

struct info {
  struct gx_disk *disk;
};

struct open_file {
  H5FD_t base;
  struct gx_disk *disk;
  haddr_t eoa, eof;
};

static H5FD_t *open_disk(const char *name, unsigned flags, hid_t access, haddr_t most)
{
  (void)name, (void)flags, (void)most;
  const struct info *info = H5Pget_driver_info(access);
  struct open_file *file = info ? calloc(1, sizeof *file) : NULL;
  if (!file) return NULL;
  file->disk = info->disk;
  return &file->base;
}

static herr_t close_disk(H5FD_t *base)
{
  free(base);
  return 0;
}

static herr_t query(const H5FD_t *base, unsigned long *flags)
{
  (void)base;
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

static haddr_t get_eoa(const H5FD_t *base, H5FD_mem_t type)
{
  (void)type;
  return ((const struct open_file *)base)->eoa;
}

static herr_t set_eoa(H5FD_t *base, H5FD_mem_t type, haddr_t address)
{
  (void)type;
  ((struct open_file *)base)->eoa = address;
  return 0;
}

static haddr_t get_eof(const H5FD_t *base, H5FD_mem_t type)
{
  (void)type;
  return ((const struct open_file *)base)->eof;
}

/* Zeros where nothing was written. */
static herr_t read_disk(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void *buffer)
{
  (void)type, (void)transfer;
  struct gx_disk *disk = ((struct open_file *)base)->disk;
  char *at = buffer;
  while (size) {
    ssize_t got = pread(disk->file, at, size, (off_t)address);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && !disk->failed) disk->failed = errno;
    if (got <= 0) break;
    at += got;
    address += (haddr_t)got;
    size -= (size_t)got;
  }
  memset(at, 0, size);
  return 0;
}

static herr_t write_disk(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, const void *buffer)
{
  (void)type, (void)transfer;
  struct open_file *file = (struct open_file *)base;
  const char *at = buffer;
  if (address + size > file->eof) file->eof = address + size;
  while (size && !file->disk->failed) {
    ssize_t put = pwrite(file->disk->file, at, size, (off_t)address);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      file->disk->failed = errno;
      break;
    }
    at += put;
    address += (haddr_t)put;
    size -= (size_t)put;
  }
  return 0;
}

/* At its end the file is as long as what was allocated in it. */
static herr_t truncate_disk(H5FD_t *base, hid_t transfer, hbool_t closing)
{
  (void)transfer, (void)closing;
  struct open_file *file = (struct open_file *)base;
  if (file->eoa == file->eof) return 0;
  if (!file->disk->failed && ftruncate(file->disk->file, (off_t)file->eoa)) file->disk->failed = errno;
  file->eof = file->eoa;
  return 0;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)H5_VFD_RESERVED + 1,
#endif
    .name = "gridcross_disk",
    .maxaddr = (haddr_t)INT64_MAX,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(struct info),
    .open = open_disk,
    .close = close_disk,
    .query = query,
    .get_eoa = get_eoa,
    .set_eoa = set_eoa,
    .get_eof = get_eof,
    .read = read_disk,
    .write = write_disk,
    .truncate = truncate_disk,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

hid_t gx_disk_access(struct gx_disk *disk, int file)
{
  *disk = (struct gx_disk){.file = file, .driver = H5FDregister(&driver)};
  const struct info info = {.disk = disk};
  hid_t access = disk->driver < 0 ? -1 : H5Pcreate(H5P_FILE_ACCESS);
  if (access < 0 || H5Pset_driver(access, disk->driver, &info) >= 0) return access;
  H5Pclose(access);
  return -1;
}

void gx_disk_end(struct gx_disk *disk)
{
  if (disk->driver >= 0) H5FDunregister(disk->driver);
}
