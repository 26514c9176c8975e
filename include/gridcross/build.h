/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What this program was built from: the provenance of every result. */
#ifndef GRIDCROSS_BUILD_H
#define GRIDCROSS_BUILD_H

struct gx_build {
  const char *version;
  const char *git_revision; /* "unknown" outside a git checkout; ends in -dirty when files were changed */
  const char *compiler, *flags;
  const char *gsl, *fftw, *hdf5, *yaml; /* versions */
};

extern const struct gx_build gx_build;

#endif
