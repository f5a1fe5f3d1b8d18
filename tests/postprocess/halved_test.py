#!/usr/bin/python3
"""The value of a key that halves an annual rate, between the designs of a page."""
import types
import unittest

import support  # finds the pages' package, or skips
import numpy as np
from freestand_post import halved


class Halved(unittest.TestCase):
    """Rates that fall as the width to the power -4 halve at 2^(1/4) of it."""

    def sentences(self, widths, rate, band=1.2):
        row = lambda value: types.SimpleNamespace(title="overturned", rate=(value, value / band, value * band))
        tables = [{"overturned": row(rate(float(width)))} for width in widths]
        found = types.SimpleNamespace(differing=[("block.width_m", list(widths))], labels=list(widths))
        return halved.halving(found, found.labels, ["overturned"], tables)

    def test_the_width_that_halves_the_rate(self):
        (text,) = self.sentences(["0.6", "0.7", "0.9"], lambda width: width**-4)
        self.assertIn(f"{0.6 * 2**0.25:.2f}\u00a0m", text)
        # The band of the others, on a line from the first one's rate: ln 2 falls to ln 2 - 4 ln(0.7/0.6) - ln 1.2 where the low end lies.
        drop = 4 * np.log(0.7 / 0.6) + np.log(1.2)
        self.assertIn(f"({0.6 * (0.7 / 0.6)**(np.log(2) / drop):.2f} to {0.6 * (2 * 1.2)**0.25:.2f})", text)
        self.assertIn("of width 0.6\u00a0m", text)

    def test_a_band_that_goes_beyond_the_designs_has_a_number_all_the_same(self):
        (text,) = self.sentences(["0.6", "0.75"], lambda width: width**-4, 1.4)
        drop = 4 * np.log(0.75 / 0.6) + np.log(1.4)
        self.assertIn(f"({0.6 * (0.75 / 0.6)**(np.log(2) / drop):.2f} to beyond 0.75\u00a0m, the largest of the designs) halves", text)
        (text,) = self.sentences(["0.9", "0.7"], lambda width: width**4, 1.8)
        self.assertIn("(below 0.7\u00a0m, the smallest of the designs, to 0.8", text)

    def test_where_no_design_goes_so_far_it_says_so(self):
        (text,) = self.sentences(["0.6", "0.65"], lambda width: width**-4)
        self.assertTrue(text.startswith("No width from 0.6\u00a0m to 0.65\u00a0m halves"), text)

    def test_where_the_designs_differ_in_more_nothing_is_said(self):
        row = types.SimpleNamespace(title="overturned", rate=(1.0, 0.9, 1.1))
        for differing in ([("block.width_m", ["1", "2"]), ("friction.mu_k", ["0.3", "0.4"])], [("chain", ["with", "without"])]):
            found = types.SimpleNamespace(differing=differing, labels=["a", "b"])
            self.assertEqual(halved.halving(found, found.labels, ["e"], [{"e": row}, {"e": row}]), [])


if __name__ == "__main__":
    unittest.main()
