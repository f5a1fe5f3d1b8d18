"""Each call by which a run changes its folder fails in turn, or the run dies there. The rule: it is done with the right bits, or it tells
and going on gives the right bits; nothing between.

    faults_test.py [RANKS [EVERY [all|none]]]       every EVERYth call of each rank, for every kind of fault, until a run ends before the
                                                    call; which samples the study keeps
    faults_test.py RANKS drawn/SHARE [all|none]     for every kind of call and every fault that it may have one call drawn of those
                                                    that the run makes; of these pairs one in SHARE, but each kind of both
"""

import collections
import concurrent.futures
import itertools
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from support import command, datasets, result, study_text

LIBRARY = os.environ["FAIL_ONE_CALL"]
CURE, RESUMABLE = 74, 75
LEFT = ["bins.csv", "fragility.h5", "freestand.files", "ranking.csv", "samples.h5", "study.yaml", "summary.json", "surface.csv"]
NOTES = ["freestand.lock", "freestand.begun", "blocks"]  # where one cannot be removed, all is done, and the next run removes it
# What may come of it. A call that did a part, or tells an error though it is done, is no reason to end; one that was
# interrupted only within a library, and then going on helps; MPI's files do not tell which error it was.
ALLOWED = {"enospc": {0, CURE}, "edquot": {0, CURE}, "erofs": {0, CURE}, "eio": {0, CURE},
           "estale": {0, RESUMABLE}, "etimedout": {0, RESUMABLE}, "eintr": {0, RESUMABLE}, "short": {0}, "renamed": {0},
           "killed": None, "torn": None, "lost": None}
LASTING = ("enospc", "edquot", "erofs", "eio", "estale")
KINDS = [(kind, False) for kind in ALLOWED] + [(kind, True) for kind in LASTING]
FILE_SERVER = ("write", "pwrite", "open", "fsync", "close", "rename")  # what waits for one
WRITES = ("write", "pwrite", "writev", "pwritev")
ONLY = {"edquot": ("write", "pwrite", "close"), "estale": FILE_SERVER, "etimedout": FILE_SERVER, "erofs": ("open", "rename"), "short": WRITES,
        "torn": WRITES, "renamed": ("rename",), "eintr": WRITES + ("open", "fsync", "ftruncate")}  # others do what they do anyway


def small_study(keep):
    # Of fewer than 4096 samples all are kept.
    text = study_text(samples=128, block_size=32) if keep == "all" else study_text(samples=4400, block_size=1100) + "model: slide\nkeep: none\n"
    text = text.replace(", axes: [friction.mu_k], resamples: 50", ", resamples: 20")
    return text.replace("count: 5", "count: 2").replace("edp: [delta, overturned]", "edp: [delta]")


class Faults:
    def __init__(self, ranks=1, every=1, keep="all"):
        self.ranks, self.keep = int(ranks), keep
        drawn, _, number = str(every).rpartition("/")
        self.every, self.share = (1, int(number)) if drawn else (int(number), 0)
        self.left = sorted(LEFT + (["tally.h5"] if keep == "none" else []))
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="freestand-faults-"))
        self.study = self.folder / "study.yaml"
        self.study.write_text(small_study(keep))
        self.run(self.folder / "whole", check=True)
        self.whole = self.numbers(self.folder / "whole")

    def numbers(self, out):
        return result(out), datasets(out / "tally.h5") if self.keep == "none" else {}

    def run(self, out, *options, check=False, **settings):
        arguments = command(["run", self.study, "-o", out, "--quiet", *options], self.ranks)
        if settings and self.ranks > 1:  # the launcher's own files are not meant
            arguments = arguments[:3] + ["env", f"LD_PRELOAD={LIBRARY}"] + arguments[3:]
        elif settings:
            settings["LD_PRELOAD"] = LIBRARY
        with tempfile.TemporaryDirectory(prefix="fs-", ignore_cleanup_errors=True) as session:  # two launchers run side by side
            environment = {**os.environ, **settings, "OMPI_MCA_orte_tmpdir_base": session}
            return subprocess.run(arguments, env=environment, capture_output=True, text=True, timeout=120, check=check)

    def one(self, kind, lasting, rank, call, named=""):
        """What is wrong, nothing if all is well; None where the run ended before the call. Which call of all, or of those with a name."""
        name = f"{kind}{'-lasting' if lasting else ''}-{rank}-{named}{call}"
        out = self.folder / name
        try:
            reached, code, wrong = self.struck(out, kind, lasting, rank, call, named=named)
            wrong = wrong or self.gone_on(out, code)
            return (f"{name}: {wrong}" if wrong else "") if reached or wrong else None
        except subprocess.TimeoutExpired:
            return f"{name}: hangs"
        finally:
            shutil.rmtree(out, ignore_errors=True)

    def struck(self, out, kind, lasting, rank, call, *options, named=""):
        """Runs into the fault: was it reached, the exit code, and what is wrong with it."""
        told = out.with_name(f"{out.name}.told")
        try:
            done = self.run(out, *options, FAULT_FOLDER=str(out), FAULT_NAME=named, FAULT_CALL=str(call), FAULT_KIND=kind, FAULT_LASTING="01"[lasting],
                            FAULT_RANK=str(rank) if self.ranks > 1 else "", FAULT_TOLD=str(told), FAULT_SEED=str(call))
            wrong = self.wrong_end(out, kind, done)
            return told.exists(), done.returncode, f"{wrong}\n    {done.returncode}: {(done.stdout + done.stderr).strip()[-1500:]}" if wrong else ""
        finally:
            for left in out.parent.glob(f"{told.name}*"):  # and what it keeps of files that were replaced
                left.unlink()

    def wrong_end(self, out, kind, done):
        allowed = ALLOWED[kind]
        if kind == "eintr" and self.ranks > 1:
            allowed = allowed | {CURE}
        if allowed is not None and done.returncode not in allowed:
            return f"ends with {done.returncode}"
        if done.returncode != 0 and allowed is not None and (not done.stderr.strip() or "unexpected" in done.stderr):
            return "does not say what happened"
        return ""

    def gone_on(self, out, code):
        """What is wrong when it goes on to its end, after an end with that code."""
        if code == 0 and not any((out / name).exists() for name in NOTES):
            return self.other(out, "is done, but")
        for _ in range(2):  # where a rank has died, its lock is watched first
            again = self.run(out, "--resume")
            if again.returncode != RESUMABLE:
                break
        if again.returncode != 0:
            return f"going on ends with {again.returncode}: {again.stderr.split('---')[0].strip()[-400:]}"
        return self.other(out, "gone on,")

    def other(self, out, when):
        if self.numbers(out) != self.whole:
            return f"{when} the numbers are others"
        names = sorted(path.name for path in out.iterdir())
        return "" if names == self.left else f"{when} {sorted(set(names) ^ set(self.left))} is there or missing"

    def calls(self, rank):
        """How often a rank of the whole run makes each kind of call."""
        out, told = self.folder / f"listed-{rank}", self.folder / f"listed-{rank}.told"
        self.run(out, check=True, FAULT_FOLDER=str(out), FAULT_KIND="listed", FAULT_RANK=str(rank) if self.ranks > 1 else "", FAULT_TOLD=str(told))
        shutil.rmtree(out)
        return collections.Counter(told.read_text().split() if told.exists() else [])

    def every_one(self, pool):
        """Each fault and what is wrong with its answer."""
        kinds = [(*kind, name) for kind in KINDS for name in ONLY.get(kind[0], [""])]
        for number, ((kind, lasting, name), rank) in enumerate(itertools.product(kinds, range(self.ranks))):
            ended, calls = False, itertools.count(1 + number % self.every, self.every)
            while not ended:
                for wrong in pool.map(lambda call: self.one(kind, lasting, rank, call, name), itertools.islice(calls, 4)):
                    ended = ended or wrong is None
                    yield kind, lasting, wrong

    def drawn(self, pool, share):
        """The same of pairs of a fault and a call that it may strike. Ranks side by side do not make the same calls each time: where
        that one is not reached, the root's first is taken."""
        dice = random.Random(f"{self.ranks}/{self.keep}")
        made = [self.calls(rank) for rank in range(self.ranks)]
        pairs = [(kind, name) for kind in KINDS for name in sorted(made[0]) if name in ONLY.get(kind[0], made[0])]
        dice.shuffle(pairs)
        seen, faults = set(), []
        for number, (kind, name) in enumerate(pairs):
            if number % share == 0 or not seen.issuperset((kind, name)):
                seen.update((kind, name))
                rank = dice.choice([rank for rank in range(self.ranks) if made[rank][name]])
                faults.append((*kind, rank, dice.randint(1, made[rank][name]), name))
        for (*kind, _, _, name), wrong in zip(faults, pool.map(lambda fault: self.one(*fault), faults)):
            yield *kind, self.one(*kind, 0, 1, name) if wrong is None else wrong

    def all(self):
        counts, faults = collections.Counter(), []
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for kind, lasting, wrong in self.drawn(pool, self.share) if self.share else self.every_one(pool):
                counts[kind + (", lasting" if lasting else "")] += wrong is not None
                if wrong:
                    faults.append(wrong)
                    print(wrong, flush=True)
        shutil.rmtree(self.folder)
        print(f"{self.ranks} ranks, keep {self.keep}: {sum(counts.values())} faults, {len(faults)} answered wrongly:", dict(counts), flush=True)
        unseen = [kind for kind, _ in KINDS if counts[kind] == 0] if self.share or not counts else []
        if unseen:
            print(f"not one {', '.join(unseen)} was reached", flush=True)
        return not faults and not unseen


if __name__ == "__main__":
    sys.exit(0 if Faults(*sys.argv[1:]).all() else 1)
