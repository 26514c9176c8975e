/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Starter run files: every parameter of a problem at its default, each with its meaning. */
#ifndef GRIDCROSS_STARTER_H
#define GRIDCROSS_STARTER_H

#include <stdio.h>

#include <gridcross/problem.h>

/* Writes a commented run file for the problem. Returns 0, or -1 when out cannot be written. */
int gx_starter_write(FILE *out, const struct gx_problem *problem);

#endif
