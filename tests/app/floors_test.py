"""Records of the ground, equipment upstairs: `motion --floor`, a sweep in a building, and what goes by the ground or by the floor."""

import csv
import json
import re
import unittest

from support import InFolder, h5py, study_text, write_records

MUSEUM = "storeys: 4\nperiod_s: 0.5\ndamping: 0.03\n"
STUDY = study_text(samples=1500).replace("- {pulse: [A, B, C1], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {uniform: [0.1, 2]}}",
                                         "- {records: records/*.csv, scale_to: {pga_g: {uniform: [0.1, 1]}}, building: museum.yaml, storey: {choice: [1, 3]}}")
STUDY = STUDY.replace("im: report", "im: ground.pga_g").replace("axes: [friction.mu_k]", "axes: [{name: motion.storey, bins: {edges: [0, 2, 4]}}]")


class Floors(InFolder):
    def setUp(self):
        super().setUp()
        write_records(self.folder / "records")
        self.museum = self.write("museum.yaml", MUSEUM)
        self.record = self.folder / "records/c.csv"

    def peaks(self, text):
        """PGA, PGV of the record, as `motion` prints them."""
        found = re.search(r"PGA ([\d.]+) g +PGV ([\d.]+) m/s", text)
        return float(found[1]), float(found[2])

    def test_motion_tells_and_writes_floors(self):
        told = self.succeed(["motion", self.record, "--floor", self.museum]).stdout
        rows = {int(words[0]): words for words in (line.split() for line in told.splitlines()) if len(words) == 11}
        self.assertEqual(sorted(rows), [0, 1, 2, 3, 4])
        self.assertEqual(rows[0][2], "1.000")
        self.assertRegex(told, r"1 +0\.5000 +0\.0300 +0\.8\d+")  # first mode, its share of the mass
        for storey in (0, 3):
            out = self.folder / f"floor{storey}.csv"
            self.succeed(["motion", self.record, "--floor", self.museum, "--storey", storey, "--convert", out])
            pga, pgv = self.peaks(self.succeed(["motion", out]).stdout)
            self.assertAlmostEqual(pga, float(rows[storey][1]), delta=1.1e-4)
            self.assertAlmostEqual(pgv, float(rows[storey][3]), delta=1.1e-4)
        with open(self.folder / "floor0.csv", newline="") as floor, open(self.record, newline="") as record:
            for a, b in zip(csv.DictReader(floor), csv.DictReader(record)):
                self.assertAlmostEqual(float(a["floor_acceleration_mps2"]), float(b["floor_acceleration_mps2"]), delta=1e-12)

    def test_motion_refuses(self):
        floor = ["motion", self.record, "--floor", self.museum]
        self.fail_with(2, floor + ["--convert", self.folder / "x.csv"], "add --storey 4")
        self.fail_with(2, floor + ["--storey", 5, "--convert", self.folder / "x.csv"], "it has 4 floors above the ground")
        self.fail_with(2, floor + ["--storey", 3], "says which floor --convert writes")
        self.fail_with(2, ["motion", self.record, "--storey", 1], "add --floor building.yaml")
        self.fail_with(2, ["motion", self.record, "--floor", self.write("bad.yaml", "storeys: 4\nperiod: 0.5\n")], "bad.yaml:2:", "write period_s")
        self.fail_with(3, ["motion", self.record, "--floor", self.write("stiff.yaml", "storeys: 1\nperiod_s: 0.01\n")], "no mode of the building lies in the record's band")
        self.assertFalse((self.folder / "x.csv").exists())

    def test_a_sweep_upstairs_goes_by_the_ground(self):
        out, again = self.folder / "out", self.folder / "again"
        self.succeed(["run", self.write("study.yaml", STUDY), "-o", out, "--quiet"], 3)
        self.museum.unlink()
        self.succeed(["run", out / "study.yaml", "-o", again, "--quiet"])  # the building stands in it
        with h5py.File(out / "samples.h5") as one, h5py.File(again / "samples.h5") as two:
            for name in one["samples"]:
                self.assertEqual(one["samples"][name][()].tobytes(), two["samples"][name][()].tobytes(), name)
            motion, storey = one["samples/motion"][()], one["samples/storey"][()]
            self.assertEqual(set(storey), {1, 3})
            self.assertTrue((one["motions/storey"][()][motion] == storey).all())
            ground = one["motions/ground"][()][motion]
            scaled = one["motions/pga_mps2"][()][ground] * abs(one["samples/scale"][()]) / 9.80665
            self.assertTrue((scaled > 0.0999).all() and (scaled < 1.0001).all())
        with h5py.File(out / "fragility.h5") as file:
            self.assertEqual((file.attrs["im"], file.attrs["im_unit"]), ("ground.pga_g", "g"))
        summary = json.loads((out / "summary.json").read_text())
        ranked = [entry["im"] for entry in summary["ranking"]["demands"]["delta"]]
        self.assertIn("ground.sa_g:0.5", ranked)
        self.assertIn("pga_g", ranked)
        # The floor's own intensity is no ground's.
        floor = self.folder / "floor"
        self.succeed(["fit", out, "--im", "pga_g", "-o", floor, "--quiet"])
        export = ["--format", "openquake", "--limit-state", "delta:1", "--skip-empty", "--form", "counted"]
        self.succeed(["export", out, *export, "-o", self.folder / "ground.xml"])
        self.assertIn('imt="PGA"', (self.folder / "ground.xml").read_text())
        self.fail_with(2, ["export", floor, *export, "-o", self.folder / "no.xml"], "fit the sweep over ground.pga_g")
        self.fail_with(2, ["export", out, "--format", "pelicun", "-o", self.folder / "no"], "those of the floor on which a component stands")
        hazard = self.write("hazard.csv", "pga_g,annual_rate\n0.05,0.01\n0.3,0.002\n1,0.0001\n")
        self.succeed(["risk", out, "--hazard", hazard, "-o", self.folder / "risk"])
        self.fail_with(2, ["risk", floor, "--hazard", hazard, "-o", self.folder / "no"], "--im ground.pga_g")
        self.succeed(["fit", out, "--im", "ground.sa_g:0.5", "-o", self.folder / "sa", "--quiet"])
        self.fail_with(2, ["risk", self.folder / "sa", "--hazard", hazard, "-o", self.folder / "no"], "--im ground.pga_g")
        self.succeed(["export", self.folder / "sa", *export, "-o", self.folder / "sa.xml"])
        self.assertIn('imt="SA(0.5)"', (self.folder / "sa.xml").read_text())
        self.succeed(["sensitivity", out, "-o", self.folder / "shares"])
        shares = (self.folder / "shares/sensitivity.csv").read_text()
        self.assertIn("motion.storey", shares)
        self.assertRegex(shares, r"(?m)(^|,)motion,")  # the record, whatever the storey

    def test_what_is_drawn_of_a_building_stands_in_every_file(self):
        """Period and damping, one of each for a record; they are properties of it, on which what an intensity leaves may depend."""
        drawn = "building: {storeys: 4, period_s: {uniform: [0.3, 0.8]}, damping: {uniform: [0.02, 0.07]}}"
        out = self.folder / "out"
        self.succeed(["run", self.write("study.yaml", STUDY.replace("building: museum.yaml", drawn)), "-o", out, "--quiet"], 2)
        with h5py.File(out / "samples.h5") as file:
            of_ground = file["motions/ground"][()]
            for name, unit, low, high in (("period_s", "s", 0.3, 0.8), ("damping", "1", 0.02, 0.07)):
                numbers = file[f"motions/record_building_{name}"]
                self.assertEqual(numbers.attrs["unit"], unit)
                self.assertEqual(len(set(numbers[()])), 6)
                self.assertTrue((numbers[()] == numbers[()][of_ground]).all())
                self.assertTrue(low <= min(numbers[()]) and max(numbers[()]) <= high, name)
        ranking = json.loads((out / "summary.json").read_text())["ranking"]
        self.assertIn("record_building_damping", json.dumps(ranking))


if __name__ == "__main__":
    unittest.main()
