/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splines of each direction of a lattice, and products of their operators. */
#include "spline_lattice.h"

#include <stdlib.h>
#include <string.h>

#include "../core/large.h"
#include "sites.h"

static enum gx_status report(const struct gx_spline_lattice *lattice, const struct gx_spline_error *error)
{
  return gx_sites_report(lattice->outcome, error, lattice->n, lattice->direction[0].x + 1, lattice->periodic, lattice->closed);
}

#define SPLINE(lattice, call)                                                                                                    \
  do {                                                                                                                           \
    struct gx_spline_error error = {.site = -1};                                                                                 \
    if (call) return report(lattice, &error);                                                                                    \
  } while (0)

/* Hands out `count` doubles from *at on; with *at NULL only counts them. */
static double *hand_out(double **at, size_t count, size_t *used)
{
  double *here = *at;
  *used += count;
  if (here) *at += count;
  return here;
}

/* Sets every array from `at` on; returns the number of doubles they take. */
static size_t place_arrays(struct gx_spline_lattice *lattice, double *at)
{
  size_t used = 0, nodes = 1, most = 1;
  for (int d = 0; d < lattice->dim; d++) {
    struct gx_spline_direction *direction = &lattice->direction[d];
    direction->x = hand_out(&at, direction->sites + 2, &used);
    direction->target = hand_out(&at, direction->sites + 2, &used);
    direction->at_node = hand_out(&at, direction->nodes, &used);
    nodes *= direction->nodes;
    most *= direction->sites > direction->nodes ? direction->sites : direction->nodes;
  }
  if (lattice->closed) lattice->value = hand_out(&at, lattice->n + 2, &used);
  if (!lattice->nodal) return used;
  lattice->nodal_value = hand_out(&at, nodes, &used);
  for (int i = 0; i < 2 && lattice->dim > 1; i++) lattice->between[i] = hand_out(&at, most, &used);
  return used;
}

/* `more`: sites besides them */
static enum gx_status enough(const struct gx_spline_lattice *lattice, size_t count, size_t more, const char *what)
{
  const size_t least = (size_t)lattice->degree + 1 - more;
  if (count >= least) return GX_OK;
  return gx_status_set(lattice->outcome, GX_REFUSED, -1, "splines of degree %d need %zu %s or more%s, and there are %zu",
                       lattice->degree, least, what, lattice->dim > 1 ? " in each direction" : "", count);
}

/* Along one direction a particle space takes derivatives only; by way of nodes motion takes values on its way there and stress
 * derivatives, across the others values of both. */
static enum gx_status create_direction(struct gx_spline_lattice *lattice, struct gx_spline_direction *direction)
{
  static const enum gx_spline_ends mirrored[GX_PARITIES] = {GX_SPLINE_ODD, GX_SPLINE_EVEN};
  const int degree = lattice->degree;
  const size_t ends = lattice->stress_at_ends ? 2 : 0;
  const size_t sites[GX_PARITIES] = {direction->sites + (lattice->closed ? 2 : 0), direction->sites + ends};
  const size_t targets[GX_PARITIES] = {direction->sites + ends, direction->sites};
  for (int k = 0; k < GX_PARITIES; k++) {
    enum gx_spline_ends kind = lattice->periodic ? GX_SPLINE_PERIODIC : lattice->closed ? GX_SPLINE_OPEN : mirrored[k];
    unsigned orders = !lattice->nodal ? 2 : lattice->dim > 1 ? 3 : k == GX_PARITY_ODD ? 1 : 2;
    SPLINE(lattice, gx_spline_interpolant_create(&direction->site[k], kind, degree, sites[k], &error));
    SPLINE(lattice, gx_spline_points_create(&direction->from_sites[k], degree, orders,
                                            lattice->nodal ? direction->nodes : targets[k], &error));
    SPLINE(lattice, gx_spline_lines_create(&direction->of_sites[k], direction->site[k], direction->from_sites[k], &error));
  }
  if (!lattice->nodal) return GX_OK;
  for (size_t i = 0; i < direction->nodes; i++)
    direction->at_node[i] = (double)i / (double)(direction->nodes - !lattice->periodic);
  SPLINE(lattice, gx_spline_points_create(&direction->from_nodes, degree, 3, targets[GX_PARITY_ODD], &error));
  for (int k = 0; k < GX_PARITIES; k++) {
    enum gx_spline_ends kind = lattice->periodic ? GX_SPLINE_PERIODIC : lattice->closed ? GX_SPLINE_OPEN : mirrored[k];
    SPLINE(lattice, gx_spline_interpolant_create(&direction->node[k], kind, degree, direction->nodes, &error));
    SPLINE(lattice, gx_spline_interpolant_set_sites(direction->node[k], direction->at_node, 0, 1, &error));
    SPLINE(lattice, gx_spline_lines_create(&direction->of_nodes[k], direction->node[k], direction->from_nodes, &error));
  }
  return GX_OK;
}

/* Splines of a direction for particles at x, [sites], `stride` apart. */
static enum gx_status place_direction(struct gx_spline_lattice *lattice, struct gx_spline_direction *direction, const double *X,
                                      const double *u)
{
  const size_t n = direction->sites, stride = direction->stride;
  for (size_t p = 0; p < n; p++) direction->target[p] = direction->x[p + 1] = u ? X[p] + u[p] : X[p * stride];
  direction->x[0] = direction->target[n] = 0;
  direction->x[n + 1] = direction->target[n + 1] = 1;
  const bool first[GX_PARITIES] = {lattice->closed, lattice->stress_at_ends};
  for (int k = 0; k < GX_PARITIES; k++)
    SPLINE(lattice, gx_spline_interpolant_set_sites(direction->site[k], direction->x + !first[k], 0, 1, &error));
  for (int k = 0; k < GX_PARITIES; k++)
    gx_spline_points_set(direction->from_sites[k], direction->site[k]->knots,
                         lattice->nodal ? direction->at_node : direction->target);
  if (lattice->nodal) gx_spline_points_set(direction->from_nodes, direction->node[GX_PARITY_ODD]->knots, direction->target);
  return GX_OK;
}

enum gx_status gx_spline_lattice_place(struct gx_spline_lattice *lattice, const double *X, const double *u)
{
  return place_direction(lattice, &lattice->direction[0], X, u);
}

enum gx_status gx_spline_lattice_create(struct gx_spline_lattice *lattice, bool nodal, const struct gx_space_options *options,
                                        const struct gx_particles *particles, struct gx_outcome *outcome)
{
  const bool closed = !options->periodic && !options->symmetric;
  *lattice = (struct gx_spline_lattice){
      .dim = particles->dim,
      .degree = options->degree,
      .n = particles->n,
      .nodal = nodal,
      .periodic = options->periodic,
      .closed = closed,
      .stress_at_ends = closed && options->reference,
      .outcome = outcome,
  };
  size_t stride = 1;
  for (int d = 0; d < lattice->dim; d++) {
    struct gx_spline_direction *direction = &lattice->direction[d];
    direction->sites = (size_t)particles->lattice[d];
    direction->nodes = (size_t)options->cells[d] + !options->periodic;
    direction->stride = stride;
    stride *= direction->sites;
    GX_TRY(enough(lattice, direction->sites, lattice->stress_at_ends ? 2 : 0, "particles"));
    if (nodal) GX_TRY(enough(lattice, direction->nodes, 0, "nodes"));
  }
  lattice->block = gx_large_zeros((place_arrays(lattice, NULL) + 1) * sizeof(double));
  if (!lattice->block) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  place_arrays(lattice, lattice->block);
  for (int d = 0; d < lattice->dim; d++) {
    GX_TRY(create_direction(lattice, &lattice->direction[d]));
    GX_TRY(place_direction(lattice, &lattice->direction[d], particles->X[d], NULL));
  }
  return GX_OK;
}

void gx_spline_lattice_free(struct gx_spline_lattice *lattice)
{
  for (int d = 0; d < lattice->dim; d++) {
    struct gx_spline_direction *direction = &lattice->direction[d];
    for (int k = 0; k < GX_PARITIES; k++) {
      gx_spline_lines_free(direction->of_sites[k]);
      gx_spline_lines_free(direction->of_nodes[k]);
      gx_spline_interpolant_free(direction->site[k]);
      gx_spline_interpolant_free(direction->node[k]);
      gx_spline_points_free(direction->from_sites[k]);
    }
    gx_spline_points_free(direction->from_nodes);
  }
  free(lattice->block);
}

/* Directions across whose faces a field changes sign in the mirror. */
static unsigned odd_vector(int d)
{
  return 1u << d;
}

static unsigned odd_tensor(int d, int e)
{
  return 1u << d ^ 1u << e;
}

/* out <- (add: +=) the derivative along `along` (-1: values) of the product of splines through `in`, from particles to targets or
 * from nodes to particles. At the particles themselves the other directions take what was interpolated. */
static void carry(const struct gx_spline_lattice *lattice, bool from_nodes, unsigned odd, int along, const double *in, bool add,
                  double *out)
{
  const struct gx_spline_lines *lines[GX_MAX_DIM];
  int order[GX_MAX_DIM];
  for (int d = 0; d < lattice->dim; d++) {
    const struct gx_spline_direction *direction = &lattice->direction[d];
    const int slot = lattice->dim - 1 - d; /* the tensor's last direction runs fastest */
    lines[slot] = (from_nodes ? direction->of_nodes : direction->of_sites)[odd >> d & 1 ? GX_PARITY_ODD : GX_PARITY_EVEN];
    order[slot] = d == along ? 1 : lattice->nodal ? 0 : -1;
  }
  gx_spline_tensor_apply(lattice->dim, lines, order, in, add, out, lattice->between);
}

/* Walls neither move nor accelerate along their normal. */
static void hold_walls(struct gx_spline_lattice *lattice, int d)
{
  if (lattice->periodic) return;
  size_t before = 1, after = 1;
  for (int e = 0; e < lattice->dim; e++) *(e < d ? &after : &before) *= e == d ? 1 : lattice->direction[e].nodes;
  const size_t nodes = lattice->direction[d].nodes;
  for (size_t i = 0; i < before; i++) {
    memset(lattice->nodal_value + i * nodes * after, 0, after * sizeof(double));
    memset(lattice->nodal_value + ((i + 1) * nodes - 1) * after, 0, after * sizeof(double));
  }
}

void gx_spline_lattice_gradient(struct gx_spline_lattice *lattice, int d, const double *motion, double *const *slope)
{
  const unsigned odd = odd_vector(d);
  if (lattice->closed) {
    memcpy(lattice->value + 1, motion, lattice->n * sizeof(double));
    lattice->value[0] = lattice->value[lattice->n + 1] = 0;
    motion = lattice->value;
  }
  if (lattice->nodal) {
    carry(lattice, false, odd, -1, motion, false, lattice->nodal_value);
    hold_walls(lattice, d);
    motion = lattice->nodal_value;
  }
  for (int e = 0; e < lattice->dim; e++) carry(lattice, lattice->nodal, odd, e, motion, false, slope[e]);
}

void gx_spline_lattice_divergence(struct gx_spline_lattice *lattice, int d, double *const *stress, double *out)
{
  for (int e = 0; e < lattice->dim; e++) {
    const double *row = stress[e];
    if (lattice->stress_at_ends) {
      memcpy(lattice->value + 1, row, lattice->n * sizeof(double));
      lattice->value[0] = row[lattice->n];
      lattice->value[lattice->n + 1] = row[lattice->n + 1];
      row = lattice->value;
    }
    carry(lattice, false, odd_tensor(d, e), e, row, e > 0, lattice->nodal ? lattice->nodal_value : out);
  }
  if (!lattice->nodal) return;
  hold_walls(lattice, d);
  carry(lattice, true, odd_vector(d), -1, lattice->nodal_value, false, out);
}
