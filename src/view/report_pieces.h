/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of every report, in pieces around what differs. The build makes them of src/view/report/. */
#ifndef GRIDCROSS_VIEW_REPORT_PIECES_H
#define GRIDCROSS_VIEW_REPORT_PIECES_H

enum gx_report_gap { GX_REPORT_END, GX_REPORT_TITLE, GX_REPORT_DATA };

struct gx_report_piece {
  const char *text;        /* NULL: after the last */
  enum gx_report_gap then; /* what follows */
};

extern const struct gx_report_piece gx_report_pieces[];

#endif
