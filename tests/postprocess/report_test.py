#!/usr/bin/python3
"""postprocess/figures and postprocess/report as a user starts them: what they write, exit codes, messages."""
import html.parser
import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import unittest

import support
from freestand_post import reading, writing
from support import make_results

import h5py

VOID = {"meta", "br", "hr", "img", "link", "input", "path", "use", "rect", "line", "circle"}


class Page(html.parser.HTMLParser):
    """Walks a page: tags that are left open, ids, addresses, text."""

    def __init__(self, text):
        super().__init__()
        self.open, self.unbalanced, self.ids, self.addresses, self.tags, self.seen = [], [], [], [], [], []
        self.feed(text)
        self.text = " ".join(" ".join(self.seen).split())

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self._note(dict(attributes))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)
        self._note(dict(attributes))

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self.open or self.open.pop() != tag:
            self.unbalanced.append(tag)

    def handle_data(self, data):
        if not {"style", "script"} & set(self.open):
            self.seen.append(data)

    def _note(self, attributes):
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.addresses += [attributes[key] for key in ("src", "href", "xlink:href", "data") if attributes.get(key)]


def of_one_demand(folder):
    """A sweep with one demand parameter and no second axis: quick to draw."""
    folder = support.sweep_copy(folder)
    with h5py.File(folder / "fragility.h5", "a") as root:
        del root["edp/peak_rotation_over_alpha"]
        del root["edp/delta/axis"]
    return folder


def small(folder):
    """The same without samples."""
    folder = of_one_demand(folder)
    (folder / "samples.h5").unlink()
    return folder


class Temporary(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.kept.cleanup)
        folder = pathlib.Path(cls.kept.name)
        cls.sweep = support.sweep_copy(folder / "sweep")
        with h5py.File(cls.sweep / "fragility.h5", "a") as root:
            del root["edp/peak_rotation_over_alpha/axis"]
        history = make_results.make_history(folder / "case")
        cls.result = support.start("report", cls.sweep, "--history", history)
        cls.text = (cls.sweep / "report.html").read_text(encoding="utf-8")
        cls.page = Page(cls.text)

    def test_prints_the_path_and_nothing_else(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.assertEqual(self.result.stdout, f"{(self.sweep / 'report.html').resolve()}\n")

    def test_fetches_nothing(self):
        outside = [address for address in self.page.addresses if not address.startswith(("#", "data:"))]
        self.assertEqual(outside, [])
        self.assertFalse({"link", "iframe", "object"} & set(self.page.tags))
        self.assertNotRegex(self.text, r"@import|url\((?!#)")

    def test_is_balanced_and_ids_are_unique_and_found(self):
        self.assertEqual((self.page.unbalanced, self.page.open), ([], []))
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        wanted = {address[1:] for address in self.page.addresses if address.startswith("#")}
        wanted |= set(re.findall(r"url\(#([^)]+)\)", self.text))
        self.assertLessEqual(wanted, set(self.page.ids))

    def test_nothing_is_cut_off(self):
        """On a telephone the two tables of bins scroll in their place, and nothing else is wider than it."""
        bins = "PTA/(μg)\xa0−\xa01"
        self.assertEqual(support.cut_off(self, self.text), {1300: ([], []), 420: ([bins, bins], [])})

    def test_every_picture_is_inside(self):
        for name in ("fragility_delta", "surface_delta", "axis_delta_friction_mu_k", "goodness_delta", "overturning", "coverage",
                     "history", "fragility_peak_rotation_over_alpha"):
            self.assertIn(name, self.page.ids)
        self.assertEqual(self.page.tags.count("svg"), 12)
        self.assertNotIn("<?xml", self.text)

    def test_headline_outcomes_warnings_provenance_study(self):
        for needle in ("Refrigerator: seismic fragility", "6 000 samples", "20 s on 2 cores: sweep 12 s (480 samples a second), accuracy check 2.0 s, writing 1.0 s, fit 5.0 s",
                       "under a pulse of 3 kinds (A, B, C1), by one of the study's 7 entries of motions",
                       "Painlevé's paradox 1", "1 sample met Painlevé", "0123456789abcdef", "freestand run study.yaml -o results",
                       "hdf5 1.10.8", "peak acceleration PTA (g)", "design: sobol"):
            self.assertIn(needle, self.page.text)

    def test_failed_bins_are_marked_in_the_table(self):
        with h5py.File(self.sweep / "fragility.h5") as root:
            failed = sum(int((root[f"edp/{name}/status"][()] == 2).sum()) for name in ("delta", "peak_rotation_over_alpha"))
        self.assertGreater(failed, 0)
        self.assertEqual(self.text.count('<tr class="failed">'), failed)
        self.assertEqual(self.page.text.count("✗ fails"), failed)

    def test_what_is_merely_not_refuted_is_told_with_its_bound(self):
        with h5py.File(self.sweep / "fragility.h5") as root:
            states = [root[f"edp/{name}"] for name in ("delta", "peak_rotation_over_alpha")]
            unproven = [off_by for edp in states for off_by in edp["off_by"][()][edp["status"][()] == 4]]
            adequate = [off_by for edp in states for off_by in edp["off_by"][()][edp["status"][()] == 0]]
        self.assertGreater(len(unproven), 0)
        for off_by in unproven:
            self.assertIn(f"not refuted, may be off by {off_by:.2f}: counted", self.page.text)
        for off_by in adequate:
            self.assertIn(f"off by at most {off_by:.2f}", self.page.text)

    def test_text_from_files_is_escaped(self):
        with tempfile.TemporaryDirectory() as kept:
            folder = small(pathlib.Path(kept) / "sweep")
            summary = json.loads((folder / "summary.json").read_text())
            summary["study_name"], summary["warnings"] = "<b>bold</b> & \"co\"", ["<script>alert(1)</script>"]
            (folder / "summary.json").write_text(json.dumps(summary))
            self.assertEqual(support.run("report", folder).returncode, 0)
            text = (folder / "report.html").read_text(encoding="utf-8")
            self.assertNotIn("<script>alert", text)
            self.assertNotIn("<b>bold", text)


class Figures(Temporary):
    def test_svg_and_png_of_every_picture_and_their_captions(self):
        folder = small(self.folder / "sweep")
        result = support.start("figures", folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        target = folder / "figures"
        captions = json.loads((target / "captions.json").read_text(encoding="utf-8"))
        listed = dict(line.split()[::-1] for line in (target / "freestand.files").read_text(encoding="utf-8").splitlines()[1:])
        self.assertEqual(set(listed) | {"freestand.files"}, {path.name for path in target.iterdir()})
        self.assertEqual(set(captions), {"fragility_delta", "surface_delta", "goodness_delta", "overturning",
                                         "happening_connection_failed"})
        for name in captions:
            self.assertTrue((target / f"{name}.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>"))
            self.assertEqual((target / f"{name}.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_the_list_is_the_programs(self):
        """Hashes as published for FNV-1a, 64 bits; tests/io/own_files_test.cpp has the same. What others have listed stays."""
        (self.folder / "one").write_text("a")
        (self.folder / "two").write_text("foobar")
        writing.write_list(self.folder, ["two"])
        writing.write_list(self.folder, ["one"])
        lines = (self.folder / "freestand.files").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[1:], ["85944171f73967e8 two", "af63dc4c8601ec8c one"])

    def test_same_files_twice(self):
        case = make_results.make_history(self.folder / "case")
        support.run("figures", case, "-o", self.folder / "one")
        support.run("figures", case, "-o", self.folder / "two")
        for name in ("history.svg", "history.png", "captions.json"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes(), name)


class MissingAndBroken(Temporary):
    def refused(self, code, *needles, program="report", arguments=()):
        result = support.run(program, *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertEqual(result.stdout, "")
        for needle in needles:
            self.assertIn(needle, result.stderr)

    def test_one_simulated_case_alone(self):
        case = make_results.make_history(self.folder / "case", overturned=True)
        self.assertEqual(support.run("report", case).returncode, 0)
        page = Page((case / "report.html").read_text(encoding="utf-8"))
        self.assertEqual(page.tags.count("svg"), 1)
        self.assertIn("largest slip", page.text)

    def test_without_samples_summary_and_overturning(self):
        folder = small(self.folder / "sweep")
        (folder / "summary.json").unlink()
        with h5py.File(folder / "fragility.h5", "a") as root:
            del root["overturning"]
        self.assertEqual(support.run("report", folder).returncode, 0)
        page = Page((folder / "report.html").read_text(encoding="utf-8"))
        for needle in ("summary.json is not there", "samples.h5 is not there", "No overturning curve"):
            self.assertIn(needle, page.text)
        self.assertNotIn("coverage", page.ids)

    def test_where_few_samples_are_kept_the_page_says_of_which_it_speaks(self):
        folder = of_one_demand(self.folder / "sweep")
        with h5py.File(folder / "samples.h5", "a") as root:
            for name in list(root["samples"]):
                values, attributes = root["samples"][name][:1000], {key: value for key, value in root["samples"][name].attrs.items() if not key.isupper()}
                del root["samples"][name]
                root["samples"][name] = values
                root["samples"][name].attrs.update(attributes)
        self.assertEqual(support.run("report", folder).returncode, 0)
        text = (folder / "report.html").read_text()
        self.assertIn("drawn, of the 1\u202f000 samples kept", text)
        self.assertIn("samples kept shown", text)

    def test_where_samples_were_passed_over_draws_are_those_before_them(self):
        """What was integrated later lies in the bins that wanted it: its draws are not those of the study."""
        folder = of_one_demand(self.folder / "sweep")
        with h5py.File(folder / "samples.h5", "a") as root:
            root.attrs["samples_alike"] = 2000
            root["samples/outcome"][2000::2] = 6
            root["samples/pulse_period_s"][2000:] *= 10
            largest = root["samples/pulse_period_s"][:2000].max()
        with h5py.File(folder / "fragility.h5", "a") as root:
            root.attrs["samples_alike"] = 2000
        found = reading.read_sweep(folder)
        self.assertEqual(found.kept, 2000)
        self.assertEqual(found.draws["pulse_period_s"].max(), largest)
        self.assertEqual(support.run("report", folder).returncode, 0)
        self.assertIn("drawn, of the 2\u202f000 samples before any was passed over", (folder / "report.html").read_text())

    def test_truncated_file_is_one_line_and_exit_3(self):
        path = support.sweep_copy(self.folder / "sweep") / "fragility.h5"
        path.write_bytes(path.read_bytes()[:20_000])
        for program in ("report", "figures"):
            self.refused(3, "fragility.h5", program=program, arguments=[path.parent])
        self.assertFalse((path.parent / "report.html").exists())

    def test_wrong_folders(self):
        self.refused(3, "is not a folder", arguments=[self.folder / "nowhere"])
        self.refused(3, "no fragility.h5", arguments=[self.folder])
        case = make_results.make_history(self.folder / "case")
        self.refused(3, "has no history.csv", arguments=[case, "--history", self.folder])

    def test_usage(self):
        for program in ("report", "figures"):
            self.assertEqual(support.run(program).returncode, 2)
            self.assertEqual(support.run(program, "a", "--nothing").returncode, 2)
            self.assertEqual(support.run(program, "a", "b").returncode, 3)
            self.assertEqual(support.run(program, "--help").returncode, 0)
        self.assertIn("database", support.run("report", "--help").stdout)

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_no_permission(self):
        case = make_results.make_history(self.folder / "case")
        case.chmod(0o500)
        self.addCleanup(case.chmod, 0o700)
        self.refused(2, "no permission", arguments=[case])

    def test_place_that_cannot_be_written(self):
        case = make_results.make_history(self.folder / "case")
        self.refused(2, "cannot be written", arguments=[case, "-o", self.folder / "nowhere" / "report.html"])
        self.refused(2, "cannot be written", program="figures", arguments=[case, "-o", case / "history.csv"])

    def test_a_disk_that_fills_leaves_what_stood_there(self):
        """A limit on the size of files stands for a full disk: the file is named, the exit code is that of freestand, nothing is cut."""
        case = make_results.make_history(self.folder / "case")
        for program, name, what in (("report", "report.html", "page of yesterday"), ("figures", "captions.json", "captions")):
            target = case if program == "report" else case / "figures"
            target.mkdir(exist_ok=True)
            (target / name).write_text(what)
            before = sorted(target.iterdir())
            done = subprocess.run([support.POSTPROCESS / program, case], capture_output=True, text=True, timeout=250,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
            self.assertEqual((done.returncode, done.stdout), (74, ""))
            self.assertRegex(done.stderr, rf"^postprocess/{program}: {re.escape(str(target))}/[a-z.]+ cannot be written \(file too large\): ")
            self.assertEqual(sorted(target.iterdir()), before)
            self.assertEqual((target / name).read_text(), what)

    def test_a_page_goes_where_a_link_points_and_into_a_pipe(self):
        case = make_results.make_history(self.folder / "case")
        (self.folder / "link.html").symlink_to(self.folder / "page.html")
        self.assertEqual(support.run("report", case, "-o", self.folder / "link.html").returncode, 0)
        self.assertTrue((self.folder / "link.html").is_symlink())
        self.assertIn("</html>", (self.folder / "page.html").read_text(encoding="utf-8"))
        done = support.start("report", case, "-o", "/dev/stdout")
        self.assertEqual(done.returncode, 0)
        self.assertIn("</html>", done.stdout)


if __name__ == "__main__":
    unittest.main()
