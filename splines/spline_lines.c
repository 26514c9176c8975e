/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of a product grid, a few at a time: gathered side by side, solved and evaluated in the first cache, written back. */
#include <gridcross_splines.h>

#include "spline_basis.h"
#include "spline_lines.h"

#include <stdlib.h>
#include <string.h>

enum { LANES = GX_SPLINE_LANES };

enum gx_spline_status gx_spline_lines_create(struct gx_spline_lines **lines, const struct gx_spline_interpolant *interpolant,
                                             const struct gx_spline_points *points, struct gx_spline_error *error)
{
  *lines = NULL;
  if (interpolant->knots->degree != points->degree)
    return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "points of degree %d, interpolant of degree %d", points->degree,
                               interpolant->knots->degree);
  const size_t sites = interpolant->knots->sites, most = sites > points->count ? sites : points->count;
  struct gx_spline_lines *made = calloc(1, sizeof *made);
  double *memory = calloc((most + interpolant->knots->functions) * LANES, sizeof *memory);
  if (!made || !memory) {
    free(made);
    free(memory);
    return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for lines of %zu sites", sites);
  }
  *made = (struct gx_spline_lines){interpolant, points, memory, memory + most * LANES};
  *lines = made;
  return GX_SPLINE_OK;
}

void gx_spline_lines_free(struct gx_spline_lines *lines)
{
  if (!lines) return;
  free(lines->value);
  free(lines);
}

/* LANES lines, the last of them repeated where there are fewer. */
struct tile {
  size_t first, live, after;
  bool adjacent; /* their entries lie side by side */
};

static void starts(const struct tile *tile, size_t rows, size_t *start)
{
  for (size_t s = 0; s < LANES; s++) {
    size_t line = tile->first + (s < tile->live ? s : tile->live - 1);
    start[s] = line / tile->after * rows * tile->after + line % tile->after;
  }
}

GX_SPLINE_CLONES static void load(const struct tile *tile, size_t rows, const double *restrict in, double *restrict value)
{
  size_t start[LANES];
  starts(tile, rows, start);
  if (tile->adjacent)
    for (size_t i = 0; i < rows; i++) memcpy(value + i * LANES, in + start[0] + i * tile->after, LANES * sizeof *value);
  else
    for (size_t i = 0; i < rows; i++)
      for (size_t s = 0; s < LANES; s++) value[i * LANES + s] = in[start[s] + i * tile->after];
}

GX_SPLINE_CLONES static void store(const struct tile *tile, size_t rows, bool add, const double *restrict value,
                                   double *restrict out)
{
  size_t start[LANES];
  starts(tile, rows, start);
  for (size_t i = 0; i < rows; i++, value += LANES) {
    double *row = out + i * tile->after;
    if (tile->adjacent && add)
      for (size_t s = 0; s < LANES; s++) row[start[0] + s] += value[s];
    else if (tile->adjacent)
      memcpy(row + start[0], value, LANES * sizeof *value);
    else if (add)
      for (size_t s = 0; s < tile->live; s++) row[start[s]] += value[s];
    else
      for (size_t s = 0; s < tile->live; s++) row[start[s]] = value[s];
  }
}

void gx_spline_lines_apply(const struct gx_spline_lines *lines, int order, size_t before, size_t after, const double *in,
                           bool add, double *out)
{
  const size_t count = before * after;
  if (count == 1 && !add) {
    gx_spline_interpolant_solve(lines->interpolant, in, lines->coefficient);
    gx_spline_points_evaluate(lines->points, order, lines->coefficient, out);
    return;
  }
  for (struct tile tile = {.after = after}; tile.first < count; tile.first += LANES) {
    tile.live = count - tile.first < LANES ? count - tile.first : LANES;
    tile.adjacent = tile.live == LANES && tile.first % after + LANES <= after;
    load(&tile, lines->interpolant->knots->sites, in, lines->value);
    gx_spline_interpolant_solve_many(lines->interpolant, LANES, lines->value, lines->coefficient);
    gx_spline_points_evaluate_many(lines->points, order, LANES, lines->coefficient, lines->value);
    store(&tile, lines->points->count, add, lines->value, out);
  }
}
