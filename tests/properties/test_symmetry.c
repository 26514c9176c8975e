/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two runs of the same particles seen otherwise are the same run: mirrored along any directions, moved by whole cells of a periodic box,
 * in another order. Every method promises it; strong form alone takes its particles in the order of their lattice. The bound is what
 * roundings grow to by the end of the run, measured with a disturbed twin. */
#include "trial.h"

#include <gridcross/status.h>

static const struct property_choice choices[] = {TRIAL_CHOICES, {"directions", 1, 7, NULL}, {NULL, 0, 0, NULL}};
enum { DIRECTIONS = TRIAL_SEED + 1 };

/* So sensitive a run cannot tell a difference from roundings. */
static const double blurred = 1e-6;

static enum property_verdict compare(const struct property *property, const int *value, const struct trial_view *view,
                                     struct property_finding *finding)
{
  struct trial plain, seen;
  enum gx_status status = trial_run(&plain, property->choice, value, NULL);
  const double bound = status == GX_OK ? trial_sensitivity(&plain, property->choice, value) : NAN;
  enum property_verdict verdict = trial_judge(&plain, status == GX_OK ? GX_UNSTABLE : status, finding); /* an internal failure */
  if (bound <= blurred) {
    const bool ended = trial_run(&seen, property->choice, value, view) == GX_OK;
    property_compare(finding, ended ? trial_distance(&plain, &seen) : NAN, bound, ended ? "" : seen.rig.outcome.reason);
    verdict = property_judge(finding);
    trial_free(&seen);
  }
  trial_free(&plain);
  return verdict;
}

/* Bits of the directions that there are, one of them at least. */
static bool goes(const int *value, int d)
{
  const int there = (1 << value[TRIAL_DIMENSION]) - 1, along = value[DIRECTIONS] & there;
  return (along ? along : 1) >> d & 1;
}

static enum property_verdict check_mirror(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial_view view = {.shuffled = false};
  for (int d = 0; d < value[TRIAL_DIMENSION]; d++) view.mirrored[d] = goes(value, d);
  return compare(property, value, &view, finding);
}

static enum property_verdict check_translation(const struct property *property, const int *value,
                                               struct property_finding *finding)
{
  struct trial_view view = {.shuffled = false};
  for (int d = 0; d < value[TRIAL_DIMENSION]; d++) view.shift[d] = goes(value, d) ? 1 + (value[TRIAL_SEED] + d) % 3 : 0;
  return compare(property, value, &view, finding);
}

static enum property_verdict check_order(const struct property *property, const int *value, struct property_finding *finding)
{
  return compare(property, value, &(struct trial_view){.shuffled = true}, finding);
}

static void mirror(void **state)
{
  (void)state;
  property_check(&(const struct property){"mirror", choices, 60, 20, check_mirror});
}

static void translation(void **state)
{
  (void)state;
  struct property_choice periodic[PROPERTY_CHOICES];
  memcpy(periodic, choices, sizeof choices);
  periodic[TRIAL_ENDS].most = 0;
  property_check(&(const struct property){"translation", periodic, 60, 20, check_translation});
}

static void order(void **state)
{
  (void)state;
  struct property_choice grids[PROPERTY_CHOICES];
  memcpy(grids, choices, sizeof choices);
  grids[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 1, trial_grids};
  property_check(&(const struct property){"order of particles", grids, 60, 20, check_order});
}

int main(void)
{
  gx_status_quiet_gsl();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mirror),
      cmocka_unit_test(translation),
      cmocka_unit_test(order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
