"""`reproduce`: the whole of it on two ranks, its page, a table of one's own, and the mistakes that users make."""

import csv
import json
import re
import subprocess
import unittest

from support import CONFIGS, InFolder

ROOT = CONFIGS.parent
TABLES = CONFIGS / "report"


class Report(InFolder):
    def test_the_whole_report_and_its_page(self):
        out = self.folder / "report"
        done = self.succeed(["reproduce", "-o", out], 2)
        found = json.loads((out / "reproduce.json").read_text())
        self.assertEqual(found["format"], "freestand-reproduce/1")
        self.assertEqual((found["numbers_printed"], found["numbers_that_agree"], found["numbers_that_disagree"], found["numbers_in_which_the_print_disagrees_with_itself"]), (202, 194, 0, 8))
        self.assertIn("194 of 202 numbers of the report agree within rounding", done.stdout)
        items = [item for figure in found["figures"] for item in figure["items"]]
        self.assertEqual(len({item["id"] for item in items}), len(items))
        self.assertEqual(sum(item["verdict"] in ("agrees", "print disagrees with itself") for item in items if item["kind"] == "number"), 202)
        for item in items:
            if item["kind"] == "number" and item["print"] is not None:
                self.assertAlmostEqual(item["difference"], item["ours"] - item["print"], delta=1e-12)
            self.assertTrue(item["why"] or item["verdict"] in ("agrees", "not printed"), item["id"])
        for figure in found["figures"]:
            for name in figure["files"]:
                with open(out / name, newline="") as file:
                    rows = list(csv.DictReader(file))
                self.assertTrue(rows and all(row["figure"] == figure["id"] and None not in row for row in rows), name)
                self.assertNotIn("nan", (out / name).read_text())
        self.cape(out)
        self.page(out, "194 of 202 numbers of the report agree within rounding")
        # Nothing is replaced unasked, and nothing that is not freestand's at all.
        self.fail_with(2, ["reproduce", "-o", out], "--overwrite")
        (out / "reproduce.json").write_text("{}")
        self.fail_with(2, ["reproduce", "-o", out, "--overwrite"], "reproduce.json", "freestand did not write it")

    def cape(self, out):
        """At seven times p the block stands again between two amplitudes above the lowest that overturns it."""
        with open(out / "overturning_one_sine.csv", newline="") as file:
            here = [row for row in csv.DictReader(file) if abs(float(row["frequency_over_p"]) - 7) < 1e-9]
        self.assertEqual([row["falls_above"] for row in here], ["1", "0", "1"])
        lowest, below, above = (float(row["amplitude_over_alpha_g"]) for row in here)
        self.assertTrue(lowest < below < above / 1.02)

    def page(self, out, title):
        done = subprocess.run([ROOT / "postprocess/report", out], capture_output=True, text=True, timeout=200)
        if "Python package" in done.stderr:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (out / "report.html").read_text()
        self.assertEqual(re.search("<h1>(.*?)</h1>", text).group(1), title)
        self.assertEqual(re.findall(r'(?:src|href)="(?!#)[^"]*"', re.sub(r"<svg.*?</svg>", "", text, flags=re.S)), [])  # nothing is fetched
        self.assertIsNone(re.search(r"\bnan\b", re.sub(r"<svg.*?</svg>", "", text, flags=re.S)))
        for figure in json.loads((out / "reproduce.json").read_text())["figures"]:
            section = text[text.index(f'<section id="of-{figure["id"]}">'):].split("</section>")[0]
            self.assertTrue("<figure" in section, figure["id"])


class OwnPeaks(InFolder):
    def test_the_same_on_any_number_of_ranks(self):
        table = self.write("peaks.csv", (TABLES / "table_8_1.csv").read_text())
        texts = []
        for ranks in (1, 2):
            out = self.folder / f"own{ranks}"
            done = self.succeed(["reproduce", "--peaks", table, "-o", out], ranks)
            self.assertIn("slope of the mean demand", done.stdout)
            found = json.loads((out / "reproduce.json").read_text())
            found.pop("provenance")
            texts.append((json.dumps(found), [(path.name, path.read_bytes()) for path in sorted(out.glob("*.csv"))]))
        self.assertEqual(texts[0], texts[1])
        best = next(figure for figure in json.loads(texts[0][0])["figures"] if figure["id"] == "own_mu_best_fit")
        slope = next(item["ours"] for item in best["items"] if item["id"].endswith(".slope"))
        self.assertAlmostEqual(slope, 0.380, delta=0.0006)


class Mistakes(InFolder):
    def test_what_is_missing_is_named(self):
        out = self.folder / "out"
        self.fail_with(3, ["reproduce", "-o", out, "--tables", self.folder], "table_3_1.csv", "--tables")
        self.fail_with(3, ["reproduce", "-o", self.folder / "a", "--records", self.folder / "none"], "none is no folder", "--records")
        self.fail_with(3, ["reproduce", "-o", self.folder / "b", "--peaks", self.folder / "none.csv"], "none.csv")
        self.fail_with(3, ["reproduce", "-o", self.folder / "c", "--peaks", self.write("p.csv", "pta_g,mu,period_s,peak_slip_m\n1,0.2,1,0\n")], "p.csv:2: peak_slip_m is 0", ranks=2)
        self.fail_with(2, ["reproduce"], "--output")


if __name__ == "__main__":
    unittest.main()
