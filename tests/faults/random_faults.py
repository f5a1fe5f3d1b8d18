"""Cases drawn at random: a run, alone or of several ranks, that meets one to four faults of any kind one after the other, and then goes on to
its end. A case is told by the seed and its number, and these alone make it again.

    random_faults.py [CASES [SEED [FIRST]]]     tests/faults/run_random gives the rest
"""

import concurrent.futures
import os
import random
import shutil
import subprocess
import sys

from faults_test import ALLOWED, CURE, LASTING, Faults

RANKS = (1, 1, 1, 2, 3)
MOST_CALLS = 300  # that a small run makes in its folder


class Settings:
    """Small runs to compare with: one for each number of ranks and way of keeping."""

    def __init__(self):
        self.made = {}

    def of(self, ranks, keep):
        if (ranks, keep) not in self.made:
            self.made[ranks, keep] = Faults(ranks, 1, keep)
        return self.made[ranks, keep]

    def remove(self):
        for faults in self.made.values():
            shutil.rmtree(faults.folder)


def kind_of(dice):
    return dice.choice(RANKS), dice.choice(("all", "none"))


def drawn(dice):
    """One fault: most calls are early in a run that goes on, so that small numbers come more often."""
    kind = dice.choice(list(ALLOWED))
    return kind, kind in LASTING and dice.random() < 0.3, int(MOST_CALLS ** dice.random())


def case(settings, seed, number):
    """Faults that were met, and what is wrong."""
    dice = random.Random(f"{seed}/{number}")
    ranks, keep = kind_of(dice)
    faults = settings.of(ranks, keep)
    out, met, told = faults.folder / f"case-{number}", 0, []
    try:
        for _ in range(dice.randint(1, 4)):
            kind, lasting, call = drawn(dice)
            rank = dice.randrange(ranks)
            told.append(f"{kind}{', lasting' if lasting else ''} at call {call} of rank {rank}")
            reached, code, wrong = faults.struck(out, kind, lasting, rank, call, *(["--resume"] if out.exists() else []))
            met += reached
            if wrong and not (len(told) > 1 and code == CURE):  # nothing finished twice in a row asks for a cure, whatever the fault
                return met, f"{', '.join(told)}: {wrong}"
            if code == 0:
                break
        wrong = faults.gone_on(out, code)
        return met, wrong and f"{', '.join(told)}: {wrong}"
    except subprocess.TimeoutExpired:
        return met, f"{', '.join(told)}: hangs"
    finally:
        shutil.rmtree(out, ignore_errors=True)


def main(cases=50, seed=None, first=0):
    seed = int(seed) if seed is not None else int.from_bytes(os.urandom(4), "little")
    numbers = range(int(first), int(first) + int(cases))
    settings = Settings()
    for number in numbers:
        settings.of(*kind_of(random.Random(f"{seed}/{number}")))  # before they are run side by side
    met, wrong = 0, 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for number, (faults, problem) in zip(numbers, pool.map(lambda number: case(settings, seed, number), numbers)):
            met += faults
            wrong += bool(problem)
            if problem:
                print(f"again by: random_faults.py 1 {seed} {number}\n    {problem}", flush=True)
    settings.remove()
    print(f"seed {seed}: {len(numbers)} cases, {met} faults met, {wrong} cases answered wrongly", flush=True)
    return not wrong


if __name__ == "__main__":
    sys.exit(0 if main(*sys.argv[1:]) else 1)
