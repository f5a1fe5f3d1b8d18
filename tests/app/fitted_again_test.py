"""A study that was fitted, taken again by every command: its intervals stay with their numbers, what the tests leave open is drawn, effects that
are named alone are written with their numbers, and what belonged to another model is gone."""

import csv
import math
import statistics
import unittest

from support import InFolder, h5py, numbers, walkthrough

STRENGTHS = (0.28, 0.3, 0.32, 0.34, 0.36, 0.38, 0.4, 0.42, 0.44, 0.47, 0.5, 0.55)
FALLEN = (0.34, 0.38, 0.42, 0.44, 0.47, 0.5, 0.55)
TAIL = ("samples: 200\nmotions: [{pulse: B, period_s: 0.8, peak_acceleration_g: {uniform: [0.1, 0.6]}}]\n"
        "fragility: {im: pta_g, bins: {count: 4}, edp: [overturned], resamples: 20}\n")


def outcomes(folder, model):
    folder.mkdir()
    tests = "".join(f"  - {{id: t{k}, pulse: B, period_s: 0.8, peak_acceleration_g: {g}, role: {'holdout' if k % 4 == 3 else 'calibration'}, "
                    f"overturned: {str(g in FALLEN).lower()}}}\n" for k, g in enumerate(STRENGTHS))
    (folder / "dataset.yaml").write_text("format: freestand-measurements/1\nname: blocks\nspecimen: {mass_kg: 100}\ntests:\n" + tests)
    study = folder / "study.yaml"
    study.write_text(f"measurements: dataset.yaml\nmodel:\n{model}" + TAIL)
    return study


class FittedAgain(InFolder):
    def test_outcomes_are_predicted_by_what_the_tests_leave_open(self):
        study = outcomes(self.folder / "o", "  placement_scatter: {calibrate: [0.01, 0.5]}\n  friction: {mu: 0.9}\n"
                         "  block: {slenderness_rad: {calibrate: [0.1, 0.6]}, size_m: 0.8}\n")
        found = {}
        for name, of in (("first", study), ("again", self.folder / "first" / "fitted.yaml")):
            self.succeed(["compare", of, "-o", self.folder / name, "--quiet"])
            found[name] = numbers(self.folder / name / "comparison.json")
        first, again = ({p["name"]: p for p in f["parameters"]} for f in (found["first"], found["again"]))
        self.assertEqual(list(first), list(again))
        for name, number in first.items():
            self.assertAlmostEqual(again[name]["value"], number["value"], places=6)
            if number["interval"] and again[name]["interval"]:
                for one, other in zip(number["interval"], again[name]["interval"]):
                    self.assertAlmostEqual(one, other, delta=1e-6 * abs(one))
        self.assertEqual(found["again"]["posterior"]["draws"], found["first"]["posterior"]["draws"])
        for role in ("calibration", "holdout"):
            self.assertAlmostEqual(found["again"][role]["error"], found["first"][role]["error"], delta=0.03)
        for best in ([], ["--best"]):  # steep placements stay below pi/2
            self.succeed(["run", self.folder / "again" / "fitted.yaml", "-o", self.folder / f"swept{len(best)}", "--quiet", *best])

    def test_placements_of_a_known_width_are_drawn_with_their_scatter(self):
        study = outcomes(self.folder / "o", "  placement_scatter: {calibrate: [0.01, 0.5]}\n  friction: {mu: 0.9}\n"
                         "  block: {width_m: 0.4, height_m: 1.5}\n  model: rock\n")
        self.succeed(["compare", study, "-o", self.folder / "first", "--quiet"])
        with (self.folder / "first" / "fitted_draws.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        spread = statistics.pstdev(math.log(float(row["block.width_m"]) / 0.4) for row in rows)
        scatter = math.sqrt(statistics.fmean(float(row["placement_scatter"])**2 for row in rows))
        self.assertAlmostEqual(spread, scatter, delta=4 * scatter / math.sqrt(len(rows)))
        widths = {}
        for best in ([], ["--best"]):
            self.succeed(["run", self.folder / "first" / "fitted.yaml", "-o", self.folder / f"swept{len(best)}", "--quiet", *best])
            with h5py.File(self.folder / f"swept{len(best)}" / "samples.h5") as file:
                widths[len(best)] = set(file["samples/block_width_m"][:])
        drawn = {float(row["block.width_m"]) for row in rows}
        self.assertLessEqual(widths[0], drawn)
        self.assertFalse(widths[1] & drawn)

    def test_an_effect_named_alone_is_written_with_its_numbers(self):
        study = walkthrough(self.folder / "w", ("t01", "t02", "t05", "t07"), 2.2)
        study.write_text(study.read_text(encoding="utf-8").replace("effects: []", "effects: [rate_weakening]"), encoding="utf-8")
        self.assertIn("[rate_weakening]", study.read_text(encoding="utf-8"))
        self.succeed(["compare", study, "-o", self.folder / "out", "--quiet"])
        fitted = (self.folder / "out" / "fitted.yaml").read_text(encoding="utf-8")
        self.assertRegex(fitted, r"name: rate_weakening, drop: \{calibrate: .*value: ")
        sweep = self.write("out/sweep.yaml", fitted.replace("samples: 20000", "samples: 100"))
        self.succeed(["run", sweep, "-o", self.folder / "sweep", "--quiet"])
        # A discrepancy is of the model that it was found with, and a ladder of the tests that it was climbed on.
        old = fitted.replace("model:\n", "model:\n  discrepancy: {slip: {lognormal: {median: 1.1, dispersion: 0.3}}}\n")
        before = self.write("w/before.yaml", old + "ladder: [{step: base, error_calibration: 45.8}]\n")
        other = walkthrough(self.folder / "v", ("t01", "t05", "t07"), 2.2).parent / "dataset.yaml"
        self.succeed(["add", before, "static_friction", "--measurements", other, "-o", self.folder / "w" / "after.yaml", "--quiet"])
        after = (self.folder / "w" / "after.yaml").read_text(encoding="utf-8")
        self.assertNotIn("discrepancy", after)
        self.assertNotIn("45.8", after)
        self.assertRegex(after, r"step: base")


if __name__ == "__main__":
    unittest.main()
