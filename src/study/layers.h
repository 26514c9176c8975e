/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layers: the keys of a run file, of its cases and of --set, sorted into settings. */
#ifndef GRIDCROSS_STUDY_LAYERS_H
#define GRIDCROSS_STUDY_LAYERS_H

#include "setting.h"

/* Reads the whole file into settings->base, ->cases and ->zip. */
void gx_layers_read(struct gx_settings *settings, const struct gx_yaml *root);

/* Applies the set-th (from 1) --set string to the base. */
void gx_layers_set(struct gx_settings *settings, int set, const char *text);

#endif
