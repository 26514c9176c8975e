/* SPDX-License-Identifier: GPL-3.0-or-later */
/* UTF-8: RFC 3629. */
#include "utf8.h"

int gx_utf8_length(const char *text, unsigned long *point)
{
  static const unsigned long least[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned char *c = (const unsigned char *)text;
  const int length = c[0] < 0x80 ? 1 : c[0] >> 5 == 0x6 ? 2 : c[0] >> 4 == 0xE ? 3 : c[0] >> 3 == 0x1E ? 4 : 0;
  if (!length) return 0;
  *point = length == 1 ? c[0] : c[0] & (0x7Fu >> length);
  for (int i = 1; i < length; i++) {
    if ((c[i] & 0xC0) != 0x80) return 0;
    *point = *point << 6 | (c[i] & 0x3Fu);
  }
  return *point < least[length] || *point > 0x10FFFF || (*point >= 0xD800 && *point <= 0xDFFF) ? 0 : length;
}
