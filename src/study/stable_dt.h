/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest stable time step of a case. */
#ifndef GRIDCROSS_STUDY_STABLE_DT_H
#define GRIDCROSS_STUDY_STABLE_DT_H

#include <gridcross/study.h>

/* Estimated on a fresh copy of the case, s; 0: no step is stable; NaN: the case cannot run, has no stress, or the estimate would cost more
 * than the run. running: for the result of a run, whose few steps cost less; else for who asks. team: borrowed, may be NULL. */
double gx_stable_dt(const struct gx_case *one, bool running, struct gx_team *team);

#endif
