"""The last line of a result file, behind HDF5's end of it: a checksum of all before (src/io/closing_line.hpp).

freestand itself reads no file without it. Here a file may lack it: it goes when h5py writes into the file.
"""
import re
import zlib

_LINE = re.compile(rb"\nfreestand closed this file, crc32 of all before this line ([0-9a-f]{8})\n\Z")
_LENGTH = 68


def closed(content):
    """The bytes of a file with the line behind them, that which they may have had replaced."""
    content = _LINE.sub(b"", content)
    return content + b"\nfreestand closed this file, crc32 of all before this line %08x\n" % zlib.crc32(content)


def close(path):
    """For files that were changed on purpose."""
    path.write_bytes(closed(path.read_bytes()))


def is_damaged(path):
    """It has the line, and is not what it was when it was closed."""
    with open(path, "rb") as file:
        left = file.seek(0, 2) - _LENGTH
        if left < 0:
            return False
        file.seek(left)
        line = _LINE.search(file.read())
        if not line:
            return False
        file.seek(0)
        found = 0
        while left > 0:
            part = file.read(min(left, 1 << 20))
            if not part:
                return True
            found = zlib.crc32(part, found)
            left -= len(part)
        return found != int(line[1], 16)
