/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of a report: each writes one member of its data. */
#ifndef GRIDCROSS_VIEW_REPORT_PAGE_H
#define GRIDCROSS_VIEW_REPORT_PAGE_H

#include <gridcross/paper.h>
#include <gridcross/report.h>

#include "front.h"
#include "pivot.h"
#include "report_json.h"

struct gx_report_page {
  const struct gx_report *report;
  char **run_file, **title;          /* [studies], owned */
  const struct gx_paper_item **item; /* [studies] whose run file it is; NULL: no paper's; owned */
  bool papers;                       /* several studies, all items of papers: not compared with each other */
  struct gx_table *table;            /* the studies joined, owned */
  size_t axes, *axis;                /* columns of table that tell cases apart, owned */
  size_t results, *result;           /* columns of table with numbers to show, errors first; owned */
  struct gx_front front;             /* without members: front_note says why */
  char *front_note;                  /* one line each, owned */
  long *index;                       /* [table->rows] place among the cases shown, -1: left out; owned */
  size_t shown;                      /* cases */
  size_t divisor;                    /* of every limit, so that the page fits */
};

/* Reads what the parts need. Returns 0, or -1 after a message; to be freed in either case. */
int gx_report_page_create(struct gx_report_page *page, const struct gx_report *report, FILE *errors);
void gx_report_page_free(struct gx_report_page *page);
/* Sets the divisor, and which cases are shown. */
void gx_report_page_limit(struct gx_report_page *page, size_t divisor);

/* Functions that return int give 0, or -1 when memory runs out. */

/* studies, axes, fixed: what was compared, run files, provenance. */
int gx_report_study_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors);
/* cases: every row. */
int gx_report_cases_write(const struct gx_report_page *page, struct gx_report_json *json);
/* compare: cases by rows that refine and columns, with orders. */
int gx_report_compare_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors);
/* front: the cheapest cases, and why. */
int gx_report_front_write(const struct gx_report_page *page, struct gx_report_json *json);
/* histories, spectra: of some cases. */
int gx_report_curves_write(const struct gx_report_page *page, struct gx_report_json *json);
/* tracks: paths of particles over the cells of some cases that kept snapshots. */
int gx_report_tracks_write(const struct gx_report_page *page, struct gx_report_json *json);
/* paper: items beside the print. */
int gx_report_paper_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors);

/* The study that a row of the joined table came from; row becomes that of its own table. */
size_t gx_report_page_study(const struct gx_report_page *page, size_t *row);
/* "standard, degree 2, cells 32"; owned by the caller, NULL when memory runs out. */
char *gx_report_page_label(const struct gx_table *table, size_t axes, const size_t *axis, size_t row);
/* Rows to show more of than numbers, pairs that differ in the space alone first. row: [most]. Returns how many. wanted: whether a
 * row can be shown so. */
size_t gx_report_page_choose(const struct gx_report_page *page, size_t most, size_t *row,
                             bool (*wanted)(const struct gx_report_page *page, size_t row));

/* The i-th of `count` places from 0 to last. */
static inline size_t gx_report_page_spread(size_t i, size_t count, size_t last)
{
  return count < 2 ? last : (size_t)((double)last * (double)i / (double)(count - 1) + 0.5);
}

#endif
