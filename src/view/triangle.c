/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where slope triangles fit. Places are shares of the figure's extent, (0, 0) its lower left corner. */
#include "triangle.h"

#include <math.h>

/* Space below the line, beside it for the slope, below it for the 1; orders this near are one. */
static const double gap = 0.04, beside = 0.09, under = 0.06, alike = 0.3, least_order = 0.5;

/* A pair of neighbouring points of a line. */
struct pair {
  const struct gx_figure_line *line;
  size_t row; /* of data: this one and the next */
  double order;
};

/* A triangle in places, its right angle last. */
struct shape {
  double corner[3][2];
};

static double share(const struct gx_figure_axis *axis, double value)
{
  return log(value / axis->least) / log(axis->most / axis->least);
}

static double value_at(const struct gx_figure_axis *axis, double place)
{
  return axis->least * pow(axis->most / axis->least, place);
}

static void place_of(const struct gx_figure *figure, size_t row, double place[2])
{
  place[0] = share(&figure->x, gx_figure_number(figure, row, GX_FIGURE_X));
  place[1] = share(&figure->y, gx_figure_number(figure, row, GX_FIGURE_Y));
}

static double slope_of(const struct gx_figure *figure, size_t row)
{
  double x[2], y[2];
  for (size_t i = 0; i < 2; i++) {
    x[i] = log(gx_figure_number(figure, row + i, GX_FIGURE_X));
    y[i] = log(gx_figure_number(figure, row + i, GX_FIGURE_Y));
  }
  return (y[1] - y[0]) / (x[1] - x[0]);
}

/* The triangle under the middle half of a pair. */
static struct shape put_under(const struct gx_figure *figure, const struct pair *pair)
{
  struct shape shape;
  double(*corner)[2] = shape.corner;
  double end[2][2];
  for (size_t i = 0; i < 2; i++) place_of(figure, pair->row + i, end[i]);
  for (size_t i = 0; i < 2; i++) {
    double t = i ? 0.75 : 0.25;
    corner[i][0] = end[0][0] + t * (end[1][0] - end[0][0]);
    corner[i][1] = end[0][1] + t * (end[1][1] - end[0][1]) - gap;
  }
  const double *high = corner[corner[0][1] < corner[1][1]], *low = corner[corner[0][1] >= corner[1][1]];
  corner[2][0] = high[0];
  corner[2][1] = low[1];
  return shape;
}

/* Whether a place lies within the triangle and the space of its labels. */
static bool covers(const struct shape *shape, const double place[2])
{
  const double(*corner)[2] = shape->corner;
  double left = fmin(corner[0][0], corner[1][0]), right = fmax(corner[0][0], corner[1][0]);
  double low = fmin(corner[0][1], corner[1][1]) - under;
  double t = (place[0] - corner[0][0]) / (corner[1][0] - corner[0][0]);
  double top = corner[0][1] + fmin(fmax(t, 0), 1) * (corner[1][1] - corner[0][1]) + gap / 3;
  bool on_left = corner[2][0] == left;
  return place[0] > left - (on_left ? beside : 0.01) && place[0] < right + (on_left ? 0.01 : beside) && place[1] > low &&
         place[1] < top;
}

/* Whether a line runs through it, between its points as well. */
static bool is_crossed(const struct gx_figure *figure, const struct shape *shape)
{
  enum { PARTS = 32 };
  for (size_t i = 0; i < figure->lines; i++)
    for (size_t k = 0; k + 1 < figure->line[i].count; k++) {
      double end[2][2], place[2];
      for (size_t e = 0; e < 2; e++) place_of(figure, figure->line[i].first + k + e, end[e]);
      for (int part = 0; part <= PARTS; part++) {
        for (int d = 0; d < 2; d++) place[d] = end[0][d] + (end[1][d] - end[0][d]) * part / PARTS;
        if (covers(shape, place)) return true;
      }
    }
  return false;
}

static bool is_taken(const struct gx_figure *figure, const struct pair *pair, const struct shape *shape)
{
  for (size_t i = 0; i < figure->triangles; i++) {
    const struct gx_figure_triangle *other = &figure->triangle[i];
    if (fabs(other->slope - pair->order) <= alike) return true;
    struct shape theirs;
    double middle[2] = {0, 0}, own[2] = {0, 0};
    for (int c = 0; c < 3; c++) {
      theirs.corner[c][0] = share(&figure->x, other->at[c][0]);
      theirs.corner[c][1] = share(&figure->y, other->at[c][1]);
      for (int d = 0; d < 2; d++) middle[d] += theirs.corner[c][d] / 3;
      for (int d = 0; d < 2; d++) own[d] += shape->corner[c][d] / 3;
    }
    for (int c = 0; c < 3; c++)
      if (covers(shape, theirs.corner[c]) || covers(&theirs, shape->corner[c])) return true;
    if (covers(shape, middle) || covers(&theirs, own)) return true;
  }
  return false;
}

/* The finest pair of a line that shows an order and has room, else its steepest. Order 0: none. */
static struct pair find_pair(const struct gx_figure *figure, const struct gx_figure_line *line)
{
  struct pair best = {.line = line};
  for (size_t t = 0; t < figure->triangles; t++)
    if (figure->triangle[t].line == line) return best;
  if (isnan(line->order) || line->count < 2) return best;
  double sign = line->order * slope_of(figure, line->first + line->count - 2) < 0 ? -1 : 1;
  for (size_t k = line->count - 1; k-- > 0;) {
    struct pair pair = {line, line->first + k, sign * slope_of(figure, line->first + k)};
    if (pair.order < least_order || pair.order <= best.order) continue;
    struct shape shape = put_under(figure, &pair);
    if (is_taken(figure, &pair, &shape) || is_crossed(figure, &shape)) continue;
    best = pair;
    if (k + 2 == line->count) break;
  }
  return best;
}

static bool is_lower(const struct gx_figure *figure, const struct pair *a, const struct pair *b)
{
  return gx_figure_number(figure, a->row + 1, GX_FIGURE_Y) < gx_figure_number(figure, b->row + 1, GX_FIGURE_Y);
}

static void add(struct gx_figure *figure, const struct pair *pair)
{
  struct gx_figure_triangle *triangle = &figure->triangle[figure->triangles++];
  struct shape shape = put_under(figure, pair);
  triangle->line = pair->line;
  triangle->slope = pair->order;
  for (int c = 0; c < 3; c++) {
    triangle->at[c][0] = value_at(&figure->x, shape.corner[c][0]);
    triangle->at[c][1] = value_at(&figure->y, shape.corner[c][1]);
  }
}

/* Room for triangles under the lowest line. */
static void make_room(struct gx_figure *figure)
{
  double below = pow(figure->y.most / figure->y.least, -1.5 * gap), least = figure->y.least;
  for (size_t i = 0; i < figure->triangles; i++) least = fmin(least, figure->triangle[i].at[2][1] * below);
  figure->y.least = least;
}

void gx_triangle_find(struct gx_figure *figure)
{
  if (!figure->x.log || !figure->y.log) return;
  while (figure->triangles < GX_FIGURE_TRIANGLES) {
    struct pair best = {0};
    for (size_t i = 0; i < figure->lines; i++) {
      struct pair pair = find_pair(figure, &figure->line[i]);
      if (pair.order <= 0) continue;
      bool steeper = pair.order > best.order + alike, as_steep = pair.order > best.order - alike;
      if (!best.line || steeper || (as_steep && is_lower(figure, &pair, &best))) best = pair;
    }
    if (!best.line) break;
    add(figure, &best);
  }
  make_room(figure);
}
