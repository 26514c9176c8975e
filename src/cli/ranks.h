/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranks: the processes that mpirun starts for one run. They take cases from the first of them as they become free; it works on cases
 * as well. All else of MPI is in ranks.c. Without MPI, or started alone, a run has no ranks: NULL below, and nothing is done. */
#ifndef GRIDCROSS_CLI_RANKS_H
#define GRIDCROSS_CLI_RANKS_H

#include <stdint.h>

#include <gridcross/study.h>

struct gx_ranks;

/* "MPI 3.1" that it was built with, or "no MPI". */
const char *gx_ranks_version(void);

/* Joins the others. From now on only the first rank is heard on standard error, until gx_ranks_speak. apart: processes without MPI may
 * do this side by side, each its own part. Returns 0, or an exit code after a message of one of them. */
int gx_ranks_begin(struct gx_ranks **ranks, bool apart);
/* Of those that have no ranks, everyone is first. */
bool gx_ranks_first(const struct gx_ranks *ranks);
/* Threads of this rank, of so many processors that it may use and that the ranks beside it use as well. */
size_t gx_ranks_threads(const struct gx_ranks *ranks, size_t processors);

/* Below, calls that all ranks make together. */

/* 0 where that is everyone's code; else that of the first rank that has another, which is then heard with what it has said. */
int gx_ranks_agree(struct gx_ranks *ranks, int code);
/* 0 where all have the same number, else an exit code after a message. */
int gx_ranks_alike(struct gx_ranks *ranks, uint64_t number);
/* Everyone is heard again. */
void gx_ranks_speak(struct gx_ranks *ranks);
/* Gives out the cases of a queue; the others' is NULL. cancel: ends waiting. Both are borrowed until gx_ranks_meet. The source is for
 * this rank's threads. Returns 0, or an exit code after a message. */
int gx_ranks_serve(struct gx_ranks *ranks, struct gx_queue *queue, const atomic_bool *cancel, struct gx_source *source);
/* Cases that were given out, to all ranks; known to the first. */
size_t gx_ranks_given(const struct gx_ranks *ranks);
/* Waits for all, until they have no case left. Returns 0, or -1 when it was cancelled. */
int gx_ranks_meet(struct gx_ranks *ranks);
/* The end, for all together; broken: this rank ends before its time, by an error or a signal, and so must the others. */
void gx_ranks_end(struct gx_ranks *ranks, bool broken, int code);

#endif
