/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paths of particles and of cell edges, and where they cross. */
#include "tracks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/series.h>

enum { MOST_TIMES = 400 }; /* points of a path */

void gx_tracks_free(struct gx_tracks *tracks)
{
  free(tracks->time);
  free(tracks->index);
  free(tracks->path);
  free(tracks->edge_index);
  free(tracks->edge);
  free(tracks->crossing);
  *tracks = (struct gx_tracks){0};
}

static int no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return -1;
}

static int ascending(const void *left, const void *right)
{
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* The level that most of the sorted places share, nearest to the middle where several do. */
static double fullest_level(size_t n, const double *sorted, double near)
{
  double middle = 0.5 * (sorted[0] + sorted[n - 1]), best = sorted[0];
  size_t most = 0;
  for (size_t from = 0, to; from < n; from = to) {
    for (to = from + 1; to < n && sorted[to] - sorted[from] <= near;) to++;
    bool nearer = fabs(sorted[from] - middle) < fabs(best - middle);
    if (to - from > most || (to - from == most && nearer)) best = sorted[from];
    if (to - from > most) most = to - from;
  }
  return best;
}

/* Drops the particles that are not of one row along d. among: [particles], 1: still there. */
static int choose_row(const struct gx_series *series, int d, char *among, FILE *errors)
{
  double *X = gx_series_read(series, 0, GX_SERIES_PARTICLES, "reference_position", d, errors);
  double *sorted = X ? malloc(series->particles * sizeof *sorted) : NULL;
  size_t n = 0;
  for (size_t p = 0; p < series->particles && sorted; p++)
    if (among[p]) sorted[n++] = X[p];
  if (n) {
    qsort(sorted, n, sizeof *sorted, ascending);
    double near = 1e-9 * (sorted[n - 1] - sorted[0]), level = fullest_level(n, sorted, near);
    for (size_t p = 0; p < series->particles; p++) among[p] = among[p] && X[p] >= level && X[p] <= level + near;
  }
  int failed = !X ? -1 : !sorted ? no_memory(errors) : 0;
  free(sorted);
  free(X);
  return failed;
}

static size_t stride_of(size_t count, size_t most)
{
  return count > most ? (count + most - 1) / most : 1;
}

static int choose_paths(struct gx_tracks *tracks, const struct gx_series *series, FILE *errors)
{
  char *among = malloc(series->particles + 1);
  if (!among) return no_memory(errors);
  memset(among, 1, series->particles);
  int failed = 0;
  for (int d = 1; d < series->dim && !failed; d++) failed = choose_row(series, d, among, errors);
  for (size_t p = 0; p < series->particles; p++) tracks->of += (size_t)among[p];
  size_t stride = stride_of(tracks->of, GX_TRACKS_MOST), met = 0;
  if (!failed && !(tracks->index = calloc(GX_TRACKS_MOST + 1, sizeof *tracks->index))) failed = no_memory(errors);
  for (size_t p = 0; p < series->particles && !failed; p++)
    if (among[p] && met++ % stride == 0) tracks->index[tracks->paths++] = p;
  free(among);
  return failed;
}

/* Vertices of the grid along x, in the middle of the other directions: the first, and how far apart they are. */
static size_t first_vertex(const struct gx_series *series)
{
  const size_t *shape = series->vertices;
  return (shape[2] / 2 * shape[1] + shape[1] / 2) * shape[0];
}

static int choose_edges(struct gx_tracks *tracks, const struct gx_series *series, FILE *errors)
{
  tracks->edges_of = series->vertices[0];
  size_t stride = stride_of(tracks->edges_of, GX_TRACKS_MOST + 1);
  if (!(tracks->edge_index = calloc(GX_TRACKS_MOST + 2, sizeof *tracks->edge_index))) return no_memory(errors);
  for (size_t i = 0; i < tracks->edges_of; i += stride) tracks->edge_index[tracks->edges++] = i;
  return 0;
}

/* Where a path meets edges from one snapshot to the next. cells: along x. */
static int cross(struct gx_tracks *tracks, size_t path, double cells, const double x[2], const double time[2])
{
  double from = floor(x[0] * cells), to = floor(x[1] * cells), step = to > from ? 1 : -1;
  for (double cell = from; cell != to; cell += step) {
    double edge = (step > 0 ? cell + 1 : cell) / cells, share = (edge - x[0]) / (x[1] - x[0]);
    if (!(tracks->crossings & (tracks->crossings + 1))) { /* room for twice as many */
      void *more = realloc(tracks->crossing, 2 * (tracks->crossings + 1) * sizeof *tracks->crossing);
      if (!more) return -1;
      tracks->crossing = more;
    }
    tracks->crossing[tracks->crossings++] = (struct gx_tracks_crossing){path, edge, time[0] + share * (time[1] - time[0])};
  }
  return 0;
}

/* One snapshot; kept: its place among the times, if it has one. before: [paths] where they were at the last one. */
static int take(struct gx_tracks *tracks, const struct gx_series *series, size_t i, size_t kept, double *before, FILE *errors)
{
  double *x = gx_series_read(series, i, GX_SERIES_PARTICLES, "position", 0, errors), *u = NULL;
  if (!x) return -1;
  int failed = 0;
  for (size_t k = 0; k < tracks->paths && !failed; k++) {
    double at[2] = {before[k], x[tracks->index[k]]};
    bool near = fabs(at[0]) < 1000 && fabs(at[1] - at[0]) <= 1; /* else it is lost, and crosses edges without end */
    if (tracks->cells && i > 0 && near) failed = cross(tracks, k, (double)tracks->cells, at, &series->time[i - 1]);
    before[k] = at[1];
    if (kept < tracks->times) tracks->path[k * tracks->times + kept] = at[1];
  }
  free(x);
  if (failed) return no_memory(errors);
  if (kept >= tracks->times || !tracks->edges) return 0;
  if (series->moving && !(u = gx_series_read(series, i, GX_SERIES_VERTICES, "displacement", 0, errors))) return -1;
  for (size_t k = 0; k < tracks->edges; k++) {
    size_t vertex = tracks->edge_index[k];
    double rest = (double)vertex / (double)(series->vertices[0] - 1);
    tracks->edge[k * tracks->times + kept] = rest + (u ? u[first_vertex(series) + vertex] : 0);
  }
  free(u);
  return 0;
}

static int take_all(struct gx_tracks *tracks, const struct gx_series *series, FILE *errors)
{
  size_t stride = stride_of(series->count, MOST_TIMES), kept = 0;
  tracks->times = (series->count - 1 + stride - 1) / stride + 1; /* the last as well */
  tracks->time = calloc(tracks->times, sizeof *tracks->time);
  tracks->path = calloc(tracks->paths * tracks->times + 1, sizeof *tracks->path);
  tracks->edge = calloc(tracks->edges * tracks->times + 1, sizeof *tracks->edge);
  double *before = calloc(tracks->paths + 1, sizeof *before);
  int failed = tracks->time && tracks->path && tracks->edge && before ? 0 : no_memory(errors);
  for (size_t i = 0; i < series->count && !failed; i++) {
    bool keep = i % stride == 0 || i + 1 == series->count;
    if (keep) tracks->time[kept] = series->time[i];
    failed = take(tracks, series, i, keep ? kept++ : tracks->times, before, errors);
  }
  free(before);
  return failed;
}

int gx_tracks_read(struct gx_tracks *tracks, const char *directory, const char *id, FILE *errors)
{
  *tracks = (struct gx_tracks){0};
  struct gx_series *series = gx_series_open(directory, id, errors);
  if (!series) return -1;
  tracks->cells = series->vertices[0] > 1 && !series->moving ? series->vertices[0] - 1 : 0;
  tracks->row = series->dim > 1;
  int failed = choose_paths(tracks, series, errors);
  if (!failed) failed = choose_edges(tracks, series, errors);
  if (!failed) failed = take_all(tracks, series, errors);
  gx_series_close(series);
  return failed;
}
