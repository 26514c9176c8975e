/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of particles that run files name. */
#ifndef GRIDCROSS_STUDY_POINTS_H
#define GRIDCROSS_STUDY_POINTS_H

#include "setting.h"

/* Reads every list that a case of the study names by body.file, once, and gives it to the case. runfile: names that are not absolute
 * are relative to its directory. hdf5: as in gx_runfile_read. Lists that cannot be opened are errors of the settings; what is wrong in
 * one goes to `out` at once. Returns 0, or -1 after either. */
int gx_points_read(struct gx_settings *settings, const char *runfile, const struct gx_array_reader *hdf5, FILE *out);
void gx_points_free(struct gx_points *points);

#endif
