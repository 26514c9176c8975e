# SPDX-License-Identifier: GPL-3.0-or-later
"""The checksums at the end of study.h5 and case-<id>.h5, made anew for a file that a test has changed (src/store/seal.c)."""
import struct

PIECE, START, WORD = 1 << 16, 0x9E3779B97F4A7C15, 1 << 64
FOOT = struct.Struct("<QQ8s")


def stir(total, word):
    total = (total ^ word) * 0xFF51AFD7ED558CCD % WORD
    return total ^ total >> 32


def checksum(data):
    whole = len(data) // 8 * 8
    total = START
    for (word,) in struct.iter_unpack("<Q", data[:whole]):
        total = stir(total, word)
    rest = data[whole:]
    return stir(stir(total, int.from_bytes(rest, "little")), len(rest)) if rest else total


def sealed(data):
    """The bytes of a file, up to its old checksums, with new ones."""
    length, _, magic = FOOT.unpack(data[-FOOT.size :])
    content = data[:length]
    sums = b"".join(struct.pack("<Q", checksum(content[at : at + PIECE])) for at in range(0, length, PIECE))
    return content + sums + FOOT.pack(length, checksum(sums + struct.pack("<Q", length)), magic)
