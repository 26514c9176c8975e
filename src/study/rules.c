/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules that the parameter table refers to: choices, where parameters apply, defaults that depend on others, free texts. */
#include "rules.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <gridcross/basis.h>
#include <gridcross/clock.h>
#include <gridcross/problem.h>
#include <gridcross/space.h>

#include "number.h"

static const struct gx_problem *problem_of(const struct gx_value *value)
{
  return gx_problem_find(value[GX_PROBLEM_NAME].text);
}

static struct gx_value text_value(const char *text)
{
  return (struct gx_value){.type = GX_TEXT, .text = text};
}

static bool is_text(struct gx_value value, const char *text)
{
  return value.type == GX_TEXT && !strcmp(value.text, text);
}

/* Choices */

#define FAMILY_CHOICE(function, family)                                                                                          \
  const char *function(int i)                                                                                                    \
  {                                                                                                                              \
    return family[i] ? family[i]->name : NULL;                                                                                   \
  }
FAMILY_CHOICE(gx_rules_problem_choice, gx_problem_family)
FAMILY_CHOICE(gx_rules_basis_choice, gx_basis_family)
FAMILY_CHOICE(gx_rules_clock_choice, gx_clock_family)

/* Spaces that belong to one problem are no choice. */
const char *gx_rules_space_choice(int i)
{
  for (const struct gx_space_kind *const *kind = gx_space_family; *kind; kind++)
    if (!(*kind)->of_problem && i-- == 0) return (*kind)->name;
  return NULL;
}

#define CHOICE(function, ...)                                                                                                    \
  const char *function(int i)                                                                                                    \
  {                                                                                                                              \
    static const char *const texts[] = {__VA_ARGS__, NULL};                                                                      \
    return texts[i];                                                                                                             \
  }
CHOICE(gx_rules_shape_choice, "box", "disk", "ring", "points")
CHOICE(gx_rules_variant_choice, "printed", "corrected")
CHOICE(gx_rules_layout_choice, "uniform", "gauss")
CHOICE(gx_rules_mass_choice, "lumped", "consistent")
CHOICE(gx_rules_quadrature_choice, "particles", "reconstructed")
CHOICE(gx_rules_transfer_choice, "flip", "pic", "apic")
CHOICE(gx_rules_position_choice, "nodal", "particle")
CHOICE(gx_rules_projection_choice, "each-step", "once")
CHOICE(gx_rules_stress_choice, "F", "rate")
CHOICE(gx_rules_frame_choice, "current", "reference")
CHOICE(gx_rules_closure_choice, "papers", "symmetric")
CHOICE(gx_rules_divergence_choice, "exact", "papers")
CHOICE(gx_rules_landing_choice, "exact", "past")
CHOICE(gx_rules_accumulate_choice, "product", "sum", "compensated")
CHOICE(gx_rules_measures_choice, "final", "max", "all")
CHOICE(gx_rules_switch_choice, "no", "yes")

const char *gx_rules_boundary_choice(int i)
{
  return gx_problem_boundary[i];
}

/* Where parameters apply */

bool gx_rules_is_continuum(const struct gx_value *value)
{
  return !problem_of(value)->space;
}

static const struct gx_space_kind *space_of(const struct gx_value *value)
{
  return value[GX_METHOD_SPACE].type == GX_TEXT ? gx_space_find(value[GX_METHOD_SPACE].text) : NULL;
}

bool gx_rules_is_collocation(const struct gx_value *value)
{
  const struct gx_space_kind *space = space_of(value);
  return gx_rules_is_continuum(value) && space && space->collocation;
}

bool gx_rules_is_galerkin(const struct gx_value *value)
{
  return gx_rules_is_continuum(value) && !gx_rules_is_collocation(value);
}

bool gx_rules_closure_applies(const struct gx_value *value)
{
  return gx_rules_is_collocation(value) && is_text(value[GX_PROBLEM_BOUNDARY], "fixed");
}

bool gx_rules_divergence_applies(const struct gx_value *value)
{
  return gx_rules_is_collocation(value) && is_text(value[GX_METHOD_FRAME], "current");
}

bool gx_rules_interpolation_error_applies(const struct gx_value *value)
{
  return problem_of(value)->has_interpolation_error;
}

bool gx_rules_modulus_applies(const struct gx_value *value)
{
  return problem_of(value)->material->piola;
}

bool gx_rules_knot_applies(const struct gx_value *value)
{
  return problem_of(value)->has_knots;
}

bool gx_rules_jump_applies(const struct gx_value *value)
{
  return problem_of(value)->has_jump;
}

bool gx_rules_poisson_applies(const struct gx_value *value)
{
  return problem_of(value)->has_poisson;
}

bool gx_rules_amplitude_applies(const struct gx_value *value)
{
  return problem_of(value)->has_amplitude;
}

bool gx_rules_flight_applies(const struct gx_value *value)
{
  return problem_of(value)->has_flight;
}

bool gx_rules_spin_applies(const struct gx_value *value)
{
  return problem_of(value)->has_spin && value[GX_PROBLEM_DIMENSION].integer > 1;
}

bool gx_rules_rotation_applies(const struct gx_value *value)
{
  return problem_of(value)->has_rotation;
}

bool gx_rules_gravity_applies(const struct gx_value *value)
{
  return problem_of(value)->has_gravity;
}

bool gx_rules_body_applies(const struct gx_value *value)
{
  return problem_of(value)->has_body;
}

static bool has_shape(const struct gx_value *value, const char *shape)
{
  return problem_of(value)->has_body && is_text(value[GX_BODY_SHAPE], shape);
}

bool gx_rules_file_applies(const struct gx_value *value)
{
  return has_shape(value, "points");
}

bool gx_rules_size_applies(const struct gx_value *value)
{
  return has_shape(value, "box");
}

bool gx_rules_radius_applies(const struct gx_value *value)
{
  return has_shape(value, "disk") || has_shape(value, "ring");
}

bool gx_rules_inner_radius_applies(const struct gx_value *value)
{
  return has_shape(value, "ring");
}

/* A list of particles needs no lattice. */
bool gx_rules_lattice_applies(const struct gx_value *value)
{
  return gx_rules_is_continuum(value) && !has_shape(value, "points");
}

bool gx_rules_mode_applies(const struct gx_value *value)
{
  return problem_of(value)->has_mode;
}

bool gx_rules_directions_apply(const struct gx_value *value)
{
  return problem_of(value)->has_directions;
}

bool gx_rules_degree_applies(const struct gx_value *value)
{
  if (gx_rules_is_collocation(value)) return true;
  return value[GX_METHOD_BASIS].type == GX_TEXT && gx_basis_find(value[GX_METHOD_BASIS].text)->has_degree;
}

/* Particles that only sample the nodal field carry no velocity of their own. */
bool gx_rules_particles_move(const struct gx_value *value)
{
  const struct gx_space_kind *space = space_of(value);
  return space && !space->collocation && (space->fixed_grid || !is_text(value[GX_METHOD_PROJECTION], "once"));
}

bool gx_rules_jumps_apply(const struct gx_value *value)
{
  const char *own = problem_of(value)->space;
  const struct gx_space_kind *space = own ? gx_space_find(own) : space_of(value);
  return space && space->fixed_grid;
}

bool gx_rules_flip_applies(const struct gx_value *value)
{
  return gx_rules_particles_move(value) && is_text(value[GX_METHOD_TRANSFER], "flip");
}

bool gx_rules_cfl_applies(const struct gx_value *value)
{
  return value[GX_TIME_DT].type == GX_NULL && gx_rules_is_continuum(value);
}

bool gx_rules_periods_applies(const struct gx_value *value)
{
  bool counted = value[GX_TIME_END].type != GX_NULL || value[GX_TIME_STEPS].type != GX_NULL;
  return !counted && problem_of(value)->cycles > 0;
}

/* A number of steps lands where it does. */
bool gx_rules_landing_applies(const struct gx_value *value)
{
  return value[GX_TIME_STEPS].type == GX_NULL;
}

/* Defaults that depend on other parameters */

struct gx_value gx_rules_boundary_default(const struct gx_value *value)
{
  return text_value(gx_problem_boundary[problem_of(value)->boundary]);
}

struct gx_value gx_rules_active_default(const struct gx_value *value)
{
  static const char *const all[] = {"x", "xy", "xyz"};
  return text_value(all[value[GX_PROBLEM_DIMENSION].integer - 1]);
}

/* A text of one number a dimension. */
#define VECTOR(function, one, two, three)                                                                                        \
  struct gx_value function(const struct gx_value *value)                                                                         \
  {                                                                                                                              \
    static const char *const texts[] = {one, one " " two, one " " two " " three};                                                \
    return text_value(texts[value[GX_PROBLEM_DIMENSION].integer - 1]);                                                           \
  }
VECTOR(gx_rules_phases_default, "0", "0", "0")
VECTOR(gx_rules_velocity_default, "1", "0.5", "0.25")
VECTOR(gx_rules_centre_default, "0.5", "0.5", "0.5")
VECTOR(gx_rules_size_default, "0.5", "0.5", "0.5")

struct gx_value gx_rules_shape_default(const struct gx_value *value)
{
  return text_value(value[GX_BODY_FILE].type == GX_TEXT ? "points" : "box");
}

struct gx_value gx_rules_degree_default(const struct gx_value *value)
{
  return (struct gx_value){.type = GX_INTEGER, .integer = gx_rules_is_collocation(value) ? 5 : 2};
}

struct gx_value gx_rules_closure_default(const struct gx_value *value)
{
  return text_value(is_text(value[GX_METHOD_FRAME], "reference") ? "symmetric" : "papers");
}

/* Without cells there is no CFL number. */
struct gx_value gx_rules_dt_default(const struct gx_value *value)
{
  return gx_rules_is_continuum(value) ? (struct gx_value){.type = GX_NULL} : (struct gx_value){.type = GX_REAL, .real = 1e-3};
}

/* Without a period there is no number of periods. */
struct gx_value gx_rules_end_default(const struct gx_value *value)
{
  const struct gx_problem *problem = problem_of(value);
  if (problem->cycles > 0 || value[GX_TIME_STEPS].type != GX_NULL) return (struct gx_value){.type = GX_NULL};
  return (struct gx_value){.type = GX_REAL, .real = value[GX_TIME_START].real + problem->end};
}

struct gx_value gx_rules_projection_default(const struct gx_value *value)
{
  return text_value(space_of(value)->fixed_grid ? "each-step" : "once");
}

/* Free texts */

bool gx_rules_active_well_formed(const char *text, const struct gx_value *value)
{
  char last = 'x' - 1, end = (char)('x' + value[GX_PROBLEM_DIMENSION].integer);
  const char *s = text;
  for (; *s > last && *s < end; s++) last = *s;
  return *text && !*s;
}

/* Whether the text is one number a dimension, each from least to most. */
static bool are_numbers(const char *text, const struct gx_value *value, double least, double most)
{
  long numbers = 0;
  while (*(text += strspn(text, " "))) {
    char word[64];
    double number;
    size_t length = strcspn(text, " ");
    if (length >= sizeof word) return false;
    memcpy(word, text, length);
    word[length] = '\0';
    if (gx_number_real(word, &number) || number < least || number > most) return false;
    text += length;
    numbers++;
  }
  return numbers == value[GX_PROBLEM_DIMENSION].integer;
}

bool gx_rules_numbers_well_formed(const char *text, const struct gx_value *value)
{
  return are_numbers(text, value, -INFINITY, INFINITY);
}

bool gx_rules_place_well_formed(const char *text, const struct gx_value *value)
{
  return are_numbers(text, value, 0, 1);
}

bool gx_rules_edges_well_formed(const char *text, const struct gx_value *value)
{
  return are_numbers(text, value, DBL_MIN, 1);
}

/* Not empty, and fit for messages. */
bool gx_rules_is_file_name(const char *text)
{
  const char *s = text;
  while ((unsigned char)*s >= 0x20 && *s != 0x7F) s++;
  return *text && !*s;
}
