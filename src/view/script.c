/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scripts for gnuplot 5. Text from outside is quoted and never `enhanced`; files are named from ./ on, so that none reads as a pipe
 * ("|..."), a command ("< ...") or an option. */
#include "script.h"

#include <math.h>
#include <string.h>

#include "gnuplot.h"
#include "script_axis.h"
#include "script_layout.h"

const char gx_script_mark[] = "# gridcross plot overwrites this file: restyle a copy. To draw: gnuplot FILE.gp\n";

/* Okabe and Ito's palette, yellow left out: too light on white. */
static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
static const int markers[] = {7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14};
_Static_assert(sizeof colours / sizeof *colours == GX_FIGURE_COLOURS, "plots choose among them");
_Static_assert(sizeof markers / sizeof *markers == GX_FIGURE_MARKERS, "plots choose among them");

static void put_triangles(const struct gx_figure *figure, FILE *out)
{
  if (!figure->triangles) return;
  fputs("$triangles << EOD\n", out);
  for (size_t t = 0; t < figure->triangles; t++) {
    if (t) putc('\n', out);
    for (int i = 0; i < 4; i++) fprintf(out, "%.17g,%.17g\n", figure->triangle[t].at[i % 3][0], figure->triangle[t].at[i % 3][1]);
  }
  fputs("EOD\n", out);
  for (size_t t = 0; t < figure->triangles; t++) {
    const double(*at)[2] = figure->triangle[t].at;
    double other = at[2][0] == at[0][0] ? at[1][0] : at[0][0], high = at[2][1] == at[0][1] ? at[1][1] : at[0][1];
    const char *side = at[2][0] > other ? "left offset 0.5,0" : "right offset -0.5,0";
    fprintf(out, "set label '%.1f' at %.17g,%.17g %s\n", figure->triangle[t].slope, at[2][0], sqrt(high * at[2][1]), side);
    fprintf(out, "set label '1' at %.17g,%.17g center offset 0,-0.8\n", sqrt(other * at[2][0]), at[2][1]);
  }
}

/* Vertical lines where the grids of the lines end, each once. Returns whether there are any. */
static bool put_nyquist(const struct gx_figure *figure, FILE *out)
{
  bool any = false;
  for (size_t i = 0; i < figure->lines; i++) {
    double at = figure->line[i].nyquist;
    bool seen = isnan(at) || (figure->x.log && at <= 0);
    for (size_t k = 0; k < i && !seen; k++) seen = figure->line[k].nyquist == at;
    if (seen) continue;
    fprintf(out, "set arrow from first %.17g, graph 0 to first %.17g, graph 1 nohead dashtype 3 linecolor rgb '#666666'\n", at,
            at);
    any = true;
  }
  return any;
}

/* "./<name>.<ending>", byte for byte */
static void put_file(const char *name, const char *ending, FILE *out)
{
  fputs("\"./", out);
  gx_gnuplot_quote(name, strlen(name), out);
  fprintf(out, ".%s\"", ending);
}

static bool has_markers(const struct gx_figure_line *line)
{
  return line->style == GX_FIGURE_LINES_POINTS || line->style == GX_FIGURE_POINTS;
}

/* Open markers hide the line behind them. */
static void put_styles(const struct gx_figure *figure, FILE *out)
{
  fputs("set pointintervalbox 1\n", out);
  for (size_t i = 0; i < figure->lines; i++) {
    const struct gx_figure_line *line = &figure->line[i];
    bool open = line->marker % GX_FIGURE_MARKERS >= GX_FIGURE_SHAPES, many = line->style != GX_FIGURE_LINES_POINTS;
    bool thin = line->style == GX_FIGURE_CURVES || line->style == GX_FIGURE_POINTS; /* small open markers stay open */
    fprintf(out, "set style line %zu linecolor rgb '%s' linewidth %s dashtype %d", i + 1,
            colours[line->colour % GX_FIGURE_COLOURS], thin ? "0.8" : "1.6", line->dash % GX_FIGURE_DASHES + 1);
    if (has_markers(line))
      fprintf(out, " pointtype %d pointsize %s", markers[line->marker % GX_FIGURE_MARKERS], many ? "0.7" : "0.9");
    if (line->style == GX_FIGURE_LINES_POINTS && (figure->dense || open))
      fprintf(out, " pointinterval %s%zu", open ? "-" : "", figure->dense ? line->count / 8 + 1 : 1);
    putc('\n', out);
  }
}

static void put_title(const struct gx_figure_line *line, bool key, FILE *out)
{
  if (!key || line->style == GX_FIGURE_COLOURED) {
    fputs(" notitle", out);
    return;
  }
  fputs(" title \"", out);
  gx_gnuplot_text(line->label, out);
  if (!isnan(line->order)) fprintf(out, " (order %.1f)", fabs(line->order) < 0.05 ? 0 : line->order);
  putc('"', out);
}

static void put_line(const struct gx_figure *figure, size_t index, const char *stem, const struct gx_script_layout *layout,
                     bool key, FILE *out)
{
  static const char interrupted[] = "2:(strlen(strcol(3)) ? column(3) : NaN)", whole[] = "2:3", coloured[] = "2:3:5";
  const struct gx_figure_line *line = &figure->line[index];
  bool thin = line->style == GX_FIGURE_CURVES || line->style == GX_FIGURE_GUIDES;
  put_file(stem, "csv", out);
  fprintf(out, " skip 1 every ::%zu::%zu using %s with ", line->first, line->first + line->count - 1,
          line->style == GX_FIGURE_COLOURED ? coloured
          : thin                            ? interrupted
                                            : whole);
  switch (line->style) {
  case GX_FIGURE_LINES_POINTS:
    fprintf(out, "linespoints linestyle %zu", index + 1);
    break;
  case GX_FIGURE_POINTS:
    fprintf(out, "points linestyle %zu", index + 1);
    break;
  case GX_FIGURE_STEPS:
    fprintf(out, "steps linestyle %zu", index + 1);
    break;
  case GX_FIGURE_PRINTED:
    fputs("points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb '#000000'", out);
    break;
  case GX_FIGURE_CURVES:
    fprintf(out, "lines linestyle %zu", index + 1);
    break;
  case GX_FIGURE_GUIDES:
    fputs("lines linewidth 1.2 linecolor rgb '#303030'", out);
    break;
  case GX_FIGURE_EXACT:
    fputs("lines linewidth 1 linecolor rgb '#000000'", out);
    break;
  case GX_FIGURE_COLOURED:
    fprintf(out, "points pointtype 7 pointsize %.3g linecolor palette", layout->point);
    break;
  }
  put_title(line, key, out);
}

static void put_plot(const struct gx_figure *figure, const char *stem, const struct gx_script_layout *layout, size_t panel,
                     bool nyquist, FILE *out)
{
  const char *gap = "plot ";
  if (figure->triangles) {
    fprintf(out, "%s$triangles using 1:2 with lines linecolor rgb '#666666' notitle", gap);
    gap = ", \\\n     ";
  }
  for (size_t i = 0; i < figure->lines; i++) {
    if (figure->line[i].panel != panel) continue;
    fputs(gap, out);
    put_line(figure, i, stem, layout, panel == 0, out);
    gap = ", \\\n     ";
  }
  if (nyquist) fprintf(out, "%sNaN with lines dashtype 3 linecolor rgb '#666666' title 'Nyquist wavenumber of the grid'", gap);
  putc('\n', out);
}

static void put_panels(const struct gx_figure *figure, const char *stem, const struct gx_script_layout *layout, FILE *out)
{
  fputs("set multiplot\n", out);
  for (size_t p = 0; p < figure->panels; p++) {
    gx_script_layout_panel(figure, layout, p, out);
    put_plot(figure, stem, layout, p, false, out);
  }
  fputs("unset multiplot\n", out);
}

void gx_script_write(const struct gx_figure *figure, const char *stem, const char *ending, FILE *out)
{
  struct gx_script_layout layout = gx_script_layout_choose(figure);
  fputs(gx_script_mark, out);
  gx_script_layout_terminal(&layout, ending, out);
  fputs("set output ", out);
  put_file(stem, ending, out);
  fputs("\nset encoding utf8\nset datafile separator comma\n", out);
  gx_script_layout_write(figure, &layout, out);
  gx_script_axis_label("x", &figure->data->column[GX_FIGURE_X], out);
  gx_script_axis_label("y", &figure->data->column[GX_FIGURE_Y], out);
  gx_script_axis_scales(figure, out);
  fputs("set border 3\nset tics nomirror\n", out);
  if (!figure->panels) fputs("set grid linecolor rgb '#d0d0d0' linewidth 1\n", out); /* among edges of cells it would confuse */
  put_triangles(figure, out);
  bool nyquist = put_nyquist(figure, out);
  put_styles(figure, out);
  if (figure->panels)
    put_panels(figure, stem, &layout, out);
  else
    put_plot(figure, stem, &layout, 0, nyquist, out);
}
