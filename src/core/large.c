/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of arrays that may be large, on large pages where the system has them. */
#define _DEFAULT_SOURCE /* madvise */
#include "large.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

enum { PAGE = 4096, LARGE = 4 << 20 };

void *gx_large_zeros(size_t bytes)
{
  void *memory = calloc(bytes ? bytes : 1, 1);
#ifdef MADV_HUGEPAGE
  if (memory && bytes >= LARGE) { /* advice: where it is not taken, nothing changes */
    size_t past = (uintptr_t)memory % PAGE, skipped = past ? PAGE - past : 0;
    madvise((char *)memory + skipped, (bytes - skipped) / PAGE * PAGE, MADV_HUGEPAGE);
  }
#endif
  return memory;
}
