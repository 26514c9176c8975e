/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What went wrong, in words. */
#include <gridcross_splines.h>

#include <stdarg.h>
#include <stdio.h>

const char *gx_spline_error_name(enum gx_spline_status status)
{
  static const char *const name[] = {
      [GX_SPLINE_OK] = "ok",
      [GX_SPLINE_DEGREE] = "degree",
      [GX_SPLINE_TOO_FEW] = "too-few",
      [GX_SPLINE_NOT_INCREASING] = "not-increasing",
      [GX_SPLINE_OUTSIDE] = "outside",
      [GX_SPLINE_SCHOENBERG_WHITNEY] = "schoenberg-whitney",
      [GX_SPLINE_SINGULAR] = "singular",
      [GX_SPLINE_MEMORY] = "memory",
  };
  return (unsigned)status < GX_SPLINE_STATUSES ? name[status] : "unknown";
}

enum gx_spline_status gx_spline_error_set(struct gx_spline_error *error, enum gx_spline_status status, long site,
                                          const char *format, ...)
{
  if (!error) return status;
  error->status = status;
  error->site = site;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(error->message, sizeof error->message, format, arguments);
  va_end(arguments);
  return status;
}
