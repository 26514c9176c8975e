/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ctrl-C and SIGTERM: a thread waits for them, so that no handler needs a global variable. */
#ifndef GRIDCROSS_CLI_INTERRUPT_H
#define GRIDCROSS_CLI_INTERRUPT_H

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>

struct gx_interrupt {
  atomic_bool cancel;   /* what is under way is to end */
  atomic_int signal;    /* that has come; 0: none */
  const char *herald;   /* borrowed, or NULL: said as soon as the signal comes */
  const char *farewell; /* borrowed, or NULL: said when the process has to end at once */
  sigset_t watched, before;
  pthread_t watcher;
  bool watching;
};

/* From now on SIGINT, SIGTERM and SIGHUP, unless they are ignored, set `cancel`; a second one, or eight tenths of a second without
 * gx_interrupt_end, ends the process with 128 + signal, as a shell would report it. Before other threads are begun. */
void gx_interrupt_begin(struct gx_interrupt *interrupt, const char *herald, const char *farewell);
/* Signals are what they were before. */
void gx_interrupt_end(struct gx_interrupt *interrupt);

#endif
