# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts as C takes them, for the scripts that put files into the program."""


def literal(text):
    return '"' + "".join(c if " " <= c <= "~" and c not in '"\\?' else "".join(f"\\{b:03o}" for b in c.encode()) for c in text) + '"'


def array(text):
    """A string of any length: compilers need not take literals beyond 4095 characters."""
    numbers = ",".join(str(b if b < 128 else b - 256) for b in text.encode() + b"\0")
    return "{" + numbers + "}"
