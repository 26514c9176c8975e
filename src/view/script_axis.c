/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scales and tics that people can read: few values of a parameter by name, powers of ten elsewhere. */
#include "script_axis.h"

#include <math.h>
#include <stdlib.h>

#include "gnuplot.h"

enum { LISTED = 8 }; /* at most so many values of x each have a tic */

static int by_size(const void *left, const void *right)
{
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* The values of x, when there are few. Returns how many, 0: many. */
static size_t few_values(const struct gx_figure *figure, double value[LISTED])
{
  size_t count = 0;
  for (size_t r = 0; r < figure->data->rows; r++) {
    double x = gx_figure_number(figure, r, GX_FIGURE_X);
    size_t i = 0;
    while (i < count && value[i] != x) i++;
    if (i < count) continue;
    if (count == LISTED) return 0;
    value[count++] = x;
  }
  qsort(value, count, sizeof *value, by_size);
  return count;
}

static void put_range(const char *name, const struct gx_figure_axis *axis, FILE *out)
{
  double least = axis->least, most = axis->most;
  if (axis->log) {
    double room = pow(most / least, 0.05);
    least /= room;
    most *= room;
  } else if (least == most) { /* gnuplot would warn */
    double room = least != 0 ? fabs(least) / 2 : 1;
    least -= room;
    most += room;
  } else if (!axis->exact) {
    return;
  }
  fprintf(out, "set %srange [%.6g:%.6g]\n", name, least, most);
}

static void put_axis(const char *name, const struct gx_figure_axis *axis, size_t values, const double *value, FILE *out)
{
  char text[GX_NUMBER_LENGTH];
  const char *gap = "";
  put_range(name, axis, out);
  if (!axis->log) {
    bool small = fmax(fabs(axis->least), fabs(axis->most)) < 1e-3; /* whose zeros would push the label off the figure */
    if (small) fprintf(out, "set format %s '%%.1te%%T'\n", name);
    return;
  }
  fprintf(out, "set logscale %s\n", name);
  if (!values && axis->most / axis->least > 100) {
    fprintf(out, "set format %s '10^{%%L}'\n", name);
    return;
  }
  fprintf(out, "set %stics (", name);
  for (size_t i = 0; i < values; i++, gap = ", ") {
    gx_value_real(value[i], text);
    fprintf(out, "%s'%s' %s", gap, text, text);
  }
  for (int k = (int)floor(log10(axis->least)); !values && k <= (int)ceil(log10(axis->most)); k++)
    for (int digit = 1; digit <= 5; digit += digit == 1 ? 1 : 3, gap = ", ") {
      if (k >= -3 && k < 5) /* 0.05 and 200 rather than 5e-2 and 2e2 */
        fprintf(out, "%s'%g' %de%d", gap, digit * pow(10, k), digit, k);
      else
        fprintf(out, "%s'%de%d' %de%d", gap, digit, k, digit, k);
    }
  fputs(")\n", out);
}

void gx_script_axis_label(const char *axis, const struct gx_column *column, FILE *out)
{
  fprintf(out, "set %slabel \"", axis);
  gx_gnuplot_text(column->name, out);
  if (*column->unit) {
    fputs(" [", out);
    gx_gnuplot_text(column->unit, out);
    fputs("]", out);
  }
  fputs("\" noenhanced\n", out);
}

void gx_script_axis_scales(const struct gx_figure *figure, FILE *out)
{
  double value[LISTED];
  put_axis("x", &figure->x, figure->few_x && figure->x.log ? few_values(figure, value) : 0, value, out);
  put_axis("y", &figure->y, 0, value, out);
}

/* Values of both signs are coloured from zero on, by how far they lie to either side; others by viridis, which grows brighter
 * throughout. */
void gx_script_axis_colours(const struct gx_figure *figure, FILE *out)
{
  static const char both[] = "0 '#0072B2', 0.5 '#dddddd', 1 '#D55E00'";
  static const char one[] = "0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', "
                            "7 '#addc30', 8 '#fde725'";
  struct gx_figure_axis axis = figure->value;
  bool signs = axis.least < 0 && axis.most > 0;
  if (signs) {
    axis.most = fmax(-axis.least, axis.most);
    axis.least = -axis.most;
  } else if (axis.least == axis.most) {
    axis.most += axis.most != 0 ? fabs(axis.most) : 1;
  }
  fprintf(out, "set palette defined (%s)\nset cbrange [%.6g:%.6g]\n", signs ? both : one, axis.least, axis.most);
  if (fmax(fabs(axis.least), fabs(axis.most)) < 1e-3) fputs("set format cb '%.1te%T'\n", out);
  gx_script_axis_label("cb", &figure->data->column[GX_FIGURE_VALUE], out);
}
