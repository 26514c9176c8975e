/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scripts for gnuplot 5. Text from outside is quoted with what gnuplot would substitute as octal numbers, and never `enhanced`;
 * files are named from ./ on, so that none reads as a pipe ("|..."), a command ("< ...") or an option. */
#include "gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LISTED = 8 }; /* at most so many values of x each have a tic */

const char gx_gnuplot_mark[] = "# gridcross plot overwrites this file: restyle a copy. To draw: gnuplot FILE.gp\n";

/* Okabe and Ito's palette, yellow left out: too light on white. */
static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
static const int markers[] = {7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14};
_Static_assert(sizeof colours / sizeof *colours == GX_FIGURE_COLOURS, "plots choose among them");
enum { MARKERS = sizeof markers / sizeof *markers, DASHES = 5 };

/* Bytes of a well-formed UTF-8 character, 0: it is none. */
static size_t character(const char *text)
{
  const unsigned char *c = (const unsigned char *)text;
  size_t length = *c < 0x80 ? 1 : *c >= 0xC2 && *c < 0xE0 ? 2 : *c >= 0xE0 && *c < 0xF0 ? 3 : *c >= 0xF0 && *c < 0xF5 ? 4 : 0;
  for (size_t i = 1; i < length; i++)
    if ((c[i] & 0xC0) != 0x80) return 0;
  return length;
}

/* Part of a text in double quotes. Single ones would be simpler, were it not that gnuplot 5.4 ends '''' after two. */
static void put_quoted(const char *text, size_t length, FILE *out)
{
  for (size_t i = 0; i < length; i++) fprintf(out, strchr("\"\\`@", text[i]) ? "\\%03o" : "%c", (unsigned char)text[i]);
}

/* The same for text to be seen: a line break would break the line, and what is no character would spoil the image. */
static void put_part(const char *text, FILE *out)
{
  for (size_t length; *text; text += length ? length : 1) {
    length = character(text);
    if (length == 0)
      putc('?', out);
    else if ((unsigned char)*text < ' ' || *text == 0x7F)
      putc(' ', out);
    else
      put_quoted(text, length, out);
  }
}

static void put_axis_label(const char *axis, const struct gx_column *column, FILE *out)
{
  fprintf(out, "set %slabel \"", axis);
  put_part(column->name, out);
  if (*column->unit) {
    fputs(" [", out);
    put_part(column->unit, out);
    fputs("]", out);
  }
  fputs("\" noenhanced\n", out);
}

static int by_size(const void *left, const void *right)
{
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* The values of x, when there are few. Returns how many, 0: many. */
static size_t few_values(const struct gx_figure *figure, double value[LISTED])
{
  size_t count = 0;
  for (size_t r = 0; r < figure->data->rows; r++) {
    double x = gx_figure_number(figure, r, GX_FIGURE_X);
    size_t i = 0;
    while (i < count && value[i] != x) i++;
    if (i < count) continue;
    if (count == LISTED) return 0;
    value[count++] = x;
  }
  qsort(value, count, sizeof *value, by_size);
  return count;
}

static void put_range(const char *name, const struct gx_figure_axis *axis, FILE *out)
{
  double least = axis->least, most = axis->most;
  if (axis->log) {
    double room = pow(most / least, 0.05);
    least /= room;
    most *= room;
  } else if (least == most) { /* gnuplot would warn */
    double room = least != 0 ? fabs(least) / 2 : 1;
    least -= room;
    most += room;
  } else {
    return;
  }
  fprintf(out, "set %srange [%.6g:%.6g]\n", name, least, most);
}

static void put_axis(const char *name, const struct gx_figure_axis *axis, size_t values, const double *value, FILE *out)
{
  char text[GX_NUMBER_LENGTH];
  const char *gap = "";
  put_range(name, axis, out);
  if (!axis->log) {
    bool small = fmax(fabs(axis->least), fabs(axis->most)) < 1e-3; /* whose zeros would push the label off the figure */
    if (small) fprintf(out, "set format %s '%%.1te%%T'\n", name);
    return;
  }
  fprintf(out, "set logscale %s\n", name);
  if (!values && axis->most / axis->least > 100) {
    fprintf(out, "set format %s '10^{%%L}'\n", name);
    return;
  }
  fprintf(out, "set %stics (", name);
  for (size_t i = 0; i < values; i++, gap = ", ") {
    gx_value_real(value[i], text);
    fprintf(out, "%s'%s' %s", gap, text, text);
  }
  for (int k = (int)floor(log10(axis->least)); !values && k <= (int)ceil(log10(axis->most)); k++)
    for (int digit = 1; digit <= 5; digit += digit == 1 ? 1 : 3, gap = ", ")
      fprintf(out, "%s'%de%d' %de%d", gap, digit, k, digit, k);
  fputs(")\n", out);
}

/* Terminal and margins. Where the legend stands is not left to gnuplot, whose guess at the width of SVG text is poor; of a legend
 * higher than the plot it would drop the end. */
static void put_layout(const struct gx_figure *figure, const char *ending, FILE *out)
{
  enum { LEFT = 105, RIGHT = 655, GAP = 20, LINE = 21, SAMPLE = 90, LETTER = 8 };
  bool key = figure->lines > 1 || *figure->line[0].label;
  size_t widest = 0;
  for (size_t i = 0; i < figure->lines; i++) {
    size_t length = strlen(figure->line[i].label) + (isnan(figure->line[i].order) ? 0 : strlen(" (order 1.0)"));
    if (length > widest) widest = length;
  }
  double width = RIGHT + GAP + (key ? SAMPLE + LETTER * (double)widest : 0), height = LINE * (double)figure->lines + 140;
  if (height < 480) height = 480;
  if (!strcmp(ending, "svg"))
    fprintf(out, "set terminal svg size %.0f,%.0f font 'sans-serif,13' background '#ffffff'\n", width, height);
  else if (!strcmp(ending, "pdf"))
    fprintf(out, "set terminal pdfcairo size %.2f,%.2f font 'sans,16' linewidth 1.5 pointscale 0.6\n", width / 96, height / 96);
  else
    fprintf(out,
            "if (strstrt(GPVAL_TERMINALS, 'pngcairo')) {\n"
            "  set terminal pngcairo size %.0f,%.0f font 'sans,10' fontscale 2 linewidth 2 pointscale 2\n"
            "} else {\n"
            "  set terminal png size %.0f,%.0f\n"
            "}\n",
            2 * width, 2 * height, width, height);
  fprintf(out, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", LEFT / width, RIGHT / width);
  if (key)
    fprintf(out, "set key noenhanced at screen %.4f,%.4f left top vertical maxcols 1 Left reverse\n", (RIGHT + GAP) / width,
            1 - 40 / height);
  else
    fputs("unset key\n", out);
}

/* A right-angled triangle under the steepest line: 1 along x, the slope along y. */
static void put_triangle(const struct gx_figure *figure, FILE *out)
{
  const double(*at)[2] = figure->triangle;
  const char *side = at[2][0] < at[1][0] ? "right offset -0.5,0" : "left offset 0.5,0";
  fputs("$triangle << EOD\n", out);
  for (int i = 0; i < 4; i++) fprintf(out, "%.17g,%.17g\n", at[i % 3][0], at[i % 3][1]);
  fputs("EOD\n", out);
  fprintf(out, "set label '%.1f' at %.17g,%.17g %s\n", figure->triangle_slope, at[2][0], sqrt(at[0][1] * at[2][1]), side);
  fprintf(out, "set label '1' at %.17g,%.17g center offset 0,-0.8\n", sqrt(at[1][0] * at[2][0]), at[2][1]);
}

/* Vertical lines where the grids of the lines end, each once. */
static void put_nyquist(const struct gx_figure *figure, FILE *out)
{
  for (size_t i = 0; i < figure->lines; i++) {
    double at = figure->line[i].nyquist;
    bool seen = isnan(at) || (figure->x.log && at <= 0);
    for (size_t k = 0; k < i && !seen; k++) seen = figure->line[k].nyquist == at;
    if (seen) continue;
    fprintf(out, "set arrow from first %.17g, graph 0 to first %.17g, graph 1 nohead dashtype 3 linecolor rgb '#666666'\n", at,
            at);
    fprintf(out, "set label 'Nyquist' at first %.17g, graph 0.97 right rotate by 90 offset -1.2,0 textcolor rgb '#666666'\n", at);
  }
}

/* "./<name>.<ending>", byte for byte */
static void put_file(const char *name, const char *ending, FILE *out)
{
  fputs("\"./", out);
  put_quoted(name, strlen(name), out);
  fprintf(out, ".%s\"", ending);
}

static void put_lines(const struct gx_figure *figure, const char *stem, FILE *out)
{
  static const char *const with[] = {
      [GX_FIGURE_LINES_POINTS] = "linespoints", [GX_FIGURE_POINTS] = "points", [GX_FIGURE_STEPS] = "steps"};
  for (size_t i = 0; i < figure->lines; i++) {
    const struct gx_figure_line *line = &figure->line[i];
    fprintf(out, "set style line %zu linecolor rgb '%s' linewidth 1.6 dashtype %d pointtype %d pointsize %s", i + 1,
            colours[line->colour % GX_FIGURE_COLOURS], line->dash % DASHES + 1, markers[line->marker % MARKERS],
            line->style == GX_FIGURE_POINTS ? "0.6" : "0.9");
    if (figure->dense) fprintf(out, " pointinterval %zu", line->count / 8 + 1);
    putc('\n', out);
  }
  fputs("plot ", out);
  if (figure->triangle_slope != 0) fputs("$triangle using 1:2 with lines linecolor rgb '#666666' notitle, \\\n     ", out);
  for (size_t i = 0; i < figure->lines; i++) {
    const struct gx_figure_line *line = &figure->line[i];
    if (i) fputs(", \\\n     ", out);
    put_file(stem, "csv", out);
    fprintf(out, " skip 1 every ::%zu::%zu using %d:%d with ", line->first, line->first + line->count - 1, GX_FIGURE_X + 1,
            GX_FIGURE_Y + 1);
    if (line->style == GX_FIGURE_PRINTED)
      fputs("points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb '#000000' title \"", out);
    else
      fprintf(out, "%s linestyle %zu title \"", with[line->style], i + 1);
    put_part(line->label, out);
    if (!isnan(line->order)) fprintf(out, " (order %.1f)", fabs(line->order) < 0.05 ? 0 : line->order);
    putc('"', out);
  }
  putc('\n', out);
}

void gx_gnuplot_write(const struct gx_figure *figure, const char *stem, const char *ending, FILE *out)
{
  double value[LISTED];
  fputs(gx_gnuplot_mark, out);
  put_layout(figure, ending, out);
  fputs("set output ", out);
  put_file(stem, ending, out);
  fputs("\nset encoding utf8\nset datafile separator comma\n", out);
  if (*figure->title) {
    fputs("set title \"", out);
    put_part(figure->title, out);
    fputs("\" noenhanced\n", out);
  }
  put_axis_label("x", &figure->data->column[GX_FIGURE_X], out);
  put_axis_label("y", &figure->data->column[GX_FIGURE_Y], out);
  put_axis("x", &figure->x, figure->few_x && figure->x.log ? few_values(figure, value) : 0, value, out);
  put_axis("y", &figure->y, 0, value, out);
  fputs("set border 3\nset tics nomirror\nset grid linecolor rgb '#d0d0d0' linewidth 1\n", out);
  if (figure->triangle_slope != 0) put_triangle(figure, out);
  put_nyquist(figure, out);
  put_lines(figure, stem, out);
}

/* Without a shell. -d: nobody's own settings change the figure. */
static int spawn(char *const *arguments, int *status)
{
  extern char **environ;
  posix_spawn_file_actions_t actions;
  pid_t child;
  int error = posix_spawn_file_actions_init(&actions);
  if (error) return error;
  error = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (!error) error = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (!error) error = posix_spawnp(&child, arguments[0], &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  while (!error && waitpid(child, status, 0) < 0)
    if (errno != EINTR) error = errno;
  return error;
}

/* cd "<folder>", owned by the caller; a leading ~ would be a home. */
static char *change_folder(const char *folder)
{
  char *command = NULL;
  size_t length;
  FILE *out = open_memstream(&command, &length);
  if (!out) return NULL;
  fputs(*folder == '/' ? "cd \"" : "cd \"./", out);
  put_quoted(folder, strlen(folder), out);
  putc('"', out);
  if (!fclose(out)) return command;
  free(command);
  return NULL;
}

int gx_gnuplot_run(const char *folder, const char *script, FILE *errors)
{
  char gnuplot[] = "gnuplot", plain[] = "-d", execute[] = "-e", *change = change_folder(folder), *name = strdup(script);
  char *const arguments[] = {gnuplot, plain, execute, change, name, NULL};
  int status = 0, error = change && name ? spawn(arguments, &status) : ENOMEM;
  free(change);
  free(name);
  if (error == ENOENT)
    fputs("gridcross: gnuplot is not installed: apt-get install gnuplot-nox, then plot again", errors);
  else if (error)
    fprintf(errors, "gridcross: cannot run gnuplot: %s", strerror(error));
  else if (!WIFEXITED(status) || WEXITSTATUS(status))
    fputs("gridcross: gnuplot could not draw the figure", errors);
  else
    return 0;
  return -1;
}
