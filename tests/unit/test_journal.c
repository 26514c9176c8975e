/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Journals give back what was put into them, and of a damaged file all that is whole, and nothing else. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"
#include "temporary.h"
#include "store/journal.h"

enum { RECORDS = 4, SAMPLES = 3, LINES = 2, BINS = 5 };

static const char *const identity = "version\t1\nrun\t#1:ab\n";

struct fixture {
  char directory[TEMPORARY_ROOM], path[128], other[128];
  struct gx_result results[RECORDS];
};

static double *numbers(size_t count, double first)
{
  double *array = malloc(count * sizeof *array);
  for (size_t i = 0; i < count; i++) array[i] = first + (double)i;
  return array;
}

/* The first keeps nothing, the next a history, then spectra, then all there is. */
static void fill(struct gx_result *result, size_t index)
{
  memset(result, 0, sizeof *result);
  result->dt = index ? 0.1 * (double)index : NAN;
  result->probe = -1;
  result->seconds = -0.0;
  result->stable_dt = INFINITY;
  result->outcome = (struct gx_outcome){.status = index == 1 ? GX_TANGLED : GX_OK, .particle = -1};
  if (index == 1) strcpy(result->outcome.reason, "tab\t, \"quote\", \xE2\x82\xAC, new\nline");
  if (index == 1 || index == 3) {
    result->history.samples = SAMPLES;
    result->history.dim = 2;
    result->history.sample = calloc(SAMPLES, sizeof *result->history.sample);
    for (int i = 0; i < SAMPLES; i++) result->history.sample[i] = (struct gx_sample){.time = i, .defect = NAN};
  }
  if (index == 3) {
    result->history.jumps = true;
    result->history.probe = calloc(SAMPLES, sizeof *result->history.probe);
    result->history.budget = calloc(SAMPLES, sizeof *result->history.budget);
    for (int i = 0; i < SAMPLES; i++) {
      result->history.probe[i].u[1] = 7 + i;
      result->history.budget[i].value[2] = 9 + i;
    }
  }
  if (index >= 2) {
    result->spectra = (struct gx_spectra){.samples = LINES, .bins = BINS, .spacing = 0.5, .nyquist = 4, .driven = 1};
    result->spectra.time = numbers(LINES, 1);
    result->spectra.rms = numbers(LINES * GX_QUANTITIES * BINS, 100);
  }
}

static void same_array(const void *a, const void *b, size_t bytes)
{
  assert_int_equal(!a, !b);
  if (a) assert_memory_equal(a, b, bytes);
}

/* All but the pointers, bit for bit. */
static void same_result(const struct gx_result *a, const struct gx_result *b)
{
  struct gx_result bare[2] = {*a, *b};
  for (int i = 0; i < 2; i++) {
    bare[i].history.sample = NULL;
    bare[i].history.probe = NULL;
    bare[i].history.budget = NULL;
    bare[i].spectra.time = bare[i].spectra.rms = NULL;
  }
  assert_memory_equal(&bare[0], &bare[1], sizeof bare[0]);
  const struct gx_history *h = &a->history, *k = &b->history;
  same_array(h->sample, k->sample, h->samples * sizeof *h->sample);
  same_array(h->probe, k->probe, h->samples * sizeof *h->probe);
  same_array(h->budget, k->budget, h->samples * sizeof *h->budget);
  same_array(a->spectra.time, b->spectra.time, a->spectra.samples * sizeof(double));
  same_array(a->spectra.rms, b->spectra.rms, a->spectra.samples * a->spectra.bins * GX_QUANTITIES * sizeof(double));
}

static int set_up(void **state)
{
  struct fixture *f = calloc(1, sizeof *f);
  if (!temporary_directory(f->directory, "journal")) return -1;
  snprintf(f->path, sizeof f->path, "%s/.journal-1.partial", f->directory);
  snprintf(f->other, sizeof f->other, "%s/other", f->directory);
  struct gx_journal *journal = gx_journal_create(f->directory, identity, stderr);
  for (size_t i = 0; i < RECORDS; i++) {
    fill(&f->results[i], i);
    if (!journal || gx_journal_append(journal, i, &f->results[i])) return -1;
  }
  *state = f;
  return gx_journal_close(journal);
}

static int tear_down(void **state)
{
  struct fixture *f = *state;
  for (size_t i = 0; i < RECORDS; i++) gx_case_free(&f->results[i]);
  unlink(f->path);
  unlink(f->other);
  int failed = rmdir(f->directory);
  free(f);
  return failed;
}

static char *contents(const char *path, size_t *length)
{
  FILE *in = fopen(path, "rb");
  assert_non_null(in);
  char *bytes = malloc(1 << 20);
  *length = fread(bytes, 1, 1 << 20, in);
  assert_true(*length < 1 << 20);
  fclose(in);
  return bytes;
}

static void put(const char *path, const char *bytes, size_t length)
{
  FILE *out = fopen(path, "wb");
  assert_int_equal(fwrite(bytes, 1, length, out), length);
  assert_int_equal(fclose(out), 0);
}

struct found {
  size_t count;
  size_t index[RECORDS + 1];
  uint64_t offset[RECORDS + 1];
};

static void note(void *context, size_t index, uint64_t offset)
{
  struct found *found = context;
  assert_true(found->count <= RECORDS);
  found->index[found->count] = index;
  found->offset[found->count++] = offset;
}

/* What a file has, each record read back and compared with what was put in; returns whether its head is whole. */
static bool read_back(const struct fixture *f, const char *path, struct found *found)
{
  int file = open(path, O_RDONLY);
  struct gx_pages *pages = gx_pages_create();
  *found = (struct found){0};
  assert_int_equal(gx_journal_scan(file, note, found), 0);
  for (size_t i = 0; i < found->count; i++) {
    struct gx_result result;
    assert_true(found->index[i] < RECORDS);
    assert_int_equal(gx_journal_scan_result(file, i % 2 ? pages : NULL, found->offset[i], &result), 0);
    same_result(&result, &f->results[found->index[i]]);
    gx_case_free(&result);
  }
  char *there = gx_journal_scan_identity(file);
  bool whole = there;
  if (there) assert_string_equal(there, identity);
  free(there);
  gx_pages_free(pages);
  close(file);
  return whole;
}

static void test_what_was_put_in_comes_back(void **state)
{
  const struct fixture *f = *state;
  struct found found;
  assert_true(read_back(f, f->path, &found));
  assert_int_equal(found.count, RECORDS);
  for (size_t i = 0; i < RECORDS; i++) assert_int_equal(found.index[i], i);
}

static void test_a_truncated_journal_keeps_whole_records(void **state)
{
  const struct fixture *f = *state;
  struct found whole, found;
  read_back(f, f->path, &whole);
  size_t length;
  char *bytes = contents(f->path, &length);
  int file = open(f->other, O_RDWR | O_CREAT, 0666);
  assert_int_equal(pwrite(file, bytes, length, 0), length);
  for (size_t keep = length; keep-- > 0;) {
    assert_int_equal(ftruncate(file, (off_t)keep), 0);
    size_t expected = 0;
    while (expected < RECORDS && (expected + 1 < RECORDS ? whole.offset[expected + 1] : length) <= keep) expected++;
    bool head = read_back(f, f->other, &found);
    CHECK(found.count == expected, "%zu bytes: %zu records, not %zu", keep, found.count, expected);
    if (keep >= whole.offset[0]) assert_true(head);
  }
  close(file);
  free(bytes);
}

/* Any one bit: the record that it is in is gone, the others are there. */
static void test_a_flipped_bit_costs_one_record(void **state)
{
  const struct fixture *f = *state;
  struct found whole, found;
  read_back(f, f->path, &whole);
  size_t length;
  char *bytes = contents(f->path, &length);
  int file = open(f->other, O_RDWR | O_CREAT | O_TRUNC, 0666);
  assert_int_equal(pwrite(file, bytes, length, 0), length);
  for (size_t at = 0; at < length; at++) {
    const char flipped = (char)(bytes[at] ^ 1 << at % 8);
    assert_int_equal(pwrite(file, &flipped, 1, (off_t)at), 1);
    bool head = read_back(f, f->other, &found);
    CHECK(head == (at >= whole.offset[0]), "byte %zu of the head", at);
    CHECK(found.count == (head ? RECORDS - 1 : RECORDS), "byte %zu: %zu records", at, found.count);
    assert_int_equal(pwrite(file, &bytes[at], 1, (off_t)at), 1);
  }
  close(file);
  free(bytes);
}

static void test_foreign_files_hold_nothing(void **state)
{
  const struct fixture *f = *state;
  struct found found;
  char noise[5000];
  unsigned seed = 1;
  for (size_t i = 0; i < sizeof noise; i++) noise[i] = (char)((seed = seed * 1103515245u + 12345u) >> 16);
  put(f->other, noise, sizeof noise);
  assert_false(read_back(f, f->other, &found));
  assert_int_equal(found.count, 0);
  /* a head that claims more than there is, and one that claims more than memory */
  struct gx_journal_head head = {.magic = GX_JOURNAL_MAGIC, .length = 1000};
  put(f->other, (const char *)&head, sizeof head);
  assert_false(read_back(f, f->other, &found));
  head.length = UINT64_MAX - 3;
  put(f->other, (const char *)&head, sizeof head);
  assert_false(read_back(f, f->other, &found));
  int directory = open(f->directory, O_RDONLY);
  assert_int_equal(gx_journal_scan(directory, note, &found), -1);
  assert_null(gx_journal_scan_identity(directory));
  close(directory);
}

/* A writer never touches what another has left. */
static void test_journals_have_numbers_of_their_own(void **state)
{
  const struct fixture *f = *state;
  struct gx_journal *one = gx_journal_create(f->directory, identity, stderr),
                    *two = gx_journal_create(f->directory, identity, stderr);
  char path[128];
  assert_non_null(one);
  assert_non_null(two);
  for (int n = 2; n <= 3; n++) {
    snprintf(path, sizeof path, "%s/.journal-%d.partial", f->directory, n);
    assert_int_equal(access(path, F_OK), 0);
  }
  char *message;
  size_t length;
  FILE *errors = open_memstream(&message, &length);
  assert_null(gx_journal_create("/nowhere", identity, errors));
  fclose(errors);
  assert_non_null(strstr(message, "/nowhere/.journal-1.partial: No such file"));
  free(message);
  assert_int_equal(gx_journal_close(one), 0);
  assert_int_equal(gx_journal_close(two), 0);
  assert_int_equal(access(path, F_OK), -1); /* nothing was in it */
}

/* Words of every kind, of counts around those that a word of bits is of. */
static void test_packed_words_come_back(void **state)
{
  enum { MOST = 200 };
  static const uint64_t kind[] = {0, 0, 0, 0x7ff8000000000000, 0x7ff8000000000000, 1, UINT64_MAX};
  uint64_t from[MOST], packed[GX_PACKING_MOST(MOST)], back[MOST + 1];
  uint32_t seed = 1;
  (void)state;
  for (size_t words = 1; words <= MOST; words++) {
    size_t changes = 0;
    for (size_t i = 0; i < words; i++) {
      seed = seed * 1103515245u + 12345u;
      from[i] = words == MOST ? seed : kind[(seed >> 16) % (sizeof kind / sizeof *kind)];
      changes += from[i] != (i ? from[i - 1] : 0);
    }
    const size_t length = gx_packing_pack(from, words, packed);
    assert_int_equal(length, GX_PACKING_BITS(words) + changes);
    back[words] = 77;
    assert_int_equal(gx_packing_unpack(packed, length + 3, back, words), length);
    assert_memory_equal(from, back, 8 * words);
    assert_int_equal(back[words], 77);
    if (changes) assert_int_equal(gx_packing_unpack(packed, length - 1, back, words), 0);
    assert_int_equal(gx_packing_unpack(packed, GX_PACKING_BITS(words) - 1, back, words), 0);
  }
}

/* Small readings in any order are those of the file itself, across pages, after it has grown, and up to its end. */
static void test_pages_give_what_the_file_has(void **state)
{
  enum { LENGTH = 1 << 20, PIECE = 20000 };
  const struct fixture *f = *state;
  unsigned char *bytes = malloc(LENGTH), piece[PIECE];
  uint32_t seed = 1;
  for (size_t i = 0; i < LENGTH; i++) bytes[i] = (unsigned char)((seed = seed * 1103515245u + 12345u) >> 16);
  put(f->other, (const char *)bytes, LENGTH / 2 + 5);
  int file = open(f->other, O_RDWR | O_APPEND);
  struct gx_pages *pages = gx_pages_create();
  for (size_t have = LENGTH / 2 + 5; have <= LENGTH; have += LENGTH / 2 - 5) {
    for (int tried = 0; tried < 3000; tried++) {
      const size_t at = (seed = seed * 1103515245u + 12345u) >> 11 & (LENGTH - 1);
      const size_t length = (seed = seed * 1103515245u + 12345u) >> 16 & (tried % 10 ? 1023 : 16383);
      const bool whole = at + length <= have;
      assert_int_equal(gx_pages_read(tried % 100 ? pages : NULL, file, at, piece, length), whole || !length ? 0 : -1);
      if (whole) assert_memory_equal(piece, bytes + at, length);
    }
    assert_int_equal(gx_pages_read(pages, file, have - 3, piece, 3), 0);
    assert_int_equal(gx_pages_read(pages, file, have - 3, piece, 4), -1);
    if (have < LENGTH) assert_int_equal(write(file, bytes + have, LENGTH - have), LENGTH - have);
  }
  gx_pages_forget(pages, file);
  put(f->other, "other", 5);
  assert_int_equal(gx_pages_read(pages, file, 0, piece, 5), 0);
  assert_memory_equal(piece, "other", 5);
  gx_pages_free(pages);
  close(file);
  free(bytes);
}

/* What is written to a file that has vanished would be lost without a word. */
static void test_a_vanished_journal_is_an_error(void **state)
{
  const struct fixture *f = *state;
  char *message, path[128];
  size_t length;
  FILE *errors = open_memstream(&message, &length);
  struct gx_journal *journal = gx_journal_create(f->directory, identity, errors);
  assert_int_equal(gx_journal_append(journal, 0, &f->results[3]), 0);
  snprintf(path, sizeof path, "%s/.journal-2.partial", f->directory);
  assert_int_equal(unlink(path), 0);
  assert_int_equal(gx_journal_close(journal), -1);
  fclose(errors);
  assert_non_null(strstr(message, "journal-2.partial: No such file"));
  free(message);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_what_was_put_in_comes_back, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_a_truncated_journal_keeps_whole_records, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_a_flipped_bit_costs_one_record, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_foreign_files_hold_nothing, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_journals_have_numbers_of_their_own, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_packed_words_come_back, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_pages_give_what_the_file_has, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_a_vanished_journal_is_an_error, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
