/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON within HTML: nothing in a text ends the script element or a line of it. */
#ifndef GRIDCROSS_VIEW_REPORT_JSON_H
#define GRIDCROSS_VIEW_REPORT_JSON_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/value.h>

struct gx_report_json {
  FILE *out;   /* its error flag tells of failure */
  bool filled; /* the innermost array or object has a member */
};

/* key: of a member of an object; NULL: of an array, or the whole. bracket: '{' or '['. */
void gx_report_json_open(struct gx_report_json *json, const char *key, char bracket);
/* bracket: '}' or ']' */
void gx_report_json_close(struct gx_report_json *json, char bracket);
/* NULL: null. Bytes that are no UTF-8 become U+FFFD. */
void gx_report_json_text(struct gx_report_json *json, const char *key, const char *text);
/* To six digits; null where it is not finite. */
void gx_report_json_number(struct gx_report_json *json, const char *key, double number);
void gx_report_json_integer(struct gx_report_json *json, const char *key, long number);
/* Text for HTML's own elements. */
void gx_report_json_escape(const char *text, FILE *out);

#endif
