/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run files: from a path to a study, or to every error in it. */
#include <gridcross/study.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "expansion.h"
#include "layers.h"
#include "points.h"

enum { LARGEST = 4 << 20, CHUNK = 1 << 16 };

/* The bytes of a file, NUL-ended, owned by the caller; NULL: reported. */
static char *read_bytes(FILE *file, struct gx_errors *errors, size_t *length)
{
  struct gx_place whole = {.line = 0};
  char *text = NULL;
  size_t room = 0;
  *length = 0;
  while (!ferror(file) && !feof(file) && *length <= LARGEST) {
    if (room - *length < CHUNK + 1) {
      room = 2 * room + CHUNK + 1;
      char *more = realloc(text, room);
      if (!more) {
        errors->out_of_memory = true;
        free(text);
        return NULL;
      }
      text = more;
    }
    *length += fread(text + *length, 1, CHUNK, file);
  }
  if (ferror(file))
    gx_errors_add(errors, whole, "cannot be read: %s", strerror(errno));
  else if (*length > LARGEST)
    gx_errors_add(errors, whole, "larger than %d MiB: not a run file", LARGEST >> 20);
  else {
    text[*length] = '\0';
    return text;
  }
  free(text);
  return NULL;
}

static char *read_source(const char *path, struct gx_errors *errors, size_t *length)
{
  if (!strcmp(path, "-")) return read_bytes(stdin, errors, length);
  FILE *file = fopen(path, "rb");
  if (!file) {
    gx_errors_add(errors, (struct gx_place){.line = 0}, "cannot be opened: %s", strerror(errno));
    return NULL;
  }
  char *source = read_bytes(file, errors, length);
  fclose(file);
  return source;
}

static void read_cases(struct gx_settings *settings, size_t length, size_t sets, const char *const *set)
{
  struct gx_errors *errors = settings->errors;
  const struct gx_yaml *root = gx_yaml_read(&settings->arena, errors, settings->study->source, length, 0);
  if (!root && !errors->count)
    gx_errors_add(errors, settings->base.place, "the file is empty; 'gridcross init' writes one to start from");
  if (!root) return;
  gx_layers_read(settings, root);
  for (size_t i = 0; i < sets && !gx_errors_full(errors); i++) gx_layers_set(settings, (int)i + 1, set[i]);
  if (!gx_errors_full(errors)) gx_expansion_run(settings);
  if (!settings->study->title) settings->study->title = strdup("");
  errors->out_of_memory |= !settings->study->title;
}

/* source: owned, NULL when reading it has failed. */
static struct gx_study *read_text(const char *name, char *source, size_t length, size_t sets, const char *const *set,
                                  const struct gx_array_reader *hdf5, struct gx_errors *errors, FILE *out)
{
  struct gx_study *study = calloc(1, sizeof *study);
  bool bad = false;
  if (study) {
    struct gx_settings settings = {.errors = errors, .study = study, .base.place = {.line = 1, .column = 1}};
    settings.base.tail = &settings.base.first;
    settings.cases_tail = &settings.cases;
    study->source = source;
    if (source) read_cases(&settings, length, sets, set);
    if (gx_points_read(&settings, name, hdf5, out)) bad = true;
    gx_arena_free(&settings.arena);
  } else {
    errors->out_of_memory = true;
    free(source);
  }
  bad = bad || errors->count || errors->out_of_memory;
  gx_errors_print(errors, name, set, out);
  gx_errors_free(errors);
  if (!bad) return study;
  gx_runfile_free(study);
  return NULL;
}

struct gx_study *gx_runfile_read(const char *path, size_t sets, const char *const *set, const struct gx_array_reader *hdf5,
                                 FILE *out)
{
  struct gx_errors errors = {.count = 0};
  size_t length = 0;
  char *source = read_source(path, &errors, &length);
  return read_text(strcmp(path, "-") ? path : "<stdin>", source, length, sets, set, hdf5, &errors, out);
}

struct gx_study *gx_runfile_parse(const char *name, const char *text, FILE *out)
{
  struct gx_errors errors = {.count = 0};
  char *source = strdup(text);
  errors.out_of_memory = !source;
  return read_text(name, source, strlen(text), 0, NULL, NULL, &errors, out);
}

void gx_runfile_free(struct gx_study *study)
{
  if (!study) return;
  for (size_t i = 0; i < study->text_count; i++) free(study->texts[i]);
  free(study->texts);
  for (size_t i = 0; i < study->point_lists; i++) gx_points_free(study->points[i]);
  free(study->points);
  free(study->cases);
  free(study->source);
  free(study->title);
  free(study);
}
