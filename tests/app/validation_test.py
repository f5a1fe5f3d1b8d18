"""compare, diagnose and add as their users run them: the same answer on any number of ranks, a sweep of what was fitted,
a formula as an effect, and what is said of broken measurements."""

import os
import re
import shutil
import subprocess
import time
import unittest

from support import InFolder, command, finished_blocks, numbers, run, walkthrough


class Validation(InFolder):
    def setUp(self):
        super().setUp()
        self.study = self.copy("all", None)

    def copy(self, name, tests, until_s=None):
        return walkthrough(self.folder / name, tests, until_s)

    def kill_on_the_way(self, arguments):
        """Kills the run when it has kept something."""
        process = subprocess.Popen(command(arguments), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and finished_blocks(arguments[3]) < 5:
            time.sleep(0.01)
        process.kill()
        self.assertEqual(process.wait(), -9)

    def test_any_number_of_ranks(self):
        study = self.copy("few", ("t01", "t02", "t05", "t07"), 2.2)  # the shortest, until they have come to rest
        found = {}
        for ranks in (1, 3):
            out = self.folder / f"{ranks}"
            self.succeed(["compare", study, "-o", out / "before", "--quiet"], ranks)
            if ranks == 1:  # killed on the way: its fits are kept
                self.kill_on_the_way(["diagnose", study, "-o", out / "diagnosis", "--quiet"])
                self.fail_with(2, ["diagnose", study, "-o", out / "diagnosis", "--quiet"], "--resume goes on")
                self.fail_with(2, ["diagnose", self.study, "-o", out / "diagnosis", "--quiet", "--resume"], "of another study")
            self.succeed(["diagnose", study, "-o", out / "diagnosis", "--quiet", "--resume"], ranks)
            self.assertNotIn("blocks", os.listdir(out / "diagnosis"))
            after = study.with_name(f"with_{ranks}.yaml")
            self.succeed(["add", study, "rate_weakening", "-o", after, "--quiet"], ranks)
            found[ranks] = (numbers(out / "before" / "comparison.json"), numbers(out / "diagnosis" / "diagnosis.json"),
                            [line for line in after.read_text(encoding="utf-8").split("\n") if not line.startswith("# ")])
        self.assertEqual(found[1], found[3])
        diagnosis = found[1][1]
        self.assertEqual(len(diagnosis["candidates"]), len({c["effect"] for c in diagnosis["candidates"]}))
        self.assertEqual(diagnosis["best"], diagnosis["candidates"][0]["effect"])  # one answer in the whole file
        self.assertIn(diagnosis["effects"], ([], [diagnosis["best"]]))
        for candidate in [diagnosis["base"]] + diagnosis["candidates"]:
            for name, number in candidate["parameters"].items():
                if number["interval"] is None:
                    self.assertTrue(number["no_interval"], (candidate["effect"], name))
                else:
                    self.assertLess(*number["interval"], (candidate["effect"], name))

    def test_ladder_and_sweep_of_what_was_fitted(self):
        second = self.study.with_name("second.yaml")
        self.succeed(["add", self.study, "rate_weakening", "-o", second, "--quiet"])
        out = self.folder / "after"
        self.succeed(["compare", second, "-o", out, "--quiet"])
        comparison = numbers(out / "comparison.json")
        self.assertLess(comparison["holdout"]["error_floor_noise_allowed"], 1.2)
        self.assertLess(comparison["holdout"]["error_of_mean"], 1.2)
        base, added = comparison["ladder"]
        self.succeed(["compare", self.study, "-o", self.folder / "before", "--quiet"])
        before = numbers(self.folder / "before" / "comparison.json")
        for role, error in (("calibration", base["error_calibration"]), ("holdout", base["error_holdout"])):
            self.assertAlmostEqual(before[role]["error_noise_units"], error, delta=1e-4 * error)
        self.assertEqual((base["step"], added["step"]), ("base", "rate_weakening"))
        self.assertGreater(base["error_holdout"], 20 * added["error_holdout"])
        sweep = (out / "fitted.yaml").read_text(encoding="utf-8").replace("samples: 20000", "samples: 300")
        self.succeed(["run", self.write("after/sweep.yaml", sweep), "-o", self.folder / "sweep", "--quiet"])
        swept = (self.folder / "sweep" / "study.yaml").read_text(encoding="utf-8")
        self.assertIn("rate_weakening", swept)
        # The numbers are drawn together, row by row of the table; --best takes the best ones.
        lines = [line for line in (out / "fitted_draws.csv").read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
        self.assertEqual(lines[0], "friction.mu,effects.rate_weakening.drop,effects.rate_weakening.speed_mps")
        self.assertEqual(swept.count("posterior: "), 3)
        self.succeed(["run", self.folder / "after" / "sweep.yaml", "--best", "-o", self.folder / "best", "--quiet"])
        self.assertNotIn("posterior", (self.folder / "best" / "study.yaml").read_text(encoding="utf-8"))
        for test in comparison["tests"]:
            self.assertGreater(test["within_band"], 0.8)
        for number in comparison["parameters"]:
            self.assertLess(number["interval"][0], number["interval_90"][0])
            self.assertLess(number["interval_90"][1], number["interval"][1])
        (out / "fitted_draws.csv").unlink()
        self.fail_with(2, ["run", out / "fitted.yaml", "-o", self.folder / "lost"], "fitted_draws.csv", "--best")

    def test_a_formula_is_added_as_a_name_is(self):
        law = ('{name: my_law, friction: "mu*(1 - d*(1 - exp(-abs(v)/c_mps)))", '
               "parameters: {d: {calibrate: [0.1, 0.8]}, c_mps: {calibrate: [0.02, 0.3]}}}")
        second = self.study.with_name("formula.yaml")
        self.succeed(["add", self.study, law, "-o", second, "--quiet"])
        self.succeed(["compare", second, "-o", self.folder / "formula", "--quiet"])
        comparison = numbers(self.folder / "formula" / "comparison.json")
        self.assertLess(comparison["holdout"]["error_floor_noise_allowed"], 1.2)

    def change(self, name, change):
        study = self.copy(name, None)
        file = study.with_name("t03.csv")
        file.write_text("\n".join(change(file.read_text(encoding="utf-8").split("\n"))), encoding="utf-8")
        return ["compare", study, "-o", self.folder / f"out_{name}", "--quiet"]

    def test_broken_measurements_name_file_and_line(self):
        def without(name):
            def change(lines):
                place = lines[0].split(",").index(name)
                return [",".join(c for i, c in enumerate(line.split(",")) if i != place) for line in lines]
            return change

        def with_nan(lines):
            return lines[:100] + [lines[100].rsplit(",", 1)[0] + ",nan"] + lines[101:]

        self.fail_with(3, self.change("channel", without("slip_m")), "t03.csv:1", "no column slip_m")
        self.fail_with(3, self.change("floor", without("floor_acceleration_mps2")), "t03.csv:1", "no column floor_acceleration_mps2")
        self.fail_with(3, self.change("nan", with_nan), "t03.csv:101", "nan")
        self.fail_with(3, self.change("gap", lambda lines: lines[:200] + lines[201:]), "t03.csv:201", "time jumps")
        self.fail_with(3, self.change("cut", lambda lines: lines[:1]), "t03.csv")
        twin = self.copy("twin", None)
        shutil.copy(twin.with_name("t01.csv"), twin.with_name("t02.csv"))
        self.fail_with(3, ["compare", twin, "-o", self.folder / "twin_out", "--quiet"], "test t02 has the file of test t01, or a copy")

    def rewritten(self, name, tests, row):
        """Some tests of the walk-through, each row of their csv (after the names) as row(i, rows) says."""
        study = self.copy(name, tests)
        for test in tests:
            file = study.with_name(f"{test}.csv")
            head, *lines = file.read_text(encoding="utf-8").splitlines()
            rows = [dict(zip(head.split(","), line.split(","))) for line in lines]
            rows = [row(i, rows) for i in range(len(rows))]
            file.write_text(",".join(rows[0]) + "\n" + "\n".join(",".join(r.values()) for r in rows) + "\n", encoding="utf-8")
        return study

    def test_too_little_or_impossible_data_get_no_verdict(self):
        one = self.copy("one", ("t02",))
        self.fail_with(3, ["diagnose", one, "-o", self.folder / "o", "--quiet"], "cabinet has 1 calibration test for 1 number")
        still = self.rewritten("still", ("t02", "t03", "t05"), lambda i, rows: rows[i] | {"slip_m": rows[i % 40]["slip_m"]})
        self.fail_with(3, ["diagnose", still, "-o", self.folder / "s", "--quiet"], "dataset.yaml", "no test shows motion above the noise")
        twin = self.rewritten("copy", ("t03",), lambda i, rows: rows[i] | {"rotation_rad": rows[i]["slip_m"]})
        self.fail_with(3, ["compare", twin, "-o", self.folder / "c", "--quiet"], "t03.csv:1", "rotation_rad is a copy of slip_m")

    def test_a_response_that_begins_before_its_floor_is_bad_data(self):
        early = self.rewritten("early", ("t02", "t03", "t05"),
                               lambda i, rows: rows[i] | {"slip_m": rows[min(i + 300, len(rows) - 1)]["slip_m"]})
        self.succeed(["diagnose", early, "-o", self.folder / "e", "--quiet"])
        found = numbers(self.folder / "e" / "diagnosis.json")
        self.assertEqual((found["verdict"], found["reason"], found["effects"], found["decided_by"]), ("bad_data", "data", [], "findings"))
        self.assertTrue(any("before its floor" in finding for finding in found["findings"]), found["findings"])

    def test_bytes_of_a_binary_file_reach_no_terminal(self):
        for name in ("t03.csv", "dataset.yaml"):
            for text in (b"\x89PNG\r\n\x1a\n\0\0\x1b[2J" * 9, b"time_s,\x1b[31mslip_m\n" * 20, b"name: \x9b31m\n\x07: [\x1b[0m]\n"):
                study = self.copy("binary", None)
                study.with_name(name).write_bytes(text)
                result = run(["compare", study, "-o", self.folder / "binary_out", "--quiet", "--overwrite"])
                self.assertEqual(result.returncode, 3)
                self.assertRegex(result.stderr.rstrip("\n"), r"^[\x20-\x7e\n]+$")
                self.assertLess(len(result.stderr), 2000)
                shutil.rmtree(self.folder / "binary")

    def test_mistakes_in_the_study(self):
        self.fail_with(2, ["add", self.study, "rate_weakning", "-o", self.study.with_name("x.yaml")], "is not known")
        self.fail_with(2, ["add", self.study, "rate_weakening", "-o", self.study], "exists already")
        self.fail_with(2, ["run", self.study, "-o", self.folder / "sweep"], "not fitted yet")
        few = self.copy("two", ("t02", "t03"))
        self.fail_with(3, ["diagnose", few, "-o", self.folder / "d", "--quiet"], "2 calibration tests for 1 number")
        lost = self.study.with_name("lost.yaml")
        lost.write_text(self.study.read_text(encoding="utf-8").replace("dataset.yaml", "nowhere.yaml"), encoding="utf-8")
        self.fail_with(3, ["compare", lost, "-o", self.folder / "l", "--quiet"], "lost.yaml:4", "nowhere.yaml")
        self.fail_with(2, ["compar", self.study], "compar is no command", "compare")
        text = self.study.read_text(encoding="utf-8")

        def study(name, effects):
            self.study.with_name(name).write_text(text.replace("effects: []", f"effects: [{effects}]"), encoding="utf-8")
            return ["compare", self.study.with_name(name), "-o", self.folder / "e", "--quiet"]
        self.fail_with(2, study("wide.yaml", "{name: rate_weakening, drop: {calibrate: [0.1, 1.3]}, speed_mps: 0.1}"),
                       "wide.yaml:7", "must lie between 0 and 1")
        data = self.study.with_name("dataset.yaml")
        data.write_text(data.read_text(encoding="utf-8").replace("file: t02.csv", "file: t01.csv"), encoding="utf-8")
        self.fail_with(3, ["compare", self.study, "-o", self.folder / "t", "--quiet"], "test t02 has the file of test t01")

    def test_tests_of_two_kinds_are_refused(self):
        data = self.study.with_name("dataset.yaml")
        data.write_text(data.read_text(encoding="utf-8") + "  - {id: fell, pulse: B, period_s: 0.8, peak_acceleration_g: 0.9, "
                        "role: calibration, overturned: true}\n", encoding="utf-8")
        for verb in ("compare", "diagnose"):
            self.fail_with(3, [verb, self.study, "-o", self.folder / verb, "--quiet"], "histories (t01, ", "outcomes alone (fell)", "split")

    def test_a_noise_of_zero_is_not_missing(self):
        data = self.study.with_name("dataset.yaml")
        text = data.read_text(encoding="utf-8")
        noise = re.search(r"(?m)^  slip_m: .*$", text).group()
        command = ["compare", self.study, "-o", self.folder / "zero", "--quiet"]
        data.write_text(text.replace(noise, "  slip_m: 0"), encoding="utf-8")
        self.assertNotIn("missing", self.fail_with(3, command, "noise.slip_m is 0", "must be above zero").stderr)
        data.write_text(re.sub(r"(?m)^noise:\n(  .*\n)*", "noise: 0\n", text), encoding="utf-8")
        self.assertNotIn("missing", self.fail_with(3, command, "noise is a single value", "keys").stderr)

    def test_nothing_to_calibrate(self):
        study = self.copy("fixed", ("t03", "t04", "t05"))
        study.write_text(study.read_text(encoding="utf-8").replace("{calibrate: [0.03, 1.2]}", "0.15"), encoding="utf-8")
        self.succeed(["diagnose", study, "-o", self.folder / "fixed_out", "--quiet"])
        found = numbers(self.folder / "fixed_out" / "diagnosis.json")
        self.assertEqual(found["base"]["parameters"], {})

    def test_tables_of_outcomes_and_of_peaks(self):
        tests = {"outcome": [("a", "overturned: true"), ("b", "overturned: false")],
                 "peak": [("a", "peak_slip_m: 0.1"), ("still", "peak_slip_m: 0")]}
        said = {}
        for name, results in tests.items():
            folder = self.folder / name
            folder.mkdir()
            entries = "".join(f"  - {{id: {i}, pulse: B, period_s: 0.8, peak_acceleration_g: {0.9 - 0.3 * k}, role: calibration, {result}}}\n"
                              for k, (i, result) in enumerate(results))
            (folder / "dataset.yaml").write_text("format: freestand-measurements/1\nname: few\n"
                                                 "specimen: {width_m: 0.4, height_m: 1.6, mass_kg: 100}\ntests:\n" + entries)
            (folder / "study.yaml").write_text("measurements: dataset.yaml\nmodel: {friction: {mu: 0.2}, placement_scatter: 0.1}\n")
            said[name] = self.succeed(["compare", folder / "study.yaml", "-o", folder / "out"]).stdout
        self.assertRegex(said["outcome"], r"(?m)^test +role +came out +P\(falls\) +Brier$")
        self.assertRegex(said["outcome"], r"(?m)^a +calibration +overturned +[01]\.\d\d +[0-9.e-]+$")
        self.assertRegex(said["outcome"], r"(?m)^b +calibration +stood ")
        level = self.folder / "peak" / "vertical.yaml"
        level.write_text("measurements: dataset.yaml\nmodel: {friction: {mu: 0.2}, effects: [{name: vertical_shaking}]}\n")
        self.fail_with(3, ["compare", level, "-o", self.folder / "v"], "vertical.yaml", "nothing to act on")
        self.assertRegex(said["peak"], r"(?m)^a +calibration +-?[0-9.]+ +[0-9.]+$")
        self.assertRegex(said["peak"], r"(?m)^still +calibration +>= 3\.00 +1\.00$")
        self.assertIn("and the study as it stands", said["peak"])


if __name__ == "__main__":
    unittest.main()
