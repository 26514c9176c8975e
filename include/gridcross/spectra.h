/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spectra as tables for people and programs. NULL when memory runs out. */
#ifndef GRIDCROSS_SPECTRA_H
#define GRIDCROSS_SPECTRA_H

#include <gridcross/spectrum.h>
#include <gridcross/table.h>

/* One row a sample, at most `rows` of them at equal distances, first and last included: time, the error's root mean square, its
 * parts up to the grid's Nyquist wavenumber, above it and at the driven one, and the share of its square that is above. */
struct gx_table *gx_spectra_times(const struct gx_spectra *spectra, enum gx_quantity quantity, size_t rows);

/* One row a wavenumber: content at the first sample after the start, half-way and at the last, growth over all samples, and which
 * wavenumber is driven, which the grid's Nyquist wavenumber. Others are left out that hold less than a thousandth of the fullest. */
struct gx_table *gx_spectra_wavenumbers(const struct gx_spectra *spectra, enum gx_quantity quantity);

/* One row a case, sample and wavenumber: case, time, wavenumber, content. spectra, id: [cases] */
struct gx_table *gx_spectra_all(size_t cases, struct gx_spectra *const *spectra, const char *const *id,
                                enum gx_quantity quantity);

/* One row a wavenumber that is not 0: content at the last sample, null where it is round-off of the fullest. For axes
 * that are logarithmic. */
struct gx_table *gx_spectra_last(const struct gx_spectra *spectra, enum gx_quantity quantity);

#endif
