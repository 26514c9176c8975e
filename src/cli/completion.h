/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion of the command line by bash, from the tables that the program is made of. */
#ifndef GRIDCROSS_CLI_COMPLETION_H
#define GRIDCROSS_CLI_COMPLETION_H

#include <stdio.h>

/* Writes a script for bash to read. Returns 0, or -1 when memory runs out. */
int gx_completion_print(FILE *out);

#endif
