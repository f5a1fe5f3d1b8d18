"""A sweep that does not keep its samples has the tables of one that does, on any number of ranks and after any interruption."""

import json
import os
import re
import signal
import subprocess
import time
import unittest

from kill_and_resume_test import ranks_of
from support import InFolder, command, datasets, h5py, study_text

TABLES = ("bins.csv", "surface.csv", "ranking.csv")


def tables(folder):
    return {name: (folder / name).read_bytes() for name in TABLES}, datasets(folder / "fragility.h5")


def summed_blocks(folder):
    """Blocks in the sums of the last run whose first node has a file."""
    files = sorted((folder / "blocks").glob("run-*.node-000000.sums"))
    try:
        content = files[-1].read_bytes() if files else b""
    except FileNotFoundError:
        return 0
    blocks = int.from_bytes(content[80:88], "little")
    return sum(byte.bit_count() for byte in content[112:112 + (blocks + 63) // 64 * 8])


class Keep(InFolder):
    def study(self, keep, samples=9000, **changes):
        return self.write(f"{keep[:4]}.yaml".replace("{", ""), study_text(samples=samples, **changes) + (f"keep: {keep}\n" if keep else ""))

    def test_the_tables_are_those_of_all_samples(self):
        all_kept = self.folder / "all"
        self.succeed(["run", self.study("all"), "-o", all_kept, "--quiet"], 2)
        counts = []
        for keep, kept, ranks in (("none", 4096, 1), ("none", 4096, 3), ("{thin: 2}", 4500, 2)):
            out = self.folder / f"{kept}-{ranks}"
            done = self.succeed(["run", self.study(keep), "-o", out, "--quiet"], ranks)
            self.assertEqual(tables(out), tables(all_kept))
            self.assertNotIn("are kept", done.stdout)
            self.assertFalse((out / "blocks").exists())
            with h5py.File(out / "samples.h5") as few, h5py.File(all_kept / "samples.h5") as many:
                self.assertEqual(len(few["samples/sample"]), kept)
                self.assertEqual(few["samples/edp_delta"][:].tobytes(), many["samples/edp_delta"][:kept].tobytes())
            counts.append(datasets(out / "tally.h5"))
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(summary["samples"], 9000)
            self.assertIn("tally.h5", summary["files"])
        self.assertTrue(all(one == counts[0] for one in counts))

    def test_fits_of_what_was_counted_and_of_what_was_kept(self):
        out = self.folder / "out"
        self.succeed(["sweep", self.study("none"), "-o", out, "--quiet"], 2)
        study = out / "study.yaml"
        swept = study.read_text()
        study.write_text(swept.replace("confidence: 0.95", "confidence: 0.9"))
        self.assertIn("9000 samples fitted", self.succeed(["fit", out]).stdout)
        told = self.succeed(["fit", out, "--im", "pga_g", "-o", self.folder / "pga"], 2).stdout
        self.assertIn("of the 9000 samples of the sweep the first 4096 are kept", told)
        self.assertIn("4096 samples fitted", told)
        self.assertIn("the first 4096 are kept", self.succeed(["sensitivity", out]).stdout)
        (out / "tally.h5").unlink()
        self.fail_with(3, ["fit", out], "tally.h5")
        study.write_text(swept)
        self.succeed(["run", self.study("none"), "-o", out, "--resume", "--quiet"], 2)  # swept again
        self.assertEqual(json.loads((out / "summary.json").read_text())["timing"]["samples_computed"], 9000)
        whole = self.folder / "whole"
        self.succeed(["run", self.study("none"), "-o", whole, "--quiet"])
        self.assertEqual(tables(out), tables(whole))

    def test_with_until(self):
        studies = [self.write(f"{keep}.yaml", study_text().replace("samples: 3000", "until: {half_width: 0.03, at_most: 40000}").replace(", axes: [friction.mu_k]", "")
                              + f"keep: {keep}\n") for keep in ("all", "none")]
        for study in studies:
            self.succeed(["run", study, "-o", self.folder / study.stem, "--quiet"], 2)
        self.assertEqual(tables(self.folder / "none"), tables(self.folder / "all"))
        samples = json.loads((self.folder / "none" / "summary.json").read_text())["samples"]
        self.assertTrue(4096 < samples < 40000, samples)

    def test_with_until_a_run_that_was_stopped_ends_where_it_would_have(self):
        """What was counted in a later round is not taken for the answer of an earlier one."""
        text = study_text().replace("samples: 3000", "until: {half_width: 0.014, at_most: 1000000}").replace(", axes: [friction.mu_k]", "")
        study = self.write("study.yaml", text + "keep: none\n")
        whole, out = self.folder / "whole", self.folder / "out"
        self.succeed(["run", study, "-o", whole, "--quiet"], 2)
        samples = json.loads((whole / "summary.json").read_text())["samples"]
        self.assertTrue(15000 < samples < 1000000, samples)
        launcher = subprocess.Popen(command(["run", study, "-o", out, "--quiet"], 2), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        while summed_blocks(out) * 64 < 0.2 * samples and launcher.poll() is None:
            time.sleep(0.01)
        for rank in ranks_of(launcher.pid):
            os.kill(rank, signal.SIGTERM)
        launcher.communicate(timeout=60)
        self.assertEqual(launcher.returncode, 75)
        self.assertLessEqual(summed_blocks(out) * 64, samples)
        self.succeed(["run", study, "-o", out, "--resume", "--quiet"], 2)
        self.assertEqual(json.loads((out / "summary.json").read_text())["samples"], samples)
        self.assertEqual(tables(out), tables(whole))

    def test_killed_and_stopped_it_goes_on_to_the_same_bits_and_with_nothing_else(self):
        study = self.study("none", samples=240000)
        whole = self.folder / "whole"
        self.succeed(["run", study, "-o", whole, "--quiet"], 2)
        out, kept = self.folder / "out", []
        for number in (signal.SIGTERM, signal.SIGKILL):
            launcher = subprocess.Popen(command(["run", study, "-o", out, "--quiet", *(["--resume"] if out.exists() else [])], 2),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            before, deadline = summed_blocks(out), time.monotonic() + 60
            while summed_blocks(out) <= before and launcher.poll() is None and time.monotonic() < deadline:
                time.sleep(0.01)
            ranks = ranks_of(launcher.pid)
            for rank in ranks[:2 if number == signal.SIGTERM else 1]:
                os.kill(rank, number)
            _, error = launcher.communicate(timeout=60)
            self.assertTrue(launcher.returncode, error)
            deadline = time.monotonic() + 60  # the rank that was not killed may outlive the launcher, and write
            while any(os.path.exists(f"/proc/{rank}") for rank in ranks) and time.monotonic() < deadline:
                time.sleep(0.01)
            kept.append(summed_blocks(out))
        self.assertGreater(kept[0], 0)
        self.assertGreater(kept[1], kept[0])
        self.fail_with(2, ["run", study, "-o", out], f"--overwrite throws {kept[1]} finished blocks away")
        for old, new, why in (("count: 5", "count: 6", "fragility.bins.count was 5, is 6"), ("keep: none", "keep: all", "keep was none")):
            other = self.write("other.yaml", study.read_text().replace(old, new))
            self.fail_with(2, ["run", other, "-o", out, "--resume"], why)
        self.succeed(["run", study, "-o", out, "--resume", "--quiet"], 3)
        self.assertEqual(tables(out), tables(whole))
        computed = json.loads((out / "summary.json").read_text())["timing"]["samples_computed"]
        self.assertEqual(computed, 240000 - 64 * kept[1])
        more = self.study("none", samples=250000)
        self.fail_with(2, ["run", more, "-o", out, "--resume"], "counts of 240000 samples", "none can be added")

    def test_check_tells_how_large_it_is(self):
        factor = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}
        for keep, samples, files in (("all", 20000, ("samples.h5",)), ("all", 64, ("samples.h5",)), ("none", 20000, ("samples.h5", "tally.h5"))):
            study, out = self.study(keep, samples=samples), self.folder / f"{keep}{samples}"
            told = self.succeed(["run", study, "--check"]).stdout
            number, unit = re.search(r"kept: at most (\S+) (\w*B) in samples.h5", told).groups()
            self.succeed(["sweep", study, "-o", out, "--quiet"])
            size = sum((out / name).stat().st_size for name in files)
            most = float(number) * factor[unit]  # half of the columns are those of few values, and are packed to nothing
            self.assertLess(size, most)
            self.assertGreater(size, 0.2 * most)
            number, unit = re.search(r"and (\S+) (\w*B) in fragility.h5 and its tables", told).groups()
            self.succeed(["fit", out, "--quiet"])
            size = sum((out / name).stat().st_size for name in ("fragility.h5", "surface.csv", "bins.csv"))
            most = float(number) * factor[unit]  # of the fine cells of a function only those are written that hold samples
            self.assertLess(size, most)
            self.assertGreater(size, 0.2 * most)
        study = self.write("large.yaml", study_text().replace("count: 5", "count: 1000").replace("axes: [friction.mu_k]", """axes:
  [{name: friction.mu_k, bins: {count: 1000}}, {name: block.width_m, bins: {count: 1000}}, {name: motion.period_s, bins: {count: 1000}},
   {name: motion.pta_g, bins: {count: 1000}}],
  capacities: {delta: [%s]}""" % ", ".join(f"{0.01 * i:g}" for i in range(1, 100))))
        for arguments in (["--check"], ["-o", self.folder / "large"]):
            self.fail_with(2, ["run", study, *arguments], "what is counted takes", "take fewer bins")
        self.assertEqual(list((self.folder / "large").glob("*.h5")), [])

    def test_unless_the_study_says_otherwise_a_hundred_million_are_kept(self):
        told = self.succeed(["run", self.study("", samples=100_000_001), "--check"]).stdout
        self.assertIn("\nkeep: none\n", told)
        self.assertNotIn("\nkeep:", self.succeed(["run", self.study("", samples=100_000_000), "--check"]).stdout)
        self.fail_with(2, ["run", self.study("some"), "--check"], "keep", "all, none")


if __name__ == "__main__":
    unittest.main()
