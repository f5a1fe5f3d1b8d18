#!/usr/bin/python3
"""Comparisons and diagnoses: what is read and refused, and the pictures drawn of them."""
import json
import os
import math
import pathlib
import tempfile
import unittest

import support
from pictures_test import overlaps
from report_test import Page

import h5py
import make_validation as make
import numpy as np
from freestand_post import command, pictures, reading_validation, style
from freestand_post.problem import USAGE, Problem


class Temporary(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def change(self, folder, name, change):
        path = folder / name
        value = json.loads(path.read_text())
        change(value)
        path.write_text(json.dumps(value))


class Reads(Temporary):
    def test_comparison(self):
        found = reading_validation.read_comparison(make.comparison(self.folder, ["static_friction"]))
        self.assertEqual((found.name, found.effects, found.unit), ("bench", ["static_friction"], "noise units"))
        self.assertEqual([test["id"] for test in found.tests], ["t01", "t02", "t03", "t04"])
        self.assertEqual(found.tests[0]["peaks"]["peak_slip_m"][0], 0.04)
        self.assertEqual((found.calibration["error"], found.holdout["error_expected"]), (17.4, 1.04))
        self.assertEqual(found.parameters[0]["interval"], (0.284, 0.314))
        self.assertTrue(all(map(math.isnan, found.parameters[1]["interval"])))
        (channel,) = found.histories[0].channels
        np.testing.assert_allclose(channel.residual, channel.model - channel.measured)
        self.assertEqual(found.tables["calibration"][0].label[2], "slipping")

    def test_null_is_nan_or_nothing(self):
        found = reading_validation.read_comparison(make.peaks(self.folder))
        self.assertEqual((found.holdout, found.histories), ({}, []))
        self.assertTrue(math.isnan(found.tests[0]["error_noise_units"]))
        self.assertTrue(math.isnan(found.calibration["error_expected"]))
        table = reading_validation.read_comparison(make.comparison(self.folder)).tables["calibration"][0]
        np.testing.assert_array_equal(np.isnan(table.columns["error_noise_units"]), [False] * 4 + [True] * 2 + [False])

    def test_diagnosis(self):
        found = reading_validation.read_diagnosis(make.diagnosis(self.folder, "ambiguous"))
        self.assertEqual((found.verdict, found.effects), ("ambiguous", ["rate_weakening", "static_friction"]))
        self.assertEqual(found.best["effect"], "rate_weakening")
        self.assertEqual(found.suggestion["motion"]["pulse"], "C2")
        self.assertEqual(found.suggestion["specimen"], "")
        self.assertEqual([table.variable for table in found.recovered], ["time_s", "speed_mps", "direction", "normal_g"])
        self.assertEqual(reading_validation.read_diagnosis(make.diagnosis(self.folder, "none")).suggestion, {})

    def test_the_best_is_the_one_that_the_file_names(self):
        found = [make.candidate("static_friction", 1.2), make.candidate("rate_weakening", 1.4, True)]
        chosen = reading_validation.read_diagnosis(make.diagnosis(self.folder, candidates=found, best="static_friction"))
        self.assertEqual(chosen.best["effect"], "static_friction")
        self.assertEqual(reading_validation.read_diagnosis(make.diagnosis(self.folder, candidates=found, best=None)).best, {})

    def test_missing_parts_are_empty(self):
        make.write(self.folder, "diagnosis.json", {"format": "freestand-diagnosis/2", "verdict": "none", "candidates": []})
        found = reading_validation.read_diagnosis(self.folder)
        self.assertEqual((found.base, found.best, found.recovered), ({}, {}, []))
        self.assertTrue(math.isnan(found.noise_floor))


class Refuses(Temporary):
    def refused(self, read, *needles):
        with self.assertRaises(Problem) as caught:
            read(self.folder)
        text = str(caught.exception)
        self.assertEqual((caught.exception.exit_code, len(text.splitlines())), (3, 1), text)
        for needle in needles:
            self.assertIn(needle, text)

    def test_truncated_anywhere(self):
        path = make.comparison(self.folder) / "comparison.json"
        whole = path.read_text()
        for share in (0.0, 0.01, 0.3, 0.7, 0.999):
            path.write_text(whole[:int(share * len(whole))])
            self.refused(reading_validation.read_comparison, "comparison.json", "not readable as JSON", "freestand compare")

    def test_not_text_and_no_object(self):
        path = self.folder / "diagnosis.json"
        path.write_bytes(b"\xff\xfe\x00\x81" * 20)
        self.refused(reading_validation.read_diagnosis, "not readable")
        path.write_text("[1, 2]")
        self.refused(reading_validation.read_diagnosis, "the whole is not an object", "freestand diagnose")

    def test_other_format(self):
        make.comparison(self.folder, format="freestand-comparison/9")
        self.refused(reading_validation.read_comparison, '"freestand-comparison/9"', '"freestand-comparison/2"')

    def test_wrong_kinds_are_named(self):
        for change, place in ((lambda v: v["tests"][1].update(error_relative="big"), "tests[1].error_relative is not a number"),
                              (lambda v: v.update(tests=None), "tests is not a list"),
                              (lambda v: v.update(findings=[3]), "findings is not a list of texts"),
                              (lambda v: v["calibration"].update(error=True), "calibration.error is not a number"),
                              (lambda v: v["histories"][0]["slip_m"].update(model=[1, 2]), "histories[0].slip_m.model"),
                              (lambda v: v["histories"][1]["slip_m"].update(noise={}), "histories[1].slip_m.noise"),
                              (lambda v: v["error_tables"]["calibration"][1].update(count=["a"]), "error_tables.calibration[1].count"),
                              (lambda v: v.update(parameters=["mu"]), "parameters[0] is not an object")):
            with self.subTest(place):
                make.comparison(self.folder)
                self.change(self.folder, "comparison.json", change)
                self.refused(reading_validation.read_comparison, place)

    def test_verdict_that_is_none_of_the_four(self):
        make.diagnosis(self.folder, verdict="perhaps")
        self.refused(reading_validation.read_diagnosis, "verdict", "ambiguous")

    def test_through_the_program_it_is_one_line(self):
        (self.folder / "comparison.json").write_text("{")
        for program in ("report", "figures"):
            result = support.run(program, self.folder)
            self.assertEqual((result.returncode, result.stdout, len(result.stderr.strip().splitlines())), (3, "", 1), result.stderr)
        self.assertFalse((self.folder / "report.html").exists())

    def test_several_folders_without_a_validation(self):
        for name in ("one", "two"):
            (self.folder / name).mkdir()
        with self.assertRaises(Problem):
            command.read([self.folder / "one", self.folder / "two"])
        with self.assertRaisesRegex(Problem, "given twice") as caught:
            command.read([support.sweep(), support.sweep()])
        self.assertEqual(caught.exception.exit_code, USAGE)


class Drawn(Temporary):
    def setUp(self):
        super().setUp()
        style.apply()

    def draw(self, *folders, about=""):
        """All pictures of a validation by name; all of them said in words, and none of those that the test is about crowded (the others are
        those of other tests; all of them where FREESTAND_LONG_TESTS is set)."""
        drawn = {picture.name: picture for picture in pictures.draw(command.read(folders)[0])}
        for name, picture in drawn.items():
            with self.subTest(name):
                self.assertGreater(len(picture.finding), 15)
                self.assertNotRegex(picture.finding + picture.caption, r"\bnan\b|\{|\}|_")
                self.assertTrue(picture.caption.endswith("."))
                if name.startswith(about) or "FREESTAND_LONG_TESTS" in os.environ:
                    self.assertEqual(overlaps(picture.figure), [])
                    title, _ = style.take_headline(picture.figure)  # as the page shows it
                    self.assertEqual((title, overlaps(picture.figure)), (picture.finding, []))
        return drawn

    def test_whole_ladder(self):
        before = make.comparison(self.folder / "before", channels=("slip_m", "rotation_rad"))
        after = make.comparison(self.folder / "after", ["static_friction"], 1.03, 1.01, channels=("slip_m", "rotation_rad"))
        drawn = self.draw(before, make.diagnosis(self.folder / "diag"), after)
        self.assertEqual(set(drawn), {"ladder", "ranking", "recovered", "worst_t02", "worst_t04", "where"})
        self.assertIn("held-out error falls from 13.8 to 1.01 noise units, at the noise floor", drawn["ladder"].finding)
        self.assertIn("falls from 17.7 to 1.20", drawn["ranking"].finding)
        self.assertIn("mostly while sliding", drawn["where"].finding)
        self.assertIn("path slid (mm)", [axes.get_xlabel() for axes in drawn["where"].figure.axes])
        self.assertIn("with the base model", drawn["worst_t02"].finding)
        labels = [axes.get_ylabel() for axes in drawn["worst_t02"].figure.axes]
        self.assertEqual(labels, ["floor (g)", "slip (cm)", "residual\n(noise units)", "rotation (°)", "residual\n(noise units)"])

    def test_ladder_of_the_study_is_longer_than_the_folders(self):
        rows = [{"step": step, "error_calibration": error, "error_holdout": None, "noise_floor": 1.0}
                for step, error in (("base", 70.1), ("impact_loss", 9.0), ("viscous_drag", 1.04))]
        before = make.comparison(self.folder / "before")
        after = make.comparison(self.folder / "after", ["impact_loss", "viscous_drag"], 1.04, 1.02, ladder=rows)
        drawn = self.draw(before, after, about="ladder")["ladder"]
        (axes,) = drawn.figure.axes
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()], ["base", "+ impact loss", "+ viscous drag"])
        self.assertIn("With impact loss and viscous drag the calibration error falls from 70.1 to 1.04", drawn.finding)
        one = self.draw(before, make.comparison(self.folder / "after", ["impact_loss"], 1.04, 1.02), about="ladder")["ladder"]
        self.assertEqual([label.get_text() for label in one.figure.axes[0].get_xticklabels()], ["base", "+ impact loss"])

    def test_ladder_that_ends_above_the_noise(self):
        before, after = make.comparison(self.folder / "before"), make.comparison(self.folder / "after", ["impact_loss"], 6.0, 5.0)
        self.assertEqual(self.draw(before, after, about="ladder")["ladder"].finding,
                         "With impact loss the held-out error falls from 13.8 to 5.00 noise units, above the noise floor of 1.04")

    def test_effects_without_an_error_on_tests_left_out_are_crosses(self):
        found = [make.candidate("viscous_drag", 1.0, True), make.candidate("rate_strengthening", 1.01) | {"numbers_as_met_in_practice": False},
                 make.candidate("floor_tilt", 3.0), make.candidate("flexible_legs", 2.0) | {"left_out_refitted": False}]
        drawn = self.draw(make.diagnosis(self.folder / "crosses", candidates=found), about="ranking")["ranking"]
        (axes,) = drawn.figure.axes
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()],
                         ["viscous drag", "rate strengthening", "floor tilt", "flexible legs"])
        self.assertEqual(sum(line.get_marker() == "x" for line in axes.get_lines()), 1)
        self.assertIn("rate strengthening leaves 1.01, with numbers that are not met in practice", drawn.finding)
        self.assertIn("Crosses", drawn.caption)

    def test_worst_histories_in_order_with_the_errors_of_both_models(self):
        before = make.comparison(self.folder / "before")
        after = make.comparison(self.folder / "after", ["static_friction"], 1.03, 1.01, histories=[])
        drawn = self.draw(before, after, about="worst")
        self.assertEqual([name for name in drawn if name.startswith("worst")], ["worst_t04", "worst_t02"])
        self.assertEqual(drawn["worst_t02"].finding, "Test t02: 19.1 noise units with the base model, 1.13 with static friction")

    def test_history_shows_the_numbers_of_the_file(self):
        folder = make.comparison(self.folder / "one")
        value = json.loads((folder / "comparison.json").read_text())["histories"][0]
        _, slip, residual = self.draw(folder, about="worst_t02")["worst_t02"].figure.axes
        shown = [line.get_ydata() for line in slip.get_lines()]
        np.testing.assert_allclose(shown[0], 100 * np.array(value["slip_m"]["measured"]))
        np.testing.assert_allclose(shown[1], 100 * np.array(value["slip_m"]["model"]))
        np.testing.assert_allclose(residual.get_lines()[0].get_ydata(), np.array(value["slip_m"]["residual"]) / make.NOISE)

    def test_a_test_that_only_the_last_model_lists_is_shown_if_missed(self):
        before = make.comparison(self.folder / "before", histories=[make.history("t02", 17)])
        after = make.comparison(self.folder / "after", ["wall_impact"], 1.0, 1.0, histories=[make.history("t03", 1)])
        self.assertNotIn("worst_t03", self.draw(before, after, about="worst_t03"))
        after = make.comparison(self.folder / "after", ["wall_impact"], 9.0, 9.0, histories=[make.history("t03", 9)])
        self.assertIn("worst_t03", self.draw(before, after, about="worst_t03"))

    def test_ranking_shows_ten_and_says_how_many_more(self):
        drawn = self.draw(make.diagnosis(self.folder, "ambiguous"), about="ranking")["ranking"]
        (axes,) = drawn.figure.axes
        names = [label.get_text() for label in axes.get_yticklabels()]
        self.assertEqual((len(names), names[:3]), (10, ["rate weakening", "static friction", "floor tilt"]))
        self.assertEqual([label.get_weight() for label in axes.get_yticklabels()[:3]], ["bold", "bold", "normal"])
        self.assertEqual(axes.get_xscale(), "log")

    def test_law_is_drawn_where_it_is_a_law_of_that_variable(self):
        drawn = self.draw(make.diagnosis(self.folder), about="recovered")["recovered"]
        panels = {axes.get_xlabel(): axes for axes in drawn.figure.axes}
        self.assertEqual(list(panels)[0], "sliding speed (m/s)")
        self.assertNotIn("normal force over mass (g)", panels)
        blue = {name: [line for line in axes.get_lines() if line.get_color() == style.BLUE and np.isfinite(line.get_ydata()).any()]
                for name, axes in panels.items()}
        self.assertEqual({name for name, lines in blue.items() if lines}, {"sliding speed (m/s)"})
        self.assertRegex(drawn.finding, r"sliding speed .* from 0\.2\d to 0\.20; the law of rate weakening from 0\.2\d to 0\.20")

    def blue_lines(self, drawn):
        return [line for axes in drawn["recovered"].figure.axes for line in axes.get_lines()
                if line.get_color() == style.BLUE and np.isfinite(line.get_ydata()).any()]

    def test_a_force_that_cancels_in_friction_is_drawn_as_a_force(self):
        """A spring's: friction there and back averages to the same, and a reader would see that nothing depends on the position."""
        recovered = make.recovered()
        place = [-0.05, 0.0, 0.05]
        recovered["tables"].append({"variable": "position_m", "unit": "m", "edge": [], "centre": place, "count": [16.0] * 3, "mu": [0.25, 0.251, 0.25],
                                    "mu_deviation": [0.01] * 3, "mu_lower": [0.24] * 3, "mu_upper": [0.26] * 3, "force_mps2": [0.3, 0.0, -0.31],
                                    "force_lower_mps2": [0.2, -0.1, -0.4], "force_upper_mps2": [0.4, 0.1, -0.2], "share_explained": 0.09,
                                    "share_of_force_explained": 0.7,
                                    "law": {"effects": ["centering_spring"], "mu": [0.25] * 3, "force_mps2": [0.29, 0.0, -0.29], "follows": True}})
        found = [make.candidate("centering_spring", 1.2, True)]
        folder = make.diagnosis(self.folder, candidates=found, best="centering_spring", effects=["centering_spring"], recovered_force=recovered)
        drawn = self.draw(folder, about="recovered")["recovered"]
        self.assertEqual(drawn.finding, "Over the position the recovered missing force goes from 0.15 to −0.15 m/s²; the law of centering spring from 0.14 to −0.14 m/s²")
        force, friction = drawn.figure.axes[:2]
        self.assertEqual((force.get_ylabel(), friction.get_ylabel()), ("force over mass (m/s²)", "friction coefficient μ"))
        self.assertEqual([list(line.get_ydata()) for line in force.get_lines() if line.get_color() == style.BLUE], [[0.29, 0.0, -0.29]])
        self.assertLess(force.get_ylim()[0], -0.31)
        self.assertGreater(friction.get_ylim()[0], 0)

    def test_no_law_is_drawn_where_no_effect_is_named(self):
        for verdict in ("none", "unknown"):
            self.assertFalse(self.blue_lines(self.draw(make.diagnosis(self.folder / verdict, verdict), about="recovered")))

    def test_no_law_is_drawn_but_that_of_the_effect_that_the_verdict_names(self):
        found = [make.candidate("static_friction", 1.2, True), make.candidate("rate_weakening", 2.0)]
        folder = make.diagnosis(self.folder, candidates=found, best="static_friction", effects=["static_friction"])
        drawn = self.draw(folder, about="recovered")
        self.assertFalse(self.blue_lines(drawn))
        self.assertNotIn("law of", drawn["recovered"].finding)

    def test_the_next_best_is_worse_than_the_best(self):
        """An effect that leaves less than the one named is told with what is held against it, never as the next best."""
        best = make.candidate("rate_weakening", 1.37, True) | {"error_left_out_floor_noise_allowed": 1.02}
        for other, told in (({"numbers_as_met_in_practice": False}, "static friction leaves 1.17, with numbers that are not met in practice"),
                            ({"error_left_out_floor_noise_allowed": 1.4}, "static friction leaves 1.17, but 1.40 against 1.02 where the floor's noise"),
                            ({"error_left_out_floor_noise_allowed": 0.9}, "static friction leaves 1.17, which chance does not part from it")):
            rows = [best, make.candidate("static_friction", 1.17) | other, make.candidate("floor_tilt", 2.5)]
            finding = self.draw(make.diagnosis(self.folder, candidates=rows), about="ranking")["ranking"].finding
            self.assertIn("With rate weakening the left-out error falls from 17.7 to 1.37 noise units", finding)
            self.assertIn(told, finding)
            self.assertIn("the next best leaves 2.50", finding)
            self.assertNotIn("best leaves 1.17", finding)

    def test_verdict_none_keeps_small_differences_small(self):
        base = make.candidate("", 1.02)
        near = [make.candidate(name, value) for name, value in (("wall_impact", 1.01), ("floor_tilt", 1.02))]
        (axes,) = self.draw(make.diagnosis(self.folder, "none", candidates=near, base=base, noise_floor=1.04), about="ranking")["ranking"].figure.axes
        low, high = axes.get_xlim()
        self.assertGreater(high - low, 0.3)

    def test_peaks(self):
        slow, fitted = make.peaks(self.folder / "slow", 0.2, stuck=2), make.peaks(self.folder / "fitted", 0.95)
        picture = self.draw(slow, fitted)["peaks_peak_slip_m"]
        self.assertRegex(picture.finding, r"In fitted the model predicts .* in slow 0\.\d+")
        (axes,) = picture.figure.axes
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("measured peak slip (cm)", "predicted peak slip (cm)"))
        stuck = [line for line in axes.get_lines() if line.get_marker() == "v" and line.get_xdata().size]
        self.assertEqual([line.get_xdata().size for line in stuck], [2])

    def test_a_bias_is_what_the_comparison_calls_one(self):
        for ratio, said in ((0.95, "predicts the peak slip without a bias that these tests show"), (0.5, "times the measured peak slip")):
            self.assertIn(said, self.draw(make.peaks(self.folder, ratio))["peaks_peak_slip_m"].finding)

    def test_specimen_that_stood_still(self):
        (axes,) = self.draw(make.peaks(self.folder, 0.95, stuck=1, stood=2))["peaks_peak_slip_m"].figure.axes
        left = [line for line in axes.get_lines() if line.get_marker() == "<"]
        self.assertEqual([line.get_xdata().size for line in left], [2])
        self.assertLess(left[0].get_xdata().max(), 1.1 * axes.get_xlim()[0])

    def test_model_that_never_moves(self):
        self.assertIn("does not move in any of the 9 tests", self.draw(make.peaks(self.folder, 0.2, stuck=9))["peaks_peak_slip_m"].finding)

    def test_outcomes_in_order_of_intensity_or_probability(self):
        for intensity, label in ((True, "peak floor acceleration (g)"), (False, "tests, by the probability that the model gives")):
            picture = self.draw(make.outcomes(self.folder, intensity))["outcomes"]
            self.assertEqual(picture.figure.axes[-1].get_xlabel(), label)
            self.assertIn("36 of 40 outcomes right", picture.finding)

    def test_fragility_before_and_after(self):
        changed = support.sweep_copy(self.folder / "changed")
        with h5py.File(changed / "fragility.h5", "a") as root:
            root.attrs["effects"] = json.dumps([{"name": "static_friction", "parameters": []}])
            for key in ("probability", "lower", "upper"):
                root[f"edp/delta/surface/{key}"][...] *= 0.5
        picture = self.draw(make.comparison(self.folder / "one"), support.sweep(), changed, about="before_after")["before_after"]
        self.assertRegex(picture.finding, r"With static friction P\(Δ.>.0\.5\) falls by up to 0\.50")
        self.assertEqual(picture.figure.axes[-1].get_title(loc="left").strip(), "P(overturned)")

    def test_one_value_of_the_reports_intensity_is_two_shakings_where_friction_differs(self):
        before, after = (support.sweep_copy(self.folder / name) for name in ("base", "with"))
        for folder, mu in ((before, 0.113), (after, 0.151)):
            with h5py.File(folder / "fragility.h5", "a") as root:
                root.attrs["im"] = "report"
                root.attrs["study"] = f"friction: {{mu: {mu}}}\nblock: {{width_m: 0.6}}\n"
        folders = [make.comparison(self.folder / "one"), before, after]
        self.assertNotIn("before_after", self.draw(*folders, about="before_after"))
        self.assertEqual(support.run("report", *folders, "-o", self.folder / "page.html").returncode, 0)
        self.assertIn("one value is two shakings", Page((self.folder / "page.html").read_text()).text)

    def test_sweeps_that_cannot_be_compared_say_why(self):
        other = support.sweep_copy(self.folder / "other")
        with h5py.File(other / "fragility.h5", "a") as root:
            root.attrs["im"] = "pga_g"
        folders = [make.comparison(self.folder / "one"), support.sweep(), other]
        self.assertNotIn("before_after", self.draw(*folders, about="before_after"))
        self.assertEqual(support.run("report", *folders, "-o", self.folder / "page.html").returncode, 0)
        self.assertIn("not drawn together", Page((self.folder / "page.html").read_text()).text)

    def test_headline_stands_in_the_picture_until_a_page_takes_it(self):
        (picture,) = (item for item in pictures.draw(command.read([make.diagnosis(self.folder)])[0]) if item.name == "ranking")
        said = " ".join(text.get_text() for text in picture.figure.texts)
        self.assertIn("With rate weakening the left-out error falls", said)
        height = picture.figure.get_size_inches()[1]
        _, reading = style.take_headline(picture.figure)
        self.assertIn("3 more candidates", reading)
        self.assertEqual(len(picture.figure.texts), 0)
        self.assertLess(picture.figure.get_size_inches()[1], height)

    def test_nothing_known_draws_nothing(self):
        make.comparison(self.folder, tests=[], histories=[], error_tables=None, calibration=None, holdout=None, peak_ratio=None)
        make.diagnosis(self.folder, "none", candidates=[], base=None, recovered_force=None, noise_floor=None)
        self.assertEqual(self.draw(self.folder), {})
        self.assertEqual(support.run("report", self.folder).returncode, 0)


if __name__ == "__main__":
    unittest.main()
