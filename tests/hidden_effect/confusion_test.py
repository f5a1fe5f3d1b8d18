#!/usr/bin/python3
"""What the confusion table counts as right, ambiguous and wrong."""

import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from confusion import judged, ladder  # noqa: E402

TWINS = ["floor_tilt", "directional_friction"]


def answer(effects, twins=(), in_catalogue=True):
    return {"effects": effects, "twins": list(twins), "in_catalogue": in_catalogue}


def diagnosis(verdict, effects, left_out=1.0):
    candidate = {"effect": "x", "visible": True, "error_left_out": left_out}
    return {"verdict": verdict, "effects": effects, "candidates": [candidate], "noise_floor": 1.0,
            "base": {"error_left_out": 9.0}}


class Judged(unittest.TestCase):
    def check(self, expected, truth, *told):
        self.assertEqual(judged(truth, diagnosis(*told)), expected, (truth, told))

    def test_one_effect(self):
        truth = answer(["a"])
        self.check("right", truth, "missing", ["a"])
        self.check("wrong", truth, "missing", ["b"])
        self.check("wrong", truth, "missing", ["a", "b"])
        self.check("ambiguous", truth, "ambiguous", ["b", "a"])
        self.check("wrong", truth, "ambiguous", ["b", "c"])
        self.check("none", truth, "none", [])
        self.check("unknown", truth, "unknown", [])

    def test_a_pair(self):
        truth = answer(["a", "b"])
        self.check("right", truth, "missing", ["b", "a"])
        self.check("wrong", truth, "missing", ["a"])

    def test_friction_that_differs_from_test_to_test_parts_twins(self):
        told = diagnosis("missing", ["floor_tilt"])
        for fault, expected in (("friction_scatter", "right"), ("drift", "wrong"), (None, "wrong")):
            self.assertEqual(judged(answer(["floor_tilt"], TWINS) | {"fault": fault}, told), expected, fault)
        other = answer(["directional_friction"], TWINS) | {"fault": "friction_scatter"}
        self.assertEqual(judged(other, told), "wrong")

    def test_twins_are_named_both(self):
        truth = answer(["floor_tilt"], TWINS)
        self.check("right", truth, "ambiguous", TWINS)
        self.check("wrong", truth, "missing", ["floor_tilt"])
        self.check("ambiguous", truth, "ambiguous", TWINS + ["a"])
        pair = answer(["a", "floor_tilt"], TWINS)
        self.check("right", pair, "ambiguous", ["a"] + TWINS)
        self.check("right", pair, "missing", ["a", "floor_tilt"])

    def test_nothing_hidden(self):
        self.check("right", answer([]), "none", [])
        self.check("wrong", answer([]), "missing", ["a"])
        self.check("wrong", answer([]), "ambiguous", ["a", "b"])
        self.check("wrong", answer([]), "bad_data", [])

    def test_outside_the_catalogue(self):
        truth = answer(["rough_floor"], (), False)
        self.check("right", truth, "unknown", [])
        self.check("wrong", truth, "missing", ["a"], 2.0)
        self.check("wrong", truth, "ambiguous", ["a", "b"], 2.0)
        self.check("none", truth, "none", [])


class Ladder(unittest.TestCase):
    def test_is_read_from_a_study(self):
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder) / "study.yaml"
            study.write_text("model:\n  effects:\n    - {name: a, ratio: 1}\nladder:\n"
                             "  - {step: base, error_calibration: 27.4, error_holdout: 26, noise_floor: 1.0}\n"
                             "  - {step: a, error_calibration: 1.01, error_holdout: 1.02, noise_floor: 1.05}\n")
            steps = ladder(study)
        self.assertEqual(json.dumps(steps[-1]),
                         '{"error_calibration": 1.01, "error_holdout": 1.02, "noise_floor": 1.05}')
        self.assertEqual(len(steps), 2)


if __name__ == "__main__":
    unittest.main()
