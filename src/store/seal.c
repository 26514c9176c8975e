/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A driver of HDF5's virtual file layer that checks each piece of a file before it is read for the first time. */
#include "seal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include "../core/checksum.h"

enum { PIECE = 1 << 16 }; /* bytes */

/* The end of a file, behind a checksum of each piece of what HDF5 wrote. */
struct foot {
  uint64_t length; /* of HDF5's file, bytes */
  uint64_t sum;    /* of the checksums, then of length */
  char magic[8];
};

static const char magic[8] = "GXSEAL1";

struct open_file {
  H5FD_t base;
  int file; /* descriptor */
  haddr_t eoa;
  uint64_t length;
  uint64_t *sum;        /* [pieces], owned */
  bool *checked;        /* [pieces], owned */
  unsigned char *piece; /* [PIECE], owned */
};

static uint64_t pieces_of(uint64_t length)
{
  return length / PIECE + (length % PIECE > 0);
}

/* Returns 0 or errno; ENODATA where the file ends before. */
static int read_at(int file, uint64_t offset, void *to, size_t length)
{
  for (char *at = to; length;) {
    const ssize_t got = pread(file, at, length, (off_t)offset);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got ? errno : ENODATA;
    at += got;
    offset += (uint64_t)got;
    length -= (size_t)got;
  }
  return 0;
}

static int write_at(int file, uint64_t offset, const void *from, size_t length)
{
  for (const char *at = from; length;) {
    const ssize_t put = pwrite(file, at, length, (off_t)offset);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return put ? errno : EIO;
    at += put;
    offset += (uint64_t)put;
    length -= (size_t)put;
  }
  return 0;
}

/* The checksum of piece i of a file of a length. buffer: [PIECE]. Returns 0 or errno. */
static int sum_piece(int file, uint64_t length, uint64_t i, unsigned char *buffer, uint64_t *sum)
{
  const uint64_t left = length - i * PIECE;
  const size_t size = left < PIECE ? (size_t)left : PIECE;
  const int failed = read_at(file, i * PIECE, buffer, size);
  if (!failed) *sum = gx_checksum(GX_CHECKSUM_START, buffer, size);
  return failed;
}

static uint64_t sum_sums(const uint64_t *sum, uint64_t pieces, uint64_t length)
{
  return gx_checksum(gx_checksum(GX_CHECKSUM_START, sum, (size_t)pieces * sizeof *sum), &length, sizeof length);
}

int gx_seal_put(int descriptor)
{
  struct stat status;
  if (fstat(descriptor, &status)) return errno;
  struct foot foot = {.length = (uint64_t)status.st_size};
  memcpy(foot.magic, magic, sizeof foot.magic);
  const uint64_t pieces = pieces_of(foot.length);
  uint64_t *sum = malloc((size_t)(pieces + 1) * sizeof *sum);
  unsigned char *buffer = malloc(PIECE);
  int failed = sum && buffer ? 0 : ENOMEM;
  for (uint64_t i = 0; i < pieces && !failed; i++) failed = sum_piece(descriptor, foot.length, i, buffer, &sum[i]);
  if (!failed) {
    foot.sum = sum_sums(sum, pieces, foot.length);
    failed = write_at(descriptor, foot.length, sum, (size_t)pieces * sizeof *sum);
  }
  if (!failed) failed = write_at(descriptor, foot.length + pieces * sizeof *sum, &foot, sizeof foot);
  free(buffer);
  free(sum);
  return failed;
}

/* Whether the file ends in checksums that are whole; memory is taken for no more of them than it has. */
static bool read_foot(struct open_file *file)
{
  struct stat status;
  struct foot foot;
  if (fstat(file->file, &status) || (size_t)status.st_size < sizeof foot) return false;
  const uint64_t size = (uint64_t)status.st_size - sizeof foot;
  if (read_at(file->file, size, &foot, sizeof foot) || memcmp(foot.magic, magic, sizeof magic) || foot.length > size)
    return false;
  const uint64_t pieces = pieces_of(foot.length);
  if (size - foot.length != pieces * sizeof *file->sum) return false;
  file->length = foot.length;
  file->sum = malloc((size_t)(pieces + 1) * sizeof *file->sum);
  file->checked = calloc((size_t)pieces + 1, sizeof *file->checked);
  file->piece = malloc(PIECE);
  return file->sum && file->checked && file->piece &&
         !read_at(file->file, foot.length, file->sum, (size_t)pieces * sizeof *file->sum) &&
         sum_sums(file->sum, pieces, foot.length) == foot.sum;
}

static void release(struct open_file *file)
{
  if (file->file >= 0) close(file->file);
  free(file->sum);
  free(file->checked);
  free(file->piece);
  free(file);
}

struct info {
  bool *sealed; /* where to say whether there are checksums */
};

static H5FD_t *open_sealed(const char *name, unsigned flags, hid_t access, haddr_t most)
{
  (void)flags, (void)most;
  const struct info *info = H5Pget_driver_info(access);
  struct open_file *file = info ? calloc(1, sizeof *file) : NULL;
  if (!file) return NULL;
  file->file = open(name, O_RDONLY | O_CLOEXEC);
  *info->sealed = file->file >= 0 && read_foot(file);
  if (*info->sealed) return &file->base;
  release(file);
  return NULL;
}

static herr_t close_sealed(H5FD_t *base)
{
  release((struct open_file *)base);
  return 0;
}

static herr_t query(const H5FD_t *base, unsigned long *flags)
{
  (void)base;
  *flags = H5FD_FEAT_DATA_SIEVE;
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
  return ((const struct open_file *)base)->length;
}

static bool is_sound(struct open_file *file, uint64_t i)
{
  uint64_t sum;
  if (!file->checked[i]) file->checked[i] = !sum_piece(file->file, file->length, i, file->piece, &sum) && sum == file->sum[i];
  return file->checked[i];
}

static herr_t read_sealed(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void *buffer)
{
  (void)type, (void)transfer;
  struct open_file *file = (struct open_file *)base;
  if (!size) return 0;
  if (address > file->length || size > file->length - address) return -1;
  for (uint64_t i = address / PIECE; i <= (address + size - 1) / PIECE; i++)
    if (!is_sound(file, i)) return -1;
  return read_at(file->file, address, buffer, size) ? -1 : 0;
}

static herr_t write_sealed(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, const void *buffer)
{
  (void)base, (void)type, (void)transfer, (void)address, (void)size, (void)buffer;
  return -1;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)H5_VFD_RESERVED + 2,
#endif
    .name = "gridcross_seal",
    .maxaddr = (haddr_t)INT64_MAX,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(struct info),
    .open = open_sealed,
    .close = close_sealed,
    .query = query,
    .get_eoa = get_eoa,
    .set_eoa = set_eoa,
    .get_eof = get_eof,
    .read = read_sealed,
    .write = write_sealed,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

hid_t gx_seal_open(const char *path, const char **wrong)
{
  bool sealed = false;
  const struct info info = {.sealed = &sealed};
  const hid_t registered = H5FDregister(&driver), access = registered < 0 ? -1 : H5Pcreate(H5P_FILE_ACCESS);
  hid_t file = -1;
  if (access >= 0 && H5Pset_driver(access, registered, &info) >= 0) file = H5Fopen(path, H5F_ACC_RDONLY, access);
  if (access >= 0) H5Pclose(access);
  if (registered >= 0 && file < 0) H5FDunregister(registered);
  *wrong = sealed ? "is damaged" : "is damaged, was changed by another program, or gridcross did not write it";
  return file;
}

/* HDF5 closes a file by a driver that is no longer there unless somebody else holds on to that. */
void gx_seal_close(hid_t file)
{
  const hid_t access = H5Fget_access_plist(file), registered = access < 0 ? -1 : H5Pget_driver(access);
  if (access >= 0) H5Pclose(access);
  H5Fclose(file);
  if (registered >= 0) H5FDunregister(registered);
}
