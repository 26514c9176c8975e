/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What commands share. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "command.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gridcross/store.h>

#include "../view/sheet.h"
#include "where.h"

const struct gx_command *const gx_command_family[] = {&gx_command_run,
                                                      &gx_command_check,
                                                      &gx_command_init,
                                                      &gx_command_compare,
                                                      &gx_command_plot,
                                                      &gx_command_report,
                                                      &gx_command_spectrum,
                                                      &gx_command_balance,
                                                      &gx_command_advise,
                                                      &gx_command_paper,
                                                      &gx_command_merge,
                                                      &gx_command_list,
                                                      NULL};

int gx_command_no_memory(void)
{
  fputs("gridcross: out of memory\n", stderr);
  return GX_EXIT_FAILED;
}

int gx_command_print(const struct gx_table *table)
{
  const struct gx_page page = gx_terminal_page(stdout);
  return gx_sheet_print(table, &page, stdout);
}

struct gx_study *gx_command_read(const struct gx_options *options)
{
  const char **set = calloc(options->count + 1, sizeof *set);
  if (!set) {
    gx_command_no_memory();
    return NULL;
  }
  size_t sets = gx_options_values(options, "set", set);
  struct gx_study *study = gx_runfile_read(options->operand[0], sets, set, &gx_hdf5_arrays, stderr);
  free(set);
  return study;
}

/* The directory as it was named, without .study and slashes at its end; owned by the caller. */
static char *study_name(const char *directory)
{
  size_t length = strlen(directory);
  while (length > 1 && directory[length - 1] == '/') length--;
  if (length > 6 && !strncmp(directory + length - 6, ".study", 6) && directory[length - 7] != '/') length -= 6;
  return strndup(directory, length);
}

int gx_command_studies_read(struct gx_command_studies *studies, const struct gx_options *options, size_t count)
{
  *studies = (struct gx_command_studies){.count = count};
  studies->table = calloc(count + 1, sizeof *studies->table);
  studies->name = calloc(count + 1, sizeof *studies->name);
  if (!studies->table || !studies->name) return gx_command_no_memory();
  for (size_t s = 0; s < count; s++) {
    if (!(studies->name[s] = study_name(options->operand[s]))) return gx_command_no_memory();
    if (!(studies->table[s] = gx_store_read(options->operand[s], stderr))) return GX_EXIT_USAGE;
  }
  return gx_where_keep(studies, options);
}

void gx_command_studies_free(struct gx_command_studies *studies)
{
  for (size_t s = 0; s < studies->count; s++) {
    if (studies->table) gx_table_free(studies->table[s]);
    if (studies->name) free(studies->name[s]);
  }
  free(studies->table);
  free(studies->name);
}

size_t gx_command_count(const struct gx_options *options, const char *name)
{
  const char *given = gx_options_value(options, name);
  char *end;
  long count = strtol(given, &end, 10);
  if (end != given && !*end && count >= 1 && count <= 4096) return (size_t)count;
  fprintf(stderr, "gridcross %s: --%s takes a number from 1 to 4096, not '%s'\n", options->command->name, name, given);
  return 0;
}

size_t gx_command_jobs(const struct gx_options *options)
{
  if (gx_options_value(options, "jobs")) return gx_command_count(options, "jobs");
  long processors = sysconf(_SC_NPROCESSORS_ONLN);
#ifdef CPU_COUNT
  cpu_set_t ours; /* what taskset, a batch system or mpirun leaves us */
  if (!sched_getaffinity(0, sizeof ours, &ours)) processors = CPU_COUNT(&ours);
#endif
  return processors > 0 ? (size_t)processors : 1;
}
