"""What a result holds can be run again from where it lies, and nothing that the user wrote is replaced."""

import math
import os
import shutil
import unittest

from support import CONFIGS, InFolder, result, run, study_text

CASE = """\
block: {width_m: 0.6, height_m: 1.8, mass_kg: 150}
friction: {mu: 0.2}
effects: [{name: vertical_shaking}]
motion: {file: ../records/both.csv, scale: 1.5}
"""


def shaken(motions, **options):
    text = study_text(samples=300, **options)
    return text[:text.index("motions:")] + f"motions:\n{motions}" + text[text.index("fragility:"):]


class Rerun(InFolder):
    def setUp(self):
        super().setUp()
        self.tree = self.folder / "tree"
        (self.tree / "studies").mkdir(parents=True)
        (self.tree / "records").mkdir()
        rows = [(0.01 * i, 4 * math.sin(6 * 0.01 * i), math.cos(9 * 0.01 * i)) for i in range(300)]
        for name, sign in (("one", 1), ("two", -0.7)):
            text = "".join(f"{t:.2f},{sign * a}\n" for t, a, _ in rows)
            (self.tree / "records" / f"{name}.csv").write_text("time_s,floor_acceleration_mps2\n" + text)
        text = "".join(f"{t:.2f},{a},{v}\n" for t, a, v in rows)
        (self.tree / "records" / "both.csv").write_text(
            "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n" + text)

    def test_study_of_a_result_from_any_folder_and_after_a_move(self):
        study = self.tree / "studies" / "mine.yaml"
        study.write_text(shaken(
            '  - {records: "../records/[ot]*.csv", scale_to: {pta_g: {uniform: [0.2, 0.8]}}}\n'
            '  - {records: ../records/both.csv, vertical_records: ../records/one.csv}\n'
            f'  - {{records: "{CONFIGS}/walkthrough/t01.csv"}}\n'
            '  - {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n'))
        first = self.tree / "results" / "first"
        self.succeed(["run", study, "-o", first, "--quiet"])
        self.succeed(["run", first / "study.yaml", "-o", self.folder / "elsewhere", "--quiet"])
        self.assertEqual(result(self.folder / "elsewhere"), result(first))

        moved = self.folder / "moved"
        self.tree.rename(moved)
        here = os.getcwd()
        os.chdir(moved / "results" / "first")
        self.addCleanup(os.chdir, here)
        self.succeed(["run", "study.yaml", "-o", "../second", "--quiet"])
        self.assertEqual(result(moved / "results" / "second"), result(moved / "results" / "first"))
        self.succeed(["run", "../first/study.yaml", "-o", "../first", "--resume", "--quiet"])
        shutil.rmtree(moved / "records")
        os.chdir(here)
        shutil.move(moved / "results" / "first", self.folder / "alone")
        self.succeed(["fit", self.folder / "alone"])

    def test_check_prints_a_study_for_the_folder_that_it_is_called_in(self):
        study = self.tree / "studies" / "mine.yaml"
        study.write_text(shaken('  - {records: "../records/[ot]*.csv"}\n'))
        here = os.getcwd()
        os.chdir(self.tree)
        self.addCleanup(os.chdir, here)
        (self.tree / "whole.yaml").write_text(self.succeed(["run", "--check", study]).stdout)
        self.succeed(["run", "whole.yaml", "-o", "a", "--quiet"])
        self.succeed(["run", study, "-o", "b", "--quiet"])
        self.assertEqual(result(self.tree / "a"), result(self.tree / "b"))

    def test_case_of_a_result(self):
        case = self.tree / "studies" / "one.yaml"
        case.write_text(CASE)
        self.succeed(["simulate", case, "-o", self.folder / "a"])
        self.succeed(["simulate", self.folder / "a" / "case.yaml", "-o", self.folder / "b"])
        self.assertEqual((self.folder / "a" / "history.csv").read_bytes(), (self.folder / "b" / "history.csv").read_bytes())

    def test_fitted_study_finds_measurements_and_records(self):
        shutil.copytree(CONFIGS / "walkthrough", self.tree / "bench")
        dataset = self.tree / "bench" / "dataset.yaml"
        head, *tests = dataset.read_text().split("  - id: ")
        dataset.write_text(head + "".join("  - id: " + t for t in tests[:1]))
        study = self.tree / "studies" / "fit.yaml"
        study.write_text("measurements: ../bench/dataset.yaml\nmodel: {friction: {mu: {calibrate: [0.03, 1.2]}}}\n"
                         "samples: 100\nmotions: [{records: ../records/one.csv}]\nfragility: {edp: [peak_slip_m]}\n")
        out = self.folder / "deep" / "compared"
        self.succeed(["compare", study, "-o", out, "--quiet"])
        self.succeed(["compare", out / "fitted.yaml", "-o", self.folder / "again", "--quiet"])
        self.succeed(["run", out / "fitted.yaml", "-o", self.folder / "swept", "--quiet"])
        self.succeed(["add", study, "viscous_drag", "-o", self.folder / "added.yaml", "--quiet"])
        self.succeed(["compare", self.folder / "added.yaml", "-o", self.folder / "after", "--quiet"])


class Kept(InFolder):
    def test_study_of_the_user_in_the_folder_of_results(self):
        study = self.write("study.yaml", "# my notes\n" + study_text(samples=200))
        before = study.read_text()
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        for more in (["--overwrite"], ["--resume"]):
            self.fail_with(2, ["run", "study.yaml", "-o", "."] + more, "study.yaml would be replaced")
        self.assertEqual(study.read_text(), before)
        self.assertEqual(os.listdir("."), ["study.yaml"])

    def test_what_was_changed_since_and_what_only_has_the_name_of_a_result(self):
        study = self.write("mine.yaml", study_text(samples=200))
        out = self.folder / "out"
        self.succeed(["run", study, "-o", out, "--quiet"])
        self.succeed(["run", study, "-o", out, "--quiet", "--overwrite"])
        (out / "study.yaml").write_text((out / "study.yaml").read_text().replace("seed: 7", "seed: 8"))
        self.fail_with(2, ["run", study, "-o", out, "--overwrite"], "study.yaml would be replaced")
        self.assertTrue((out / "samples.h5").exists())
        (out / "study.yaml").unlink()
        (out / "summary.json").write_text('{"mine": 1}\n')
        self.fail_with(2, ["run", study, "-o", out, "--overwrite"], "summary.json would be replaced")
        self.fail_with(2, ["fit", out], "summary.json would be replaced")
        self.assertEqual((out / "summary.json").read_text(), '{"mine": 1}\n')

    def test_a_number_that_was_changed_in_a_table(self):
        study = self.write("mine.yaml", study_text(samples=200))
        out = self.folder / "out"
        self.succeed(["run", study, "-o", out, "--quiet"])
        self.succeed(["fit", out])
        for name in ("bins.csv", "surface.csv", "ranking.csv", "summary.json"):
            before = (out / name).read_text()
            place = max(before.rindex(digit) for digit in "0123456789" if digit in before)
            changed = before[:place] + str((int(before[place]) + 1) % 10) + before[place + 1:]
            (out / name).write_text(changed)
            self.fail_with(2, ["fit", out], f"{name} would be replaced")
            self.fail_with(2, ["run", study, "-o", out, "--overwrite"], name, "move it away")
            self.assertEqual((out / name).read_text(), changed)
            (out / name).write_text(before)
        (out / "bins.csv").unlink()
        self.succeed(["fit", out])
        self.succeed(["run", study, "-o", out, "--quiet", "--overwrite"])

    def test_no_result_of_an_earlier_run_stays_beside_the_new_ones(self):
        study = self.write("mine.yaml", study_text(samples=200))
        out = self.folder / "out"
        self.succeed(["run", study, "-o", out, "--quiet"])
        self.succeed(["sensitivity", out, "--quiet"])
        self.succeed(["export", out, "--format", "csv", "-o", out])
        (out / "notes.txt").write_text("mine\n")
        self.assertLessEqual({"certificate.json", "fragility.csv", "sensitivity.csv", "ranking.csv", "study.yaml"}, set(os.listdir(out)))
        case = self.write("one.yaml", "block: {width_m: 0.6, height_m: 1.8, mass_kg: 150}\nfriction: {mu: 0.2}\n"
                          "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n")
        self.succeed(["simulate", case, "-o", out, "--overwrite"])
        self.assertEqual(set(os.listdir(out)), {"case.yaml", "freestand.files", "history.csv", "notes.txt", "summary.json"})
        shutil.copytree(CONFIGS / "walkthrough", self.folder / "bench")
        self.succeed(["compare", self.folder / "bench" / "cabinet.yaml", "-o", out, "--overwrite", "--quiet"])
        compared = {"comparison.json", "fitted.yaml", "fitted_draws.csv", "freestand.files", "notes.txt"}
        self.assertEqual(set(os.listdir(out)), compared)
        # What a command reads is not removed by it.
        self.fail_with(2, ["diagnose", out / "fitted.yaml", "-o", out, "--overwrite"], "fitted.yaml is read")
        self.fail_with(2, ["run", out / "fitted.yaml", "-o", out, "--overwrite"], "fitted.yaml is read")
        self.assertEqual(set(os.listdir(out)), compared)
        self.succeed(["run", study, "-o", out, "--overwrite", "--quiet"])
        self.assertNotIn("fitted.yaml", os.listdir(out))
        self.fail_with(2, ["fit", out, "-o", out, "--overwrite"], "samples.h5 is read")
        self.succeed(["run", out / "study.yaml", "-o", out, "--overwrite", "--quiet"])

    def test_history_that_was_the_floor_motion(self):
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        rows = "".join(f"{0.01 * i:.2f},{4 * math.sin(0.06 * i)}\n" for i in range(300))
        history = self.write("history.csv", "time_s,floor_acceleration_mps2\n" + rows)
        self.write("one.yaml", CASE.replace("../records/both.csv", "history.csv").replace(
            "effects: [{name: vertical_shaking}]\n", ""))
        self.fail_with(2, ["simulate", "one.yaml", "-o", ".", "--overwrite"], "history.csv would be replaced")
        self.assertTrue(history.exists())

    def test_study_that_add_would_write_over(self):
        shutil.copytree(CONFIGS / "walkthrough", self.folder / "bench")
        study = self.folder / "bench" / "cabinet.yaml"
        before = study.read_text()
        done = run(["add", study, "rate_weakening", "-o", study, "--overwrite"])
        self.assertEqual(done.returncode, 2)
        self.assertEqual(study.read_text(), before)


if __name__ == "__main__":
    unittest.main()
