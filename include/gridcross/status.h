/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outcomes: how a case ended. A method that blows up is a result, not an abort. */
#ifndef GRIDCROSS_STATUS_H
#define GRIDCROSS_STATUS_H

enum gx_status {
  GX_OK,
  GX_LEFT_DOMAIN, /* a particle passed a fixed end */
  GX_TANGLED,     /* det F <= 0, or a particle domain outgrew its cell */
  GX_UNSTABLE,    /* kinetic energy far above the exact solution's, or all that there is, or not finite */
  GX_SINGULAR,    /* the consistent mass matrix is not positive definite */
  GX_REFUSED,     /* the combination of methods has no meaning; the reason says why */
  GX_FAILED,      /* an internal failure: out of memory, disk full */
  GX_CANCELLED,   /* its caller wants it no more: no result, and in no table */
  GX_STATUSES
};

enum { GX_REASON_LENGTH = 256 };

struct gx_outcome {
  enum gx_status status;
  long particle; /* index of the particle at fault, -1: none */
  char reason[GX_REASON_LENGTH];
};

/* "ok", "left-domain", ... as result.status prints them */
const char *gx_status_name(enum gx_status status);

/* Switches off GSL's error handler, which would end the program: what fails there becomes an outcome. Once, before anything is built
 * or run; gx_study_run does. */
void gx_status_quiet_gsl(void);

/* Fills outcome and returns status, so that a failure is reported by one statement. */
enum gx_status gx_status_set(struct gx_outcome *outcome, enum gx_status status, long particle, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Returns from the calling function unless the expression is GX_OK. */
#define GX_TRY(expression)                                                                                                       \
  do {                                                                                                                           \
    enum gx_status gx_try_status = (expression);                                                                                 \
    if (gx_try_status != GX_OK) return gx_try_status;                                                                            \
  } while (0)

#endif
