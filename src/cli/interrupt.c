/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waiting for signals. */
#include "interrupt.h"

#include <stddef.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { STOP = SIGUSR1 }; /* to the watcher alone: nobody wants it any more */

/* In one piece, by a call that is safe beside any other; what cannot be said is lost. */
static void say(const char *text)
{
  if (text && write(STDERR_FILENO, text, strlen(text)) < 0) return;
}

static void *watch(void *argument)
{
  struct gx_interrupt *interrupt = argument;
  const struct timespec patience = {.tv_nsec = 800000000};
  int signal;
  if (sigwait(&interrupt->watched, &signal) || signal == STOP) return NULL;
  atomic_store(&interrupt->signal, signal);
  atomic_store(&interrupt->cancel, true);
  say(interrupt->herald);
  if (sigtimedwait(&interrupt->watched, NULL, &patience) == STOP) return NULL;
  say(interrupt->farewell);
  _exit(128 + signal);
}

static void add(sigset_t *set, int signal)
{
  struct sigaction action;
  if (!sigaction(signal, NULL, &action) && action.sa_handler != SIG_IGN) sigaddset(set, signal);
}

void gx_interrupt_begin(struct gx_interrupt *interrupt, const char *herald, const char *farewell)
{
  *interrupt = (struct gx_interrupt){.herald = herald, .farewell = farewell};
  sigemptyset(&interrupt->watched);
  add(&interrupt->watched, SIGINT);
  add(&interrupt->watched, SIGTERM);
  add(&interrupt->watched, SIGHUP);
  sigaddset(&interrupt->watched, STOP);
  pthread_sigmask(SIG_BLOCK, &interrupt->watched, &interrupt->before);
  interrupt->watching = !pthread_create(&interrupt->watcher, NULL, watch, interrupt);
  if (!interrupt->watching) pthread_sigmask(SIG_SETMASK, &interrupt->before, NULL); /* signals kill, as ever */
}

void gx_interrupt_end(struct gx_interrupt *interrupt)
{
  if (!interrupt->watching) return;
  pthread_kill(interrupt->watcher, STOP);
  pthread_join(interrupt->watcher, NULL);
  interrupt->watching = false;
  pthread_sigmask(SIG_SETMASK, &interrupt->before, NULL);
}
