/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where transfers meet: FLIP with no share of it is PIC to the bit; a blend lies on the line between the two after a kick; and PIC is
 * FLIP where the grid holds all that the particles carry: as many functions as particles, and the full mass matrix. APIC has no such
 * limit but uniform motion, which is a property of its own. */
#include "trial.h"

/* One run with each of the transfers; other than GX_OK: of the first that did not end. */
static enum gx_status run_all(struct trial *trial, int count, const struct trial_view *view, const struct property *property,
                              const int *value)
{
  enum gx_status status = GX_OK;
  for (int i = 0; i < count; i++) {
    enum gx_status ended = trial_run(&trial[i], property->choice, value, &view[i]);
    if (status == GX_OK) status = ended;
  }
  return status;
}

static void free_all(struct trial *trial, int count)
{
  for (int i = 0; i < count; i++) trial_free(&trial[i]);
}

static enum property_verdict check_no_flip(const struct property *property, const int *value, struct property_finding *finding)
{
  const struct trial_view view[] = {{.transfer = "pic"}, {.transfer = "flip", .flip = 0}};
  struct trial trial[2];
  enum gx_status status = run_all(trial, 2, view, property, value);
  if (status == GX_OK) property_compare(finding, trial_distance(&trial[0], &trial[1]), 1e-300, "not the same bits");
  enum property_verdict verdict = trial_judge(&trial[0], status, finding);
  free_all(trial, 2);
  return verdict;
}

/* A clock of one kick, one step: v and u are affine in the share of FLIP, F does not depend on it. */
static enum property_verdict check_blend(const struct property *property, const int *value, struct property_finding *finding)
{
  const double share = 1 - 0.25 * value[TRIAL_DAMPING];
  const struct trial_view view[] = {{.transfer = "pic"}, {.transfer = "flip", .flip = 1}, {.transfer = "flip", .flip = share}};
  struct trial trial[3];
  enum gx_status status = run_all(trial, 3, view, property, value);
  if (status == GX_OK) {
    const struct gx_particles *pic = trial[0].rig.simulation.particles, *flip = trial[1].rig.simulation.particles;
    const struct gx_particles *blend = trial[2].rig.simulation.particles;
    double size = 0;
    for (int d = 0; d < blend->dim; d++)
      for (size_t p = 0; p < blend->n; p++) size = fmax(size, fmax(fabs(pic->v[d][p]), fabs(flip->v[d][p])));
    for (int d = 0; d < blend->dim; d++)
      for (size_t p = 0; p < blend->n; p++) {
        const double v = share * flip->v[d][p] + (1 - share) * pic->v[d][p];
        const double u = share * flip->u[d][p] + (1 - share) * pic->u[d][p];
        const double bound = 0x1p-53 * trial_roundings(&trial[2]) * size;
        property_compare(finding, fabs(blend->v[d][p] - v), bound, "velocity");
        property_compare(finding, fabs(blend->u[d][p] - u), bound, "displacement");
        for (int e = 0; e < blend->dim; e++) {
          const int k = d * blend->dim + e;
          property_compare(finding, fmax(fabs(blend->F[k][p] - flip->F[k][p]), fabs(blend->F[k][p] - pic->F[k][p])), 1e-300, "F");
        }
      }
  }
  enum property_verdict verdict = trial_judge(&trial[0], status, finding);
  free_all(trial, 3);
  return verdict;
}

/* S is square: S M^-1 S^T m v = v where it is not singular. */
static enum property_verdict check_all_held(const struct property *property, const int *value, struct property_finding *finding)
{
  const struct trial_view view[] = {{.transfer = "flip", .flip = 1}, {.transfer = "pic"}};
  struct trial trial[2];
  enum gx_status status = run_all(trial, 2, view, property, value);
  const double bound = status == GX_OK ? trial_sensitivity(&trial[0], property->choice, value) : NAN;
  if (status == GX_OK && bound < 1e-6) property_compare(finding, trial_distance(&trial[0], &trial[1]), bound, "PIC is not FLIP");
  enum property_verdict verdict = trial_judge(&trial[0], status == GX_OK && !(bound < 1e-6) ? GX_UNSTABLE : status, finding);
  free_all(trial, 2);
  return verdict;
}

static const struct property_choice choices[] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
static const char *const each_step[] = {"each-step", NULL};

static void choose(struct property_choice *on_grids)
{
  memcpy(on_grids, choices, sizeof choices);
  on_grids[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 1, trial_grids};
  on_grids[TRIAL_PROJECTION] = (struct property_choice){"method.projection", 0, 0, each_step};
}

static void no_share_of_flip(void **state)
{
  (void)state;
  struct property_choice on_grids[PROPERTY_CHOICES];
  choose(on_grids);
  property_check(&(const struct property){"no share of FLIP is PIC", on_grids, 60, 15, check_no_flip});
}

static void blend(void **state)
{
  (void)state;
  static const char *const euler[] = {"euler-stress-last", "euler-stress-first", NULL};
  struct property_choice on_grids[PROPERTY_CHOICES];
  choose(on_grids);
  on_grids[TRIAL_CLOCK] = (struct property_choice){"method.clock", 0, 1, euler};
  on_grids[TRIAL_DAMPING].least = 1;
  on_grids[TRIAL_DAMPING].most = 3;
  on_grids[TRIAL_STEPS].most = 1;
  property_check(&(const struct property){"a blend is between FLIP and PIC", on_grids, 80, 25, check_blend});
}

static void all_held(void **state)
{
  (void)state;
  static const char *const consistent[] = {"consistent", NULL}, *const particles[] = {"particles", NULL};
  struct property_choice on_grids[PROPERTY_CHOICES];
  choose(on_grids);
  on_grids[TRIAL_DIMENSION].most = 2;
  on_grids[TRIAL_PER_CELL].most = 1;
  on_grids[TRIAL_MASS] = (struct property_choice){"method.mass", 0, 0, consistent};
  on_grids[TRIAL_QUADRATURE] = (struct property_choice){"method.quadrature", 0, 0, particles};
  on_grids[TRIAL_ENDS].most = 0; /* periodic: a function a cell */
  property_check(&(const struct property){"PIC is FLIP where the grid holds all", on_grids, 80, 10, check_all_held});
}

int main(void)
{
  gx_status_quiet_gsl();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_share_of_flip),
      cmocka_unit_test(blend),
      cmocka_unit_test(all_held),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
