/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Published tables and figures: the run file that recomputes an item, what the paper prints, and how close we must come. */
#ifndef GRIDCROSS_PAPER_H
#define GRIDCROSS_PAPER_H

#include <stdio.h>

#include <gridcross/plot.h>
#include <gridcross/study.h>
#include <gridcross/table.h>

/* One row of runs/papers/<paper>/<item>.csv; texts are "" where there is nothing. */
struct gx_paper_row {
  const char *row, *quantity; /* as the reader finds it in the paper */
  /* Factors joined by " * " or " / ": a number, or column{path=value ...} of the one case that has these values; each may be
   * followed by ^number. Without braces: of the only case. */
  const char *value;
  const char *printed;   /* number, "*" where the paper has no result, "" where it states no number */
  const char *corrected; /* what the print should read */
  /* "5%", "5% of 1.567", "factor 2", "factor 2 of 3e-4", "below 1", "above 1", "between 1 2", "show". Without `of` a gate is held
   * against `corrected`, else `printed`. */
  const char *gate;
  const char *reason; /* of a difference */
};

struct gx_paper_item {
  const char *paper, *item;
  const char *run_file;           /* text of the run file */
  const char *plot;               /* options of `gridcross plot`, one figure a line; "": none */
  const struct gx_paper_row *row; /* [rows] */
  size_t rows;
};

extern const struct gx_paper_item gx_paper_items[];
extern const size_t gx_paper_item_count;

/* "paper/item". */
enum { GX_PAPER_NAME_LENGTH = 64 };
void gx_paper_name(const struct gx_paper_item *item, char name[GX_PAPER_NAME_LENGTH]);

/* The study of an item; as gx_runfile_read. */
struct gx_study *gx_paper_study(const struct gx_paper_item *item, FILE *errors);

/* The item's rows beside the table of its study (with timing columns): paper, item, row, quantity, ours, printed, corrected, ratio
 * (ours / printed), gate, verdict, reason. Verdicts:
 *   matches              ours agrees with the print within the gate, or 10 % and the rounding of the print
 *   matches corrected    it agrees so with the corrected reading
 *   differs              it does not, and the reason says why
 *   holds                the paper prints no number, and the gate is met
 *   shown                the paper prints no number, and there is no gate
 *   misses its gate      ours is wrong, or the paper's reading is
 *   unexplained          ratio outside 0.5 ... 2, or nothing to compare, without a reason
 *   invalid              the row does not name one case of the study, or is ill-formed; the reason says how
 * missed: how many rows have one of the last three. NULL when memory runs out. */
struct gx_table *gx_paper_compare(const struct gx_paper_item *item, const struct gx_table *study, size_t *missed);

/* The printed values of column y beside the x of their cases; rows whose value is more than that column are left out.
 * point: [item->rows], filled. Returns how many. */
size_t gx_paper_points(const struct gx_paper_item *item, const struct gx_table *study, const char *x, const char *y,
                       struct gx_plot_point *point);

#endif
