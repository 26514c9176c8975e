/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A family of methods: the NULL-ended array and its find-by-name, from the list of members that the build generates. */
#ifndef GRIDCROSS_CORE_FAMILY_H
#define GRIDCROSS_CORE_FAMILY_H

#include <string.h>

#define GX_FAMILY_ENTRY(member) &gx_##member,

/* type: struct gx_<type>; LIST(X): X(member) for each member, whose struct is gx_<member>. */
#define GX_FAMILY(type, prefix, LIST)                                                                                            \
  LIST(GX_FAMILY_DECLARE)                                                                                                        \
  const struct type *const prefix##_family[] = {LIST(GX_FAMILY_ENTRY) NULL};                                                     \
  const struct type *prefix##_find(const char *name)                                                                             \
  {                                                                                                                              \
    for (size_t i = 0; prefix##_family[i]; i++) /* a name that comes from here is soon found */                                  \
      if (prefix##_family[i]->name == name) return prefix##_family[i];                                                           \
    for (size_t i = 0; prefix##_family[i]; i++)                                                                                  \
      if (!strcmp(prefix##_family[i]->name, name)) return prefix##_family[i];                                                    \
    return NULL;                                                                                                                 \
  }

#endif
