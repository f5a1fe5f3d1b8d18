#!/usr/bin/python3
"""The picture of joint draws tells the intervals of comparison.json, and none of its own."""
import unittest
from unittest import mock

import support  # noqa: F401

import numpy as np
from freestand_post.pictures import draws

NAME = "block.slenderness_rad"


def comparison(**parameter):
    """Draws of the placements of other tests, which scatter further than the middle is open."""
    values = np.random.default_rng(1).normal(0.2, 0.05, 400)
    return mock.Mock(friction_scatter=0.0, draws={NAME: values}, parameters=[{"name": NAME, "value": 0.2, **parameter}])


class Draws(unittest.TestCase):
    def test_the_title_and_the_dashes_are_those_of_the_interval(self):
        picture = draws._picture(comparison(interval_90=(0.19, 0.22)))
        self.assertIn("between 0.19 and 0.22", picture.finding)
        dashed = [line.get_xdata()[0] for ax in picture.figure.axes for line in ax.lines if line.get_linestyle() == "--"]
        self.assertEqual(dashed, [0.19, 0.22])


if __name__ == "__main__":
    unittest.main()
