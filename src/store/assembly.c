/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The four files of a study, written side by side. */
#include "assembly.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "hdf5_write.h"

enum { ROWS = 512 }; /* written at once */

const char *const gx_assembly_name[GX_ASSEMBLY_FILES] = {[GX_ASSEMBLY_STUDY] = "study.h5",
                                                         [GX_ASSEMBLY_TABLE] = "table.csv",
                                                         [GX_ASSEMBLY_TIMING] = "timing.csv",
                                                         [GX_ASSEMBLY_RUN] = "run.json"};

struct gx_assembly {
  const char *directory;
  FILE *errors;
  char *path[GX_ASSEMBLY_FILES]; /* owned: partial ones */
  FILE *text[GX_ASSEMBLY_FILES]; /* of the files that are texts */
  struct gx_hdf5_writer *study;
  struct gx_table *part, *timing; /* owned: rows to be written */
  size_t rows;                    /* of part that are filled */
  struct gx_value repeats;
  bool failed;
};

char *gx_assembly_path(const char *directory, const char *prefix, const char *name, const char *suffix)
{
  size_t room = strlen(directory) + strlen(prefix) + strlen(name) + strlen(suffix) + 2;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s/%s%s%s", directory, prefix, name, suffix);
  return path;
}

int gx_assembly_say(FILE *errors, const char *path)
{
  fprintf(errors, "%s: %s\n", path ? path : "study", path ? strerror(errno) : "out of memory");
  return -1;
}

static int fail(struct gx_assembly *assembly, const char *path)
{
  assembly->failed = true;
  return gx_assembly_say(assembly->errors, path);
}

/* As many rows of null with the columns of another table. */
static struct gx_table *table_like(const struct gx_table *like, size_t rows)
{
  struct gx_table *table = gx_table_create(like->columns, rows);
  int failed = !table;
  for (size_t c = 0; c < like->columns && !failed; c++) failed = gx_table_column_like(table, c, &like->column[c]);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static struct gx_table *timing_table(const struct gx_table *like)
{
  struct gx_table *table = gx_table_create(4, ROWS);
  const struct gx_column *seconds = &like->column[like->columns - 2];
  int failed = !table || gx_table_column(table, 0, "case", "", GX_TEXT) ||
               gx_table_column(table, 1, "seconds", seconds[0].unit, GX_REAL) ||
               gx_table_column(table, 2, "ns_per_particle_step", seconds[1].unit, GX_REAL) ||
               gx_table_column(table, 3, "repeats", "", GX_INTEGER);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static int open_text(struct gx_assembly *assembly, int which)
{
  assembly->text[which] = fopen(assembly->path[which], "wb");
  return assembly->text[which] ? 0 : fail(assembly, assembly->path[which]);
}

static int begin(struct gx_assembly *assembly, const struct gx_table *like, size_t cases)
{
  for (int f = 0; f < GX_ASSEMBLY_FILES; f++)
    if (!(assembly->path[f] = gx_assembly_path(assembly->directory, ".", gx_assembly_name[f], ".partial")))
      return fail(assembly, NULL);
  assembly->part = table_like(like, ROWS);
  assembly->timing = timing_table(like);
  if (!assembly->part || !assembly->timing) return fail(assembly, NULL);
  assembly->study = gx_hdf5_write_begin(assembly->path[GX_ASSEMBLY_STUDY], like, like->columns - 2, cases, assembly->errors);
  if (!assembly->study) assembly->failed = true;
  if (!assembly->study || open_text(assembly, GX_ASSEMBLY_TABLE) || open_text(assembly, GX_ASSEMBLY_TIMING)) return -1;
  gx_csv_write_head(like, like->columns - 2, assembly->text[GX_ASSEMBLY_TABLE]);
  gx_csv_write_head(assembly->timing, 4, assembly->text[GX_ASSEMBLY_TIMING]);
  return 0;
}

struct gx_assembly *gx_assembly_begin(const char *directory, const struct gx_table *like, size_t cases, size_t repeats,
                                      FILE *errors)
{
  struct gx_assembly *assembly = calloc(1, sizeof *assembly);
  if (!assembly) {
    gx_assembly_say(errors, NULL);
    return NULL;
  }
  *assembly =
      (struct gx_assembly){.directory = directory, .errors = errors, .repeats = {.type = GX_INTEGER, .integer = (long)repeats}};
  if (!begin(assembly, like, cases)) return assembly;
  gx_assembly_end(assembly, NULL, NULL);
  return NULL;
}

/* Also starts the part anew, so that texts do not pile up. */
static int write_part(struct gx_assembly *assembly)
{
  struct gx_table *part = assembly->part, *timing = assembly->timing;
  const size_t rows = assembly->rows, columns = part->columns - 2;
  int failed = gx_hdf5_write_rows(assembly->study, part, rows);
  if (failed) assembly->failed = true;
  gx_csv_write_rows(part, columns, rows, assembly->text[GX_ASSEMBLY_TABLE]);
  for (size_t r = 0; r < rows && !failed; r++)
    failed = gx_table_set(timing, r, 0, gx_table_get(part, r, 0)) || gx_table_set(timing, r, 1, gx_table_get(part, r, columns)) ||
             gx_table_set(timing, r, 2, gx_table_get(part, r, columns + 1)) || gx_table_set(timing, r, 3, assembly->repeats);
  if (failed && !assembly->failed) fail(assembly, NULL);
  gx_csv_write_rows(timing, 4, rows, assembly->text[GX_ASSEMBLY_TIMING]);
  gx_table_clear(part);
  gx_table_clear(timing);
  assembly->rows = 0;
  for (int f = GX_ASSEMBLY_TABLE; f <= GX_ASSEMBLY_TIMING && !failed; f++)
    if (ferror(assembly->text[f])) failed = fail(assembly, assembly->path[f]);
  return failed ? -1 : 0;
}

static int put_kept(struct gx_assembly *assembly, enum gx_hdf5_kept what, const char *id, const struct gx_table *kept)
{
  if (!kept || !kept->rows || !gx_hdf5_write_kept(assembly->study, what, id, kept)) return 0;
  assembly->failed = true;
  return -1;
}

static int end_row(struct gx_assembly *assembly, const char *id, const struct gx_table *history, const struct gx_table *spectra)
{
  if (put_kept(assembly, GX_HDF5_HISTORIES, id, history) || put_kept(assembly, GX_HDF5_SPECTRA, id, spectra)) return -1;
  return ++assembly->rows < ROWS ? 0 : write_part(assembly);
}

int gx_assembly_put(struct gx_assembly *assembly, const struct gx_case *one, const struct gx_result *result)
{
  struct gx_table *history = result->history.samples ? gx_study_table_history(result) : NULL;
  struct gx_table *spectra = result->spectra.samples ? gx_study_table_spectra(result) : NULL;
  int failed = (result->history.samples && !history) || (result->spectra.samples && !spectra) ||
               gx_study_table_fill(assembly->part, assembly->rows, one, result, true);
  failed = failed ? fail(assembly, NULL) : end_row(assembly, one->id, history, spectra);
  gx_table_free(history);
  gx_table_free(spectra);
  return failed;
}

int gx_assembly_put_row(struct gx_assembly *assembly, const struct gx_table *table, size_t row, const struct gx_table *history,
                        const struct gx_table *spectra)
{
  int failed = 0;
  for (size_t c = 0; c < assembly->part->columns && !failed; c++)
    failed = gx_table_set(assembly->part, assembly->rows, c, gx_table_get(table, row, c));
  if (failed) return fail(assembly, NULL);
  return end_row(assembly, gx_table_get(assembly->part, assembly->rows, 0).text, history, spectra);
}

static int write_run(struct gx_assembly *assembly, const struct gx_store_run *run)
{
  char host[256] = "", date[32] = "";
  time_t now = time(NULL);
  struct tm utc;
  gethostname(host, sizeof host - 1);
  if (gmtime_r(&now, &utc)) strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
  const struct {
    const char *name;
    struct gx_value value;
  } column[] = {{"host", {.type = GX_TEXT, .text = host}},
                {"date", {.type = GX_TEXT, .text = date}},
                {"command", {.type = GX_TEXT, .text = run->command}},
                {"seconds", {.type = GX_REAL, .real = run->seconds}}};
  struct gx_table *table = gx_table_create(4, 1);
  int failed = !table;
  for (size_t c = 0; c < 4 && !failed; c++)
    failed = gx_table_column(table, c, column[c].name, "", column[c].value.type) || gx_table_set(table, 0, c, column[c].value);
  failed = failed ? fail(assembly, NULL) : open_text(assembly, GX_ASSEMBLY_RUN);
  if (!failed) {
    gx_json_write_object(table, 0, assembly->text[GX_ASSEMBLY_RUN]);
    putc('\n', assembly->text[GX_ASSEMBLY_RUN]);
  }
  gx_table_free(table);
  return failed;
}

static int close_text(struct gx_assembly *assembly, int which)
{
  FILE *out = assembly->text[which];
  assembly->text[which] = NULL;
  if (!out) return 0;
  /* EINVAL: a file system that cannot flush; nothing more to be done there. */
  int failed = fflush(out) || ferror(out) || (!assembly->failed && fsync(fileno(out)) && errno != EINVAL) ? -1 : 0;
  if (failed && !assembly->failed) fail(assembly, assembly->path[which]);
  if (fclose(out) && !failed && !assembly->failed) failed = fail(assembly, assembly->path[which]);
  return failed;
}

static int rename_all(struct gx_assembly *assembly)
{
  int failed = 0;
  for (int f = 0; f < GX_ASSEMBLY_FILES && !failed; f++) {
    char *to = gx_assembly_path(assembly->directory, "", gx_assembly_name[f], "");
    if (!to || rename(assembly->path[f], to)) failed = fail(assembly, to);
    free(to);
  }
  int directory = failed ? -1 : open(assembly->directory, O_RDONLY | O_CLOEXEC);
  if (directory < 0) return failed ? failed : fail(assembly, assembly->directory);
  if (fsync(directory) && errno != EINVAL) failed = fail(assembly, assembly->directory);
  close(directory);
  return failed;
}

int gx_assembly_end(struct gx_assembly *assembly, const struct gx_provenance *provenance, const struct gx_store_run *run)
{
  if (!provenance) assembly->failed = true;
  if (!assembly->failed) write_part(assembly);
  if (assembly->study && gx_hdf5_write_end(assembly->study, assembly->failed ? NULL : provenance)) assembly->failed = true;
  if (!assembly->failed) write_run(assembly, run);
  for (int f = 0; f < GX_ASSEMBLY_FILES; f++) close_text(assembly, f);
  if (!assembly->failed) rename_all(assembly);
  int failed = assembly->failed ? -1 : 0;
  for (int f = 0; f < GX_ASSEMBLY_FILES; f++) {
    if (failed && assembly->path[f]) unlink(assembly->path[f]);
    free(assembly->path[f]);
  }
  gx_table_free(assembly->part);
  gx_table_free(assembly->timing);
  free(assembly);
  return failed;
}
