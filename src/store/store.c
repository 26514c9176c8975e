/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study directory. Files are written beside their final names, flushed to disk and renamed, study.h5 first, so that a kill
 * at any instant leaves the old study or the new one. */
#include <gridcross/store.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { STUDY, TABLE, TIMING, RUN, FILES };

static const char *const names[FILES] = {
    [STUDY] = "study.h5", [TABLE] = "table.csv", [TIMING] = "timing.csv", [RUN] = "run.json"};

/* DIRECTORY/<prefix><name><suffix>, owned by the caller */
static char *path_in(const char *directory, const char *prefix, const char *name, const char *suffix)
{
  size_t room = strlen(directory) + strlen(prefix) + strlen(name) + strlen(suffix) + 2;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s/%s%s%s", directory, prefix, name, suffix);
  return path;
}

static char *partial_path(const char *directory, int file)
{
  return path_in(directory, ".", names[file], ".partial");
}

static int say(FILE *errors, const char *path)
{
  fprintf(errors, "%s: %s\n", path ? path : "study", path ? strerror(errno) : "out of memory");
  return -1;
}

/* Only what an interrupted run leaves: nothing, or partial files. */
static int check_empty(const char *directory, FILE *errors)
{
  DIR *stream = opendir(directory);
  if (!stream) return say(errors, directory);
  int failed = 0;
  for (struct dirent *entry; !failed && (entry = readdir(stream));) {
    size_t n = strlen(entry->d_name);
    bool ours = !strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") ||
                (n > 8 && entry->d_name[0] == '.' && !strcmp(entry->d_name + n - 8, ".partial"));
    if (ours) continue;
    fprintf(errors, "%s: is neither a study nor empty (it holds %s): name another directory with -o\n", directory, entry->d_name);
    failed = -1;
  }
  closedir(stream);
  return failed;
}

static int check_writable(const char *directory, FILE *errors)
{
  char *path = partial_path(directory, RUN);
  int file = path ? open(path, O_WRONLY | O_CREAT, 0666) : -1;
  int failed = file < 0 ? say(errors, path) : 0;
  if (file >= 0) {
    close(file);
    unlink(path);
  }
  free(path);
  return failed;
}

/* mkdir -p */
static int make_directory(const char *directory, FILE *errors)
{
  char *path = strdup(directory);
  if (!path) return say(errors, NULL);
  int failed = 0;
  for (char *c = path + 1; !failed && path[0]; c++) {
    bool last = !*c;
    if (!last && *c != '/') continue;
    *c = '\0';
    if (mkdir(path, 0777) && errno != EEXIST) failed = say(errors, path);
    if (last) break;
    *c = '/';
  }
  free(path);
  return failed;
}

int gx_store_prepare(const char *directory, FILE *errors)
{
  struct stat status;
  if (make_directory(directory, errors)) return -1;
  if (stat(directory, &status)) return say(errors, directory);
  if (!S_ISDIR(status.st_mode)) {
    fprintf(errors, "%s: is not a directory: name another place with -o\n", directory);
    return -1;
  }
  char *study = path_in(directory, "", names[STUDY], "");
  if (!study) return say(errors, NULL);
  int failed = 0;
  if (stat(study, &status)) {
    failed = check_empty(directory, errors);
  } else {
    struct gx_table *old = gx_hdf5_read(study, errors);
    if (!old) fprintf(errors, "%s: will not be overwritten: remove it, or name another directory with -o\n", study);
    failed = old ? 0 : -1;
    gx_table_free(old);
  }
  free(study);
  return failed ? failed : check_writable(directory, errors);
}

static struct gx_table *timing_table(const struct gx_study *study, const struct gx_result *results)
{
  struct gx_table *full = gx_study_table(study, results, true);
  struct gx_table *timing = full ? gx_table_create(4, study->count) : NULL;
  int failed = !timing || gx_table_column(timing, 3, "repeats", "", GX_INTEGER);
  const size_t from[] = {0, full ? full->columns - 2 : 0, full ? full->columns - 1 : 0};
  const char *const name[] = {"case", "seconds", "ns_per_particle_step"};
  const struct gx_value repeats = {.type = GX_INTEGER, .integer = (long)study->repeats};
  for (size_t r = 0; r < study->count && !failed; r++) failed = gx_table_set(timing, r, 3, repeats);
  for (size_t c = 0; c < 3 && !failed; c++)
    failed = gx_table_copy(timing, c, full, from[c]) ||
             gx_table_column(timing, c, name[c], full->column[from[c]].unit, full->column[from[c]].type);
  gx_table_free(full);
  if (!failed) return timing;
  gx_table_free(timing);
  return NULL;
}

static struct gx_table *run_table(const struct gx_store_run *run)
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
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static int write_text(const char *path, int which, const struct gx_table *table, FILE *errors)
{
  FILE *out = fopen(path, "wb");
  if (!out) return say(errors, path);
  if (which == RUN) {
    gx_json_write_object(table, 0, out);
    putc('\n', out);
  } else {
    gx_csv_write(table, out);
  }
  int failed = fflush(out) || ferror(out) ? say(errors, path) : 0;
  if (fclose(out) && !failed) failed = say(errors, path);
  return failed;
}

static int flush_to_disk(const char *path, FILE *errors)
{
  int file = open(path, O_RDONLY);
  if (file < 0) return say(errors, path);
  /* EINVAL: a file system that cannot; nothing more to be done there. */
  int failed = fsync(file) && errno != EINVAL ? say(errors, path) : 0;
  close(file);
  return failed;
}

static int rename_all(const char *directory, FILE *errors)
{
  int failed = 0;
  for (int f = 0; f < FILES && !failed; f++) {
    char *from = partial_path(directory, f), *to = path_in(directory, "", names[f], "");
    if (!from || !to)
      failed = say(errors, NULL);
    else if (rename(from, to))
      failed = say(errors, to);
    free(from);
    free(to);
  }
  return failed ? failed : flush_to_disk(directory, errors);
}

static void remove_partials(const char *directory)
{
  for (int f = 0; f < FILES; f++) {
    char *path = partial_path(directory, f);
    if (path) unlink(path);
    free(path);
  }
}

int gx_store_write(const char *directory, const struct gx_study *study, const struct gx_result *results,
                   const struct gx_store_run *run, FILE *errors)
{
  struct gx_table *main_table = gx_study_table(study, results, false);
  struct gx_table *table[FILES] = {main_table, main_table, timing_table(study, results), run_table(run)};
  int failed = 0;
  for (int f = 0; f < FILES && !failed; f++) {
    char *path = partial_path(directory, f);
    if (!path || !table[f])
      failed = say(errors, NULL);
    else if (f == STUDY)
      failed = gx_hdf5_write(path, study, results, table[f], errors);
    else
      failed = write_text(path, f, table[f], errors);
    if (!failed) failed = flush_to_disk(path, errors);
    free(path);
  }
  if (!failed) failed = rename_all(directory, errors);
  if (failed) remove_partials(directory);
  gx_table_free(main_table);
  gx_table_free(table[TIMING]);
  gx_table_free(table[RUN]);
  return failed;
}

/* Whether a table has columns that only those who read it add. */
static bool has_ours(const struct gx_table *table)
{
  static const char *const ours[] = {"study", "result.seconds", "result.ns_per_particle_step"};
  for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
    if (gx_table_find(table, ours[i]) >= 0) return true;
  return false;
}

/* The same table with empty timing columns at its end. Frees the old one. */
static struct gx_table *widen(struct gx_table *narrow)
{
  struct gx_table *wide = gx_table_create(narrow->columns + 2, narrow->rows);
  int failed = !wide;
  for (size_t c = 0; c < narrow->columns && !failed; c++) failed = gx_table_copy(wide, c, narrow, c);
  if (!failed)
    failed = gx_table_column(wide, wide->columns - 2, "result.seconds", "s", GX_REAL) ||
             gx_table_column(wide, wide->columns - 1, "result.ns_per_particle_step", "ns", GX_REAL);
  gx_table_free(narrow);
  if (!failed) return wide;
  gx_table_free(wide);
  return NULL;
}

/* Timings are a comment on the table: a missing or foreign timing.csv leaves them null. Its rows stand in the order of the
 * table, so that the search starts where the last one ended. */
static void read_timing(const char *path, struct gx_table *table)
{
  FILE *in = fopen(path, "rb");
  long id_column = gx_table_find(table, "case");
  char line[256], id[GX_ID_LENGTH];
  size_t row = 0;
  struct gx_value seconds = {.type = GX_REAL}, cost = {.type = GX_REAL};
  while (in && id_column >= 0 && fgets(line, sizeof line, in)) {
    if (sscanf(line, "%16[^,],%lf,%lf", id, &seconds.real, &cost.real) != 3) continue;
    if (!isfinite(seconds.real) || !isfinite(cost.real)) continue;
    for (size_t tried = 0; tried < table->rows; tried++, row = (row + 1) % table->rows) {
      struct gx_value value = gx_table_get(table, row, (size_t)id_column);
      if (value.type != GX_TEXT || strcmp(value.text, id)) continue;
      gx_table_set(table, row, table->columns - 2, seconds);
      gx_table_set(table, row, table->columns - 1, cost);
      break;
    }
  }
  if (in) fclose(in);
}

struct gx_table *gx_store_read(const char *directory, FILE *errors)
{
  char *study = path_in(directory, "", names[STUDY], ""), *timing = path_in(directory, "", names[TIMING], "");
  struct gx_table *table = study && timing ? gx_hdf5_read(study, errors) : NULL;
  if (table && has_ours(table)) {
    fprintf(errors, "%s: its table is damaged\n", study);
    gx_table_free(table);
    table = NULL;
  }
  if (table && !(table = widen(table))) say(errors, NULL);
  if (table) read_timing(timing, table);
  free(study);
  free(timing);
  return table;
}

long gx_store_read_repeats(const char *directory)
{
  char *path = path_in(directory, "", names[TIMING], ""), line[256];
  FILE *in = path ? fopen(path, "rb") : NULL;
  long least = -1, repeats;
  for (int row = 0; in && fgets(line, sizeof line, in); row++) {
    if (!row) continue;
    if (sscanf(line, "%*[^,],%*[^,],%*[^,],%ld", &repeats) != 1) repeats = 0;
    if (least < 0 || repeats < least) least = repeats;
  }
  if (in) fclose(in);
  free(path);
  return least > 0 ? least : 0;
}

char *gx_store_read_title(const char *directory, FILE *errors)
{
  char *study = path_in(directory, "", names[STUDY], ""), *title = study ? gx_hdf5_read_title(study, errors) : NULL;
  if (!study) say(errors, NULL);
  free(study);
  return title;
}

struct gx_table *gx_store_read_history(const char *directory, const char *id, const char *name, FILE *errors)
{
  char *study = path_in(directory, "", names[STUDY], "");
  struct gx_table *history = study ? gx_hdf5_read_history(study, id, name, errors) : NULL;
  if (!study) say(errors, NULL);
  free(study);
  return history;
}

static double real_at(const struct gx_table *table, size_t row, size_t column)
{
  struct gx_value value = gx_table_get(table, row, column);
  return value.type == GX_REAL ? value.real : NAN;
}

static struct gx_value value_named(const struct gx_table *table, size_t row, const char *name)
{
  long column = gx_table_find(table, name);
  return column < 0 ? (struct gx_value){.type = GX_NULL} : gx_table_get(table, row, (size_t)column);
}

/* Samples and bins of the rows of stored spectra, which must be whole samples of the same wavenumbers, in order. */
static int measure_spectra(const struct gx_table *stored, struct gx_spectra *spectra)
{
  static const char *const names_of[] = {"time", "wavenumber", "displacement", "velocity", "stress"};
  enum { COLUMNS = sizeof names_of / sizeof *names_of };
  if (stored->columns != COLUMNS || !stored->rows) return -1;
  for (size_t c = 0; c < COLUMNS; c++)
    if (strcmp(stored->column[c].name, names_of[c])) return -1;
  size_t bins = 1;
  while (bins < stored->rows && real_at(stored, bins, 0) == real_at(stored, 0, 0)) bins++;
  double spacing = bins > 1 ? real_at(stored, 1, 1) : 1;
  for (size_t r = 0; r < stored->rows; r++) {
    if (real_at(stored, r, 0) != real_at(stored, r - r % bins, 0)) return -1;
    if (real_at(stored, r, 1) != (double)(r % bins) * spacing) return -1;
    for (size_t c = 2; c < COLUMNS; c++)
      if (real_at(stored, r, c) < 0) return -1; /* null: not a number */
  }
  *spectra = (struct gx_spectra){.samples = stored->rows / bins, .bins = bins, .spacing = spacing};
  return stored->rows % bins ? -1 : 0;
}

/* Owned by the caller; NULL when memory runs out. */
static struct gx_spectra *to_spectra(const struct gx_table *stored, const struct gx_spectra *shape)
{
  struct gx_spectra *spectra = calloc(1, sizeof *spectra);
  if (!spectra) return NULL;
  *spectra = *shape;
  spectra->time = malloc(spectra->samples * sizeof(double));
  spectra->rms = malloc(stored->rows * GX_QUANTITIES * sizeof(double));
  if (!spectra->time || !spectra->rms) {
    gx_store_free_spectra(spectra);
    return NULL;
  }
  for (size_t r = 0; r < stored->rows; r++) {
    size_t sample = r / spectra->bins, bin = r % spectra->bins;
    spectra->time[sample] = real_at(stored, r, 0);
    for (size_t q = 0; q < GX_QUANTITIES; q++)
      spectra->rms[(sample * GX_QUANTITIES + q) * spectra->bins + bin] = real_at(stored, r, 2 + q);
  }
  return spectra;
}

struct gx_spectra *gx_store_read_spectra(const char *directory, const struct gx_table *table, size_t row, FILE *errors)
{
  struct gx_value id = value_named(table, row, "case"), mode = value_named(table, row, gx_parameters[GX_PROBLEM_MODE].path);
  struct gx_value cells = value_named(table, row, gx_parameters[GX_MESH_CELLS].path);
  char *path = path_in(directory, "", names[STUDY], "");
  struct gx_table *stored = path && id.type == GX_TEXT ? gx_hdf5_read_spectra(path, id.text, errors) : NULL;
  struct gx_spectra *spectra = NULL, shape;
  if (!path)
    say(errors, NULL);
  else if (id.type != GX_TEXT || (stored && (cells.type != GX_INTEGER || measure_spectra(stored, &shape))))
    fprintf(errors, "%s: the spectra of case %s are damaged\n", path, id.type == GX_TEXT ? id.text : "?");
  else if (stored && !(spectra = to_spectra(stored, &shape)))
    say(errors, NULL);
  if (spectra) {
    spectra->nyquist = 0.5 * (double)cells.integer;
    spectra->driven = mode.type == GX_INTEGER ? (double)mode.integer : 1;
  }
  gx_table_free(stored);
  free(path);
  return spectra;
}

void gx_store_free_spectra(struct gx_spectra *spectra)
{
  if (!spectra) return;
  free(spectra->time);
  free(spectra->rms);
  free(spectra);
}
