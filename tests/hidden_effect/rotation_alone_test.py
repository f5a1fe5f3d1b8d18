#!/usr/bin/python3
"""Rotation alone, as where a gyroscope stands on the specimen and nothing measures its slip: a rocking block, made with impacts
that lose more than the plain model's, through compare, diagnose and the page."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

FREESTAND, MAKE_SETS = os.environ["FREESTAND"], os.environ["MAKE_SETS"]
REPORT = pathlib.Path(__file__).resolve().parents[2] / "postprocess" / "report"
STUDY = "measurements: impact_loss-41/dataset.yaml\nmodel: {friction: {mu: {calibrate: [0.03, 1.2]}}}\n"


def without_slip(folder):
    """A set whose slip was never measured."""
    for file in folder.glob("t*.csv"):
        rows = [line.split(",") for line in file.read_text(encoding="utf-8").splitlines()]
        place = rows[0].index("slip_m")
        file.write_text("\n".join(",".join(cell for i, cell in enumerate(row) if i != place) for row in rows) + "\n", encoding="utf-8")
    data = folder / "dataset.yaml"
    data.write_text(re.sub(r"(?m)^  slip_m: .*\n", "", data.read_text(encoding="utf-8")), encoding="utf-8")


class RotationAlone(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="freestand_rotation_")
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def succeed(self, *words):
        done = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def read(self, *path):
        return json.loads(self.folder.joinpath(*path).read_text(encoding="utf-8"))

    def test_a_rocking_block(self):
        self.succeed(MAKE_SETS, "-o", ".", "--effects", "impact_loss", "--first", 41, "--seeds", 1, "--tests", 5, "--duration", 5)
        without_slip(self.folder / "impact_loss-41")
        (self.folder / "study.yaml").write_text(STUDY, encoding="utf-8")
        told = self.succeed(FREESTAND, "compare", "study.yaml", "-o", "before")
        self.assertIn("slip was not measured", told)
        self.assertNotIn("slip by", told)
        before = self.read("before", "comparison.json")
        self.assertEqual({channel["name"] for test in before["tests"] for channel in test["channels"]}, {"rotation_rad"})
        self.assertEqual([table["variable"] for table in before["error_tables"]["calibration"]], ["phase", "normal_g", "time_s", "floor_g"])
        self.succeed(FREESTAND, "diagnose", "study.yaml", "-o", "diagnosis", "--quiet")
        diagnosis = self.read("diagnosis", "diagnosis.json")
        self.assertEqual((diagnosis["verdict"], diagnosis["effects"]), ("missing", ["impact_loss"]))
        self.assertEqual((diagnosis["recovered_force"]["samples"], diagnosis["recovered_force"]["tables"]), (0, []))
        self.assertTrue(any("none can be recovered" in sentence for sentence in diagnosis["findings"]))
        self.succeed(REPORT, "before", "diagnosis", "-o", "page.html")
        self.assertIn("slip was not measured", (self.folder / "page.html").read_text(encoding="utf-8").lower())


if __name__ == "__main__":
    unittest.main()
