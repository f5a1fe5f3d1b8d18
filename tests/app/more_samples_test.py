"""More samples added to a finished sweep: the first are not computed again, and all are those of a sweep of its own."""

import json
import unittest

from support import InFolder, closing, datasets, h5py, result, study_text, write_records


class MoreSamples(InFolder):
    def run_study(self, out, *options, ranks=1, **changes):
        study = self.write("study.yaml", study_text(**changes))
        return self.succeed(["run", study, "-o", out, "--quiet", *options], ranks)

    def test_they_are_those_of_a_sweep_of_its_own(self):
        whole, grown = self.folder / "whole", self.folder / "grown"
        self.run_study(whole, samples=900, block_size=64)
        self.run_study(grown, samples=500, block_size=100)
        before = datasets(grown / "samples.h5")
        self.run_study(grown, "--resume", ranks=2, samples=900, block_size=64)
        self.assertEqual(result(grown), result(whole))
        self.assertNotEqual(datasets(grown / "samples.h5"), before)
        timing = json.loads((grown / "summary.json").read_text())["timing"]
        self.assertEqual(timing["samples_computed"], 400)
        self.assertIn("samples: 900", (grown / "study.yaml").read_text())
        self.assertFalse((grown / "blocks").exists())
        self.run_study(grown, "--resume", samples=900, block_size=64)  # nothing is left to do
        self.assertEqual(result(grown), result(whole))

    def test_other_bins_are_no_other_study(self):
        out = self.folder / "out"
        self.run_study(out, samples=300)
        study = self.write("study.yaml", study_text(samples=300).replace("count: 5", "count: 3"))
        self.succeed(["run", study, "-o", out, "--resume", "--quiet"])
        timing = json.loads((out / "summary.json").read_text())["timing"]
        self.assertEqual(timing["samples_computed"], 0)
        self.assertEqual(len((out / "bins.csv").read_text().splitlines()), 1 + 2 * 3)

    def test_a_finished_sweep_of_records_that_were_changed_is_refused_and_kept(self):
        write_records(self.folder / "records")
        text = study_text(samples=200)
        start, end = text.index("motions:"), text.index("fragility:")
        study = self.write("study.yaml", text[:start] + "motions: [{records: records/*.csv}]\n" + text[end:])
        out, record = self.folder / "out", self.folder / "records" / "c.csv"
        self.succeed(["run", study, "-o", out, "--quiet"])
        before, rows = result(out), record.read_text()
        self.succeed(["run", study, "-o", out, "--resume", "--quiet"], 2)
        for change in (lambda: record.write_text(rows.replace("0.10,", "0.10,-")), record.unlink):
            change()
            self.fail_with(2, ["run", study, "-o", out, "--resume", "--quiet"], "samples of other records", ranks=2)
            self.assertEqual(result(out), before)

    def test_samples_of_a_program_that_gives_other_numbers_are_refused(self):
        out = self.folder / "out"
        self.run_study(out, samples=300)
        with h5py.File(out / "samples.h5", "r+") as file:
            file.attrs["kernel"] = "00000001"
        study = self.write("more.yaml", study_text(samples=600))
        self.fail_with(3, ["run", study, "-o", out, "--resume", "--quiet"], "samples.h5", "does not end with the line")
        closing.close(out / "samples.h5")
        before = result(out)
        self.fail_with(2, ["run", study, "-o", out, "--resume", "--quiet"], "another version of freestand")
        self.assertEqual(result(out), before)

    def test_what_cannot_be_added_to_is_refused_and_kept(self):
        out = self.folder / "out"
        for design, samples, words in (("latin_hypercube", 700, ("every draw depends on the number of samples",)),
                                       ("sobol", 300, ("holds 500 samples of this study, and 300 are asked for",)),
                                       ("monte_carlo", 700, ("another study",))):
            first = "sobol" if design == "monte_carlo" else design
            self.run_study(out, "--overwrite", samples=500, design=first)
            before = result(out)
            study = self.write("more.yaml", study_text(samples=samples, design=design))
            self.fail_with(2, ["run", study, "-o", out, "--resume", "--quiet"], *words, ranks=2)
            self.assertEqual(result(out), before)
            self.succeed(["fit", out])


if __name__ == "__main__":
    unittest.main()
