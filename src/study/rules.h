/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules that the parameter table refers to. */
#ifndef GRIDCROSS_STUDY_RULES_H
#define GRIDCROSS_STUDY_RULES_H

#include <gridcross/parameter.h>

/* Admissible texts: the i-th, NULL after the last. */
const char *gx_rules_problem_choice(int i);
const char *gx_rules_basis_choice(int i);
const char *gx_rules_clock_choice(int i);
const char *gx_rules_space_choice(int i);
const char *gx_rules_boundary_choice(int i);
const char *gx_rules_shape_choice(int i);
const char *gx_rules_variant_choice(int i);
const char *gx_rules_layout_choice(int i);
const char *gx_rules_mass_choice(int i);
const char *gx_rules_quadrature_choice(int i);
const char *gx_rules_transfer_choice(int i);
const char *gx_rules_position_choice(int i);
const char *gx_rules_projection_choice(int i);
const char *gx_rules_stress_choice(int i);
const char *gx_rules_frame_choice(int i);
const char *gx_rules_closure_choice(int i);
const char *gx_rules_divergence_choice(int i);
const char *gx_rules_landing_choice(int i);
const char *gx_rules_accumulate_choice(int i);
const char *gx_rules_measures_choice(int i);
const char *gx_rules_switch_choice(int i);

/* Whether a parameter applies to a case. value: [GX_PARAMETERS]. */
bool gx_rules_is_continuum(const struct gx_value *value);
bool gx_rules_is_collocation(const struct gx_value *value);
bool gx_rules_is_galerkin(const struct gx_value *value);
bool gx_rules_closure_applies(const struct gx_value *value);
bool gx_rules_divergence_applies(const struct gx_value *value);
bool gx_rules_interpolation_error_applies(const struct gx_value *value);
bool gx_rules_modulus_applies(const struct gx_value *value);
bool gx_rules_knot_applies(const struct gx_value *value);
bool gx_rules_jump_applies(const struct gx_value *value);
bool gx_rules_poisson_applies(const struct gx_value *value);
bool gx_rules_amplitude_applies(const struct gx_value *value);
bool gx_rules_flight_applies(const struct gx_value *value);
bool gx_rules_spin_applies(const struct gx_value *value);
bool gx_rules_rotation_applies(const struct gx_value *value);
bool gx_rules_gravity_applies(const struct gx_value *value);
bool gx_rules_body_applies(const struct gx_value *value);
bool gx_rules_file_applies(const struct gx_value *value);
bool gx_rules_size_applies(const struct gx_value *value);
bool gx_rules_radius_applies(const struct gx_value *value);
bool gx_rules_inner_radius_applies(const struct gx_value *value);
bool gx_rules_lattice_applies(const struct gx_value *value);
bool gx_rules_mode_applies(const struct gx_value *value);
bool gx_rules_directions_apply(const struct gx_value *value);
bool gx_rules_degree_applies(const struct gx_value *value);
bool gx_rules_particles_move(const struct gx_value *value);
bool gx_rules_jumps_apply(const struct gx_value *value);
bool gx_rules_flip_applies(const struct gx_value *value);
bool gx_rules_cfl_applies(const struct gx_value *value);
bool gx_rules_periods_applies(const struct gx_value *value);
bool gx_rules_landing_applies(const struct gx_value *value);

/* Defaults that follow from parameters before them in the table. */
struct gx_value gx_rules_boundary_default(const struct gx_value *value);
struct gx_value gx_rules_active_default(const struct gx_value *value);
struct gx_value gx_rules_phases_default(const struct gx_value *value);
struct gx_value gx_rules_velocity_default(const struct gx_value *value);
struct gx_value gx_rules_centre_default(const struct gx_value *value);
struct gx_value gx_rules_size_default(const struct gx_value *value);
struct gx_value gx_rules_shape_default(const struct gx_value *value);
struct gx_value gx_rules_degree_default(const struct gx_value *value);
struct gx_value gx_rules_closure_default(const struct gx_value *value);
struct gx_value gx_rules_dt_default(const struct gx_value *value);
struct gx_value gx_rules_end_default(const struct gx_value *value);
struct gx_value gx_rules_projection_default(const struct gx_value *value);

/* Whether a free text fits the case. */
bool gx_rules_active_well_formed(const char *text, const struct gx_value *value);
bool gx_rules_numbers_well_formed(const char *text, const struct gx_value *value); /* one a dimension */
bool gx_rules_place_well_formed(const char *text, const struct gx_value *value);   /* the same, from 0 to 1 */
bool gx_rules_edges_well_formed(const char *text, const struct gx_value *value);   /* the same, above 0 */
bool gx_rules_is_file_name(const char *text);

#endif
