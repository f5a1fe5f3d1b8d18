#!/usr/bin/python3
"""Pages of decisions: several designs and intensities, annual risk, shares of variance."""
import html
import json
import unittest

import support

import h5py
import make_decisions
import numpy as np
from freestand_post import best_intensity, decisions_report, designs, pictures, reading_decisions
from freestand_post.command import read
from freestand_post.problem import Problem
from freestand_post.report import page
from make_decisions import InFolder
from pictures_test import overlaps


class RiskPicture(InFolder):
    def test_of_many_rates_each_demand_keeps_one_and_the_rest_is_told(self):
        folder = make_decisions.make_risk(self.folder / "risk")
        found = json.loads((folder / "risk.json").read_text())
        told = next(one for one in found["demands"] if not one["refused"])
        found["demands"] = [{**told, "edp": edp, "capacity": capacity, "title": f"{edp} {capacity}"}
                            for edp in ("delta", "peak_slip_m", "residual_slip_m") for capacity in (1, 2, 3)] + [{**told, "edp": "leaves", "capacity": None, "title": "leaves"}]
        (folder / "risk.json").write_text(json.dumps(found))
        (picture,) = pictures.draw(read([folder])[0])
        rows = [label.get_text() for label in picture.figure.axes[0].get_yticklabels()]
        self.assertEqual((len(rows), rows[-1]), (8, "Leaves"))
        self.assertIn("2 more rates: in the table.", picture.caption)


class Rates(InFolder):
    def test_the_lowest_rate_and_what_its_band_does_not_part(self):
        found = [(1e-3, 8e-4, 1.2e-3), (2e-4, 1e-4, 3e-4), (2.5e-4, 2e-4, 4e-4)]
        text = decisions_report._lowest("overturned", ["a", "b", "c"], found)
        self.assertEqual(text, "B has the lowest annual rate of “overturned”: 2.0×10⁻⁴, 5.0 times below a; not parted by more than their bands from c")

    def test_a_design_of_which_no_rate_is_told_may_have_the_lowest(self):
        """The rate of the widest one is refused, most of it being from beyond the sweep: it is likely the lowest."""
        text = decisions_report._lowest("overturned", ["a", "b", "c"], [(1e-3, 8e-4, 1.2e-3), (2e-4, 1e-4, 3e-4), (float("nan"),) * 3])
        self.assertEqual(text, "Of those that are told, b has the lowest annual rate of “overturned”: 2.0×10⁻⁴, 5.0 times below a; none is told of c")

    def test_what_pairs_of_samples_part_is_not_called_the_same(self):
        """Bands of the rates overlap; the medians of the same motions differ by more than chance: the table's verdict is the headline's."""
        found = self.sweeps(self.design("a", 2.0), self.design("b", 2.1, width=0.9, of_own=1))
        self.assertEqual(designs.verdict(found.rows[0].ratio[1]), "yes")
        risks = [reading_decisions.read_risk(make_decisions.make_risk(self.folder / f"r{name}", sweep=name, times=times)) for name, times in (("a", 1), ("b", 0.95))]
        text = decisions_report.rates(found, risks)["finding"]
        self.assertNotIn("not parted", text)
        self.assertIn("do not part it from width 0.6\u00a0m, but the medians differ by more than chance", text)


class Pages(InFolder):
    def text(self, *folders):
        with support.words_alone():
            return html.unescape(page(read(folders)))

    def test_several_sweeps_stand_on_one_page_with_their_risks(self):
        folders = [self.design("a", 2.0), self.design("b", 3.0, width=0.9), make_decisions.make_risk(self.folder / "ra"),
                   make_decisions.make_risk(self.folder / "rb")]
        text = self.text(*folders)
        for words in ("width 0.6\u00a0m", "width 0.9\u00a0m", "1.50 times as large", "block.width_m", "Annual risk: refrigerator (out)", "Annual rates by design", "has the lowest annual rate of"):
            self.assertIn(words, text)
        self.assertEqual(text.count("<svg"), 3)
        self.assertNotIn("nan", text.split("<body>")[1].split("<svg")[0])

    def test_what_the_fits_warn_of_stands_on_the_page_but_for_other_demands(self):
        folders = [self.design("a", 2.0), self.design("b", 3.0, width=0.9)]
        path = folders[1] / "summary.json"
        summary = json.loads(path.read_text())
        lead, other = list(summary["edps"])[:2]
        summary["warnings"] = [f"{lead}: bins are empty.", f"{other}: bins are emptier."]
        path.write_text(json.dumps(summary))
        text = self.text(*folders)
        self.assertIn(f"Width 0.9\u00a0m: {lead}: bins are empty.", text)
        self.assertNotIn("emptier", text)

    def test_the_width_that_halves_a_rate_is_that_of_the_designs_which_the_risks_are_of(self):
        """In whatever order they are given; of risks that are of other sweeps nothing is said."""
        designs_ = [self.design("a", 2.0), self.design("b", 3.0, width=0.9)]
        def risk(folder, sweep, times=1):
            return make_decisions.make_risk(self.folder / folder, sweep=sweep, times=times)
        self.assertIn("No width from 0.6\u00a0m to 0.9\u00a0m halves the annual rate of", self.text(*designs_, risk("r1", "a"), risk("r2", "b")))
        half = self.text(*designs_, risk("r3", "b", 0.25), risk("r4", "a"))
        # 16 times less at 1.5 times the width: half at 1.5^(1/4) of it.
        self.assertIn(f"Width {0.6 * 1.5**0.25:.2f}\u00a0m", self.text(*designs_, risk("r5", "a"), risk("r6", "b", 0.0625)))
        self.assertIn("No width from 0.6\u00a0m to 0.9\u00a0m halves the annual rate of “overturned” of width 0.9\u00a0m", half)
        self.assertNotIn("halves", self.text(*designs_, risk("r7", "out"), risk("r8", "out")))

    def over(self, folder, im, unit):
        with h5py.File(folder / "fragility.h5", "a") as root:
            root.attrs.update(im=im, im_unit=unit, im_symbol="")
        return folder

    def test_one_sweep_over_two_intensities_stands_on_one_page(self):
        """Each over its own axis, with its unit; what the ranking says of them stands there once."""
        folders = [self.over(self.design("pga", 1.2), "pga_g", "g"), self.over(self.design("pgv", 2.3), "pgv_mps", "m/s")]
        results = read(folders)
        ranked = [{"im": im, "deviance_explained": value, "deviance_explained_se": 0.03, "behind_best": 0.63 - value, "behind_best_se": 0.02}
                  for im, value in (("pgv_mps", 0.63), ("pga_g", 0.54), ("pgd_m", 0.3))]
        results[0].sweeps[0].summary["ranking"] = {"demands": {"overturned": ranked}}
        drawn = pictures.draw(results[0])
        self.assertEqual([picture.name for picture in drawn], ["over_intensities", "intensities"])
        panels = [ax for ax in drawn[0].figure.axes if ax.get_visible()]
        self.assertEqual([ax.get_xlabel() for ax in panels], ["PGA (g)", "PGV (m/s)"])
        for ax, median in zip(panels, (1.2, 2.3)):
            curve = next(line for line in ax.lines if line.get_label() == "overturned")
            self.assertAlmostEqual(float(np.interp(median, *curve.get_data())), 0.5, delta=0.01)
        self.assertEqual(overlaps(drawn[0].figure), [])
        bold = [label.get_text() for label in drawn[1].figure.axes[0].get_yticklabels() if label.get_weight() == "bold"]
        self.assertEqual(bold, ["PGV", "PGA"])
        text = self.text(*folders, make_decisions.make_risk(self.folder / "r", sweep="pga"))
        for words in ("half of the specimens overturn at PGA\u00a0=\u00a01.2\u00a0g and PGV\u00a0=\u00a02.3\u00a0m/s", "over PGA and PGV",
                      "Annual risk: refrigerator (pga)", "2.30 ± 0.1", "PGV (m/s)</td>"):
            self.assertIn(words, text)
        self.assertEqual(text.count("<svg"), 2)
        self.assertNotIn("nan", text.split("<body>")[1].split("<svg")[0])

    def test_periods_of_one_measure_are_several_intensities(self):
        folders = [self.over(self.design(name, 1.2), "sa_g", "g") for name in ("short", "long")]
        for folder, period in zip(folders, (0.2, 1.0)):
            path = folder / "summary.json"
            path.write_text(json.dumps({**json.loads(path.read_text()), "im_period_s": period}))
        self.assertIn("over Sa(0.2\u00a0s) and Sa(1\u00a0s)", self.text(*folders))
        with self.assertRaisesRegex(Problem, "sa_g:0.2 and .* over sa_g:1"):
            self.sweeps(*folders)

    def test_several_designs_over_several_intensities_stand_on_one_page(self):
        def both(name, median, width):
            first = self.design(name, median, width=width)
            second = self.over(self.design(name + "_pga", 2 * median, width=width), "pga_g", "g")
            return first, second
        narrow, wide = both("narrow", 1.2, 0.6), both("wide", 1.8, 0.9)
        text = self.text(narrow[0], wide[0], narrow[1], wide[1])
        for words in ("Medians, over PTA/(μg)\u00a0−\u00a01", "Medians, over PGA", "median PGA of overturning: width 0.9\u00a0m", "width 0.9\u00a0m, over PGA"):
            self.assertIn(words, text)
        found = page(read([narrow[0], wide[0], narrow[1], wide[1]]))
        self.assertEqual([found.count(f'id="designs-{im}-clip') > 0 for im in ("report", "pga-g")], [True, True])
        # Which one is better stands there by the ranking of each design, what all of them warn of once.
        results = read([narrow[0], wide[0], narrow[1], wide[1]])
        self.assertIsNone(best_intensity.table(results))
        for value, sweep in zip((0.6, 0.7), results[0].sweeps):
            ranked = [("pgd_m", 0.8), ("report", value), ("pga_g", 0.65)]
            sweep.summary["ranking"] = {"demands": {sweep.edps[0].name: [
                {"im": im, "deviance_explained": share, "deviance_explained_se": 0.02, "scatter": 1 - share, "scatter_se": 0.02} for im, share in ranked]}}
        told = best_intensity.table(results)
        self.assertEqual([row["best"].split(":")[0] for row in told["rows"]], ["PGD", "PGD"])
        self.assertRegex(told["finding"], "depends on the design: PGA for width 0.6\u00a0m and PTA/.* for width 0.9")
        results[0].sweeps[0].summary["ranking"]["demands"][results[0].sweeps[0].edps[0].name][2].update(deviance_explained=0.5, scatter=0.5)
        self.assertRegex(best_intensity.table(results)["finding"], "^PTA/.* better than PGA, in each of the designs; by no more than two standard errors for width 0.9")
        for one in results:
            for sweep in one.sweeps:
                sweep.summary["warnings"] = ["few motions"]
        results[0].sweeps[0].summary["warnings"].append("odd")
        told = decisions_report._warnings(results)
        self.assertEqual(told, ["Few motions", "Width 0.6\u00a0m, over PTA/(μg)\u00a0−\u00a01: odd"])
        with self.assertRaisesRegex(Problem, "every design over every intensity"):
            read([narrow[0], wide[0], narrow[1]])

    def test_other_intensities_of_other_designs_do_not_fit_into_one_axis(self):
        other = self.over(self.design("b", 3.0, width=0.9), "pga_g", "g")
        done = support.run("report", self.design("a", 2.0), other)
        self.assertEqual(done.returncode, 2)
        self.assertIn("do not fit into one axis", done.stderr)

    def test_a_sweep_shows_its_risk_and_its_shares(self):
        sweep = make_decisions.make_sensitivity(support.sweep_copy(self.folder / "a"))
        text = self.text(sweep, make_decisions.make_risk(self.folder / "risk"))
        for words in ("Annual risk", "3.1×10⁻⁴", "71 % of the rate may come from", "What the scatter is owed to", "0.45", "fewer than 30",
                      "Peak acceleration explains 45 % of the scatter of the largest slip"):
            self.assertIn(words, text)

    def test_a_risk_stands_alone(self):
        text = self.text(make_decisions.make_risk(self.folder / "risk"))
        self.assertNotIn("–\u00a0g", text)  # an intensity that is not known has no unit
        self.assertIn("The chance that the specimen is overturned in 50 years is 1.5 %", text)

    def test_shares_without_totals_have_no_points(self):
        folder = self.folder / "only"
        folder.mkdir()
        text = self.text(make_decisions.make_sensitivity(folder, pairs=0))
        self.assertNotIn("Open points", text)

    def shares(self, change):
        """Page and picture of invented shares of which `change` has changed the answers."""
        folder = self.folder / "changed"
        folder.mkdir(exist_ok=True)
        path = make_decisions.make_sensitivity(folder) / "sensitivity.json"
        found = json.loads(path.read_text())
        change(found["answers"])
        path.write_text(json.dumps(found))
        return page(read([folder])), pictures.draw(read([folder])[0])[0]

    @staticmethod
    def part(value, se):
        return {"value": value, "se": se, "lower": value - 2 * se, "upper": value + 2 * se}

    def test_shares_are_shown_as_they_are_and_no_finer_than_a_thousandth(self):
        """A share below none is noise or bias, which a reader must see; a total above all likewise."""
        def change(answers):
            answers[0]["shares"]["block.width_m"] = {"share": self.part(-0.0196, 0.0017), "total": self.part(1.24e-6, 2.4e-7), "pairs": 100}
            answers[0]["shares"]["motion"] = {"share": self.part(0.2, 0.01), "total": self.part(1.04, 0.09), "pairs": 100}
        text, picture = self.shares(change)
        self.assertIn("−0.020 ± 0.002 (&lt; 0.001)", text.replace("<td>", ""))
        self.assertIn("0.20 ± 0.01 (1.04 ± 0.09)", text)
        self.assertNotIn("0.000001", text)
        ax = picture.figure.axes[0]
        widths = [bar.get_width() for bar in ax.patches]
        self.assertAlmostEqual(min(widths), -0.0196)
        self.assertLess(ax.get_xlim()[0], -0.0229)
        self.assertGreater(ax.get_xlim()[1], 1.04 + 0.01)

    def test_what_lacks_to_one_is_of_parameters_together_only_beyond_its_error(self):
        def together(value, se):
            def change(answers):
                for answer in answers:
                    if answer["shares"]:
                        answer["together"] = self.part(value, se)
            return change
        text, picture = self.shares(together(0.7, 0.02))
        self.assertIn("is due to parameters that act together", picture.caption)
        self.assertIn(picture.caption[:40], text)
        for value, se in ((0.97, 0.02), (1.01, 0.02)):
            self.assertNotIn("act together", self.shares(together(value, se))[1].caption)
        def one(answers):
            together(0.97, 0.02)(answers)
            answers[0]["together"] = self.part(0.7, 0.02)
        self.assertIn("of ln of the largest slip lack to 1", self.shares(one)[1].caption.replace(" U ", " "))

    def test_no_parameter_is_said_to_explain_what_chance_does(self):
        def change(answers):
            for share in answers[0]["shares"].values():
                share["share"] = self.part(0.01, 0.02)
        self.assertIn("No parameter alone explains", self.shares(change)[1].finding)

    def test_a_file_of_another_format_or_a_spoilt_one_is_told(self):
        folder = make_decisions.make_risk(self.folder / "risk")
        path = folder / "risk.json"
        path.write_text(path.read_text().replace("freestand-risk/1", "freestand-risk/9"))
        self.assertIn("freestand-risk/9", support.run("report", folder).stderr)
        path.write_text(path.read_text().replace("freestand-risk/9", "freestand-risk/1").replace('"im_edge"', '"im_edges"'))
        done = support.run("report", folder)
        self.assertEqual(done.returncode, 3)
        self.assertIn("lacks what a risk needs", done.stderr)


class NoRate(InFolder):
    def test_a_risk_without_any_rate_has_no_picture(self):
        folder = make_decisions.make_risk(self.folder / "risk")
        found = json.loads((folder / "risk.json").read_text())
        found["demands"] = [one for one in found["demands"] if one["refused"]]
        (folder / "risk.json").write_text(json.dumps(found))
        results = read([folder])
        self.assertEqual([picture for result in results for picture in pictures.draw(result)], [])
        self.assertIn("71 %", page(results))


if __name__ == "__main__":
    unittest.main()
