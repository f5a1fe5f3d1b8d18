"""`fit` by itself: by the fragility block of the study.yaml beside the samples, and by nothing else that was edited there."""

import csv
import json
import os
import pty
import shutil
import subprocess
import unittest

from support import InFolder, command, folder_of_class, h5py, run, slow_fit, study_text


class Fit(InFolder):
    @classmethod
    def setUpClass(cls):
        folder = folder_of_class(cls)
        cls.kept, study = folder / "out", folder / "study.yaml"
        study.write_text(study_text(samples=2000))
        cls.done = run(["run", study, "-o", cls.kept], 2)
        cls.done.check_returncode()

    def sweep(self):
        self.out = self.folder / "out"
        shutil.copytree(self.kept, self.out)

    def edit(self, old, new):
        path = self.out / "study.yaml"
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))

    def test_on_a_terminal_it_tells_how_far_it_is_and_at_the_end_how_long_it_took(self):
        out = self.folder / "out"
        self.succeed(["sweep", self.write("slow.yaml", slow_fit(study_text(samples=9000)).replace("15000", "5000")), "-o", out, "--quiet"], 2)
        ours, its = pty.openpty()
        process = subprocess.Popen(command(["fit", out]), stdout=subprocess.PIPE, stderr=its, text=True)
        os.close(its)
        told = b""
        while True:
            try:
                told += os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
        said, _ = process.communicate(timeout=100)
        os.close(ours)
        self.assertRegex(told.decode(), r"fit\w*: \d+/\d+, \S+ s so far")
        self.assertRegex(said, r"9000 samples fitted over \w+ in \d")

    def test_an_edited_study_is_used_or_refused_and_it_says_so(self):
        self.sweep()
        self.assertIn("by the study as it was swept", self.succeed(["fit", self.out]).stdout)
        before = (self.out / "bins.csv").read_text()
        self.edit("confidence: 0.95", "confidence: 0.8")
        self.edit("bins: {count: 5, spacing: equal_count}\n  edp", "bins: {edges: [0, 1, 3]}\n  edp")
        done = self.succeed(["fit", self.out], 2)
        self.assertIn("by fragility.bins, fragility.confidence of", done.stdout)
        with h5py.File(self.out / "fragility.h5") as file:
            self.assertEqual(file.attrs["confidence"], 0.8)
            self.assertEqual(list(file["im/edge"][()]), [0, 1, 3])
            self.assertIn("confidence: 0.8", file.attrs["study"])
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual(summary["study_changed"], ["fragility.bins", "fragility.confidence"])
        kept = (self.out / "fragility.h5").read_bytes()
        self.edit("dispersion: 0.4", "dispersion: 0.5")
        self.fail_with(2, ["fit", self.out], "study.yaml:", "friction.mu_k", "is 0.5", "made with 0.4", ranks=2)
        self.assertEqual((self.out / "fragility.h5").read_bytes(), kept)
        self.edit("dispersion: 0.5", "dispersion: 0.4")
        self.edit("resamples: 50", "resamples: 1")
        self.fail_with(2, ["fit", self.out], "study.yaml:", "fragility.resamples is 1")
        (self.out / "study.yaml").unlink()
        self.succeed(["fit", self.out])
        self.assertEqual((self.out / "bins.csv").read_text(), before)

    def test_a_bin_stands_at_the_mean_of_its_samples_everywhere(self):
        self.sweep()
        with h5py.File(self.out / "samples.h5") as file:
            im, usable = file["samples/pta_g"][()] / file["samples/friction_mu_k"][()] - 1, file["samples/outcome"][()] <= 2
        with h5py.File(self.out / "fragility.h5") as file:
            edge, centre = file["im/edge"][()], file["im/centre"][()]
            self.assertEqual(list(file["edp/delta/im"][()]), list(centre))
        for i, (low, high) in enumerate(zip(edge[:-1], edge[1:])):
            inside = usable & (im >= low) & ((im < high) | ((i == len(centre) - 1) & (im == high)))
            self.assertAlmostEqual(centre[i] / im[inside].mean(), 1, delta=1e-9)
        for name in ("bins.csv", "surface.csv"):
            with open(self.out / name, newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(sorted({(float(r["im"]), float(r["im_lower"]), float(r["im_upper"])) for r in rows}),
                             sorted(zip(centre, edge[:-1], edge[1:])))

    def test_what_the_command_line_asks_for_is_told_as_such(self):
        self.sweep()
        said = self.succeed(["fit", self.out, "--im", "pga_g", "--confidence", "0.8"]).stdout
        self.assertIn("by fragility.confidence, fragility.im as the command line says; results in", said)
        self.assertIn("in place of the fit that was there", said)
        self.assertNotIn("edited", said)
        with h5py.File(self.out / "fragility.h5") as file:
            self.assertEqual(file.attrs["confidence"], 0.8)
        self.fail_with(2, ["fit", self.out, "--confidence", "95"], "fragility.confidence is 95")
        self.assertNotIn("in place", self.succeed(["fit", self.out, "-o", self.folder / "other"]).stdout)

    def test_how_often_something_happened_stands_in_its_own_column(self):
        self.sweep()
        with open(self.out / "bins.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        over = [row for row in rows if row["edp"] == "overturned"]
        self.assertEqual([row["n_happened"] for row in over], [row["n_over"] for row in over])
        self.assertGreater(sum(int(row["n_happened"]) for row in over), 0)
        self.assertEqual({row["n_happened"] for row in rows if row["edp"] == "delta"}, {""})

    def test_run_tells_what_its_fit_warns_of(self):
        failing = self.write("study.yaml", study_text(samples=300) + 'effects: [{name: dead, force: "sqrt(3 - t - 10*speed)"}]\n')
        told = self.succeed(["run", failing, "-o", self.folder / "out"]).stdout
        warning = next(line for line in told.splitlines() if line.startswith("warning: "))
        self.assertRegex(warning, r"of 300 samples ended as not_finite")
        warnings = json.loads((self.folder / "out/summary.json").read_text())["warnings"]
        self.assertEqual([line[9:] for line in told.splitlines() if line.startswith("warning: ")], warnings[:4])
        self.assertEqual(f"({len(warnings) - 4} more warnings in " in told, len(warnings) > 4)
        # What concerns the demand that the study names first comes before what concerns others.
        of = [warning.split(":")[0] for warning in warnings if warning.startswith(("delta: ", "overturned: "))]
        self.assertEqual(of, sorted(of))
        self.assertIn(warning, self.succeed(["fit", self.folder / "out"]).stdout)

    def test_times_are_told_by_phase_and_in_total(self):
        self.sweep()
        self.assertRegex(self.done.stdout, r"2000 samples in .* on 2 ranks: motions and spectra .*, sweep .* \(\d+ samples/s\), accuracy check .*, "
                                           r"writing .*, fit .*; results in")
        timing = json.loads((self.out / "summary.json").read_text())["timing"]
        phases = [timing[key] for key in ("sweep_s", "accuracy_s", "write_s", "fit_s")]
        self.assertTrue(all(seconds > 0 for seconds in phases), timing)
        self.assertLessEqual(sum(phases), timing["wall_s"] + 1e-9)
        self.assertAlmostEqual(timing["samples_per_s"], timing["samples_computed"] / timing["sweep_s"], delta=1e-6 * timing["samples_per_s"])
        self.succeed(["fit", self.out])
        timing = json.loads((self.out / "summary.json").read_text())["timing"]
        self.assertEqual(timing["wall_s"], timing["fit_s"])


if __name__ == "__main__":
    unittest.main()
