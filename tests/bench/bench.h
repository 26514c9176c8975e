/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every benchmark does: it tells the time, and sets parameters of a case. */
#ifndef GRIDCROSS_BENCH_BENCH_H
#define GRIDCROSS_BENCH_BENCH_H

#include <time.h>

#include <gridcross/parameter.h>

/* ns; of CLOCK_THREAD_CPUTIME_ID other programs take none. */
static inline double bench_now(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static inline struct gx_value bench_text(const char *value)
{
  return (struct gx_value){.type = GX_TEXT, .text = value};
}

static inline struct gx_value bench_integer(long value)
{
  return (struct gx_value){.type = GX_INTEGER, .integer = value};
}

static inline struct gx_value bench_real(double value)
{
  return (struct gx_value){.type = GX_REAL, .real = value};
}

#endif
