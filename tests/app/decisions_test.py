"""`risk` and `sensitivity` on a real sweep, and the mistakes that their users make."""

import csv
import json
import unittest
from math import log
from statistics import pvariance as variance

from support import InFolder, h5py, study_text

HAZARD = "pga_g,annual_rate\n0.02,0.5\n0.1,0.06\n0.3,0.008\n1,3e-4\n3,1e-6\n"
STUDY = study_text(samples=3000).replace("im: report", "im: pga_g").replace("axes: [friction.mu_k], ", "")


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Risk(InFolder):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.succeed(["run", self.write("study.yaml", STUDY), "-o", self.out], 2)
        self.hazard = self.write("hazard.csv", HAZARD)

    def test_rates_of_every_demand_and_capacity(self):
        done = self.succeed(["risk", self.out, "--hazard", self.hazard, "-o", self.folder / "risk", "--years", 50, 475])
        self.assertRegex(done.stdout, "in 50 years +in 475 years")
        found = json.loads((self.folder / "risk/risk.json").read_text())
        table = rows(self.folder / "risk/risk.csv")
        with h5py.File(self.out / "fragility.h5") as file:
            titles = [(name, c) for name in file["edp"] for c in file[f"edp/{name}/capacity"][()]]
        self.assertEqual(len(found["demands"]), len(titles))
        self.assertEqual(len(table), len(titles))
        told = [row for row in found["demands"] if row["annual_rate"]]
        self.assertTrue(told)
        for row in told:
            self.assertLess(row["lower"], row["annual_rate"])
            self.assertGreater(row["upper"], row["annual_rate"])
            self.assertAlmostEqual(sum(row["share_by_im"]), 1, delta=1e-9)
            self.assertEqual([one["years"] for one in row["in_years"]], [50, 475])
        delta = [row["annual_rate"] for row in told if row["edp"] == "delta"]
        self.assertEqual(delta, sorted(delta, reverse=True))
        self.assertIn("probability_475y", table[0])
        # An overturned block is beyond every capacity, so no limit of overturning lies above one of those.
        over, = (row for row in told if row["edp"] == "overturned")
        for row in told:
            if row["edp"] == "delta":
                self.assertLessEqual(over["upper"], row["upper"])
                self.assertLessEqual(over["lower"], row["lower"])
        # Why a row goes by counts stands below the table.
        for row in told:
            if row["recommended"] == "counts":
                self.assertIn(f"* by counts, {row['why']}: ", done.stdout)
        self.assertIn("counts", [row["recommended"] for row in told])
        # Nothing is replaced unasked, nor the sweep at all.
        self.fail_with(2, ["risk", self.out, "--hazard", self.hazard, "-o", self.folder / "risk"], "--overwrite")
        self.succeed(["risk", self.out, "--hazard", self.hazard, "-o", self.folder / "risk", "--overwrite"])
        self.fail_with(2, ["risk", self.out, "--hazard", self.hazard, "-o", self.out, "--overwrite"], "is the sweep itself")
        self.assertTrue((self.out / "samples.h5").exists())

    def test_a_curve_that_no_bin_checks_is_marked(self):
        study = self.write("few.yaml", STUDY.replace("resamples: 50", "resamples: 50, minimum_samples: 2000"))
        self.succeed(["run", study, "-o", self.folder / "few", "--quiet"])
        done = self.succeed(["risk", self.folder / "few", "--hazard", self.hazard, "-o", self.folder / "risk"])
        self.assertRegex(done.stdout, r"(?m)^  delta > 1 .*fitted curve, with no bin to check it$")

    def test_mistakes_are_told_with_file_and_line(self):
        def refused(code, text, *words):
            self.fail_with(code, ["risk", self.out, "--hazard", self.write("bad.csv", text), "-o", self.folder / "no"], *words)
            self.assertFalse((self.folder / "no").exists())

        refused(3, HAZARD.replace("0.3,0.008", "0.3,0.08"), "bad.csv:4", "annual_rate rises from 0.06 to 0.08")
        refused(3, HAZARD.replace("3e-4", "0"), "bad.csv:5", "not positive")
        refused(3, HAZARD.replace("pga_g", "pga"), "bad.csv:1", "pga is unknown", "pga_g")
        refused(2, HAZARD.replace("pga_g", "pgv_mps"), "bad.csv:1: the curve is over pgv_mps", "was fitted over pga_g")
        refused(2, "pga_g,annual_rate\n20,0.5\n30,0.1\n", "share no intensity")
        self.fail_with(3, ["risk", self.out, "--hazard", self.folder / "none.csv", "-o", self.folder / "no"], "none.csv")
        self.fail_with(3, ["risk", self.folder, "--hazard", self.hazard, "-o", self.folder / "no"], "has no fragility.h5")
        self.fail_with(2, ["risk", self.out, "--hazard", self.hazard, "-o", self.folder / "no", "--years", -1], "--years -1")


class Sensitivity(InFolder):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.succeed(["run", self.write("study.yaml", STUDY), "-o", self.out], 2)

    def test_the_same_numbers_on_any_number_of_ranks(self):
        done = self.succeed(["sensitivity", self.out, "--total", 256, "-o", self.folder / "one"])
        self.assertIn("ln delta", done.stdout)
        self.succeed(["sensitivity", self.out, "--total", 256, "-o", self.folder / "three"], 3)
        for name in ("sensitivity.json", "sensitivity.csv"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "three" / name).read_bytes())
        found = json.loads((self.folder / "one/sensitivity.json").read_text())
        names = [one["name"] for one in found["parameters"]]
        self.assertEqual(names, ["block.width_m", "friction.mu_k", "motion.peak_acceleration_g", "motion.period_s", "motion"])
        ln_delta = found["answers"][0]
        self.assertEqual((ln_delta["edp"], ln_delta["kind"]), ("delta", "ln_demand"))
        shares = {name: one["share"]["value"] for name, one in ln_delta["shares"].items()}
        # Friction and peak acceleration make the slip; the width does not enter it while the block does not rock.
        self.assertGreater(min(shares["friction.mu_k"], shares["motion.peak_acceleration_g"]), 0.05)
        self.assertLess(shares["block.width_m"], 0.05)
        for one in ln_delta["shares"].values():
            self.assertGreater(one["total"]["value"], one["share"]["value"] - 4 * (one["total"]["se"] + one["share"]["se"]))

    def test_numbers_that_are_drawn_together_have_one_share(self):
        """Friction alone moves a sliding block. The impact factor is drawn with it, hardly depends on it, and had its total share."""
        draws = "".join(f"{0.05 + 0.25 * i / 500},{0.5 + 0.3 * (i * 0.618034 % 1)}\n" for i in range(500))
        self.write("draws.csv", "mu,factor\n" + draws)
        study = """
seed: 3
samples: 16000
block: {width_m: 0.6, height_m: 1.8, mass_kg: 100}
friction: {mu: {posterior: draws.csv, column: mu}}
impact: {factor: {posterior: draws.csv, column: factor}}
model: slide
motions: [{pulse: rectangular, period_s: {uniform: [0.4, 0.6]}, peak_acceleration_g: 0.6}]
fragility: {im: pga_g, edp: [peak_slip_m], capacities: {peak_slip_m: [0.8]}}
"""
        self.succeed(["run", self.write("joint.yaml", study), "-o", self.folder / "joint", "--quiet"])
        done = self.succeed(["sensitivity", self.folder / "joint", "--total", 500])
        table = "friction.mu with impact.factor (drawn together)"
        self.assertIn(table, done.stdout)
        found = json.loads((self.folder / "joint/sensitivity.json").read_text())
        self.assertEqual([one["name"] for one in found["parameters"]], [table, "motion.period_s"])
        self.assertEqual({row["parameter"] for row in rows(self.folder / "joint/sensitivity.csv")}, {table, "motion.period_s"})
        ln_slip = found["answers"][0]
        # Slip goes as (0.6/mu - 1) T^2: the variances of the two logarithms add up.
        mu = [0.05 + 0.25 * i / 500 for i in range(500)]
        of_mu, of_period = variance([log(0.6 / one - 1) for one in mu]), variance([2 * log(0.4 + 0.2 * (i + 0.5) / 1000) for i in range(1000)])
        for name, own in ((table, of_mu), ("motion.period_s", of_period)):
            truth, one = own / (of_mu + of_period), ln_slip["shares"][name]
            for kind in ("share", "total"):
                self.assertAlmostEqual(one[kind]["value"], truth, delta=3 * one[kind]["se"], msg=f"{name} {kind}")
        self.assertAlmostEqual(ln_slip["together"]["value"], 1, delta=0.03)

    def test_pairs_that_are_too_few_give_no_total_shares(self):
        done = self.succeed(["sensitivity", self.out, "--total", 64, "-o", self.folder / "few"])
        self.assertRegex(done.stdout, r"overturned .*no total shares: \d+ of the 64 samples that were computed again differ from the others")
        found = json.loads((self.folder / "few/sensitivity.json").read_text())
        self.assertNotIn("total", next(one for one in found["answers"] if one["kind"] != "ln_demand" and one["shares"])["shares"]["friction.mu_k"])

    def test_the_confidence_of_the_study(self):
        self.succeed(["fit", self.out, "--confidence", 0.8])
        width = {}
        for more in ([], ["--confidence", 0.95]):
            self.succeed(["sensitivity", self.out, "-o", self.folder / "s", "--quiet"] + more)
            found = json.loads((self.folder / "s/sensitivity.json").read_text())
            share = next(one for one in found["answers"] if one["shares"])["shares"]["motion.peak_acceleration_g"]["share"]
            width[found["confidence"]] = share["upper"] - share["lower"]
        self.assertEqual(sorted(width), [0.8, 0.95])
        self.assertLess(width[0.8], 0.8 * width[0.95])

    def test_a_damage_state_has_the_shares_of_the_demand_that_it_asks_for(self):
        path = self.out / "study.yaml"
        text = path.read_text().replace("edp: [delta, overturned]", "edp: [delta, overturned, peak_slip_m]\n  damage:\n    gone: peak_slip_m > 0.1 or overturned")
        self.assertIn("gone", text)
        path.write_text(text)
        self.succeed(["fit", self.out])
        self.succeed(["sensitivity", self.out, "--total", 256, "-o", self.folder / "s"], 2)
        answers = json.loads((self.folder / "s/sensitivity.json").read_text())["answers"]
        state, = (one for one in answers if one["edp"] == "gone")
        demand, = (one for one in answers if (one["edp"], one.get("capacity")) == ("peak_slip_m", 0.1))
        self.assertEqual(state["shares"], demand["shares"])
        self.assertGreater(state["shares"]["motion.peak_acceleration_g"]["share"]["value"], 0.1)

    def test_mistakes(self):
        self.fail_with(2, ["sensitivity", self.out, "--total", 99999], "--total 99999 is more than the 3000 samples")
        self.fail_with(3, ["sensitivity", self.folder], "samples.h5")
        (self.out / "sensitivity.csv").write_text("mine\n")
        self.fail_with(2, ["sensitivity", self.out], "sensitivity.csv", "did not write")
        self.assertEqual((self.out / "sensitivity.csv").read_text(), "mine\n")
        path = self.out / "study.yaml"
        path.write_text(path.read_text().replace("dispersion: 0.4", "dispersion: 0.5"))
        self.fail_with(2, ["sensitivity", self.out, "--total", 64, "-o", self.folder / "x"], "is not the study that was swept")
        fixed = STUDY.replace("{uniform: [0.5, 0.9]}", "0.7").replace("{lognormal: {median: 0.25, dispersion: 0.4}}", "0.25")
        fixed = fixed.replace("pulse: [A, B, C1]", "pulse: A").replace("{uniform: [0.3, 1.5]}", "0.8").replace("{uniform: [0.1, 2]}", "0.7")
        fixed = fixed.replace("samples: 3000", "samples: 40").replace("bins: {count: 5}", "bins: {edges: [0.1, 2]}")
        self.succeed(["run", self.write("fixed.yaml", fixed), "-o", self.folder / "fixed"])
        self.fail_with(2, ["sensitivity", self.folder / "fixed"], "samples nothing")


if __name__ == "__main__":
    unittest.main()
