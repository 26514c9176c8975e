/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of particles as CSV: a header that names the columns x, y, z as the dimension asks, and volume, in any order, then a row a
 * particle. As HDF5: datasets of these names, read by whoever knows HDF5. Which of the two it is, the first bytes say. */
#include "points.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

enum { MOST_POINTS = 10000000, LINE = 1024, COLUMNS = GX_MAX_DIM + 1 };

static const double least_volume = 1e-30; /* m^dim: masses and their inverses stay numbers */

struct list {
  struct gx_points *points;
  struct gx_errors errors;
  size_t room;
  int line;
  int columns, of[COLUMNS]; /* of the file: 0 ... dim - 1 coordinates, dim the volume */
  char text[LINE];
};

static const char *name_of(int dim, int column)
{
  static const char *const names[] = {"x", "y", "z"};
  return column < dim ? names[column] : "volume";
}

static double **array_of(struct gx_points *points, int column)
{
  return column < points->dim ? &points->X[column] : &points->V0;
}

/* What is wrong with a value; false: nothing. */
static bool is_wrong(int dim, int column, double value, char wrong[128])
{
  const char *name = name_of(dim, column);
  *wrong = '\0';
  if (!(value >= -1e300 && value <= 1e300)) /* NaN too */
    snprintf(wrong, 128, "%s is not finite; give a finite number", name);
  else if (column < dim && !(value >= 0 && value <= 1))
    snprintf(wrong, 128, "%s is %g, outside the domain [0, 1]; move the point or leave it out", name, value);
  else if (column == dim && !(value >= least_volume && value <= 1))
    snprintf(wrong, 128, "volume is %g; it must be above 0 (%g at least) and at most that of the domain, 1", value, least_volume);
  return *wrong;
}

/* A line without its end. false: the file has ended, or reading on makes no sense. */
static bool read_line(struct list *list, FILE *file)
{
  struct gx_place place = {.line = ++list->line, .column = 1};
  size_t length = 0;
  int c = getc(file);
  if (c == EOF) return false;
  for (; c != EOF && c != '\n'; c = getc(file)) {
    if (c == '\0' || length + 1 == LINE) {
      gx_errors_add(&list->errors, place,
                    c ? "the line is longer than %d characters: not a list of points" : "holds a NUL byte: not a list of points",
                    LINE - 1);
      return false;
    }
    list->text[length++] = (char)c;
  }
  if (length && list->text[length - 1] == '\r') length--;
  list->text[length] = '\0';
  return true;
}

/* The next field of a line, trimmed and ended; NULL after the last. at: where to go on, NULL then. column: its first character. */
static char *next_field(struct list *list, char **at, int *column)
{
  char *field = *at, *end;
  if (!field) return NULL;
  end = field + strcspn(field, ",");
  *at = *end ? end + 1 : NULL;
  *end = '\0';
  field += strspn(field, " \t");
  while (end > field && (end[-1] == ' ' || end[-1] == '\t')) *--end = '\0';
  if (end - field > 1 && *field == '"' && end[-1] == '"') { /* as spreadsheets write them */
    *--end = '\0';
    field++;
  }
  *column = (int)(field - list->text) + 1;
  return field;
}

static void report_column(struct list *list, struct gx_place place, const char *name)
{
  int dim = list->points->dim;
  for (int d = dim; d < GX_MAX_DIM; d++)
    if (!strcmp(name, name_of(GX_MAX_DIM, d))) {
      gx_errors_add(&list->errors, place, "column '%s' does not suit dimension %d; remove it, or set problem.dimension: %d", name,
                    dim, d + 1);
      return;
    }
  gx_errors_add(&list->errors, place, "unknown column %s; give x%s%s and volume", gx_errors_quote(name).text,
                dim > 1 ? ", y" : "", dim > 2 ? ", z" : "");
}

static void read_header(struct list *list)
{
  const int dim = list->points->dim;
  struct gx_place place = {.line = list->line, .column = 1};
  char *at = list->text, *field;
  bool found[COLUMNS] = {false};
  if (!strncmp(at, "\xef\xbb\xbf", 3)) at += 3; /* a byte-order mark */
  while ((field = next_field(list, &at, &place.column))) {
    int column = 0;
    while (column <= dim && strcmp(field, name_of(dim, column)) != 0) column++;
    if (column > dim)
      report_column(list, place, field);
    else if (found[column])
      gx_errors_add(&list->errors, place, "column '%s' is given twice; remove one", field);
    else
      list->of[list->columns++] = column;
    if (column <= dim) found[column] = true;
  }
  place.column = 1;
  for (int column = 0; column <= dim; column++)
    if (!found[column])
      gx_errors_add(&list->errors, place, "there is no column '%s'; name it in the header", name_of(dim, column));
  if (list->columns) return;
  list->errors.count = 0; /* its fields are no names at all: one message says it */
  gx_errors_add(&list->errors, place, "no column is named x%s%s or volume; begin with the line x%s%s,volume",
                dim > 1 ? ", y" : "", dim > 2 ? ", z" : "", dim > 1 ? ",y" : "", dim > 2 ? ",z" : "");
}

static bool make_room(struct list *list)
{
  struct gx_points *points = list->points;
  size_t room = list->room ? 2 * list->room : 1024;
  if (points->n < list->room) return true;
  for (int column = 0; column <= points->dim; column++) {
    double *more = realloc(*array_of(points, column), room * sizeof *more);
    if (more) *array_of(points, column) = more;
    list->errors.out_of_memory |= !more;
  }
  list->room = room;
  return !list->errors.out_of_memory;
}

static void read_row(struct list *list)
{
  struct gx_points *points = list->points;
  struct gx_place place = {.line = list->line, .column = 1};
  char *at = list->text, *field, wrong[128];
  int fields = 0;
  if (!list->text[strspn(list->text, " \t")] || !make_room(list)) return;
  for (; (field = next_field(list, &at, &place.column)); fields++) {
    double value;
    if (fields >= list->columns) continue;
    const char *name = name_of(points->dim, list->of[fields]), *bad = gx_number_real(field, &value);
    if (bad)
      gx_errors_add(&list->errors, place, "%s: %s %s", name, gx_errors_quote(field).text, bad);
    else if (is_wrong(points->dim, list->of[fields], value, wrong))
      gx_errors_add(&list->errors, place, "%s", wrong);
    else
      (*array_of(points, list->of[fields]))[points->n] = value;
  }
  place.column = 1;
  if (fields != list->columns)
    gx_errors_add(&list->errors, place, "%d value%s in a row of %d; give one for each column of the header", fields,
                  fields == 1 ? "" : "s", list->columns);
  points->n++;
}

static void read_csv(struct list *list, FILE *file)
{
  struct gx_place whole = {.line = 0};
  if (read_line(list, file)) read_header(list);
  if (list->errors.count) return;
  while (!gx_errors_full(&list->errors) && read_line(list, file)) {
    if (list->points->n == MOST_POINTS) {
      gx_errors_add(&list->errors, (struct gx_place){.line = list->line, .column = 1}, "more than %d points; give fewer",
                    MOST_POINTS);
      return;
    }
    read_row(list);
  }
  if (ferror(file))
    gx_errors_add(&list->errors, whole, "cannot be read: %s", strerror(errno));
  else if (!list->points->n && !list->errors.count)
    gx_errors_add(&list->errors, whole, "holds no point; give a row a point below the header x%s%s,volume",
                  list->points->dim > 1 ? ",y" : "", list->points->dim > 2 ? ",z" : "");
}

/* Messages of the reader go to `out` at once. Returns 0, or -1 after one. */
static int read_hdf5(struct list *list, const char *path, const struct gx_array_reader *hdf5, FILE *out)
{
  struct gx_points *points = list->points;
  const char *name[COLUMNS];
  const char *absent[COLUMNS] = {NULL};
  double *array[COLUMNS] = {NULL};
  char wrong[128];
  for (int d = points->dim; d < GX_MAX_DIM; d++) absent[d - points->dim] = name_of(GX_MAX_DIM, d);
  for (int column = 0; column <= points->dim; column++) name[column] = name_of(points->dim, column);
  int failed = hdf5->read(path, (size_t)points->dim + 1, name, absent, MOST_POINTS, array, &points->n, out);
  for (int column = 0; column <= points->dim; column++) {
    *array_of(points, column) = array[column];
    for (size_t p = 0; p < points->n && !failed; p++)
      if (is_wrong(points->dim, column, array[column][p], wrong))
        gx_errors_add(&list->errors, (struct gx_place){.line = 0}, "point %zu: %s", p, wrong);
  }
  return failed;
}

static bool is_hdf5(FILE *file)
{
  int first = getc(file);
  ungetc(first, file); /* a pipe cannot go back further */
  return first == 0x89;
}

static void check_sum(struct list *list)
{
  double sum = 0;
  for (size_t p = 0; p < list->points->n; p++) sum += list->points->V0[p];
  if (sum > 1 + 1e-6)
    gx_errors_add(&list->errors, (struct gx_place){.line = 0},
                  "the volumes add up to %g, more than that of the domain, 1; give smaller ones", sum);
}

/* file: of that path, closed here. Returns 0, or -1 after messages. */
static int read_list(const char *path, FILE *file, struct gx_points *points, const struct gx_array_reader *hdf5, FILE *out)
{
  struct gx_place whole = {.line = 0};
  struct list list = {.points = points};
  int failed = 0;
  if (!is_hdf5(file))
    read_csv(&list, file);
  else if (hdf5)
    failed = read_hdf5(&list, path, hdf5, out);
  else
    gx_errors_add(&list.errors, whole, "is an HDF5 file, which cannot be read here; give the points as CSV");
  fclose(file);
  if (!failed && !list.errors.count && !list.errors.out_of_memory) check_sum(&list);
  if (list.errors.count || list.errors.out_of_memory) {
    gx_errors_print(&list.errors, path, NULL, out);
    failed = -1;
  }
  gx_errors_free(&list.errors);
  return failed;
}

void gx_points_free(struct gx_points *points)
{
  if (!points) return;
  for (int d = 0; d < GX_MAX_DIM; d++) free(points->X[d]);
  free(points->V0);
  free(points->path);
  free(points);
}

/* Owned by the caller; NULL when memory runs out. */
static char *path_from(const char *runfile, const char *name)
{
  const char *slash = *name == '/' ? NULL : strrchr(runfile, '/');
  size_t directory = slash ? (size_t)(slash - runfile) + 1 : 0, room = directory + strlen(name) + 1;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%.*s%s", (int)directory, runfile, name);
  return path;
}

/* Where the run file names that list. */
static struct gx_item *item_of(const struct gx_settings *settings, const char *name)
{
  for (const struct gx_layer *layer = &settings->base; layer; layer = layer == &settings->base ? settings->cases : layer->next) {
    struct gx_setting *setting = gx_setting_find(layer, GX_BODY_FILE);
    for (size_t i = 0; setting && i < setting->count; i++)
      if (setting->item[i].value.text == name) return &setting->item[i]; /* each has its own copy */
  }
  return NULL;
}

static void report_closed(struct gx_settings *settings, const char *name, const char *path, const char *why)
{
  struct gx_item *item = item_of(settings, name);
  if (item && item->refused) return;
  if (item) item->refused = true;
  gx_errors_add(settings->errors, item ? item->place : (struct gx_place){.line = 0}, "body.file: '%s' cannot be opened: %s", path,
                why);
}

/* A new list of the study, empty; NULL when memory runs out. */
static struct gx_points *add_list(struct gx_study *study, const char *path, int dim)
{
  struct gx_points **more = realloc(study->points, (study->point_lists + 1) * sizeof *more);
  if (more) study->points = more;
  struct gx_points *points = more ? calloc(1, sizeof *points) : NULL;
  if (!points) return NULL;
  *points = (struct gx_points){.dim = dim, .path = strdup(path)};
  study->points[study->point_lists++] = points;
  return points->path ? points : NULL;
}

/* The list of that name and path in a case's dimension, read if it is new. Returns 0, or -1 after messages. */
static int give(struct gx_settings *settings, struct gx_case *one, const char *path, const struct gx_array_reader *hdf5,
                FILE *out)
{
  struct gx_study *study = settings->study;
  int dim = (int)one->value[GX_PROBLEM_DIMENSION].integer;
  for (size_t i = 0; i < study->point_lists && !one->points; i++)
    if (study->points[i]->dim == dim && !strcmp(study->points[i]->path, path)) one->points = study->points[i];
  if (one->points) return 0;
  FILE *file = fopen(path, "rb");
  if (!file) {
    report_closed(settings, one->value[GX_BODY_FILE].text, path, strerror(errno));
    return -1;
  }
  struct gx_points *points = add_list(study, path, dim);
  one->points = points;
  if (points) return read_list(path, file, points, hdf5, out);
  fclose(file);
  settings->errors->out_of_memory = true;
  return -1;
}

int gx_points_read(struct gx_settings *settings, const char *runfile, const struct gx_array_reader *hdf5, FILE *out)
{
  struct gx_study *study = settings->study;
  int failed = 0;
  for (size_t i = 0; i < study->count && !gx_errors_full(settings->errors); i++) {
    struct gx_case *one = &study->cases[i];
    if (one->value[GX_BODY_FILE].type != GX_TEXT) continue;
    char *path = path_from(runfile, one->value[GX_BODY_FILE].text);
    if (!path) settings->errors->out_of_memory = true;
    if (!path || give(settings, one, path, hdf5, out)) failed = -1;
    free(path);
  }
  return failed;
}
