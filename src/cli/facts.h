/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A parameter in a line: what it may be, its unit and its default. */
#ifndef GRIDCROSS_CLI_FACTS_H
#define GRIDCROSS_CLI_FACTS_H

#include <gridcross/parameter.h>

enum { GX_FACTS_LENGTH = 1024 };

/* "(integer >= 1, <= 4096; default 32)", "(flip, pic, apic; default flip)". Returns facts. */
const char *gx_facts_text(const struct gx_parameter *parameter, char facts[GX_FACTS_LENGTH]);

#endif
