/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What measures find out about the particles while they exist slot by slot only: squares of their errors are summed and compared cell
 * by cell, over slots and stretches, and last over the cells; squares of velocities are those of the nodes with the band of the
 * consistent mass. Elementwise all the way, so that the bits are those of every instruction set. */
#include "slots_core.h"

#include "../core/kernel.h"
#include "../core/vector.h"

/* The first slot of a group and the exact solution there; nodal fields from the first node on that the stretch meets. */
struct group {
  int cells;
  size_t pitch, pitch_P; /* from one slot to the next, and of their P: 0, they have the same */
  const double *S, *u, *v, *P, *exact_u, *exact_v, *exact_P;
};

/* Value of a slot that is g slots on, in cell i: gathered with equal weights, or read where support is 0. */
GX_CORE double value(const int support, double w[GX_SLOTS_GROUP][GX_SLOTS_FEW], int g, const double *field, size_t i, size_t at)
{
  if (support == 0) return field[at];
  double sum = w[g][0] * field[i];
  for (int k = 1; k < support; k++) sum += w[g][k] * field[i + (size_t)k];
  return sum;
}

/* square[q] = or += error[q]^2, most[q] = max(0 or most[q], error[q]^2) of all quantities, in every cell */
GX_CORE void compare(const int support, const int count, const bool add, const struct group *group, double *restrict tally)
{
  const double *restrict u = group->u, *restrict v = group->v, *restrict P = group->P;
  const double *restrict exact_u = group->exact_u, *restrict exact_v = group->exact_v, *restrict exact_P = group->exact_P;
  const double *restrict stress[GX_SLOTS_GROUP];
  double w[GX_SLOTS_GROUP][GX_SLOTS_FEW];
  for (int g = 0; g < count; g++) {
    stress[g] = P + (size_t)g * group->pitch_P;
    for (int k = 0; k < support; k++) w[g][k] = group->S[g * support + k];
  }
  for (size_t i = 0; i < (size_t)group->cells; i++) {
    double square[GX_QUANTITIES], most[GX_QUANTITIES];
    for (size_t q = 0; q < GX_QUANTITIES; q++) {
      square[q] = add ? tally[q * GX_SLOTS_ROW + i] : 0;
      most[q] = add ? tally[(GX_QUANTITIES + q) * GX_SLOTS_ROW + i] : 0;
    }
    for (int g = 0; g < count; g++) {
      const size_t at = (size_t)g * group->pitch + i;
      const double error[GX_QUANTITIES] = {value(support, w, g, u, i, at) - exact_u[at],
                                           value(support, w, g, v, i, at) - exact_v[at], stress[g][i] - exact_P[at]};
      for (int q = 0; q < GX_QUANTITIES; q++) {
        const double more = error[q] * error[q];
        square[q] += more;
        most[q] = more > most[q] ? more : most[q];
      }
    }
    for (size_t q = 0; q < GX_QUANTITIES; q++) {
      tally[q * GX_SLOTS_ROW + i] = square[q];
      tally[(GX_QUANTITIES + q) * GX_SLOTS_ROW + i] = most[q];
    }
  }
}

GX_CLONES static void compare_group(int support, int count, bool add, const struct group *group, double *tally)
{
#define COMPARE(support)                                                                                                         \
  case support:                                                                                                                  \
    if (count == GX_SLOTS_GROUP && add)                                                                                          \
      compare(support, GX_SLOTS_GROUP, true, group, tally);                                                                      \
    else if (count == GX_SLOTS_GROUP)                                                                                            \
      compare(support, GX_SLOTS_GROUP, false, group, tally);                                                                     \
    else if (add)                                                                                                                \
      compare(support, 1, true, group, tally);                                                                                   \
    else                                                                                                                         \
      compare(support, 1, false, group, tally);                                                                                  \
    break;
  switch (support) {
    COMPARE(0)
    COMPARE(2)
    COMPARE(3)
    COMPARE(4)
  }
#undef COMPARE
}

/* The exact solution of a stretch, and its stress. */
static void find_exact(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, double t)
{
  const struct gx_posed *posed = gx_slots_posed(slots, stretch);
  double *u[] = {slots->exact_u}, *v[] = {slots->exact_v}, *F[] = {slots->exact_F}, *P[] = {slots->exact_P};
  posed->problem->exact(posed, t, u, v, F, NULL);
  posed->problem->material->piola(&posed->options.moduli, 1, posed->n, F, P);
}

static void compare_stretch(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, const double *u,
                            const double *v)
{
  const bool gathered = !slots->uniform || slots->support < 2 || slots->support > GX_SLOTS_FEW;
  const int support = gathered ? 0 : slots->support;
  const size_t pitch_P = slots->strains > 1 ? stretch->pitch : 0;
  if (gathered) {
    gx_slots_values(slots, stretch, slots->slots, slots->S, 0, u, slots->u);
    gx_slots_values(slots, stretch, slots->slots, slots->S, 0, v, slots->v);
  }
  for (int slot = 0, count; slot < slots->slots; slot += count) {
    const size_t at = (size_t)slot * stretch->pitch;
    count = slots->slots - slot < GX_SLOTS_GROUP ? 1 : GX_SLOTS_GROUP;
    const struct group group = {.cells = stretch->cells,
                                .pitch = stretch->pitch,
                                .pitch_P = pitch_P,
                                .S = slots->S + slot * support,
                                .u = gathered ? slots->u + at : u,
                                .v = gathered ? slots->v + at : v,
                                .P = slots->P + (size_t)slot * pitch_P,
                                .exact_u = slots->exact_u + at,
                                .exact_v = slots->exact_v + at,
                                .exact_P = slots->exact_P + at};
    compare_group(support, count, slot > 0 || stretch->from > 0, &group, slots->tally);
  }
}

/* Sum of V0 W of a stretch. */
static double energy(const struct gx_slots *slots, const struct gx_slots_stretch *stretch)
{
  const struct gx_material *material = slots->posed->problem->material;
  const struct gx_moduli *moduli = &slots->posed->options.moduli;
  const size_t n = stretch->pitch * (size_t)slots->strains;
  double *F[] = {slots->F}, *W = slots->exact_F;
  if (slots->volume > 0 && material->total) return slots->volume * material->total(moduli, 1, n, F); /* 0 where F is 1 */
  material->energy(moduli, 1, n, F, W);
  return gx_vector_dot(n, W, slots->V0 + stretch->at);
}

static void find_errors(struct gx_slots *slots, const double *u, const double *v, struct gx_survey *survey)
{
  const bool elastic = survey->energies && slots->posed->problem->material->energy;
  survey->elastic = 0;
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    if (!slots->held) gx_slots_stress(slots, &stretch, u);
    find_exact(slots, &stretch, survey->t);
    compare_stretch(slots, &stretch, u + slots->base + from, v + slots->base + from);
    if (elastic) survey->elastic += energy(slots, &stretch);
  }
  const size_t cells = (size_t)gx_slots_stretch_from(slots, 0).cells;
  for (int q = 0; q < GX_QUANTITIES; q++) {
    survey->square[q] = gx_vector_sum(cells, slots->tally + q * GX_SLOTS_ROW);
    survey->most[q] = gx_vector_max(cells, slots->tally + (GX_QUANTITIES + q) * GX_SLOTS_ROW);
  }
}

/* Terms of sum over particles of m_p x_p y_p with x_p = sum_i x_i S_ip, where x and y are v, and two more fields. What is read behind the
 * nodes meets a band of zeros. */
GX_CORE void products(const int support, size_t n, const double *restrict band, const double *restrict v,
                      const double *restrict with, const double *restrict change, double *restrict twice, double *restrict term)
{
  for (size_t i = 0; i < n; i++) {
    double square = band[i] * (v[i] * v[i]), product = band[i] * (with[i] * change[i]);
    for (size_t k = 1; k < (size_t)support; k++) {
      const double w = band[k * n + i];
      square += 2 * w * (v[i] * v[i + k]);
      product += w * (with[i] * change[i + k] + with[i + k] * change[i]);
    }
    twice[i] = square;
    term[i] = product;
  }
}

GX_CLONES static void form_products(int support, size_t n, const double *band, const double *v, const double *with,
                                    const double *change, double *twice, double *term)
{
  if (support == 2)
    products(2, n, band, v, with, change, twice, term);
  else if (support == 3)
    products(3, n, band, v, with, change, twice, term);
  else
    products(support, n, band, v, with, change, twice, term);
}

/* From the end of step before to this one: now = v + ahead a and a0 = a; with = half of now before, or a quarter of its change, and
 * change = that of a. */
GX_CLONES static void bring(size_t n, double ahead, bool first_order, const double *restrict v, const double *restrict a,
                            double *restrict now, double *restrict a0, double *restrict with, double *restrict change)
{
  for (size_t i = 0; i < n; i++) {
    const double end = v[i] + ahead * a[i];
    with[i] = first_order ? 0.5 * now[i] : 0.25 * (end - now[i]);
    change[i] = a[i] - a0[i];
    now[i] = end;
    a0[i] = a[i];
  }
}

size_t gx_slots_survey_keeps(const struct gx_slots *slots)
{
  return 2 * (size_t)slots->nodes + GX_MAX_SUPPORT; /* what is read behind v is of a, which has fewer entries on few cells */
}

void gx_slots_survey(struct gx_slots *slots, const struct gx_slots_nodes *nodes, struct gx_survey *survey)
{
  const size_t n = (size_t)slots->nodes, row = n + GX_MAX_SUPPORT;
  double *with = slots->forms, *change = with + row, *twice = change + row, *term = twice + row;
  double *v = survey->kept, *a = v + n;
  bring(n, survey->ahead, survey->first_order, nodes->v, nodes->a, v, a, with, change);
  find_errors(slots, nodes->u, v, survey);
  if (!survey->energies) return;
  form_products(slots->support, n, slots->band, v, with, change, twice, term);
  survey->momentum[0] = gx_vector_dot(n, nodes->mass, v);
  survey->kinetic = 0.5 * gx_vector_sum(n, twice);
  survey->defect = gx_vector_sum(n, term);
}
