#!/usr/bin/python3
"""The page of comparisons and diagnoses: what it says, and that it says the same everywhere."""
import json
import re
import unittest

import support
from report_test import Page
from validation_test import Temporary

import make_validation as make


class ThePage(Temporary):
    def page(self, *folders, drawn=False):
        result = support.run("report", *folders, "-o", self.folder / "page.html", drawn=drawn)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertEqual([address for address in page.addresses if not address.startswith("#")], [])
        self.assertNotRegex(page.text, r"\bnan\b")
        return page, text

    def test_before_diagnosis_after(self):
        diagnosis = make.diagnosis(self.folder / "diag", candidates=[make.candidate("static_friction", 1.2, True)],
                                   effects=["static_friction"], sentences=["static_friction brings it down"])
        page, text = self.page(make.comparison(self.folder / "before"), diagnosis,
                               make.comparison(self.folder / "after", ["static_friction"], 1.03, 1.01))
        for needle in ("bench: the missing effect was static friction", "17.7 base model", "1.20 with static friction",
                       "1.01 on held-out tests", "1.03 to 1.08 noise floor: what noise alone would make, which models and tests answer differently", "4 tests (3 for calibration and 1 held out)",
                       "Static friction brings it down.", "friction: μ 0.2991", "static friction: ratio 1.800", "All 1 candidate and", "t03",
                       "simplex method"):
            self.assertIn(needle, page.text)
        self.assertEqual(text.count('<tr class="missed">'), 0)
        self.assertLessEqual({"ladder", "ranking", "recovered", "worst_t02", "where"}, set(page.ids))

    def test_one_noise_floor_where_all_are_the_same(self):
        one = {"error_noise_units": 2.0, "error_relative": 0.1, "error": 2.0, "error_expected": 1.08, "tests": 1}
        page, _ = self.page(make.comparison(self.folder / "before", calibration=one, holdout=one), make.diagnosis(self.folder / "diag"))
        self.assertRegex(page.text, r"1\.08 noise floor: what noise alone would make\s[^,]")

    def test_one_comparison(self):
        page, text = self.page(make.comparison(self.folder / "before"))
        self.assertIn("The error comes about mostly while sliding: there it changes by 4.6 mm in 0.1 s, 2.6 mm on the average", page.text)
        self.assertIn("bench: the model misses its tests by 17.4 times the sensor noise", page.text)
        self.assertEqual(text.count('<tr class="missed">'), 4)
        self.assertNotIn("ladder", page.ids)
        self.assertIn("method of the fit", page.text)

    def test_praise_only_where_the_tests_can_judge(self):
        for error, expected, needle in ((1.02, 1.03, "bench: the model is as good as the noise can tell"),
                                        (2900.0, 2484.0, "bench: the floor's noise alone drowns its tests"),
                                        (0.05, 1.0, "bench: the model is nearer to its tests than the noise alone would be")):
            with self.subTest(error):
                mine = {"error_noise_units": error, "error_relative": 0.2, "error": error, "error_expected": expected, "tests": 3}
                page, _ = self.page(make.comparison(self.folder / str(error), calibration=mine))
                self.assertIn(needle, page.text)

    def test_a_comparison_at_given_numbers_fits_nothing(self):
        page, _ = self.page(make.comparison(self.folder / "before", parameters=[]))
        self.assertNotIn("method of the fit", page.text)

    def test_verdicts_in_the_headline(self):
        for verdict, needle in (("none", "these tests show no missing effect"), ("unknown", "no effect of the catalogue explains"),
                                ("ambiguous", "the missing effect is rate weakening or static friction"),
                                ("missing", "the missing effect is rate weakening")):
            with self.subTest(verdict):
                page, _ = self.page(make.diagnosis(self.folder / verdict, verdict))
                self.assertIn(needle, page.text)
                self.assertEqual("would part them by 41.9 noise units" in page.text, verdict == "ambiguous")

    def test_why_a_verdict_is_unknown(self):
        for reason, title, finding in (
                ("data", "bench: no verdict, since the measurements look wrong in a sign, a clock, a unit, an offset or a dimension", "were the measurements right: none is named"),
                ("none_helps", "bench: the model misses more than noise explains, and no effect", "the best, rate weakening, 6.00"),
                ("none_suffices", "bench: no effect of the catalogue explains all", "The best candidate, rate weakening, still misses")):
            with self.subTest(reason):
                best = None if reason == "data" else "rate_weakening"
                page, text = self.page(make.diagnosis(self.folder / reason, "unknown", reason=reason, best=best))
                self.assertIn(title, page.text)
                self.assertIn(finding, page.text)
                self.assertNotIn("lacks something", page.text)
                self.assertEqual("with rate weakening, on tests left out" in page.text, reason == "none_suffices")
                self.assertEqual(text.index("<figure") > text.index("What was found"), reason == "data")

    def test_peaks_that_no_model_meets(self):
        for reason, title in (("none_helps", "bench: the model misses the peaks by more than one test misses another"),
                              ("none_suffices", "bench: even the best effect of the catalogue misses the peaks by more than one test misses another")):
            with self.subTest(reason):
                enough = {"question": "is it enough", "about": "the model as it is", "p": 0.01, "level": 0.05, "observed": 3, "chance_reaches": 1,
                          "simulations": 2000, "told_apart": None}
                page, _ = self.page(make.diagnosis(self.folder / reason, "unknown", reason=reason, best="rate_weakening", error_unit="ln ratio",
                                                   tests_of_chance=[enough]))
                self.assertIn(title, page.text)
                self.assertIn("that the model as it is misses tests by so much more than one test misses another where it is the truth", page.text)

    def test_one_law_for_two_effects(self):
        law = {"effect": "friction_over_speed_squared", "error_left_out": 1.02, "friction": "mu*(1 + a*v*v)"}
        page, _ = self.page(make.diagnosis(self.folder / "one_law", "unknown", reason="one_law", best="rate_weakening+viscous_drag", proposed_law=law,
                                          candidates=[make.candidate("rate_weakening+viscous_drag", 1.03)]))
        self.assertIn("one law of no catalogue, friction over speed squared, does for rate weakening and viscous drag", page.text)
        self.assertIn("Rate weakening and viscous drag together would be enough, with more numbers than one law takes", page.text)
        self.assertNotIn("No effect of the catalogue is enough", page.text)

    def test_what_lies_within_its_tolerance_and_whose_friction_differs(self):
        for name, keys, needles in (
                ("within", {"enough_if": "the width is 0.06 % larger than stated"},
                 ("No effect is needed: if the width is 0.06 % larger than stated, within its tolerance", "these tests show no missing effect")),
                ("odd", {"decided_by": "friction_scatter", "friction_scatter": {"standard_deviation_ln": 0.12, "factors": [1], "odd_test": "t02"}},
                 ("test t02 has a friction of its own; these tests show no missing effect",))):
            with self.subTest(name):
                page, _ = self.page(make.diagnosis(self.folder / name, "none", **keys))
                for needle in needles:
                    self.assertIn(needle, page.text)

    def test_a_gain_beyond_chance_that_is_not_needed(self):
        """What stands over the candidates says no more of chance than the table of chances does."""
        helps = {"question": "does an effect help", "about": "12 effects", "p": 0.0005, "level": 0.05, "observed": 40, "chance_reaches": 5,
                 "simulations": 2000, "told_apart": None}
        for decided_by, needles in (("friction_scatter", ("A friction of its own in each test explains what the base misses",
                                                          "friction that differs from test to test explains it")),
                                    ("tests_of_chance", ("No effect is needed: the base leaves", "rate weakening: not needed"))):
            with self.subTest(decided_by):
                page, _ = self.page(make.diagnosis(self.folder / decided_by, "none", decided_by=decided_by, tests_of_chance=[helps]))
                for needle in needles:
                    self.assertIn(needle, page.text)
                self.assertNotIn("no more than chance", page.text)
                self.assertNotIn("by more than chance", page.text)
        enough = {"question": "is it enough", "about": "the model as it is", "p": 0.0005, "level": 0.05, "observed": 9, "chance_reaches": 5, "simulations": 2000,
                  "told_apart": None}
        page, _ = self.page(make.diagnosis(self.folder / "near_enough", "none", tests_of_chance=[helps, enough]))
        self.assertIn("more than noise explains, but no more than one reading strays by", page.text)
        self.assertNotIn("no more than noise explains", page.text)

    def test_a_fault_of_the_laboratory_is_no_effect(self):
        width = make.candidate("width_as_stated", 1.02, True)
        width["parameters"] = {"laboratory.width_as_stated": {"value": 0.981, "unit": "1", "interval": [0.98, 0.982]}}
        for verdict, effects, others, title in (
                ("bad_data", [], [make.candidate("reduced_base", 9)], "bench: no effect is needed: the stated width is off"),
                ("ambiguous", ["reduced_base"], [make.candidate("reduced_base", 1.03, True)],
                 "bench: the missing effect is reduced base, or the stated width is off")):
            with self.subTest(verdict):
                page, _ = self.page(make.diagnosis(self.folder / verdict, verdict, effects=effects, candidates=[width] + others,
                                                   reason="data" if verdict == "bad_data" else None))
                self.assertIn(title, page.text)
                self.assertIn("the stated width", page.text)
                self.assertNotIn("width as stated", page.text)

    def test_a_law_that_is_proposed(self):
        law = make.candidate("waves_over_position", 1.28) | {
            "friction": "mu*(1 + a*sin(2*pi*u/l))", "force": None, "variable": "position_m", "entry": "{name: waves_over_position}\n",
            "parameters": {"effects.waves_over_position.l_m": {"value": 0.157, "unit": "m", "interval": [0.155, 0.158]}}}
        page, _ = self.page(make.diagnosis(self.folder / "proposed", "unknown", proposed_law=law))
        self.assertIn("no effect of the catalogue explains it; waves over position, a law of no catalogue, leaves 1.28 of 17.7", page.text)
        self.assertIn("friction: mu*(1 + a*sin(2*pi*u/l)) leaves 1.28 of 17.7 noise units", page.text)
        self.assertIn("freestand add study.yaml proposed/proposed_law.yaml -o WITH_LAW.yaml", page.text)
        self.assertIn("1.28 with waves over position, on tests left out of the fit", page.text)
        self.assertIn("0.1550 to 0.1580", page.text)
        without, _ = self.page(make.diagnosis(self.folder / "without", "unknown"))
        self.assertNotIn("A law that nobody has named", without.text)

    def test_what_chance_would_do_stands_beside_the_verdict(self):
        page, _ = self.page(make.diagnosis(self.folder))
        self.assertIn("that the best of 13 effects gains as much where nothing is missing", page.text)
        self.assertIn("that rate weakening leads static friction by as much where static friction is the truth", page.text)
        self.assertIn("less than 0.0005", page.text)
        self.assertIn("that the model as it is leaves as much where it is the truth", page.text)
        self.assertIn("that one more effect gains as much where rate weakening is the truth", page.text)
        self.assertIn("that one of all effects tried gains as much as rate weakening by the readings which the floor's noise does not turn elsewhere", page.text)
        self.assertIn("less than 0.0065", page.text)
        self.assertIn("92 %", page.text)
        self.assertIn("0.012", page.text)

    def test_an_interval_that_is_not_there_says_why(self):
        page, _ = self.page(make.diagnosis(self.folder))
        self.assertIn("none: it was not fitted to the end", page.text)

    def test_narrow_screens_cut_nothing(self):
        """Pictures fill the width; tables are written row under row, each cell with what it is."""
        _, text = self.page(make.comparison(self.folder / "before"), make.diagnosis(self.folder / "diag"),
                            make.comparison(self.folder / "after", ["static_friction"], 1.03, 1.01), drawn=True)
        self.assertNotRegex(text, r"figure svg \{[^}]*min-width")
        tables = re.findall(r"<table class=\"([^\"]*)\">(.*?)</table>", text, re.S)
        self.assertEqual(len(tables), 4)
        for kind, table in tables:
            self.assertIn("stack", kind)
            body = table[table.index("<tbody>"):]
            for row in re.findall(r"<tr.*?</tr>", body, re.S):
                self.assertRegex(row, r"<tr[^>]*><td class=\"text\">")
                self.assertEqual(row.count("<td"), row.count("data-label=") + 1, row)
        self.assertEqual(support.cut_off(self, text), {1300: ([], []), 420: ([], [])})

    def test_peaks_and_outcomes(self):
        page, _ = self.page(make.peaks(self.folder / "peaks"))
        self.assertIn("the model predicts 0.20 times the measured peaks", page.text)
        page, text = self.page(make.outcomes(self.folder / "outcomes"))
        self.assertIn("the model gets 36 of 40 outcomes right", page.text)
        self.assertIn("All 40 tests, 4 of them missed", page.text)
        self.assertEqual(text.count('<tr class="missed">'), 4)

    def test_text_from_files_is_escaped(self):
        _, text = self.page(make.comparison(self.folder / "one", name="<b>bench</b>", findings=["<script>alert(1)</script>"]))
        self.assertNotIn("<script>alert", text)
        self.assertNotIn("<b>bench", text)

    def test_joint_draws_are_shown_under_the_numbers(self):
        after = make.comparison(self.folder / "after", ["static_friction"], 1.03, 1.01, posterior={"table": "fitted_draws.csv", "friction_scatter": 0.12})
        lines = [f"{0.3 + 0.001 * k},{1.8 - 0.002 * k}" for k in range(20)]
        (after / "fitted_draws.csv").write_text("\n".join(["# draws", "friction.mu,effects.static_friction.ratio"] + lines))
        page, _ = self.page(after)
        self.assertIn("draws", page.ids)
        self.assertIn("The tests know friction μ and static friction ratio better together than each (correlation -1.00); friction differs by 12 % from test to test", page.text)
        (after / "fitted_draws.csv").write_text("friction.mu\nxyz\n")
        result = support.run("report", after)
        self.assertEqual(result.returncode, 3)
        self.assertIn("fitted_draws.csv is no table of numbers", result.stderr)

    def test_the_table_says_that_it_allows_for_the_friction_of_each_test(self):
        for own in (None, 0.93):
            tests = [test | {"own_friction": own} for test in make.history_tests(1.03)]
            page, _ = self.page(make.comparison(self.folder / str(own), tests=tests))
            self.assertIn("allowing for floor noise", page.text)
            self.assertEqual("allowing for floor noise and a friction of its own" in page.text, own is not None)

    def test_figures_writes_them_as_files(self):
        folder = make.comparison(self.folder / "one")
        result = support.run("figures", folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        captions = json.loads((folder / "figures/captions.json").read_text())
        self.assertEqual(set(captions), {"worst_t02", "worst_t04", "where"})
        self.assertTrue(all((folder / f"figures/{name}.{kind}").exists() for name in captions for kind in ("svg", "png")))


if __name__ == "__main__":
    unittest.main()
