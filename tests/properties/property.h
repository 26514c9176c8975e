/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties over random cases. A case is a list of choices, each a whole number of which the least is the simplest, so that a case which
 * breaks a property shrinks: every choice goes down as far as the property stays broken.
 *
 *   GX_SEED=7 GX_CASES=200 PROGRAM     200 cases of each property from one seed; GX_SEED=random: another one each time, printed
 *   GX_CASE='NAME: choice=value ...' PROGRAM     one case of one property, as a failure prints it; what is not named is the simplest
 *
 * Without them: a fixed list of seeds. */
#ifndef GRIDCROSS_TESTS_PROPERTIES_PROPERTY_H
#define GRIDCROSS_TESTS_PROPERTIES_PROPERTY_H

#include <stdbool.h>

#include "check.h"

/* least ... most; with text: a name each. A choice with the path of a parameter that has names takes those. */
struct property_choice {
  const char *name;
  int least, most;
  const char *const *text; /* [most + 1], NULL-ended; NULL: numbers, or the parameter's names */
};

enum { PROPERTY_CHOICES = 32 };

enum property_verdict {
  PROPERTY_HOLDS,
  PROPERTY_BROKEN,
  PROPERTY_SILENT /* the method promises nothing here, is refused, or ended before there was anything to measure */
};

struct property_finding {
  double measured, bound;
  char what[160]; /* said of a broken case; may be empty */
};

/* Broken unless measured <= bound; so is NaN. */
enum property_verdict property_judge(const struct property_finding *finding);
/* Of several measures a finding keeps the one that is farthest above its own bound, or nearest to it. bound: positive. */
void property_compare(struct property_finding *finding, double measured, double bound, const char *what);

struct property {
  const char *name;
  const struct property_choice *choice; /* ended by a NULL name */
  int cases;                            /* of each seed of the fixed list */
  int least_held;                       /* per cent of the list's cases that must hold, not be silent */
  enum property_verdict (*check)(const struct property *property, const int *value, struct property_finding *finding);
};

/* Fails the test after it said where the property is broken. */
void property_check(const struct property *property);

/* Names of a choice's values; NULL: it has none. */
const char *property_text(const struct property_choice *choice, int value);
/* Index of a choice; it must be there. */
int property_index(const struct property_choice *choice, const char *name);

/* What a search found; the tests of the search look at it. */
struct property_search {
  long cases, held, silent;
  double closest; /* largest measured / bound of those that held */
  bool broken;
  int drawn[PROPERTY_CHOICES], shrunk[PROPERTY_CHOICES]; /* the first broken case; and what it shrinks to */
  struct property_finding of_drawn, of_shrunk;
  int trials; /* cases tried to shrink it */
};

/* Case `number` of a seed. */
void property_draw(const struct property *property, uint64_t seed, long number, int *value);
/* Tries cases until one is broken, which is shrunk. */
struct property_search property_search(const struct property *property, uint64_t seed, long cases);
/* A case as GX_CASE takes it. text: [length] */
void property_print(const struct property *property, const int *value, char *text, size_t length);
/* The reverse; false: the text is not of this property, or names what it does not have. */
bool property_read(const struct property *property, const char *text, int *value);

#endif
