#!/usr/bin/python3
"""Several designs side by side: what they are called by, whether their medians differ, and where a curve or the sweep ends."""
import unittest

import support  # noqa: F401

import h5py
import numpy as np
from freestand_post import decisions_report, designs, over_intensities, pictures, style
from freestand_post.command import read
from make_decisions import InFolder
from pictures_test import overlaps


class Labels(InFolder):
    def test_designs_are_called_by_what_their_studies_differ_in(self):
        found = self.sweeps(self.design("a", 2.0), self.design("b", 3.0, width=0.9))
        self.assertEqual(found.labels, ["width 0.6\u00a0m", "width 0.9\u00a0m"])
        self.assertEqual(found.differing, [("block.width_m", ["0.6", "0.9"])])

    def test_distributions_and_several_keys(self):
        found = self.sweeps(self.design("a", 2.0), self.design("b", 3.0, width="{uniform: [0.5, 0.9]}", mu="{lognormal: {median: 0.2, dispersion: 0.3}}"))
        self.assertEqual(found.labels[1], "width 0.5 to 0.9\u00a0m, friction coefficient μk 0.2 (dispersion 0.3)")

    def test_what_one_has_and_the_other_has_not_is_one_word(self):
        chain = "chain: {slack_m: 0.02, stiffness_npm: 4e5, strength_n: 2700}\n"
        found = self.sweeps(self.design("a", 2.0), self.design("b", 3.0, chain=chain))
        self.assertEqual(found.labels, ["without chain", "with chain"])

    def test_the_same_study_goes_by_its_folder(self):
        found = self.sweeps(self.design("a", 2.0), self.design("b", 2.0))
        self.assertEqual((found.labels, found.differing), (["a", "b"], []))


class Differences(InFolder):
    def test_pairs_see_a_difference_that_independent_samples_do_not(self):
        """Both medians scatter by 10 % with the motions, but by 1 % against each other: 5 % are beyond chance in pairs alone."""
        first = self.design("a", 2.0)
        paired = self.sweeps(first, self.design("b", 2.1, width=0.9, of_own=1))
        self.assertTrue(paired.paired)
        row = paired.rows[0]
        self.assertEqual((row.what, designs.verdict(row.ratio[1])), ("overturning", "yes"))
        value, low, high = row.ratio[1]
        self.assertAlmostEqual(value, 1.05, delta=1e-9)
        self.assertAlmostEqual(np.log(high / low), 2 * 1.96 * 0.01 * np.sqrt(2), delta=0.01)
        other = self.sweeps(first, self.design("c", 2.1, width=0.9, of_own=1, seed=2))
        self.assertFalse(other.paired)
        self.assertEqual(designs.verdict(other.rows[0].ratio[1]), "no")
        value, low, high = other.rows[0].ratio[1]
        self.assertAlmostEqual(np.log(high / low), 2 * 1.96 * 0.1 * np.sqrt(2), delta=0.08)

    def test_every_common_capacity_has_its_row(self):
        found = self.sweeps(self.design("a", 2.0), self.design("b", 3.0, width=0.9))
        self.assertEqual(len([row for row in found.rows if row.what.startswith("dimensionless")]), len(found.sweeps[0].edps[0].capacity))
        self.assertTrue(all(abs(row.ratio[1][0] - 1.5) < 1e-9 for row in found.rows))


class BeyondTheSweep(InFolder):
    """A median beyond what was swept is an extrapolation: no headline, no title and no factor rests on it."""

    def beyond(self, *arguments, **more):
        folder = self.design(*arguments, **more)
        with h5py.File(folder / "fragility.h5", "a") as root:
            root["overturning"].attrs["extrapolated"] = 1
        return folder

    def made(self, *folders):
        results = read([*folders])
        (picture,) = pictures.draw(results[0])
        return decisions_report.designs(results, [], [{"section": "designs"}]), picture.finding, results[0].sweeps[0].edge[-1]

    def test_of_all_but_the_first(self):
        content, finding, end = self.made(self.design("a", 2.0), self.beyond("b", 9.0, width=0.9), self.beyond("c", 44.0, width=1.2))
        self.assertEqual([number for number, _ in content["headline"]], ["2.0", f"> {end:.4g}", f"> {end:.4g}"])
        self.assertIn("of overturning lies outside of what was swept for width 0.9\u00a0m and width 1.2\u00a0m", finding)
        self.assertNotIn("22", finding)
        rows = [row for row in content["parts"][0]["medians"][:3]]
        self.assertEqual([row["ratio"] for row in rows], ["", "4.50*", "22.00*"])

    def test_of_one_of_them(self):
        content, finding, _ = self.made(self.design("a", 2.0), self.design("b", 3.0, width=0.9), self.beyond("c", 44.0, width=1.2))
        self.assertIn("Width 0.9\u00a0m against width 0.6\u00a0m: the median PTA/(μg)\u00a0−\u00a01 of overturning is 1.50 times as large", finding)
        self.assertIn("of width 1.2\u00a0m it lies outside of what was swept", finding)

    def test_of_all_of_them_another_demand_is_compared(self):
        _, finding, _ = self.made(self.beyond("a", 22.0), self.beyond("b", 44.0, width=0.9))
        self.assertNotIn("overturning", finding)

    def test_over_several_intensities(self):
        folders = [self.beyond("pga", 44.0), self.design("pgv", 2.3)]
        for folder, im, unit in zip(folders, ("pga_g", "pgv_mps"), ("g", "m/s")):
            with h5py.File(folder / "fragility.h5", "a") as root:
                root.attrs.update(im=im, im_unit=unit, im_symbol="")
        results = read(folders)
        end = results[0].sweeps[0].edge[-1]
        self.assertEqual([number for number, _ in over_intensities.content(results[0], [], [])["headline"]], [f"> {end:.4g}\u00a0g", "2.3\u00a0m/s"])
        self.assertNotIn("44", pictures.draw(results[0])[0].finding)


class WhereACurveDoesNotHold(InFolder):
    """What counts is where the counted shares reach one half: in headline, title, ratio, and what is beyond chance."""

    def refuted(self, name, median, half, **more):
        """A design whose curve misses its counted shares, which rise evenly through one half at `half`."""
        folder = self.design(name, median, **more)
        with h5py.File(folder / "fragility.h5", "a") as root:
            root["overturning"].attrs["adequate"] = 0
            root["edp/overturned/p_over"][:] = np.clip(0.5 + 0.2 * (root["im/centre"][()] - half), 0, 1)
        return folder

    def test_of_several_designs(self):
        folders = [self.refuted("a", 2.0, 1.6), self.refuted("b", 3.0, 2.2, width=0.9)]
        results = read(folders)
        (picture,) = pictures.draw(results[0])
        content = decisions_report.designs(results, [], [{"section": "designs"}])
        self.assertEqual([(number, what.split(": ")[0].split("of ")[1]) for number, what in content["headline"]],
                         [("1.6", "overturning, counted"), ("2.2", "overturning, counted")])
        self.assertIn("at which the counted shares of overturning reach one half is 1.38 times as large", picture.finding)
        first, second = content["parts"][0]["medians"][:2]
        self.assertEqual((first["counted"], second["counted"], second["ratio"], second["interval"], second["verdict"]),
                         ("1.60", "2.20", "1.38†", "", "not known"))
        self.assertTrue(second["median"].endswith("†"))

    def test_of_one_that_holds_and_one_that_falls_nowhere(self):
        results = read([self.design("a", 2.0), self.refuted("b", 3.0, 90, width=0.9)])
        content = decisions_report.designs(results, [], [{"section": "designs"}])
        end = results[0].sweeps[0].edge[-1]
        self.assertEqual([number for number, _ in content["headline"]], ["2.0", f"> {end:.4g}"])
        self.assertEqual(content["parts"][0]["medians"][1]["ratio"], "–")

    def test_over_several_intensities(self):
        folders = [self.design("pga", 1.2), self.refuted("pgv", 2.3, 1.7)]
        for folder, im, unit in zip(folders, ("pga_g", "pgv_mps"), ("g", "m/s")):
            with h5py.File(folder / "fragility.h5", "a") as root:
                root.attrs.update(im=im, im_unit=unit, im_symbol="")
        results = read(folders)
        self.assertEqual(over_intensities.content(results[0], [], [])["headline"],
                         [("1.2\u00a0g", "median PGA of overturning"), ("1.7\u00a0m/s", "median PGV of overturning, counted")])
        self.assertRegex(pictures.draw(results[0])[0].finding, "counted shares where these do not hold, .* PGA\u00a0=\u00a01.2\u00a0g and PGV\u00a0=\u00a01.7")


class Legend(InFolder):
    def test_every_row_of_the_legend_has_its_room(self):
        """Five designs take two rows of short names, five rows of long ones."""
        style.apply()
        for mu in (0.3, "{lognormal: {median: 0.2, dispersion: 0.3}}"):
            folders = [self.design(f"{i}{mu}"[:6], 2 + 0.2 * i, width=0.5 + 0.1 * i, mu=0.3 if i == 0 else mu) for i in range(5)]
            (picture,) = pictures.draw(self.sweeps(*folders))
            with self.subTest(mu):
                self.assertEqual(overlaps(picture.figure), [])
                style.take_headline(picture.figure)
                self.assertEqual(overlaps(picture.figure), [])


if __name__ == "__main__":
    unittest.main()
