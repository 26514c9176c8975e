/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaks text between words. */
#include "text.h"

#include <string.h>

#include "../view/sheet.h"
#include "terminal.h"

int gx_text_width(void)
{
  enum { WIDEST = 100 };
  int width = gx_terminal_page(stdout).width;
  return width && width < WIDEST ? width : WIDEST;
}

void gx_text_print(const char *text, int at, int indent, int width, FILE *out)
{
  const char *gap = "";
  while (*(text += strspn(text, " "))) {
    char word[256];
    size_t length = strcspn(text, " ");
    if (length >= sizeof word) length = sizeof word - 1;
    snprintf(word, sizeof word, "%.*s", (int)length, text);
    text += length;
    int shown = gx_sheet_width(word);
    if (at > indent && at + (int)strlen(gap) + shown > width) {
      fprintf(out, "\n%*s", indent, "");
      at = indent;
      gap = "";
    }
    at += (int)strlen(gap) + shown;
    fprintf(out, "%s%s", gap, word);
    gap = " ";
  }
  putc('\n', out);
}
