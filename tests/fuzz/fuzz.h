/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz targets: any bytes go in, nothing may crash, leak, hang or take memory that only a number in the input asks for. Each is a file
 * that libFuzzer drives, or main.c, which gives it the files of its corpus. */
#ifndef GRIDCROSS_TESTS_FUZZ_H
#define GRIDCROSS_TESTS_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <gridcross/study.h>

enum { FUZZ_PATH = 256 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A directory of this process, removed when it ends. */
const char *fuzz_directory(void);
/* DIR/name; one at a time. */
const char *fuzz_path(const char *name);
/* Where messages go. */
FILE *fuzz_quiet(void);
void fuzz_write(const char *name, const void *data, size_t size);
/* A directory in it is made, or removed with the files in it. */
void fuzz_make(const char *name);
void fuzz_clear(const char *name);

/* A file of fuzz_directory, [size], owned by the caller. */
uint8_t *fuzz_read(const char *name, size_t *size);
/* A file whose good bytes are known. The input's first byte says how it is damaged: 0: it is what follows; odd: the first two bytes
 * that follow say what share of it is left; then each five bytes are an offset and what to add there. */
void fuzz_damage(const char *name, const uint8_t *good, size_t length, const uint8_t *data, size_t size);

/* Runs a case if it is small, and checks that its row of the table is numbers. */
void fuzz_run(const struct gx_case *one);

/* Runs a small study of four cases with everything that a study can keep into a directory in fuzz_directory(); shards 0: undivided.
 * Owned by the caller. */
struct gx_study *fuzz_study(const char *name, size_t shard, size_t shards);

#endif
