/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Balance of space and time errors in one step, steffen2010 §§5.4, 6.4, 7: c1 h^p dt against c2 dt^q. */
#ifndef GRIDCROSS_BALANCE_H
#define GRIDCROSS_BALANCE_H

#include <stdio.h>

#include <gridcross/study.h>
#include <gridcross/table.h>

/* Makes every case one step from time.start with its budget, whatever its end. Returns 0, or -1 after messages that begin with
 * `name` when a case has no grid or no time.dt. */
int gx_balance_prepare(struct gx_study *study, const char *name, FILE *errors);

/* One row a method, that is, what remains of the axes without mesh.cells and time.dt; table: of the study so prepared, run on three
 * meshes and three steps or more. Columns: the method, mesh.cells (the finest, at which the balance is), and as result.balance.*
 *   c1, space_order, space_order_error     space error of the acceleration (budget.l2.projected) as c1 h^p: p by a least-squares
 *                                          line through the logarithms of all meshes but the finest, with its standard error; c1 at
 *                                          the finest of these, with p rounded to a whole number
 *   c2, time_order                         time error of the step (budget.l2.time) as c2 dt^q: likewise; c2 at the least step that
 *                                          round-off leaves alone
 *   predicted_dt                           where c1 h^p dt = c2 dt^q at the finest mesh, which c1 has not seen
 *   measured_dt                            where the two ends of the measured curve (budget.l2.increment there) meet: the line of
 *                                          slope 1 through its least step and that of slope q through its largest; null where the
 *                                          curve has not these slopes, within 0.1, at its ends
 *   stable_dt                              the largest stable step there
 *   time_over_space                        ratio of the two errors at stable_dt
 *   quadrature                             forces by particles: their error over that of all else in space (budget.velocity.*)
 *   advice                                 what follows, in words, after steffen2010 §7
 * NULL after a message that begins with `name`. */
struct gx_table *gx_balance_table(const struct gx_table *table, const char *name, FILE *errors);

#endif
