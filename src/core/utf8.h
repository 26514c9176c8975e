/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text from outside may be of any bytes. */
#ifndef GRIDCROSS_CORE_UTF8_H
#define GRIDCROSS_CORE_UTF8_H

/* Bytes of the well-formed UTF-8 character that a text begins with, 1 to 4, and its code point; 0: there is none. */
int gx_utf8_length(const char *text, unsigned long *point);

#endif
