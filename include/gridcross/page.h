/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What tables for people are printed on. */
#ifndef GRIDCROSS_PAGE_H
#define GRIDCROSS_PAGE_H

#include <stdbool.h>

/* {0}: a file. */
struct gx_page {
  int width;       /* characters a line; 0: as many as there are */
  bool attributes; /* understands ECMA-48 attributes: bold */
};

#endif
