/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables on pages: headings, units, rows, and what becomes of those that are wider than the page. */
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "sheet.h"

enum { GAP = 2, NARROW_GAP = 1 };

/* A block of columns as it is printed. */
struct layout {
  const struct gx_table *table;
  const struct gx_page *page;
  size_t count, *column; /* [count] of the table, owned */
  int *width;            /* [columns of the table], owned; 0: holds nothing but null */
  int number_width;      /* of the number that leads each row; 0: none */
  int gap;               /* between columns */
};

/* Column names without the prefix that all results share. */
static const char *heading(const char *name)
{
  return strncmp(name, "result.", 7) ? name : name + 7;
}

static int larger(int a, int b)
{
  return a > b ? a : b;
}

/* Bytes of the first line of a heading in a column so wide: up to a dot or underscore, which begins the next line. */
static int head_length(const char *head, int width)
{
  int fits = 0;
  for (int at = 1;; at++) {
    if (head[at - 1] && head[at] && head[at] != '.' && head[at] != '_') continue;
    if (fits && at > width) return fits;
    fits = at;
    if (!head[at]) return fits;
  }
}

/* Width of the longest part of a heading that is not broken. */
static int head_width(const char *head)
{
  int longest = 0;
  for (int length; *head; head += length) longest = larger(longest, length = head_length(head, 0));
  return longest;
}

static int entry_width(const struct gx_table *table, size_t row, size_t c)
{
  char buffer[GX_NUMBER_LENGTH];
  struct gx_value value = gx_table_get(table, row, c);
  return value.type == GX_NULL ? 0 : gx_sheet_width(gx_sheet_text(table->column[c].name, value, buffer));
}

static int column_width(const struct gx_table *table, size_t c, bool broken)
{
  int width = 0;
  for (size_t r = 0; r < table->rows; r++) width = larger(width, entry_width(table, r, c));
  if (!width) return 0;
  const char *head = heading(table->column[c].name);
  return larger(larger(width, broken ? head_width(head) : gx_sheet_width(head)), gx_sheet_width(table->column[c].unit));
}

static int total_width(const struct layout *at)
{
  int total = at->number_width ? at->number_width + at->gap : 0;
  for (size_t i = 0; i < at->count; i++) total += at->width[at->column[i]] + at->gap;
  return total - at->gap;
}

static bool fits(const struct layout *at)
{
  return !at->page->width || total_width(at) <= at->page->width;
}

/* Columns that hold something, as wide as they need be. */
static void gather(struct layout *at, bool broken)
{
  at->count = 0;
  for (size_t c = 0; c < at->table->columns; c++)
    if ((at->width[c] = column_width(at->table, c, broken))) at->column[at->count++] = c;
}

static bool is_constant(const struct gx_table *table, size_t c)
{
  for (size_t r = 1; r < table->rows; r++)
    if (gx_value_compare(gx_table_get(table, 0, c), gx_table_get(table, r, c))) return false;
  return table->rows > 1;
}

/* Takes out, and puts into `same`, columns with one value in all rows. Returns how many. */
static size_t take_constant(struct layout *at, size_t *same)
{
  size_t kept = 0, taken = 0;
  for (size_t i = 0; i < at->count; i++)
    if (is_constant(at->table, at->column[i]))
      same[taken++] = at->column[i];
    else
      at->column[kept++] = at->column[i];
  at->count = kept;
  return taken;
}

/* A text in the last column has what the page leaves it, if that is 24 characters or half the page. */
static void narrow_text(struct layout *at)
{
  if (!at->count || at->table->column[at->column[at->count - 1]].type != GX_TEXT) return;
  int *width = &at->width[at->column[at->count - 1]], left = at->page->width - (total_width(at) - *width);
  if ((left >= 24 || 2 * left >= at->page->width) && left < *width) *width = left;
}

/* Text in its column; blanks are owed, and printed before what follows them alone. */
static void put(const struct layout *at, const char *text, int length, int width, bool right, int *owed, FILE *out)
{
  int shown = 0;
  for (int i = 0; i < length; i++) shown += ((unsigned char)text[i] & 0xC0) != 0x80;
  int fill = width > shown ? width - shown : 0;
  if (right) *owed += fill;
  if (length) {
    fprintf(out, "%*s%.*s", *owed, "", length, text);
    *owed = 0;
  }
  *owed += at->gap + (right ? 0 : fill);
}

/* Bytes of the first line of a text that is broken between words. */
static int text_length(const char *text, int width)
{
  int shown = 0, blank = 0, i = 0;
  for (; text[i]; i++) {
    if (text[i] == ' ') blank = i;
    shown += ((unsigned char)text[i] & 0xC0) != 0x80;
    if (shown > width && blank) return blank;
  }
  return i;
}

static bool is_right(const struct gx_table *table, size_t c)
{
  return table->column[c].type != GX_TEXT;
}

/* Lines of the headings in turn; each stands above its column at the bottom of them. */
static void print_headings(const struct layout *at, FILE *out)
{
  int lines = 1;
  bool units = false;
  for (size_t i = 0; i < at->count; i++) {
    int own = 0;
    for (const char *head = heading(at->table->column[at->column[i]].name); *head; own++)
      head += head_length(head, at->width[at->column[i]]);
    lines = larger(lines, own);
    units = units || *at->table->column[at->column[i]].unit;
  }
  for (int line = 0; line < lines + units; line++) {
    int owed = at->number_width ? at->number_width + at->gap : 0;
    for (size_t i = 0; i < at->count; i++) {
      size_t c = at->column[i];
      const char *head = heading(at->table->column[c].name), *end = head;
      int width = at->width[c], own = 0, skip;
      while (*end) end += head_length(end, width), own++;
      for (skip = line - (lines - own); skip > 0 && *head; skip--) head += head_length(head, width);
      if (line == lines) head = at->table->column[c].unit;
      int length = line == lines ? (int)strlen(head) : skip < 0 || !*head ? 0 : head_length(head, width);
      put(at, head, length, width, is_right(at->table, c), &owed, out);
    }
    putc('\n', out);
  }
}

static void print_row(const struct layout *at, size_t row, FILE *out)
{
  int owed = 0;
  const char *rest = NULL; /* of the last text */
  char buffer[GX_NUMBER_LENGTH];
  if (at->number_width) {
    snprintf(buffer, sizeof buffer, "%zu", row + 1);
    put(at, buffer, (int)strlen(buffer), at->number_width, true, &owed, out);
  }
  for (size_t i = 0; i < at->count; i++) {
    size_t c = at->column[i];
    struct gx_value value = gx_table_get(at->table, row, c);
    const char *text = gx_sheet_text(at->table->column[c].name, value, buffer);
    bool last = i + 1 == at->count, right = is_right(at->table, c), blank = last && !right && value.type == GX_NULL;
    int length = blank ? 0 : last && !right ? text_length(text, at->width[c]) : (int)strlen(text);
    put(at, text, length, at->width[c], right, &owed, out);
    if (last && !right && !blank) rest = text + length;
  }
  putc('\n', out);
  while (rest && *(rest += strspn(rest, " "))) {
    size_t c = at->column[at->count - 1];
    int length = text_length(rest, at->width[c]);
    fprintf(out, "%*s%.*s\n", total_width(at) - at->width[c], "", length, rest);
    rest += length;
  }
}

static void print_block(const struct layout *at, FILE *out)
{
  print_headings(at, out);
  for (size_t r = 0; r < at->table->rows; r++) print_row(at, r, out);
}

/* Columns that tell rows apart lead every block, unless they take half the page: then a number of the row does. */
static size_t find_lead(struct layout *all)
{
  size_t lead = 0;
  int width = 0;
  for (; lead < all->count && gx_axes_parameter(all->table, all->column[lead]); lead++)
    width += all->width[all->column[lead]] + all->gap;
  if (lead && width <= all->page->width / 2) return lead;
  for (size_t rows = all->table->rows; rows; rows /= 10) all->number_width++;
  return 0;
}

/* Adds a column if the page has room for it, a text perhaps broken. */
static bool add(struct layout *block, size_t column)
{
  int width = block->width[column];
  block->column[block->count++] = column;
  if (!fits(block)) narrow_text(block);
  if (fits(block)) return true;
  block->width[column] = width;
  block->count--;
  return false;
}

/* block has room for all columns and the widths of all. */
static void print_blocks(struct layout *all, struct layout *block, FILE *out)
{
  size_t lead = find_lead(all), next = lead;
  memcpy(block->column, all->column, lead * sizeof *block->column);
  block->number_width = all->number_width;
  while (next < all->count) {
    if (next > lead) putc('\n', out);
    block->count = lead;
    if (!add(block, all->column[next])) block->column[block->count++] = all->column[next];
    while (++next < all->count && add(block, all->column[next])) continue;
    print_block(block, out);
  }
}

/* "in all rows: status ok, dt 0.001 s" */
static void print_same(const struct layout *at, size_t count, const size_t *same, FILE *out)
{
  int used = count ? fprintf(out, "in all rows:") : 0;
  for (size_t i = 0; i < count; i++) {
    const struct gx_column *column = &at->table->column[same[i]];
    char buffer[GX_NUMBER_LENGTH];
    const char *text = gx_sheet_text(column->name, gx_table_get(at->table, 0, same[i]), buffer), *name = heading(column->name);
    int width = gx_sheet_width(name) + gx_sheet_width(text) + gx_sheet_width(column->unit) + 4;
    if (used + width > at->page->width && i) used = fprintf(out, "\n ") - 1;
    used += width;
    fprintf(out, " %s %s%s%s%s", name, text, *column->unit ? " " : "", column->unit, i + 1 < count ? "," : "");
  }
  if (count) putc('\n', out);
}

int gx_sheet_print(const struct gx_table *table, const struct gx_page *page, FILE *out)
{
  size_t *column = calloc(3 * table->columns + 1, sizeof *column), taken = 0;
  int *width = calloc(table->columns + 1, sizeof *width);
  if (column && width) {
    struct layout all = {.table = table, .page = page, .column = column, .width = width, .gap = GAP}, block = all;
    size_t *same = column + 2 * table->columns;
    block.column = column + table->columns;
    gather(&all, false);
    if (!fits(&all)) gather(&all, true);
    if (!fits(&all)) taken = take_constant(&all, same);
    if (!fits(&all)) narrow_text(&all);
    if (!fits(&all)) all.gap = NARROW_GAP;
    if (!fits(&all)) all.gap = GAP;
    if (fits(&all))
      print_block(&all, out);
    else
      print_blocks(&all, &block, out);
    print_same(&all, taken, same, out);
  }
  int failed = column && width ? 0 : -1;
  free(column);
  free(width);
  return failed;
}
