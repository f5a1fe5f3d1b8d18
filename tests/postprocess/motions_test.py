#!/usr/bin/python3
"""What pages say of the motions of a sweep: records on the floors of buildings, beside pulses, and in two horizontal directions."""
import pathlib
import tempfile
import unittest

import support

import h5py
import numpy as np
from freestand_post import pictures, reading, report, style
from freestand_post.pictures.coverage import swept
from pictures_test import overlaps


def sweep_under(motions, chosen, **columns):
    """A sweep under motions given as (name, group, ground, storey, peak); chosen: the motion of each sample, in turn. columns: of
    /samples, in turn too, or None for one that is not there."""
    with tempfile.TemporaryDirectory() as kept:
        folder = support.sweep_copy(pathlib.Path(kept) / "sweep")
        with h5py.File(folder / "samples.h5", "a") as root:
            del root["motions"]
            names, *numbers = zip(*motions)
            root["motions/name"] = np.array(names, dtype=h5py.string_dtype())
            for name, values in zip(("group", "ground", "storey", "pga_mps2"), numbers):
                root[f"motions/{name}"] = np.array(values)
            size = root["samples/outcome"].size
            columns = {"motion": chosen, "storey": np.array(numbers[2])[chosen], **columns}
            for name, values in columns.items():
                if name in root["samples"]:
                    del root[f"samples/{name}"]
                if values is not None:
                    root[f"samples/{name}"] = np.resize(values, size)
        return reading.read_sweep(folder)


def in_buildings(*buildings):
    """Two records in each building given as (name, storey, how hard the floor shakes under each)."""
    motions = []
    for building, storey, ratios in buildings:
        for record, ratio in zip(("r1.csv", "r2.csv"), ratios):
            ground = len(motions)
            motions += [(record, 0, ground, 0, 2.0), (f"{record} {building} storey {storey}", 0, ground, storey, 2.0 * ratio)]
    return motions


class Floors(unittest.TestCase):
    def setUp(self):
        style.apply()

    def floors(self, sweep):
        (picture,) = [picture for picture in pictures.draw(sweep) if picture.name == "floors"]
        (ax,) = picture.figure.axes
        self.assertEqual(overlaps(picture.figure), [])
        medians = [(list(line.get_xdata()), list(line.get_ydata())) for line in ax.lines if line.get_linestyle() == "-" and line.get_marker() == "o"]
        return picture, medians, style.take_headline(picture.figure)[1]

    def test_floors_stand_over_the_ground_of_their_own_record(self):
        """Two records, each with the floors 1 and 3 of its building; peaks of the floors over those of the record they hang on."""
        self.assertEqual(reading.read_sweep(support.sweep()).amplification, {})  # no building
        sweep = sweep_under([("a.csv", 0, 0, 0, 2.0), ("a.csv hall storey 1", 0, 0, 1, 3.0), ("a.csv hall storey 3", 0, 0, 3, 5.0),
                             ("b.csv", 3, 3, 0, 4.0), ("b.csv hall storey 1", 3, 3, 1, 4.0), ("b.csv hall storey 3", 3, 3, 3, 14.0)], [1, 2, 4, 5])
        self.assertEqual(sweep.amplification, {("hall", 1): {"a.csv": 1.5, "b.csv": 1.0}, ("hall", 3): {"a.csv": 2.5, "b.csv": 3.5}})
        picture, medians, head = self.floors(sweep)
        self.assertEqual(medians, [([1.0, 1.25, 3.0], [0, 1, 3])])
        self.assertIn("On storey 3 of hall the floor shakes 3.0 times as hard as the ground", picture.finding)
        self.assertIn("the building hall", picture.caption)
        self.assertIn("2 records; from 2.5 to 3.5 times", head)

    def test_each_building_has_its_own_line(self):
        """Pooled, two buildings under the same two records had one median between them, "over 4 records"."""
        sweep = sweep_under(in_buildings(("stiff", 3, (2.0, 4.0)), ("soft", 3, (0.5, 1.5))), [1, 3, 5, 7])
        picture, medians, head = self.floors(sweep)
        self.assertEqual(medians, [([1.0, 3.0], [0, 3]), ([1.0, 1.0], [0, 3])])
        self.assertEqual(picture.finding, "On storey 3 of stiff the floor shakes 3.0 times as hard as the ground, on storey 3 of soft 1.0 times")
        self.assertEqual(head, "Medians over 2 records; from 2.0 to 4.0 times on storey 3 of stiff, from 0.50 to 1.5 times on storey 3 of soft.")
        self.assertIn("one of the buildings stiff and soft", picture.caption)
        self.assertIn("on storey 3 of one of the buildings stiff and soft", report._motions(sweep))

    def test_a_record_of_two_entries_counts_once_in_a_building(self):
        sweep = sweep_under(in_buildings(("hall", 2, (2.0, 3.0)), ("hall", 2, (2.0, 3.0))), [1, 3, 5, 7])
        self.assertEqual(sweep.amplification, {("hall", 2): {"r1.csv": 2.0, "r2.csv": 3.0}})

    def test_buildings_of_one_name_that_shake_otherwise_are_two(self):
        sweep = sweep_under(in_buildings(("building", 2, (2.0, 3.0)), ("building", 2, (1.0, 1.0))), [1, 3, 5, 7])
        self.assertEqual(sweep.amplification, {("building", 2): {"r1.csv": 2.0, "r2.csv": 3.0}, ("building 2", 2): {"r1.csv": 1.0, "r2.csv": 1.0}})
        self.assertIn("On storey 2 of the building the floor", self.floors(sweep)[0].finding)


class Storeys(unittest.TestCase):
    """The file says storey 0 of a pulse, and of a record without a building: nothing stands on a storey there."""
    hall = in_buildings(("hall", 2, (2.0, 3.0)))

    def test_pulses_stand_on_no_storey(self):
        sweep = sweep_under([*self.hall, ("A", -1, 4, 0, 1.0)], [1, 3, 4, 4])
        self.assertEqual(report._motions(sweep), "one of 2 records of the ground, on storey 2 of a building, or a pulse A")
        self.assertNotIn("storey", swept(sweep, limit=None))

    def test_records_without_a_building_are_told_apart(self):
        sweep = sweep_under([*self.hall, ("r3.csv", 4, 4, 0, 1.0)], [1, 3, 4])
        self.assertEqual(report._motions(sweep), "one of 3 records of the ground, as it is or on storey 2 of a building")
        self.assertNotIn("storey", swept(sweep, limit=None))

    def test_the_ground_floor_of_a_building_is_a_storey(self):
        sweep = sweep_under([*self.hall, ("A", -1, 4, 0, 1.0)], [0, 1, 2, 3, 4])
        self.assertEqual(report._motions(sweep), "one of 2 records of the ground, on storey 0 or 2 of a building, or a pulse A")
        self.assertIn("storey", swept(sweep, limit=None))


class Pairs(unittest.TestCase):
    """Whatever names them: a table's column `cross`, or `cross_records`."""

    def said(self, is_pair):
        sweep = sweep_under([("r1.csv", 0, 0, 0, 2.0), ("r2.csv", 1, 1, 0, 2.0)], [0, 1], storey=None)
        sweep.is_pair = np.array(is_pair)
        return report._motions(sweep)

    def test_records_in_both_horizontal_directions(self):
        self.assertEqual(self.said([True, True]), "one of 2 records in two horizontal directions")
        self.assertEqual(self.said([False, False]), "one of 2 records")
        self.assertEqual(self.said([True, False]), "one of 2 records, some of them in two horizontal directions")


if __name__ == "__main__":
    unittest.main()
