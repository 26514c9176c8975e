/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Journals: the results of a study under way, DIR/.journal-<n>.partial, one a writer. Nothing in them is ever changed: a head says whose
 * results they are, and each case that ends adds one record with two checksums, one of its own head and one of what follows. A
 * kill can only leave the last record unfinished, which is then none; damage elsewhere costs the records that it hits.
 * What they hold is the memory of the program that wrote them, for that program alone: identities (identity.h) say which that is. */
#ifndef GRIDCROSS_STORE_JOURNAL_H
#define GRIDCROSS_STORE_JOURNAL_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include <gridcross/study.h>

#include "packing.h"
#include "pages.h"

/* First of a journal: its head and, in whole words, the text of an identity. */
struct gx_journal_head {
  uint64_t magic;
  uint64_t length; /* of the text, bytes, without the zeros that fill its last word */
  uint64_t sum;    /* of length and text */
};

/* First of a record. */
struct gx_journal_record {
  uint64_t magic;
  uint64_t index;  /* of the case */
  uint64_t length; /* of what follows, bytes */
  uint64_t sum;    /* of what follows */
  uint64_t own;    /* of the four above */
};

#define GX_JOURNAL_MAGIC        UINT64_C(0x0a324c4e524a5847) /* "GXJRNL2\n" where words begin with their low byte */
#define GX_JOURNAL_RECORD_MAGIC UINT64_C(0x65736163beefcafe)

/* What follows: this, packed (packing.h), then of the history sample, probe and budget, then of the spectra time and rms, where there are
 * any. */
struct gx_journal_body {
  uint64_t probes, budgets; /* whether there are any */
  struct gx_result result;  /* without pointers */
};
_Static_assert(sizeof(struct gx_journal_body) % 8 == 0 && sizeof(struct gx_sample) % 8 == 0 && sizeof(struct gx_probe) % 8 == 0 &&
                   sizeof(struct gx_budget_values) % 8 == 0,
               "checksums go by words");
enum { GX_JOURNAL_BODY = sizeof(struct gx_journal_body) / 8 }; /* words */

struct gx_journal;

/* A new journal under the first number that is free. errors: borrowed until it is closed. NULL after a message. */
struct gx_journal *gx_journal_create(const char *directory, const char *identity, FILE *errors);
/* Adds a record, which then no kill undoes; flushed to disk within about a second. By any thread. Returns 0, or -1 after a message:
 * then the journal is as it was, and can be used again, unless its file was removed, which is found out when it is flushed. */
int gx_journal_append(struct gx_journal *journal, size_t index, const struct gx_result *result);
/* Flushes it to disk; one without records is removed. Returns 0, or -1 after a message. */
int gx_journal_close(struct gx_journal *journal);

/* Of a file that may be any file at all: */

/* The identity, owned by the caller; NULL: it is no journal, or its head is damaged. */
char *gx_journal_scan_identity(int file);
/* Tells of every whole record, in order. Returns 0, or -1 when it cannot be read. */
int gx_journal_scan(int file, void (*found)(void *context, size_t index, uint64_t offset), void *context);
/* The result of a whole record, freed by gx_case_free. pages: of the file, NULL: none. Returns 0, or -1 when it is damaged, cannot be read,
 * or memory runs out. */
int gx_journal_scan_result(int file, struct gx_pages *pages, uint64_t offset, struct gx_result *result);

#endif
