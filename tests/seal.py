# SPDX-License-Identifier: GPL-3.0-or-later
"""The checksums that study.h5 and case-<id>.h5 end in (src/store/seal.c), for files that tests change or write by other programs."""
import struct

MAGIC = b"GXSEAL1\0"
PIECE = 1 << 16  # bytes


def stir(total, word):
    total = (total ^ word) * 0xFF51AFD7ED558CCD % 2**64
    return total ^ total >> 32


def checksum(data):
    whole = len(data) // 8 * 8
    total = 0x9E3779B97F4A7C15
    for (word,) in struct.iter_unpack("<Q", data[:whole]):
        total = stir(total, word)
    rest = data[whole:]
    return stir(stir(total, int.from_bytes(rest, "little")), len(rest)) if rest else total


def seal(path):
    """Gives a file new checksums, in place of those that it has: one for each piece, then one for these and the length."""
    data = path.read_bytes()
    if data.endswith(MAGIC):
        (length,) = struct.unpack("<Q", data[-24:-16])
        data = data[:length]
    sums = b"".join(struct.pack("<Q", checksum(data[at : at + PIECE])) for at in range(0, len(data), PIECE))
    length = struct.pack("<Q", len(data))
    path.write_bytes(data + sums + length + struct.pack("<Q", checksum(sums + length)) + MAGIC)
