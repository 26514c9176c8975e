/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of particles that run files name. */
#ifndef GRIDCROSS_STUDY_POINTS_H
#define GRIDCROSS_STUDY_POINTS_H

#include <gridcross/study.h>

/* Reads every list that a case names by body.file, once, and gives it to the case. runfile: names that are not absolute are relative
 * to its directory. hdf5: as in gx_runfile_read. Returns 0, or -1 after messages to `out`. */
int gx_points_read(struct gx_study *study, const char *runfile, const struct gx_array_reader *hdf5, FILE *out);
void gx_points_free(struct gx_points *points);

#endif
