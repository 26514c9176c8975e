/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What figures of studies share: cases by their axes, labels and styles of lines, and cases left out. */
#ifndef GRIDCROSS_VIEW_SKETCH_H
#define GRIDCROSS_VIEW_SKETCH_H

#include <gridcross/plot.h>

#include "figure.h"
#include "left_out.h"
#include "pivot.h"

struct gx_sketch {
  const struct gx_plot *plot; /* borrowed */
  struct gx_pivot *pivot;     /* NULL: refused, after a message; owned */
  struct gx_figure figure;
  struct gx_left_out left_out;
  size_t *colour, *style; /* [pivot->columns], owned */
  size_t styles;
};

/* rows: the axis of the pivot's rows, NULL: as gx_comparison chooses. value: [values] columns to be shown. */
struct gx_sketch gx_sketch_create(const struct gx_plot *plot, const char *rows, size_t values, const char *const *value,
                                  FILE *errors);
/* One line a case: rows are studies, where they do not tell lines apart by --by. */
struct gx_sketch gx_sketch_create_cases(const struct gx_plot *plot, FILE *errors);
void gx_sketch_free(struct gx_sketch *sketch);
/* Colours tell some axes apart, markers and dashes the others. Returns 0, or -1 when memory runs out. */
int gx_sketch_style(struct gx_sketch *sketch);
/* Labels of the pivot's column, and of the row where that tells cases apart; owned by the caller, NULL when memory runs out. */
char *gx_sketch_label(const struct gx_sketch *sketch, size_t column, bool row_too, size_t row);
/* Begins a labelled and styled line. Returns it, or NULL when memory runs out. */
struct gx_figure_line *gx_sketch_begin(struct gx_sketch *sketch, size_t column, bool row_too, size_t row);
/* The study that a row of the joined table came from; row becomes that of its own table. */
size_t gx_sketch_study(const struct gx_plot *plot, size_t *row);
/* Whether a column holds numbers; if not, says so. */
bool gx_sketch_numeric(const struct gx_table *table, size_t column, const char *option, FILE *errors);
/* Draws, with a note of what was left out. name: of what is drawn, a column of the table or of histories. */
enum gx_plot_status gx_sketch_draw(struct gx_sketch *sketch, const char *name, FILE *errors);
enum gx_plot_status gx_sketch_no_memory(FILE *errors);

#endif
