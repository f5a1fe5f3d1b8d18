"""Files are written aside and then renamed: a full disk leaves no cut page, and what stood there before."""
import errno
import os
import tempfile

from .problem import CURE, USAGE, Problem

CURABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)  # as freestand: to be cured before going on helps


def write(path, content):
    """content: text or bytes."""
    content = content.encode("utf-8") if isinstance(content, str) else content
    try:
        if path.exists() and not path.is_file():  # a pipe
            path.write_bytes(content)
        else:
            _aside(path.resolve(), content)
    except OSError as why:
        raise unwritten(path, why) from why


LIST = "freestand.files"
HEAD = "# What freestand wrote here, by a hash. A file of these that was changed since is yours, and is never replaced.\n"


def write_list(folder, names):
    """The list by which the program knows these files again (src/io/written_files.hpp): FNV-1a, 64 bits, and the name."""
    before = (folder / LIST).read_text(encoding="utf-8").splitlines(True)[1:] if (folder / LIST).is_file() else []
    lines = [line for line in before if line[17:].rstrip("\n") not in names]
    for name in names:
        found = 14695981039346656037
        for byte in (folder / name).read_bytes():
            found = (found ^ byte) * 1099511628211 & 0xFFFFFFFFFFFFFFFF
        lines.append(f"{found:016x} {name}\n")
    write(folder / LIST, HEAD + "".join(lines))


def _aside(path, content):
    number, aside = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(number, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(number)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(aside, 0o666 & ~mask)  # mkstemp's are its owner's alone
        os.replace(aside, path)
    except BaseException:
        os.unlink(aside)
        raise


def unwritten(path, why):
    reason = "no permission" if isinstance(why, PermissionError) else (why.strerror or str(why)).lower()
    if why.errno in CURABLE:
        return Problem(f"{path} cannot be written ({reason}): cure it, as by freeing some space, and start again; what stood there is kept", CURE)
    return Problem(f"{path} cannot be written ({reason}): give another place with -o", USAGE)
