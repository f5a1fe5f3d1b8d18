"""Motions that are made: `motion --synthetic`, and a sweep over them on any number of ranks."""

import csv
import unittest

from support import InFolder, h5py, study_text

SET = """count: 6
arias_mps: {lognormal: {median: 0.5, dispersion: 0.4}}
duration_s: {uniform: [3, 5]}
middle_s: {uniform: [3, 4]}
frequency_hz: {uniform: [2, 4]}
bandwidth: 0.3
corner_hz: 0.3
step_s: 0.02
pulse: {type: [B, C1], period_s: 1.5, peak_velocity_mps: 0.3, middle_s: 4}
"""
PULSES = "- {pulse: [A, B, C1], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {uniform: [0.1, 2]}}"
MADE = "- {synthetic: near.yaml, scale_to: {pga_g: {uniform: [0.1, 1]}}}"


class Synthetic(InFolder):
    def setUp(self):
        super().setUp()
        self.set = self.write("near.yaml", SET)

    def test_a_sweep_has_the_same_bits_on_any_number_of_ranks_and_from_its_own_study(self):
        one, three, again = (self.folder / name for name in ("one", "three", "again"))
        study = self.write("study.yaml", study_text(samples=400).replace(PULSES, MADE))
        self.succeed(["run", study, "-o", one, "--quiet"])
        self.succeed(["run", study, "-o", three, "--quiet"], 3)
        self.set.unlink()
        self.succeed(["run", one / "study.yaml", "-o", again, "--quiet"])  # the set stands in it
        with h5py.File(one / "samples.h5") as a, h5py.File(three / "samples.h5") as b, h5py.File(again / "samples.h5") as c:
            for name in a["samples"]:
                for other in (b, c):
                    self.assertEqual(a["samples"][name][()].tobytes(), other["samples"][name][()].tobytes(), name)
        self.assertEqual((one / "bins.csv").read_bytes(), (three / "bins.csv").read_bytes())
        with open(one / "ranking.csv", newline="") as ranking:
            self.assertIn(",record_significant_5_95_expected_s,6,", ranking.read())
        self.succeed(["fit", one, "--im", "record.frequency_hz", "-o", self.folder / "fit"])

    def test_motion_replaces_only_what_it_wrote(self):
        record, notes = self.folder / "x.csv", self.folder / "notes.txt"
        self.succeed(["motion", "--synthetic", self.set, "--number", 1, "--convert", record])
        before = record.read_bytes()
        notes.write_text("of the laboratory\n")
        self.fail_with(2, ["motion", record, "--convert", record, "--overwrite"], "is what is read")
        self.fail_with(2, ["motion", record, "--csv", notes, "--overwrite"], "is not what this command writes")
        self.assertEqual((record.read_bytes(), notes.read_text()), (before, "of the laboratory\n"))
        for _ in range(2):
            self.succeed(["motion", record, "--csv", self.folder / "table.csv", "--convert", self.folder / "y.csv", "--overwrite"])

    def test_motion_writes_what_a_study_reads(self):
        folder, table = self.folder / "made", self.folder / "made.csv"
        told = self.succeed(["motion", "--synthetic", self.set, "--seed", 7, "--convert", folder, "--csv", table]).stdout
        self.assertIn("near 5", told)
        with open(table, newline="") as rows:
            self.assertEqual([row["file"] for row in csv.DictReader(rows)], [f"made/near {n}.csv" for n in range(6)])
        alone = self.folder / "alone.csv"
        self.succeed(["motion", "--synthetic", self.set, "--seed", 7, "--number", 4, "--convert", alone])
        self.assertEqual(alone.read_bytes(), (folder / "near 4.csv").read_bytes())
        self.succeed(["motion", "--synthetic", self.set, "--seed", 8, "--number", 4, "--convert", alone, "--overwrite"])
        self.assertNotEqual(alone.read_bytes(), (folder / "near 4.csv").read_bytes())
        made, read = self.folder / "by_set", self.folder / "by_files"
        self.succeed(["run", self.write("a.yaml", study_text(samples=300).replace(PULSES, MADE)), "-o", made, "--quiet"])
        files = MADE.replace("synthetic: near.yaml", "records: made.csv")
        self.succeed(["run", self.write("b.yaml", study_text(samples=300).replace(PULSES, files)), "-o", read, "--quiet"])
        with h5py.File(made / "samples.h5") as a, h5py.File(read / "samples.h5") as b:  # files hold the very numbers
            self.assertEqual(a["samples/edp_peak_slip_m"][()].tobytes(), b["samples/edp_peak_slip_m"][()].tobytes())

    def test_motion_refuses(self):
        made = ["motion", "--synthetic", self.set]
        self.fail_with(2, made + ["--number", 6], "it has 6 motions, the first is 0")
        self.fail_with(2, made + ["--csv", self.folder / "x.csv"], "add --convert FOLDER")
        self.fail_with(2, made + [self.set], "takes no records")
        self.fail_with(2, made + ["--convert", self.folder], "go to a new folder")
        self.fail_with(2, ["motion"], "names no record")
        long = self.write("long.yaml", SET.replace("duration_s: {uniform: [3, 5]}", "duration_s: 40"))
        self.fail_with(2, ["motion", "--synthetic", long], "long.yaml: long 0 is a shaking of 40 s", "with 6 of 6")


if __name__ == "__main__":
    unittest.main()
