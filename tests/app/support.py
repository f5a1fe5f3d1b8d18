"""What the tests of the program share: studies, runs, and the comparison of result files."""

import atexit
import contextlib
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    print("skipped: python3-h5py is not installed")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "postprocess"))
from freestand_post import closing  # noqa: E402, F401

FREESTAND = os.environ["FREESTAND"]
MPIEXEC = os.environ["MPIEXEC"]


def own_session_folder():
    """A folder in which a launcher keeps its session. Open MPI's own is shared by all of a user: a launcher that starts while another one
    that ends removes it stops with "mkdir: File exists"."""
    folder = tempfile.mkdtemp(prefix="fs-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


os.environ["OMPI_MCA_orte_tmpdir_base"] = own_session_folder()
CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"

STUDY = """\
seed: 7
samples: {samples}
design: {design}
block_size: {block_size}
block: {{width_m: {{uniform: [0.5, 0.9]}}, height_m: 2.2, mass_kg: 300}}
friction: {{mu_k: {{lognormal: {{median: 0.25, dispersion: 0.4}}}}, static_ratio: 1.2}}
impact: {{law: coulomb}}
motions:
  - {{pulse: [A, B, C1], period_s: {{uniform: [0.3, 1.5]}}, peak_acceleration_g: {{uniform: [0.1, 2]}}}}
fragility: {{im: report, bins: {{count: 5}}, edp: [delta, overturned], axes: [friction.mu_k], resamples: 50}}
"""


def study_text(samples=3000, design="sobol", block_size=64):
    return STUDY.format(samples=samples, design=design, block_size=block_size)


def write_records(folder):
    """Six floor motions, and a table beside the folder that gives each a peak of the ground and a magnitude."""
    folder.mkdir()
    table = "file,pga_g,magnitude_mw\n"
    for number, (beat, fade) in enumerate(((5, 0.3), (9, 0.5), (3, 0.2), (14, 0.4), (7, 0.3), (20, 0.2))):
        name = f"{'abcdef'[number]}.csv"
        rows = (f"{0.01 * i:.2f},{4 * math.sin(beat * 0.01 * i * (1 + 0.001 * i)) * math.exp(-fade * 0.01 * i):.9f}\n" for i in range(600))
        (folder / name).write_text("time_s,floor_acceleration_mps2\n" + "".join(rows))
        table += f"{folder.name}/{name},{0.1 * (number + 1):.1f},{5 + 0.3 * number}\n"
    folder.with_suffix(".csv").write_text(table)


def slow_fit(text):
    """The study with a fit of many seconds."""
    return text.replace("edp: [delta, overturned]", "edp: [delta, overturned, peak_slip_m, slid_path_m]").replace("resamples: 50", "resamples: 15000")


def command(arguments, ranks=1):
    launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
    return launcher + [FREESTAND] + [str(a) for a in arguments]


def run(arguments, ranks=1, **options):
    return subprocess.run(command(arguments, ranks), capture_output=True, text=True, timeout=200, **options)


def datasets(path):
    """Every dataset of an HDF5 file: name -> (type, bytes)."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            values = item[()]
            found[name] = (str(item.dtype), values.tobytes() if item.dtype.kind != "O" else repr(list(values)))

    with h5py.File(path, "r") as file:
        file.visititems(visit)
    return found


def finished_blocks(folder):
    """Blocks of samples in the logs of a sweep that is not done: each begins a page."""
    logs = []
    for log in (folder / "blocks").glob("run-*.log"):
        with contextlib.suppress(FileNotFoundError):  # it was done, and took them away
            logs.append(log.read_bytes())
    return sum(log[page:page + 8] == b"FSBLOCKS" for log in logs for page in range(0, len(log), 4096))


def result(folder):
    """All numbers of a result folder."""
    texts = {name: (folder / name).read_bytes() for name in ("bins.csv", "surface.csv")}
    return datasets(folder / "samples.h5"), datasets(folder / "fragility.h5"), texts


def numbers(document):
    """All that is found in a JSON document, without what it says of the run."""
    about_the_run = ("created_utc", "command", "ranks", "host", "study", "measurements")
    found = json.loads(pathlib.Path(document).read_text(encoding="utf-8"))
    return {key: value for key, value in found.items() if key not in about_the_run}


def walkthrough(folder, tests=None, until_s=None):
    """The walk-through's study in a folder of its own, with some of its tests, and of these what was measured up to some time."""
    shutil.copytree(CONFIGS / "walkthrough", folder)
    if tests:
        head, *entries = (folder / "dataset.yaml").read_text(encoding="utf-8").split("  - id: ")
        kept = [entry for entry in entries if entry[:3] in tests]
        (folder / "dataset.yaml").write_text(head + "".join("  - id: " + entry for entry in kept), encoding="utf-8")
    if until_s:
        for file in (folder / f"{test}.csv" for test in tests):
            head, *rows = file.read_text(encoding="utf-8").splitlines()
            file.write_text("\n".join([head] + [row for row in rows if float(row.split(",")[0]) <= until_s]) + "\n", encoding="utf-8")
    return folder / "cabinet.yaml"


def folder_of_class(test_class):
    """A folder that the tests of a class share."""
    return pathlib.Path(test_class.enterClassContext(tempfile.TemporaryDirectory(prefix="freestand-test-")))


class InFolder(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="freestand-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def succeed(self, arguments, ranks=1):
        done = run(arguments, ranks)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fail_with(self, code, arguments, *words, ranks=1, **options):
        done = run(arguments, ranks, **options)
        self.assertEqual(done.returncode, code, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        return done
