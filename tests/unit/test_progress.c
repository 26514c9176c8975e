/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress: what the line says, and when a plain one is due. */
#include <string.h>

#include "check.h"
#include "cli/progress.h"

static void the_time_left_follows_from_the_share_done(void **state)
{
  (void)state;
  const struct {
    double seconds;
    size_t done, total;
    const char *text;
  } line[] = {
      {10, 0, 40, "0 of 40 cases, 0 %"},
      {10, 10, 40, "10 of 40 cases, 25 %, about 30 s left"},
      {100, 40, 80, "40 of 80 cases, 50 %, about 1 min 40 s left"},
      {59.4, 1, 2, "1 of 2 cases, 50 %, about 59 s left"},
      {4800, 3, 12, "3 of 12 cases, 25 %, about 4 h 0 min left"},
      {7000, 2, 4, "2 of 4 cases, 50 %, about 1 h 56 min left"},
      {12, 7, 7, "7 of 7 cases, 100 %"},
  };
  struct gx_progress_line bare = {0}, named = {.what = "2 of 3, fig5"};
  char text[GX_PROGRESS_ROOM];
  for (size_t i = 0; i < sizeof line / sizeof *line; i++) {
    gx_progress_text(&bare, line[i].seconds, line[i].done, line[i].total, text);
    assert_string_equal(text, line[i].text);
  }
  gx_progress_text(&named, 1, 1, 1, text);
  assert_string_equal(text, "2 of 3, fig5: 1 of 1 cases, 100 %");
}

static void plain_lines_are_far_apart(void **state)
{
  (void)state;
  struct gx_progress_line line = {.start = 100, .shown = 100};
  assert_false(gx_progress_due(&line, 9.9, 50, 100)); /* a short run says nothing */
  assert_true(gx_progress_due(&line, 10, 10, 100));
  assert_false(gx_progress_due(&line, 10, 9, 100));
  assert_false(gx_progress_due(&line, 29, 9, 100));
  assert_true(gx_progress_due(&line, 30, 1, 100)); /* slow cases: half a minute */
  assert_false(gx_progress_due(&line, 1000, 100, 100));
  line = (struct gx_progress_line){.start = 100, .shown = 150, .tenth = 3};
  assert_false(gx_progress_due(&line, 59, 50, 100));
  assert_true(gx_progress_due(&line, 60, 40, 100));
  assert_false(gx_progress_due(&line, 60, 39, 100));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_time_left_follows_from_the_share_done),
      cmocka_unit_test(plain_lines_are_far_apart),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
