/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All journals of a directory. */
#ifndef GRIDCROSS_STORE_JOURNALS_H
#define GRIDCROSS_STORE_JOURNALS_H

#include "journal.h"

/* Whether a study of this identity may be run there. resume: results that are there must be its own; otherwise there must be none.
 * Journals without results are removed. Returns 0, or -1 after a message. */
int gx_journals_check(const char *directory, const char *identity, bool resume, FILE *errors);

struct gx_journals;

/* Those of an identity. NULL after a message. directory, errors: borrowed until they are closed. */
struct gx_journals *gx_journals_open(const char *directory, const char *identity, FILE *errors);
/* Tells of every whole record of every journal. Returns 0, or -1 after a message. */
int gx_journals_scan(struct gx_journals *journals, void (*found)(void *context, size_t journal, size_t index, uint64_t offset),
                     void *context);
/* A result that was found, freed by gx_case_free. Returns 0, or -1 after a message. */
int gx_journals_result(struct gx_journals *journals, size_t journal, uint64_t offset, struct gx_result *result);
/* Removes them from the directory. */
void gx_journals_remove(struct gx_journals *journals);
void gx_journals_close(struct gx_journals *journals);

#endif
