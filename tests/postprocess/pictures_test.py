#!/usr/bin/python3
"""Every picture: it is drawn, says what it shows, names its axes, and no two of its texts overlap or leave the page."""
import pathlib
import tempfile
import unittest
from unittest import mock

import support
from support import make_results

import h5py
import numpy as np
from freestand_post import pictures, reading, style, words
from freestand_post.pictures import intensities, overturning, surface
from matplotlib.text import Text


def texts(figure):
    """Texts that are drawn, with their boxes in pixels. Contour labels stand on their lines and are left out."""
    drawn, draw = [], Text.draw

    def record(self, renderer, *arguments, **options):
        drawn.append(self)
        return draw(self, renderer, *arguments, **options)

    with mock.patch.object(Text, "draw", record):
        figure.draw_without_rendering()  # lays it out, once, as savefig does
    renderer = figure.canvas.get_renderer()
    for text in drawn:
        if text.get_text().strip() and text.get_visible() and text.get_rotation() in (0, 90):
            yield text.get_text(), text.get_window_extent(renderer)


def overlaps(figure):
    found, seen = [], list(texts(figure))
    for i, (a, box_a) in enumerate(seen):
        for b, box_b in seen[i + 1:]:
            x = min(box_a.x1, box_b.x1) - max(box_a.x0, box_b.x0)
            y = min(box_a.y1, box_b.y1) - max(box_a.y0, box_b.y0)
            if x > 1.0 and y > 1.5:
                found.append((a, b))
    width, height = figure.get_size_inches() * figure.dpi
    found += [(a, "edge of the page") for a, box in seen
              if box.x0 < -1 or box.y0 < -1 or box.x1 > width + 1 or box.y1 > height + 1]
    return found


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        style.apply()
        sweep = reading.read_sweep(support.sweep())
        sweep.edps[1].axes = sweep.edps[1].axes[1:]
        cls.drawn = {picture.name: picture for picture in pictures.draw(sweep)}
        with tempfile.TemporaryDirectory() as folder:
            for name, overturned in (("stands", False), ("falls", True)):
                history = reading.read_history(make_results.make_history(pathlib.Path(folder) / name, overturned))
                (picture,) = pictures.draw(history)
                cls.drawn[name] = picture

    def test_all_are_there(self):
        per_edp = ["fragility_{}", "surface_{}", "axis_{}_friction_mu_k", "axis_{}_pulse_period_s", "goodness_{}"]
        expected = {form.format(edp) for edp in ("delta", "peak_rotation_over_alpha") for form in per_edp}
        expected.remove("axis_peak_rotation_over_alpha_friction_mu_k")
        self.assertEqual(set(self.drawn), expected | {"overturning", "happening_connection_failed", "coverage", "stands", "falls"})

    def test_no_two_texts_overlap(self):
        for name, picture in self.drawn.items():
            with self.subTest(name):
                self.assertEqual(overlaps(picture.figure), [])

    def test_the_check_of_overlaps_sees_one(self):
        figure = style.figure(4, 3)
        figure.text(0.5, 0.5, "first text")
        figure.text(0.52, 0.51, "second text")
        figure.text(0.98, 0.1, "runs off the page")
        self.assertEqual(overlaps(figure), [("first text", "second text"), ("runs off the page", "edge of the page")])

    def test_finding_and_caption_are_sentences(self):
        for name, picture in self.drawn.items():
            with self.subTest(name):
                self.assertGreater(len(picture.finding), 15)
                self.assertNotIn("nan", picture.finding.lower().split())
                self.assertTrue(picture.caption.endswith("."))
                self.assertNotIn("{", picture.caption)

    def test_a_surface_that_overturning_lifts_over_all_capacities_says_so(self):
        sweep = mock.Mock(centre=np.array([0.2, 0.6]), im_unit="g")
        edp = mock.Mock(unit="m", label="U", bins={"n": np.array([9, 9]), "n_over": np.array([0, 6])})
        edp.name = "peak_slip_m"
        for over, said in ((0.7, "they overturn"), (0.3, "Nowhere do half")):
            p = np.array([[0.1, 0.05], [over + 0.01, over]])
            self.assertIn(said, surface._finding(sweep, edp, "U", "PGA", p, np.array([0.1, 0.2])))

    def test_where_all_specimens_fall_titles_say_so(self):
        sweep = mock.Mock(centre=np.array([0.2, 0.6]), edge=np.array([0.1, 0.4, 0.8]), im_unit="g")
        fell = {"n": np.array([9, 9]), "n_over": np.array([9, 9]), "p_over": np.array([1.0, 1.0])}
        edp = mock.Mock(unit="1", label="θ/α", bins=fell)
        nothing = np.full((2, 2), np.nan)
        self.assertEqual(surface._finding(sweep, edp, "θ/α", "PGA", nothing, np.array([0.1, 0.2])),
                         "All specimens overturn, and so exceed every θ/α")
        self.assertEqual(overturning._finding(sweep, fell, {}, False, "PGA"), "100 % of the specimens fall at every intensity swept")

    def test_overturning_is_told_by_counted_shares_where_the_curve_is_refuted(self):
        sweep = mock.Mock(centre=np.array([0.2, 0.6, 1.0]), edge=np.array([0.1, 0.4, 0.8, 1.2]), im_unit="g")
        bins = {"n_over": np.array([0, 4, 4]), "p_over": np.array([0.0, 0.43, 0.43])}
        curve = {"median": 1.0, "adequate": False}
        self.assertRegex(overturning._finding(sweep, bins, curve, True, "PGA"), "^43.% of the specimens fall at the end of the range swept")
        self.assertIn("By the fitted curve, half", overturning._finding(sweep, bins, {**curve, "adequate": True}, True, "PGA"))

    def test_units_are_read_off_names(self):
        for name, found in (("rate_per_s", ("rate", "1/s")), ("peak_chain_force_n", ("peak_chain_force", "N")), ("stiffness_npm", ("stiffness", "N/m")),
                            ("width_m", ("width", "m")), ("mu_k", ("mu_k", ""))):
            self.assertEqual(words.split_unit(name), found)
        self.assertEqual(words.beyond("peak_chain_force_n", "F", "500 N"), "pull at a chain by more than 500 N")

    def test_outer_axes_are_named(self):
        for name, picture in self.drawn.items():
            labels = [axes.get_xlabel() for axes in picture.figure.axes] + [axes.get_ylabel() for axes in picture.figure.axes]
            with self.subTest(name):
                self.assertGreaterEqual(sum(bool(label) for label in labels), 2, labels)

    def test_units_stand_on_the_axes(self):
        labels = {axes.get_ylabel() for axes in self.drawn["stands"].figure.axes}
        self.assertLessEqual({"floor acc. (g)", "slip (cm)", "rotation (°)"}, labels)
        labels = {axes.get_ylabel() for axes in self.drawn["axis_delta_pulse_period_s"].figure.axes}
        self.assertIn("pulse period (s)", labels)

    def test_the_curve_is_the_surface_in_the_file(self):
        sweep = reading.read_sweep(support.sweep())
        lines = [line.get_ydata() for line in self.drawn["fragility_delta"].figure.axes[0].get_lines()]
        for k in range(4):
            wanted = sweep.edps[0].surface["probability"][:, k]
            self.assertTrue(any(len(y) == len(wanted) and np.array_equal(y, wanted, equal_nan=True) for y in lines), k)

    def test_intensities_stand_in_their_order_with_the_best_ones_filled(self):
        def row(im, value, se, behind, p=0.5, key="scatter"):
            return {"im": im, key: value, f"{key}_se": se, "behind_best": behind, "behind_best_se": 0.02, "sufficiency": [{"on": "record_pulse_period_s", "p": p}]}

        sweep = reading.read_sweep(support.sweep())
        own = sweep.im_name
        slip = [row("pgv_mps", 0.4, 0.02, 0), row("housner_m", 0.43, 0.03, 0.03, p=0.001), row(own, 0.7, 0.05, 0.3), row("pgd_m", None, None, None)]
        falls = [row("pgv_mps", 0.5, 0.02, 0, key="deviance_explained"), row(own, 0.2, 0.02, 0.3, key="deviance_explained")]
        overturned = mock.Mock(kind="binary", label="overturned")
        overturned.name = "overturned"
        sweep.edps[:] = [sweep.edps[0], overturned]
        sweep.summary["ranking"] = {"demands": {sweep.edps[0].name: slip, "overturned": falls}}
        (picture,) = intensities.pictures(sweep)
        left, right = picture.figure.axes
        self.assertEqual(overlaps(picture.figure), [])
        points = [line for line in left.get_lines() if line.get_marker() == "o"]
        marks = {(float(line.get_xdata()[0]), float(line.get_ydata()[0])): line for line in points if line.get_markersize() == 6}
        self.assertEqual(sorted(marks), [(0.4, 0), (0.43, -1), (0.7, -2)])  # what is not known has no point
        filled = {at: line.get_markerfacecolor() != "white" for at, line in marks.items()}
        self.assertEqual(filled, {(0.4, 0): True, (0.43, -1): True, (0.7, -2): False})
        rings = [(float(line.get_xdata()[0]), float(line.get_ydata()[0])) for line in points if line.get_markersize() == 12]
        self.assertEqual(rings, [(0.43, -1)])
        bold = [label.get_text() for label in left.get_yticklabels() if label.get_weight() == "bold"]
        self.assertEqual(bold, [words.intensity(own)])
        self.assertGreater(right.get_xlim()[0], right.get_xlim()[1])  # the best at the left in both
        self.assertIn("0.4", picture.finding)
        self.assertNotIn("Of the first", picture.caption)
        sweep.summary["ranking"].update(samples=65536, swept=100000)
        self.assertIn("Of the first 65\u202f536 samples", next(intensities.pictures(sweep)).caption)
        self.assertIn(words.intensity("pgv_mps"), picture.finding)
        # The demand that the study names first is the title's; what is not parted from the best has its number all the same.
        sweep.edps.reverse()
        falls[1]["behind_best"], falls[1]["behind_best_se"] = 0.3, 0.2
        (picture,) = intensities.pictures(sweep)
        self.assertIn("parts best what happened (overturned) (0.50)", picture.finding)
        self.assertIn(f"{words.intensity(own)} (0.20) no worse", picture.finding)
        self.assertIn("deviance explained", picture.figure.axes[0].get_xlabel())

    def test_half_is_where_the_title_says(self):
        sweep = reading.read_sweep(support.sweep())
        title = self.drawn["fragility_delta"].finding
        p = sweep.edps[0].surface["probability"][:, 2]
        at = float(title.rsplit(" ", 1)[1])
        self.assertIn("Δ\u00a0=\u00a02 ", title)
        self.assertAlmostEqual(np.interp(at, sweep.centre, p), 0.5, delta=0.02)

    def test_bins_stand_at_the_mean_of_their_samples(self):
        with h5py.File(support.sweep() / "samples.h5") as samples, h5py.File(support.sweep() / "fragility.h5") as root:
            im = samples["samples/pta_g"][()] / samples["samples/friction_mu_k"][()] - 1
            edge = root["im/edge"][()]
            usable = samples["samples/outcome"][()] <= 2
        sweep = reading.read_sweep(support.sweep())
        means = [im[usable & (im >= low) & (im < high)].mean() for low, high in zip(edge[:-1], edge[1:])]
        np.testing.assert_allclose(sweep.centre, means, rtol=1e-12)
        for name in ("fragility_delta", "happening_connection_failed"):
            lines = [line.get_xdata() for line in self.drawn[name].figure.axes[0].get_lines()]
            self.assertTrue(any(len(x) == len(means) and np.array_equal(x, sweep.centre) for x in lines), name)

    def test_what_happens_or_not_is_drawn(self):
        picture = self.drawn["happening_connection_failed"]
        self.assertTrue(picture.finding.startswith("The connection fails in "), picture.finding)
        share = reading.read_sweep(support.sweep()).happenings()[0].surface["probability"][:, 0]
        lines = [line.get_ydata() for line in picture.figure.axes[0].get_lines()]
        self.assertTrue(any(len(y) == len(share) and np.array_equal(y, share, equal_nan=True) for y in lines))

    def test_intervals_are_called_what_they_are(self):
        sweep = reading.read_sweep(support.sweep())
        sweep.attributes["confidence"] = 0.9
        sweep.edps[0].axes = sweep.edps[0].axes[:1]
        sweep.edps = [edp for edp in sweep.edps if edp.name != "peak_rotation_over_alpha"]
        for picture in pictures.draw(sweep):
            said = " ".join([picture.caption, *style.take_headline(picture.figure)])
            with self.subTest(picture.name):
                self.assertNotIn("95 %", said)
                if picture.name.startswith(("fragility", "axis", "overturning", "happening")):
                    self.assertIn("90 %", said)

    def test_misfit_and_extrapolation_of_the_overturning_curve_are_told(self):
        sweep = reading.read_sweep(support.sweep())
        self.assertIn("misses the counted shares by up to 0.08", self.drawn["overturning"].caption)
        sweep.overturning.update(extrapolated=True, misfit_p=0.01)
        (picture,) = [picture for picture in pictures.draw(sweep) if picture.name == "overturning"]
        self.assertIn("one curve is too simple", picture.caption)
        self.assertIn("an extrapolation", style.take_headline(picture.figure)[1])

    def test_medians_by_curve_and_by_counts_are_told_apart(self):
        sweep = reading.read_sweep(support.sweep())
        bins = next(edp.bins for edp in sweep.edps if edp.name == "overturned")
        bins["p_over"][:] = np.linspace(0, 0.96, bins["p_over"].size)
        (picture,) = [picture for picture in pictures.draw(sweep) if picture.name == "overturning"]
        said = " ".join(style.take_headline(picture.figure))
        half = words.quantity(np.interp(0.5, bins["p_over"], sweep.centre), sweep.im_unit)
        self.assertIn(f"the counted shares reach one half at {half}", said)
        self.assertIn("motions as the unit", picture.caption)
        self.assertNotIn("bars: exact", picture.caption + said)

    def test_failed_bins_are_marked(self):
        sweep = reading.read_sweep(support.sweep())
        failed = int((sweep.edps[0].bins["status"] == 2).sum())
        self.assertGreater(failed, 0)
        titles = [axes.get_title(loc="left") for axes in self.drawn["goodness_delta"].figure.axes]
        self.assertEqual(sum("fails" in title for title in titles), failed)
        unproven = int((sweep.edps[0].bins["status"] == 4).sum())
        self.assertIn(f"in {unproven} it is not refuted, but may be off by more", self.drawn["goodness_delta"].finding)
        marks = len([line for line in self.drawn["surface_delta"].figure.axes[0].lines if line.get_marker() == "v"])
        self.assertEqual(marks, failed + unproven)
        shown = " ".join(text for text, _ in texts(self.drawn["goodness_delta"].figure))
        self.assertIn("S = ", shown)
        self.assertIn("p* ", shown)

    def test_counted_distributions_are_told_to_be_taken_to_the_mean_intensity(self):
        """src/fragility/tally.cpp counts residuals: where the demand rises within a bin, they are not the shares counted in it."""
        for name in ("surface_delta", "goodness_delta"):
            self.assertIn("taken along the bin's slope to its mean intensity", self.drawn[name].caption)

    def test_the_fall_is_told(self):
        self.assertTrue(self.drawn["falls"].finding.startswith("Overturns at "))
        self.assertIn("comes to rest", self.drawn["stands"].finding)


class MissingPieces(unittest.TestCase):
    """Pictures of poor results: nothing breaks, nothing is invented."""

    def setUp(self):
        style.apply()
        self.sweep = reading.read_sweep(support.sweep())
        self.sweep.edps = [edp for edp in self.sweep.edps if edp.name != "peak_rotation_over_alpha"]
        self.sweep.edps[0].axes = self.sweep.edps[0].axes[:1]
        self.draws, self.sweep.draws = self.sweep.draws, {}

    def draw(self):
        drawn = {picture.name: picture for picture in pictures.draw(self.sweep)}
        for picture in drawn.values():
            style.svg(picture.figure)
        return drawn

    def test_no_bin_has_enough_samples(self):
        edp = self.sweep.edps[0]
        for name in edp.bins:
            if name not in ("n", "n_still", "n_over", "n_moved"):
                edp.bins[name] = np.full_like(edp.bins[name], np.nan)
        edp.bins["status"][:] = 1
        for table in (*edp.surface.values(), edp.axes[0].probability, edp.axes[0].lower, edp.axes[0].upper):
            table[:] = np.nan
        drawn = self.draw()
        self.assertIn("Too few", drawn["fragility_delta"].finding)
        self.assertIn("Too few", drawn["surface_delta"].finding)
        self.assertIn("Too few", drawn["axis_delta_friction_mu_k"].finding)
        self.assertNotIn("goodness_delta", drawn)

    def test_empty_bins_single_bin_and_nothing_overturned(self):
        edp, _, binary = self.sweep.edps
        binary.bins["n_over"][:] = 0
        for name in ("p_over", "p_over_lower", "p_over_upper"):
            binary.bins[name][:] = 0.0
        self.sweep.overturning = {}
        self.sweep.outcome[self.sweep.outcome == 2] = 1
        keep = int(np.flatnonzero(edp.bins["status"] == 0)[0])
        for i in range(edp.bins["n"].size):
            if i != keep:
                edp.bins["status"][i] = 1
                edp.bins["n"][i] = edp.bins["n_still"][i] = edp.bins["n_moved"][i] = edp.bins["n_over"][i] = 0
                for table in edp.surface.values():
                    table[i] = np.nan
        drawn = self.draw()
        self.assertEqual(drawn["overturning"].finding, "No specimen overturned in the range swept")
        self.assertIn("the one bin", drawn["goodness_delta"].finding)

    def test_without_draws_and_without_edps(self):
        self.sweep.outcome = np.zeros(0, int)
        self.sweep.edps = []
        self.assertEqual(self.draw(), {})

    def test_one_draw_and_missing_values(self):
        period = self.draws["pulse_period_s"]
        period[::2] = np.nan  # recorded motions have no period
        self.sweep.draws = {"pulse_period_s": period}
        self.sweep.edps = []
        self.assertEqual(set(self.draw()), {"coverage"})


if __name__ == "__main__":
    unittest.main()
