/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An image passes through a buffer, block by block: it may be as large as what the run has in memory. */
#include "checkpoint.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../core/checksum.h"

/* Whatever changes the meaning of images without changing the program's version changes this. */
static const char magic[8] = "GXCKPT1";

struct head {
  char magic[8];
  struct gx_checkpoint_mark mark;
  uint64_t identity; /* bytes of text, without the padding */
  uint64_t length;   /* bytes of the image */
  uint64_t sum;      /* of the identity, padded, and the image */
  uint64_t own;      /* of all above */
};

enum { BLOCK = 1 << 18 }; /* a multiple of 8 */

/* A file that is written, or read, from front to back. */
struct stream {
  int file, failed; /* failed: errno; ENODATA: it ended too soon */
  bool reading;
  size_t used, filled; /* of the block: used up to here; reading: filled up to there */
  uint64_t length, sum;
  unsigned char *block; /* [BLOCK] */
};

static void write_block(struct stream *stream)
{
  stream->sum = gx_checksum(stream->sum, stream->block, stream->used);
  stream->length += stream->used;
  for (size_t at = 0; at < stream->used && !stream->failed;) {
    ssize_t written = write(stream->file, stream->block + at, stream->used - at);
    if (written < 0 && errno != EINTR) stream->failed = errno;
    if (written > 0) at += (size_t)written;
  }
  stream->used = 0;
}

static void read_block(struct stream *stream)
{
  stream->used = stream->filled = 0;
  while (stream->filled < BLOCK && !stream->failed) {
    ssize_t got = read(stream->file, stream->block + stream->filled, BLOCK - stream->filled);
    if (got < 0 && errno != EINTR) stream->failed = errno;
    if (got == 0) break;
    if (got > 0) stream->filled += (size_t)got;
  }
  stream->sum = gx_checksum(stream->sum, stream->block, stream->filled);
  stream->length += stream->filled;
}

static int move(void *context, void *bytes, size_t length)
{
  struct stream *stream = context;
  unsigned char *at = bytes;
  while (length && !stream->failed) {
    if (stream->reading && stream->used == stream->filled) read_block(stream);
    if (!stream->reading && stream->used == BLOCK) write_block(stream);
    const size_t room = (stream->reading ? stream->filled : BLOCK) - stream->used, n = length < room ? length : room;
    if (!room && !stream->failed) stream->failed = ENODATA;
    if (stream->failed) break;
    if (stream->reading)
      memcpy(at, stream->block + stream->used, n);
    else
      memcpy(stream->block + stream->used, at, n);
    stream->used += n;
    at += n;
    length -= n;
  }
  return stream->failed;
}

static void put_identity(struct stream *stream, const char *identity, size_t length)
{
  char padding[8] = "", *text = strdup(identity);
  if (text)
    move(stream, text, length);
  else
    stream->failed = ENOMEM;
  move(stream, padding, (8 - length % 8) % 8);
  free(text);
}

/* An open file is filled, flushed and closed. Returns 0 or errno. */
static int fill(int file, const char *identity, const struct gx_checkpoint_mark *mark, const struct gx_checkpoint *run)
{
  struct stream stream = {.file = file, .sum = GX_CHECKSUM_START, .block = malloc(BLOCK)};
  struct head head = {.mark = *mark, .identity = strlen(identity)};
  memcpy(head.magic, magic, sizeof head.magic);
  if (!stream.block) stream.failed = ENOMEM;
  if (!stream.failed && lseek(file, sizeof head, SEEK_SET) < 0) stream.failed = errno;
  put_identity(&stream, identity, head.identity);
  struct gx_image image = {.context = &stream, .move = move, .failed = stream.failed};
  run->image(run->run, &image);
  write_block(&stream);
  if (image.failed && !stream.failed) stream.failed = EINVAL;
  head.length = stream.length - (head.identity + 7) / 8 * 8;
  head.sum = stream.sum;
  head.own = gx_checksum(GX_CHECKSUM_START, &head, offsetof(struct head, own));
  if (!stream.failed && pwrite(file, &head, sizeof head, 0) != (ssize_t)sizeof head) stream.failed = errno ? errno : EIO;
  if (!stream.failed && fsync(file) && errno != EINVAL && errno != EROFS) stream.failed = errno;
  if (close(file) && !stream.failed) stream.failed = errno;
  free(stream.block);
  return stream.failed;
}

/* So that the new name is on disk too; nothing is lost where that fails. */
static void flush_directory(const char *path)
{
  char *directory = strdup(path), *slash = directory ? strrchr(directory, '/') : NULL;
  if (slash) *slash = '\0';
  int file = slash ? open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
  if (file >= 0) {
    fsync(file);
    close(file);
  }
  free(directory);
}

int gx_checkpoint_write(const char *path, const char *hidden, const char *identity, const struct gx_checkpoint_mark *mark,
                        const struct gx_checkpoint *run)
{
  int file = open(hidden, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int failed = fill(file, identity, mark, run);
  if (!failed && rename(hidden, path)) failed = errno;
  if (failed)
    unlink(hidden);
  else
    flush_directory(path);
  return failed;
}

static bool is_head(const struct head *head)
{
  return !memcmp(head->magic, magic, sizeof magic) &&
         head->own == gx_checksum(GX_CHECKSUM_START, head, offsetof(struct head, own)) && head->identity < 1 << 20;
}

/* Whether what follows the head is whole, and of this identity. */
static const char *look_behind(struct stream *stream, const struct head *head, const char *identity)
{
  static const char *const damaged = "is damaged";
  const size_t padded = (head->identity + 7) / 8 * 8;
  char *text = malloc(padded + 1);
  if (!text || !stream->block) {
    free(text);
    return "does not fit into memory";
  }
  bool whole = !move(stream, text, padded);
  while (whole && stream->filled) read_block(stream); /* what is left */
  whole = whole && !stream->failed && stream->length == padded + head->length && stream->sum == head->sum;
  const bool same = whole && strlen(identity) == head->identity && !memcmp(text, identity, head->identity);
  free(text);
  return !whole ? damaged : same ? NULL : "is of another study, or another program wrote it";
}

const char *gx_checkpoint_look(const char *path, const char *identity, struct gx_checkpoint_mark *mark)
{
  struct head head;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno == ENOENT ? "" : "cannot be read";
  const char *reason = "is damaged";
  if (read(file, &head, sizeof head) == (ssize_t)sizeof head && is_head(&head)) {
    struct stream stream = {.file = file, .reading = true, .sum = GX_CHECKSUM_START, .block = malloc(BLOCK)};
    reason = look_behind(&stream, &head, identity);
    free(stream.block);
    *mark = head.mark;
  }
  close(file);
  return reason;
}

int gx_checkpoint_load(const char *path, const struct gx_checkpoint *run)
{
  struct head head;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return -1;
  struct stream stream = {.file = file, .reading = true, .sum = GX_CHECKSUM_START, .block = malloc(BLOCK)};
  const bool readable = stream.block && read(file, &head, sizeof head) == (ssize_t)sizeof head && is_head(&head) &&
                        lseek(file, (off_t)((head.identity + 7) / 8 * 8), SEEK_CUR) > 0;
  struct gx_image image = {.context = &stream, .loading = true, .move = move, .failed = !readable};
  run->image(run->run, &image);
  const bool all = stream.length - stream.filled + stream.used == head.length;
  free(stream.block);
  close(file);
  return image.failed || !all ? -1 : 0;
}
