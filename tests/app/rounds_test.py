"""Rounds of `until` take samples of the bins that want them, and nothing else about these samples is another."""

import csv
import json
import os
import signal
import subprocess
import time
import unittest
from statistics import NormalDist

import numpy

from kill_and_resume_test import ranks_of
from support import InFolder, command, datasets, folder_of_class, h5py, run, study_text

PASSED_OVER, ROUNDS = 6, (0, 4096, 8192, 16384, 32768, 65536, 131072)
TEXT = study_text(block_size=256).replace(", axes: [friction.mu_k]", ", minimum_samples: 30")
# The counted shares of overturning alone, whose bands fall as 1/sqrt(n): 0.02 is reached in all five bins at once at 4150 samples where P is 1/2, at
# 1500 where it is 0.1.
UNTIL = TEXT.replace("edp: [delta, overturned]", "edp: [overturned]").replace("samples: 3000", "until: {half_width: 0.02, at_most: 300000}")


def columns(folder):
    with h5py.File(folder / "samples.h5") as file:
        return {name: file["samples"][name][()] for name in file["samples"]}


def lines(file):
    """Of one that comes, and goes when the run ends."""
    try:
        return file.read_text().count("\n")
    except FileNotFoundError:
        return 0


def bins_of(folder, rows):
    """The bin of each sample by the edges of the fit, the outer ones open; the intensity is PTA/(mu g) - 1."""
    with h5py.File(folder / "fragility.h5") as file:
        edges = file["im/edge"][()]
    return numpy.clip(numpy.searchsorted(edges, rows["pta_g"] / rows["friction_mu_k"] - 1, side="right") - 1, 0, len(edges) - 2)


class Rounds(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.shared = folder_of_class(cls)
        cls.study, cls.out, cls.every = cls.shared / "study.yaml", cls.shared / "out", cls.shared / "every"
        cls.study.write_text(UNTIL)
        cls.done = run(["run", cls.study, "-o", cls.out], 2)
        cls.done.check_returncode()
        everywhere = cls.shared / "everywhere.yaml"
        everywhere.write_text(UNTIL.replace("at_most: 300000", "at_most: 300000, everywhere: true"))
        run(["run", everywhere, "-o", cls.every, "--quiet"], 2).check_returncode()
        cls.rows, cls.all = columns(cls.out), columns(cls.every)
        cls.until = json.loads((cls.out / "summary.json").read_text())["until"]

    def test_it_depends_on_the_bin_alone_whether_a_sample_is_taken(self):
        passed, bins = self.rows["outcome"] == PASSED_OVER, bins_of(self.out, self.rows)
        ends = [end for end in ROUNDS if end <= len(passed)]
        self.assertEqual(ends[-1], len(passed))
        self.assertGreater(len(ends), 3)
        for first, end in zip(ends, ends[1:]):
            shares = [passed[first:end][bins[first:end] == number].mean() for number in range(5)]
            self.assertLessEqual(set(shares), {0.0, 1.0}, (first, shares))
        self.assertFalse(passed[:4096].any())
        self.assertTrue(passed[ends[-2]:].any() and not passed[ends[-2]:].all())

    def test_samples_that_are_taken_are_those_of_the_study(self):
        taken, both = self.rows["outcome"] != PASSED_OVER, min(len(self.rows["outcome"]), len(self.all["outcome"]))
        for name, values in self.rows.items():
            integrated = name.startswith("edp_") or name in ("outcome", "events")
            which = taken[:both] if integrated else slice(None)
            self.assertEqual(values[:both][which].tobytes(), self.all[name][:both][which].tobytes(), name)
            if name.startswith("edp_"):
                self.assertTrue(numpy.isnan(values[~taken]).all(), name)

    def test_curves_are_those_of_the_samples_of_each_bin(self):
        """Counted here, from the rows; and every band is as wanted, for two thirds of the samples: two of the five bins stop one doubling earlier."""
        taken, bins = self.rows["outcome"] != PASSED_OVER, bins_of(self.out, self.rows)
        at_once = NormalDist().inv_cdf(1 - 0.025 / 5) / NormalDist().inv_cdf(0.975)
        with open(self.out / "surface.csv", newline="") as file:
            surface = list(csv.DictReader(file))
        for number, row in enumerate(surface):
            share = (self.rows["outcome"][taken & (bins == number)] == 2).mean()
            self.assertAlmostEqual(float(row["empirical"]), share, 12)
            self.assertLessEqual(at_once * (float(row["upper"]) - float(row["lower"])) / 2, 0.02)
        self.assertEqual((len(surface), self.until["points"]), (5, 5))
        everything = json.loads((self.every / "summary.json").read_text())["until"]
        self.assertTrue(self.until["reached"] and everything["reached"])
        self.assertEqual((self.until["samples"], self.until["drawn"]), (taken.sum(), len(taken)))
        self.assertEqual(everything["samples"], everything["drawn"])
        self.assertLess(self.until["samples"], 2 / 3 * everything["samples"])

    def test_what_is_asked_of_all_intensities_comes_from_the_first_ones(self):
        alike = self.until["alike"]
        self.assertEqual(alike, numpy.flatnonzero(self.rows["outcome"] == PASSED_OVER)[0] // 4096 * 4096)
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual(summary["ranking"]["samples"], alike)
        self.assertEqual(summary["accuracy"]["samples_checked"], 200)
        self.assertTrue(any("lean towards those bins" in warning for warning in summary["warnings"]))
        plain = self.shared / "plain.yaml"
        plain.write_text(TEXT.replace("edp: [delta, overturned]", "edp: [overturned]").replace("samples: 3000", f"samples: {alike}"))
        self.succeed(["run", plain, "-o", self.folder / "plain", "--quiet"], 2)
        self.assertEqual((self.folder / "plain" / "ranking.csv").read_bytes(), (self.out / "ranking.csv").read_bytes())
        for folder, name in ((self.out, "a"), (self.folder / "plain", "b")):
            done = self.succeed(["fit", folder, "--im", "pga_g", "-o", self.folder / name])
            self.assertEqual("were taken whatever their intensity" in done.stdout, name == "a")
        self.assertEqual((self.folder / "a" / "surface.csv").read_bytes(), (self.folder / "b" / "surface.csv").read_bytes())
        shares = [self.succeed(["sensitivity", folder]).stdout for folder in (self.out, self.folder / "plain")]
        self.assertIn(f"the first {alike} were taken whatever their intensity", shares[0])
        tables = [[line for line in text.splitlines() if "friction.mu_k" in line] for text in shares]
        self.assertEqual(len(tables[0]), 1)
        self.assertEqual(tables[0], tables[1])

    def test_more_capacities_of_the_same_intensity_come_from_all(self):
        done = self.succeed(["fit", self.out, "--edp", "delta", "--capacities", "delta=0.1,1", "-o", self.folder / "more"])
        self.assertIn(f"{self.until['samples']} samples fitted", done.stdout)

    def test_bins_that_join_those_of_the_sweep_come_from_the_first_samples(self):
        alike, shares = self.until["alike"], {}
        for folder in (self.out, self.every):
            for name, edges in (("joined", "0,1,3"), ("same", "")):
                out = self.folder / f"{folder.name}-{name}"
                done = self.succeed(["fit", folder, *(["--bins", edges] if edges else ["--edp", "overturned"]), "-o", out])
                self.assertEqual("were taken whatever their intensity" in done.stdout, (folder, name) == (self.out, "joined"))
                with h5py.File(out / "fragility.h5") as file:
                    surface = file["edp/overturned/surface"]
                    shares[folder.name, name] = surface["empirical"][()].ravel(), surface["lower"][()].ravel(), surface["upper"][()].ravel()
        for name in ("joined", "same"):
            share = shares["every", name][0]
            self.assertTrue((share >= shares["out", name][1]).all() and (share <= shares["out", name][2]).all(), (name, shares))
        self.assertEqual(int(self.succeed(["fit", self.out, "--bins", "0,1,3", "-o", self.folder / "n"]).stdout.split(" samples fitted")[0].split()[-1]), alike)

    def test_the_same_bits_of_any_ranks_and_keep(self):
        for ranks, keep in ((1, "all"), (3, "none")):
            study = self.write(f"{keep}.yaml", UNTIL + f"keep: {keep}\n")
            out = self.folder / keep
            self.succeed(["run", study, "-o", out, "--quiet"], ranks)
            if keep == "all":
                self.assertEqual(datasets(out / "samples.h5"), datasets(self.out / "samples.h5"))
            self.assertEqual(datasets(out / "fragility.h5"), datasets(self.out / "fragility.h5"))
            for name in ("bins.csv", "surface.csv", "ranking.csv"):
                self.assertEqual((out / name).read_bytes(), (self.out / name).read_bytes(), name)

    def test_killed_in_its_rounds_it_ends_where_it_would_have(self):
        ways = (("all", signal.SIGKILL), ("none", signal.SIGKILL), ("all", signal.SIGTERM))
        for keep, number in ways if "FREESTAND_LONG_TESTS" in os.environ else ways[:1]:
            study, out = self.write(f"{keep}.yaml", UNTIL + f"keep: {keep}\n"), self.folder / f"{keep}-{int(number)}"
            rounds = out / "blocks" / "run-0000.node-000000.rounds"
            stopped, wanted = 0, 3  # lines: fingerprint, two rounds
            for _ in range(2):
                launcher = subprocess.Popen(command(["run", study, "-o", out, "--quiet", *(["--resume"] if out.exists() else [])], 2),
                                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                while launcher.poll() is None and (not rounds.exists() or rounds.read_text().count("\n") <= wanted):
                    time.sleep(0.002)
                for rank in ranks_of(launcher.pid):
                    os.kill(rank, number)
                launcher.communicate(timeout=60)
                stopped += launcher.returncode != 0
                wanted += 1
            self.assertGreater(stopped, 0)
            self.succeed(["run", study, "-o", out, "--resume", "--quiet"], 3)
            self.assertEqual(datasets(out / "fragility.h5"), datasets(self.out / "fragility.h5"))
            self.assertFalse((out / "blocks").exists())

    def test_rounds_that_are_lost_are_decided_again_or_told(self):
        for keep, code in (("all", 0), ("none", 2)):
            study, out = self.write(f"{keep}.yaml", UNTIL + f"keep: {keep}\n"), self.folder / keep
            rounds = out / "blocks" / "run-0000.node-000000.rounds"
            launcher = subprocess.Popen(command(["run", study, "-o", out, "--quiet"], 2), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            while launcher.poll() is None and lines(rounds) < 6:
                time.sleep(0.002)
            for rank in ranks_of(launcher.pid):
                os.kill(rank, signal.SIGTERM)
            launcher.communicate(timeout=60)
            self.assertEqual(launcher.returncode, 75)
            rounds.write_text(rounds.read_text().replace("end", "en"))
            done = run(["run", study, "-o", out, "--resume", "--quiet"], 2)
            self.assertEqual(done.returncode, code, done.stderr)
            if code:
                self.assertIn("which samples its rounds have taken is not known any more", done.stderr)
            else:
                self.assertEqual(datasets(out / "samples.h5"), datasets(self.out / "samples.h5"))

    def test_another_wish_begins_its_own_rounds_from_the_first_samples(self):
        """0.04 is reached with fewer samples; the rows of the finished sweep that it does not share are not taken for its own."""
        out = self.folder / "out"
        loose = self.write("loose.yaml", UNTIL.replace("half_width: 0.02", "half_width: 0.04"))
        self.succeed(["run", loose, "-o", out, "--quiet"], 2)
        self.assertLess(json.loads((out / "summary.json").read_text())["until"]["drawn"], self.until["drawn"])
        self.succeed(["run", self.study, "-o", out, "--resume", "--quiet"], 2)
        self.assertEqual(datasets(out / "samples.h5"), datasets(self.out / "samples.h5"))

    def test_a_relative_error_is_reached_at_its_least_probability(self):
        wish = "until: {relative_error: 0.2, down_to: 0.01, at_most: 300000}"
        study = self.write("rare.yaml", UNTIL.replace("until: {half_width: 0.02, at_most: 300000}", wish))
        done = self.succeed(["run", study, "-o", self.folder / "rare"], 2)
        self.assertIn("a standard error of 20 % of P down to 0.01", done.stderr)
        self.assertNotIn("at once", done.stderr)
        with open(self.folder / "rare" / "surface.csv", newline="") as file:
            for row in csv.DictReader(file):
                half = (float(row["upper"]) - float(row["lower"])) / 2
                self.assertLessEqual(half, 1.959964 * 0.2 * max(0.01, float(row["probability"])), row)


if __name__ == "__main__":
    unittest.main()
