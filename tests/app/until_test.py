"""`until` goes on in rounds until the surface is known well enough, and a resumed one stops at the same place."""

import unittest

from support import InFolder, datasets, h5py, study_text

TEXT = study_text(block_size=256).replace("samples: 3000", "until: {half_width: 0.08, at_most: 200000}")


class Until(InFolder):
    def test_stops_when_the_surface_is_known(self):
        folder = self.folder / "out"
        done = self.succeed(["run", self.write("u.yaml", TEXT), "-o", folder], 2)
        self.assertIn("the surface is known to", done.stderr)
        with h5py.File(folder / "samples.h5") as file:
            samples = file["samples/outcome"].shape[0]
        self.assertLess(samples, 200000)
        with h5py.File(folder / "fragility.h5") as file:
            surface = file["edp/delta/surface"]
            half_width = (surface["upper"][()] - surface["lower"][()]).max() / 2
        self.assertLessEqual(half_width, 0.08)
        one = self.folder / "one"
        self.succeed(["run", self.write("u.yaml", TEXT), "-o", one, "--quiet"])
        self.assertEqual(datasets(one / "samples.h5"), datasets(folder / "samples.h5"))


if __name__ == "__main__":
    unittest.main()
