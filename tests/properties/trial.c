/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building random cases and their twins. */
#include "trial.h"

#include "spaces/least_squares.h"
#include "spaces/mass_cg.h"
#include "spaces/mesh.h"

const char *const trial_layouts[] = {"uniform", "gauss", "scattered", NULL};
const char *const trial_ends[] = {"periodic", "free", "fixed", NULL};
const char *const trial_grids[] = {"standard", "moving-mesh", NULL};
const char *const trial_states[] = {"moving", "wave", "noise", NULL};

static const double speed = 0.2, drift = 0.6, strain = 0.03, disturbance = 0x1p-28;

static struct gx_problem box; /* axis-aligned waves without the waves: nothing acts from outside */

static void at_rest(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F)
{
  const int dim = posed->options.dim;
  for (int d = 0; d < dim; d++) memset(u[d], 0, posed->n * sizeof(double));
  for (int d = 0; d < dim; d++) memset(v[d], 0, posed->n * sizeof(double));
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < posed->n; p++) F[k][p] = k / dim == k % dim;
}

static bool is_inside(const struct gx_problem_options *options, const double *X)
{
  bool inside = true;
  for (int d = 0; d < options->dim; d++) inside = inside && fabs(X[d] - 0.5) <= 0.5 * options->body.size[d];
  return inside;
}

static int least_of(int a, int b)
{
  return a < b ? a : b;
}

struct gx_case trial_case(const struct property_choice *choice, const int *value)
{
  static const int most_cells[] = {0, 10, 8, 4}, most_per_cell[] = {0, 5, 3, 2}, most_degree[] = {0, GX_MAX_DEGREE, 5, 3};
  const int dim = value[TRIAL_DIMENSION];
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0", "problem.modulus=3");
  for (int i = 0; choice[i].name; i++) {
    int id = strchr(choice[i].name, '.') ? gx_parameter_find(choice[i].name) : -1;
    const char *text = property_text(&choice[i], value[i]);
    if (id >= 0 && text) case_set(&one, (enum gx_parameter_id)id, text);
    if (id >= 0 && !text) case_set_integer(&one, (enum gx_parameter_id)id, value[i]);
  }
  case_set_integer(&one, GX_MESH_CELLS, least_of(value[TRIAL_CELLS], most_cells[dim]));
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, least_of(value[TRIAL_PER_CELL], most_per_cell[dim]));
  case_set_integer(&one, GX_METHOD_DEGREE, least_of(value[TRIAL_DEGREE], most_degree[dim]));
  case_set(&one, GX_MESH_LAYOUT, value[TRIAL_LAYOUT] == 1 ? "gauss" : "uniform");
  case_set(&one, GX_PROBLEM_BOUNDARY, trial_ends[value[TRIAL_ENDS]]);
  case_set_real(&one, GX_METHOD_FLIP, 1 - 0.25 * value[TRIAL_DAMPING]);
  case_set_real(&one, GX_PROBLEM_POISSON, 0.1 * value[TRIAL_POISSON]);
  case_set_real(&one, GX_TIME_CFL, 0.05 * value[TRIAL_CFL]);
  case_set_integer(&one, GX_TIME_STEPS, value[TRIAL_STEPS]);
  gx_parameter_resolve(one.value);
  return one;
}

/* Particles off their lattice, each within its own part of a cell, of any mass and volume. */
static void scatter(struct trial *trial)
{
  struct gx_particles *particles = trial->rig.simulation.particles;
  for (size_t p = 0; p < particles->n; p++) {
    for (int d = 0; d < particles->dim; d++) {
      particles->X[d][p] += check_random(&trial->seed, -0.9, 0.9) * particles->half_length[d][p];
      particles->half_length[d][p] *= check_random(&trial->seed, 0.2, 0.9);
    }
    particles->m[p] *= check_random(&trial->seed, 0.6, 1.4);
    particles->V0[p] *= check_random(&trial->seed, 0.6, 1.4);
  }
  memset(particles->lattice, 0, sizeof particles->lattice);
}

/* v, u and F by particle of the plain view. */
struct condition {
  double *v[GX_MAX_DIM], *u[GX_MAX_DIM], *F[GX_MAX_TENSOR], *block;
};

static double smooth(const struct gx_particles *particles, size_t p, int component)
{
  double sum = 0;
  for (int e = 0; e < particles->dim; e++)
    sum += sin(2 * M_PI * particles->X[e][p] + component) + 0.5 * cos(4 * M_PI * particles->X[e][p] + e + component);
  return sum / 3;
}

static struct condition condition_of(struct trial *trial, int kind)
{
  const struct gx_particles *particles = trial->rig.simulation.particles;
  const struct gx_space_options *options = &trial->rig.simulation.space_options;
  const int dim = particles->dim;
  const size_t n = particles->n;
  struct condition c = {.block = calloc(n * (size_t)(2 * dim + dim * dim), sizeof(double))};
  double *at = c.block;
  for (int d = 0; d < dim; d++, at += n) c.v[d] = at;
  for (int d = 0; d < dim; d++, at += n) c.u[d] = at;
  for (int k = 0; k < dim * dim; k++, at += n) c.F[k] = at;
  for (size_t p = 0; p < n; p++) {
    for (int d = 0; d < dim; d++) {
      const double rough = check_random(&trial->seed, -1, 1), away = check_random(&trial->seed, -1, 1);
      c.v[d][p] = (options->periodic ? drift / (d + 1) : 0) + speed * (kind == 2 ? rough : kind ? smooth(particles, p, d) : 0);
      c.u[d][p] = kind == 2 ? 0.2 * strain * particles->half_length[d][p] * away : 0;
    }
    for (int k = 0; k < dim * dim; k++)
      c.F[k][p] = (k / dim == k % dim) + (kind == 2 ? strain * check_random(&trial->seed, -1, 1) : 0);
  }
  return c;
}

/* On a lattice the state moves from particle to particle; scattered particles move themselves. */
static size_t partner(const struct trial *trial, size_t p)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  const struct gx_particles *particles = simulation->particles;
  size_t there = 0, stride = 1, rest = p;
  for (int d = 0; d < particles->dim; d++) {
    const size_t points = (size_t)particles->lattice[d], k = rest % points;
    const size_t seen = trial->view.mirrored[d] ? points - 1 - k : k;
    there += (seen + (size_t)(trial->view.shift[d] * simulation->per_cell)) % points * stride;
    rest /= points;
    stride *= points;
  }
  return there;
}

static double sign_of(const struct trial *trial, int d)
{
  return trial->view.mirrored[d] ? -1 : 1;
}

static void move(struct trial *trial)
{
  struct gx_particles *particles = trial->rig.simulation.particles;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      double *X = &particles->X[d][p];
      if (trial->view.mirrored[d]) *X = 1 - *X;
      if (trial->view.shift[d]) {
        *X += (double)trial->view.shift[d] / trial->rig.simulation.space_options.cells[d];
        *X -= floor(*X);
      }
    }
}

static void shuffle(struct trial *trial)
{
  struct gx_particles *particles = trial->rig.simulation.particles;
  const size_t n = particles->n;
  size_t *order = malloc(n * sizeof *order);
  uint64_t seed = trial->seed;
  for (size_t p = 0; p < n; p++) {
    size_t other = (size_t)check_random(&seed, 0, (double)(p + 1));
    order[p] = order[other];
    order[other] = p;
  }
  rig_reorder(particles, order);
  for (size_t p = 0; p < n; p++) trial->slot[order[p]] = p;
  free(order);
}

static void see(struct trial *trial)
{
  const struct gx_particles *particles = trial->rig.simulation.particles;
  const bool lattice = particles->lattice[0] > 0;
  for (size_t p = 0; p < particles->n; p++) trial->slot[p] = lattice ? partner(trial, p) : p;
  if (!lattice) move(trial);
  if (trial->view.shuffled) shuffle(trial);
}

static void disturb(struct trial *trial)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  struct gx_particles *particles = simulation->particles;
  const double by = trial->view.disturbance, h = 1.0 / simulation->space_options.cells[0];
  uint64_t seed = (trial->seed ^ 0x5bd1e995) + (uint64_t)trial->view.draw;
  for (size_t p = 0; p < particles->n; p++) {
    for (int d = 0; d < particles->dim; d++) {
      particles->v[d][p] += by * speed * check_random(&seed, -1, 1);
      particles->u[d][p] += by * h * check_random(&seed, -1, 1);
    }
    for (int k = 0; k < particles->dim * particles->dim; k++) particles->F[k][p] += by * check_random(&seed, -1, 1);
    if (simulation->kind->collocation) continue; /* its sites are where they are */
    particles->m[p] *= 1 + by * check_random(&seed, -1, 1);
    particles->V0[p] *= 1 + by * check_random(&seed, -1, 1);
    for (int d = 0; d < particles->dim; d++) particles->X[d][p] += 0.1 * by * h * check_random(&seed, -1, 1);
  }
  if (!simulation->kind->collocation) memset(particles->lattice, 0, sizeof particles->lattice);
}

static void set_state(struct trial *trial, const struct condition *condition)
{
  struct gx_particles *particles = trial->rig.simulation.particles;
  const int dim = particles->dim;
  for (size_t p = 0; p < particles->n; p++) {
    const size_t s = trial->slot[p];
    for (int d = 0; d < dim; d++) {
      particles->v[d][s] = sign_of(trial, d) * condition->v[d][p];
      particles->u[d][s] = sign_of(trial, d) * condition->u[d][p];
      for (int e = 0; e < dim; e++)
        particles->F[d * dim + e][s] = sign_of(trial, d) * sign_of(trial, e) * condition->F[d * dim + e][p];
    }
  }
}

enum gx_status trial_build(struct trial *trial, const struct property_choice *choice, const int *value,
                           const struct trial_view *view)
{
  *trial = (struct trial){.one = trial_case(choice, value), .seed = (uint64_t)value[TRIAL_SEED] * 2654435761u + 1};
  if (view) trial->view = *view;
  if (trial->view.transfer && trial->one.value[GX_METHOD_TRANSFER].type == GX_TEXT) {
    case_set(&trial->one, GX_METHOD_TRANSFER, trial->view.transfer);
    case_set_real(&trial->one, GX_METHOD_FLIP, trial->view.flip);
  }
  struct rig *rig = &trial->rig;
  struct gx_simulation *simulation = &rig->simulation;
  rig->outcome = (struct gx_outcome){.status = GX_OK, .particle = -1};
  GX_TRY(gx_simulation_plan(simulation, &trial->one, &rig->outcome));
  box = *gx_problem_find("axis-aligned");
  box.exact = NULL;
  box.body = NULL;
  box.initial = at_rest;
  box.inside = trial->view.body > 0 ? is_inside : NULL;
  for (int d = 0; d < GX_MAX_DIM; d++) simulation->problem_options.body.size[d] = trial->view.body;
  if (trial->view.material) box.material = trial->view.material;
  simulation->problem = &box;
  GX_TRY(gx_simulation_lay_out(simulation, &rig->outcome));
  if (value[TRIAL_LAYOUT] == 2) {
    if (simulation->kind->collocation) return GX_REFUSED; /* its particles are a lattice */
    scatter(trial);
  }
  trial->slot = malloc(simulation->particles->n * sizeof *trial->slot);
  struct condition condition = condition_of(trial, value[TRIAL_STATE]);
  see(trial);
  enum gx_status status = gx_simulation_pose(simulation, &rig->outcome);
  set_state(trial, &condition);
  free(condition.block);
  if (trial->view.disturbance > 0) disturb(trial);
  if (status == GX_OK) status = gx_simulation_open(simulation, &rig->outcome);
  if (status != GX_OK) return status;
  rig->stepper = gx_stepper_create(simulation->clock, simulation->space, NULL);
  return GX_OK;
}

enum gx_status trial_step(struct trial *trial)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  return gx_stepper_step(trial->rig.stepper, trial->rig.steps++ * simulation->dt, simulation->dt);
}

void trial_settle(struct trial *trial)
{
  struct gx_space *space = trial->rig.simulation.space;
  if (space->kind->settle) space->kind->settle(space);
}

enum gx_status trial_run(struct trial *trial, const struct property_choice *choice, const int *value,
                         const struct trial_view *view)
{
  GX_TRY(trial_build(trial, choice, value, view));
  for (int k = 0; k < value[TRIAL_STEPS]; k++) GX_TRY(trial_step(trial));
  trial_settle(trial);
  return GX_OK;
}

void trial_free(struct trial *trial)
{
  rig_free(&trial->rig);
  free(trial->slot);
}

enum property_verdict trial_judge(const struct trial *trial, enum gx_status status, struct property_finding *finding)
{
  if (status == GX_OK) return property_judge(finding);
  if (status != GX_FAILED) return PROPERTY_SILENT;
  *finding = (struct property_finding){.measured = NAN};
  snprintf(finding->what, sizeof finding->what, "failed: %.140s", trial->rig.outcome.reason);
  return PROPERTY_BROKEN;
}

double trial_distance(const struct trial *a, const struct trial *b)
{
  const struct gx_particles *ours = a->rig.simulation.particles, *theirs = b->rig.simulation.particles;
  const double cells = a->rig.simulation.space_options.cells[0];
  const int dim = ours->dim;
  double worst = 0;
  for (size_t p = 0; p < ours->n; p++) {
    const size_t i = a->slot[p], j = b->slot[p];
    for (int d = 0; d < dim; d++) {
      const double sign = sign_of(a, d) * sign_of(b, d);
      double apart[2 + GX_MAX_DIM] = {(ours->v[d][i] - sign * theirs->v[d][j]) / speed,
                                      (ours->u[d][i] - sign * theirs->u[d][j]) * cells};
      for (int e = 0; e < dim; e++)
        apart[2 + e] = ours->F[d * dim + e][i] - sign * sign_of(a, e) * sign_of(b, e) * theirs->F[d * dim + e][j];
      for (int k = 0; k < 2 + dim; k++)
        if (!(fabs(apart[k]) <= worst)) worst = fabs(apart[k]); /* NaN too */
    }
  }
  return worst;
}

double trial_roundings(const struct trial *trial)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  const int support = simulation->space_options.degree + 2;
  const struct gx_mesh *mesh = case_on_grid(simulation->kind) ? (const struct gx_mesh *)simulation->space : NULL;
  const size_t points = mesh && mesh->reconstruction ? mesh->reconstruction->points->n : 0;
  return (double)(simulation->particles->n + points) + simulation->problem_options.dim * (10.0 * support + 6);
}

/* The full mass matrix loses the digits of its condition in nodal velocity, whose digits particles need not lose to the same
 * disturbance: theirs is in p and in M at once. */
static double nodal_distance(const struct trial *a, const struct trial *b)
{
  const struct gx_mesh *ours = (const struct gx_mesh *)a->rig.simulation.space;
  const struct gx_mesh *theirs = (const struct gx_mesh *)b->rig.simulation.space;
  double worst = 0;
  for (int d = 0; d < ours->grid.dim; d++)
    for (size_t i = 0; i < ours->grid.stored; i++) worst = fmax(worst, fabs(ours->v[d][i] - theirs->v[d][i]) / speed);
  return worst;
}

/* What a twin is apart at the end, as trial_distance says; NAN: it did not end. */
static double twin_distance(const struct trial *plain, const struct property_choice *choice, const int *value,
                            const struct trial_view *view)
{
  struct trial twin;
  const bool ended = trial_run(&twin, choice, value, view) == GX_OK;
  double distance = ended ? trial_distance(plain, &twin) : NAN;
  if (ended && plain->rig.simulation.space_options.consistent) distance += nodal_distance(plain, &twin);
  trial_free(&twin);
  return distance;
}

double trial_sensitivity(const struct trial *plain, const struct property_choice *choice, const int *value)
{
  enum { TWINS = 4 }; /* few particles may be disturbed, by chance, as the method does not feel it */
  struct trial_view view = plain->view;
  const struct gx_simulation *simulation = &plain->rig.simulation;
  double distance = 0;
  view.disturbance = disturbance;
  for (view.draw = 0; view.draw < TWINS && !isnan(distance); view.draw++) {
    const double apart = twin_distance(plain, choice, value, &view);
    if (!(apart <= distance)) distance = apart;
  }
  double each = 0x1p-53 * trial_roundings(plain);
  const bool above = simulation->problem_options.dim > 1;
  if (above && simulation->space_options.consistent) each += GX_MASS_CG_TOLERANCE;
  if (above && simulation->space_options.reconstructed)
    each /= sqrt(GX_LEAST_SQUARES_PIVOT); /* normal equations: the condition once more */
  return distance / disturbance * each * value[TRIAL_STEPS] * (simulation->clock->stages + 1);
}
