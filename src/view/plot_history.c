/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A history against time, one line a case. */
#include <math.h>

#include <gridcross/store.h>

#include "curves.h"

static struct gx_curve read_history(const struct gx_plot *plot, size_t study, size_t row, const char *name, FILE *errors)
{
  const struct gx_table *table = plot->table[study];
  const char *id = gx_table_get(table, row, (size_t)gx_table_find(table, "case")).text;
  return (struct gx_curve){gx_store_read_history(plot->directory[study], id, name, errors), NAN};
}

static enum gx_plot_status draw(const struct gx_plot *plot, FILE *errors)
{
  static const struct gx_curves curves = {.name = "displacement.rms", .in_time = true, .read = read_history};
  return gx_curves_plot(plot, &curves, errors);
}

const struct gx_plot_kind gx_plot_history = {
    .name = "history",
    .help = "errors, energies and other measures in time, one line a case; of studies run with output.histories",
    .y = "displacement.rms, energy.kinetic, energy.elastic, crossings, ...",
    .across = "time",
    .example = "gridcross plot FILE.study history --y energy.kinetic -o energy.svg",
    .draw = draw,
};
