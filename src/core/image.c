/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces of an image, each behind its length. */
#include <gridcross/image.h>

#include <stdint.h>

static void move(struct gx_image *image, void *bytes, size_t length)
{
  if (!image->failed && length && image->move(image->context, bytes, length)) image->failed = true;
}

void gx_image_bytes(struct gx_image *image, void *bytes, size_t length)
{
  uint64_t known = length;
  move(image, &known, sizeof known);
  if (known != length) image->failed = true; /* not of an equal thing */
  move(image, bytes, length);
}

void gx_image_reals(struct gx_image *image, int count, double *const *array, size_t length)
{
  for (int i = 0; i < count; i++) gx_image_bytes(image, array[i], length * sizeof(double));
}
