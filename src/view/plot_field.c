/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quantity of particles at one time: in 1-D along x with the exact solution, else as the colour of particles, one panel a case. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "panels.h"
#include "snap.h"

enum { MOST_LINES = 60 };

struct scene {
  struct gx_sketch *sketch;
  size_t count;
  const struct gx_panels_case *cases; /* [count], borrowed */
  struct gx_snap *snap;               /* [count], owned */
  struct gx_snap_field field;
  const char *name; /* of the field */
};

/* Whether all are drawn at one time. */
static bool is_one_time(const struct scene *scene)
{
  for (size_t i = 1; i < scene->count; i++)
    if (fabs(scene->snap[i].time - scene->snap[0].time) > 1e-6 * fabs(scene->snap[0].time)) return false;
  return true;
}

/* Label of a case, with its time where that is not the others'; owned by the caller. */
static char *title_of(const struct scene *scene, size_t index)
{
  char *title = gx_panels_title(scene->sketch, &scene->cases[index]), *timed = NULL;
  if (!title || is_one_time(scene)) return title;
  size_t room = strlen(title) + 32;
  if ((timed = malloc(room))) snprintf(timed, room, "%s%s%.4g s", title, *title ? " at " : "at ", scene->snap[index].time);
  free(title);
  return timed;
}

static int by_place(const void *left, const void *right)
{
  double a = ((const double *)left)[0], b = ((const double *)right)[0];
  return (a > b) - (a < b);
}

/* The exact solution along x: [n] pairs of place and value, ascending; owned by the caller. */
static double (*sort_exact(const struct gx_snap *snap))[2]
{
  double(*at)[2] = malloc((snap->n + 1) * sizeof *at);
  for (size_t p = 0; p < snap->n && at; p++) {
    at[p][0] = snap->exact_x[p];
    at[p][1] = snap->exact[p];
  }
  if (at) qsort(at, snap->n, sizeof *at, by_place);
  return at;
}

/* Whether a curve also goes through the exact values of another case. */
static bool is_curve_of(const struct gx_snap *snap, size_t n, double (*const curve)[2])
{
  double least = INFINITY, most = -INFINITY;
  for (size_t i = 0; i < n; i++) {
    least = fmin(least, curve[i][1]);
    most = fmax(most, curve[i][1]);
  }
  for (size_t p = 0; p < snap->n; p++) {
    size_t low = 0, high = n - 1;
    if (n < 2 || snap->exact_x[p] < curve[low][0] || snap->exact_x[p] > curve[high][0]) continue;
    while (high - low > 1) {
      size_t middle = (low + high) / 2;
      if (curve[middle][0] <= snap->exact_x[p])
        low = middle;
      else
        high = middle;
    }
    double width = curve[high][0] - curve[low][0], t = width > 0 ? (snap->exact_x[p] - curve[low][0]) / width : 0;
    double value = curve[low][1] + t * (curve[high][1] - curve[low][1]);
    if (fabs(value - snap->exact[p]) > 0.02 * (most - least)) return false;
  }
  return true;
}

/* The exact solution of the case with most particles, and of those that have another. */
static int add_exact(struct scene *scene)
{
  struct gx_figure *figure = &scene->sketch->figure;
  bool *drawn = calloc(scene->count + 1, sizeof *drawn);
  int failed = !drawn;
  while (!failed) {
    const struct gx_snap *finest = NULL;
    for (size_t i = 0; i < scene->count; i++)
      if (!drawn[i] && scene->snap[i].exact && (!finest || scene->snap[i].n > finest->n)) finest = &scene->snap[i];
    if (!finest) break;
    double(*at)[2] = sort_exact(finest);
    struct gx_figure_line *line = at ? gx_figure_begin(figure, strdup("exact")) : NULL;
    failed = !line;
    if (line) line->style = GX_FIGURE_EXACT;
    for (size_t p = 0; p < finest->n && !failed; p++)
      failed = gx_figure_add(figure, gx_value_from(at[p][0]), gx_value_from(at[p][1]));
    for (size_t i = 0; i < scene->count && !failed; i++)
      drawn[i] = drawn[i] || !scene->snap[i].exact || &scene->snap[i] == finest || is_curve_of(&scene->snap[i], finest->n, at);
    free(at);
  }
  free(drawn);
  return failed;
}

static struct gx_column column_of(const char *name, const char *unit)
{
  return (struct gx_column){.name = strdup(name), .unit = strdup(unit), .type = GX_REAL};
}

static void free_column(struct gx_column *column)
{
  free(column->name);
  free(column->unit);
}

static int start(struct scene *scene, size_t lines, size_t points, bool coloured)
{
  const char *unit = gx_measure_quantity[scene->field.quantity].unit;
  struct gx_column x = column_of("x", "m"), y = column_of("y", "m"), value = column_of(scene->name, unit);
  int failed = !x.name || !x.unit || !y.name || !y.unit || !value.name || !value.unit ||
               gx_figure_start(&scene->sketch->figure, lines, points, &x, coloured ? &y : &value, coloured ? &value : NULL);
  free_column(&x);
  free_column(&y);
  free_column(&value);
  return failed;
}

static int fill_curves(struct scene *scene)
{
  struct gx_figure *figure = &scene->sketch->figure;
  size_t points = 0;
  for (size_t i = 0; i < scene->count; i++) points += 2 * scene->snap[i].n;
  if (start(scene, 2 * scene->count, points, false) || gx_sketch_style(scene->sketch) || add_exact(scene)) return -1;
  for (size_t i = 0; i < scene->count; i++) {
    const struct gx_panels_case *one = &scene->cases[i];
    struct gx_figure_line *line = gx_sketch_begin(scene->sketch, one->line_column, scene->sketch->pivot->rows > 1, one->line_row);
    if (!line) return -1;
    line->style = GX_FIGURE_POINTS;
    free(line->label);
    line->label = title_of(scene, i);
    if (line->label && !*line->label) {
      free(line->label);
      line->label = strdup("particles");
    }
    if (!line->label) return -1;
    for (size_t p = 0; p < scene->snap[i].n; p++)
      if (gx_figure_add(figure, gx_value_from(scene->snap[i].x[0][p]), gx_value_from(scene->snap[i].value[p]))) return -1;
  }
  figure->x = gx_figure_range(figure, GX_FIGURE_X, INFINITY, 0);
  figure->y = gx_figure_range(figure, GX_FIGURE_Y, INFINITY, 0);
  return 0;
}

/* The axis around whole particles. */
static struct gx_figure_axis around(struct gx_figure_axis axis, double spacing)
{
  double room = fmax(spacing, 0.02 * (axis.most - axis.least));
  return (struct gx_figure_axis){.exact = true, .least = axis.least - room, .most = axis.most + room};
}

static int fill_panels(struct scene *scene)
{
  struct gx_figure *figure = &scene->sketch->figure;
  size_t points = 0;
  for (size_t i = 0; i < scene->count; i++) points += scene->snap[i].n;
  if (!(figure->panel = calloc(scene->count, sizeof *figure->panel))) return -1;
  figure->panels = scene->count;
  for (size_t i = 0; i < scene->count; i++)
    if (!(figure->panel[i] = title_of(scene, i))) return -1;
  if (start(scene, scene->count, points, true)) return -1;
  for (size_t i = 0; i < scene->count; i++) {
    const struct gx_snap *snap = &scene->snap[i];
    struct gx_figure_line *line = gx_figure_begin(figure, strdup(figure->panel[i]));
    if (!line) return -1;
    line->style = GX_FIGURE_COLOURED;
    line->panel = i;
    for (size_t p = 0; p < snap->n; p++)
      if (gx_figure_add(figure, gx_value_from(snap->x[0][p]), gx_value_from(snap->x[1][p])) ||
          gx_figure_colour(figure, snap->value[p]))
        return -1;
    if (i == 0 || snap->spacing < figure->spacing) figure->spacing = snap->spacing;
  }
  figure->equal = true;
  figure->x = around(gx_figure_range(figure, GX_FIGURE_X, INFINITY, 0), figure->spacing);
  figure->y = around(gx_figure_range(figure, GX_FIGURE_Y, INFINITY, 0), figure->spacing);
  figure->value = gx_figure_range(figure, GX_FIGURE_VALUE, INFINITY, 0);
  return 0;
}

/* At which time, where that is one, and in 3-D where. */
static char *describe(const struct scene *scene)
{
  const struct gx_snap *snap = scene->snap;
  char note[160], when[40] = "", slice[80] = "";
  if (is_one_time(scene)) snprintf(when, sizeof when, "at %.6g s", snap->time);
  if (snap->dim == 3)
    snprintf(slice, sizeof slice, "%sthe layer of particles that starts at z = %.4g m", *when ? "; " : "", snap->slice);
  snprintf(note, sizeof note, "%s%s", when, slice);
  return strdup(note);
}

static enum gx_plot_status draw_scene(struct scene *scene, double time, FILE *errors)
{
  for (size_t i = 0; i < scene->count; i++) {
    if (gx_snap_read(&scene->snap[i], scene->cases[i].directory, scene->cases[i].id, &scene->field, time, errors))
      return GX_PLOT_REFUSED;
    if (scene->snap[i].dim == scene->snap[0].dim) continue;
    fputs("gridcross: cases have different dimensions: choose by --where problem.dimension=N\n", errors);
    return GX_PLOT_REFUSED;
  }
  bool plane = scene->snap[0].dim > 1;
  if (plane && scene->count > GX_PANELS_MOST) {
    fprintf(errors, "gridcross: %zu cases are more panels than %d: choose by --where PATH=VALUE\n", scene->count, GX_PANELS_MOST);
    return GX_PLOT_REFUSED;
  }
  if ((plane ? fill_panels : fill_curves)(scene) || !(scene->sketch->figure.note = describe(scene)))
    return gx_sketch_no_memory(errors);
  return gx_sketch_draw(scene->sketch, "case", errors);
}

static enum gx_plot_status draw(const struct gx_plot *plot, FILE *errors)
{
  struct scene scene = {.name = plot->y ? plot->y : "displacement"};
  if (gx_snap_find(scene.name, &scene.field)) {
    fprintf(errors, "gridcross: no field '%s'; there are %s\n", scene.name, gx_snap_fields);
    return GX_PLOT_REFUSED;
  }
  struct gx_sketch sketch = gx_sketch_create_cases(plot, errors);
  struct gx_panels_case *cases = NULL;
  long count = sketch.pivot ? gx_panels_choose(&sketch, MOST_LINES, &cases, errors) : -1;
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (count > 0) {
    scene.sketch = &sketch;
    scene.count = (size_t)count;
    scene.cases = cases;
    scene.snap = calloc(scene.count, sizeof *scene.snap);
    status = scene.snap ? draw_scene(&scene, plot->time, errors) : gx_sketch_no_memory(errors);
    for (size_t i = 0; scene.snap && i < scene.count; i++) gx_snap_free(&scene.snap[i]);
    free(scene.snap);
  }
  free(cases);
  gx_sketch_free(&sketch);
  return status;
}

const struct gx_plot_kind gx_plot_field = {
    .name = "field",
    .help = "a quantity of particles at --time: in 1-D along x beside the exact solution, in 2-D in colour, in 3-D of the layer "
            "in the "
            "middle; of studies run with output.snapshots",
    .y = gx_snap_fields,
    .across = "position",
    .at_time = true,
    .example = "gridcross plot FILE.study field --y stress --time 0.5 -o stress.png",
    .draw = draw,
};
