"""`until` goes on in rounds until the surface is known well enough, and a resumed one stops at the same place."""

import csv
import json
import unittest
from statistics import NormalDist

import numpy

from support import InFolder, datasets, h5py, study_text, write_records

# A rectangular pulse of amplitude a and period T, half of it one way and half the other, makes a block slip a g T^2/2 (a/mu - 1) at most.
SLIDING = """
seed: 1
until: {half_width: 0.01, at_most: 300000}
design: sobol
block: {width_m: 0.6, height_m: 1.8, mass_kg: 100}
friction: {mu: {uniform: [0.05, 0.3]}}
model: slide
motions:
  - {pulse: rectangular, period_s: {lognormal: {median: 0.6, dispersion: 0.4, min: 0.02}}, peak_acceleration_g: AMPLITUDE}
fragility:
  im: pga_g
  bins: BINS
  edp: [peak_slip_m]
  capacities: {peak_slip_m: [0.05, 0.2, 0.5, 1.0, 2.0]}
"""


def sliding(amplitude, bins):
    return SLIDING.replace("AMPLITUDE", amplitude).replace("BINS", bins)


def slips(random, amplitude_g):
    samples = len(amplitude_g)
    friction, period_s = random.uniform(0.05, 0.3, samples), 0.6 * numpy.exp(0.4 * random.standard_normal(samples))
    return amplitude_g * 9.80665 * period_s**2 / 2 * numpy.maximum(0, amplitude_g / friction - 1)


TEXT = study_text(block_size=256).replace("samples: 3000", "until: {half_width: 0.15, at_most: 200000}")


def of_points(points):
    """Half width that holds at so many points at once, in those of 95 % of one: z(1 - 0.025/m)/z(0.975)."""
    return NormalDist().inv_cdf(1 - 0.025 / points) / NormalDist().inv_cdf(0.975)


class Until(InFolder):
    def test_stops_when_the_surface_is_known(self):
        folder = self.folder / "out"
        done = self.succeed(["run", self.write("u.yaml", TEXT), "-o", folder], 2)
        self.assertIn("the surface is known to", done.stderr)
        with h5py.File(folder / "samples.h5") as file:
            samples = file["samples/outcome"].shape[0]
        self.assertLess(samples, 200000)
        points = 0
        with h5py.File(folder / "fragility.h5") as file:
            for edp in file["edp"].values():
                n = edp["axis/friction_mu_k/n"][()]
                self.assertTrue((edp["n"][()] >= 30).all() and (n[n < 30] * 200000 < 30 * samples).all())  # too rare to be wanted
                points += (len(edp["n"]) + (n >= 30).sum()) * edp["surface/probability"].shape[1]
            surface = file["edp/delta/surface"]
            half_width = (surface["upper"][()] - surface["lower"][()]).max() / 2
            axis = file["edp/delta/axis/friction_mu_k"]
            cells = ((axis["upper"][()] - axis["lower"][()]) / 2)[axis["n"][()] >= 30]
        self.assertLessEqual(of_points(points) * cells.max(), 0.15)  # of the second axis too
        self.assertGreater(cells.max(), 1.1 * half_width)
        self.assertIn("samples are needed", done.stderr)
        self.assertRegex(done.stderr, rf"the surface is known to \+-0\.\d+ at all {points} points at once \(wanted \+-0\.150\)\n")
        until = json.loads((folder / "summary.json").read_text())["until"]
        self.assertEqual(until["points"], points)
        self.assertAlmostEqual(until["half_width_reached"], of_points(points) * cells.max(), 12)
        self.assertIn("friction_mu_k", until["farthest"])
        self.assertEqual(until["farthest"]["half_width"], until["half_width_reached"])
        self.assertLessEqual(until["samples_needed"], samples)
        one = self.folder / "one"
        self.succeed(["run", self.write("u.yaml", TEXT), "-o", one, "--quiet"])
        self.assertEqual(datasets(one / "samples.h5"), datasets(folder / "samples.h5"))

    def test_what_is_promised_holds_the_closed_form(self):
        """Lognormals of these bins are off by up to 0.03, which their bands do not know."""
        edges = [0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.1, 1.5]
        out, random, samples = self.folder / "out", numpy.random.default_rng(5), 1000000
        self.succeed(["run", self.write("s.yaml", sliding("{log_uniform: [0.1, 1.5]}", f"{{edges: {edges}}}")), "-o", out, "--quiet"], 2)
        self.assertTrue(json.loads((out / "summary.json").read_text())["until"]["reached"])
        with open(out / "surface.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 40)
        slipped = {}
        for row in rows:
            im, capacity = float(row["im"]), float(row["capacity"])
            if im not in slipped:
                bin_of = max(i for i, edge in enumerate(edges) if edge <= im)
                in_bin = numpy.exp(random.uniform(numpy.log(edges[bin_of]), numpy.log(edges[bin_of + 1]), samples))
                # Counts are of the whole bin, a fit of its mean intensity.
                slipped[im] = [slips(random, a) for a in (in_bin, numpy.full(samples, im))]
            off = [abs(float(row["probability"]) - (all_slips > capacity).mean()) for all_slips in slipped[im]]
            self.assertLess(min(off), 0.01, row)
        self.assertEqual(len(slipped), 8)

    def test_bins_that_stay_empty_are_not_waited_for(self):
        for name, everywhere in (("some", "false"), ("all", "true")):
            text = sliding("{choice: [0.2, 0.4, 0.8]}", "{count: 12, spacing: equal_width}").replace("half_width: 0.01", f"half_width: 0.04, everywhere: {everywhere}")
            out = self.folder / name
            done = self.succeed(["run", self.write("e.yaml", text), "-o", out])
            summary = json.loads((out / "summary.json").read_text())
            self.assertTrue(summary["until"]["reached"])
            self.assertLess(summary["until"]["drawn"], 40000)  # exp(-30 n/300000) is below 0.05 from n = 29957 on
            self.assertEqual(len(summary["until"]["empty_bins"]), 9)
            told = f"none of the {summary['until']['drawn']} samples drawn lies in the bins of intensity about 0.275, 0.325, "
            self.assertIn(told, done.stderr)
            self.assertTrue(any(told in warning for warning in summary["warnings"]))

    def test_what_was_not_reached_is_told(self):
        text = TEXT.replace("half_width: 0.15, at_most: 200000", "half_width: 0.001, at_most: 1024")
        out = self.folder / "out"
        self.study = self.write("u.yaml", text)
        done = self.succeed(["run", self.study, "-o", out])
        self.assertEqual(done.stderr.count("was to be known"), 1)
        self.assertIn("was to be known to +-0.001", done.stderr)
        summary = json.loads((out / "summary.json").read_text())
        until = summary["until"]
        self.assertEqual((until["half_width_wanted"], until["samples"], until["at_most"], until["reached"]),
                         (0.001, 1024, 1024, False))
        with h5py.File(out / "fragility.h5") as file:
            surface = file["edp/delta/surface"]
            half_width = (surface["upper"][()] - surface["lower"][()]).max() / 2
        self.assertGreaterEqual(until["half_width_reached"], of_points(until["points"]) * half_width)
        self.assertTrue(any("was to be known" in warning for warning in summary["warnings"]))
        self.assertGreater(until["samples_needed"], 1e5)
        self.assertIn("samples are needed: raise at_most from 1024", done.stderr)
        alone = self.succeed(["sweep", self.study, "-o", self.folder / "alone", "--quiet"])  # no fit will tell
        self.assertIn(f"was to be known to +-0.001 at all {until['points']} points at once, and after 1024 samples", alone.stderr)
        self.assertEqual(alone.stderr.count("\n"), 1)
        few = TEXT.replace("half_width: 0.15, at_most: 200000", "half_width: 0.05, at_most: 20") + "keep: none\n"
        told = self.succeed(["run", self.write("few.yaml", few), "-o", self.folder / "few"]).stderr
        self.assertRegex(told, r"more than \S+ samples are needed: raise at_most from 20 and sweep anew .*some points have no band yet")
        last = TEXT.replace("half_width: 0.15, at_most: 200000", "half_width: 0.49, at_most: 1024")
        self.assertIn("1024 samples: the surface is known to", self.succeed(["run", self.write("last.yaml", last), "-o", self.folder / "last"]).stderr)
        plain = self.succeed(["run", self.write("plain.yaml", study_text(samples=300)), "-o", self.folder / "plain"])
        self.assertNotIn("the surface is known to", plain.stderr)
        reached = TEXT.replace("half_width: 0.15", "half_width: 0.49")
        self.succeed(["run", self.write("v.yaml", reached), "-o", self.folder / "v"])
        self.assertTrue(json.loads((self.folder / "v" / "summary.json").read_text())["until"]["reached"])

    def test_records_that_are_too_few_are_told(self):
        write_records(self.folder / "records")
        text = TEXT.replace("until: {half_width: 0.15, at_most: 200000}", "until: {half_width: 0.05, at_most: 4096}")
        text = text.replace("  - {pulse: [A, B, C1], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {uniform: [0.1, 2]}}",
                            '  - {records: "records/*.csv", scale_to: {pta_g: {uniform: [0.1, 1]}}}').replace(", axes: [friction.mu_k]", "")
        done = self.succeed(["run", self.write("r.yaml", text), "-o", self.folder / "out"])
        self.assertIn("however many samples are made of these records: take more records", done.stderr)
        until = json.loads((self.folder / "out" / "summary.json").read_text())["until"]
        self.assertIsNone(until["samples_needed"])
        self.assertGreater(until["stays_above"], 0.05)


if __name__ == "__main__":
    unittest.main()
