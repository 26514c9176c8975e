/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images of what holds state over steps: each such thing has one function that names its lasting arrays, gx_<thing>_image, and the same
 * function saves them and loads them into an equal thing built anew. Not named is what building sets up and what every step makes. */
#ifndef GRIDCROSS_IMAGE_H
#define GRIDCROSS_IMAGE_H

#include <stdbool.h>
#include <stddef.h>

struct gx_image {
  void *context;
  bool loading;
  /* Moves so many bytes to where the image is kept or, loading, from there. Returns 0, or other than 0 when it cannot. */
  int (*move)(void *context, void *bytes, size_t length);
  bool failed; /* nothing is moved any more, and what was being loaded is neither old nor new */
};

/* With its length, which must be the same when it is loaded. */
void gx_image_bytes(struct gx_image *image, void *bytes, size_t length);
/* Component arrays of `length` numbers each. */
void gx_image_reals(struct gx_image *image, int count, double *const *array, size_t length);
#define GX_IMAGE(image, object) gx_image_bytes(image, &(object), sizeof(object))

#endif
