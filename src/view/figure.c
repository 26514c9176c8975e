/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three files of a figure. */
#include "figure.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gridcross/store.h>

#include "gnuplot.h"
#include "script.h"

struct files {
  char *folder;                 /* with a slash at its end; "" where none is named */
  char *stem;                   /* without folder and ending */
  const char *image, *ending;   /* borrowed */
  char *data, *script, *beside; /* paths; the script as its folder sees it */
};

static void files_free(struct files *files)
{
  free(files->folder);
  free(files->stem);
  free(files->data);
  free(files->script);
  free(files->beside);
}

static char *join(const char *folder, const char *stem, const char *ending)
{
  size_t room = strlen(folder) + strlen(stem) + strlen(ending) + 2;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s%s.%s", folder, stem, ending);
  return path;
}

static enum gx_plot_status files_name(struct files *files, const char *output, FILE *errors)
{
  const char *slash = strrchr(output, '/'), *name = slash ? slash + 1 : output, *dot = strrchr(name, '.');
  *files = (struct files){.image = output, .ending = dot ? dot + 1 : ""};
  for (const char *c = output; *c; c++)
    if ((unsigned char)*c < ' ' || *c == 0x7F) {
      fputs("gridcross: the name of a figure cannot hold line breaks and other control characters\n", errors);
      return GX_PLOT_REFUSED;
    }
  if (!dot || dot == name || (strcmp(dot, ".svg") && strcmp(dot, ".png") && strcmp(dot, ".pdf"))) {
    fprintf(errors, "gridcross: '%s' does not say how to draw: end the figure's name in .svg, .png or .pdf\n", output);
    return GX_PLOT_REFUSED;
  }
  files->folder = slash ? strndup(output, (size_t)(name - output)) : strdup("");
  files->stem = strndup(name, (size_t)(dot - name));
  if (files->folder && files->stem) {
    files->data = join(files->folder, files->stem, "csv");
    files->script = join(files->folder, files->stem, "gp");
    files->beside = join("./", files->stem, "gp");
  }
  if (files->data && files->script && files->beside) return GX_PLOT_DONE;
  fputs("gridcross: out of memory\n", errors);
  return GX_PLOT_FAILED;
}

/* A script that we wrote speaks for the data beside it; other files, such as table.csv of a study, are left alone. */
static enum gx_plot_status files_check(const struct files *files, FILE *errors)
{
  char line[128] = "";
  FILE *script = fopen(files->script, "rb");
  bool ours = script && fgets(line, sizeof line, script) && !strcmp(line, gx_script_mark);
  const char *foreign = script && !ours ? files->script : !ours && !access(files->data, F_OK) ? files->data : NULL;
  if (script) fclose(script);
  if (!foreign) return GX_PLOT_DONE;
  fprintf(errors, "gridcross: %s is there and belongs to no figure: name another figure with -o\n", foreign);
  return GX_PLOT_REFUSED;
}

/* Beside its place, so that a full disk leaves an older one. Returns it, owned by the caller; NULL after a message. */
static char *write_beside(const char *path, const struct files *files, const struct gx_figure *figure, FILE *errors)
{
  const size_t room = strlen(path) + sizeof ".partial";
  char *partial = malloc(room);
  if (!partial) {
    fputs("gridcross: out of memory\n", errors);
    return NULL;
  }
  snprintf(partial, room, "%s.partial", path);
  FILE *out = fopen(partial, "wb");
  if (out && path == files->script)
    gx_script_write(figure, files->stem, files->ending, out);
  else if (out)
    gx_csv_write(figure->data, out);
  int failed = !out || fflush(out) || ferror(out);
  if (out && fclose(out)) failed = 1;
  if (!failed) return partial;
  fprintf(errors, "gridcross: cannot write %s: %s\n", path, strerror(errno));
  if (out) unlink(partial);
  free(partial);
  return NULL;
}

static int files_write(const struct files *files, const struct gx_figure *figure, FILE *errors)
{
  const char *const path[2] = {files->script, files->data};
  char *partial[2] = {NULL, NULL};
  int failed = 0;
  for (int i = 0; i < 2 && !failed; i++) failed = !(partial[i] = write_beside(path[i], files, figure, errors));
  for (int i = 0; i < 2; i++) {
    if (partial[i] && !failed && rename(partial[i], path[i])) {
      fprintf(errors, "gridcross: cannot write %s: %s\n", path[i], strerror(errno));
      failed = 1;
    }
    if (partial[i] && failed) unlink(partial[i]);
    free(partial[i]);
  }
  return failed;
}

enum gx_plot_status gx_figure_draw(const struct gx_figure *figure, const char *output, FILE *errors)
{
  struct files files;
  enum gx_plot_status status = files_name(&files, output, errors);
  if (!status) status = files_check(&files, errors);
  if (!status && files_write(&files, figure, errors)) status = GX_PLOT_FAILED;
  if (!status) {
    unlink(files.image); /* an older one would not fit the data beside it */
    if (gx_gnuplot_run(*files.folder ? files.folder : ".", files.beside, errors)) {
      fprintf(errors, "; %s and %s are written\n", files.script, files.data);
      status = GX_PLOT_FAILED;
    } else if (!gx_gnuplot_is_whole(files.image)) { /* gnuplot does not say so */
      fprintf(errors, "gridcross: %s could not be written whole: is the disk full?; %s and %s are written\n", files.image,
              files.script, files.data);
      unlink(files.image);
      status = GX_PLOT_FAILED;
    } else if (!strcmp(files.ending, "pdf") && gx_gnuplot_undate(files.image)) {
      fprintf(errors, "gridcross: cannot write %s: %s\n", files.image, strerror(errno));
      status = GX_PLOT_FAILED;
    }
  }
  files_free(&files);
  return status;
}

double gx_figure_number(const struct gx_figure *figure, size_t row, size_t column)
{
  return gx_value_number(gx_table_get(figure->data, row, column));
}

static void one_line(char *text) /* gnuplot reads the data by lines */
{
  for (char *c = text; *c; c++)
    if ((unsigned char)*c < ' ') *c = ' ';
}

int gx_figure_start(struct gx_figure *figure, size_t lines, size_t points, const struct gx_column *x, const struct gx_column *y,
                    const struct gx_column *value)
{
  if (!(figure->line = calloc(lines + 1, sizeof *figure->line))) return -1;
  if (!(figure->data = gx_table_create(value ? GX_FIGURE_VALUE + 1 : GX_FIGURE_VALUE, points))) return -1;
  figure->data->rows = 0; /* in use */
  return gx_table_column(figure->data, GX_FIGURE_LINE, "line", "", GX_INTEGER) ||
         gx_table_column(figure->data, GX_FIGURE_X, x->name, x->unit, x->type) ||
         gx_table_column(figure->data, GX_FIGURE_Y, y->name, y->unit, y->type) ||
         gx_table_column(figure->data, GX_FIGURE_LABEL, "label", "", GX_TEXT) ||
         (value && gx_table_column(figure->data, GX_FIGURE_VALUE, value->name, value->unit, value->type));
}

struct gx_figure_line *gx_figure_begin(struct gx_figure *figure, char *label)
{
  if (!label) return NULL;
  one_line(label);
  struct gx_figure_line *line = &figure->line[figure->lines++];
  *line = (struct gx_figure_line){.label = label, .first = figure->data->rows, .order = NAN, .nyquist = NAN};
  return line;
}

int gx_figure_add(struct gx_figure *figure, struct gx_value x, struct gx_value y)
{
  struct gx_figure_line *line = &figure->line[figure->lines - 1];
  size_t row = figure->data->rows++;
  line->count++;
  return gx_table_set(figure->data, row, GX_FIGURE_LINE, (struct gx_value){.type = GX_INTEGER, .integer = (long)figure->lines}) ||
         gx_table_set(figure->data, row, GX_FIGURE_X, x) || gx_table_set(figure->data, row, GX_FIGURE_Y, y) ||
         gx_table_set(figure->data, row, GX_FIGURE_LABEL, (struct gx_value){.type = GX_TEXT, .text = line->label});
}

int gx_figure_name(struct gx_figure *figure, const char *label)
{
  char *text = strdup(label);
  if (text) one_line(text);
  int failed = !text || gx_table_set(figure->data, figure->data->rows - 1, GX_FIGURE_LABEL,
                                     (struct gx_value){.type = GX_TEXT, .text = text});
  free(text);
  return failed;
}

int gx_figure_colour(struct gx_figure *figure, double value)
{
  return gx_table_set(figure->data, figure->data->rows - 1, GX_FIGURE_VALUE, gx_value_from(value));
}

void gx_figure_end(struct gx_figure *figure)
{
  struct gx_figure_line *line = &figure->line[figure->lines - 1];
  if (line->count) return;
  free(line->label);
  figure->lines--;
}

struct gx_figure_axis gx_figure_range(const struct gx_figure *figure, size_t column, double factor, size_t from)
{
  struct gx_figure_axis axis = {.least = INFINITY, .most = -INFINITY};
  for (size_t i = 0; i < figure->lines; i++)
    for (size_t p = figure->line[i].count > from ? from : 0; p < figure->line[i].count; p++) {
      double value = gx_figure_number(figure, figure->line[i].first + p, column);
      axis.least = fmin(axis.least, value);
      axis.most = fmax(axis.most, value);
    }
  axis.log = axis.least > 0 && axis.most >= factor * axis.least;
  return axis;
}

void gx_figure_free(struct gx_figure *figure)
{
  for (size_t i = 0; i < figure->lines; i++) free(figure->line[i].label);
  for (size_t i = 0; figure->panel && i < figure->panels; i++) free(figure->panel[i]);
  free(figure->line);
  free(figure->panel);
  free(figure->note);
  gx_table_free(figure->data);
}
