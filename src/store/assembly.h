/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a study together from its cases in order, by pieces: memory does not grow with their number. Files are written beside their final
 * names, flushed to disk and renamed, study.h5 first, so that a kill at any instant leaves the old study or the new one. */
#ifndef GRIDCROSS_STORE_ASSEMBLY_H
#define GRIDCROSS_STORE_ASSEMBLY_H

#include "provenance.h"

enum { GX_ASSEMBLY_STUDY, GX_ASSEMBLY_TABLE, GX_ASSEMBLY_TIMING, GX_ASSEMBLY_RUN, GX_ASSEMBLY_FILES };

/* study.h5, table.csv, timing.csv, run.json */
extern const char *const gx_assembly_name[GX_ASSEMBLY_FILES];

/* DIRECTORY/<prefix><name><suffix>, owned by the caller; NULL when memory runs out. */
char *gx_assembly_path(const char *directory, const char *prefix, const char *name, const char *suffix);
/* Says "path: what errno means", or that memory ran out where path is NULL. Returns -1. */
int gx_assembly_say(FILE *errors, const char *path);

struct gx_assembly;

/* Of so many cases; like: a table whose columns they have, timing last. NULL after a message. directory, errors: borrowed to the end. */
struct gx_assembly *gx_assembly_begin(const char *directory, const struct gx_table *like, size_t cases, size_t repeats,
                                      FILE *errors);
/* The next case. Returns 0, or -1 after a message, and so do those below. */
int gx_assembly_put(struct gx_assembly *assembly, const struct gx_case *one, const struct gx_result *result);
/* The next case from a row of a table with the same columns, with its history and spectra; NULL: none. */
int gx_assembly_put_row(struct gx_assembly *assembly, const struct gx_table *table, size_t row, const struct gx_table *history,
                        const struct gx_table *spectra);
/* Replaces the study in the directory, and frees the assembly. provenance: NULL: it is given up and the old study stays. */
int gx_assembly_end(struct gx_assembly *assembly, const struct gx_provenance *provenance, const struct gx_store_run *run);

#endif
