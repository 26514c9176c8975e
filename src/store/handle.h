/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What reading and writing HDF5 share. Included by the files of store/ that read or write HDF5, and by nobody else. */
#ifndef GRIDCROSS_STORE_HANDLE_H
#define GRIDCROSS_STORE_HANDLE_H

#include <stdbool.h>
#include <stdint.h>

#include <hdf5.h>

#include <gridcross/value.h>

enum {
  GX_HDF5_FORMAT = 3,    /* of study.h5: texts of known length are as wide as the longest */
  GX_HDF5_OLDEST = 2,    /* that is read */
  GX_HANDLE_NAME = 256,  /* room for a member's name */
  GX_HANDLE_WIDEST = 256 /* bytes of a text in a column that has a width */
};

/* HDF5 prints its error stack by default; we print one message instead. */
struct gx_handle_silence {
  H5E_auto2_t function;
  void *data;
};

/* Keeps HDF5 silent, until what is returned is given to gx_handle_restore. */
struct gx_handle_silence gx_handle_silence(void);
void gx_handle_restore(struct gx_handle_silence old);

/* Below, functions that return int give 0 or -1, those that return hid_t an identifier to be closed, or less than 0. */

/* UTF-8 of so many bytes, padded with zeros; 0: of any length. */
hid_t gx_handle_text_type(size_t width);
/* A scalar attribute. */
int gx_handle_put_attribute(hid_t object, const char *name, hid_t file_type, hid_t memory_type, const void *value);
int gx_handle_put_text(hid_t object, const char *name, const char *text);
int gx_handle_put_integer(hid_t object, const char *name, int64_t value);
/* A text attribute, owned by the caller; NULL when there is none. */
char *gx_handle_get_text(hid_t object, const char *name);
int gx_handle_get_integer(hid_t object, const char *name, int64_t *value);

/* A group whose members are listed in the order in which they were made. */
hid_t gx_handle_make_group(hid_t parent, const char *name);
/* Opens a member only when it is there. */
hid_t gx_handle_open_group(hid_t file, const char *name);
/* Name of a group's member in the order in which they were made; false: there is none. */
bool gx_handle_member(hid_t group, hsize_t i, char name[GX_HANDLE_NAME]);

/* A column of so many rows, without times, each null as long as nothing is written, when it takes no room: null: of `memory`'s type,
 * NULL: a text. */
hid_t gx_handle_make_dataset(hid_t group, const char *name, hid_t type, size_t rows, hid_t memory, const void *null);
/* Whether it has room for its rows, that is to say whether anything was written. */
bool gx_handle_is_stored(hid_t dataset);
/* Number of rows and type of a dataset that can be a column, or -1. */
hssize_t gx_handle_shape(hid_t dataset, enum gx_type *type);
/* Bytes of each of its texts, up to GX_HANDLE_WIDEST; 0: any number, or no texts. */
size_t gx_handle_width(hid_t dataset);
/* Whether the file that an object is of is as large as so many numbers of 8 bytes: what claims more is damaged, and no memory is taken
 * for it. */
bool gx_handle_holds(hid_t object, double numbers);
/* The same of a table, of whose columns at least so many are stored, and the others take no room. */
bool gx_handle_fits(hid_t object, double rows, size_t columns, size_t stored);
/* How many members a group has, or -1, also for more than its file can hold. */
hssize_t gx_handle_members(hid_t group);

#endif
