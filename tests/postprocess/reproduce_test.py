#!/usr/bin/python3
"""The page of the report computed again, from invented results: what it says, that nothing is cut off, and what it refuses."""
import html
import json
import pathlib
import tempfile
import unittest

import support

import numpy as np
from freestand_post import pictures, style
from freestand_post.command import read
from freestand_post.problem import Problem
from freestand_post.report import page
from pictures_test import overlaps


def number(name, ours, printed=None, verdict="not printed", why=""):
    return {"id": name, "kind": "number", "what": f"what {name} is", "unit": "1", "ours": ours, "print": printed, "print_unit": None if printed is None else 0.01, "reach": None,
            "difference": None if printed is None else ours - printed, "verdict": verdict, "why": why}


def line_tables():
    im = np.linspace(0.5, 5, 20)
    delta = 0.7 * im * np.where(np.arange(20) % 2, 1.4, 0.6)
    grid = np.linspace(0.1, 6, 40)
    u = np.sort(np.linspace(0.02, 0.97, 20))
    return {"points": ("specimen_and_motion,im,delta,line,standard_deviation,probability_below", [("a block", x, y, 0.7 * x, 0.3 * x, 0.5) for x, y in zip(im, delta)]),
            "line": ("im,mean,mean_less_sigma,mean_plus_sigma,median,fractile_16,fractile_84", [(x, 0.7 * x, 0.4 * x, x, 0.65 * x, 0.4 * x, x) for x in grid]),
            "bins": ("im_low,im_high,im,n,mean,standard_deviation,lambda,omega", [(0.5, 2.5, 1.5, 10, 1, 0.4, 0, 0.4), (2.5, 5, 4, 10, 2.8, 1, 1, 0.4)]),
            "ks": ("probability_below,share_before,share_after", [(x, i / 20, (i + 1) / 20) for i, x in enumerate(u)]),
            "surface": ("im,capacity,probability", [(x, c, 1 / (1 + (c / (0.7 * x)) ** 3)) for x in grid[::4] for c in grid[::4]])}


LINE = [number(f"best_fit.{name}", value) for name, value in (("sd_slope", 0.3), ("slope_se", 0.1), ("ks_ours", 0.12), ("ks_critical", 0.2), ("ks_critical_textbook", 0.25), ("ks_p", 0.4))]


def make(folder, own=""):
    """A line of which the print disagrees in its slope, and tests of which one of twelve does."""
    folder.mkdir()
    files = []
    for name, (columns, rows) in line_tables().items():
        files.append(f"best_fit_{name}.csv")
        (folder / files[-1]).write_text(f"figure,series,{columns}\n" + "".join(",".join(map(str, ("best_fit", "best_fit", *row))) + "\n" for row in rows))
    slope = number("best_fit.slope", 0.7, *(() if own else (0.6, "print disagrees with itself", "its table gives another")))
    line = {"id": "best_fit", "chapter": 5, "place": "Figures", "what": "peaks", "items": [slope, number("best_fit.r2", 0.5), *LINE], "files": files, "left_out": ["what is not there"]}
    rows = [number(f"table_5_1.{i}", 1 + i / 7, 1 + round(i / 7, 2), "agrees") for i in range(12)]
    table = {"id": "table_5_1", "chapter": 5, "place": "Table 5.1", "what": "rows", "items": rows, "files": [], "left_out": []}
    document = {"format": "freestand-reproduce/1", "own_peaks": own or None, "numbers_printed": 0 if own else 13, "numbers_that_agree": 0 if own else 12, "numbers_that_disagree": 0,
                "numbers_in_which_the_print_disagrees_with_itself": 0 if own else 1, "records": False, "figures": [line] if own else [table, line], "provenance": {"version": "0", "ranks": 1}}
    (folder / "reproduce.json").write_text(json.dumps(document))
    return folder


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="freestand-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_it_says_what_agrees_and_why_the_rest_does_not(self):
        found = read([make(self.folder / "a")])
        text = page(found)
        plain = html.unescape(text)
        for words in ("<h1>12 of 13 numbers of the report agree within rounding</h1>", "the print disagrees with itself: its table gives another", "Not computed: what is not there.", ">0.60<", ">0.7000<"):
            self.assertIn(words, plain)
        self.assertEqual(text.count("<svg"), 4)  # ours against the print; line, fit and surface
        self.assertEqual(support.cut_off(self, text), {1300: ([], []), 420: ([], [])})

    def test_statements_that_disagree_stand_in_the_headline_too(self):
        """The table of what does not agree has them; a headline without them would contradict it."""
        folder = make(self.folder / "a")
        self.assertNotIn("statement", html.unescape(page(read([folder]))).split("<main>")[0])
        path = folder / "reproduce.json"
        found = json.loads(path.read_text())
        found["figures"][0]["items"].append({"id": "table_5_1.s", "kind": "statement", "what": "does it fall", "ours": "no", "print": "yes", "verdict": "disagrees", "why": "it stands"})
        path.write_text(json.dumps(found))
        self.assertIn("<dd>1</dd><dt>statement in words that disagrees, beside the numbers</dt>", page(read([folder])))

    def test_no_two_texts_of_a_picture_overlap(self):
        style.apply()
        for picture in pictures.draw(read([make(self.folder / "a")])[0]):
            with self.subTest(picture.name):
                self.assertEqual(overlaps(picture.figure), [])

    def test_peaks_of_ones_own(self):
        text = page(read([make(self.folder / "own", "mine.csv")]))
        self.assertIn("<h1>Measured peaks of mine.csv: line, bins, fit and fragility</h1>", text)
        self.assertNotIn("What does not agree", text)
        self.assertNotIn("<th>print</th>", text)

    def test_what_cannot_be_shown_is_refused(self):
        folder = make(self.folder / "a")
        with self.assertRaisesRegex(Problem, "page of its own"):
            read([folder, folder])
        (folder / "best_fit_line.csv").unlink()
        with self.assertRaisesRegex(Problem, "best_fit_line.csv cannot be read"):
            page(read([folder]))
        (folder / "reproduce.json").write_text('{"format": "freestand-reproduce/9"}')
        with self.assertRaisesRegex(Problem, "freestand-reproduce/9"):
            read([folder])


if __name__ == "__main__":
    unittest.main()
