/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of clocks. */
#include <gridcross/clock.h>

#include "../core/family.h"
#include "clock_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_clock gx_##member;
GX_FAMILY(gx_clock, gx_clock, GX_CLOCK_FAMILY)

/* The stage at that time, the last one or a new one. */
static struct gx_clock_stage *at(struct gx_clock_stage *stage, int *count, double time)
{
  if (stage[*count - 1].time != time) stage[(*count)++] = (struct gx_clock_stage){.time = time};
  return &stage[*count - 1];
}

static void move(struct gx_clock_stage *stage, double drift, double kicked)
{
  stage->drift += drift;
  stage->velocity_time = kicked;
}

static int stages_of_rows(const struct gx_row *rows, struct gx_clock_stage *stage)
{
  double drifted = 0, accelerated = 0, kicked = 0;
  int count = 1;
  bool opened = false; /* drifts are predictions */
  for (const struct gx_row *row = rows; row->primitive != GX_END; row++) {
    if (row->primitive == GX_ACCELERATE) accelerated = drifted;
    if (row->primitive == GX_OPEN || row->primitive == GX_CLOSE) move(at(stage, &count, drifted), row->coefficient, kicked);
    opened = opened || row->primitive == GX_OPEN;
    if (row->primitive == GX_KICK) {
      at(stage, &count, accelerated)->kick += row->coefficient;
      kicked += row->coefficient;
    }
    if (row->primitive != GX_DRIFT) continue;
    if (!opened) move(at(stage, &count, drifted), row->coefficient, kicked);
    drifted += row->coefficient;
  }
  return count;
}

int gx_clock_stages(const struct gx_clock *clock, bool plain, struct gx_clock_stage *stage)
{
  int count = 1;
  stage[0] = (struct gx_clock_stage){0};
  if (clock->rows) return stages_of_rows(plain && clock->plain_rows ? clock->plain_rows : clock->rows, stage);
  const struct gx_splitting *splitting = clock->splitting;
  if (splitting) {
    double drifted = splitting->drift[0], kicked = 0;
    move(&stage[0], drifted, 0);
    for (int j = 0; j < splitting->stages; j++) {
      kicked += splitting->kick[j];
      at(stage, &count, drifted)->kick += splitting->kick[j];
      move(&stage[count - 1], splitting->drift[j + 1], kicked);
      drifted += splitting->drift[j + 1];
    }
    return count;
  }
  for (int j = 0; j < clock->tableau->stages; j++) {
    const struct gx_tableau *tableau = clock->tableau;
    at(stage, &count, tableau->c[j])->kick += tableau->b[j];
    move(&stage[count - 1], tableau->b[j], tableau->c[j]);
  }
  return count;
}
