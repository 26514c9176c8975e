/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as run files write them: decimal, whole, finite. */
#ifndef GRIDCROSS_STUDY_NUMBER_H
#define GRIDCROSS_STUDY_NUMBER_H

/* Return NULL and fill the number, or say what is wrong with the text: "is not a number". -0 reads as 0. */
const char *gx_number_integer(const char *text, long *number);
const char *gx_number_real(const char *text, double *number);

#endif
