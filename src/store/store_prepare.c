/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directories that a study may be written to. */
#include <gridcross/store.h>

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gridcross/recorder.h>

#include "assembly.h"
#include "hdf5_rows.h"

/* Only what an interrupted run leaves: nothing, or partial files. */
static int check_empty(const char *directory, FILE *errors)
{
  DIR *stream = opendir(directory);
  if (!stream) return gx_assembly_say(errors, directory);
  int failed = 0;
  for (struct dirent *entry; !failed && (entry = readdir(stream));) {
    size_t n = strlen(entry->d_name);
    bool ours = !strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") ||
                (n > 8 && entry->d_name[0] == '.' && !strcmp(entry->d_name + n - 8, ".partial")) ||
                gx_recorder_owns(entry->d_name);
    if (ours) continue;
    fprintf(errors, "%s: is neither a study nor empty (it holds %s): name another directory with -o\n", directory, entry->d_name);
    failed = -1;
  }
  closedir(stream);
  return failed;
}

/* mkdir -p */
static int make_directory(const char *directory, FILE *errors)
{
  char *path = strdup(directory);
  if (!path) return gx_assembly_say(errors, NULL);
  int failed = 0;
  for (char *c = path + 1; !failed && path[0]; c++) {
    bool last = !*c;
    if (!last && *c != '/') continue;
    *c = '\0';
    if (mkdir(path, 0777) && errno != EEXIST) failed = gx_assembly_say(errors, path);
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
  if (stat(directory, &status)) return gx_assembly_say(errors, directory);
  if (!S_ISDIR(status.st_mode)) {
    fprintf(errors, "%s: is not a directory: name another place with -o\n", directory);
    return -1;
  }
  char *study = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  if (!study) return gx_assembly_say(errors, NULL);
  int failed = 0;
  if (stat(study, &status)) {
    failed = check_empty(directory, errors);
  } else {
    struct gx_hdf5_rows *old = gx_hdf5_rows_begin(study, 0, NULL, errors);
    if (!old) fprintf(errors, "%s: will not be overwritten: remove it, or name another directory with -o\n", study);
    failed = old ? 0 : -1;
    gx_hdf5_rows_end(old);
  }
  free(study);
  return failed;
}
