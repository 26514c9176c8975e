/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing, shrinking and printing of random cases. */
#include "property.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <gridcross/parameter.h>

static const uint64_t seeds[] = {20100803, 20210118, 20220405}; /* of every run without GX_SEED */

enum { MOST_TRIALS = 1000, TEXT = 1024 };

const char *property_text(const struct property_choice *choice, int value)
{
  if (choice->text) return choice->text[value];
  int id = strchr(choice->name, '.') ? gx_parameter_find(choice->name) : -1;
  return id >= 0 && gx_parameters[id].choice ? gx_parameters[id].choice(value) : NULL;
}

/* The largest value of a choice. */
static int most_of(const struct property_choice *choice)
{
  int names = choice->least;
  if (choice->text || !property_text(choice, names)) return choice->most;
  while (property_text(choice, names + 1)) names++;
  return names;
}

int property_index(const struct property_choice *choice, const char *name)
{
  int i = 0;
  while (choice[i].name && strcmp(choice[i].name, name)) i++;
  CHECK(choice[i].name, "no choice '%s'", name);
  return i;
}

enum property_verdict property_judge(const struct property_finding *finding)
{
  return finding->measured <= finding->bound ? PROPERTY_HOLDS : PROPERTY_BROKEN;
}

void property_compare(struct property_finding *finding, double measured, double bound, const char *what)
{
  const bool first = !(finding->bound > 0);
  if (isnan(finding->measured) || (!first && measured / bound <= finding->measured / finding->bound)) return;
  finding->measured = measured;
  finding->bound = bound;
  snprintf(finding->what, sizeof finding->what, "%s", what);
}

/* Neighbours of a seed, of a number and of a name give unrelated sequences (splitmix64). */
static uint64_t mix(uint64_t z)
{
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void property_draw(const struct property *property, uint64_t seed, long number, int *value)
{
  uint64_t random = mix(seed);
  for (const char *s = property->name; *s; s++) random = mix(random ^ (unsigned char)*s);
  random = mix(random ^ (uint64_t)number);
  for (int i = 0; property->choice[i].name; i++) {
    const struct property_choice *choice = &property->choice[i];
    value[i] = choice->least + (int)check_random(&random, 0, most_of(choice) - choice->least + 1);
  }
}

static enum property_verdict check(const struct property *property, const int *value, struct property_finding *finding)
{
  *finding = (struct property_finding){0};
  return property->check(property, value, finding);
}

/* One choice to the simplest, or half of the way, a quarter, ... one less. Returns whether that left the property broken. */
static bool lower(const struct property *property, int i, struct property_search *search)
{
  const int least = property->choice[i].least, was = search->shrunk[i];
  for (int less = was - least; less > 0 && search->trials < MOST_TRIALS; less /= 2) {
    struct property_finding finding;
    search->trials++;
    search->shrunk[i] = was - less;
    if (check(property, search->shrunk, &finding) == PROPERTY_BROKEN) {
      search->of_shrunk = finding;
      return true;
    }
  }
  search->shrunk[i] = was;
  return false;
}

static void shrink(const struct property *property, struct property_search *search)
{
  memcpy(search->shrunk, search->drawn, sizeof search->shrunk);
  search->of_shrunk = search->of_drawn;
  for (bool lowered = true; lowered;) {
    lowered = false;
    for (int i = 0; property->choice[i].name; i++)
      while (lower(property, i, search)) lowered = true;
  }
}

struct property_search property_search(const struct property *property, uint64_t seed, long cases)
{
  struct property_search search = {0};
  while (search.cases < cases && !search.broken) {
    property_draw(property, seed, search.cases++, search.drawn);
    enum property_verdict verdict = check(property, search.drawn, &search.of_drawn);
    search.held += verdict == PROPERTY_HOLDS;
    search.silent += verdict == PROPERTY_SILENT;
    search.broken = verdict == PROPERTY_BROKEN;
    if (verdict == PROPERTY_HOLDS && search.of_drawn.bound > 0)
      search.closest = fmax(search.closest, search.of_drawn.measured / search.of_drawn.bound);
  }
  if (search.broken) shrink(property, &search);
  return search;
}

void property_print(const struct property *property, const int *value, char *text, size_t length)
{
  int used = snprintf(text, length, "%s:", property->name);
  for (int i = 0; property->choice[i].name && used >= 0 && (size_t)used < length; i++) {
    const char *name = property_text(&property->choice[i], value[i]);
    used += name ? snprintf(text + used, length - (size_t)used, " %s=%s", property->choice[i].name, name)
                 : snprintf(text + used, length - (size_t)used, " %s=%d", property->choice[i].name, value[i]);
  }
}

/* "value" of a choice; false: it is none. */
static bool read_value(const struct property_choice *choice, const char *word, int *value)
{
  const int most = most_of(choice);
  char *end;
  if (!property_text(choice, choice->least)) {
    long number = strtol(word, &end, 10);
    *value = (int)number;
    return end > word && !*end && number >= choice->least && number <= most;
  }
  for (*value = choice->least; *value <= most; ++*value)
    if (!strcmp(property_text(choice, *value), word)) return true;
  return false;
}

bool property_read(const struct property *property, const char *text, int *value)
{
  const size_t length = strlen(property->name);
  char copy[TEXT], *rest = NULL;
  if (strncmp(text, property->name, length) || text[length] != ':') return false;
  for (int i = 0; property->choice[i].name; i++) value[i] = property->choice[i].least;
  snprintf(copy, sizeof copy, "%s", text + length + 1);
  for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
    char *equals = strchr(word, '=');
    int i = 0;
    if (!equals) return false;
    *equals = '\0';
    while (property->choice[i].name && strcmp(property->choice[i].name, word)) i++;
    if (!property->choice[i].name || !read_value(&property->choice[i], equals + 1, &value[i])) return false;
  }
  return true;
}

static void say(const struct property *property, const char *which, const int *value, const struct property_finding *finding)
{
  char text[TEXT];
  property_print(property, value, text, sizeof text);
  print_error("  %s GX_CASE='%s'\n    measured %.17g, bound %.17g%s%s\n", which, text, finding->measured, finding->bound,
              *finding->what ? ": " : "", finding->what);
}

/* Returns how many cases held. */
static long check_seed(const struct property *property, uint64_t seed, long cases)
{
  struct property_search search = property_search(property, seed, cases);
  print_message("%s: GX_SEED=%llu GX_CASES=%ld: %ld held, the closest at %.2g of its bound; nothing promised of %ld\n",
                property->name, (unsigned long long)seed, cases, search.held, search.closest, search.silent);
  if (search.broken) {
    print_error("%s: broken by case %ld\n", property->name, search.cases);
    say(property, "drawn ", search.drawn, &search.of_drawn);
    say(property, "shrunk", search.shrunk, &search.of_shrunk);
    fail();
  }
  return search.held;
}

static void check_list(const struct property *property, long cases)
{
  for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
    const long held = check_seed(property, seeds[i], cases);
    CHECK(cases < property->cases || 100 * held >= property->least_held * cases, "%s: only %ld of %ld cases held", property->name,
          held, cases);
  }
}

static void check_one(const struct property *property, const char *text)
{
  int value[PROPERTY_CHOICES] = {0};
  struct property_finding finding;
  if (strncmp(text, property->name, strlen(property->name)) || text[strlen(property->name)] != ':') return;
  CHECK(property_read(property, text, value), "'%s' names what %s does not have", text, property->name);
  static const char *const names[] = {"holds", "broken", "promises nothing"};
  enum property_verdict verdict = check(property, value, &finding);
  say(property, names[verdict], value, &finding);
  if (verdict == PROPERTY_BROKEN) fail();
}

void property_check(const struct property *property)
{
  const char *one = getenv("GX_CASE"), *seed = getenv("GX_SEED"), *cases = getenv("GX_CASES");
  const long count = cases ? atol(cases) : property->cases;
  if (one)
    check_one(property, one);
  else if (seed && !strcmp(seed, "random"))
    check_seed(property, mix((uint64_t)time(NULL) ^ (uint64_t)getpid() << 32) >> 32, count);
  else if (seed)
    check_seed(property, strtoull(seed, NULL, 10), count);
  else
    check_list(property, count);
}
