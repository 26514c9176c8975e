/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of outcomes, and reporting one. */
#include <gridcross/status.h>

#include <stdarg.h>
#include <stdio.h>

#include <gsl/gsl_errno.h>

const char *gx_status_name(enum gx_status status)
{
  static const char *const names[GX_STATUSES] = {
      [GX_OK] = "ok",
      [GX_LEFT_DOMAIN] = "left-domain",
      [GX_TANGLED] = "tangled",
      [GX_UNSTABLE] = "unstable",
      [GX_SINGULAR] = "singular",
      [GX_REFUSED] = "refused",
      [GX_FAILED] = "failed",
      [GX_CANCELLED] = "cancelled",
  };
  return names[status];
}

void gx_status_quiet_gsl(void)
{
  gsl_set_error_handler_off();
}

enum gx_status gx_status_set(struct gx_outcome *outcome, enum gx_status status, long particle, const char *format, ...)
{
  outcome->status = status;
  outcome->particle = particle;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(outcome->reason, sizeof outcome->reason, format, arguments);
  va_end(arguments);
  return status;
}
