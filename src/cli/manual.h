/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The manual, from the tables of commands, parameters and columns, in the language of scdoc. */
#ifndef GRIDCROSS_CLI_MANUAL_H
#define GRIDCROSS_CLI_MANUAL_H

#include <stdio.h>

/* gridcross(1). Returns 0, or -1 when memory runs out. */
int gx_manual_program(FILE *out);
/* gridcross(5): run files, and the columns of the table. */
int gx_manual_reference(FILE *out);

#endif
