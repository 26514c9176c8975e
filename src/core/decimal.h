/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decimal digits of a double, quickly. */
#ifndef GRIDCROSS_CORE_DECIMAL_H
#define GRIDCROSS_CORE_DECIMAL_H

#include <stdbool.h>

#include <gridcross/value.h>

/* Prints what printf's %.15g, %.16g or %.17g would, the first that reads back bit for bit. False where this arithmetic cannot tell, for
 * a few numbers in a hundred, and beyond 1e-39 to 1e17. */
bool gx_decimal_print(double value, char text[GX_NUMBER_LENGTH]);

#endif
