/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranks by MPI. Nobody waits for another within MPI, where waiting costs a processor: all look now and then. */
#include "ranks.h"

#include <stdio.h>
#include <stdlib.h>

#include "options.h"

struct launch {
  long size, rank;      /* size 1: alone */
  const char *variable; /* of the environment, that says so; NULL: none */
};

/* What Open MPI, MPICH and others by PMI, and Slurm with PMIx say to the processes that they start. */
static struct launch find_launch(void)
{
  static const struct {
    const char *size, *rank;
  } known[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}, {"SLURM_STEP_NUM_TASKS", "PMIX_RANK"}};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    const char *size = getenv(known[k].size), *rank = getenv(known[k].rank);
    if (!size || !rank) continue;
    const struct launch launch = {.size = strtol(size, NULL, 10), .rank = strtol(rank, NULL, 10), .variable = known[k].size};
    if (launch.size > 1) return launch;
  }
  return (struct launch){.size = 1};
}

#ifdef GX_HAVE_MPI

#include <limits.h>
#include <mpi.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { WANT = 1, GIVEN, MOST = 250 }; /* tags; tickets at once: less than 4 kB, which MPI sends without being asked for */

struct ticket {
  uint64_t index;
  double share;
};

struct gx_ranks {
  int rank, count, beside; /* beside: on this machine */
  FILE *said;              /* what is not heard; owned; NULL: all is heard */
  int standard_error;      /* descriptor kept meanwhile */
  const atomic_bool *cancel;
  struct gx_source queue; /* of the first rank */
  pthread_t server;
  bool serving;
  atomic_size_t given;
  struct ticket ticket[MOST]; /* of the others, got from the first */
  size_t got, used;
};

static const double first_nap = 2e-5, longest_nap = 1e-3; /* s */

static void nap(double *seconds)
{
  const struct timespec time = {.tv_nsec = (long)(1e9 * *seconds)};
  nanosleep(&time, NULL);
  *seconds = *seconds * 1.5 < longest_nap ? *seconds * 1.5 : longest_nap;
}

/* Returns false when it was cancelled; the request then is left to the end of the process. */
static bool wait_for(const struct gx_ranks *ranks, MPI_Request *request, MPI_Status *status)
{
  int is_done = 0;
  for (double seconds = first_nap; MPI_Test(request, &is_done, status), !is_done; nap(&seconds))
    if (ranks->cancel && atomic_load(ranks->cancel)) return false;
  return true;
}

const char *gx_ranks_version(void)
{
#define GX_TEXT_OF(x) #x
#define GX_TEXT(x)    GX_TEXT_OF(x)
  return "MPI " GX_TEXT(MPI_VERSION) "." GX_TEXT(MPI_SUBVERSION);
}

/* Its threads take no signals, which have a thread of their own. */
static int initialise(void)
{
  sigset_t all, before;
  int level = MPI_THREAD_SINGLE;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &level);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return level;
}

/* Standard error goes to a file that may be shown later. */
static void hush(struct gx_ranks *ranks)
{
  ranks->said = tmpfile();
  ranks->standard_error = ranks->said ? dup(STDERR_FILENO) : -1;
  if (ranks->said) dup2(fileno(ranks->said), STDERR_FILENO);
}

void gx_ranks_speak(struct gx_ranks *ranks)
{
  if (!ranks || !ranks->said) return;
  fflush(stderr);
  dup2(ranks->standard_error, STDERR_FILENO);
  close(ranks->standard_error);
  fclose(ranks->said);
  ranks->said = NULL;
}

static void show_said(struct gx_ranks *ranks)
{
  char piece[4096], machine[256] = "";
  if (!ranks->said) return;
  fflush(stderr);
  rewind(ranks->said);
  size_t length = fread(piece, 1, sizeof piece, ranks->said);
  gx_ranks_speak(ranks);
  gethostname(machine, sizeof machine - 1);
  fprintf(stderr, "gridcross run: rank %d, on %s, could not join the others:\n%.*s", ranks->rank, machine, (int)length, piece);
}

int gx_ranks_begin(struct gx_ranks **ranks, bool apart)
{
  const struct launch launch = find_launch();
  (void)apart;
  *ranks = NULL;
  if (launch.size < 2) return 0;
  struct gx_ranks *new = calloc(1, sizeof *new);
  const int level = new ? initialise() : 0;
  if (!new) return GX_EXIT_FAILED;
  MPI_Comm_size(MPI_COMM_WORLD, &new->count);
  MPI_Comm_rank(MPI_COMM_WORLD, &new->rank);
  if (new->count != launch.size || level < MPI_THREAD_SERIALIZED) {
    if (!launch.rank)
      fprintf(stderr, "gridcross run: %s: %s\n", gx_ranks_version(),
              new->count != launch.size ? "is not the one that started these processes: use the mpirun that belongs to it"
                                        : "has no threads (MPI_THREAD_SERIALIZED): build with another");
    MPI_Finalize();
    free(new);
    return GX_EXIT_USAGE;
  }
  MPI_Comm beside;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &beside);
  MPI_Comm_size(beside, &new->beside);
  MPI_Comm_free(&beside);
  if (new->rank) hush(new);
  *ranks = new;
  return 0;
}

bool gx_ranks_first(const struct gx_ranks *ranks)
{
  return !ranks || !ranks->rank;
}

size_t gx_ranks_threads(const struct gx_ranks *ranks, size_t processors)
{
  if (!ranks) return processors;
  const long all = sysconf(_SC_NPROCESSORS_ONLN), each = all / ranks->beside;
  return each < 1 ? 1 : (size_t)each < processors ? (size_t)each : processors;
}

int gx_ranks_agree(struct gx_ranks *ranks, int code)
{
  enum { CODES = 256 };
  if (!ranks) return code;
  int mine = code ? ranks->rank * CODES + code : INT_MAX, worst = INT_MAX;
  MPI_Request request;
  MPI_Iallreduce(&mine, &worst, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
  if (!wait_for(ranks, &request, MPI_STATUS_IGNORE)) return GX_EXIT_FAILED;
  if (worst == INT_MAX) return 0;
  if (worst == mine) show_said(ranks);
  return worst % CODES;
}

int gx_ranks_alike(struct gx_ranks *ranks, uint64_t number)
{
  if (!ranks) return 0;
  uint64_t first = number;
  MPI_Request request;
  MPI_Ibcast(&first, sizeof first, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  if (!wait_for(ranks, &request, MPI_STATUS_IGNORE)) return GX_EXIT_FAILED;
  if (first != number)
    fputs("it has another study, or is another build, than the first: all ranks need the same program, run file and options\n",
          stderr);
  return gx_ranks_agree(ranks, first != number ? GX_EXIT_USAGE : 0);
}

/* Cases that are a small part of what is left, so that at the end nobody waits for one that has many. */
static int fill(struct gx_ranks *ranks, struct ticket *ticket)
{
  const double most = 1 / (8.0 * ranks->count);
  int count = 0;
  size_t index;
  double share, sum = 0;
  while (count < MOST && sum < most && ranks->queue.take(ranks->queue.context, &index, &share)) {
    ticket[count++] = (struct ticket){.index = index, .share = share};
    sum += share;
  }
  atomic_fetch_add(&ranks->given, (size_t)count);
  return count;
}

/* Of the first rank: answers until each of the others has been told that nothing is left. Its threads make no other call of MPI
 * meanwhile. */
static void *serve(void *argument)
{
  struct gx_ranks *ranks = argument;
  struct ticket ticket[MOST];
  double seconds = first_nap;
  for (int left = ranks->count - 1; left && !atomic_load(ranks->cancel);) {
    MPI_Status status;
    int any;
    MPI_Iprobe(MPI_ANY_SOURCE, WANT, MPI_COMM_WORLD, &any, &status);
    if (!any) {
      nap(&seconds);
      continue;
    }
    seconds = first_nap;
    MPI_Recv(NULL, 0, MPI_BYTE, status.MPI_SOURCE, WANT, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const int count = fill(ranks, ticket);
    MPI_Send(ticket, count * (int)sizeof *ticket, MPI_BYTE, status.MPI_SOURCE, GIVEN, MPI_COMM_WORLD);
    left -= !count;
  }
  return NULL;
}

/* Of a case whose threads are of this rank alone. */
static double share_here(const struct gx_ranks *ranks, double share)
{
  return share * ranks->count < 1 ? share * ranks->count : 1;
}

static bool take(void *context, size_t *index, double *share)
{
  struct gx_ranks *ranks = context;
  if (!ranks->queue.take(ranks->queue.context, index, share)) return false;
  *share = share_here(ranks, *share);
  atomic_fetch_add(&ranks->given, 1);
  return true;
}

static bool ask(void *context, size_t *index, double *share)
{
  struct gx_ranks *ranks = context;
  if (ranks->used == ranks->got) {
    MPI_Request request;
    MPI_Status status;
    int bytes;
    MPI_Irecv(ranks->ticket, sizeof ranks->ticket, MPI_BYTE, 0, GIVEN, MPI_COMM_WORLD, &request);
    MPI_Send(NULL, 0, MPI_BYTE, 0, WANT, MPI_COMM_WORLD);
    if (!wait_for(ranks, &request, &status)) return false;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    ranks->got = (size_t)bytes / sizeof *ranks->ticket;
    ranks->used = 0;
    if (!ranks->got) return false;
  }
  *index = (size_t)ranks->ticket[ranks->used].index;
  *share = share_here(ranks, ranks->ticket[ranks->used++].share);
  return true;
}

int gx_ranks_serve(struct gx_ranks *ranks, struct gx_queue *queue, const atomic_bool *cancel, struct gx_source *source)
{
  ranks->cancel = cancel;
  *source = (struct gx_source){.context = ranks, .take = ranks->rank ? ask : take};
  if (ranks->rank) return 0;
  ranks->queue = gx_queue_source(queue);
  ranks->serving = !pthread_create(&ranks->server, NULL, serve, ranks);
  if (ranks->serving) return 0;
  fputs("gridcross run: cannot begin the thread that gives out cases\n", stderr);
  return GX_EXIT_FAILED;
}

size_t gx_ranks_given(const struct gx_ranks *ranks)
{
  return atomic_load(&ranks->given);
}

int gx_ranks_meet(struct gx_ranks *ranks)
{
  if (!ranks) return 0;
  if (ranks->serving) pthread_join(ranks->server, NULL);
  ranks->serving = false;
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  return wait_for(ranks, &request, MPI_STATUS_IGNORE) ? 0 : -1;
}

void gx_ranks_end(struct gx_ranks *ranks, bool broken, int code)
{
  enum { SIGNALS = 128 }; /* codes above: whoever sent the signal sees to the others */
  const struct timespec others = {.tv_nsec = 500000000};
  if (!ranks) return;
  gx_ranks_speak(ranks);
  if (!broken) {
    ranks->cancel = NULL;
    gx_ranks_meet(ranks);
    MPI_Finalize();
    free(ranks);
  } else if (code < SIGNALS) {
    fflush(NULL);
    MPI_Abort(MPI_COMM_WORLD, code);
  } else {
    nanosleep(&others, NULL); /* Open MPI kills all as soon as one has ended: to them too time for what they keep */
  }
}

#else

const char *gx_ranks_version(void)
{
  return "no MPI";
}

int gx_ranks_begin(struct gx_ranks **ranks, bool apart)
{
  const struct launch launch = find_launch();
  *ranks = NULL;
  if (launch.size < 2 || apart) return 0;
  if (!launch.rank)
    fprintf(stderr,
            "gridcross run: %ld processes were started for one run (%s), but this build has no MPI: build with meson setup "
            "-Dmpi=enabled, run parts by --shard i/n, or unset %s\n",
            launch.size, launch.variable, launch.variable);
  return GX_EXIT_USAGE;
}

bool gx_ranks_first(const struct gx_ranks *ranks)
{
  (void)ranks;
  return true;
}

size_t gx_ranks_threads(const struct gx_ranks *ranks, size_t processors)
{
  (void)ranks;
  return processors;
}

int gx_ranks_agree(struct gx_ranks *ranks, int code)
{
  (void)ranks;
  return code;
}

int gx_ranks_alike(struct gx_ranks *ranks, uint64_t number)
{
  (void)ranks, (void)number;
  return 0;
}

void gx_ranks_speak(struct gx_ranks *ranks)
{
  (void)ranks;
}

int gx_ranks_serve(struct gx_ranks *ranks, struct gx_queue *queue, const atomic_bool *cancel, struct gx_source *source)
{
  (void)ranks, (void)queue, (void)cancel, (void)source;
  return GX_EXIT_FAILED;
}

size_t gx_ranks_given(const struct gx_ranks *ranks)
{
  (void)ranks;
  return 0;
}

int gx_ranks_meet(struct gx_ranks *ranks)
{
  (void)ranks;
  return 0;
}

void gx_ranks_end(struct gx_ranks *ranks, bool broken, int code)
{
  (void)ranks, (void)broken, (void)code;
}
#endif
