/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advice from studies: the error-cost front, the cheapest cases that meet an error, and why. Cost is result.seconds,
 * the time of the steps alone. */
#ifndef GRIDCROSS_ADVISE_H
#define GRIDCROSS_ADVISE_H

#include <stdio.h>

#include <gridcross/page.h>
#include <gridcross/table.h>

struct gx_advice {
  size_t studies;
  const struct gx_table *const *table; /* [studies], borrowed */
  const char *const *name;             /* [studies] values of the axis `study` */
  const char *value;                   /* column of the error; NULL: result.displacement.max.rms */
  size_t bounds;
  const double *bound; /* [bounds] errors to meet; none: the front alone */
};

/* The front as a table, then for each error its cheapest case as a run file, and why it is the cheapest. Cases that did not end ok,
 * and those whose step is above the stable one, do not take part here or below; notes to `errors`, where every message goes, tell
 * how many there were. Every function returns 0 (or a table), or -1 (NULL) after a message: what is asked for is not there, or
 * the cases are of different problems. */
int gx_advise_print(const struct gx_advice *advice, const struct gx_page *page, FILE *out, FILE *errors);
/* The front, one row a case, cheapest first: case, what varies, the error, result.seconds, result.dt, result.stable_dt,
 * `pick` (the errors it is the cheapest case for), `why` (one reason a line) and `run_file`. */
struct gx_table *gx_advise_table(const struct gx_advice *advice, FILE *errors);
/* A run file of the cheapest cases, or of the front where no error is given. */
int gx_advise_write(const struct gx_advice *advice, FILE *out, FILE *errors);

#endif
