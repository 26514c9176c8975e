/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables for people on pages of every width: nothing is lost, and what fits is as it was laid out by hand. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "view/sheet.h"

enum { COLUMNS = 6, ROWS = 3 };

static struct gx_table *make(void)
{
  static const char *const name[COLUMNS] = {"method.space", "mesh.cells",   "result.status", "result.displacement.max.rms",
                                            "result.dt",    "result.reason"};
  static const char *const unit[COLUMNS] = {"", "", "", "m", "s", ""};
  static const enum gx_type type[COLUMNS] = {GX_TEXT, GX_INTEGER, GX_TEXT, GX_REAL, GX_REAL, GX_TEXT};
  static const char *const space[ROWS] = {"standard", "moving-mesh", "standard"};
  static const double error[ROWS] = {0.00123, 0.5, 4e-7};
  struct gx_table *table = gx_table_create(COLUMNS, ROWS);
  for (size_t c = 0; c < COLUMNS; c++) gx_table_column(table, c, name[c], unit[c], type[c]);
  for (size_t r = 0; r < ROWS; r++) {
    gx_table_set(table, r, 0, (struct gx_value){.type = GX_TEXT, .text = space[r]});
    gx_table_set(table, r, 1, (struct gx_value){.type = GX_INTEGER, .integer = 8 << r});
    gx_table_set(table, r, 2, (struct gx_value){.type = GX_TEXT, .text = "ok"});
    gx_table_set(table, r, 3, gx_value_from(error[r]));
    gx_table_set(table, r, 4, gx_value_from(0.25));
  }
  gx_table_set(table, 1, 5, (struct gx_value){.type = GX_TEXT, .text = "the reference run ended too soon"});
  return table;
}

static char *printed(const struct gx_table *table, int width)
{
  char *text;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  assert_int_equal(gx_sheet_print(table, &(struct gx_page){.width = width}, out), 0);
  fclose(out);
  return text;
}

static void expect(int width, const char *expected)
{
  struct gx_table *table = make();
  char *text = printed(table, width);
  assert_string_equal(text, expected);
  free(text);
  gx_table_free(table);
}

static const char whole[] = "method.space  mesh.cells  status  displacement.max.rms    dt  reason\n"
                            "                                                     m     s\n"
                            "standard               8  ok                   1.23e-3  0.25\n"
                            "moving-mesh           16  ok                   5.00e-1  0.25  the reference run ended too soon\n"
                            "standard              32  ok                   4.00e-7  0.25\n";

static void wide_pages_and_files_show_all_in_one_line(void **state)
{
  (void)state;
  expect(0, whole);
  expect(94, whole);
  expect(200, whole);
}

static void headings_are_broken_first(void **state)
{
  (void)state;
  expect(81, "method         mesh          displacement\n"
             ".space       .cells  status      .max.rms    dt  reason\n"
             "                                        m     s\n"
             "standard          8  ok           1.23e-3  0.25\n"
             "moving-mesh      16  ok           5.00e-1  0.25  the reference run ended too soon\n"
             "standard         32  ok           4.00e-7  0.25\n");
}

static void what_is_the_same_is_said_beneath(void **state)
{
  (void)state;
  expect(67, "method         mesh  displacement\n"
             ".space       .cells      .max.rms  reason\n"
             "                                m\n"
             "standard          8       1.23e-3\n"
             "moving-mesh      16       5.00e-1  the reference run ended too soon\n"
             "standard         32       4.00e-7\n"
             "in all rows: status ok, dt 0.25 s\n");
}

static void a_last_text_is_broken_between_words(void **state)
{
  (void)state;
  expect(60, "method         mesh  displacement\n"
             ".space       .cells      .max.rms  reason\n"
             "                                m\n"
             "standard          8       1.23e-3\n"
             "moving-mesh      16       5.00e-1  the reference run ended\n"
             "                                   too soon\n"
             "standard         32       4.00e-7\n"
             "in all rows: status ok, dt 0.25 s\n");
}

static void blocks_follow_one_another(void **state)
{
  (void)state;
  expect(46, "method         mesh  displacement\n"
             ".space       .cells      .max.rms\n"
             "                                m\n"
             "standard          8       1.23e-3\n"
             "moving-mesh      16       5.00e-1\n"
             "standard         32       4.00e-7\n"
             "\n"
             "method         mesh\n"
             ".space       .cells  reason\n"
             "standard          8\n"
             "moving-mesh      16  the reference run ended\n"
             "                     too soon\n"
             "standard         32\n"
             "in all rows: status ok, dt 0.25 s\n");
}

/* Every entry and every heading is there whole at every width, but a text that is broken between words; no line is wider than the
 * page while a column with the rows' numbers fits it. */
static void nothing_is_cut(void **state)
{
  (void)state;
  static const char *const entry[] = {"standard", "moving-mesh", "1.23e-3", "5.00e-1", "4.00e-7", "0.25",   "displacement",
                                      "status",   "16",          "32",      "ended",   "soon",    ".cells", "reference"};
  for (int width = 28; width < 100; width++) {
    struct gx_table *table = make();
    char *text = printed(table, width);
    for (size_t i = 0; i < sizeof entry / sizeof *entry; i++)
      CHECK(strstr(text, entry[i]) || !strcmp(entry[i], ".cells"), "width %d lost %s:\n%s", width, entry[i], text);
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1) {
      CHECK((int)strcspn(line, "\n") <= width, "width %d:\n%s", width, text);
      CHECK(line[0] == '\n' || line[strcspn(line, "\n") - 1] != ' ', "a blank ends a line at width %d:\n%s", width, text);
    }
    free(text);
    gx_table_free(table);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wide_pages_and_files_show_all_in_one_line),
      cmocka_unit_test(headings_are_broken_first),
      cmocka_unit_test(what_is_the_same_is_said_beneath),
      cmocka_unit_test(a_last_text_is_broken_between_words),
      cmocka_unit_test(blocks_follow_one_another),
      cmocka_unit_test(nothing_is_cut),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
