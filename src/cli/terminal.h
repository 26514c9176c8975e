/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a stream of the program is written to. */
#ifndef GRIDCROSS_CLI_TERMINAL_H
#define GRIDCROSS_CLI_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/page.h>

/* Whether it is a terminal that can renew a line. */
bool gx_terminal_is(FILE *stream);
/* Its width, and whether it shows attributes: a terminal, unless NO_COLOR (no-color.org) is set. Not a terminal: as wide as it gets,
 * and plain. */
struct gx_page gx_terminal_page(FILE *stream);

#endif
