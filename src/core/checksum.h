/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checksums of what is kept on disk: against accidents, not against enemies. */
#ifndef GRIDCROSS_CORE_CHECKSUM_H
#define GRIDCROSS_CORE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* To begin with. */
#define GX_CHECKSUM_START UINT64_C(0x9e3779b97f4a7c15)

/* Of what came before, then these bytes; pieces whose lengths are multiples of 8 give the sum of the whole. A change of any one word
 * of 8 bytes changes the sum. */
uint64_t gx_checksum(uint64_t before, const void *bytes, size_t length);

#endif
