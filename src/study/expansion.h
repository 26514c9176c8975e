/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expansion: from settings to the cases of a study. */
#ifndef GRIDCROSS_STUDY_EXPANSION_H
#define GRIDCROSS_STUDY_EXPANSION_H

#include "setting.h"

/* Fills settings->study; errors go to settings->errors. */
void gx_expansion_run(struct gx_settings *settings);

#endif
