/* SPDX-License-Identifier: GPL-3.0-or-later */
/* YAML text as a tree, from the events of libyaml: they give the place of everything, and show an anchor before it costs. */
#include "yaml.h"

#include <string.h>
#include <yaml.h>

enum { DEEPEST = 16 };

struct reader {
  struct gx_arena *arena;
  struct gx_errors *errors;
  const char *text;
  int set;
  int depth;
  struct gx_yaml *open[DEEPEST + 1];        /* open[0]: the document */
  const struct gx_yaml **tail[DEEPEST + 1]; /* where the next entry goes */
  bool anchor_reported, broken;
};

static struct gx_place place_of(const struct reader *reader, const yaml_mark_t *mark)
{
  return (struct gx_place){.set = reader->set, .line = (int)mark->line + 1, .column = (int)mark->column + 1};
}

/* The decoder gives a byte offset instead of a mark. */
static struct gx_place place_of_byte(const struct reader *reader, size_t offset)
{
  struct gx_place place = {.set = reader->set, .line = 1, .column = 1};
  for (size_t i = 0; i < offset; i++) {
    unsigned char c = (unsigned char)reader->text[i];
    if (c == '\n' || (c == '\r' && reader->text[i + 1] != '\n')) {
      place.line++;
      place.column = 1;
    } else if ((c & 0xC0) != 0x80 && c != '\r')
      place.column++;
  }
  return place;
}

/* Marks count characters. */
static bool is_tab(const struct reader *reader, const yaml_mark_t *mark)
{
  const char *c = reader->text;
  for (size_t left = mark->index; *c && left > 0; c++) left -= (c[1] & 0xC0) != 0x80;
  return *c == '\t';
}

static void report_syntax(struct reader *reader, const yaml_parser_t *parser)
{
  if (parser->error == YAML_MEMORY_ERROR)
    reader->errors->out_of_memory = true;
  else if (parser->error == YAML_READER_ERROR) {
    size_t offset = parser->problem_offset;
    /* A wrong trailing byte is given: the character starts before it. */
    if (strstr(parser->problem, "trailing"))
      while (offset > 0 && ((unsigned char)reader->text[--offset] & 0xC0) == 0x80) continue;
    gx_errors_add(reader->errors, place_of_byte(reader, offset), "not UTF-8 text: %s", parser->problem);
  } else
    gx_errors_add(reader->errors, place_of(reader, &parser->problem_mark), "not valid YAML: %s%s%s%s", parser->problem,
                  parser->context ? " " : "", parser->context ? parser->context : "",
                  is_tab(reader, &parser->problem_mark) ? "; indent by blanks, not by tabs" : "");
}

static bool has_anchor(const yaml_event_t *event)
{
  switch (event->type) {
  case YAML_ALIAS_EVENT:
    return true;
  case YAML_SCALAR_EVENT:
    return event->data.scalar.anchor;
  case YAML_SEQUENCE_START_EVENT:
    return event->data.sequence_start.anchor;
  case YAML_MAPPING_START_EVENT:
    return event->data.mapping_start.anchor;
  default:
    return false;
  }
}

static const char *tag_of(const yaml_event_t *event)
{
  switch (event->type) {
  case YAML_SCALAR_EVENT:
    return (const char *)event->data.scalar.tag;
  case YAML_SEQUENCE_START_EVENT:
    return (const char *)event->data.sequence_start.tag;
  case YAML_MAPPING_START_EVENT:
    return (const char *)event->data.mapping_start.tag;
  default:
    return NULL;
  }
}

/* Adds the node that the event starts. false: stop reading. */
static bool add_node(struct reader *reader, const yaml_event_t *event, enum gx_yaml_kind kind)
{
  struct gx_yaml *node = gx_arena_take(reader->arena, sizeof *node);
  if (!node) {
    reader->errors->out_of_memory = true;
    return false;
  }
  *node = (struct gx_yaml){.kind = kind, .place = place_of(reader, &event->start_mark)};
  *reader->tail[reader->depth] = node;
  reader->tail[reader->depth] = &node->next;
  reader->open[reader->depth]->count++;
  if (has_anchor(event) && !reader->anchor_reported) {
    gx_errors_add(reader->errors, node->place, "anchors (&) and aliases (*) are not allowed; write the value out");
    reader->anchor_reported = true;
  }
  if (tag_of(event)) {
    gx_errors_add(reader->errors, node->place, "tag %s is not allowed; remove it", gx_errors_quote(tag_of(event)).text);
    node->kind = kind == GX_YAML_SCALAR ? GX_YAML_REFUSED : kind;
  }
  if (kind == GX_YAML_SCALAR) {
    const char *text = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    node->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (memchr(text, '\0', length)) {
      gx_errors_add(reader->errors, node->place, "text holds a NUL character; remove it");
      node->kind = GX_YAML_REFUSED;
    }
    node->text = gx_arena_text(reader->arena, text, length);
    reader->errors->out_of_memory |= !node->text;
    return node->text;
  }
  if (kind == GX_YAML_REFUSED) return true;
  if (reader->depth == DEEPEST) {
    gx_errors_add(reader->errors, node->place, "nested deeper than %d levels", DEEPEST);
    reader->broken = true;
    return false;
  }
  reader->depth++;
  reader->open[reader->depth] = node;
  reader->tail[reader->depth] = &node->first;
  return true;
}

static bool take_event(struct reader *reader, const yaml_event_t *event)
{
  switch (event->type) {
  case YAML_STREAM_END_EVENT:
    return false;
  case YAML_DOCUMENT_START_EVENT:
    if (!reader->open[0]->count) return true;
    gx_errors_add(reader->errors, place_of(reader, &event->start_mark),
                  "a second document starts here; a run file holds one: remove this and what follows");
    return false;
  case YAML_ALIAS_EVENT:
    return add_node(reader, event, GX_YAML_REFUSED);
  case YAML_SCALAR_EVENT:
    return add_node(reader, event, GX_YAML_SCALAR);
  case YAML_SEQUENCE_START_EVENT:
    return add_node(reader, event, GX_YAML_LIST);
  case YAML_MAPPING_START_EVENT:
    return add_node(reader, event, GX_YAML_MAPPING);
  case YAML_SEQUENCE_END_EVENT:
  case YAML_MAPPING_END_EVENT:
    reader->depth--;
    return true;
  default:
    return true;
  }
}

const struct gx_yaml *gx_yaml_read(struct gx_arena *arena, struct gx_errors *errors, const char *text, size_t length, int set)
{
  struct gx_yaml document = {.count = 0};
  struct reader reader = {.arena = arena, .errors = errors, .text = text, .set = set};
  reader.open[0] = &document;
  reader.tail[0] = &document.first;
  yaml_parser_t parser;
  if (!yaml_parser_initialize(&parser)) {
    errors->out_of_memory = true;
    return NULL;
  }
  yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
  bool more = true, valid = true;
  while (more && valid) {
    yaml_event_t event;
    valid = yaml_parser_parse(&parser, &event);
    if (valid) {
      more = take_event(&reader, &event);
      yaml_event_delete(&event);
    } else
      report_syntax(&reader, &parser);
  }
  yaml_parser_delete(&parser);
  return valid && !reader.broken && !errors->out_of_memory ? document.first : NULL;
}

bool gx_yaml_is_empty(const struct gx_yaml *node)
{
  return node->kind == GX_YAML_SCALAR && node->plain && !*node->text;
}
