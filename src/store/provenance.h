/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where results come from: what study.h5 says of itself in /provenance, and what tells studies apart. */
#ifndef GRIDCROSS_STORE_PROVENANCE_H
#define GRIDCROSS_STORE_PROVENANCE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include <gridcross/store.h>

enum { GX_PROVENANCE_TITLE, GX_PROVENANCE_RUN_FILE, GX_PROVENANCE_PROGRAM, GX_PROVENANCE_TEXTS = GX_PROVENANCE_PROGRAM + 8 };

/* Names of the attributes: title, run_file, then version, git_revision and so on of the program. */
extern const char *const gx_provenance_name[GX_PROVENANCE_TEXTS];

struct gx_provenance {
  const char *text[GX_PROVENANCE_TEXTS]; /* borrowed */
  /* Of one shard of a study, else 0. */
  size_t shard, shards; /* from 1 */
  size_t cases;         /* of all shards */
  const char *identity; /* of the study, borrowed; NULL: undivided */
};

/* Of a study that this program runs. */
struct gx_provenance gx_provenance_of(const struct gx_study *study);

/* A sum over many things, in order. */
struct gx_provenance_sum {
  uint64_t sum;
  size_t count;
};
void gx_provenance_add(struct gx_provenance_sum *sum, const void *bytes, size_t length);

/* An identity is a text of lines "name<TAB>value", equal for studies that may be one: the same run file, cases, options, program. */

/* Of cases whose ids were summed up. Owned by the caller, NULL when memory runs out. */
char *gx_provenance_identity(const struct gx_provenance *provenance, const struct gx_provenance_sum *cases, size_t repeats);
/* The same of a study that this program runs, with more that results depend on. */
char *gx_provenance_identify(const struct gx_study *study);
/* Whether what both name is equal; if not, says what differs: "the run file, repeats (3 there, 0 here)". out: NULL: nothing is said. */
bool gx_provenance_equal(const char *there, const char *here, FILE *out);

#endif
