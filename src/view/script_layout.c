/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nothing is left to gnuplot's guess at the width of SVG text, which is poor, and of a legend higher than the plot it would drop the
 * end. */
#include "script_layout.h"

#include <math.h>
#include <string.h>

#include "gnuplot.h"
#include "script_axis.h"
#include "sheet.h"

enum { LEFT = 105, TOP = 58, BOTTOM = 62, NOTE = 24, GAP = 20, KEY_TOP = 40, LINE = 21, SAMPLE = 90, LETTER = 8 };
enum { WIDTH = 550, HEIGHT = 360, MOST_HEIGHT = 480 };                                        /* of the axes of one plot */
enum { PANELS = 3, PANEL_WIDTH = 330, PANEL_HEIGHT = 360, PANEL_GAP = 36, PANEL_TITLE = 24 }; /* of one beside others */
enum { BAR_GAP = 30, BAR_WIDTH = 16, BAR_TEXT = 115 };

static bool has_note(const struct gx_figure *figure)
{
  return figure->note && *figure->note;
}

static bool has_panel_titles(const struct gx_figure *figure)
{
  return figure->panels > 1 || (figure->panels && *figure->panel[0]);
}

static bool is_coloured(const struct gx_figure *figure)
{
  return figure->data->columns > GX_FIGURE_VALUE;
}

/* Entries of the legend, which is the first panel's, and the letters of the longest. */
static size_t count_entries(const struct gx_figure *figure, int *letters)
{
  size_t entries = 0;
  bool nyquist = false;
  *letters = 0;
  for (size_t i = 0; i < figure->lines; i++) {
    const struct gx_figure_line *line = &figure->line[i];
    nyquist = nyquist || !isnan(line->nyquist);
    if (line->panel || line->style == GX_FIGURE_COLOURED) continue;
    int length = gx_sheet_width(line->label) + (isnan(line->order) ? 0 : (int)strlen(" (order 1.0)"));
    if (length > *letters) *letters = length;
    entries++;
  }
  if (nyquist && *letters < 31) *letters = 31;
  return entries + nyquist;
}

/* Height of axes of that width for lengths drawn alike; narrower ones where they would be too high. */
static void keep_shape(const struct gx_figure *figure, struct gx_script_layout *layout)
{
  double shape = (figure->y.most - figure->y.least) / (figure->x.most - figure->x.least);
  layout->down = layout->across * shape;
  if (layout->down > MOST_HEIGHT) layout->down = MOST_HEIGHT;
  layout->across = layout->down / shape;
}

struct gx_script_layout gx_script_layout_choose(const struct gx_figure *figure)
{
  int letters;
  size_t entries = count_entries(figure, &letters), panels = figure->panels ? figure->panels : 1;
  struct gx_script_layout layout = {
      .across = panels > 1 ? PANEL_WIDTH : WIDTH,
      .down = panels > 1 ? PANEL_HEIGHT : fmax(HEIGHT, LINE * (double)entries),
      .columns = panels < PANELS ? panels : PANELS,
      .key = entries > 1 || (entries && *figure->line[0].label),
  };
  if (figure->equal) keep_shape(figure, &layout);
  double rows = (double)((panels - 1) / layout.columns + 1), columns = (double)layout.columns;
  layout.top = TOP + (has_panel_titles(figure) ? PANEL_TITLE : 0);
  layout.right = LEFT + columns * layout.across + (columns - 1) * PANEL_GAP;
  layout.width = layout.right + GAP + (layout.key ? SAMPLE + LETTER * letters : 0);
  if (is_coloured(figure)) layout.width = fmax(layout.width, layout.right + BAR_GAP + BAR_WIDTH + BAR_TEXT);
  layout.height = layout.top + rows * (layout.down + BOTTOM) + (rows - 1) * PANEL_TITLE + (has_note(figure) ? NOTE : 0);
  layout.height = fmax(layout.height, KEY_TOP + LINE * (double)entries + GAP);
  double apart = figure->spacing / (figure->x.most - figure->x.least) * layout.across; /* a point of size 1 is ten wide */
  layout.point = fmin(2, fmax(0.15, apart / 10));
  return layout;
}

void gx_script_layout_terminal(const struct gx_script_layout *layout, const char *ending, FILE *out)
{
  double width = layout->width, height = layout->height;
  if (!strcmp(ending, "svg"))
    fprintf(out, "set terminal svg size %.0f,%.0f font 'sans-serif,13' background '#ffffff'\n", width, height);
  else if (!strcmp(ending, "pdf"))
    fprintf(out, "set terminal pdfcairo size %.2f,%.2f font 'sans,16' linewidth 1.5 pointscale 0.8\n", width / 96, height / 96);
  else
    fprintf(out,
            "if (strstrt(GPVAL_TERMINALS, 'pngcairo')) {\n"
            "  set terminal pngcairo size %.0f,%.0f font 'sans,10' fontscale 2 linewidth 2 pointscale 2\n"
            "} else {\n"
            "  set terminal png size %.0f,%.0f\n"
            "}\n",
            2 * width, 2 * height, width, height);
}

/* Of axes whose upper left corner stands there. */
static void put_margins(const struct gx_script_layout *layout, double left, double top, FILE *out)
{
  fprintf(out, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", left / layout->width,
          (left + layout->across) / layout->width);
  fprintf(out, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", 1 - top / layout->height,
          1 - (top + layout->down) / layout->height);
}

static void put_key(const struct gx_script_layout *layout, FILE *out)
{
  if (layout->key)
    fprintf(out, "set key noenhanced at screen %.4f,%.4f left top vertical maxcols 1 Left reverse\n",
            (layout->right + GAP) / layout->width, 1 - KEY_TOP / layout->height);
  else
    fputs("unset key\n", out);
}

static void put_bar(const struct gx_figure *figure, const struct gx_script_layout *layout, FILE *out)
{
  fprintf(out, "set colorbox user origin screen %.4f,%.4f size screen %.4f,%.4f\n", (layout->right + BAR_GAP) / layout->width,
          1 - (layout->top + layout->down) / layout->height, BAR_WIDTH / layout->width, layout->down / layout->height);
  gx_script_axis_colours(figure, out);
}

static bool is_blank(char c)
{
  return c == ' ' || c == '\n' || c == '\t';
}

/* Bytes of a line of at most so many letters, up to a blank where there is one. */
static size_t fit(const char *text, size_t most)
{
  size_t blank = 0, at = 0;
  for (size_t letters = 0; text[at]; at++) {
    const bool begins = ((unsigned char)text[at] & 0xC0) != 0x80;
    if (begins && letters == most) return blank ? blank : at;
    letters += begins;
    if (is_blank(text[at])) blank = at;
  }
  return at;
}

/* In two lines at most, as wide as the axes and the gap beside them. */
static void put_title(const char *title, const struct gx_script_layout *layout, FILE *out)
{
  const size_t most = (size_t)((layout->right - LEFT + 2 * GAP) / LETTER);
  size_t length = fit(title, most);
  gx_gnuplot_part(title, length, out);
  title += length;
  while (is_blank(*title)) title++;
  if (!*title) return;
  length = fit(title, most);
  if (title[length]) length = fit(title, most - 1);
  fputs("\\n", out);
  gx_gnuplot_part(title, length, out);
  if (title[length]) fputs("…", out);
}

/* Of a figure with panels it is a label, since each of them has a title of its own. */
static void put_heading(const struct gx_figure *figure, const struct gx_script_layout *layout, FILE *out)
{
  fputs(figure->panels ? "set label \"" : "set title \"", out);
  put_title(figure->title, layout, out);
  fputs("\" ", out);
  if (figure->panels)
    fprintf(out, "at screen %.4f, screen %.4f center ", (LEFT + layout->right) / 2 / layout->width, 1 - 26 / layout->height);
  fputs("noenhanced\n", out);
}

void gx_script_layout_write(const struct gx_figure *figure, const struct gx_script_layout *layout, FILE *out)
{
  put_key(layout, out);
  if (is_coloured(figure)) put_bar(figure, layout, out);
  if (*figure->title) put_heading(figure, layout, out);
  if (has_note(figure)) {
    fputs("set label \"", out);
    gx_gnuplot_text(figure->note, out);
    fprintf(out, "\" at screen %.4f, screen %.4f left noenhanced textcolor rgb '#666666'\n", LEFT / layout->width,
            14 / layout->height);
  }
  if (figure->equal) fputs("set size ratio -1\n", out);
  if (!figure->panels) put_margins(layout, LEFT, layout->top, out);
}

void gx_script_layout_panel(const struct gx_figure *figure, const struct gx_script_layout *layout, size_t panel, FILE *out)
{
  size_t column = panel % layout->columns, row = panel / layout->columns;
  double step = layout->down + BOTTOM + PANEL_TITLE;
  put_margins(layout, LEFT + (double)column * (layout->across + PANEL_GAP), layout->top + (double)row * step, out);
  fputs("set title \"", out);
  gx_gnuplot_text(figure->panel[panel], out);
  fputs("\" noenhanced\n", out);
  if (column > 0)
    fputs("set format y ''\nunset ylabel\n", out);
  else if (row > 0) { /* as the first panel's */
    fputs("set format y\n", out);
    gx_script_axis_scales(figure, out);
    gx_script_axis_label("y", &figure->data->column[GX_FIGURE_Y], out);
  }
  if (panel == 1) fputs("unset label\nunset key\nunset colorbox\n", out);
}
