/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross paper: published tables and figures beside ours. */
#include "command.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/paper.h>
#include <gridcross/store.h>

#include "../core/nearest.h"
#include "../view/sheet.h"
#include "progress.h"

static const struct gx_option option[] = {
    {0, "list", NULL, "name the items and what they are"},
    {'o', "output", "DIR", "keep each item's study there, and draw its figure"},
    {'j', "jobs", "N", "threads: cases at once, longest first, and within long 2-D and 3-D cases; default: the processors"},
    {0, "csv", NULL, "print all rows as CSV"},
    {0, "json", NULL, "print all rows as JSON"},
    {'q', "quiet", NULL, "no progress on standard error"},
    {0},
};

/* What a command does over its items. */
struct session {
  const struct gx_options *options;
  size_t jobs, count;
  const struct gx_paper_item *item[256];
  struct gx_table *table[256]; /* rows of each item, owned */
  size_t missed;               /* rows that miss their gate or cannot be judged */
};

static bool is_selected(const struct gx_paper_item *item, const char *operand)
{
  char name[GX_PAPER_NAME_LENGTH];
  gx_paper_name(item, name);
  return !strcmp(operand, item->paper) || !strcmp(operand, name);
}

static void suggest(const char *operand)
{
  struct gx_nearest near = {.word = operand};
  for (size_t i = 0; i < gx_paper_item_count; i++) {
    char name[GX_PAPER_NAME_LENGTH];
    gx_paper_name(&gx_paper_items[i], name);
    gx_nearest_try(&near, gx_paper_items[i].paper);
    gx_nearest_try(&near, name);
  }
  fprintf(stderr, "gridcross paper: no paper or item '%s'", operand);
  if (*near.best) fprintf(stderr, ": did you mean %s?", near.best);
  fputs(*near.best ? "\n" : "; see gridcross paper --list\n", stderr);
}

/* Items in their own order, whatever the order of the operands; without operands all of them. */
static int select_items(struct session *session)
{
  const struct gx_options *options = session->options;
  int code = GX_EXIT_DONE;
  for (size_t o = 0; o < options->operands; o++) {
    bool known = false;
    for (size_t i = 0; i < gx_paper_item_count; i++) known = known || is_selected(&gx_paper_items[i], options->operand[o]);
    if (known) continue;
    suggest(options->operand[o]);
    code = GX_EXIT_USAGE;
  }
  for (size_t i = 0; i < gx_paper_item_count; i++) {
    bool wanted = !options->operands;
    for (size_t o = 0; o < options->operands; o++) wanted = wanted || is_selected(&gx_paper_items[i], options->operand[o]);
    if (wanted && session->count < sizeof session->item / sizeof *session->item)
      session->item[session->count++] = &gx_paper_items[i];
  }
  return code;
}

static int list_items(const struct session *session)
{
  for (size_t i = 0; i < session->count; i++) {
    char name[GX_PAPER_NAME_LENGTH];
    struct gx_study *study = gx_paper_study(session->item[i], stderr);
    if (!study) return GX_EXIT_FAILED;
    gx_paper_name(session->item[i], name);
    printf("%-26s%4zu rows  %s\n", name, session->item[i]->rows, study->title);
    gx_runfile_free(study);
  }
  return GX_EXIT_DONE;
}

/* DIR/<paper>-<item><ending>, owned by the caller. */
static char *place(const struct session *session, size_t index, const char *ending)
{
  const char *directory = gx_options_value(session->options, "output");
  const struct gx_paper_item *item = session->item[index];
  size_t room = strlen(directory) + strlen(item->paper) + strlen(item->item) + strlen(ending) + 3;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s/%s-%s%s", directory, item->paper, item->item, ending);
  return path;
}

/* What is wrong with a place of a study is said before the first case runs. */
static int prepare_all(const struct session *session)
{
  int code = GX_EXIT_DONE;
  for (size_t i = 0; gx_options_value(session->options, "output") && i < session->count && !code; i++) {
    char *directory = place(session, i, ".study");
    if (!directory) return gx_command_no_memory();
    if (gx_store_prepare(directory, stderr)) code = GX_EXIT_FAILED;
    free(directory);
  }
  return code;
}

/* The printed values of what the figure shows. Returns how many, or -1 when memory runs out. */
static long find_points(const struct gx_paper_item *item, const struct gx_options *options, const struct gx_table *table,
                        struct gx_plot_point **point)
{
  const char *x = gx_options_value(options, "x"), *y = gx_options_value(options, "y");
  *point = calloc(item->rows + 1, sizeof **point);
  if (!*point) return -1;
  return x && y ? (long)gx_paper_points(item, table, x, y, *point) : 0;
}

/* Draws as `gridcross plot STUDY <words> -o FIGURE` does, printed values over ours. words, study, figure: written to. */
static int draw(const struct gx_paper_item *item, char *words, char *study, char *figure, const struct gx_table *table)
{
  enum { WORDS = 32 };
  char program[] = "gridcross", plot[] = "plot", to[] = "-o", *rest = NULL;
  char *argv[WORDS + 2] = {program, plot, study};
  int argc = 3;
  for (char *word = strtok_r(words, " ", &rest); word && argc < WORDS; word = strtok_r(NULL, " ", &rest)) argv[argc++] = word;
  argv[argc++] = to;
  argv[argc++] = figure;
  struct gx_options options;
  struct gx_plot_point *point = NULL;
  int code = gx_options_parse(&options, &gx_command_plot, argc, argv, stderr);
  long points = code ? 0 : find_points(item, &options, table, &point);
  if (!code) code = points < 0 ? gx_command_no_memory() : gx_command_plot_figure(&options, (size_t)points, point);
  gx_options_free(&options);
  free(point);
  return code;
}

/* One figure a line of the item's plot: <item>.svg, <item>-2.svg, ... */
static int draw_all(const struct session *session, size_t index, char *study, const struct gx_table *table)
{
  char *lines = strdup(session->item[index]->plot), *rest = NULL;
  int code = lines ? GX_EXIT_DONE : gx_command_no_memory(), number = 1;
  for (char *line = lines ? strtok_r(lines, "\n", &rest) : NULL; line && !code; line = strtok_r(NULL, "\n", &rest)) {
    char ending[24];
    snprintf(ending, sizeof ending, number > 1 ? "-%d.svg" : ".svg", number);
    char *figure = place(session, index, ending);
    code = figure ? draw(session->item[index], line, study, figure, table) : gx_command_no_memory();
    number++;
    free(figure);
  }
  free(lines);
  return code;
}

static int keep(const struct session *session, size_t index, const struct gx_study *study, const struct gx_result *results,
                const struct gx_table *table)
{
  char *directory = place(session, index, ".study"), *line = gx_options_line(session->options);
  int code = directory && line ? GX_EXIT_DONE : gx_command_no_memory();
  const struct gx_store_run about = {.command = line};
  if (!code && gx_store_write(directory, study, results, &about, stderr)) code = GX_EXIT_FAILED;
  if (!code) code = draw_all(session, index, directory, table);
  free(directory);
  free(line);
  return code;
}

/* Notes are numbered by distinct reason. Returns the number of row's, 0: none. */
static size_t note_of(const struct gx_table *table, size_t reason, size_t row)
{
  size_t note = 0;
  struct gx_value wanted = gx_table_get(table, row, reason);
  if (wanted.type != GX_TEXT) return 0;
  for (size_t r = 0; r <= row; r++) {
    struct gx_value value = gx_table_get(table, r, reason);
    bool first = value.type == GX_TEXT;
    for (size_t before = 0; before < r && first; before++)
      first = gx_value_compare(gx_table_get(table, before, reason), value) != 0;
    note += first;
    if (first && !gx_value_compare(value, wanted)) break;
  }
  return note;
}

enum { ROW, QUANTITY, OURS, PRINTED, CORRECTED, RATIO, GATE, VERDICT, NOTE, SHOWN };

static int set_text(struct gx_table *sheet, size_t row, size_t column, const char *text)
{
  return *text ? gx_table_set(sheet, row, column, (struct gx_value){.type = GX_TEXT, .text = text}) : 0;
}

/* Significant digits of a number of the paper, or of the figure that a gate names last: 5 of "1.7895e-2". */
static int digits_of(const char *text)
{
  int digits = 0;
  const char *word = strrchr(text, ' ');
  for (const char *c = word ? word + 1 : text; *c && *c != 'e' && *c != 'E'; c++)
    digits += isdigit((unsigned char)*c) && (digits || *c != '0');
  return digits;
}

/* With a digit more than the paper has, as papers print them: 1.731e-4, but 0.01731 and 173.1. */
static const char *short_number(struct gx_value value, const struct gx_paper_row *row, char text[GX_NUMBER_LENGTH])
{
  int digits = 3, more = digits_of(row->printed), gate = strstr(row->gate, " of ") ? digits_of(row->gate) : 0;
  if (value.type == GX_TEXT) return value.text;
  if (gate > more) more = gate;
  if (more + 1 > digits) digits = more + 1 < 8 ? more + 1 : 8;
  double size = fabs(value.real);
  bool plain = size == 0 || (size >= 0.01 && size < 1e5);
  snprintf(text, GX_NUMBER_LENGTH, plain ? "%.*g" : "%.*e", plain ? digits : digits - 1, value.real);
  gx_sheet_shorten(text);
  return text;
}

/* 1.0000 where four decimals say it. */
static const char *ratio_text(struct gx_value ratio, char text[GX_NUMBER_LENGTH])
{
  snprintf(text, GX_NUMBER_LENGTH, fabs(ratio.real) >= 0.1 && fabs(ratio.real) < 10 ? "%.4f" : "%.3g", ratio.real);
  gx_sheet_shorten(text);
  return text;
}

/* Numbers of the paper stand as they are printed. */
static struct gx_table *brief(const struct gx_paper_item *item, const struct gx_table *table, size_t reason)
{
  static const char *const name[SHOWN] = {"row", "quantity", "ours", "printed", "corrected", "ratio", "gate", "verdict", "note"};
  struct gx_table *sheet = gx_table_create(SHOWN, table->rows);
  size_t ours = (size_t)gx_table_find(table, "ours"), ratio = (size_t)gx_table_find(table, "ratio");
  int failed = !sheet || gx_table_copy(sheet, VERDICT, table, (size_t)gx_table_find(table, "verdict"));
  for (size_t c = 0; c < SHOWN && !failed; c++)
    failed = gx_table_column(sheet, c, name[c], "", c == NOTE ? GX_INTEGER : c >= OURS && c <= RATIO ? GX_REAL : GX_TEXT);
  for (size_t r = 0; r < table->rows && !failed; r++) {
    const struct gx_paper_row *row = &item->row[r];
    struct gx_value our_value = gx_table_get(table, r, ours), our_ratio = gx_table_get(table, r, ratio);
    char text[GX_NUMBER_LENGTH];
    size_t note = note_of(table, reason, r);
    failed = set_text(sheet, r, ROW, row->row) || set_text(sheet, r, QUANTITY, row->quantity) ||
             (our_value.type != GX_NULL && set_text(sheet, r, OURS, short_number(our_value, row, text))) ||
             set_text(sheet, r, PRINTED, row->printed) || set_text(sheet, r, CORRECTED, row->corrected) ||
             (our_ratio.type != GX_NULL && set_text(sheet, r, RATIO, ratio_text(our_ratio, text))) ||
             set_text(sheet, r, GATE, row->gate) ||
             (note && gx_table_set(sheet, r, NOTE, (struct gx_value){.type = GX_INTEGER, .integer = (long)note}));
  }
  if (!failed) return sheet;
  gx_table_free(sheet);
  return NULL;
}

static int print_item(const struct gx_paper_item *item, const char *title, const struct gx_table *table)
{
  size_t reason = (size_t)gx_table_find(table, "reason"), notes = 0;
  struct gx_table *sheet = brief(item, table, reason);
  if (!sheet) return gx_command_no_memory();
  printf("%s/%s  %s\n", item->paper, item->item, title);
  int failed = gx_command_print(sheet);
  for (size_t r = 0; r < table->rows; r++)
    if (note_of(table, reason, r) > notes) printf("  %zu: %s\n", ++notes, gx_table_get(table, r, reason).text);
  putchar('\n');
  fflush(stdout);
  gx_table_free(sheet);
  return failed ? gx_command_no_memory() : GX_EXIT_DONE;
}

static bool is_streamed(const struct session *session)
{
  return gx_options_value(session->options, "csv") || gx_options_value(session->options, "json");
}

static int run_item(struct session *session, size_t index)
{
  const struct gx_paper_item *item = session->item[index];
  struct gx_study *study = gx_paper_study(item, stderr);
  struct gx_result *results = study ? calloc(study->count + 1, sizeof *results) : NULL;
  struct gx_table *table = NULL;
  size_t missed = 0;
  int code = GX_EXIT_FAILED;
  if (!results) {
    if (study) gx_command_no_memory();
  } else {
    char what[GX_PAPER_NAME_LENGTH + 48], name[GX_PAPER_NAME_LENGTH];
    gx_paper_name(item, name);
    snprintf(what, sizeof what, "%zu of %zu, %s", index + 1, session->count, name);
    struct gx_progress_line line;
    gx_progress_begin(&line, gx_options_value(session->options, "quiet"), what);
    const struct gx_progress progress = {.context = &line, .done = gx_progress_done};
    gx_study_run(study,
                 &(struct gx_study_means){.threads = session->jobs, .sink = gx_sink_array(results), .progress = &progress});
    gx_progress_end(&line);
    table = gx_study_table(study, results, true);
    session->table[index] = table ? gx_paper_compare(item, table, &missed) : NULL;
    session->missed += missed;
    code = session->table[index] ? GX_EXIT_DONE : gx_command_no_memory();
    if (!code && !is_streamed(session)) code = print_item(item, study->title, session->table[index]);
    if (!code && gx_options_value(session->options, "output")) code = keep(session, index, study, results, table);
    for (size_t i = 0; i < study->count; i++) gx_case_free(&results[i]);
  }
  gx_table_free(table);
  free(results);
  gx_runfile_free(study);
  return code;
}

static struct gx_table *join(const struct session *session)
{
  size_t rows = 0, at = 0;
  for (size_t i = 0; i < session->count; i++) rows += session->table[i]->rows;
  const struct gx_table *any = session->table[0];
  struct gx_table *all = gx_table_create(any->columns, rows);
  int failed = !all;
  for (size_t c = 0; c < any->columns && !failed; c++) failed = gx_table_column_like(all, c, &any->column[c]);
  for (size_t i = 0; i < session->count; i++)
    for (size_t r = 0; r < session->table[i]->rows && !failed; r++, at++)
      for (size_t c = 0; c < any->columns && !failed; c++)
        failed = gx_table_set(all, at, c, gx_table_get(session->table[i], r, c));
  if (!failed) return all;
  gx_table_free(all);
  return NULL;
}

/* How many rows have each verdict. */
static void print_summary(const struct gx_table *all, const struct session *session)
{
  size_t verdict = (size_t)gx_table_find(all, "verdict");
  printf("%zu item%s, %zu rows:", session->count, session->count == 1 ? "" : "s", all->rows);
  const char *gap = " ";
  for (size_t r = 0; r < all->rows; r++) {
    struct gx_value value = gx_table_get(all, r, verdict);
    size_t count = 0, before = 0;
    for (size_t other = 0; other < all->rows; other++) {
      bool same = !gx_value_compare(gx_table_get(all, other, verdict), value);
      count += same;
      before += same && other < r;
    }
    if (before) continue;
    printf("%s%zu %s", gap, count, value.text);
    gap = ", ";
  }
  puts(session->missed ? ". A gate is missed." : ". Every gate is met.");
}

static int report(const struct session *session)
{
  struct gx_table *all = join(session);
  if (!all) return gx_command_no_memory();
  if (gx_options_value(session->options, "csv"))
    gx_csv_write(all, stdout);
  else if (gx_options_value(session->options, "json"))
    gx_json_write(all, stdout);
  else
    print_summary(all, session);
  gx_table_free(all);
  return session->missed ? GX_EXIT_FAILED : GX_EXIT_DONE;
}

static int run_items(struct session *session)
{
  int code = GX_EXIT_DONE;
  for (size_t i = 0; i < session->count && !code; i++) code = run_item(session, i);
  if (!code) code = report(session);
  for (size_t i = 0; i < session->count; i++) gx_table_free(session->table[i]);
  return code;
}

static int run(const struct gx_options *options)
{
  struct session session = {.options = options};
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross paper: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  int code = select_items(&session);
  if (code) return code;
  if (gx_options_value(options, "list")) return list_items(&session);
  session.jobs = gx_command_jobs(options);
  if (!session.jobs) return GX_EXIT_USAGE;
  code = prepare_all(&session);
  return code ? code : run_items(&session);
}

static const struct gx_example example[] = {
    {"gridcross paper --list", "what there is"},
    {"gridcross paper steffen2010/fig11", "one figure: ours, theirs, ratio, gate, verdict"},
    {"gridcross paper berzins2021 -o ours", "all its tables; studies and figures are kept"},
    {0},
};

const struct gx_command gx_command_paper = {
    .name = "paper",
    .operands = "[PAPER[/ITEM]]...",
    .least = 0,
    .most = -1,
    .help = "Recompute published tables and figures and print ours beside theirs, with ratio, gate and verdict.",
    .option = option,
    .example = example,
    .run = run,
};
