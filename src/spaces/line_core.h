/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The passes, for vectors of WIDTH doubles (8 or 4) and functions of attribute PASS; included once in a file. Whoever includes it
 * gives what differs: whole_below, and how data move, interleave, deinterleave and look_up. No result depends on the width. */
#include <string.h>

#include "../bases/gimp.h"
#include "../core/kernel.h"

/* At any address. */
#define LOAD(vector, from) memcpy(&(vector), (from), sizeof(vector))
#define STORE(vector, to)  memcpy((to), &(vector), sizeof(vector))

typedef double record __attribute__((vector_size(32)));

/* Runs statement with `support` a constant where it is small. */
#define OF_SUPPORT(value, statement)                                                                                             \
  if ((value) == 2) {                                                                                                            \
    enum { support = 2 };                                                                                                        \
    statement;                                                                                                                   \
  } else if ((value) == 3) {                                                                                                     \
    enum { support = 3 };                                                                                                        \
    statement;                                                                                                                   \
  } else if ((value) == 4) {                                                                                                     \
    enum { support = 4 };                                                                                                        \
    statement;                                                                                                                   \
  } else {                                                                                                                       \
    const int support = (value);                                                                                                 \
    if (support < 2 || support > GX_MAX_SUPPORT) __builtin_unreachable();                                                        \
    statement;                                                                                                                   \
  }

/* X + u in units of cells, as gx_locate has it. */
GX_CORE void locate(const bool periodic, const vec *cells, const vec *x, vec *s)
{
  vec whole = {0};
  if (periodic) whole_below(x, &whole);
  *s = (periodic ? *x - whole : *x) * *cells;
}

/* Whole cells below, held to [0, last], whatever it was. */
GX_CORE void hold(const vec *position, const vec *last, vec *cell)
{
  const vec none = {0};
  vec whole, within;
  whole_below(position, &whole);
  within = LEAST(whole, *last);
  *cell = LARGEST(within, none);
}

/* At place r of a cell, D per cell, as the basis has them. */
GX_CORE void spline_weights(const int degree, const vec *place, vec *S, vec *D)
{
  const vec r = *place, one = (vec){0} + 1;
  S[0] = one;
  for (int q = 1; q <= degree; q++) {
    const double share = 1.0 / q;
    if (q == degree) {
      D[0] = -S[0];
      for (int j = 1; j < q; j++) D[j] = S[j - 1] - S[j];
      D[q] = S[q - 1];
    }
    S[q] = r * S[q - 1] * share;
    for (int j = q - 1; j >= 1; j--) S[j] = ((r + (q - j)) * S[j - 1] + (j + 1 - r) * S[j]) * share;
    S[0] = (1 - r) * S[0] * share;
  }
}

/* As gx_locate_share. */
GX_CORE void hold_share(vec *place)
{
  const vec least = (vec){0} + 0x1p-60, most = (vec){0} + (1 - 0x1p-53);
  *place = LARGEST(*place, least);
  *place = LEAST(*place, most);
}

/* As gx_gimp_weights, t from the nearest node and half width l, in units of cells. */
GX_CORE void gimp_weights(const vec *from_nearest, const vec *half, vec *S, vec *D)
{
  const vec none = {0}, t = *from_nearest, l = *half, width = 2 * l;
  vec a = l - t, b = l + t, beyond_left = -t - l, beyond_right = t - l;
  a = LARGEST(a, none);
  b = LARGEST(b, none);
  a = LEAST(a, width);
  b = LEAST(b, width);
  const vec scale = 0.5 / l, slope_left = a * scale, slope_right = b * scale;
  const vec left = 0.5 * a * slope_left + LARGEST(beyond_left, none), right = 0.5 * b * slope_right + LARGEST(beyond_right, none);
  S[0] = left;
  S[1] = 1 - left - right;
  S[2] = right;
  D[0] = -slope_left;
  D[1] = slope_left - slope_right;
  D[2] = slope_right;
}

/* Blocks that meet a cell at an end, whose functions are others. */
static void weigh_end(const struct gx_line_fields *f, size_t p)
{
  double x[GX_LINE_BLOCK] = {0}, S[GX_MAX_SUPPORT * GX_LINE_BLOCK], D[GX_MAX_SUPPORT * GX_LINE_BLOCK];
  const size_t rest = f->n - p < GX_LINE_BLOCK ? f->n - p : GX_LINE_BLOCK;
  for (size_t k = 0; k < rest; k++) x[k] = f->X[p + k] + f->u[p + k];
  f->basis->evaluate(f->axis, rest, x, NULL, f->first + p, S, D);
  for (size_t s = 0; s < (size_t)f->support; s++)
    for (size_t k = 0; k < rest; k++) {
      f->S[s * f->n + p + k] = S[s * rest + k];
      f->D[s * f->n + p + k] = D[s * rest + k];
    }
}

GX_CORE bool meets_end(const struct gx_line_fields *f, const int degree, size_t p)
{
  int least = f->axis->cells, most = 0;
  for (size_t k = p; k < p + GX_LINE_BLOCK && k < f->n; k++) {
    least = f->first[k] < least ? f->first[k] : least;
    most = f->first[k] > most ? f->first[k] : most;
  }
  return least < degree - 1 || most > f->axis->cells - degree;
}

struct weigh_scale {
  vec cells, last; /* cells of the bar; index of the last cell, or node */
};

/* Weights of WIDTH particles at p; sets bits of stray where one is. */
GX_CORE void weigh_some(const struct gx_line_fields *f, const int support, const bool gimp, const bool periodic, double low,
                        double high, size_t p, const struct weigh_scale *scale, ints *stray)
{
  const vec cells = scale->cells;
  vec X, u, F, s, cell, place, half, S[GX_MAX_SUPPORT], D[GX_MAX_SUPPORT];
  LOAD(X, f->X + p);
  LOAD(u, f->u + p);
  const vec x = X + u;
  *stray |= ~((x >= low) & (x <= high));
  locate(periodic, &cells, &x, &s);
  const vec rounded = gimp ? s + 0.5 : s;
  hold(&rounded, &scale->last, &cell);
  const indices first = TO_INDICES(cell);
  place = s - cell;
  if (gimp) {
    LOAD(half, f->half_length + p);
    if (f->half) {
      LOAD(F, f->F + p);
      half = F * half;
      STORE(half, f->half + p);
    }
    half = half * cells;
    if (f->half) *stray |= ~((half > 0) & (half <= gx_gimp_widest));
    gimp_weights(&place, &half, S, D);
  } else {
    if (support == 2) hold_share(&place);
    spline_weights(support - 1, &place, S, D);
  }
  STORE(first, f->first + p);
  for (int k = 0; k < support; k++) {
    STORE(S[k], f->S + (size_t)k * f->n + p);
    D[k] = D[k] * cells;
    if (support > 2) STORE(D[k], f->D + (size_t)k * f->n + p); /* slopes of hats never change */
  }
}

GX_CORE bool weigh_all(const struct gx_line_fields *f, const int support, const bool gimp, const bool periodic, double low,
                       double high)
{
  const size_t n = f->n;
  const struct weigh_scale scale = {(vec){0} + f->axis->cells, (vec){0} + (f->axis->cells - !gimp)};
  ints stray = {0};
  for (size_t p = 0; p < n; p += WIDTH) /* the last ones, whole, perhaps twice */
    weigh_some(f, support, gimp, periodic, low, high, p + WIDTH <= n ? p : n - WIDTH, &scale, &stray);
  for (int k = 0; k < WIDTH; k++)
    if (stray[k]) return false;
  for (size_t p = 0; !periodic && !gimp && support > 2 && p < n; p += GX_LINE_BLOCK)
    if (meets_end(f, support - 1, p)) weigh_end(f, p);
  return true;
}

GX_CORE bool weigh_axis(const struct gx_line_fields *f, const int support, const bool gimp, double low, double high)
{
  return f->axis->periodic ? weigh_all(f, support, gimp, true, low, high) : weigh_all(f, support, gimp, false, low, high);
}

PASS static bool weigh(const struct gx_line_fields *fields, double low, double high)
{
  const struct gx_line_fields f = *fields;
  bool sound = true;
  if (f.basis->has_domain) return weigh_axis(&f, 3, true, low, high);
  OF_SUPPORT(f.support, sound = weigh_axis(&f, support, false, low, high))
  return sound;
}

/* Records of the block at p, [support][BLOCK]: those of its even particles, then of its odd ones. */
GX_CORE void fill_block(const struct gx_line_fields *f, const int support, const bool body, const enum gx_line_part part,
                        size_t p, double *records)
{
  const size_t n = f->n;
  for (size_t h = 0; h < GX_LINE_BLOCK; h += WIDTH) {
    const size_t at = p + h;
    vec m, v, momentum, V0, P, F, T, b, load;
    LOAD(m, f->m + at);
    if (part & GX_LINE_MOTION) {
      LOAD(v, f->v + at);
      momentum = m * v;
    }
    if (part & GX_LINE_FORCE) {
      LOAD(V0, f->V0 + at);
      LOAD(P, f->P + at);
      LOAD(F, f->F + at);
      T = -V0 * (P * F);
    }
    if (body && (part & GX_LINE_FORCE)) {
      LOAD(b, f->b + at);
      load = m * b;
    }
    for (int s = 0; s < support; s++) {
      vec S, D, mass = {0}, moment = {0}, force = {0};
      LOAD(S, f->S + (size_t)s * n + at);
      if (part & GX_LINE_MOTION) {
        mass = m * S;
        moment = momentum * S;
      }
      if (part & GX_LINE_FORCE) {
        LOAD(D, f->D + (size_t)s * n + at);
        force = T * D;
        if (body) force = force + load * S;
      }
      if (part == GX_LINE_FORCE)
        STORE(force, records + (size_t)s * GX_LINE_BLOCK + h);
      else
        interleave(&mass, &moment, &force, h, records + (size_t)s * GX_LINE_BLOCK * GX_LINE_RECORD);
    }
  }
}

GX_CORE void add_record(const double *from, double *to)
{
  record more, sum;
  LOAD(more, from);
  LOAD(sum, to);
  sum = sum + more;
  STORE(sum, to);
}

/* Particles of a block in the order of its records. */
GX_CORE size_t particle_of(const size_t k)
{
  return k < GX_LINE_BLOCK / 2 ? 2 * k : 2 * k - GX_LINE_BLOCK + 1;
}

/* One particle of so many lanes each. */
GX_CORE void add_particles(const int support, const enum gx_line_part part, size_t lanes, size_t length, const int *first,
                           const double *from, double *to)
{
  const size_t size = part == GX_LINE_FORCE ? 1 : GX_LINE_RECORD, room = (size_t)support * GX_LINE_BLOCK * size;
  for (size_t lane = 0; lane < lanes; lane++) {
    double *node = to + (size_t)first[lane * length] * size;
    for (int s = 0; s < support; s++)
      if (part == GX_LINE_FORCE)
        node[s] += from[lane * room + (size_t)s * GX_LINE_BLOCK];
      else
        add_record(from + lane * room + (size_t)s * GX_LINE_BLOCK * size, node + (size_t)s * size);
  }
}

GX_CORE void scatter_lanes(const struct gx_line_fields *f, const int support, const bool body, const enum gx_line_part part)
{
  const size_t n = f->n, size = part == GX_LINE_FORCE ? 1 : GX_LINE_RECORD, room = (size_t)support * GX_LINE_BLOCK * size;
  const size_t blocks = (n + GX_LINE_BLOCK - 1) / GX_LINE_BLOCK;
  const size_t length = (blocks + GX_LINE_LANES - 1) / GX_LINE_LANES * GX_LINE_BLOCK;
  for (size_t j = 0; j < length; j += GX_LINE_BLOCK) {
    const size_t lanes = (n - j + length - 1) / length;
    for (size_t lane = 0; lane < lanes; lane++) fill_block(f, support, body, part, lane * length + j, f->scratch + lane * room);
    /* those past the last have no mass and no volume */
    for (size_t k = 0; k < GX_LINE_BLOCK; k++) {
      const int *first = f->first + j + (part == GX_LINE_FORCE ? k : particle_of(k));
      if (lanes == GX_LINE_LANES)
        add_particles(support, part, GX_LINE_LANES, length, first, f->scratch + k * size, f->record);
      else
        add_particles(support, part, lanes, length, first, f->scratch + k * size, f->record);
    }
  }
}

GX_CORE void scatter_part(const struct gx_line_fields *f, const int support, const enum gx_line_part part)
{
  if (f->b)
    scatter_lanes(f, support, true, part);
  else
    scatter_lanes(f, support, false, part);
}

GX_CORE void scatter_support(const struct gx_line_fields *f, const int support, enum gx_line_part part)
{
  if (part == GX_LINE_ALL)
    scatter_part(f, support, GX_LINE_ALL);
  else if (part == GX_LINE_MOTION)
    scatter_lanes(f, support, false, GX_LINE_MOTION);
  else
    scatter_part(f, support, GX_LINE_FORCE);
}

PASS static void scatter(const struct gx_line_fields *fields, enum gx_line_part part)
{
  const struct gx_line_fields f = *fields; /* what is written cannot change them */
  OF_SUPPORT(f.support, scatter_support(&f, support, part))
}

PASS static void divide(const struct gx_line_fields *fields, enum gx_line_part part)
{
  const struct gx_line_fields fixed = *fields, *f = &fixed;
  const size_t size = part == GX_LINE_FORCE ? 1 : GX_LINE_RECORD;
  for (size_t i = 0; i < f->stored; i += WIDTH) {
    vec mass, moment = {0}, force, share;
    double *from = f->record + i * size;
    const vec none = {0};
    if (part == GX_LINE_FORCE) {
      LOAD(force, from);
      LOAD(mass, f->mass + i);
      STORE(none, from);
    } else {
      deinterleave(from, &mass, &moment, &force);
      for (size_t k = 0; k < GX_LINE_RECORD; k++) STORE(none, from + k * WIDTH);
      STORE(mass, f->mass + i);
    }
    const vec one = none + 1, trace = none + f->trace;
    share = (vec)((ints)(one / mass) & (mass > trace)); /* 0 where there is none */
    moment = moment * share;
    force = force * share;
    if (part & GX_LINE_MOTION) STORE(moment, f->velocity + i);
    if (part & GX_LINE_FORCE) STORE(force, f->acceleration + i);
  }
}

/* The block at p; within: its nodes are within a window. */
GX_CORE void advance_block(const struct gx_line_fields *f, const int support, const bool kick, const bool strain,
                           const bool drift, const bool blend, const struct gx_line_step *step, size_t p, const bool within)
{
  const size_t n = f->n;
  for (size_t h = 0; h < GX_LINE_BLOCK; h += WIDTH) {
    const size_t at = p + h;
    const int *first = f->first + at;
    vec a = {0}, v = {0}, gradient = {0}, nodal = {0}, S, D, F, u, velocity;
    for (int s = 0; s < support; s++) {
      LOAD(S, f->S + (size_t)s * n + at);
      LOAD(D, f->D + (size_t)s * n + at);
      if (kick) {
        look_up(first, within, s, f->acceleration, &nodal);
        a = s ? a + S * nodal : S * nodal;
      }
      look_up(first, within, s, f->velocity, &nodal);
      if (drift || blend) v = s ? v + S * nodal : S * nodal;
      if (strain) gradient = s ? gradient + D * nodal : D * nodal;
    }
    if (kick) {
      LOAD(velocity, f->v + at);
      velocity = velocity + step->kick * a;
      if (blend) velocity = step->flip * velocity + (1 - step->flip) * v;
      STORE(velocity, f->v + at);
    }
    if (strain) {
      LOAD(F, f->F + at);
      F = F + step->strain * (gradient * F);
      STORE(F, f->F + at);
    }
    if (drift) {
      LOAD(u, f->u + at);
      u = u + step->drift * v;
      STORE(u, f->u + at);
    }
  }
}

GX_CORE void advance_blocks(const struct gx_line_fields *f, const int support, const bool kick, const bool strain,
                            const bool drift, const bool blend, const struct gx_line_step *step)
{
  for (size_t p = 0; p < f->n; p += GX_LINE_BLOCK)
    if (is_within(f->first + p, support))
      advance_block(f, support, kick, strain, drift, blend, step, p, true);
    else
      advance_block(f, support, kick, strain, drift, blend, step, p, false);
}

GX_CORE void advance_support(const struct gx_line_fields *f, const int support, const struct gx_line_step *step)
{
  const bool blend = step->flip < 1;
  if (step->kick == 0)
    advance_blocks(f, support, false, true, false, false, step);
  else if (step->strain == 0 && !blend)
    advance_blocks(f, support, true, false, true, false, step);
  else if (step->strain == 0)
    advance_blocks(f, support, true, false, true, true, step);
  else if (!blend)
    advance_blocks(f, support, true, true, true, false, step);
  else
    advance_blocks(f, support, true, true, true, true, step);
}

PASS static void advance(const struct gx_line_fields *fields, const struct gx_line_step *spans)
{
  const struct gx_line_fields f = *fields;
  const struct gx_line_step step = *spans;
  OF_SUPPORT(f.support, advance_support(&f, support, &step))
}

/* Of the block at p, which writes its `count` particles alone. */
GX_CORE void gather_block(const struct gx_line_fields *f, const int support, const double *field, size_t p, const bool within,
                          size_t count, double *value)
{
  double all[GX_LINE_BLOCK];
  for (size_t h = 0; h < GX_LINE_BLOCK; h += WIDTH) {
    vec sum = {0}, nodal = {0}, S;
    for (int s = 0; s < support; s++) {
      LOAD(S, f->S + (size_t)s * f->n + p + h);
      look_up(f->first + p + h, within, s, field, &nodal);
      sum = s ? sum + S * nodal : S * nodal;
    }
    STORE(sum, count < GX_LINE_BLOCK ? all + h : value + p + h);
  }
  if (count < GX_LINE_BLOCK) memcpy(value + p, all, count * sizeof(double));
}

GX_CORE void gather_support(const struct gx_line_fields *f, const int support, const double *field, double *value)
{
  for (size_t p = 0; p < f->n; p += GX_LINE_BLOCK) {
    const size_t count = f->n - p < GX_LINE_BLOCK ? f->n - p : GX_LINE_BLOCK;
    if (is_within(f->first + p, support))
      gather_block(f, support, field, p, true, count, value);
    else
      gather_block(f, support, field, p, false, count, value);
  }
}

PASS static void gather(const struct gx_line_fields *fields, const double *field, double *value)
{
  const struct gx_line_fields f = *fields;
  OF_SUPPORT(f.support, gather_support(&f, support, field, value))
}

#undef OF_SUPPORT
#undef LOAD
#undef STORE
