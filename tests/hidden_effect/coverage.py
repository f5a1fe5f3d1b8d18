#!/usr/bin/python3
"""Do the stated intervals hold the truth as often as they say, and do the readings kept back lie in their bands?

    coverage.py -o DIR [--seeds 12] [--first 1] [--effects a,b,c+d] [--tests 7] [--duration 8] [--rate 200] [--fault friction_scatter]
                [--build build/release]

Makes each set (make_sets, which shares no code with the program), gives `freestand compare` the model with the hidden effects, all
their numbers to be calibrated, and holds its joint draws against the numbers that the set was made with: is the truth within the
interval of 90 %, and at which rank among the draws? Of tests that no fit has seen: which share of the readings lies in the predicted
bands of 90 %? DIR/coverage.jsonl keeps each set, so that a later run goes on from there.
"""
import argparse
import json
import math
import pathlib
import subprocess

MODEL = "measurements: {}/dataset.yaml\nmodel: {{friction: {{mu: {{calibrate: [0.03, 1.2]}}}}, effects: [{}]}}\n"


def options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--effects", help="a,b,c+d; default: none, and all of the catalogue that make_sets --list names")
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--tests", type=int, default=7)
    parser.add_argument("--duration", type=float, default=8)
    parser.add_argument("--rate", type=int, default=200, help="readings of the sensors [Hz]")
    parser.add_argument("--fault", help="of the laboratory that measures (make_sets --help)")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    return parser.parse_args()


class Bench:
    def __init__(self, o):
        self.options, self.sets = o, o.output / "sets"
        self.freestand, self.make_sets = ((o.build / name).resolve() for name in ("freestand", "make_sets"))
        self.sets.mkdir(parents=True, exist_ok=True)

        told = subprocess.run([self.freestand, "effects", "--json"], capture_output=True, text=True, check=True).stdout
        self.known = {effect["name"]: effect["parameters"] for effect in json.loads(told)}

    def names(self):
        if self.options.effects:
            return self.options.effects.split(",")
        listed = subprocess.run([self.make_sets, "--list"], capture_output=True, text=True, check=True).stdout.split()
        return [name for name in listed if name == "none" or set(name.split("+")) <= set(self.known)]

    def name(self, effects, seed):
        o = self.options
        return f"{effects}-{seed}" + (f"-{o.rate}hz" if o.rate != 200 else "") + (f"-{o.fault}" if o.fault else "")

    def entry(self, effect):
        """The effect with all its numbers to be calibrated, those with a default too."""
        numbers = "".join(f", {p['name']}: {{calibrate: [{p['low']}, {p['high']}]}}" for p in self.known[effect] if p["fitted"])
        return f"{{name: {effect}{numbers}}}"

    def one(self, effects, seed):
        o = self.options
        subprocess.run([self.make_sets, "-o", self.sets, "--effects", effects, "--first", str(seed), "--seeds", "1", "--tests", str(o.tests),
                        "--duration", str(o.duration), "--rate", str(o.rate)] + (["--fault", o.fault] if o.fault else []), check=True, capture_output=True)
        name = self.name(effects, seed)
        answer = json.loads((self.sets / "answers.json").read_text())[name]
        (self.sets / f"{name}.yaml").write_text(MODEL.format(name, ", ".join(map(self.entry, answer["effects"]))))
        result = {"name": name, "effects": effects, "seed": seed}
        done = subprocess.run([self.freestand, "compare", f"{name}.yaml", "-o", f"{name}.comparison", "--overwrite", "--quiet"], cwd=self.sets,
                              capture_output=True, text=True)
        if done.returncode != 0:
            return {**result, "failed": done.stderr.strip()[-400:]}
        comparison = json.loads((self.sets / f"{name}.comparison" / "comparison.json").read_text())
        truth = true_numbers(answer["true_parameters"])
        result["error"] = comparison["calibration"]["error_floor_noise_allowed"]
        result["numbers"] = {p["name"]: {"true": truth[p["name"]], "value": p["value"], "interval": p["interval_90"], "rank": p["rank"]}
                             for p in ranked(comparison["parameters"], self.sets / f"{name}.comparison", truth)}
        result["within_band"] = [t["within_band"] for t in comparison["tests"] if t["role"] == "holdout" and t["within_band"] is not None]
        return result


def true_numbers(parameters):
    numbers = {"friction.mu": parameters["mu"]}
    for effect, values in parameters["effects"].items():
        numbers.update({f"effects.{effect}.{name}": value for name, value in values.items()})
    return numbers


def ranked(parameters, folder, truth):
    """Those with an interval and a truth, each with the share of the draws below the truth."""
    lines = [line.split(",") for line in (folder / "fitted_draws.csv").read_text().splitlines() if not line.startswith("#")]
    for p in parameters:
        if p["interval_90"] and p["name"] in truth:
            column = lines[0].index(p["name"])
            draws = [float(line[column]) for line in lines[1:]]
            yield {**p, "rank": sum(draw < truth[p["name"]] for draw in draws) / len(draws)}


def interval_of_share(held, count):
    """Wilson's, of 95 %."""
    z, p = 1.96, held / count
    middle, half = (p + z * z / (2 * count)), z * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count))
    return max(0.0, middle - half) / (1 + z * z / count), (middle + half) / (1 + z * z / count)


def table(results):
    good = [r for r in results if "failed" not in r]
    print(f"\n{'hidden':<36} {'number':<44} {'held':>8}")
    cells, ranks, bands = {}, [], []
    for r in good:
        for name, n in r["numbers"].items():
            cells.setdefault((r["effects"], name), []).append(n["interval"][0] <= n["true"] <= n["interval"][1])
            ranks.append(n["rank"])
        bands += r["within_band"]
    for (effects, name), held in cells.items():
        print(f"{effects:<36} {name:<44} {sum(held):>3}/{len(held)}")
    held = [one for all_ in cells.values() for one in all_]
    if held:
        low, high = interval_of_share(sum(held), len(held))
        print(f"intervals of 90 % hold the truth in {sum(held)} of {len(held)}: {100 * sum(held) / len(held):.1f} % ({100 * low:.1f} to {100 * high:.1f})")
        tenths = [sum(k <= 10 * rank < k + 1 or (k == 9 and rank == 1) for rank in ranks) for k in range(10)]
        chi2 = sum((n - len(ranks) / 10) ** 2 / (len(ranks) / 10) for n in tenths)
        print(f"ranks of the truth among the draws, by tenths: {tenths}; chi^2 {chi2:.1f} of 9 (16.9 in one of twenty)")
    if bands:
        mean = sum(bands) / len(bands)
        error = math.sqrt(sum((b - mean) ** 2 for b in bands) / max(len(bands) - 1, 1) / len(bands))
        print(f"of the readings of {len(bands)} tests kept back, {100 * mean:.1f} +- {100 * error:.1f} % lie in their bands of 90 %")
    print(f"{len(good)} sets, {len(results) - len(good)} failed")


def main():
    o = options()
    o.output.mkdir(parents=True, exist_ok=True)
    file = o.output / "coverage.jsonl"
    results = {r["name"]: r for r in map(json.loads, file.read_text().splitlines())} if file.exists() else {}
    bench = Bench(o)
    for seed in range(o.first, o.first + o.seeds):
        for effects in bench.names():
            name = bench.name(effects, seed)
            if name in results:
                continue
            results[name] = bench.one(effects, seed)
            with file.open("a") as out:
                out.write(json.dumps(results[name]) + "\n")
            told = results[name].get("failed") or "  ".join(f"{n['rank']:.2f}" for n in results[name]["numbers"].values())
            print(f"{name:<44} {told}", flush=True)
    table(list(results.values()))


if __name__ == "__main__":
    main()
