/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error-cost front as a figure: every case a point, and below them the steps of the cheapest. */
#include "plot_front.h"

#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "figure.h"
#include "front.h"
#include "join.h"
#include "sheet.h"

struct sketch {
  const struct gx_plot *plot;
  struct gx_table *table; /* the studies joined; owned */
  struct gx_front front;
  size_t bys, *by;       /* columns that colours tell apart; owned */
  size_t groups, *group; /* [table->rows] which colour; owned */
  struct gx_figure figure;
};

static enum gx_plot_status no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return GX_PLOT_FAILED;
}

static void sketch_free(struct sketch *sketch)
{
  gx_figure_free(&sketch->figure);
  gx_front_free(&sketch->front);
  gx_table_free(sketch->table);
  free(sketch->by);
  free(sketch->group);
}

static enum gx_plot_status choose_by(struct sketch *sketch, FILE *errors)
{
  const struct gx_plot *plot = sketch->plot;
  if (!(sketch->by = calloc(sketch->table->columns + plot->bys + 1, sizeof *sketch->by))) return no_memory(errors);
  for (size_t b = 0; b < plot->bys; b++) {
    long c = gx_join_find(sketch->table, plot->by[b], true, errors);
    if (c < 0) return GX_PLOT_REFUSED;
    sketch->by[sketch->bys++] = (size_t)c;
  }
  if (plot->bys) return GX_PLOT_DONE;
  long space = gx_table_find(sketch->table, "method.space"), axes = gx_axes_find(sketch->table, 0, sketch->by);
  if (axes < 0) return no_memory(errors);
  if (space >= 0 && gx_axes_vary(sketch->table, (size_t)space)) sketch->by[0] = (size_t)space;
  sketch->bys = axes > 0;
  return GX_PLOT_DONE;
}

static int choose_groups(struct sketch *sketch)
{
  size_t rows = sketch->table->rows, *rank = calloc(rows + 1, sizeof *rank);
  long groups = rank && (sketch->group = calloc(rows + 1, sizeof *sketch->group)) ? 1 : -1;
  for (size_t b = 0; b < sketch->bys && groups >= 0; b++)
    groups = gx_axes_rank(sketch->table, sketch->by[b], rank) < 0 ? -1 : gx_axes_refine(rows, sketch->group, rank);
  sketch->groups = groups < 0 ? 0 : (size_t)groups;
  free(rank);
  return groups < 0 ? -1 : 0;
}

static char *group_label(const struct sketch *sketch, size_t row)
{
  char text[GX_SHEET_LABEL], *label = calloc(sketch->bys + 1, GX_SHEET_LABEL + 2);
  for (size_t b = 0; b < sketch->bys && label; b++) {
    gx_sheet_label(sketch->table, sketch->by[b], row, text);
    if (*text && *label) strcat(label, ", ");
    strcat(label, text);
  }
  if (label && !*label && sketch->bys) strcpy(label, "-");
  return label;
}

static int add_case(struct sketch *sketch, size_t row)
{
  return gx_figure_add(&sketch->figure, gx_table_get(sketch->table, row, sketch->front.cost),
                       gx_table_get(sketch->table, row, sketch->front.error));
}

static int add_group(struct sketch *sketch, size_t group)
{
  const struct gx_front *front = &sketch->front;
  struct gx_figure_line *line = NULL;
  int failed = 0;
  for (size_t i = 0; i < front->cases && !failed; i++) {
    if (sketch->group[front->row[i]] != group) continue;
    if (!line) {
      if (!(line = gx_figure_begin(&sketch->figure, group_label(sketch, front->row[i])))) return -1;
      line->style = GX_FIGURE_POINTS;
      line->colour = (int)(group % (GX_FIGURE_COLOURS - 1)); /* the last, black, is the front's */
      line->marker = (int)group;
    }
    failed = add_case(sketch, front->row[i]);
  }
  return failed;
}

static int fill(struct sketch *sketch)
{
  const struct gx_front *front = &sketch->front;
  const struct gx_column *x = &sketch->table->column[front->cost], *y = &sketch->table->column[front->error];
  int failed = gx_figure_start(&sketch->figure, sketch->groups + 1, front->cases + front->members, x, y, NULL);
  for (size_t g = 0; g < sketch->groups && !failed; g++) failed = add_group(sketch, g);
  struct gx_figure_line *line = failed ? NULL : gx_figure_begin(&sketch->figure, strdup("front"));
  if (!line) return -1;
  line->style = GX_FIGURE_STEPS;
  line->colour = GX_FIGURE_COLOURS - 1;
  for (size_t i = 0; i < front->members && !failed; i++) failed = add_case(sketch, front->member[i]);
  return failed;
}

static enum gx_plot_status draw(struct sketch *sketch, FILE *errors)
{
  gx_front_tell(&sketch->front, errors);
  if (!sketch->front.cases) {
    fputs("gridcross: there is nothing to draw\n", errors);
    return GX_PLOT_REFUSED;
  }
  if (choose_groups(sketch) || fill(sketch)) return no_memory(errors);
  struct gx_figure *figure = &sketch->figure;
  figure->title = sketch->plot->title;
  figure->x = gx_figure_range(figure, GX_FIGURE_X, 2, 0);
  figure->y = gx_figure_range(figure, GX_FIGURE_Y, 2, 0);
  return gx_figure_draw(figure, sketch->plot->output, errors);
}

enum gx_plot_status gx_plot_front_draw(const struct gx_plot *plot, FILE *errors)
{
  struct sketch sketch = {.plot = plot};
  const char *error = plot->y ? plot->y : "result.displacement.max.rms", *cost = plot->x ? plot->x : "result.seconds";
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (!gx_join_check(plot->studies, plot->name, errors)) {
    sketch.table = gx_join_tables(plot->studies, plot->table, plot->name);
    status = sketch.table ? choose_by(&sketch, errors) : no_memory(errors);
  }
  if (status == GX_PLOT_DONE)
    status = gx_front_find(&sketch.front, sketch.table, error, cost, errors) ? GX_PLOT_REFUSED : draw(&sketch, errors);
  sketch_free(&sketch);
  return status;
}
