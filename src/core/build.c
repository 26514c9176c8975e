/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Provenance of the build, from what Meson configured. */
#include <gridcross/build.h>

#include "build_info.h"
#include "git_revision.h"

const struct gx_build gx_build = {
    .version = GX_VERSION,
    .git_revision = GX_GIT_REVISION,
    .compiler = GX_COMPILER,
    .flags = GX_FLAGS,
    .gsl = GX_GSL_VERSION,
    .fftw = GX_FFTW_VERSION,
    .hdf5 = GX_HDF5_VERSION,
    .yaml = GX_YAML_VERSION,
};
