#!/usr/bin/python3
"""Result files: what is read, what is refused and how, and the demand model evaluated from them."""
import json
import pathlib
import tempfile
import unittest

import support
from support import make_results

import h5py
import numpy as np
from freestand_post import closing, model, reading, style, words
from freestand_post.problem import Problem


class Folder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = support.sweep_copy(pathlib.Path(kept.name) / "sweep")
        self.fragility = self.folder / "fragility.h5"

    def refused(self, *needles):
        with self.assertRaises(Problem) as caught:
            reading.read_sweep(self.folder)
        text = str(caught.exception)
        self.assertEqual(caught.exception.exit_code, 3)
        self.assertEqual(len(text.splitlines()), 1, text)
        for needle in needles:
            self.assertIn(needle, text)


class Reads(Folder):
    def test_whole_sweep(self):
        sweep = reading.read_sweep(self.folder)
        self.assertEqual([edp.name for edp in sweep.edps], ["delta", "peak_rotation_over_alpha", "connection_failed", "overturned"])
        self.assertEqual([edp.name for edp in sweep.continuous()], ["delta", "peak_rotation_over_alpha"])
        self.assertEqual(sweep.samples, 6000)
        self.assertEqual(sum(sweep.outcomes.values()), 6000)
        np.testing.assert_array_equal(sweep.edge, make_results.EDGES)
        self.assertEqual(sweep.motions, ["A", "B", "C1"])
        self.assertEqual(sweep.outcome.size, 6000)
        self.assertIn("friction_mu_k", sweep.draws)
        self.assertFalse([name for name in sweep.draws if name.startswith(("im_", "edp_"))])
        self.assertIn("seed: 1", sweep.attributes["study"])

    def test_without_samples_and_summary(self):
        (self.folder / "samples.h5").unlink()
        (self.folder / "summary.json").unlink()
        sweep = reading.read_sweep(self.folder)
        self.assertEqual((sweep.draws, sweep.outcome.size, sweep.summary), ({}, 0, {}))
        self.assertEqual(sweep.samples, 6000)

    def test_column_that_an_older_file_lacks_is_nan(self):
        with h5py.File(self.fragility, "a") as root:
            del root["edp/delta/ad_statistic"]
        self.assertTrue(np.isnan(reading.read_sweep(self.folder).edps[0].bins["ad_statistic"]).all())

    def test_without_overturning(self):
        with h5py.File(self.fragility, "a") as root:
            del root["overturning"]
        self.assertEqual(reading.read_sweep(self.folder).overturning, {})


class Refuses(Folder):
    def test_truncated_anywhere(self):
        whole = self.fragility.read_bytes()
        for share in (0.02, 0.3, 0.6, 0.95):
            self.fragility.write_bytes(whole[:int(share * len(whole))])
            self.refused("fragility.h5", "run the study again")

    def test_truncated_samples(self):
        path = self.folder / "samples.h5"
        path.write_bytes(path.read_bytes()[:100_000])
        self.refused("samples.h5")

    def test_damaged_in_the_middle(self):
        whole = bytearray(self.fragility.read_bytes())
        for start in range(2000, len(whole) - 3000, len(whole) // 12):
            damaged = bytearray(whole)
            damaged[start:start + 1500] = b"\xff" * 1500
            self.fragility.write_bytes(damaged)
            try:
                reading.read_sweep(self.folder)  # numbers may have changed unnoticed; what must not happen is a traceback
            except Problem as problem:
                self.assertEqual(len(str(problem).splitlines()), 1)

    def test_text_in_place_of_hdf5(self):
        self.fragility.write_text("not this\n")
        self.refused("fragility.h5 cannot be read as HDF5")

    def test_a_byte_that_has_changed(self):
        closing.close(self.fragility)
        whole = self.fragility.read_bytes()
        self.assertEqual(reading.read_sweep(self.folder).samples, 6000)
        for at in (0, len(whole) // 2, len(whole) - 69):
            self.fragility.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            self.refused("fragility.h5 was damaged")

    def test_other_format(self):
        with h5py.File(self.fragility, "a") as root:
            root.attrs["format"] = "freestand-fragility/9"
        self.refused('"freestand-fragility/9"', '"freestand-fragility/1"')

    def test_samples_under_the_name_of_the_fit(self):
        self.fragility.write_bytes((self.folder / "samples.h5").read_bytes())
        self.refused('"freestand-samples/2"')

    def test_missing_group_and_wrong_shape(self):
        with h5py.File(self.fragility, "a") as root:
            root.move("edp/delta/surface/probability", "edp/delta/surface/was")
        self.refused("/edp/delta/surface/probability")
        with h5py.File(self.fragility, "a") as root:
            root["edp/delta/surface/probability"] = np.zeros((2, 2))
        self.refused("shape (2, 2)", "(12, 4)")

    def test_edges_that_do_not_increase(self):
        with h5py.File(self.fragility, "a") as root:
            root["im/edge"][...] = 1.0
        self.refused("/im/edge")

    def test_broken_summary(self):
        (self.folder / "summary.json").write_text('{"a": ')
        self.refused("summary.json")
        (self.folder / "summary.json").write_text("[1]")
        self.refused("summary.json")

    def test_sweep_that_was_not_fitted(self):
        self.fragility.unlink()
        self.refused("freestand fit")

    def test_empty_folder_and_no_folder(self):
        with tempfile.TemporaryDirectory() as empty:
            self.folder = pathlib.Path(empty)
            self.refused("no fragility.h5")
        self.refused("is not a folder")


class Histories(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = make_results.make_history(pathlib.Path(kept.name) / "case")
        self.path = self.folder / "history.csv"

    def refused(self, *needles):
        with self.assertRaises(Problem) as caught:
            reading.read_history(self.folder)
        for needle in needles:
            self.assertIn(needle, str(caught.exception))

    def test_whole(self):
        history = reading.read_history(self.folder)
        self.assertEqual(len(history.mode), history.columns["time_s"].size)
        self.assertEqual(set(history.mode), {"rest", "slide", "rock", "slide_rock"})

    def test_truncated_line_is_named(self):
        lines = self.path.read_text().splitlines()
        self.path.write_text("\n".join(lines[:40]) + "\n0.2,1.5\n")
        self.refused("history.csv:41", "2 fields")

    def test_bad_number_missing_column_binary_and_empty(self):
        text = self.path.read_text()
        self.path.write_text(text.replace("\n0.005,", "\nabc,", 1))
        self.refused("time_s", "abc")
        self.path.write_text(text.replace("rotation_rad,", "turn,", 1))
        self.refused("lacks the columns")
        self.path.write_bytes(b"\xff\xfe\x00\x81" * 50)
        self.refused("not a text file")
        self.path.write_text("")
        self.refused("lacks the columns")


class Model(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sweep = reading.read_sweep(support.sweep())
        cls.edp = cls.sweep.edps[0]

    def test_agrees_with_the_surface_in_the_file(self):
        ours = model.exceedance(self.edp, self.edp.capacity)
        theirs, status = self.edp.surface["probability"], self.edp.bins["status"]
        self.assertEqual(set(status.astype(int)), {0, 1, 2, 3, 4})
        np.testing.assert_allclose(ours[status == 0], theirs[status == 0], rtol=0, atol=1e-12)
        cell = self.edp.cells.max(axis=1) / np.maximum(self.edp.bins["n"], 1)  # counted shares are known to one cell
        for i in np.flatnonzero(status >= 2):
            np.testing.assert_allclose(ours[i], theirs[i], rtol=0, atol=cell[i] + 1e-12)
        self.assertTrue(np.isnan(ours[status == 1]).all())

    def test_falls_from_one_to_overturning(self):
        p = model.exceedance(self.edp, np.geomspace(1e-8, 1e8, 50))
        good = self.edp.bins["status"] != 1
        standing = 1 - np.nan_to_num(self.edp.bins["p_still"]) * (1 - self.edp.bins["p_over"])
        np.testing.assert_allclose(p[good, 0], standing[good], atol=1e-9)
        np.testing.assert_allclose(p[good, -1], self.edp.bins["p_over"][good], atol=1e-9)
        self.assertTrue((np.diff(p[good], axis=1) <= 1e-12).all())

    def test_a_fit_that_the_study_keeps_is_drawn_as_fit(self):
        self.assertFalse(model.kept_fits(self.edp).any())
        edp = reading.read_sweep(support.sweep()).edps[0]
        at = int(np.flatnonzero(edp.bins["status"] == 2)[0])
        edp.surface["probability"][at] = 0.123
        self.assertEqual(list(np.flatnonzero(model.kept_fits(edp))), [at])
        edp.bins["status"][at] = 0
        expected = model.exceedance(edp, [1.0])[at]
        edp.bins["status"][at] = 2
        np.testing.assert_array_equal(model.exceedance(edp, [1.0])[at], expected)

    def test_crossing(self):
        self.assertAlmostEqual(model.crossing([0, 1, 2, 3], np.array([0, 0.25, np.nan, 0.75]), 0.5), 2.0)
        self.assertTrue(np.isnan(model.crossing([0, 1], np.array([0.6, 0.9]), 0.5)))
        self.assertAlmostEqual(model.crossing([2, 1, 0], np.array([1.0, 0.5, 0.0]), 0.75), 1.5)

    def test_chosen_capacities(self):
        edp = reading.Edp("x", "1", "", "continuous", {}, np.arange(1, 10), {}, np.zeros(0), np.zeros((0, 0)))
        self.assertEqual(model.chosen_capacities(edp), [0, 2, 4, 6, 8])
        edp.capacity = np.array([1.0])
        self.assertEqual(model.chosen_capacities(edp), [0])


class Words(unittest.TestCase):
    def test_numbers(self):
        expected = {0.0123: "0.012", 12.34: "12", 0: "0", -0.5: "−0.50", 2: "2.0", float("nan"): "–", 1.2e7: "1.2×10⁷", 3e-9: "3.0×10⁻⁹"}
        for value, text in expected.items():
            self.assertEqual(words.number(value), text)
        self.assertEqual(words.plain(2.0), "2")
        self.assertEqual(words.plus_minus(4.1666, 0.103), "4.17 ± 0.10")
        self.assertEqual(words.p_value(1e-9), "< 0.001")
        self.assertEqual(words.probability(0.999), "> 0.99")
        self.assertEqual(words.count(1234567), "1\u202f234\u202f567")
        self.assertEqual(words.span(-0.8254, -0.0354), "−0.83 to −0.04")
        self.assertEqual([words.span(0, 0.5), words.span(2.25, 3), words.span(6.74, 27.2)], ["0 to 0.5", "2.25 to 3", "7 to 27"])
        self.assertEqual(words.listing(["a", "b", "c"]), "a, b and c")

    def test_columns_keep_their_unit(self):
        self.assertEqual(words.column("block_width_m"), "width (m)")
        self.assertEqual(words.column("effects_tilt_angle_rad"), "tilt angle (rad)")
        self.assertEqual(words.column("motion_peak_velocity_mps"), "motion peak velocity (m/s)")
        self.assertEqual(words.column("friction_static_ratio"), "friction static ratio")

    def test_spread_keeps_order_gap_and_limits(self):
        shown = style.spread([0.99, 0.98, 0.2, 0.99], 0.1, 1.0, 0.0)
        order = [shown[i] for i in (2, 1, 3, 0)]
        self.assertTrue(all(b - a >= 0.1 - 1e-9 for a, b in zip(order, order[1:])), shown)
        self.assertLessEqual(max(shown), 1.0 + 1e-9)
        self.assertEqual(style.spread([0.3, 0.7], 0.1), [0.3, 0.7])


if __name__ == "__main__":
    unittest.main()
