/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies as one page of HTML that needs nothing else: what was compared, tables, figures, run files, provenance. */
#ifndef GRIDCROSS_REPORT_H
#define GRIDCROSS_REPORT_H

#include <stdio.h>

#include <gridcross/table.h>

struct gx_report {
  size_t studies;
  const struct gx_table *const *table; /* [studies], borrowed */
  const char *const *name;             /* [studies] values of the axis `study` */
  const char *const *directory;        /* [studies] where histories, spectra and snapshots are read */
};

/* Writes the page to a file, which must not be there or be such a page; below 2 MB however large the studies are, by leaving out
 * rows, lines and samples, which the page then says. A study of the run file of a published table or figure is shown beside the
 * print; where every study is one, they are not compared with each other. Equal studies give equal bytes, but for what was timed.
 * Returns 0, or -1 after a message to `errors`. */
int gx_report_write(const struct gx_report *report, const char *output, FILE *errors);

#endif
