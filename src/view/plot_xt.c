/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles in time over the edges of cells, one panel a case. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "panels.h"
#include "tracks.h"

enum { PATHS, EDGES, CROSSINGS, LAYERS };

static int add_point(struct gx_figure *figure, double x, double time)
{
  return gx_figure_add(figure, gx_value_from(x), gx_value_from(time));
}

/* The row that interrupts a line, where it ended. */
static int add_break(struct gx_figure *figure, double x)
{
  return gx_figure_add(figure, gx_value_from(x), (struct gx_value){.type = GX_NULL});
}

static int name_point(struct gx_figure *figure, const char *panel, const char *what, size_t number)
{
  char label[320];
  snprintf(label, sizeof label, "%s%s%s %zu", panel, *panel ? ", " : "", what, number);
  return gx_figure_name(figure, label);
}

/* Lines of one layer, as one of the figure's with interruptions. x: [count][times] */
static int add_lines(struct gx_figure *figure, size_t panel, const char *what, size_t count, const size_t *index, const double *x,
                     size_t times, const double *time)
{
  int failed = 0;
  for (size_t k = 0; k < count && !failed; k++) {
    for (size_t i = 0; i < times && !failed; i++)
      failed = add_point(figure, x[k * times + i], time[i]) || name_point(figure, figure->panel[panel], what, index[k] + 1);
    if (!failed)
      failed = add_break(figure, x[k * times + times - 1]) || name_point(figure, figure->panel[panel], what, index[k] + 1);
  }
  return failed;
}

static struct gx_figure_line *begin(struct gx_figure *figure, size_t panel, const char *label, enum gx_figure_style style)
{
  struct gx_figure_line *line = gx_figure_begin(figure, strdup(label));
  if (!line) return NULL;
  line->style = style;
  line->panel = panel;
  return line;
}

static int add_case(struct gx_figure *figure, size_t panel, const struct gx_tracks *tracks)
{
  int failed =
      !begin(figure, panel, "cell edges", GX_FIGURE_GUIDES) ||
      add_lines(figure, panel, "cell edge", tracks->edges, tracks->edge_index, tracks->edge, tracks->times, tracks->time);
  if (failed) return -1;
  gx_figure_end(figure);
  failed = !begin(figure, panel, "particles", GX_FIGURE_CURVES) ||
           add_lines(figure, panel, "particle", tracks->paths, tracks->index, tracks->path, tracks->times, tracks->time);
  if (failed) return -1;
  gx_figure_end(figure);
  struct gx_figure_line *line = begin(figure, panel, "crossings", GX_FIGURE_POINTS);
  if (!line) return -1;
  line->colour = 1;
  for (size_t i = 0; i < tracks->crossings && !failed; i++)
    failed = add_point(figure, tracks->crossing[i].x, tracks->crossing[i].time) ||
             name_point(figure, figure->panel[panel], "crossing of particle", tracks->index[tracks->crossing[i].path] + 1);
  gx_figure_end(figure);
  return failed;
}

static size_t count_points(const struct gx_tracks *tracks)
{
  return (tracks->paths + tracks->edges) * (tracks->times + 1) + tracks->crossings;
}

/* That not all is shown. */
static char *describe(size_t count, const struct gx_tracks *tracks)
{
  for (size_t i = 0; i < count; i++)
    if (tracks[i].of > tracks[i].paths || tracks[i].edges_of > tracks[i].edges) {
      char note[96];
      snprintf(note, sizeof note, "of more than %d particles or edges, every second, third, ... is shown", GX_TRACKS_MOST);
      return strdup(note);
    }
  return strdup("");
}

static int fill(struct gx_sketch *sketch, size_t count, const struct gx_panels_case *cases, const struct gx_tracks *tracks)
{
  char x_name[] = "x", x_unit[] = "m", y_name[] = "time", y_unit[] = "s";
  const struct gx_column x = {.name = x_name, .unit = x_unit, .type = GX_REAL},
                         y = {.name = y_name, .unit = y_unit, .type = GX_REAL};
  struct gx_figure *figure = &sketch->figure;
  size_t points = 0;
  for (size_t i = 0; i < count; i++) points += count_points(&tracks[i]);
  if (!(figure->panel = calloc(count, sizeof *figure->panel))) return -1;
  figure->panels = count;
  for (size_t i = 0; i < count; i++)
    if (!(figure->panel[i] = gx_panels_title(sketch, &cases[i]))) return -1;
  if (gx_figure_start(figure, LAYERS * count, points, &x, &y, NULL)) return -1;
  for (size_t i = 0; i < count; i++)
    if (add_case(figure, i, &tracks[i])) return -1;
  figure->x = gx_figure_range(figure, GX_FIGURE_X, INFINITY, 0);
  figure->y = gx_figure_range(figure, GX_FIGURE_Y, INFINITY, 0);
  figure->x.exact = figure->y.exact = true;
  figure->note = describe(count, tracks);
  return figure->note ? 0 : -1;
}

static enum gx_plot_status draw_cases(struct gx_sketch *sketch, size_t count, const struct gx_panels_case *cases, FILE *errors)
{
  struct gx_tracks *tracks = calloc(count, sizeof *tracks);
  enum gx_plot_status status = tracks ? GX_PLOT_DONE : gx_sketch_no_memory(errors);
  for (size_t i = 0; i < count && !status; i++)
    if (gx_tracks_read(&tracks[i], cases[i].directory, cases[i].id, errors)) status = GX_PLOT_REFUSED;
  if (!status && fill(sketch, count, cases, tracks)) status = gx_sketch_no_memory(errors);
  if (!status) status = gx_sketch_draw(sketch, "case", errors);
  for (size_t i = 0; tracks && i < count; i++) gx_tracks_free(&tracks[i]);
  free(tracks);
  return status;
}

static enum gx_plot_status draw(const struct gx_plot *plot, FILE *errors)
{
  struct gx_sketch sketch = gx_sketch_create_cases(plot, errors);
  struct gx_panels_case *cases = NULL;
  long count = sketch.pivot ? gx_panels_choose(&sketch, GX_PANELS_MOST, &cases, errors) : -1;
  enum gx_plot_status status = count < 0 ? GX_PLOT_REFUSED : draw_cases(&sketch, (size_t)count, cases, errors);
  free(cases);
  gx_sketch_free(&sketch);
  return status;
}

const struct gx_plot_kind gx_plot_xt = {
    .name = "xt",
    .help =
        "paths of particles over the edges of cells, which move with a moving mesh, and where they cross; one panel a case; of "
        "studies run with output.snapshots",
    .across = "x, with time upwards",
    .example = "gridcross plot FILE.study xt --where mesh.cells=16 -o xt.svg",
    .draw = draw,
};
