#!/usr/bin/python3
"""What the title of a history says of a specimen that starts off its place, and of one whose floor moves in two directions."""
import pathlib
import unittest

import numpy as np

import support  # noqa: F401  finds freestand_post
from freestand_post import pictures, style
from freestand_post.reading import History


def history(slip, mode, summary, **more):
    columns = {name: np.zeros(len(slip)) for name in ("floor_acceleration_mps2", "slip_velocity_mps", "rotation_rad", "rotation_rate_radps")}
    columns.update(time_s=np.linspace(0, 1, len(slip)), slip_m=np.array(slip), **more)
    return History(pathlib.Path("none"), columns, mode, summary)


def drawn(*given, **more):
    style.apply()
    (picture,) = pictures.draw(history(*given, **more))
    return picture


class Titles(unittest.TestCase):
    def test_of_one_that_starts_off_its_place(self):
        still = drawn([0.3, 0.3, 0.3], ["rest"] * 3, {"peak_slip_m": 0.3, "residual_slip_m": 0.3})
        self.assertEqual(still.finding, "The specimen does not move from where it starts, 30 cm off its place")
        moves = drawn([-0.3, -0.1, -0.05], ["slide", "slide", "rest"], {"peak_slip_m": 0.3, "residual_slip_m": -0.05})
        self.assertEqual(moves.finding, "Moves 25 cm, does not rock and comes to rest 25 cm from where it stood")

    def test_of_two_directions_is_of_both_and_both_are_drawn(self):
        across = np.array([0, 0.04, 0.04])
        both = drawn([0, 0.03, 0.03], ["rest", "slide", "rest"], {"peak_slip_m": 0.05, "residual_slip_m": 0.05}, cross_slip_m=across,
                     floor_cross_acceleration_mps2=np.zeros(3))
        self.assertIn("Moves 5.0 cm", both.finding)
        self.assertIn("both together", both.caption)
        slip = both.figure.axes[2]
        self.assertTrue(any(np.allclose(line.get_ydata(), 100 * across) for line in slip.lines if len(line.get_ydata()) == 3))


if __name__ == "__main__":
    unittest.main()
