/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An item's rows beside its study: ours, printed, ratio, gate, verdict. */
#include <gridcross/paper.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expression.h"
#include "gate.h"

enum { REASON_ROOM = 1024 }; /* embed.py lets a reason have 700 bytes */

enum verdict { MATCHES, MATCHES_CORRECTED, DIFFERS, HOLDS, SHOWN, MISSES, UNEXPLAINED, INVALID };

static const char *const verdict_name[] = {"matches", "matches corrected", "differs",     "holds",
                                           "shown",   "misses its gate",   "unexplained", "invalid"};

void gx_paper_name(const struct gx_paper_item *item, char name[GX_PAPER_NAME_LENGTH])
{
  snprintf(name, GX_PAPER_NAME_LENGTH, "%s/%s", item->paper, item->item);
}

/* Whether a gate is held against times, which measures between the steps blur. */
static bool has_gated_times(const struct gx_paper_item *item)
{
  for (size_t r = 0; r < item->rows; r++)
    if (strstr(item->row[r].value, "result.seconds") && strcmp(item->row[r].gate, "show") != 0) return true;
  return false;
}

struct gx_study *gx_paper_study(const struct gx_paper_item *item, FILE *errors)
{
  char name[GX_PAPER_NAME_LENGTH];
  gx_paper_name(item, name);
  struct gx_study *study = gx_runfile_parse(name, item->run_file, errors);
  if (study && has_gated_times(item)) study->repeats = 5;
  return study;
}

/* NaN for "", "*" and words. */
static double number(const char *text)
{
  char *end;
  double value = strtod(text, &end);
  return end != text && !*end ? value : NAN;
}

/* Half a unit of the last digit of a printed number: of 1.5e-2 it is 5e-4. */
static double rounding(const char *printed)
{
  int decimals = 0;
  bool after_point = false;
  const char *c = printed;
  for (c += strspn(c, "+-"); *c && *c != 'e' && *c != 'E'; c++) {
    decimals += after_point;
    after_point = after_point || *c == '.';
  }
  return 0.5 * pow(10, (*c ? atoi(c + 1) : 0) - decimals);
}

/* Whether ours agrees with a printed number: as closely as the gate asks, or within 10 % and the number's own rounding. */
static bool agrees(const struct gx_gate *gate, double ours, const char *printed)
{
  double target = number(printed);
  struct gx_gate held = *gate;
  held.target = target;
  if ((gate->kind == GX_GATE_RELATIVE || gate->kind == GX_GATE_FACTOR) && gx_gate_met(&held, ours)) return true;
  return fabs(ours - target) <= 0.1 * fabs(target) + rounding(printed);
}

static enum verdict judge_text(const struct gx_paper_row *row, const char *ours)
{
  const char *target = *row->corrected ? row->corrected : row->printed;
  if (!*target) return SHOWN;
  if (!strcmp(ours, target)) return *row->corrected ? MATCHES_CORRECTED : MATCHES;
  return strcmp(row->gate, "show") ? MISSES : *row->reason ? DIFFERS : UNEXPLAINED;
}

/* ours: NaN where our case has no result. */
static enum verdict judge(const struct gx_paper_row *row, struct gx_gate *gate, double ours)
{
  const char *target = *row->corrected ? row->corrected : row->printed;
  if (!gate->own_target) gate->target = number(target);
  if (!strcmp(target, "*"))
    return isnan(ours) ? *row->corrected ? MATCHES_CORRECTED : MATCHES : *row->reason ? DIFFERS : UNEXPLAINED;
  if (!gx_gate_met(gate, ours)) return MISSES;
  if (!*target) return isnan(ours) ? UNEXPLAINED : gate->kind == GX_GATE_SHOW ? SHOWN : HOLDS;
  double ratio = ours / number(row->printed);
  if (!*row->reason && !(ratio >= 0.5 && ratio <= 2)) return UNEXPLAINED;
  if (agrees(gate, ours, target)) return *row->corrected ? MATCHES_CORRECTED : MATCHES;
  return DIFFERS;
}

static struct gx_value text_value(const char *text)
{
  return (struct gx_value){.type = *text ? GX_TEXT : GX_NULL, .text = text};
}

/* A number as a number, a star or a word as text. */
static struct gx_value printed_value(const char *text)
{
  return isnan(number(text)) ? text_value(text) : gx_value_from(number(text));
}

enum column { PAPER, ITEM, ROW, QUANTITY, OURS, PRINTED, CORRECTED, RATIO, GATE, VERDICT, REASON, COLUMNS };

static const struct {
  const char *name;
  enum gx_type type;
} column[COLUMNS] = {
    [PAPER] = {"paper", GX_TEXT},         [ITEM] = {"item", GX_TEXT},     [ROW] = {"row", GX_TEXT},
    [QUANTITY] = {"quantity", GX_TEXT},   [OURS] = {"ours", GX_REAL},     [PRINTED] = {"printed", GX_REAL},
    [CORRECTED] = {"corrected", GX_REAL}, [RATIO] = {"ratio", GX_REAL},   [GATE] = {"gate", GX_TEXT},
    [VERDICT] = {"verdict", GX_TEXT},     [REASON] = {"reason", GX_TEXT},
};

static enum verdict compare(const struct gx_paper_row *row, const struct gx_table *study, struct gx_value value[COLUMNS],
                            char reason[REASON_ROOM])
{
  struct gx_expression ours = gx_expression_value(row->value, study);
  struct gx_gate gate;
  enum verdict verdict = INVALID;
  bool text = ours.value.type == GX_TEXT;
  double real = ours.value.type == GX_REAL ? ours.value.real : NAN;
  if (!*ours.reason && gx_gate_read(&gate, row->gate)) snprintf(ours.reason, sizeof ours.reason, "no gate '%s'", row->gate);
  if (!*ours.reason) verdict = text ? judge_text(row, ours.value.text) : judge(row, &gate, real);
  snprintf(reason, REASON_ROOM, "%s%s%s", *ours.reason ? ours.reason : row->reason, *row->reason && *ours.because ? "; " : "",
           ours.because);
  value[OURS] = text ? ours.value : gx_value_from(real);
  value[RATIO] = gx_value_from(real / number(row->printed));
  value[REASON] = text_value(reason);
  return verdict;
}

struct gx_table *gx_paper_compare(const struct gx_paper_item *item, const struct gx_table *study, size_t *missed)
{
  struct gx_table *table = gx_table_create(COLUMNS, item->rows);
  int failed = !table;
  *missed = 0;
  for (size_t c = 0; c < COLUMNS && !failed; c++) failed = gx_table_column(table, c, column[c].name, "", column[c].type);
  for (size_t r = 0; r < item->rows && !failed; r++) {
    const struct gx_paper_row *row = &item->row[r];
    char reason[REASON_ROOM];
    struct gx_value value[COLUMNS] = {
        [PAPER] = text_value(item->paper),
        [ITEM] = text_value(item->item),
        [ROW] = text_value(row->row),
        [QUANTITY] = text_value(row->quantity),
        [PRINTED] = printed_value(row->printed),
        [CORRECTED] = printed_value(row->corrected),
        [GATE] = text_value(row->gate),
    };
    enum verdict verdict = compare(row, study, value, reason);
    *missed += verdict >= MISSES;
    value[VERDICT] = text_value(verdict_name[verdict]);
    for (size_t c = 0; c < COLUMNS && !failed; c++) failed = gx_table_set(table, r, c, value[c]);
  }
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

size_t gx_paper_points(const struct gx_paper_item *item, const struct gx_table *study, const char *x, const char *y,
                       struct gx_plot_point *point)
{
  long column_x = gx_table_find(study, x);
  size_t count = 0, length = strlen(y);
  for (size_t r = 0; r < item->rows && column_x >= 0; r++) {
    const struct gx_paper_row *row = &item->row[r];
    struct gx_expression ours = gx_expression_value(row->value, study);
    const char *rest = row->value + length, *brace = strchr(row->value, '}');
    bool plain = !strncmp(row->value, y, length) && (!*rest || (*rest == '{' && brace && !brace[1]));
    if (!plain || ours.row < 0 || isnan(number(row->printed))) continue;
    struct gx_value value = gx_table_get(study, (size_t)ours.row, (size_t)column_x);
    if (value.type != GX_REAL && value.type != GX_INTEGER) continue;
    point[count++] =
        (struct gx_plot_point){.x = value.type == GX_REAL ? value.real : (double)value.integer, .y = number(row->printed)};
  }
  return count;
}
