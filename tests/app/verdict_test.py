"""A verdict, its table and its numbers say the same; what is held out decides nothing."""

import math
import re
import shutil
import unittest

from support import CONFIGS, InFolder, numbers, walkthrough

SHAKE_TABLE = CONFIGS / "report" / "shake_table"


class Verdict(InFolder):
    def judged_by_its_table(self, found):
        """Of the candidates that were judged on tests left out, the best leaves the least, but for those that say why not."""
        judged = [c for c in found["candidates"] if c["left_out_refitted"]]
        best = next(c for c in judged if c["effect"] == found["best"])
        for c in judged:
            if c["error_left_out"] < best["error_left_out"]:
                self.assertTrue(c["remark"], c["effect"])
                self.assertIn(c["remark"], found["sentences"][0])
        for c in found["candidates"]:
            numbers = [c[key] for key in ("error_left_out", "error_left_out_se", "score_left_out_above_best", "chi_square_left_out")]
            self.assertEqual(numbers[0] is not None, c["left_out_refitted"], c["effect"])
            if not c["left_out_refitted"]:
                self.assertEqual(numbers, [None] * 4, c["effect"])

    def test_best_of_peaks(self):
        told = self.succeed(["diagnose", SHAKE_TABLE / "asp_profile_calibrated.yaml", "-o", self.folder / "asp"]).stdout
        found = numbers(self.folder / "asp" / "diagnosis.json")
        self.judged_by_its_table(found)
        self.assertEqual(found["verdict"], "none")
        judged = [c for c in found["candidates"] if c["left_out_refitted"]]
        self.assertEqual(found["best"], min(judged, key=lambda c: c["error_left_out"])["effect"])
        self.assertIn(f"(the best, {found['best']}, ", told)
        self.assertIn(f"with {found['best']} ", told.splitlines()[2])

    def test_fitted_numbers_lie_within_their_intervals(self):
        at_bounds = 0
        for study in sorted(SHAKE_TABLE.glob("*_calibrated.yaml")):
            out = self.folder / study.stem
            self.succeed(["compare", study, "-o", out, "--quiet"])
            parameters = numbers(out / "comparison.json")["parameters"]
            self.assertTrue(parameters)
            for number in parameters:
                for interval in (number["interval"], number["interval_90"]):
                    self.assertLessEqual(interval[0], number["value"], (study.name, number["name"]))
                    self.assertGreaterEqual(interval[1], number["value"], (study.name, number["name"]))
                    self.assertLess(*interval)
                at_bounds += any(math.isclose(number["value"], number[end]) for end in ("lower", "upper"))
        self.assertGreater(at_bounds, 0)

    def test_what_is_held_out_decides_nothing(self):
        """With its slip turned round, a test held out is told of; the verdict and what it rests on are those without it."""
        found = {}
        for name in ("as it is", "turned round"):
            walkthrough(self.folder / name, ("t01", "t02", "t05", "t06"), 2.2)
            shutil.copy(CONFIGS / "walkthrough" / "t06.csv", self.folder / name)  # the whole of the one that is looked at
            data = self.folder / name / "dataset.yaml"
            self.assertEqual(re.findall(r"(?s)(t\d\d)(?:(?!id:).)*role: holdout", data.read_text(encoding="utf-8")), ["t06"])
            if name == "turned round":
                file = self.folder / name / "t06.csv"
                names, *rows = [line.split(",") for line in file.read_text(encoding="utf-8").splitlines()]
                slip = names.index("slip_m")
                for row in rows:
                    row[slip] = repr(-float(row[slip]))
                file.write_text("\n".join(",".join(row) for row in [names] + rows) + "\n", encoding="utf-8")
            self.succeed(["diagnose", self.folder / name / "cabinet.yaml", "-o", self.folder / f"{name} out", "--quiet"])
            found[name] = numbers(self.folder / f"{name} out" / "diagnosis.json")
            self.judged_by_its_table(found[name])
        extra = [finding for finding in found["turned round"]["findings"] if finding not in found["as it is"]["findings"]]
        self.assertEqual(len(extra), 1, extra)
        self.assertRegex(extra[0], r"slip of test t06 looks mirrored.*held out, which decides nothing")
        for key in ("verdict", "effects", "sentences", "candidates", "base", "tests_of_chance", "sensors", "recovered_force"):
            self.assertEqual(found["turned round"][key], found["as it is"][key], key)


if __name__ == "__main__":
    unittest.main()
