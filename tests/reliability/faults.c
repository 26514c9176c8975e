/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A disk that fails on purpose, to be preloaded: each call of a program that changes files is counted, and one of them goes wrong.
 *   FAULTS_LIST=FILE   the names of all calls, in order, are appended there
 *   FAULTS_AT=N        which call, from 1
 *   FAULTS_HOW=kill    the process is killed before it, torn: when it is half done, full: it and what needs room after it fails,
 *                      once: it alone fails
 * Calls on standard streams do not count. */
#define _GNU_SOURCE
#undef _FILE_OFFSET_BITS
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;
static long at;
static const char *how = "";
static int list = -1;

#define NEXT(name) (__extension__(__typeof__(&name)) dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void begin(void)
{
  const char *number = getenv("FAULTS_AT"), *kind = getenv("FAULTS_HOW"), *file = getenv("FAULTS_LIST");
  if (number) at = strtol(number, NULL, 10);
  if (kind) how = strdup(kind);
  if (file) list = NEXT(open)(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  unsetenv("LD_PRELOAD"); /* programs that it starts have a good disk */
}

static void die(void)
{
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

/* 0, or the errno that the call fails with. needs: whether it takes room. */
static int fault(const char *name, int needs)
{
  const long n = atomic_fetch_add(&calls, 1) + 1;
  if (list >= 0) {
    char line[32];
    const int length = snprintf(line, sizeof line, "%s\n", name);
    if (NEXT(write)(list, line, (size_t)length) != length) abort();
  }
  if (!at || n < at) return 0;
  if (n == at && !strcmp(how, "kill")) die();
  if (n == at && !strcmp(how, "once")) return EIO;
  return needs && !strcmp(how, "full") ? ENOSPC : 0;
}

static int is_torn(void)
{
  return at && atomic_load(&calls) == at && !strcmp(how, "torn");
}

/* After a call that cannot be done by halves. */
#define RETURN(value)                                                                                                            \
  do {                                                                                                                           \
    if (is_torn()) die();                                                                                                        \
    return value;                                                                                                                \
  } while (0)

#define FAIL(name, needs, value)                                                                                                 \
  do {                                                                                                                           \
    const int failed = fault(name, needs);                                                                                       \
    if (failed) {                                                                                                                \
      errno = failed;                                                                                                            \
      return value;                                                                                                              \
    }                                                                                                                            \
  } while (0)

#define OPEN(name)                                                                                                               \
  int name(const char *path, int flags, ...)                                                                                     \
  {                                                                                                                              \
    va_list rest;                                                                                                                \
    va_start(rest, flags);                                                                                                       \
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;                                                              \
    va_end(rest);                                                                                                                \
    if (!(flags & O_CREAT)) return NEXT(name)(path, flags);                                                                      \
    FAIL("open", 1, -1);                                                                                                         \
    const int file = NEXT(name)(path, flags, mode);                                                                              \
    RETURN(file);                                                                                                                \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                                                                                              \
  FILE *name(const char *path, const char *mode)                                                                                 \
  {                                                                                                                              \
    if (*mode == 'r') return NEXT(name)(path, mode);                                                                             \
    FAIL("fopen", 1, NULL);                                                                                                      \
    FILE *file = NEXT(name)(path, mode);                                                                                         \
    RETURN(file);                                                                                                                \
  }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int file, const void *bytes, size_t length)
{
  if (file <= STDERR_FILENO) return NEXT(write)(file, bytes, length);
  FAIL("write", 1, -1);
  const ssize_t written = NEXT(write)(file, bytes, is_torn() ? length / 2 : length);
  RETURN(written);
}

#define PWRITE(name, offset)                                                                                                     \
  ssize_t name(int file, const void *bytes, size_t length, offset where)                                                         \
  {                                                                                                                              \
    FAIL("pwrite", 1, -1);                                                                                                       \
    const ssize_t written = NEXT(name)(file, bytes, is_torn() ? length / 2 : length, where);                                     \
    RETURN(written);                                                                                                             \
  }
PWRITE(pwrite, off_t)
PWRITE(pwrite64, off64_t)

ssize_t writev(int file, const struct iovec *part, int parts)
{
  FAIL("writev", 1, -1);
  const ssize_t written = NEXT(writev)(file, part, is_torn() ? (parts + 1) / 2 : parts);
  RETURN(written);
}

/* What is in the buffer then goes to disk. */
int fflush(FILE *stream)
{
  if (!stream || fileno(stream) <= STDERR_FILENO) return NEXT(fflush)(stream);
  FAIL("fflush", 1, EOF);
  const int failed = NEXT(fflush)(stream);
  RETURN(failed);
}

int fclose(FILE *stream)
{
  if (fileno(stream) <= STDERR_FILENO) return NEXT(fclose)(stream);
  const int fails = fault("fclose", 0), failed = NEXT(fclose)(stream);
  if (fails) errno = fails;
  RETURN(fails ? EOF : failed);
}

#define TRUNCATE(name, offset)                                                                                                   \
  int name(int file, offset length)                                                                                              \
  {                                                                                                                              \
    FAIL("ftruncate", 0, -1);                                                                                                    \
    const int failed = NEXT(name)(file, length);                                                                                 \
    RETURN(failed);                                                                                                              \
  }
TRUNCATE(ftruncate, off_t)
TRUNCATE(ftruncate64, off64_t)

int fsync(int file)
{
  FAIL("fsync", 1, -1);
  const int failed = NEXT(fsync)(file);
  RETURN(failed);
}

int rename(const char *from, const char *to)
{
  FAIL("rename", 0, -1);
  const int failed = NEXT(rename)(from, to);
  RETURN(failed);
}

int unlink(const char *path)
{
  FAIL("unlink", 0, -1);
  const int failed = NEXT(unlink)(path);
  RETURN(failed);
}

int unlinkat(int directory, const char *path, int flags)
{
  FAIL("unlink", 0, -1);
  const int failed = NEXT(unlinkat)(directory, path, flags);
  RETURN(failed);
}

int mkdir(const char *path, mode_t mode)
{
  FAIL("mkdir", 1, -1);
  const int failed = NEXT(mkdir)(path, mode);
  RETURN(failed);
}
