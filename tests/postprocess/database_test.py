#!/usr/bin/python3
"""The page of a database: its numbers are those of the file, it fetches nothing, and in a browser it draws what is chosen."""
import csv
import io
import json
import math
import pathlib
import re
import tempfile
import unittest
import urllib.parse

import numpy as np
import support
import make_database
from freestand_post import database
from report_test import Page


def table(page, name):
    """The csv that a figure offers, as rows."""
    address = re.search(rf'<figure id="{name}".*?href="data:text/csv;charset=utf-8,([^"]*)"', page, re.S).group(1)
    return list(csv.DictReader(io.StringIO(urllib.parse.unquote(address))))

class Database(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = make_database.make_database(pathlib.Path(kept.name) / "db")
        cls.done = support.run("report", cls.folder)
        cls.text = (cls.folder / "report.html").read_text(encoding="utf-8") if cls.done.returncode == 0 else ""
        cls.entries, cls.curves = make_database.rows()

    def test_the_command_prints_the_path(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertEqual(self.done.stdout, f"{(self.folder / 'report.html').resolve()}\n")
        self.assertIn('<meta name="generator" content="freestand">', self.text)

    def test_the_page_fetches_nothing_and_is_balanced(self):
        page = Page(self.text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertEqual([address for address in page.addresses if not address.startswith(("#", "data:"))], [])
        self.assertFalse({"link", "iframe", "object", "img"} & set(page.tags))
        self.assertNotRegex(self.text, r"@import|fetch\(|XMLHttpRequest|https?://")

    def test_its_numbers_are_those_of_the_file(self):
        data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', self.text, re.S).group(1))
        self.assertEqual([entry["id"] for entry in data["entries"]], [entry["id"] for entry in self.entries])
        self.assertEqual(data["entries"][4]["reference_source"], "a <book>")
        self.assertEqual(len(data["curves"]), len(self.curves))
        for shown, made in zip(data["curves"], self.curves):
            self.assertEqual((shown["entry"], shown["demand"], shown["capacity"]), (made["entry"], made["demand"], made["capacity"]))
            for mine, theirs in zip(shown["points"], made["points"]):
                for a, b in zip(mine, theirs):
                    self.assertEqual(a, b)

    def test_one_friction_is_no_range(self):
        made = database.read_database(self.folder)
        self.assertIn(("0.30 to 0.60", "friction μ"), database._headline(made))
        made.entries["mu_k"] = np.full(len(made.entries["id"]), 0.5)
        self.assertIn(("0.50", "friction μ"), database._headline(made))

    def test_a_database_stands_alone_and_has_no_picture_files(self):
        done = support.run("report", self.folder, self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("give its folder alone", done.stderr)
        self.assertEqual(support.run("figures", self.folder).returncode, 2)

    def test_another_file_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "database.h5").write_text("no database")
            done = support.run("report", folder)
            self.assertEqual(done.returncode, 3)
            self.assertIn("database.h5 cannot be used", done.stderr)

    # One browser for all that is seen in it: it takes a second to start.
    @unittest.skipUnless(support.BROWSER, "no chromium (apt-get install chromium)")
    def test_in_a_browser_it_draws_what_is_chosen(self):
        move = """<script>const svg = document.querySelector("#curves svg"), box = svg.getBoundingClientRect();
svg.dispatchEvent(new MouseEvent("mousemove", {clientX: box.left + box.width / 2, clientY: box.top + 20}));</script></body>"""
        copy = self.folder / "copy.html"
        copy.write_text(self.text.replace("</body>", move), encoding="utf-8")
        chosen = urllib.parse.urlencode({"class": "bookcase", "mu": 0.6, "floor": "upper", "demand": "overturned", "im": "pgv_mps", "at": 50})
        page = re.sub(r"<script.*?</script>", "", support.browse(f"file://{copy}#{chosen}", "--host-resolver-rules=MAP * 127.0.0.1:9"), flags=re.S)
        self.assertEqual(len(re.findall(r"<svg", page)), 3)
        self.assertNotRegex(page, "NaN|undefined|Infinity")
        # The curves: those of the class on the floor, cell by cell, and the reference of the chosen one.
        rows = sorted(table(page, "curves"), key=lambda row: row["id"])
        mine = [curve for curve in self.curves if curve["demand"] == "overturned" and self.entries[curve["entry"]]["class"] == "bookcase" and self.entries[curve["entry"]]["floor"] == "upper"]
        points = [(self.entries[curve["entry"]]["id"], *point) for curve in mine for point in curve["points"]]
        counted = [row for row in rows if row["n"]]
        self.assertEqual(len(counted), len(points))
        for row, point in zip(counted, points):
            self.assertEqual(row["id"], point[0])
            for name, value in zip(("pgv_mps", "probability", "lower", "upper", "n"), point[1:]):
                self.assertEqual(float(row[name]), value)
        theirs = [row for row in rows if row["id"] == "E.1"]
        self.assertGreater(len(theirs), 30)
        for row in theirs:
            self.assertAlmostEqual(float(row["probability"]), make_database.share(float(row["pgv_mps"]), 0.29, 0.5), delta=2e-5)
        # The finding: the probability at the middle of the range, by the page's interpolation.
        at = (0.1 * 3) ** 0.5
        found = re.search(r"shelf_mu60_upper: P\(overturned\) = ([\d.]+) \(([\d.]+) to ([\d.]+)\) at PGV = 0.548", page)
        self.assertAlmostEqual(float(found.group(1)), make_database.share(at, make_database.median(0.32, 1.8, 0.6, "overturned", 0.5, "upper"), 0.4), delta=0.005)
        # Every entry with the friction on the floor; medians beside the reference; the readout under the pointer.
        self.assertEqual([row["id"] for row in table(page, "classes")], ["case_mu60_upper", "shelf_mu60_upper"])
        beside = table(page, "references")
        self.assertEqual([(row["reference"], row["id"]) for row in beside], [("E.1", "shelf_mu30_upper"), ("E.1", "shelf_mu60_upper")])
        self.assertAlmostEqual(float(beside[1]["median"]), make_database.median(0.32, 1.8, 0.6, "overturned", 0.5, "upper"), delta=1e-5)
        self.assertRegex(page, r'class="readout"[^>]*>PGV = [\d.]+ m/s: shelf_mu30_upper [\d.]+ \[[\d.]+, [\d.]+\]; shelf_mu60_upper')
        self.assertEqual(len(re.findall(r'<tr data-at="\d+"', page)), 2)

    @unittest.skipUnless(support.BROWSER, "no chromium (apt-get install chromium)")
    def test_in_a_browser_a_curve_without_a_lognormal_is_straight_between_its_points(self):
        chosen = urllib.parse.urlencode({"class": "display case", "mu": 0.3, "floor": "ground", "demand": "peak_slip_m", "capacity": 0.1, "im": "pgv_mps", "at": 56})
        page = re.sub(r"<script.*?</script>", "", support.browse(f"{(self.folder / 'report.html').resolve().as_uri()}#{chosen}"), flags=re.S)
        at = 0.1 * 30**0.56
        points = next(c["points"] for c in self.curves if self.entries[c["entry"]]["id"] == "case_mu30_ground" and (c["demand"], c["capacity"]) == ("peak_slip_m", 0.1))
        wanted = [float(np.interp(at, [p[0] for p in points], [p[k] for p in points])) for k in (1, 2, 3)]
        found = re.search(r"case_mu30_ground: P\([^)]*\) = ([\d.]+) \(([\d.]+) to ([\d.]+)\) at PGV", page)
        for text, value in zip(found.groups(), wanted):
            self.assertAlmostEqual(float(text), value, delta=0.00051)
        self.assertIn("case_mu30_ground is read by straight lines between its points", page)

    @staticmethod
    def crossing(curve, column):
        """Where straight lines through a column of the points first reach 1/2: infinite where they do not, minus so where they begin there."""
        ims, values = [point[0] for point in curve["points"]], [point[column] for point in curve["points"]]
        if values[0] >= 0.5:
            return -math.inf
        for k in range(1, len(ims)):
            if values[k] >= 0.5:
                return ims[k - 1] + (ims[k] - ims[k - 1]) * (0.5 - values[k - 1]) / (values[k] - values[k - 1])
        return math.inf

    def browsed_plateaus(self, floor):
        folder = make_database.make_database(self.folder.parent / f"plateaus_{floor}", make_database.plateaus())
        self.assertEqual(support.run("report", folder).returncode, 0)
        chosen = urllib.parse.urlencode({"class": "bookcase", "mu": 0.3, "floor": floor, "demand": "overturned", "im": "pgv_mps", "at": 50})
        return re.sub(r"<script.*?</script>", "", support.browse(f"{(folder / 'report.html').resolve().as_uri()}#{chosen}"), flags=re.S)

    @unittest.skipUnless(support.BROWSER, "no chromium (apt-get install chromium)")
    def test_in_a_browser_a_median_has_its_interval_and_is_one_number_everywhere(self):
        """A median is where the curve first reaches 1/2, and may be anywhere from where its upper limit does to where its lower limit does:
        in the csv of the picture, in the picture and in the table. A fit that failed has no say."""
        entries, curves = make_database.plateaus()
        for floor in ("upper", "ground"):
            page = self.browsed_plateaus(floor)
            self.assertNotRegex(page, "NaN|undefined|Infinity|84495|8[.]45e|[0-9]e[+]2")
            beside = {row["id"]: row for row in table(page, "references")}
            for curve in curves:
                entry = entries[curve["entry"]]
                if entry["floor"] != floor or entry["class"] != "bookcase" or curve["demand"] != "overturned":
                    continue
                row = beside[entry["id"]]
                for name, column in (("median", 1), ("median_lower", 3), ("median_upper", 2)):
                    wanted = self.crossing(curve, column)
                    with self.subTest(entry=entry["id"], name=name):
                        self.assertEqual(row[name], {math.inf: "> 3", -math.inf: "< 0.1"}[wanted]) if math.isinf(wanted) else \
                            self.assertAlmostEqual(float(row[name]), wanted, delta=1e-9)
                shown = re.search(rf'<tr data-at="{curve["entry"]}".*?</tr>', page, re.S).group(0)
                finite = self.crossing(curve, 1)
                if math.isfinite(finite):
                    self.assertIn(f">{finite:#.3g} ", shown)
        # Of the first one the interval is wide and open, and every place says so.
            if floor == "upper":
                self.assertRegex(page, r"shelf_mu30_upper: median 2\.\d+ m/s \[0\.4\d+, &gt; 3.00\]")
                self.assertRegex(page, r"<td>2\.\d+ \[0\.4\d+, &gt; 3.00\]</td>")
                self.assertIn("&gt; 3.00</td>", page)
                self.assertRegex(page, r'<p class="finding">Both of our medians lie above theirs on floor upper: 2 are, or may be, beyond what was swept<')
            else:
                self.assertRegex(page, r"is below 1/2 again at 1[.]28")

    @unittest.skipUnless(support.BROWSER, "no chromium (apt-get install chromium)")
    def test_in_a_browser_no_mark_hides_another_and_the_legend_is_drawn_as_the_marks(self):
        page = self.browsed_plateaus("upper")
        picture = re.search(r'<figure id="references".*?</figure>', page, re.S).group(0)
        marks = re.findall(r'<g class="mark" data-id="([^"]*)" data-y="([^"]*)"', picture)
        self.assertEqual([mark[0] for mark in marks], ["E.1", "shelf_mu30_upper", "shelf_mu60_upper"])
        self.assertEqual(len({mark[1] for mark in marks}), 3)
        self.assertEqual(len(re.findall(r'class="beyond"', picture)), 2)  # an arrow at the end of what was swept, for each that is open
        self.assertEqual(len(re.findall(r'class="theirs-mark"', picture)), 2)  # one in the row, one in the legend

    @unittest.skipUnless(support.BROWSER, "no chromium (apt-get install chromium)")
    def test_a_picture_is_as_wide_as_its_window(self):
        """On a telephone too: nothing to be moved aside before our medians are seen."""
        done = support.run("report", self.folder)
        self.assertEqual(done.returncode, 0)
        for width, (_, cut) in support.cut_off(self, (self.folder / "report.html").read_text(encoding="utf-8")).items():
            self.assertEqual(cut, [], f"{width} px")


if __name__ == "__main__":
    unittest.main()
