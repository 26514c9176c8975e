/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --where PATH=VALUE: the cases of studies that a command looks at. */
#ifndef GRIDCROSS_CLI_WHERE_H
#define GRIDCROSS_CLI_WHERE_H

#include "command.h"

/* Drops the cases that some --where does not match. Returns 0, or an exit code after a message: no such column or case. */
int gx_where_keep(struct gx_command_studies *studies, const struct gx_options *options);

#endif
