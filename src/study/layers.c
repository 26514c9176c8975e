/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layers: the keys of a run file, of its cases and of --set, sorted into settings. */
#include "layers.h"

#include <stdlib.h>
#include <string.h>

#include "../core/nearest.h"

/* Keys beside sections and parameters, in the file itself only. */
static const char *const file_keys[] = {"title", "zip", "cases", NULL};

/* The next section after `section` (NULL: the first), from the paths of the table. NULL after the last. */
static const char *next_section(const char *section, char buffer[32])
{
  bool met = !section;
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const char *path = gx_parameters[id].path;
    size_t length = strcspn(path, ".");
    bool same = section && strlen(section) == length && !strncmp(section, path, length);
    if (met && !same) {
      memcpy(buffer, path, length);
      buffer[length] = '\0';
      return buffer;
    }
    met = met || same;
  }
  return NULL;
}

static bool is_section(const char *key)
{
  char buffer[32];
  const char *section = NULL;
  while ((section = next_section(section, buffer)))
    if (!strcmp(section, key)) return true;
  return false;
}

static void name(struct gx_settings *settings, int id)
{
  if (settings->named[id]) return;
  settings->named[id] = true;
  settings->order[settings->ordered++] = (enum gx_parameter_id)id;
}

/* What an unknown key most likely means decides which later complaints it would only echo. */
static void expect_echoes(struct gx_settings *settings, const char *meant)
{
  int id = gx_parameter_find(meant);
  if (id == GX_PROBLEM_NAME || !strcmp(meant, "problem")) settings->name_excused = true;
  if (id < 0 || gx_parameters[id].choice || id == GX_PROBLEM_DIMENSION || gx_setting_rival((enum gx_parameter_id)id, 0) >= 0)
    settings->uncertain = true;
}

static void append(char list[256], const char *word)
{
  size_t used = strlen(list);
  snprintf(list + used, 256 - used, "%s%s", used ? ", " : "", word);
}

/* The path that ends in `word`, for the right key in the wrong place; NULL: none. */
static const char *path_ending(const char *word)
{
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (!strcmp(strchr(gx_parameters[id].path, '.') + 1, word)) return gx_parameters[id].path;
  return NULL;
}

static void report_unknown_path(struct gx_settings *settings, const char *path, struct gx_place place)
{
  struct gx_nearest nearest = {.word = path};
  for (int id = 0; id < GX_PARAMETERS; id++) gx_nearest_try(&nearest, gx_parameters[id].path);
  const char *meant = path_ending(path);
  if (!meant && *nearest.best) meant = nearest.best;
  struct gx_quoted quoted = gx_errors_quote(path);
  if (meant)
    gx_errors_add(settings->errors, place, "unknown parameter %s; did you mean '%s'?", quoted.text, meant);
  else
    gx_errors_add(settings->errors, place, "unknown parameter %s; 'gridcross list parameters' names them all", quoted.text);
  if (meant) expect_echoes(settings, meant);
}

/* A key that stands in a section. */
static void report_unknown_in(struct gx_settings *settings, const char *section, const struct gx_yaml *key)
{
  size_t length = strlen(section);
  bool full = !strncmp(key->text, section, length) && key->text[length] == '.';
  struct gx_nearest nearest = {.word = key->text + (full ? length + 1 : 0)};
  char list[256] = "", path[128];
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const char *known = gx_parameters[id].path;
    if (strncmp(known, section, length) || known[length] != '.') continue;
    append(list, known + length + 1);
    gx_nearest_try(&nearest, known + length + 1);
  }
  struct gx_quoted quoted = gx_errors_quote(key->text);
  const char *elsewhere = path_ending(key->text);
  snprintf(path, sizeof path, "%s.%s", section, nearest.best);
  if (!elsewhere && !*nearest.best) {
    gx_errors_add(settings->errors, key->place, "unknown key %s in %s; known keys: %s", quoted.text, section, list);
    return;
  }
  gx_errors_add(settings->errors, key->place, "unknown key %s in %s; did you mean '%s'?", quoted.text, section,
                elsewhere ? elsewhere : nearest.best);
  expect_echoes(settings, elsewhere ? elsewhere : path);
}

/* A key of the file, or of a case. */
static void report_unknown(struct gx_settings *settings, const struct gx_yaml *key, bool in_file)
{
  struct gx_nearest nearest = {.word = key->text};
  char list[256] = "", buffer[32];
  for (int id = 0; id < GX_PARAMETERS; id++) gx_nearest_try(&nearest, gx_parameters[id].path);
  for (const char *section = NULL; (section = next_section(section, buffer));) {
    append(list, section);
    gx_nearest_try(&nearest, section);
  }
  for (int i = 0; in_file && file_keys[i]; i++) {
    append(list, file_keys[i]);
    gx_nearest_try(&nearest, file_keys[i]);
  }
  const char *meant = path_ending(key->text), *where = in_file ? "" : " in a case";
  if (!meant && *nearest.best) meant = nearest.best;
  struct gx_quoted quoted = gx_errors_quote(key->text);
  if (meant)
    gx_errors_add(settings->errors, key->place, "unknown key %s%s; did you mean '%s'?", quoted.text, where, meant);
  else
    gx_errors_add(settings->errors, key->place, "unknown key %s%s; known keys: %s", quoted.text, where, list);
  if (meant) expect_echoes(settings, meant);
}

/* Reports keys that are no words, and keys met before in the mapping. */
static bool is_fresh_key(struct gx_settings *settings, const struct gx_yaml *mapping, const struct gx_yaml *key)
{
  if (key->kind == GX_YAML_REFUSED) return false;
  if (key->kind != GX_YAML_SCALAR) {
    gx_errors_add(settings->errors, key->place, "a key must be a word, not a %s", key->kind == GX_YAML_LIST ? "list" : "mapping");
    return false;
  }
  const struct gx_yaml *same = mapping->first;
  while (same != key && !(same->kind == GX_YAML_SCALAR && !strcmp(same->text, key->text))) same = same->next->next;
  if (same == key) return true;
  gx_errors_add(settings->errors, key->place, "duplicate key %s; it was given at line %d, column %d",
                gx_errors_quote(key->text).text, same->place.line, same->place.column);
  return false;
}

static void read_setting(struct gx_settings *settings, struct gx_layer *layer, int id, const struct gx_yaml *key)
{
  struct gx_setting *same = gx_setting_find(layer, (enum gx_parameter_id)id);
  if (same) {
    gx_errors_add(settings->errors, key->place, "%s is given twice; it was given at line %d, column %d", gx_parameters[id].path,
                  same->place.line, same->place.column);
    return;
  }
  struct gx_setting *setting = gx_setting_read(settings, (enum gx_parameter_id)id, key->place, key->next);
  if (!setting) return;
  name(settings, id);
  for (int i = 0, rival; (rival = gx_setting_rival((enum gx_parameter_id)id, i)) >= 0; i++) {
    if (!(same = gx_setting_find(layer, (enum gx_parameter_id)rival))) continue;
    gx_errors_add(settings->errors, key->place, "%s and %s exclude each other; remove one (the other is at line %d, column %d)",
                  gx_parameters[id].path, gx_parameters[rival].path, same->place.line, same->place.column);
    return;
  }
  *layer->tail = setting;
  layer->tail = &setting->next;
}

static void read_section(struct gx_settings *settings, struct gx_layer *layer, const struct gx_yaml *section)
{
  const struct gx_yaml *mapping = section->next;
  if (!strcmp(section->text, "problem")) layer->place = section->place;
  if (mapping->kind == GX_YAML_REFUSED || gx_yaml_is_empty(mapping)) return;
  if (mapping->kind != GX_YAML_MAPPING) {
    gx_errors_add(settings->errors, mapping->place, "section '%s' holds keys and values, such as {key: value}", section->text);
    settings->uncertain = settings->name_excused = true;
    return;
  }
  for (const struct gx_yaml *key = mapping->first; key && !gx_errors_full(settings->errors); key = key->next->next) {
    if (!is_fresh_key(settings, mapping, key)) continue;
    char path[64];
    int length = snprintf(path, sizeof path, "%s.%s", section->text, key->text);
    int id = length < (int)sizeof path ? gx_parameter_find(path) : -1;
    if (id >= 0)
      read_setting(settings, layer, id, key);
    else
      report_unknown_in(settings, section->text, key);
  }
}

/* The section or parameter that a key of the file or of a case names. false: neither. */
static bool read_key(struct gx_settings *settings, struct gx_layer *layer, const struct gx_yaml *key)
{
  int id = gx_parameter_find(key->text);
  if (id >= 0)
    read_setting(settings, layer, id, key);
  else if (is_section(key->text))
    read_section(settings, layer, key);
  return id >= 0 || is_section(key->text);
}

static void read_title(struct gx_settings *settings, const struct gx_yaml *node)
{
  if (node->kind == GX_YAML_REFUSED) return;
  if (node->kind != GX_YAML_SCALAR) {
    gx_errors_add(settings->errors, node->place, "title: expected text, not a %s",
                  node->kind == GX_YAML_LIST ? "list" : "mapping");
    return;
  }
  free(settings->study->title);
  settings->study->title = strdup(node->text);
  settings->errors->out_of_memory |= !settings->study->title;
}

static void read_case(struct gx_settings *settings, const struct gx_yaml *entry)
{
  if (entry->kind == GX_YAML_REFUSED) return;
  if (entry->kind != GX_YAML_MAPPING) {
    gx_errors_add(settings->errors, entry->place, "cases: an entry holds keys and values, such as {method.space: moving-mesh}");
    return;
  }
  struct gx_layer *layer = gx_arena_take(&settings->arena, sizeof *layer);
  if (!layer) {
    settings->errors->out_of_memory = true;
    return;
  }
  *layer = (struct gx_layer){.place = entry->place, .tail = &layer->first};
  *settings->cases_tail = layer;
  settings->cases_tail = &layer->next;
  for (const struct gx_yaml *key = entry->first; key && !gx_errors_full(settings->errors); key = key->next->next)
    if (is_fresh_key(settings, entry, key) && !read_key(settings, layer, key)) report_unknown(settings, key, false);
  for (const struct gx_setting *setting = layer->first; setting; setting = setting->next) {
    settings->varied[setting->id] = true;
    for (int i = 0, rival; (rival = gx_setting_rival(setting->id, i)) >= 0; i++) {
      name(settings, rival);
      settings->varied[rival] = true;
    }
  }
}

static void read_cases(struct gx_settings *settings, const struct gx_yaml *list)
{
  if (list->kind == GX_YAML_REFUSED) return;
  if (list->kind != GX_YAML_LIST || !list->count) {
    gx_errors_add(settings->errors, list->place, "cases: expected a list of mappings, such as [{method.mass: consistent}]");
    settings->uncertain = true;
    return;
  }
  for (const struct gx_yaml *entry = list->first; entry && !gx_errors_full(settings->errors); entry = entry->next)
    read_case(settings, entry);
}

/* One group of parameters that advance together. */
static void read_zip_group(struct gx_settings *settings, const struct gx_yaml *group)
{
  struct gx_errors *errors = settings->errors;
  if (group->kind == GX_YAML_REFUSED) return;
  if (group->kind != GX_YAML_LIST || group->count < 2) {
    gx_errors_add(errors, group->place, "zip: expected two or more paths, such as [mesh.cells, time.dt]");
    return;
  }
  const struct gx_setting *first = NULL;
  int zip = 0;
  for (const struct gx_yaml *node = group->first; node && !gx_errors_full(errors); node = node->next) {
    int id = node->kind == GX_YAML_SCALAR ? gx_parameter_find(node->text) : -1;
    if (node->kind == GX_YAML_REFUSED) continue;
    if (node->kind != GX_YAML_SCALAR)
      gx_errors_add(errors, node->place, "zip: expected a path such as mesh.cells");
    else if (id < 0)
      report_unknown_path(settings, node->text, node->place);
    else if (settings->zip[id])
      gx_errors_add(errors, node->place, "zip: %s is named twice", node->text);
    if (id < 0 || settings->zip[id]) continue;
    const struct gx_setting *setting = gx_setting_find(&settings->base, (enum gx_parameter_id)id);
    if (!settings->named[id])
      gx_errors_add(errors, node->place, "zip: %s is not given in this file; give it a list", node->text);
    else if (setting && !setting->bad && !setting->listed)
      gx_errors_add(errors, node->place, "zip: %s is not a list", node->text);
    else if (setting && !setting->bad && first && first->count != setting->count)
      gx_errors_add(errors, node->place, "zip: %s has %zu values, but %s has %zu; give equally many", node->text, setting->count,
                    gx_parameters[first->id].path, first->count);
    else {
      if (!zip) zip = id + 1;
      settings->zip[id] = zip;
      if (setting && !setting->bad && !first) first = setting;
    }
  }
}

static void read_zip(struct gx_settings *settings, const struct gx_yaml *node)
{
  bool groups = node->kind == GX_YAML_LIST && node->first && node->first->kind == GX_YAML_LIST;
  if (!groups) {
    read_zip_group(settings, node);
    return;
  }
  for (const struct gx_yaml *group = node->first; group && !gx_errors_full(settings->errors); group = group->next)
    read_zip_group(settings, group);
}

void gx_layers_read(struct gx_settings *settings, const struct gx_yaml *root)
{
  struct gx_errors *errors = settings->errors;
  if (root->kind == GX_YAML_REFUSED) return;
  if (root->kind != GX_YAML_MAPPING) {
    gx_errors_add(errors, root->place, "a run file holds keys and values, such as 'problem: {name: bar-linear}'");
    settings->uncertain = settings->name_excused = true;
    return;
  }
  const struct gx_yaml *zip = NULL, *cases = NULL;
  for (const struct gx_yaml *key = root->first; key && !gx_errors_full(errors); key = key->next->next) {
    if (!is_fresh_key(settings, root, key) || read_key(settings, &settings->base, key)) continue;
    if (!strcmp(key->text, "title"))
      read_title(settings, key->next);
    else if (!strcmp(key->text, "zip"))
      zip = key->next;
    else if (!strcmp(key->text, "cases"))
      cases = key->next;
    else
      report_unknown(settings, key, true);
  }
  /* They speak of the base, wherever they stand. */
  if (cases) read_cases(settings, cases);
  if (zip) read_zip(settings, zip);
}

static void drop(struct gx_layer *layer, int id)
{
  struct gx_setting **link = &layer->first;
  while (*link) {
    if ((int)(*link)->id == id)
      *link = (*link)->next;
    else
      link = &(*link)->next;
  }
  layer->tail = link;
}

void gx_layers_set(struct gx_settings *settings, int set, const char *text)
{
  struct gx_errors *errors = settings->errors;
  struct gx_place place = {.set = set};
  const char *equals = strchr(text, '=');
  if (!equals || equals == text) {
    gx_errors_add(errors, place, "expected path=value, such as mesh.cells=64");
    return;
  }
  char *path = gx_arena_text(&settings->arena, text, (size_t)(equals - text));
  if (!path) {
    errors->out_of_memory = true;
    return;
  }
  int id = gx_parameter_find(path);
  if (id < 0) {
    report_unknown_path(settings, path, place);
    return;
  }
  size_t count = errors->count;
  const struct gx_yaml *value = gx_yaml_read(&settings->arena, errors, equals + 1, strlen(equals + 1), set);
  struct gx_yaml nothing = {.kind = GX_YAML_SCALAR, .plain = true, .text = "", .place = place};
  if (errors->count > count || errors->out_of_memory) return;
  struct gx_setting *setting = gx_setting_read(settings, (enum gx_parameter_id)id, place, value ? value : &nothing);
  if (!setting) return;
  drop(&settings->base, id);
  for (int i = 0, rival; (rival = gx_setting_rival((enum gx_parameter_id)id, i)) >= 0; i++) drop(&settings->base, rival);
  *settings->base.tail = setting;
  settings->base.tail = &setting->next;
  name(settings, id);
}
