/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What `gridcross run` and `gridcross merge` print of a study, from what is stored. */
#ifndef GRIDCROSS_CLI_SUMMARY_H
#define GRIDCROSS_CLI_SUMMARY_H

#include <gridcross/study.h>

#include "options.h"

/* The table on standard output, as --csv, --json and --no-timing ask for, or what varies and matters most; warnings, unless --quiet, and
 * internal failures on standard error. Returns the exit code. */
int gx_summary_print(const struct gx_options *options, const struct gx_study *study, const char *directory);

#endif
