/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sum factorisation. Gathering: each row of nodes is summed along the first direction to a row of particles (X), planes of these
 * along the last direction (L), and lines of those along the one between (G); scattering is the same backwards. Only the planes
 * and lines under the support of a weight are kept, each as often as its direction has functions in a cell, so that they stay in
 * cache. A stage whose direction the dimension lacks is left out.
 *
 * Parts are slabs of cells across the last direction, as many as the lattice demands. What a part adds to the planes of the
 * next one is kept apart and added when all are done: every plane is the sum of at most two, which has no order. */
#include "lattice.h"

#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/arena.h"
#include "../core/kernel.h"
#include "../core/vector.h"
#include "rows.h"

/* What a stage holds: slopes along the directions already summed (line, outer, middle), then the value. */
enum { X_KINDS = 2, L_KINDS, G_KINDS };

struct gx_lattice {
  int dim;
  struct gx_lattice_line line, middle, outer;
  size_t pitch;       /* of rows, doubles */
  size_t nodes_pitch; /* of a row of nodes, one entry for every point that meets it */
  size_t parts, plane, tail;
  double *tails; /* [parts][dim][tail] what a part adds beyond its end */
  double *scratch;
  size_t share; /* of a worker */
  struct gx_team *team;
  struct gx_arena arena;
  void *block;
};

/* What a worker holds. Rings: plane i is at i mod support. */
struct sweep {
  const struct gx_lattice *lattice;
  const struct gx_lattice_pass *pass;
  double *nodes;     /* a row */
  double *X, *X_sum; /* [outer.support][middle.nodes][X_KINDS][dim][pitch] */
  double *L, *L_sum; /* [middle.support][L_KINDS][dim][pitch] */
  double *G, *G_sum; /* [G_KINDS][dim][pitch] */
  double *const *sum;
  double *out[GX_MAX_DIM]; /* where the plane that is left goes */
  struct gx_lattice_row row;
};

static size_t round_up(size_t n)
{
  const size_t line = GX_CACHE_LINE / sizeof(double);
  return (n + line - 1) / line * line;
}

static size_t row_of(const struct gx_lattice *lattice)
{
  return (size_t)lattice->dim * lattice->pitch;
}

/* Sets what every point meets, by its place in a cell alone: where round-off sends some to the next function and others not (GIMP
 * half way between two nodes) by one function more. met: [points]. Returns whether particles do sit alike in every cell. */
static bool align(struct gx_lattice_line *direction, const int *met, int *first)
{
  const int period = direction->period;
  int most = 0;
  for (int r = 0; r < period; r++) {
    int least = met[r];
    for (int k = r; k < direction->points; k += period) least = met[k] - k / period < least ? met[k] - k / period : least;
    for (int k = r; k < direction->points; k += period) {
      first[k] = least + k / period;
      most = met[k] - first[k] > most ? met[k] - first[k] : most;
    }
  }
  direction->first = first;
  direction->support += most;
  for (int k = 1; k < direction->points; k++)
    if (first[k] < first[k - 1] || first[k] > first[k - 1] + 1) return false;
  return most <= 1 && direction->support <= GX_MAX_SUPPORT &&
         first[direction->points - 1] + direction->support <= direction->nodes;
}

static void arrange(const struct gx_lattice_line *direction, int support, const int *met, const double *from, bool by_point,
                    double *to)
{
  for (int k = 0; k < direction->points; k++)
    for (int j = 0; j < support; j++) {
      int at = j + met[k] - direction->first[k];
      to[by_point ? k * direction->support + at : at * direction->points + k] = from[j * direction->points + k];
    }
}

/* Weights of the points along d, whose particles are `apart` from each other. Returns whether they factor. */
static bool weigh(struct gx_lattice *lattice, struct gx_lattice_line *direction, const struct gx_grid *grid,
                  const struct gx_basis *basis, const struct gx_particles *particles, int d, size_t apart)
{
  const struct gx_axis *axis = &grid->axis[d];
  size_t n = (size_t)particles->lattice[d], weights = n * (size_t)axis->support;
  *direction = (struct gx_lattice_line){.points = (int)n,
                                        .support = axis->support,
                                        .period = (int)n / axis->cells,
                                        .nodes = axis->stored,
                                        .stride = grid->stride[d]};
  int *met = gx_arena_take(&lattice->arena, 2 * n * sizeof(int));
  double *point = gx_arena_take(&lattice->arena, (2 * n + 2 * weights) * sizeof(double));
  if ((int)n % axis->cells || !met || !point) return false;
  double *half = point + n, *S = half + n, *D = S + weights;
  for (size_t k = 0; k < n; k++) {
    point[k] = particles->X[d][k * apart];
    half[k] = particles->half_length[d][k * apart];
  }
  if (basis->evaluate(axis, n, point, half, met, S, D) >= 0 || !align(direction, met, met + n)) return false;
  double *arranged = gx_arena_take(&lattice->arena, 2 * n * (size_t)direction->support * sizeof(double));
  if (!arranged) return false;
  direction->S = arranged;
  direction->D = arranged + n * (size_t)direction->support;
  arrange(direction, axis->support, met, S, d > 0, arranged);
  arrange(direction, axis->support, met, D, d > 0, arranged + n * (size_t)direction->support);
  return true;
}

static bool weigh_all(struct gx_lattice *lattice, const struct gx_grid *grid, const struct gx_basis *basis,
                      const struct gx_particles *particles)
{
  static const int none[1];
  static const double one[1] = {1};
  struct gx_lattice_line *directions[] = {&lattice->line, grid->dim > 2 ? &lattice->middle : &lattice->outer, &lattice->outer};
  lattice->middle = lattice->outer =
      (struct gx_lattice_line){.points = 1, .support = 1, .nodes = 1, .period = 1, .first = none, .S = one};
  size_t apart = 1;
  for (int d = 0; d < grid->dim; d++) {
    if (particles->lattice[d] == 0 || !weigh(lattice, directions[d], grid, basis, particles, d, apart)) return false;
    apart *= (size_t)particles->lattice[d];
  }
  return true;
}

/* Slabs thick enough for a plane to belong to two at most, and for the planes that two share to be few. */
static size_t parts_of(const struct gx_lattice_line *outer)
{
  enum { LEAST = 6, MOST = 16 };
  int cells = outer->points / outer->period, least = outer->support + 1 > LEAST ? outer->support + 1 : LEAST;
  size_t parts = 1;
  while (parts < MOST && cells / (int)(2 * parts) >= least) parts *= 2;
  return parts;
}

/* Points before those of a part. */
static int bound(const struct gx_lattice *lattice, size_t part)
{
  size_t cells = (size_t)(lattice->outer.points / lattice->outer.period);
  return (int)(cells * part / lattice->parts) * lattice->outer.period;
}

static size_t window(const struct gx_lattice *lattice)
{
  return (size_t)(lattice->outer.support * lattice->middle.nodes) * X_KINDS * row_of(lattice);
}

static bool allocate(struct gx_lattice *lattice, const struct gx_grid *grid)
{
  size_t row = row_of(lattice), lines = (size_t)lattice->middle.support * L_KINDS * row;
  lattice->share = round_up(lattice->nodes_pitch + 2 * (window(lattice) + lines + G_KINDS * row)) + 8;
  lattice->plane = grid->stored / (size_t)lattice->outer.nodes;
  lattice->tail = (size_t)lattice->outer.support * lattice->plane;
  size_t tails = lattice->parts * (size_t)lattice->dim * lattice->tail;
  lattice->scratch = gx_aligned_zeros((lattice->share * gx_team_size(lattice->team) + tails) * sizeof(double), &lattice->block);
  lattice->tails = lattice->scratch ? lattice->scratch + lattice->share * gx_team_size(lattice->team) : NULL;
  return lattice->scratch;
}

struct gx_lattice *gx_lattice_create(const struct gx_grid *grid, const struct gx_basis *basis,
                                     const struct gx_particles *particles, struct gx_team *team)
{
  struct gx_lattice *lattice = calloc(1, sizeof *lattice);
  if (!lattice) return NULL;
  lattice->dim = grid->dim;
  lattice->team = team;
  if (weigh_all(lattice, grid, basis, particles)) {
    const struct gx_lattice_line *line = &lattice->line;
    lattice->pitch = round_up((size_t)line->points);
    lattice->nodes_pitch = round_up((size_t)(line->points + (line->support - 1) * line->period));
    lattice->parts = parts_of(&lattice->outer);
    if (allocate(lattice, grid)) return lattice;
  }
  gx_lattice_free(lattice);
  return NULL;
}

void gx_lattice_free(struct gx_lattice *lattice)
{
  if (!lattice) return;
  gx_arena_free(&lattice->arena);
  free(lattice->block);
  free(lattice);
}

const struct gx_lattice_line *gx_lattice_line(const struct gx_lattice *lattice)
{
  return &lattice->line;
}

static struct sweep begin(const struct gx_lattice *lattice, const struct gx_lattice_pass *pass, size_t worker)
{
  const int dim = lattice->dim;
  size_t row = row_of(lattice), planes = window(lattice), lines = (size_t)lattice->middle.support * L_KINDS * row;
  struct sweep sweep = {.lattice = lattice, .pass = pass, .nodes = lattice->scratch + worker * lattice->share};
  sweep.X = sweep.nodes + lattice->nodes_pitch;
  sweep.X_sum = sweep.X + planes;
  sweep.L = sweep.X_sum + planes;
  sweep.L_sum = sweep.L + lines;
  sweep.G = sweep.L_sum + lines;
  sweep.G_sum = sweep.G + G_KINDS * row;
  sweep.row.n = (size_t)lattice->line.points;
  double *const last = (double *[]){sweep.X, sweep.L, sweep.G}[dim - 1]; /* stage: dim slopes and the value */
  double *const last_sum = (double *[]){sweep.X_sum, sweep.L_sum, sweep.G_sum}[dim - 1];
  for (int d = 0; d < dim; d++) {
    for (int e = 0; e < dim; e++) {
      size_t at = (size_t)((e == 0 ? 0 : e == dim - 1 ? 1 : 2) * dim + d) * lattice->pitch; /* line, outer, middle */
      sweep.row.gradient[d * dim + e] = last + at;
      sweep.row.T[d * dim + e] = last_sum + at;
    }
    sweep.row.value[d] = last + (size_t)(dim * dim + d) * lattice->pitch;
    sweep.row.body[d] = last_sum + (size_t)(dim * dim + d) * lattice->pitch;
  }
  return sweep;
}

static double *in_window(const struct gx_lattice *lattice, double *X, int plane, int line)
{
  return X + (size_t)(plane % lattice->outer.support * lattice->middle.nodes + line) * X_KINDS * row_of(lattice);
}

static double *in_lines(const struct gx_lattice *lattice, double *L, int line)
{
  return L + (size_t)(line % lattice->middle.support) * L_KINDS * row_of(lattice);
}

/* Entries of a row of nodes that the points of one place in a cell meet. */
static int met_by_each(const struct gx_lattice_line *line)
{
  return line->points / line->period + line->support - 1;
}

static void enter_plane(struct sweep *sweep, int plane)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const struct gx_lattice_pass *pass = sweep->pass;
  const struct gx_lattice_line *line = &lattice->line;
  const size_t row = row_of(lattice), n = (size_t)line->points;
  if (pass->sum && lattice->dim > 1)
    memset(in_window(lattice, sweep->X_sum, plane, 0), 0, (size_t)lattice->middle.nodes * X_KINDS * row * sizeof(double));
  for (int i = 0; pass->field && i < lattice->middle.nodes; i++) {
    double *X = in_window(lattice, sweep->X, plane, i);
    const size_t at = (size_t)plane * lattice->outer.stride + (size_t)i * lattice->middle.stride;
    for (int d = 0; d < lattice->dim; d++, X += lattice->pitch) {
      gx_rows_expand(line->period, met_by_each(line), line->first, pass->field[d] + at, sweep->nodes);
      if (pass->gradient) gx_rows_gather(line->support, (size_t)line->period, line->D, sweep->nodes, n, X);
      if (pass->value || lattice->dim > 1) gx_rows_gather(line->support, (size_t)line->period, line->S, sweep->nodes, n, X + row);
    }
  }
}

static void leave_plane(struct sweep *sweep, int plane)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const struct gx_lattice_pass *pass = sweep->pass;
  const struct gx_lattice_line *line = &lattice->line;
  const size_t row = row_of(lattice), n = (size_t)line->points;
  const bool value = pass->body || lattice->dim > 1;
  for (int d = 0; pass->sum && d < lattice->dim; d++) memset(sweep->out[d], 0, lattice->plane * sizeof(double));
  for (int i = 0; pass->sum && i < lattice->middle.nodes; i++) {
    const double *X = in_window(lattice, sweep->X_sum, plane, i);
    for (int d = 0; d < lattice->dim; d++, X += lattice->pitch) {
      if (pass->T)
        gx_rows_scatter(line->support, (size_t)line->period, line->D, X, line->S, value ? X + row : NULL, n, sweep->nodes);
      else
        gx_rows_scatter(line->support, (size_t)line->period, line->S, X + row, NULL, NULL, n, sweep->nodes);
      gx_rows_fold(line->period, met_by_each(line), line->first, sweep->nodes,
                   sweep->out[d] + (size_t)i * lattice->middle.stride);
    }
  }
}

/* A sum over the rows of a direction for each kind: those before by S, the value by D and, if asked for, by S. in: rows of a stage
 * of so many kinds; out: of the next. */
static void combine(const struct sweep *sweep, const struct gx_lattice_line *direction, int point, int kinds, double *const *in,
                    bool value, double *out)
{
  const size_t row = row_of(sweep->lattice);
  const double *S = direction->S + point * direction->support, *D = direction->D + point * direction->support;
  double *from[GX_MAX_SUPPORT];
  for (int kind = 0; kind < kinds; kind++, out += row) {
    for (int j = 0; j < direction->support; j++) from[j] = in[j] + (size_t)kind * row;
    if (sweep->pass->gradient) gx_rows_combine(direction->support, kind + 1 < kinds ? S : D, from, row, out);
  }
  if (value) gx_rows_combine(direction->support, S, from, row, out);
}

/* The adjoint of combine. */
static void spread(const struct sweep *sweep, const struct gx_lattice_line *direction, int point, int kinds, const double *in,
                   bool value, double *const *out)
{
  const size_t row = row_of(sweep->lattice);
  const double *S = direction->S + point * direction->support, *D = direction->D + point * direction->support;
  double *to[GX_MAX_SUPPORT];
  for (int kind = 0; kind < kinds; kind++, in += row) {
    const bool slope = kind + 1 < kinds;
    for (int j = 0; j < direction->support; j++) to[j] = out[j] + (size_t)kind * row;
    if (sweep->pass->T) gx_rows_spread(direction->support, slope ? S : D, in, S, value && !slope ? in + row : NULL, row, to);
  }
  if (value && !sweep->pass->T) gx_rows_spread(direction->support, S, in, NULL, NULL, row, to);
}

static void enter_line(struct sweep *sweep, int point, int line)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const struct gx_lattice_line *outer = &lattice->outer;
  double *X[GX_MAX_SUPPORT], *L = in_lines(lattice, sweep->L, line);
  if (sweep->pass->sum && lattice->dim > 2)
    memset(in_lines(lattice, sweep->L_sum, line), 0, L_KINDS * row_of(lattice) * sizeof(double));
  if (!sweep->pass->field || lattice->dim < 2) return;
  for (int j = 0; j < outer->support; j++) X[j] = in_window(lattice, sweep->X, outer->first[point] + j, line);
  combine(sweep, outer, point, X_KINDS, X, sweep->pass->value || lattice->dim > 2, L);
}

static void leave_line(struct sweep *sweep, int point, int line)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const struct gx_lattice_line *outer = &lattice->outer;
  double *X[GX_MAX_SUPPORT];
  if (!sweep->pass->sum || lattice->dim < 2) return;
  for (int j = 0; j < outer->support; j++) X[j] = in_window(lattice, sweep->X_sum, outer->first[point] + j, line);
  spread(sweep, outer, point, X_KINDS, in_lines(lattice, sweep->L_sum, line), sweep->pass->body || lattice->dim > 2, X);
}

static void visit_row(struct sweep *sweep, int outer, int point)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const struct gx_lattice_pass *pass = sweep->pass;
  const struct gx_lattice_line *middle = &lattice->middle;
  double *L[GX_MAX_SUPPORT], *L_sum[GX_MAX_SUPPORT];
  for (int j = 0; j < middle->support; j++) {
    L[j] = in_lines(lattice, sweep->L, middle->first[point] + j);
    L_sum[j] = in_lines(lattice, sweep->L_sum, middle->first[point] + j);
  }
  if (pass->field && lattice->dim > 2) combine(sweep, middle, point, L_KINDS, L, pass->value, sweep->G);
  sweep->row.first = ((size_t)outer * (size_t)middle->points + (size_t)point) * sweep->row.n;
  pass->visit(pass->context, &sweep->row);
  if (pass->sum && lattice->dim > 2) spread(sweep, middle, point, L_KINDS, sweep->G_sum, pass->body, L_sum);
}

static void visit_plane(struct sweep *sweep, int outer)
{
  const struct gx_lattice_line *middle = &sweep->lattice->middle;
  int low = middle->first[0], high = low;
  for (int point = 0; point < middle->points; point++) {
    while (low < middle->first[point]) leave_line(sweep, outer, low++);
    while (high < middle->first[point] + middle->support) enter_line(sweep, outer, high++);
    visit_row(sweep, outer, point);
  }
  while (low < high) leave_line(sweep, outer, low++);
}

/* Where a plane goes: beyond the part's end into its tail. */
static void direct(struct sweep *sweep, size_t part, int plane)
{
  const struct gx_lattice *lattice = sweep->lattice;
  const int end = part + 1 < lattice->parts ? lattice->outer.first[bound(lattice, part + 1)] : lattice->outer.nodes;
  double *tail = lattice->tails + part * (size_t)lattice->dim * lattice->tail;
  for (int d = 0; d < lattice->dim; d++)
    sweep->out[d] = plane < end ? sweep->pass->sum[d] + (size_t)plane * lattice->plane
                                : tail + (size_t)d * lattice->tail + (size_t)(plane - end) * lattice->plane;
}

struct task {
  struct gx_lattice *lattice;
  const struct gx_lattice_pass *pass;
};

/* Planes that no particle meets. */
static void clear(const struct gx_lattice *lattice, double *const *sum, int from, int to)
{
  for (int d = 0; sum && from < to && d < lattice->dim; d++)
    memset(sum[d] + (size_t)from * lattice->plane, 0, (size_t)(to - from) * lattice->plane * sizeof(double));
}

static void run_part(void *context, size_t part, size_t worker)
{
  const struct task *task = context;
  const struct gx_lattice *lattice = task->lattice;
  const struct gx_lattice_line *outer = &lattice->outer;
  struct sweep sweep = begin(lattice, task->pass, worker);
  const int from = bound(lattice, part), to = bound(lattice, part + 1);
  int low = outer->first[from], high = low;
  if (part == 0) clear(lattice, sweep.pass->sum, 0, low);
  for (int point = from; point <= to; point++) {
    for (; low < (point < to ? outer->first[point] : high); low++) {
      if (sweep.pass->sum) direct(&sweep, part, low);
      leave_plane(&sweep, low);
    }
    if (point == to) break;
    while (high < outer->first[point] + outer->support) enter_plane(&sweep, high++);
    visit_plane(&sweep, point);
  }
  if (part + 1 == lattice->parts) clear(lattice, sweep.pass->sum, high, outer->nodes);
}

void gx_lattice_run(struct gx_lattice *lattice, const struct gx_lattice_pass *pass)
{
  struct task task = {lattice, pass};
  gx_team_run(lattice->team, lattice->parts, run_part, &task);
  for (size_t part = 0; pass->sum && part + 1 < lattice->parts; part++) {
    const size_t end = (size_t)lattice->outer.first[bound(lattice, part + 1)] * lattice->plane;
    for (int d = 0; d < lattice->dim; d++)
      gx_vector_add(lattice->tail, 1, lattice->tails + (part * (size_t)lattice->dim + (size_t)d) * lattice->tail,
                    pass->sum[d] + end);
  }
}

struct copies {
  int dim;
  const double *m;
  double *const *value, *const *gradient;
};

static void copy_out(void *context, const struct gx_lattice_row *row)
{
  const struct copies *to = context;
  const size_t bytes = row->n * sizeof(double);
  for (int d = 0; to->value && d < to->dim; d++) memcpy(to->value[d] + row->first, row->value[d], bytes);
  for (int k = 0; to->gradient && k < to->dim * to->dim; k++) memcpy(to->gradient[k] + row->first, row->gradient[k], bytes);
}

void gx_lattice_gather(struct gx_lattice *lattice, double *const *field, double *const *value, double *const *gradient)
{
  struct copies to = {.dim = lattice->dim, .value = value, .gradient = gradient};
  struct gx_lattice_pass pass = {.field = field, .value = value, .gradient = gradient, .visit = copy_out, .context = &to};
  gx_lattice_run(lattice, &pass);
}

static void weight_by_mass(void *context, const struct gx_lattice_row *row)
{
  const struct copies *from = context;
  for (int d = 0; d < from->dim; d++) {
    const double *m = from->m + row->first, *value = from->value[d] + row->first;
    for (size_t k = 0; k < row->n; k++) row->body[d][k] = m[k] * value[k];
  }
}

void gx_lattice_scatter(struct gx_lattice *lattice, const double *m, double *const *value, double *const *moment)
{
  struct copies from = {.dim = lattice->dim, .m = m, .value = value};
  struct gx_lattice_pass pass = {.sum = moment, .body = true, .visit = weight_by_mass, .context = &from};
  gx_lattice_run(lattice, &pass);
}
