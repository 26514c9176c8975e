/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands, one a file, and what they share. */
#ifndef GRIDCROSS_CLI_COMMAND_H
#define GRIDCROSS_CLI_COMMAND_H

#include <gridcross/plot.h>
#include <gridcross/study.h>

#include "options.h"
#include "terminal.h"

/* All of them, NULL-ended. */
extern const struct gx_command *const gx_command_family[];
extern const struct gx_command gx_command_run, gx_command_check, gx_command_init, gx_command_compare, gx_command_plot,
    gx_command_advise, gx_command_list, gx_command_paper, gx_command_spectrum, gx_command_balance, gx_command_merge,
    gx_command_report;

#define GX_COMMAND_SET                                                                                                           \
  {                                                                                                                              \
    0, "set", "PATH=VALUE", "replace a parameter of the run file; as often as wanted"                                            \
  }

#define GX_COMMAND_WHERE                                                                                                         \
  {                                                                                                                              \
    0, "where", "PATH=VALUE", "only cases with this value; as often as wanted"                                                   \
  }

/* Reads the run file that the first operand names with its --set. NULL after messages. */
struct gx_study *gx_command_read(const struct gx_options *options);

/* The studies that the first operands name. */
struct gx_command_studies {
  size_t count;
  struct gx_table **table; /* [count], owned */
  char **name;             /* [count], owned: as the axis `study` shows them */
};

/* Reads them and keeps the cases that --where names. Returns 0, or an exit code after a message; to be freed in either case. */
int gx_command_studies_read(struct gx_command_studies *studies, const struct gx_options *options, size_t count);
void gx_command_studies_free(struct gx_command_studies *studies);

/* The plot command with values that a paper prints; the exit code. */
int gx_command_plot_figure(const struct gx_options *options, size_t points, const struct gx_plot_point *point);

/* What an option asks for that was given, from 1 to 4096, or 0 after a message. */
size_t gx_command_count(const struct gx_options *options, const char *name);
/* Threads that --jobs asks for, or 0 after a message. */
size_t gx_command_jobs(const struct gx_options *options);

/* A table for people, as wide as the terminal. Returns 0, or -1 when memory runs out. */
int gx_command_print(const struct gx_table *table);

/* Exit code after saying that memory ran out. */
int gx_command_no_memory(void);

#endif
