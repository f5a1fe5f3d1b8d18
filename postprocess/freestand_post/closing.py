"""The last line of a result file, behind HDF5's end of it: a checksum of all before (src/io/closing_line.hpp).

freestand itself reads no file without it. Here a file may lack it: it goes when h5py writes into the file.
"""
import re
import zlib

from .problem import Problem

_LINE = re.compile(rb"\nfreestand closed this file, crc32 of all before this line ([0-9a-f]{8})\n\Z")
_LENGTH = 68


def closed(content):
    """The bytes of a file with the line behind them, that which they may have had replaced."""
    content = _LINE.sub(b"", content)
    return content + b"\nfreestand closed this file, crc32 of all before this line %08x\n" % zlib.crc32(content)


def close(path):
    """For files that were changed on purpose."""
    path.write_bytes(closed(path.read_bytes()))


def refuse_damaged(path, cure):
    """Before h5py opens it, which may crash on it, or read other numbers."""
    if is_damaged(path):
        raise Problem(f"{path} was damaged, or changed, since freestand closed it (the checksum in its last line is another one): {cure}")


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
