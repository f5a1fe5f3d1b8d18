#!/usr/bin/python3
"""Does the diagnosis name what is hidden? The confusion table, and the rates, over made sets.

    confusion.py -o DIR [--seeds 5] [--first 1] [--effects a,b,c+d] [--tests 10] [--duration 20] [--rate 200] [--ranks 1] [--again]
                 [--unpicked] [--weak] [--fault drift] [--build build/release]
    confusion.py -o DIR --mixed [--seeds 5] [--first 1] ...      of each seed: nothing, one effect, a weak one, one that no
                 catalogue knows, nothing and an effect before each fault of a laboratory; which effect, the seed says
    confusion.py -o DIR --table                                  what is done there, and nothing else

Makes each set (make_sets), runs `freestand diagnose` on it, and, where the answer is right, `freestand add` for each
hidden effect, or for the law that is proposed. One line per set as it is done; DIR/results.jsonl keeps them, so that a later run goes on from there, and
shares of the work can be done one by one. The program sees the set alone, never DIR/sets/answers.json.

What counts as what:
  right      the verdict is `missing` and names the hidden effects and no other; `none` where nothing is hidden;
             `unknown` where the effect is of no catalogue. Twins (a floor tilted and friction by direction, on a block that only slides, are one equation):
             `ambiguous`, naming the hidden effects and the twin and no other. `bad_data` where it names the dimension or
             the gain that is at fault. Beside a third effect they are nearly
             one equation: there the hidden pair alone is right as well.
  ambiguous  the verdict is `ambiguous`, and the hidden effects are among the named
  wrong      an effect is named that is not there, alone or beside such as are, whatever the errors; or `bad_data` for no
             fault
  none, unknown, failed  the verdict, or that the program gave none, where that is not right
Shares with Wilson's intervals of 95 %.
"""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import time

from coverage import interval_of_share

COLUMNS = ["right", "ambiguous", "wrong", "none", "unknown", "failed"]
STUDY = "measurements: {}/dataset.yaml\nmodel: {{friction: {{mu: {{calibrate: [0.03, 1.2]}}}}, effects: []}}\n"
# Faults that a verdict may name, by a word of its sentence; noise and friction that scatter spoil no verdict.
NAMED = {"gain": ["accelerometer"], "wrong_width": ["width"], "late_clock": ["clock", "stamped"], "one_late_clock": ["clock", "stamped"]}
FAULTS = ["coloured_noise", "drift", "gain", "wrong_width", "friction_scatter", "understated_noise", "overstated_noise",
          "late_clock", "one_late_clock"]
SIZES = [1, 2, 3, 4, 6, 12, 30, math.inf]  # [noise units] of the plain model
LEAST_BASE = 4.0  # [noise units]
AT_NOISE = 1.2
LAW_AT_NOISE, TIMES_LESS = 1.5, 5  # held-out errors after a proposed law


def options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--effects", help="a,b,c+d; default: all that make_sets --list names")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--tests", type=int, default=10)
    parser.add_argument("--duration", type=float, default=20)
    parser.add_argument("--rate", type=int, default=200, help="readings of the sensors [Hz]")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--unpicked", action="store_true", help="floors as they come, down to such as do not move the specimen")
    parser.add_argument("--weak", action="store_true", help="effects that make 1 to 6 noise units")
    parser.add_argument("--mixed", action="store_true", help="of each seed one of every kind")
    parser.add_argument("--fault", help="of the laboratory that measures (make_sets --help)")
    parser.add_argument("--again", action="store_true", help="do finished sets again")
    parser.add_argument("--table", action="store_true", help="print the table of what is done, and do nothing")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    return parser.parse_args()


class Wanted:
    """One set that is to be made."""

    def __init__(self, effects, seed, fault=None, weak=False):
        self.effects, self.seed, self.fault, self.weak = effects, seed, fault, weak

    def name(self, rate):
        return f"{self.effects}-{self.seed}" + "-weak" * self.weak + (f"-{rate}hz" if rate != 200 else "") + (f"-{self.fault}" if self.fault else "")


# By Weyl's steps through the lists, so that the seeds of a share meet all of them.
def mixed(seed, catalogue, outside):
    def at(step):
        return catalogue[(seed * 7 + step * 5) % len(catalogue)]

    sets = [Wanted("none", seed), Wanted(at(0), seed), Wanted(at(1), seed, weak=True), Wanted(outside[seed % len(outside)], seed)]
    for i, fault in enumerate(FAULTS):
        sets += [Wanted("none", seed, fault), Wanted(at(2 + i), seed, fault)]
    return sets


def answer_kind(answer):
    if not answer["effects"]:
        return "none"
    return "catalogue" if answer["in_catalogue"] else "outside"


def judged(answer, diagnosis):
    verdict, named, hidden = diagnosis["verdict"], set(diagnosis["effects"]), set(answer["effects"])
    kind, twins = answer_kind(answer), set(answer["twins"])
    if verdict == "bad_data":
        return "right" if any(word in " ".join(diagnosis["sentences"]) for word in NAMED.get(answer.get("fault"), [])) else "wrong"
    if kind == "outside":
        return "right" if verdict == "unknown" else verdict if verdict == "none" else "wrong"
    if kind == "none":
        return "right" if verdict == "none" else verdict if verdict == "unknown" else "wrong"
    if verdict in ("none", "unknown"):
        return verdict
    if verdict == "ambiguous":
        if twins and named == hidden | twins:
            return "right"
        return "ambiguous" if hidden <= named else "wrong"
    # Twins part where friction differs from test to test: what depends on the direction is a share of friction, a tilt is not.
    parted = not twins or len(hidden) > 1 or answer.get("fault") == "friction_scatter"
    return "right" if named == hidden and parted else "wrong"


class Bench:
    def __init__(self, o):
        self.options = o
        self.freestand = (o.build / "freestand").resolve()
        self.make_sets = (o.build / "make_sets").resolve()
        self.sets = o.output / "sets"
        self.sets.mkdir(parents=True, exist_ok=True)

    def run(self, *words):
        ranks = self.options.ranks
        start = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run(start + [self.freestand, *words, "--quiet"], cwd=self.sets, capture_output=True, text=True)

    def names(self):
        if self.options.effects:
            return self.options.effects.split(",")
        listed = subprocess.run([self.make_sets, "--list"], capture_output=True, text=True, check=True)
        return listed.stdout.split()

    def wanted(self):
        o = self.options
        seeds = range(o.first, o.first + o.seeds)
        if not o.mixed:
            return [Wanted(e, s, o.fault, o.weak) for s in seeds for e in self.names()]
        told = subprocess.run([self.freestand, "effects", "--json"], capture_output=True, text=True, check=True).stdout
        known = {effect["name"] for effect in json.loads(told)}
        listed = subprocess.run([self.make_sets, "--list"], capture_output=True, text=True, check=True).stdout.split()
        single = [name for name in listed if name != "none" and "+" not in name]
        inside, outside = [n for n in single if n in known], [n for n in single if n not in known]
        return [w for s in seeds for w in mixed(s, inside, outside)]

    def made(self, w):
        o = self.options
        subprocess.run([self.make_sets, "-o", self.sets, "--effects", w.effects, "--first", str(w.seed), "--seeds", "1",
                        "--tests", str(o.tests), "--duration", str(o.duration), "--rate", str(o.rate)] + ["--unpicked"] * o.unpicked +
                       ["--weak"] * w.weak + (["--fault", w.fault] if w.fault else []), check=True, capture_output=True)
        name = w.name(o.rate)
        (self.sets / f"{name}.yaml").write_text(STUDY.format(name))
        return name, json.loads((self.sets / "answers.json").read_text())[name]

    def one(self, w):
        name, answer = self.made(w)
        result = {"name": name, "effects": w.effects, "seed": w.seed, "tests": self.options.tests,
                  "duration": self.options.duration, "unpicked": self.options.unpicked, "rate": self.options.rate, "fault": w.fault, "weak": w.weak, "kind": answer_kind(answer), "twins": answer["twins"],
                  "habit": answer["habit"], "plain_error": answer["plain_error_noise_units"]}
        start = time.monotonic()
        done = self.run("diagnose", f"{name}.yaml", "-o", f"{name}.diagnosis", "--overwrite")
        result["seconds"] = round(time.monotonic() - start, 1)
        if done.returncode != 0:
            return {**result, "judged": "failed", "verdict": done.stderr.strip()[-400:]}
        diagnosis = json.loads((self.sets / f"{name}.diagnosis" / "diagnosis.json").read_text())
        visible = [c for c in diagnosis["candidates"] if c["visible"]]
        result.update(verdict=diagnosis["verdict"], named=diagnosis["effects"], judged=judged(answer, diagnosis),
                      commit=diagnosis["git_commit"], chances=diagnosis["tests_of_chance"],
                      proposed=(diagnosis["proposed_law"] or {}).get("effect"), base_error=diagnosis["base"]["error_calibration"], noise_floor=diagnosis["noise_floor"],
                      best=[[c["effect"], c["error_left_out"], c["error_left_out_floor_noise_allowed"]] for c in visible[:5]])
        if result["kind"] == "catalogue" and result["judged"] == "right":
            result.update(self.added(name, answer["effects"]))
        if result["proposed"]:
            result.update(self.added(name, [f"{name}.diagnosis/proposed_law.yaml"]))
        return result

    # The ladder after all hidden effects have been added.
    def added(self, name, effects):
        study = f"{name}.yaml"
        for i, effect in enumerate(effects):
            after = f"{name}.{i + 1}.yaml"
            done = self.run("add", study, effect, "-o", after, "--overwrite")
            if done.returncode != 0:
                return {"held_out": None, "held_out_floor": None, "trouble": done.stderr.strip()[-400:]}
            study = after
        before, *_, step = ladder(self.sets / study)
        return {"held_out_before": before.get("error_holdout"), "held_out": step.get("error_holdout"), "held_out_explained": step.get("explained_holdout"),
                "held_out_floor": step.get("noise_floor_holdout", step.get("noise_floor"))}


def ladder(study):
    steps, inside = [], False
    for line in study.read_text().splitlines():
        if inside and line.strip().startswith("- {"):
            pairs = (item.split(":") for item in line.strip()[3:-1].split(","))
            steps.append({key.strip(): float(value) for key, value in pairs if key.strip() != "step"})
        inside = inside or line.startswith("ladder:")
    return steps


def known(o):
    file = o.output / "results.jsonl"
    lines = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    return {r["name"]: r for r in lines
            if (r["tests"], r["duration"], r.get("rate", 200), r.get("unpicked", False)) == (o.tests, o.duration, o.rate, o.unpicked)}


def number(value, form="{:.3g}"):
    return "-" if value is None else form.format(value)


def line(r):
    named = " ".join(r.get("named", []))
    return (f"{r['name']:<40} {r['judged']:<9} {r['verdict']:<9} {named:<44} base {number(r.get('base_error')):>7}  "
            f"held out {number(r.get('held_out')):>6} (floor {number(r.get('held_out_floor'))}, by both "
            f"{number(r.get('held_out_explained'))})  {r['seconds']:.0f} s")


def table(results):
    print(f"\n{'hidden':<36} sets " + " ".join(f"{c:>9}" for c in COLUMNS) + "   base error   held out   seconds")
    for effects in dict.fromkeys(r["effects"] for r in results):
        rows = [r for r in results if r["effects"] == effects]
        counts = " ".join(f"{sum(r['judged'] == c for r in rows):>9}" for c in COLUMNS)
        base = [r["base_error"] for r in rows if r.get("base_error") is not None]
        held = [r["held_out"] for r in rows if r.get("held_out") is not None]
        median = number(statistics.median(base) if base else None)
        print(f"{effects:<36} {len(rows):>4} {counts} {median:>12} {number(max(held, default=None)):>10} "
              f"{max(r['seconds'] for r in rows):>9.0f}")
    print("base error: median; held out after add: largest; units of sensor noise. Seconds of diagnose: largest.")


def share(part, whole):
    if not whole:
        return "0/0"
    low, high = interval_of_share(part, whole)
    return f"{part}/{whole} = {100 * part / whole:.0f} % ({100 * low:.0f} to {100 * high:.0f})"


def false_name(r):
    """An effect is named that is not there; of outside effects any."""
    hidden = set() if r["kind"] != "catalogue" else set(r["effects"].split("+")) | set(r["twins"])
    return bool(set(r.get("named", [])) - hidden) and r.get("verdict") in ("missing", "ambiguous")


def by_fault(results):
    print("\nan effect is named that is not there (ambiguous with the right one counts too), by the laboratory's fault:")
    for fault in [None] + FAULTS + ["no_filter"]:
        of = [r for r in results if r.get("fault") == fault]
        none, some = [r for r in of if r["kind"] == "none"], [r for r in of if r["kind"] == "catalogue"]
        if of:
            right = sum(r["judged"] == "right" for r in some)
            print(f"  {fault or 'clean':<18} nothing hidden {share(sum(map(false_name, none)), len(none)):<24} one effect hidden "
                  f"{share(sum(map(false_name, some)), len(some)):<24} right there {share(right, len(some))}")


def power(results):
    print("\nclean sets with one effect, by what it makes of the plain model's error [noise units]:")
    of = [r for r in results if not r.get("fault") and r["kind"] == "catalogue"]
    for low, high in zip(SIZES, SIZES[1:]):
        rows = [r for r in of if low <= r["plain_error"] < high]
        if rows:
            counts = "  ".join(f"{c} {sum(r['judged'] == c for r in rows)}" for c in COLUMNS[1:])
            print(f"  {low:>3} to {high:<5} right {share(sum(r['judged'] == 'right' for r in rows), len(rows)):<26} {counts}")


def laws(results):
    of = [r for r in results if r["kind"] == "outside" and r.get("proposed")]
    if not of:
        return
    known = [r for r in of if r.get("held_out") is not None]
    at_noise = sum(r["held_out"] <= LAW_AT_NOISE for r in known)
    less = sum(TIMES_LESS * r["held_out"] <= r["held_out_before"] for r in known)
    print(f"\nlaws that are proposed where the effect is of no catalogue: {share(len(of), len([r for r in results if r['kind'] == 'outside']))}; "
          f"held-out error with them at most {LAW_AT_NOISE:g}: {share(at_noise, len(known))}, "
          f"{TIMES_LESS} times less than without: {share(less, len(known))}")
    for r in of:
        print(f"  {r['name']:<40} {r['proposed']:<44} held out {number(r.get('held_out_before')):>6} to {number(r.get('held_out')):>6}")


def rates(results):
    clean = [r for r in results if not r.get("fault")]
    hidden = [r for r in clean if r["kind"] == "catalogue" and r.get("base_error", LEAST_BASE + 1) > LEAST_BASE]
    none = [r for r in clean if r["kind"] == "none"]
    outside = [r for r in clean if r["kind"] == "outside"]
    right = [r for r in hidden if r["judged"] == "right"]
    both = sum(r["judged"] == "ambiguous" for r in hidden)
    counted = len(right) + min(both, len(hidden) // 10)
    held = [r["held_out_explained"] for r in right if r.get("held_out_explained") is not None]
    print(f"\nright, of the sets whose base error is over {LEAST_BASE:g}: {share(counted, len(hidden))} (wanted 95 %; "
          f"{both} ambiguous with the right one named, of which one set in ten counts)")
    print(f"none called missing: {share(sum(r['verdict'] in ('missing', 'ambiguous') for r in none), len(none))} "
          "(wanted at most 5 %)")
    print(f"outside the catalogue, not explained away: "
          f"{share(sum(r['judged'] == 'right' for r in outside), len(outside))} (wanted 90 %)")
    print(f"held-out error after add, in units of sensor and floor noise, at most {AT_NOISE:g}: "
          f"{share(sum(h <= AT_NOISE for h in held), len(right))} of the right ones; "
          f"largest {number(max(held, default=None))}")


def main():
    o = options()
    bench, results = Bench(o), known(o)
    wanted = [] if o.table else bench.wanted()
    for w in wanted:
        name = w.name(o.rate)
        if name in results and not o.again:
            continue
        results[name] = bench.one(w)
        with open(o.output / "results.jsonl", "a") as file:
            file.write(json.dumps(results[name]) + "\n")
            file.flush()
            os.fsync(file.fileno())
        print(line(results[name]), flush=True)
    shown = list(results.values()) if o.table else [results[w.name(o.rate)] for w in wanted]
    table(shown)
    rates(shown)
    laws(shown)
    by_fault(shown)
    power(shown)
    commits = sorted({r["commit"][:12] for r in shown if r.get("commit")})
    print(f"\ncommits: {', '.join(commits) or '-'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
