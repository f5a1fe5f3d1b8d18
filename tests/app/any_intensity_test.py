"""Any intensity, bins, demands and capacities out of one sweep, the ranking of intensities, and what is told of mistakes."""

import csv
import json
import re
import shutil
import unittest

from support import InFolder, datasets, folder_of_class, h5py, run, study_text, write_records

RECORDS = '  - {records: "records/*.csv", scale_to: {pta_g: {uniform: [0.1, 1.5]}}}\n'
WITHOUT_ORIGIN = {"study", "study_name", "command", "host", "created_utc", "ranks"}


def study_over(im, samples=1500):
    text = study_text(samples=samples).replace("im: report", f"im: {im}")
    return text[:text.index("  - {pulse")] + RECORDS + text[text.index("fragility:"):]


class AnyIntensity(InFolder):
    """Each test has a copy of one sweep and of its records."""

    @classmethod
    def setUpClass(cls):
        cls.swept = folder_of_class(cls)
        write_records(cls.swept / "records")
        (cls.swept / "study.yaml").write_text(study_over("report"))
        cls.done = run(["run", cls.swept / "study.yaml", "-o", cls.swept / "out"], 2)
        cls.done.check_returncode()

    def setUp(self):
        super().setUp()
        shutil.copytree(self.swept, self.folder, dirs_exist_ok=True)
        self.out = self.folder / "out"

    def fit(self, name, *options, ranks=1):
        self.succeed(["fit", self.out, *options, "-o", self.folder / name], ranks)
        return self.folder / name

    def assert_same(self, a, b):
        """The same files, but for where they come from."""
        self.assertEqual(datasets(a / "fragility.h5"), datasets(b / "fragility.h5"))
        for name in ("bins.csv", "surface.csv", "ranking.csv"):
            self.assertEqual((a / name).read_bytes(), (b / name).read_bytes(), name)
        with h5py.File(a / "fragility.h5") as one, h5py.File(b / "fragility.h5") as other:
            for key in set(one.attrs) - WITHOUT_ORIGIN:
                self.assertEqual(str(one.attrs[key]), str(other.attrs[key]), key)

    def test_one_sweep_answers_as_sweeps_of_their_own(self):
        before = {path.name: path.read_bytes() for path in self.out.iterdir() if path.is_file()}
        for im, option in (("pga_g", "pga_g"), ("{name: sa_g, period_s: 0.5}", "sa_g:0.5"), ("housner_m", "housner_m")):
            own = self.folder / "own"
            self.succeed(["run", self.write("own.yaml", study_over(im)), "-o", own, "--overwrite", "--quiet"])
            self.assert_same(self.fit(option.replace(":", "_"), "--im", option, ranks=2), own)
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir() if path.is_file()}, before)

    def test_the_records_need_not_be_there_and_the_fit_can_be_swept_again(self):
        first = self.fit("first", "--im", "pgv_mps", "--bins", "4", "--edp", "delta", "--capacities", "delta=0.5,1.5")
        self.succeed(["run", first / "study.yaml", "-o", self.folder / "again", "--quiet"])
        self.assert_same(first, self.folder / "again")
        for record in (self.folder / "records").iterdir():
            record.unlink()
        self.assert_same(self.fit("second", "--im", "pgv_mps", "--bins", "4", "--edp", "delta", "--capacities", "delta=0.5,1.5"), first)
        summary = json.loads((first / "summary.json").read_text())
        self.assertEqual(summary["samples_in"], "../out")
        self.assertLessEqual({"fragility.bins", "fragility.capacities", "fragility.edp", "fragility.im"}, set(summary["study_changed"]))

    def test_a_period_between_those_kept_is_told_with_how_well(self):
        done = self.succeed(["fit", self.out, "--im", "sa_g:0.333", "-o", self.folder / "third"])
        self.assertRegex(done.stdout, r"sa_g at 0.333 s is interpolated")
        summary = json.loads((self.folder / "third" / "summary.json").read_text())
        self.assertTrue(any("interpolated" in warning for warning in summary["warnings"]))
        self.assertEqual(summary["im_period_s"], 0.333)
        self.assertNotIn("interpolated", self.succeed(["fit", self.out, "--im", "sa_g:0.33", "-o", self.folder / "fourth"]).stdout)

    def test_intensities_are_ranked_in_every_output(self):
        self.assertIn("best intensity for delta: ", self.done.stdout)
        ranking = json.loads((self.out / "summary.json").read_text())["ranking"]
        self.assertEqual((ranking["samples"], ranking["swept"]), (1500, 1500))
        ims = [entry["im"] for entry in ranking["demands"]["delta"]]
        self.assertEqual(len(ims), len(set(ims)))
        self.assertLessEqual({"pga_g", "pgv_mps", "pgd_m", "sa_g:0.5", "sa_g:1", "housner_m", "report"}, set(ims))
        scatters = [entry["scatter"] for entry in ranking["demands"]["delta"]]
        self.assertEqual(scatters, sorted(scatters))
        on = {left["on"]: left["motions"] for left in ranking["demands"]["delta"][0]["sufficiency"]}
        self.assertEqual(on, {"record_pulse_period_s": 6})
        with open(self.out / "ranking.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["edp"] == "delta"]
        self.assertEqual([row["im"] for row in rows], ims)
        table = self.succeed(["fit", self.out, "--rank"], 3).stdout
        for im in ims:
            self.assertRegex(table, re.escape(im) + r" +[\d.]+")
        self.assertEqual(json.loads((self.out / "summary.json").read_text())["ranking"], ranking)  # on any number of ranks

    def test_a_target_is_the_sweep_that_would_have_been_made(self):
        """Of samples that are swept over a wide range of friction, those of a narrow one."""
        target = "friction.mu_k={uniform: [0.2, 0.3]}"
        first = self.fit("first", "--target", target, "--bins", "0.1,0.6,1.5")
        self.assert_same(self.fit("three", "--target", target, "--bins", "0.1,0.6,1.5", ranks=3), first)
        summary = json.loads((first / "summary.json").read_text())
        self.assertTrue(any(re.search(r"target: \d+ % of the samples stay, so that friction.mu_k is \{uniform: \[0.2, 0.3\]\}", w) for w in summary["warnings"]))
        self.assertLess(sum(summary["outcomes"].values()), 900)
        own = study_over("report", samples=6000).replace("{lognormal: {median: 0.25, dispersion: 0.4}}", "{uniform: [0.2, 0.3]}").replace("bins: {count: 5}", "bins: {edges: [0.1, 0.6, 1.5]}")
        self.succeed(["run", self.write("own.yaml", own), "-o", self.folder / "own", "--quiet"])
        curves = []
        for folder in (first, self.folder / "own"):
            with h5py.File(folder / "fragility.h5") as file:
                curves.append([file[f"edp/delta/surface/{name}"][()] for name in ("probability", "lower", "upper")])
        (p, low, high), (q, other_low, other_high) = curves
        self.assertTrue(((p - q) ** 2 <= ((high - low) ** 2 + (other_high - other_low) ** 2)).all(), (p, q))  # half widths of 95 %, doubled
        self.fail_with(2, ["fit", self.out, "--target", "friction.mu_k={uniform: [2, 3]}", "-o", self.folder / "no"], "hardly any sample lies where the target")
        self.fail_with(2, ["fit", self.out, "--target", "friction.mu_k={uniform: [0.7, 0.72]}", "-o", self.folder / "no"], "of 1500 samples", "minimum_samples")
        self.assertFalse((self.folder / "no").exists())

    def test_what_a_table_of_records_gives_is_an_intensity(self):
        study = study_over("report").replace("records/*.csv", "records.csv")
        out = self.folder / "table"
        self.succeed(["run", self.write("table.yaml", study), "-o", out], 2)
        self.succeed(["fit", out, "--im", "record.pga_g", "-o", self.folder / "by_table"])
        with h5py.File(self.folder / "by_table" / "fragility.h5") as file:
            self.assertEqual((file.attrs["im"], file.attrs["im_unit"]), ("record.pga_g", "g"))
        ranked = json.loads((out / "summary.json").read_text())["ranking"]["demands"]["delta"]
        self.assertIn("record.pga_g", [entry["im"] for entry in ranked])
        self.assertEqual({left["on"] for left in ranked[0]["sufficiency"]}, {"record_pulse_period_s", "record_magnitude_mw"})
        # On a floor it is the ground's: for targets that know the ground's alone, and for hazard curves.
        by_table = self.folder / "by_table"
        self.succeed(["export", by_table, "--format", "openquake", "--form", "counted", "--limit-state", "delta:1", "--skip-empty", "-o", self.folder / "ground.xml"])
        self.assertIn('imt="PGA"', (self.folder / "ground.xml").read_text())
        self.fail_with(2, ["export", by_table, "--format", "pelicun", "-o", self.folder / "floor"], "those of the floor on which a component stands")
        self.fail_with(2, ["export", by_table, "--format", "openquake", "--period", "0.5", "-o", self.folder / "no.xml"], "over record.pga_g", "leave it out")
        curve = self.write("hazard.csv", "pga_g,annual_rate\n0.05,0.01\n0.3,0.002\n1,0.0001\n")
        self.fail_with(2, ["risk", by_table, "--hazard", curve, "-o", self.folder / "no"], "name its column record.pga_g")
        self.fail_with(2, ["risk", out, "--hazard", curve, "-o", self.folder / "no"], "--im pga_g", "over record.pga_g")
        self.succeed(["risk", by_table, "--hazard", self.write("ground.csv", curve.read_text().replace("pga_g", "record.pga_g")), "-o", self.folder / "risk"])
        self.fail_with(2, ["fit", out, "--im", "record.pgv_mps", "-o", self.folder / "no"], "record.pgv_mps is not in the tables", "they give record.pga_g, record.magnitude_mw")
        self.assertFalse((self.folder / "no").exists())

    def test_mistakes_are_told_and_make_no_folder(self):
        into = self.folder / "into"
        for words, *options in ((("intensity measure pgx is not known",), "--im", "pgx"),
                                (("kept from 0.02 to 10 s",), "--im", "sa_g:30"),
                                (("does not increase",), "--bins", "2,1"),
                                (("slip is not known",), "--edp", "slip"),
                                (("names no demand",), "--capacities", "0.1")):
            done = self.fail_with(2, ["fit", self.out, *options, "-o", into], *words, ranks=2)
            self.assertNotIn("unexpected", done.stderr)
            self.assertFalse(into.exists(), options)
        self.fit("into")
        self.fail_with(2, ["fit", self.out, "-o", into], "not empty")
        self.fit("into", "--overwrite")
        self.fail_with(3, ["fit", into], "holds a fit, and no samples")


class Catalogues(InFolder):
    def test_they_list_and_explain(self):
        self.assertIn("what the table of records gives as pga_g", self.succeed(["im", "record.pga_g"]).stdout)
        self.fail_with(2, ["im", "record.colour"], "colour is no column", "record.pga_g")
        self.assertIn("record.COLUMN", self.succeed(["im"]).stdout)
        for verb, name in (("im", "sa_g"), ("edp", "peak_slip_m")):
            self.assertIn(name, self.succeed([verb]).stdout)
            page = self.succeed([verb, name]).stdout
            for word in ("source", "study", "afterwards"):
                self.assertIn(word, page)
            entries = json.loads(self.succeed([verb, "--json"]).stdout)
            one = json.loads(self.succeed([verb, name, "--json"]).stdout)
            self.assertIn(one, entries)
            self.fail_with(2, [verb, name + "x"], "is not in the catalogue", f"did you mean {name}?")


if __name__ == "__main__":
    unittest.main()
