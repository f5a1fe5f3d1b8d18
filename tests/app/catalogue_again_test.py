"""A catalogue that was interrupted and comes again with a changed entry; intensities that hold a period, with their exports."""

import unittest

from support import InFolder

HEAD = """\
format: freestand-catalogue/1
name: boxes
samples: 400
motions: [{pulse: [A, B], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {log_uniform: [0.1, 2]}}]
"""
FRAGILITY = "fragility: {bins: {count: 4}, edp: [peak_slip_m, overturned], capacities: {peak_slip_m: [0.02, 0.05]}, resamples: 20}\n"
ENTRY = "entries:\n  - {id: box, class: box, block: {width_m: WIDTH, height_m: 1.5}, friction: {mu: 0.2}}\n"


class CatalogueAgain(InFolder):
    def test_finished_samples_of_another_entry_are_not_replaced(self):
        samples = self.folder / "db" / "entries" / "box" / "samples.h5"
        first, other = (self.write(f"{width}.yaml", HEAD + FRAGILITY + ENTRY.replace("WIDTH", width)) for width in ("0.6", "0.7"))
        self.succeed(["catalogue", first, "-o", self.folder / "db"])
        (self.folder / "db" / "database.h5").unlink()  # as where it was interrupted before the end
        before = samples.read_bytes()
        self.fail_with(2, ["catalogue", other, "-o", self.folder / "db"], "entry box is not the one whose samples are finished (block.width_m was 0.6, is 0.7)")
        self.assertEqual(samples.read_bytes(), before)
        self.assertIn("1 fitted again", self.succeed(["catalogue", first, "-o", self.folder / "db"]).stdout)
        self.assertIn("1 computed", self.succeed(["catalogue", other, "-o", self.folder / "db", "--redo"]).stdout)

    def test_an_intensity_with_its_period_and_its_exports(self):
        text = HEAD + 'intensities: [pga_g, "sa_g:0.5"]\nexports: [incore, pelicun]\n' + FRAGILITY + ENTRY.replace("WIDTH", "0.6")
        self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"])
        exports = self.folder / "db" / "exports"
        self.assertTrue(list((exports / "incore" / "sa_g_0.5").glob("box*.json")))
        self.assertTrue((exports / "pelicun" / "sa_g_0.5" / "fragility.csv").exists())


if __name__ == "__main__":
    unittest.main()
