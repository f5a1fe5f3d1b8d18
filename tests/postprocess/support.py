"""What the tests of postprocess share: the packages (or a skip that says so), invented results, and the two programs."""
import contextlib
import io
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
POSTPROCESS = ROOT / "postprocess"
sys.path.insert(0, str(POSTPROCESS))

try:
    import h5py  # noqa: F401
    import jinja2  # noqa: F401
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
    import scipy  # noqa: F401
except ModuleNotFoundError as missing:
    print(f"skipped: the Python package {missing.name} is not there (jobs/install brings it)")
    sys.exit(77)

import make_results  # noqa: E402
from freestand_post import command  # noqa: E402

_kept = tempfile.TemporaryDirectory()
_made = {}


def sweep():
    """A finished sweep of 6000 invented samples; made once, not to be changed."""
    if "sweep" not in _made:
        _made["sweep"] = make_results.make_sweep(pathlib.Path(_kept.name) / "sweep", 6000)
    return _made["sweep"]


def sweep_copy(target):
    shutil.copytree(sweep(), target)
    return pathlib.Path(target)


def start(program, *arguments):
    """postprocess/PROGRAM as a user starts it."""
    return subprocess.run([POSTPROCESS / program, *map(str, arguments)], capture_output=True, text=True, timeout=250)


def run(program, *arguments):
    """The same within this process, which has loaded its packages."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = command.main(program, list(map(str, arguments)))
        except SystemExit as end:
            code = end.code
    return subprocess.CompletedProcess([program, *arguments], code, out.getvalue(), err.getvalue())
