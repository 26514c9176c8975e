/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts the data of studies into the page that the build made, and the page into its place. */
#include <gridcross/report.h>

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "report_page.h"
#include "report_pieces.h"

enum { LARGEST = 1900000 }; /* bytes */

/* The first lines of every page of ours: other files are not overwritten. */
static const char mark[] = "<!doctype html>\n<!-- gridcross report -->\n";

static int no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return -1;
}

static int write_data(const struct gx_report_page *page, FILE *out, FILE *errors)
{
  struct gx_report_json json = {.out = out};
  gx_report_json_open(&json, NULL, '{');
  int failed = gx_report_study_write(page, &json, errors) || gx_report_paper_write(page, &json, errors);
  if (!failed && !page->papers)
    failed = gx_report_cases_write(page, &json) || gx_report_compare_write(page, &json, errors) ||
             gx_report_front_write(page, &json) || gx_report_tracks_write(page, &json) || gx_report_curves_write(page, &json);
  gx_report_json_close(&json, '}');
  return failed;
}

/* steffen2010: Steffen 2010 */
static void write_paper(const char *paper, FILE *out)
{
  size_t letters = strcspn(paper, "0123456789");
  fprintf(out, "%c%.*s %s", toupper((unsigned char)*paper), (int)letters - 1, paper + 1, paper + letters);
}

/* Of the only study, else of all by name. */
static void write_title(const struct gx_report_page *page, FILE *out)
{
  if (page->report->studies == 1 && *page->title[0]) {
    gx_report_json_escape(page->title[0], out);
    return;
  }
  for (size_t s = 0; s < page->report->studies && !page->papers; s++) {
    if (s) fputs(", ", out);
    gx_report_json_escape(page->report->name[s], out);
  }
  for (size_t s = 0, papers = 0; s < page->report->studies && page->papers; s++) {
    bool new = true;
    for (size_t before = 0; before < s && new; before++) new = strcmp(page->item[before]->paper, page->item[s]->paper) != 0;
    if (!new) continue;
    if (papers++) fputs(", ", out);
    write_paper(page->item[s]->paper, out);
  }
  if (page->papers) fputs(", recomputed", out);
}

/* The page, owned by the caller; NULL after a message. */
static char *make_page(const struct gx_report_page *page, size_t *length, FILE *errors)
{
  char *text = NULL;
  FILE *out = open_memstream(&text, length);
  int failed = out ? 0 : no_memory(errors);
  if (out) fputs(mark, out);
  for (const struct gx_report_piece *piece = gx_report_pieces; out && piece->text && !failed; piece++) {
    fputs(piece->text, out);
    if (piece->then == GX_REPORT_TITLE) write_title(page, out);
    if (piece->then == GX_REPORT_DATA) failed = write_data(page, out, errors);
  }
  if (out && (ferror(out) | fclose(out)) && !failed) failed = no_memory(errors);
  if (!failed) return text;
  free(text);
  return NULL;
}

/* Whether a file may be put there: there is none, or a page of ours. */
static int check_place(const char *output, FILE *errors)
{
  char head[sizeof mark] = "";
  FILE *old = fopen(output, "rb");
  if (!old) return 0;
  size_t length = fread(head, 1, sizeof mark - 1, old);
  fclose(old);
  if (length == sizeof mark - 1 && !strcmp(head, mark)) return 0;
  fprintf(errors, "%s: is no report of gridcross and will not be overwritten: name another file with -o\n", output);
  return -1;
}

/* Beside its place, then renamed, so that a kill leaves the old page or the new one. */
static int put_page(const char *output, const char *text, size_t length, FILE *errors)
{
  size_t room = strlen(output) + sizeof ".partial";
  char *partial = malloc(room);
  if (!partial) return no_memory(errors);
  snprintf(partial, room, "%s.partial", output);
  FILE *out = fopen(partial, "wb");
  int failed = !out || fwrite(text, 1, length, out) != length;
  if (out && fclose(out)) failed = 1;
  if (!failed) failed = rename(partial, output);
  if (failed) {
    fprintf(errors, "%s: %s\n", output, strerror(errno));
    if (out) unlink(partial);
  }
  free(partial);
  return failed ? -1 : 0;
}

int gx_report_write(const struct gx_report *report, const char *output, FILE *errors)
{
  if (check_place(output, errors)) return -1;
  struct gx_report_page page;
  char *text = NULL;
  size_t length = 0;
  int failed = gx_report_page_create(&page, report, errors);
  for (size_t divisor = 1; !failed && (!text || (length > LARGEST && divisor <= 64)); divisor *= 2) {
    free(text);
    gx_report_page_limit(&page, divisor);
    failed = (text = make_page(&page, &length, errors)) ? 0 : -1;
  }
  if (!failed) failed = put_page(output, text, length, errors);
  free(text);
  gx_report_page_free(&page);
  return failed ? -1 : 0;
}
