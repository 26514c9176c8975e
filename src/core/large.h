/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of arrays that may be large. */
#ifndef GRIDCROSS_CORE_LARGE_H
#define GRIDCROSS_CORE_LARGE_H

#include <stddef.h>

/* Zeroed; NULL when memory runs out; for free(). Where it is many megabytes the system is asked for large pages: of small ones a system
 * hands out a gigabyte in seconds, longer than the first step over it takes. Pages that nobody touches cost nothing. */
void *gx_large_zeros(size_t bytes);

#endif
