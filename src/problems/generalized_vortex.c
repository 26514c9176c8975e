/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Generalized vortex: each circle of a ring turns about the common centre as a whole, by the angle alpha(R, t) = g(t) h(R),
 *   h = (1 - 4 s^2)^2,  s = (R - (Ri + Ro)/2) / (Ro - Ri),  g = G sin(pi t/T),
 * of Kamojjala, Brannon, Sadeghirad and Guilkey 2015, whose h = 1 - 8 s^2 + 16 s^4 this is. h and its derivative vanish at both
 * radii, so that both faces of the ring are at rest and free of traction. With Q the rotation by alpha and e_R, e_Q (along the
 * circle) at the reference point, k = R alpha_R:
 *   F = Q (I + k e_Q e_R^T),  det F = 1,  P = mu (F - F^-T) = mu k Q (e_Q e_R^T + e_R e_Q^T),
 *   d2u/dt2 = Q (R alpha_tt e_Q - R alpha_t^2 e_R),  Div P = mu Q ((3 alpha_R + R alpha_RR) e_Q - R alpha_R^2 e_R),
 * and the body force is b = d2u/dt2 - Div P / rho0. lambda does not matter, since det F = 1. In 3-D every plane of a tube moves so,
 * whose flat faces are free of traction too. The paper's ring, 0.75 to 1.25 m, is 0.24 to 0.4 m here, with its centre in the middle
 * of the domain; T = 0.375/c is the paper's 1 s, scaled, to about a hundredth, for its modulus, density and Poisson's ratio of 0.3. */
#include <gridcross/problem.h>

#include <math.h>

extern const struct gx_material gx_neo_hookean;

static const double inner = 0.24, outer = 0.4, centre = 0.5;
static const double edge = 1e-12; /* m: round-off of points that are given in decimals */

static bool inside(const struct gx_problem_options *options, const double *X)
{
  (void)options;
  double R = hypot(X[0] - centre, X[1] - centre);
  return R >= inner - edge && R <= outer + edge;
}

/* A point's angle with its derivatives, and the turned directions across and along its circle. */
struct turned {
  double R;
  double alpha, by_R, by_RR; /* rad, rad/m, rad/m^2 */
  double by_t, by_tt;        /* rad/s, rad/s^2 */
  double across[2], along[2];
  double from[2]; /* e_R */
};

/* g and its derivatives with respect to time; rad, rad/s, rad/s^2. */
struct swing {
  double g, by_t, by_tt;
};

static struct swing swing_at(const struct gx_posed *posed, double t)
{
  double omega = 2 * M_PI * posed->speed / posed->problem->cycles; /* pi/T: one period is two T */
  double G = posed->options.rotation;
  return (struct swing){G * sin(omega * t), G * omega * cos(omega * t), -G * omega * omega * sin(omega * t)};
}

static struct turned turn(const struct gx_posed *posed, size_t p, const struct swing *swing)
{
  double x = posed->X[0][p] - centre, y = posed->X[1][p] - centre, R = hypot(x, y);
  double width = outer - inner, s = (R - 0.5 * (inner + outer)) / width, rest = 1 - 4 * s * s;
  double h = rest * rest;
  struct turned at = {
      .R = R,
      .alpha = swing->g * h,
      .by_R = swing->g * -16 * s * rest / width,
      .by_RR = swing->g * (192 * s * s - 16) / (width * width),
      .by_t = swing->by_t * h,
      .by_tt = swing->by_tt * h,
      .from = {x / R, y / R},
  };
  double cosine = cos(at.alpha), sine = sin(at.alpha);
  at.across[0] = cosine * at.from[0] - sine * at.from[1];
  at.across[1] = sine * at.from[0] + cosine * at.from[1];
  at.along[0] = -at.across[1];
  at.along[1] = at.across[0];
  return at;
}

/* Q (I + k e_Q e_R^T) = Q + k along e_R^T */
static void gradient(const struct turned *at, int dim, size_t p, double *const *F)
{
  double cosine = cos(at->alpha), sine = sin(at->alpha), k = at->R * at->by_R;
  const double Q[2][2] = {{cosine, -sine}, {sine, cosine}};
  for (int i = 0; i < dim; i++)
    for (int j = 0; j < dim; j++) F[i * dim + j][p] = i < 2 && j < 2 ? Q[i][j] + k * at->along[i] * at->from[j] : i == j;
}

/* The direction along the axis does not move. */
static void rest(int dim, size_t n, double *const *field)
{
  for (int d = 2; d < dim; d++)
    for (size_t p = 0; p < n && field; p++) field[d][p] = 0;
}

static void exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a)
{
  const int dim = posed->options.dim;
  const struct swing swing = swing_at(posed, t);
  for (size_t p = 0; p < posed->n; p++) {
    struct turned at = turn(posed, p, &swing);
    for (int d = 0; d < 2; d++) {
      if (u) u[d][p] = at.R * (at.across[d] - at.from[d]);
      if (v) v[d][p] = at.R * at.by_t * at.along[d];
      if (a) a[d][p] = at.R * (at.by_tt * at.along[d] - at.by_t * at.by_t * at.across[d]);
    }
    if (F) gradient(&at, dim, p, F);
  }
  rest(dim, posed->n, u);
  rest(dim, posed->n, v);
  rest(dim, posed->n, a);
}

static void body(const struct gx_posed *posed, double t, double *const *b)
{
  const struct swing swing = swing_at(posed, t);
  const double stiff = posed->options.moduli.mu / posed->options.moduli.density;
  for (size_t p = 0; p < posed->n; p++) {
    struct turned at = turn(posed, p, &swing);
    double along = at.R * at.by_tt - stiff * (3 * at.by_R + at.R * at.by_RR);
    double across = at.R * (stiff * at.by_R * at.by_R - at.by_t * at.by_t);
    for (int d = 0; d < 2; d++) b[d][p] = along * at.along[d] + across * at.across[d];
  }
  rest(posed->options.dim, posed->n, b);
}

const struct gx_problem gx_generalized_vortex = {
    .name = "generalized-vortex",
    .help = "the circles of a ring turn about its centre and back: large shear of a body that leaves cells partly filled",
    .source = "Kamojjala, Brannon, Sadeghirad & Guilkey 2015, Eng. with Computers 31:193-213",
    .material = &gx_neo_hookean,
    .min_dim = 2,
    .max_dim = 3,
    .standard = (const char *const[]){"problem.dimension=2", "problem.poisson=0.3", NULL},
    .has_poisson = true,
    .has_rotation = true,
    .boundaries = 1u << GX_BOUNDARY_FREE | 1u << GX_BOUNDARY_PERIODIC | 1u << GX_BOUNDARY_FIXED,
    .boundary = GX_BOUNDARY_FREE,
    .cycles = 0.75,
    .inside = inside,
    .exact = exact,
    .body = body,
};
