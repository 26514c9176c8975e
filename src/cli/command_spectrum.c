/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross spectrum: errors by wavenumber. */
#include "command.h"

#include <stdlib.h>
#include <string.h>

#include <gridcross/spectra.h>
#include <gridcross/store.h>

#include "../core/nearest.h"
#include "../view/axes.h"
#include "../view/sheet.h"

static const struct gx_option option[] = {
    {0, "case", "ID", "one case in time and by wavenumber; the first letters of its id do"},
    {0, "quantity", "displacement|velocity|stress", "of what; default: displacement"},
    {0, "csv", NULL, "print every sample and wavenumber as CSV, with all digits"},
    {0},
};

/* A study's table and the rows that are asked for. */
struct request {
  const char *directory; /* borrowed */
  struct gx_table *table;
  enum gx_quantity quantity;
  size_t rows, *row; /* owned */
};

static struct gx_value value_of(const struct gx_table *table, size_t row, const char *column)
{
  long c = gx_table_find(table, column);
  return c < 0 ? (struct gx_value){.type = GX_NULL} : gx_table_get(table, row, (size_t)c);
}

static const char *id_of(const struct gx_table *table, size_t row)
{
  struct gx_value id = value_of(table, row, "case");
  return id.type == GX_TEXT ? id.text : "";
}

/* A sample is taken at the start, whatever becomes of the case. */
static bool has_spectra(const struct gx_table *table, size_t row)
{
  struct gx_value every = value_of(table, row, "output.spectra"), steps = value_of(table, row, "result.steps");
  return every.type == GX_INTEGER && every.integer > 0 && steps.type == GX_INTEGER && steps.integer > 0;
}

static int choose_quantity(const struct gx_options *options, enum gx_quantity *quantity)
{
  const char *name = gx_options_value(options, "quantity");
  struct gx_nearest near = {.word = name};
  *quantity = GX_DISPLACEMENT;
  for (int q = 0; name && q < GX_QUANTITIES; q++) {
    gx_nearest_try(&near, gx_measure_quantity[q].name);
    if (strcmp(name, gx_measure_quantity[q].name) != 0) continue;
    *quantity = (enum gx_quantity)q;
    name = NULL;
  }
  if (!name) return GX_EXIT_DONE;
  fprintf(stderr, "gridcross spectrum: no quantity '%s'", name);
  if (*near.best) fprintf(stderr, ": did you mean %s?", near.best);
  fputs(*near.best ? "\n" : "; there are displacement, velocity and stress\n", stderr);
  return GX_EXIT_USAGE;
}

/* The cases that kept spectra, or the one that --case names. */
static int choose_rows(const struct gx_options *options, struct request *request)
{
  const char *id = gx_options_value(options, "case");
  const struct gx_table *table = request->table;
  size_t named = 0;
  if (!(request->row = calloc(table->rows + 1, sizeof *request->row))) return gx_command_no_memory();
  for (size_t r = 0; r < table->rows; r++) {
    if (id && strncmp(id_of(table, r), id, strlen(id)) != 0) continue;
    named++;
    if (has_spectra(table, r)) request->row[request->rows++] = r;
  }
  if (id && named != 1) {
    fprintf(stderr, "gridcross spectrum: %s case's id begins with '%s'; %s/table.csv lists them\n",
            named ? "more than one" : "no", id, request->directory);
    return GX_EXIT_USAGE;
  }
  if (request->rows) return GX_EXIT_DONE;
  fprintf(stderr, "gridcross spectrum: %s: %s no spectra: set output.spectra in the run file, and run that again\n",
          request->directory, id ? "this case has" : "its cases have");
  return GX_EXIT_USAGE;
}

static int print_csv(const struct request *request)
{
  struct gx_spectra **spectra = calloc(request->rows + 1, sizeof *spectra);
  const char **id = calloc(request->rows + 1, sizeof *id);
  int code = spectra && id ? GX_EXIT_DONE : gx_command_no_memory();
  for (size_t i = 0; i < request->rows && !code; i++) {
    id[i] = id_of(request->table, request->row[i]);
    spectra[i] = gx_store_read_spectra(request->directory, request->table, request->row[i], stderr);
    if (!spectra[i]) code = GX_EXIT_USAGE;
  }
  if (!code) {
    struct gx_table *table = gx_spectra_all(request->rows, spectra, id, request->quantity);
    if (table)
      gx_csv_write(table, stdout);
    else
      code = gx_command_no_memory();
    gx_table_free(table);
  }
  for (size_t i = 0; spectra && i < request->rows; i++) gx_store_free_spectra(spectra[i]);
  free(spectra);
  free(id);
  return code;
}

/* Takes the table. */
static int print_sheet(struct gx_table *table)
{
  int failed = !table || gx_command_print(table);
  gx_table_free(table);
  return failed ? gx_command_no_memory() : GX_EXIT_DONE;
}

static int print_one(const struct request *request)
{
  enum { TIMES = 13 };
  struct gx_spectra *spectra = gx_store_read_spectra(request->directory, request->table, request->row[0], stderr);
  if (!spectra) return GX_EXIT_USAGE;
  printf("case %s: error of %s, root mean square of its parts\n", id_of(request->table, request->row[0]),
         gx_measure_quantity[request->quantity].name);
  struct gx_value frequency = value_of(request->table, request->row[0], "result.frequency");
  struct gx_value ratio = value_of(request->table, request->row[0], "result.frequency.ratio");
  if (frequency.type == GX_REAL && ratio.type == GX_REAL)
    printf("frequency of the driven mode %.10g/s, exactly %.10g/s: ratio %.10g\n", frequency.real, frequency.real / ratio.real,
           ratio.real);
  printf("driven wavenumber %g/m, Nyquist wavenumber of the grid %g/m, %zu samples\n\n", spectra->driven, spectra->nyquist,
         spectra->samples);
  int code = print_sheet(gx_spectra_times(spectra, request->quantity, TIMES));
  if (!code) putchar('\n');
  if (!code) code = print_sheet(gx_spectra_wavenumbers(spectra, request->quantity));
  gx_store_free_spectra(spectra);
  return code;
}

/* Columns of the study's table for the cases asked for: what varies, and the summary of their spectra. */
static struct gx_table *summary(const struct request *request)
{
  static const char *const part[] = {"below", "above", "driven", "growth"};
  enum { PARTS = sizeof part / sizeof *part };
  const struct gx_table *full = request->table;
  size_t *column = calloc(full->columns + PARTS + 3, sizeof *column);
  long axes = column ? gx_axes_find(full, 0, column + 1) : -1;
  size_t count = (size_t)(axes + 1);
  for (size_t i = 0; i < PARTS && axes >= 0; i++) {
    char name[80];
    snprintf(name, sizeof name, "result.spectrum.%s.%s", gx_measure_quantity[request->quantity].name, part[i]);
    long c = gx_table_find(full, name);
    if (c >= 0) column[count++] = (size_t)c;
  }
  static const char *const other[] = {"result.frequency.ratio", "result.status"};
  for (size_t i = 0; i < sizeof other / sizeof *other && axes >= 0; i++) {
    long c = gx_table_find(full, other[i]);
    if (c >= 0) column[count++] = (size_t)c;
  }
  long id = gx_table_find(full, "case");
  if (id >= 0 && axes >= 0) column[0] = (size_t)id;
  struct gx_table *table = axes < 0 ? NULL : gx_table_create(count, request->rows);
  int failed = !table;
  for (size_t c = 0; c < count && !failed; c++) {
    const struct gx_column *from = &full->column[column[c]];
    failed = gx_table_column_like(table, c, from);
    for (size_t r = 0; r < request->rows && !failed; r++)
      failed = gx_table_set(table, r, c, gx_table_get(full, request->row[r], column[c]));
  }
  free(column);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static int run(const struct gx_options *options)
{
  struct request request = {.directory = options->operand[0]};
  int code = choose_quantity(options, &request.quantity);
  if (code) return code;
  if (!(request.table = gx_store_read(request.directory, stderr))) return GX_EXIT_USAGE;
  code = choose_rows(options, &request);
  if (!code && gx_options_value(options, "csv"))
    code = print_csv(&request);
  else if (!code && (request.rows == 1 || gx_options_value(options, "case")))
    code = print_one(&request);
  else if (!code)
    code = print_sheet(summary(&request));
  free(request.row);
  gx_table_free(request.table);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross run runs/spectra.yaml && gridcross spectrum spectra.study --quantity stress",
     "the stress below and above the Nyquist wavenumber of the grid"},
    {0},
};

const struct gx_command gx_command_spectrum = {
    .name = "spectrum",
    .operands = "DIR",
    .least = 1,
    .most = 1,
    .help =
        "Show errors by wavenumber, of studies run with output.spectra: the parts that the grid can hold and those it cannot.",
    .option = option,
    .example = example,
    .run = run,
};
