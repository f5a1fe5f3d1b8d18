"""Kills of random ranks at random moments of a run, from its start to the end of its fit, or requests to stop; each run goes on where the last
one ended, on another number of ranks, until it is done with the right bits.

    kills.py [COUNT [kill|stop [mpirun|slurm [SEED]]]]     COUNT runs that are struck; the phases in which they were are told

kill is SIGKILL of one rank: the others must end too, within a minute. stop is SIGTERM or SIGUSR1, to the launcher or to one rank, answered within ten
seconds (a machine that is busy with other things takes longer, and is told).
"""

import collections
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("app", "slurm")]
from cluster import Cluster, find, why_not
from support import FREESTAND, MPIEXEC, finished_blocks, result, slow_fit, study_text

CURE, RESUMABLE = 74, 75
ANSWERED_S = 10  # until all ranks have ended, on cores that have nothing else to do
HUNG = "launcher hung"
MOST_RANKS = 4
PHASES = ("start", "compute", "write", "fit")


def ranks_in(folder):
    """Processes of the program that work in a folder."""
    found = []
    for entry in os.listdir("/proc"):
        try:
            words = pathlib.Path(f"/proc/{entry}/cmdline").read_bytes().split(b"\0") if entry.isdigit() else []
        except OSError:
            continue
        if words and words[0] == FREESTAND.encode() and str(folder).encode() in words:
            found.append(int(entry))
    return sorted(found)


def heeds_requests(process):
    """Is it in its main program? Before, a signal ends it as the system does, whatever the program."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False
    mask = sum(int(line.split()[1], 16) for line in status.splitlines() if line.startswith(("SigCgt", "SigIgn")))
    return bool(mask & (1 << (signal.SIGUSR1 - 1)))


def phase(folder):
    if (folder / "samples.h5").exists():
        return "fit"
    if (folder / ".samples.h5.part").exists():
        return "write"
    return "compute" if (folder / "blocks").exists() and finished_blocks(folder) else "start"


class Mpirun:
    def __init__(self, session):
        self.environment = {**os.environ, "OMPI_MCA_orte_tmpdir_base": str(session)}

    def start(self, arguments, ranks):
        return subprocess.Popen([MPIEXEC, "-n", str(ranks), FREESTAND, *arguments], env=self.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)


class Slurm:
    """Ranks on both nodes of a cluster of this machine alone."""

    def __init__(self, cluster):
        self.cluster = cluster

    def start(self, arguments, ranks):
        return subprocess.Popen([find("srun"), "--mpi=pmix", "--nodes=2", f"--ntasks={max(ranks, 2)}", "--overcommit", "--kill-on-bad-exit=1",
                                 "--quiet", FREESTAND, *arguments], env=self.cluster.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)


class Kills:
    def __init__(self, launcher, folder, what, seed):
        self.launcher, self.folder, self.what, self.dice = launcher, folder, what, random.Random(seed)
        self.study = folder / "study.yaml"
        self.study.write_text(slow_fit(study_text(samples=20000)).replace("resamples: 15000", "resamples: 500"))
        start = time.monotonic()
        self.end(self.begin(folder / "whole", 2))
        self.seconds = time.monotonic() - start
        self.whole = result(folder / "whole")
        self.phases, self.ends, self.longest, self.finished = collections.Counter(), collections.Counter(), 0.0, 0

    def begin(self, out, ranks):
        return self.launcher.start(["run", str(self.study), "-o", str(out), "--quiet", "--resume"], ranks)

    def end(self, process):
        _, error = process.communicate(timeout=600)
        if process.returncode != 0:
            raise AssertionError(f"ends with {process.returncode}: {error[-1500:]}")

    def strike(self, out, process):
        """Waits for a random moment of a random phase and strikes: the phase, or none where the run was done before."""
        wanted = self.dice.choice(PHASES)
        while process.poll() is None and (not ranks_in(out) or PHASES.index(phase(out)) < PHASES.index(wanted)):
            time.sleep(0.002)
        try:
            process.wait(0 if wanted == "write" else self.dice.uniform(0, 0.3) * self.seconds)
        except subprocess.TimeoutExpired:
            pass
        ranks, place = ranks_in(out), phase(out)
        while self.what == "stop" and ranks and not all(map(heeds_requests, ranks)):
            time.sleep(0.002)
            ranks, place = ranks_in(out), phase(out)
        if not ranks:
            return None
        start, answers = time.monotonic(), {0, CURE, RESUMABLE, HUNG}
        if self.what == "kill":
            os.kill(self.dice.choice(ranks), signal.SIGKILL)
        else:
            target, asked = self.dice.choice([process.pid, self.dice.choice(ranks)]), self.dice.choice([signal.SIGTERM, signal.SIGUSR1])
            if target == process.pid and asked == signal.SIGTERM:
                answers |= {1, 137, 143}  # mpirun and srun end the ranks their own way; the scripts of jobs/ ask them by SIGUSR1
            os.kill(target, asked)
        while ranks_in(out):
            if time.monotonic() > start + 60:
                raise AssertionError(f"{place}: ranks {ranks_in(out)} are left behind")
            time.sleep(0.01)
        seconds = time.monotonic() - start
        self.longest = max(self.longest, seconds)
        if self.what == "stop" and seconds > ANSWERED_S:
            raise AssertionError(f"{place}: a request to stop was answered after {seconds:.1f} s")
        code, error = self.end_of(process)
        if self.what == "stop" and code not in answers:
            of = "the launcher" if target == process.pid else f"rank process {ranks.index(target)} of {len(ranks)}"
            raise AssertionError(f"{place}: {asked.name} to {of} is answered by {code} after {seconds:.1f} s: {error[-1500:]}")
        self.ends[code] += 1
        return place

    def end_of(self, process):
        """Of a launcher whose ranks are gone. Those of Open MPI 4.1 now and then wait for ever for a lock of their own (PMIx_server_finalize)."""
        try:
            _, error = process.communicate(timeout=60)
            return process.returncode, error
        except subprocess.TimeoutExpired:
            process.kill()
            return HUNG, process.communicate()[1]

    def one_run(self, number, count):
        """To its end, struck up to four times."""
        out = self.folder / f"run-{number}"
        for _ in range(self.dice.randint(1, 4)):
            if sum(self.phases.values()) >= count:
                break
            process = self.begin(out, self.dice.randint(2, MOST_RANKS))
            place = self.strike(out, process)
            if place is None:
                process.communicate(timeout=600)
                break
            self.phases[place] += 1
        for _ in range(3):  # a rank that was killed has left its lock, which is watched first
            process = self.begin(out, self.dice.randint(2, MOST_RANKS))
            process.communicate(timeout=600)
            if process.returncode != RESUMABLE:
                break
        if process.returncode != 0:
            raise AssertionError(f"run {number} ends with {process.returncode}")
        if result(out) != self.whole:
            raise AssertionError(f"run {number}: the numbers are others")
        self.finished += 1
        shutil.rmtree(out)

    def all(self, count):
        number = 0
        while sum(self.phases.values()) < count:
            self.one_run(number, count)
            number += 1


def leave(*_):
    sys.exit(1)  # and what was started is stopped


def main(count=100, what="kill", how="mpirun", seed=None):
    seed = int(seed) if seed is not None else int.from_bytes(os.urandom(4), "little")
    reason = why_not() if how == "slurm" else None
    if reason:
        print(f"skipped: {reason}")
        return 77
    with tempfile.TemporaryDirectory(prefix="freestand-kills-", ignore_cleanup_errors=True) as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)
        if how == "slurm":
            with Cluster() as cluster:
                return told(Kills(Slurm(cluster), folder, what, seed), int(count), what, how, seed)
        with tempfile.TemporaryDirectory(prefix="fs-", ignore_cleanup_errors=True) as session:
            return told(Kills(Mpirun(session), folder, what, seed), int(count), what, how, seed)


def told(kills, count, what, how, seed):
    try:
        kills.all(count)
        wrong = ""
    except (AssertionError, subprocess.TimeoutExpired) as problem:
        wrong = str(problem)
    print(f"{how}, {what}, seed {seed}: struck {dict(kills.phases)}, ended with {dict(kills.ends)}, all ranks gone after {kills.longest:.1f} s "
          f"at most; {kills.finished} runs went on to the right bits{'; WRONG: ' + wrong if wrong else ''}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, leave)
    sys.exit(main(*sys.argv[1:]))
