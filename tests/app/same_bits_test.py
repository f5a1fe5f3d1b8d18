"""The same study gives the same numbers, to the bit, on any number of ranks, in one run or in two halves."""

import unittest

from support import InFolder, datasets, result, study_text


class SameBits(InFolder):
    def test_any_number_of_ranks(self):
        for design in ("sobol", "monte_carlo", "latin_hypercube"):
            study = self.write(f"{design}.yaml", study_text(design=design, samples=1500))
            results = {}
            for ranks in (1, 2, 3, 5):
                folder = self.folder / f"{design}-{ranks}"
                self.succeed(["run", study, "-o", folder, "--quiet"], ranks)
                results[ranks] = result(folder)
            self.assertEqual(len(results[1][0]["samples/outcome"][1]), 4 * 1500)
            for ranks in (2, 3, 5):
                self.assertEqual(results[ranks], results[1], f"{design}: {ranks} ranks differ from one")

    def test_block_size_and_halves_change_nothing(self):
        whole = self.folder / "whole"
        self.succeed(["run", self.write("a.yaml", study_text()), "-o", whole, "--quiet"])
        halves = self.folder / "halves"
        self.succeed(["sweep", self.write("b.yaml", study_text(block_size=100)), "-o", halves, "--quiet"], 2)
        self.assertFalse((halves / "fragility.h5").exists())
        self.assertFalse((halves / "blocks").exists())
        self.succeed(["fit", halves], 3)
        self.assertEqual(result(halves), result(whole))

    def test_another_seed_differs(self):
        folders = []
        for seed in (7, 8):
            folders.append(self.folder / str(seed))
            text = study_text(samples=200).replace("seed: 7", f"seed: {seed}")
            self.succeed(["run", self.write("s.yaml", text), "-o", folders[-1], "--quiet"])
        self.assertNotEqual(result(folders[0])[0], result(folders[1])[0])

    def test_more_samples_change_no_earlier_one(self):
        few, many = self.folder / "few", self.folder / "many"
        self.succeed(["sweep", self.write("f.yaml", study_text(samples=500)), "-o", few, "--quiet"])
        self.succeed(["sweep", self.write("m.yaml", study_text(samples=700)), "-o", many, "--quiet"], 2)
        a, b = datasets(few / "samples.h5"), datasets(many / "samples.h5")
        for name, (kind, values) in a.items():
            if name.startswith("samples/"):
                self.assertEqual(values, b[name][1][: len(values)], name)


if __name__ == "__main__":
    unittest.main()
