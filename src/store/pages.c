/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page has its place by its number: of those that share a place, the last stays. */
#include "pages.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PAGE = 1 << 13, PLACES = 64 };

struct page {
  int file; /* -1: none */
  uint64_t start;
  size_t length; /* less than PAGE: of a file that ended there */
  unsigned char byte[PAGE];
};

struct gx_pages {
  struct page page[PLACES];
};

struct gx_pages *gx_pages_create(void)
{
  struct gx_pages *pages = malloc(sizeof *pages);
  for (int i = 0; pages && i < PLACES; i++) pages->page[i].file = -1;
  return pages;
}

/* Bytes from an offset, as many as there are up to a limit; -1: it cannot be read. */
static ssize_t read_some(int file, uint64_t offset, void *to, size_t most)
{
  size_t have = 0;
  while (have < most) {
    ssize_t got = pread(file, (char *)to + have, most - have, (off_t)(offset + have));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (!got) break;
    have += (size_t)got;
  }
  return (ssize_t)have;
}

/* The page that begins there with at least so many bytes; NULL: it has not, or cannot be read. */
static const struct page *look(struct gx_pages *pages, int file, uint64_t start, size_t least)
{
  struct page *page = &pages->page[start / PAGE % PLACES];
  if (page->file != file || page->start != start || page->length < least) {
    ssize_t got = read_some(file, start, page->byte, PAGE);
    page->file = got < 0 ? -1 : file;
    page->start = start;
    page->length = got < 0 ? 0 : (size_t)got;
  }
  return page->length < least ? NULL : page;
}

int gx_pages_read(struct gx_pages *pages, int file, uint64_t offset, void *to, size_t length)
{
  if (!pages || length > PAGE) return read_some(file, offset, to, length) == (ssize_t)length ? 0 : -1;
  for (char *at = to; length;) {
    const size_t skipped = (size_t)(offset % PAGE), there = PAGE - skipped < length ? PAGE - skipped : length;
    const struct page *page = look(pages, file, offset - skipped, skipped + there);
    if (!page) return -1;
    memcpy(at, page->byte + skipped, there);
    at += there;
    offset += there;
    length -= there;
  }
  return 0;
}

void gx_pages_forget(struct gx_pages *pages, int file)
{
  for (int i = 0; pages && i < PLACES; i++)
    if (pages->page[i].file == file) pages->page[i].file = -1;
}

void gx_pages_free(struct gx_pages *pages)
{
  free(pages);
}
