"""The same study gives the same numbers, to the bit, on any number of ranks, in one run or in two halves."""

import json
import math
import os
import unittest

from support import InFolder, datasets, result, study_text


class SameBits(InFolder):
    def test_any_number_of_ranks(self):
        for design in ("sobol", "monte_carlo", "latin_hypercube"):
            study = self.write(f"{design}.yaml", study_text(design=design, samples=1500))
            results = {}
            all_ranks = (1, 2, 3, 5) if design == "sobol" else (1, 3)
            for ranks in all_ranks:
                folder = self.folder / f"{design}-{ranks}"
                self.succeed(["run", study, "-o", folder, "--quiet"], ranks)
                results[ranks] = result(folder)
            self.assertEqual(len(results[1][0]["samples/outcome"][1]), 4 * 1500)
            for ranks in all_ranks[1:]:
                self.assertEqual(results[ranks], results[1], f"{design}: {ranks} ranks differ from one")

    def test_records_packs_and_effects(self):
        """Records go through the packs, effects through the text for single samples; a run of dimensions each."""
        for number, pitch in enumerate((1.3, 2.1)):
            rows = "".join(f"{i / 100:.2f},{4 * math.sin(pitch * i / 10) * math.exp(-i / 300):.6f}\n" for i in range(800))
            (self.folder / f"floor{number}.csv").write_text("time_s,floor_acceleration_mps2\n" + rows, encoding="utf-8")
        records = 'motions:\n  - {records: "floor*.csv", scale_to: {pta_g: {uniform: [0.1, 0.9]}}}\n'
        effects = ("effects:\n  - {name: rate_weakening, drop: {uniform: [0.1, 0.5]}, speed_mps: 0.1}\n"
                   "  - {name: moving_contents, mass_ratio: 0.2, frequency_hz: 2}\n")
        text = study_text(samples=600, block_size=48).replace("impact: {law: coulomb}\n", "")
        text = text[:text.index("motions:")] + records + text[text.index("fragility:"):]
        plane = text.replace('"floor*.csv"', "floor0.csv, cross_records: floor1.csv").replace("fragility:", "model: slide\nfragility:")
        for name, study in (("packs", text), ("effects", text + effects), ("plane", plane)):
            results = {}
            all_ranks = (1, 2, 3) if "FREESTAND_LONG_TESTS" in os.environ else (1, 3)
            for ranks in all_ranks:
                folder = self.folder / f"{name}-{ranks}"
                self.succeed(["run", self.write(f"{name}.yaml", study), "-o", folder, "--quiet"], ranks)
                accuracy = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["accuracy"]
                self.assertEqual(accuracy["samples_checked"], 200)
                results[ranks] = result(folder), accuracy
            for ranks in all_ranks[1:]:
                self.assertEqual(results[ranks], results[1], f"{name}: {ranks} ranks differ from one")
            other = self.folder / f"{name}-blocks"
            self.succeed(["run", self.write("b.yaml", study.replace("block_size: 48", "block_size: 64")), "-o", other, "--quiet"])
            self.assertEqual(result(other), results[1][0], f"{name}: the size of the blocks changes the numbers")

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
