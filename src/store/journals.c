/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All journals of a directory, each opened when it is wanted: there can be more of them than a process may have open. */
#include "journals.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "assembly.h"
#include "provenance.h"

struct gx_journals {
  const char *directory;
  FILE *errors;
  size_t count, room;
  char **path; /* [count], owned */
  int *file;   /* [count] descriptors, -1: not open; owned */
  struct gx_pages *pages;
};

static bool is_journal(const char *name)
{
  const char *number = strncmp(name, ".journal-", 9) ? NULL : name + 9;
  return number && strspn(number, "0123456789") && !strcmp(number + strspn(number, "0123456789"), ".partial");
}

static int add(struct gx_journals *journals, const char *name)
{
  if (journals->count == journals->room) {
    const size_t room = 2 * journals->room + 16;
    char **path = realloc(journals->path, room * sizeof *path);
    if (path) journals->path = path;
    int *file = path ? realloc(journals->file, room * sizeof *file) : NULL;
    if (file) journals->file = file;
    if (!file) return gx_assembly_say(journals->errors, NULL);
    journals->room = room;
  }
  char *path = gx_assembly_path(journals->directory, "", name, "");
  if (!path) return gx_assembly_say(journals->errors, NULL);
  journals->path[journals->count] = path;
  journals->file[journals->count++] = -1;
  return 0;
}

/* Of any identity. */
static struct gx_journals *list(const char *directory, FILE *errors)
{
  struct gx_journals *journals = calloc(1, sizeof *journals);
  DIR *stream = journals ? opendir(directory) : NULL;
  if (!stream) {
    gx_assembly_say(errors, journals ? directory : NULL);
    free(journals);
    return NULL;
  }
  *journals =
      (struct gx_journals){.directory = directory, .errors = errors, .pages = gx_pages_create()}; /* without pages: slower */
  int failed = 0;
  for (struct dirent *entry; !failed && (entry = readdir(stream));)
    if (is_journal(entry->d_name)) failed = add(journals, entry->d_name);
  closedir(stream);
  if (!failed) return journals;
  gx_journals_close(journals);
  return NULL;
}

static void close_one(struct gx_journals *journals, size_t i)
{
  if (journals->file[i] < 0) return;
  gx_pages_forget(journals->pages, journals->file[i]);
  close(journals->file[i]);
  journals->file[i] = -1;
}

/* A descriptor, or -1 with errno. */
static int open_one(struct gx_journals *journals, size_t i)
{
  if (journals->file[i] >= 0) return journals->file[i];
  for (int tries = 0; tries < 2; tries++) {
    journals->file[i] = open(journals->path[i], O_RDONLY | O_CLOEXEC);
    if (journals->file[i] >= 0 || (errno != EMFILE && errno != ENFILE)) break;
    for (size_t k = 0; k < journals->count; k++) close_one(journals, k);
  }
  return journals->file[i];
}

static void forget(struct gx_journals *journals, size_t i)
{
  close_one(journals, i);
  free(journals->path[i]);
  journals->count--;
  journals->path[i] = journals->path[journals->count];
  journals->file[i] = journals->file[journals->count];
}

struct gx_journals *gx_journals_open(const char *directory, const char *identity, FILE *errors)
{
  struct gx_journals *journals = list(directory, errors);
  for (size_t i = 0; journals && i < journals->count;) {
    int file = open_one(journals, i);
    char *there = file < 0 ? NULL : gx_journal_scan_identity(file);
    const bool ours = there && !strcmp(there, identity);
    free(there);
    if (ours)
      i++;
    else
      forget(journals, i);
  }
  return journals;
}

static void count(void *context, size_t index, uint64_t offset)
{
  size_t *records = context;
  (void)index, (void)offset;
  ++*records;
}

/* Says why results that are there stand in the way. */
static int refuse(const struct gx_journals *journals, size_t records, const char *there, const char *identity)
{
  FILE *errors = journals->errors;
  fprintf(errors, "%s: holds %zu finished case%s of ", journals->directory, records, records == 1 ? "" : "s");
  if (!strcmp(there, identity)) {
    fputs("this study, whose run was interrupted: add --resume to go on with it, or name another directory with -o\n", errors);
    return -1;
  }
  fputs("another study, whose run was interrupted; they differ in ", errors);
  gx_provenance_equal(there, identity, errors);
  fprintf(errors, ": name another directory with -o, or remove %s/.journal-*.partial to give those cases up\n",
          journals->directory);
  return -1;
}

static int check_one(struct gx_journals *journals, size_t i, const char *identity, bool resume)
{
  enum { TORN = 1 << 14 }; /* bytes: what a kill can leave of a head is shorter */
  size_t records = 0;
  int file = open_one(journals, i), failed = 0;
  if (file < 0 || gx_journal_scan(file, count, &records)) return gx_assembly_say(journals->errors, journals->path[i]);
  char *there = gx_journal_scan_identity(file);
  if (!records && (there || lseek(file, 0, SEEK_END) < TORN)) {
    unlink(journals->path[i]);
  } else if (!there) {
    fprintf(journals->errors, "%s: is damaged or no journal: move it away, or name another directory with -o\n",
            journals->path[i]);
    failed = -1;
  } else if (!resume || strcmp(there, identity) != 0) {
    failed = refuse(journals, records, there, identity);
  }
  free(there);
  return failed;
}

int gx_journals_check(const char *directory, const char *identity, bool resume, FILE *errors)
{
  struct gx_journals *journals = list(directory, errors);
  int failed = journals ? 0 : -1;
  for (size_t i = 0; journals && i < journals->count && !failed; i++) failed = check_one(journals, i, identity, resume);
  gx_journals_close(journals);
  return failed;
}

struct scan {
  size_t journal;
  void (*found)(void *context, size_t journal, size_t index, uint64_t offset);
  void *context;
};

static void pass_on(void *context, size_t index, uint64_t offset)
{
  const struct scan *scan = context;
  scan->found(scan->context, scan->journal, index, offset);
}

int gx_journals_scan(struct gx_journals *journals, void (*found)(void *context, size_t journal, size_t index, uint64_t offset),
                     void *context)
{
  struct scan scan = {.found = found, .context = context};
  for (; scan.journal < journals->count; scan.journal++) {
    int file = open_one(journals, scan.journal);
    if (file < 0 || gx_journal_scan(file, pass_on, &scan)) return gx_assembly_say(journals->errors, journals->path[scan.journal]);
  }
  return 0;
}

int gx_journals_result(struct gx_journals *journals, size_t journal, uint64_t offset, struct gx_result *result)
{
  int file = open_one(journals, journal);
  if (file < 0) return gx_assembly_say(journals->errors, journals->path[journal]);
  if (!gx_journal_scan_result(file, journals->pages, offset, result)) return 0;
  fprintf(journals->errors, "%s: cannot be read\n", journals->path[journal]);
  return -1;
}

void gx_journals_remove(struct gx_journals *journals)
{
  for (size_t i = 0; i < journals->count; i++) unlink(journals->path[i]);
}

void gx_journals_close(struct gx_journals *journals)
{
  if (!journals) return;
  while (journals->count) forget(journals, journals->count - 1);
  gx_pages_free(journals->pages);
  free(journals->path);
  free(journals->file);
  free(journals);
}
