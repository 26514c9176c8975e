/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an x-t diagram shows of a case, from its snapshots. */
#ifndef GRIDCROSS_VIEW_TRACKS_H
#define GRIDCROSS_VIEW_TRACKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { GX_TRACKS_MOST = 64 }; /* paths, and edges; of more every second, third, ... is taken */

struct gx_tracks {
  size_t times;
  double *time;         /* [times] s, owned, as all below */
  size_t paths, *index; /* [paths] which particle */
  double *path;         /* [paths][times] x, m; in 2-D and 3-D of the row along x with most particles,
                         * nearest to the middle of the body where several have as many */
  size_t edges, *edge_index;
  double *edge; /* [edges][times] faces of cells across x, m; none where there is no grid */
  size_t crossings;
  struct gx_tracks_crossing {
    size_t path;
    double x, time;
  } * crossing;        /* [crossings] of these paths and a fixed grid's edges, between snapshots on straight lines */
  size_t of, edges_of; /* how many there are to take from */
  size_t cells;        /* along x, of a fixed grid; 0: it moves, or there is none */
  bool row;            /* paths are of one row of the body's particles */
};

/* Returns 0, or -1 after a message; to be freed in either case. */
int gx_tracks_read(struct gx_tracks *tracks, const char *directory, const char *id, FILE *errors);
void gx_tracks_free(struct gx_tracks *tracks);

#endif
