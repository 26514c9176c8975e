/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Terminals: their width and what they show. */
#define _DEFAULT_SOURCE /* struct winsize */
#include "terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { NARROWEST = 20, USUAL = 80 };

bool gx_terminal_is(FILE *stream)
{
  const char *kind = getenv("TERM");
  return isatty(fileno(stream)) && kind && *kind && strcmp(kind, "dumb") != 0;
}

static int width_of(FILE *stream)
{
  struct winsize size;
  if (!ioctl(fileno(stream), TIOCGWINSZ, &size) && size.ws_col > 0) return size.ws_col > NARROWEST ? size.ws_col : NARROWEST;
  const char *columns = getenv("COLUMNS");
  int given = columns ? atoi(columns) : 0;
  return given >= NARROWEST ? given : USUAL;
}

struct gx_page gx_terminal_page(FILE *stream)
{
  const char *plain = getenv("NO_COLOR");
  return (struct gx_page){
      .width = isatty(fileno(stream)) ? width_of(stream) : 0,
      .attributes = gx_terminal_is(stream) && !(plain && *plain),
  };
}
