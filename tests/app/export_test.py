"""`export` as its users meet it: a real sweep goes out, and reads back, in Python, as surface.csv has it; mistakes are told."""

import csv
import json
import math
import unittest
import xml.etree.ElementTree as xml

import numpy
import scipy.stats

from support import InFolder, folder_of_class

STUDY = """\
name: lab fridge no. 7
seed: 3
samples: 4000
block: {width_m: 0.55, height_m: {uniform: [1.6, 2.4]}, mass_kg: 300}
friction: {mu_k: 0.28, static_ratio: 1.2}
motions:
  - {pulse: [A, B, C1], period_s: {uniform: [0.4, 2]}, peak_acceleration_g: {log_uniform: [0.1, 2]}}
fragility:
  im: IM
  bins: {count: 6}
  edp: [peak_slip_m, overturned]
  capacities: {peak_slip_m: [0.05, 0.2]}
  resamples: 50
"""
STATES = ["peak_slip_m_over_0p05", "peak_slip_m_over_0p2", "overturned"]
NRML = "{http://openquake.org/xmlns/nrml/0.5}"


class Export(InFolder):
    fine = {}

    def sweep(self, im="pga_g", study=STUDY):
        self.im, self.out = im, self.folder / "run"
        self.succeed(["run", self.write("study.yaml", study.replace("IM", im)), "-o", self.out, "--quiet"])
        self.surface = dict(self.shares(self.out))

    @staticmethod
    def shares(out):
        """Of each limit state: intensity, probability and its band, bin by bin."""
        with open(out / "surface.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        name = lambda row: row["edp"] if row["edp"] == "overturned" else f"{row['edp']}_over_{row['capacity'].replace('.', 'p')}"  # noqa: E731
        return [(of, [[float(row[key]) for key in ("im", "probability", "lower", "upper")] for row in rows if name(row) == of])
                for of in dict.fromkeys(map(name, rows))]

    def fine_shares(self):
        """Of twenty times as many other samples, in eight times as many bins: swept once, and fitted over each intensity."""
        if not self.fine:
            folder = folder_of_class(type(self))
            (folder / "fine.yaml").write_text(STUDY.replace("IM", "pga_g").replace("seed: 3", "seed: 4").replace("samples: 4000", "samples: 80000").replace("count: 6", "count: 48"))
            self.succeed(["run", folder / "fine.yaml", "-o", folder / "pga_g", "--quiet"])
            self.succeed(["fit", folder / "pga_g", "--im", "pgv_mps", "-o", folder / "pgv_mps"])
            self.fine.update({im: {name: [row[:2] for row in rows] for name, rows in self.shares(folder / im)} for im in ("pga_g", "pgv_mps")})
        return self.fine[self.im]

    def export(self, form, to, *more, format=None):
        format = format or ("openquake" if str(to).endswith(".xml") else "incore" if str(to).endswith(".json") else "csv")
        return self.succeed(["export", self.out, "--format", format, "--form", form, "-o", to, *more])

    def certificate(self, folder=None):
        return json.loads(((folder or self.folder) / "certificate.json").read_text())["files"]

    def against_surface(self, probability, entry, within=1e-9):
        """Off the counted shares by no more than the certificate says (bins that fell are pooled, and the share of a whole bin is not
        that at its mean), within the 0.05 that curves may be off of those of many samples in narrow bins, and between the shares of the
        bins on both sides."""
        off = {state["name"]: state["largest_difference_from_surface"] for state in entry["limit_states"]}
        truth = self.fine_shares()
        pooled = {state["name"]: state["pooled_by"] for state in entry["limit_states"]}
        for state, points in self.surface.items():
            shares = [0] + [p for _, p, _, _ in points] + [1]
            for i, (im, p, _, _) in enumerate(points):
                found = probability(state, im)
                self.assertLessEqual(abs(found - p), off[state] + within, f"{state} at {im}")
                self.assertLess(abs(found - numpy.interp(im, *zip(*truth[state]))), 0.05, f"{state} at {im}")
                slack = pooled[state] + within
                self.assertTrue(min(shares[i], p) - slack <= found <= max(p, shares[i + 2]) + slack, f"{state} at {im}")

    def test_levels_of_openquake_are_the_surface(self):
        self.sweep("pgv_mps")
        self.export("discrete", self.folder / "fridge.xml")
        model = xml.parse(self.folder / "fridge.xml").getroot()[0]
        self.assertEqual(model.find(NRML + "limitStates").text.split(), STATES)
        function = model.find(NRML + "fragilityFunction")
        self.assertEqual(function[0].get("imt"), "PGV")
        levels = [float(x) for x in function[0].text.split()]
        values = {node.get("ls"): [float(x) for x in node.text.split()] for node in function[1:]}
        # freestand has m/s, OpenQuake cm/s
        entry = self.certificate()["fridge.xml"]
        self.against_surface(lambda state, im: numpy.interp(100 * im, levels, values[state]), entry)
        self.assertLess(entry["largest_difference"], 1e-6)
        self.assertTrue(entry["holds"])

    def test_a_spectral_acceleration_goes_out_at_its_period(self):
        self.sweep("{name: sa_g, period_s: 0.5}")
        self.export("discrete", self.folder / "fridge.xml")
        self.assertIn('imt="SA(0.5)"', (self.folder / "fridge.xml").read_text())
        self.export("discrete", self.folder / "fridge.csv", format="csv")
        self.assertIn(",sa_g at 0.5 s,g,", (self.folder / "fridge.csv").read_text())

    def test_a_lognormal_is_what_the_function_says(self):
        self.sweep()
        done = self.succeed(["export", self.out, "--format", "csv", "-o", self.folder / "fridge.csv"])
        with open(self.folder / "fridge.csv", newline="") as file:
            rows = {row["limit_state"]: row for row in csv.DictReader(file)}
        adequate = [state for state in STATES if rows[state]["adequate"] == "yes"]
        for state in STATES:
            word = "overturned" if state == "overturned" else "peak_slip_m:" + state.split("_over_")[1].replace("p", ".")
            command = ["export", self.out, "--format", "openquake", "--form", "lognormal", "--limit-state", word, "-o",
                       self.folder / f"{state}.xml"]
            if state not in adequate:
                self.assertRegex(self.fail_with(2, command, "use --form discrete").stderr,
                                 "is not adequate|not known to be adequate|gives other annual rates than the counts")
                continue
            self.succeed(command)
            params = xml.parse(self.folder / f"{state}.xml").getroot()[0].find(NRML + "fragilityFunction")[1]
            mean, deviation = float(params.get("mean")), float(params.get("stddev"))
            sigma = math.sqrt(math.log(1 + (deviation / mean) ** 2))
            self.assertAlmostEqual(sigma, float(rows[state]["dispersion"]), 9)
            self.assertAlmostEqual(mean * math.exp(-sigma**2 / 2), float(rows[state]["median"]), 9)
        self.assertIn("read back as csv reads it", done.stdout)

    def test_incore_text_is_python_that_gives_the_surface(self):
        # Wide bins in which blocks move, and whose lognormals are taken however much they are off, have their three parts.
        study = STUDY.replace("count: 6}", "count: 3}\n  adequate: 0.9")
        self.sweep(study=study.replace("log_uniform: [0.1, 2]", "log_uniform: [0.5, 2]"))
        for form in ("discrete", "parts"):
            done = self.export(form, self.folder / "fridge.json", "--overwrite")
            self.assertIn(f"overturned: {form}", done.stdout)
            curves = json.loads((self.folder / "fridge.json").read_text())["fragilityCurves"]
            text = {curve["description"]: curve["rules"][0]["expression"] for curve in curves}
            self.assertEqual("norm.cdf" in text["peak_slip_m_over_0p2"], form == "parts")
            self.against_surface(lambda state, im: eval(text[state], {"numpy": numpy, "scipy": scipy, "math": math, "PGA": im}),
                                 self.certificate()["fridge.json"])

    def test_pelicun_capacities_are_the_surface(self):
        self.sweep()
        folder = self.folder / "fridge"
        self.export("discrete", folder, format="pelicun")
        with open(folder / "fragility.csv", newline="") as file:
            row = next(csv.DictReader(file))
        self.assertEqual((row["ID"], row["Demand-Type"], row["Demand-Unit"]), ("lab_fridge_no__7", "Peak Floor Acceleration", "g"))

        def probability(state, im):
            x, y = row[f"LS{STATES.index(state) + 1}-Theta_0"].split("|")
            x, y = [float(f"{float(v) * 9.80665:g}") for v in x.split(",")], [float(f"{float(v):g}") for v in y.split(",")]
            return numpy.interp(im * 9.80665, x, y)

        entry = self.certificate(folder)["fragility.csv"]
        self.against_surface(probability, entry, 1e-6 + entry["rounding_at_most"])
        self.assertEqual(set(json.loads((folder / "fragility.json").read_text())), {row["ID"], "_GeneralInformation"})
        self.assertLess(entry["largest_difference"], 1e-6 + entry["rounding_at_most"])

    def test_the_intensity_of_the_report_needs_one_mu(self):
        self.sweep("report")
        to = self.folder / "a.xml"
        base = ["export", self.out, "--format", "openquake", "-o", to]
        self.fail_with(2, base, "known to no target", "--mu 0.28", "fit")
        self.fail_with(2, base + ["--mu", "0.3"], "is not the mu of the samples", "--mu 0.28")
        self.succeed(base + ["--mu", "0.28", "--skip-empty"])
        levels = [float(x) for x in xml.parse(to).getroot()[0].find(NRML + "fragilityFunction")[0].text.split()]
        for im, *_ in self.surface["overturned"]:
            self.assertLess(min(abs(level - 0.28 * (1 + im)) for level in levels), 1e-12)
        self.succeed(["export", self.out, "--format", "csv", "-o", self.folder / "a.csv"])

    def test_many_mu_have_no_pta(self):
        self.sweep("report", STUDY.replace("mu_k: 0.28", "mu_k: {uniform: [0.2, 0.3]}"))
        base = ["export", self.out, "--format", "openquake", "-o", self.folder / "a.xml"]
        self.fail_with(2, base, "known to no target", "pga_g")
        self.fail_with(2, base + ["--mu", "0.28"], "many mu")

    def test_mistakes(self):
        self.sweep()
        base = ["export", self.out, "--format"]
        to = ["-o", self.folder / "a.xml"]
        self.fail_with(2, base + ["xls"] + to, "unknown format xls", "incore")
        self.fail_with(2, base + ["openquake", "-o", self.folder / "a.json"], "another ending", "a.xml")
        self.fail_with(2, base + ["pelicun", "-o", self.folder / "a.csv"], "name a folder")
        self.fail_with(2, base + ["openquake"] + to + ["--id", "a.b"], "refuses the id a.b")
        self.fail_with(2, base + ["openquake"] + to + ["--id", "a", "--each"], "--id excludes --each")
        self.fail_with(2, base + ["openquake"] + to + ["--limit-state", "slip"], "peak_slip_m, overturned")
        self.fail_with(2, base + ["openquake"] + to + ["--mu", "0.28"], "leave it out")
        self.fail_with(2, base + ["openquake"] + to + ["--form", "parts"], "openquake has no formulas")
        self.fail_with(3, ["export", self.folder / "none", "--format", "csv"] + to, "fragility.h5")
        self.assertFalse((self.folder / "a.xml").exists())
        self.assertFalse((self.folder / "certificate.json").exists())

    def test_a_folder_that_cannot_be_made_is_told(self):
        self.sweep()
        file = self.write("file", "")
        self.fail_with(2, ["export", self.out, "--format", "csv", "-o", file / "e"], "cannot make folder", str(file))

    def test_files_are_replaced_only_when_asked_and_only_ours(self):
        self.sweep()
        to = self.folder / "a.xml"
        base = ["export", self.out, "--format", "openquake", "--form", "discrete", "-o", to]
        self.succeed(base)
        self.succeed(["export", self.out, "--format", "csv", "-o", self.folder / "a.csv"])
        self.assertEqual(set(self.certificate()), {"a.xml", "a.csv"})
        self.fail_with(2, base, "is there already", "--overwrite")
        self.succeed(base + ["--overwrite"])
        to.write_text(to.read_text().replace("</nrml>", "<!-- mine --></nrml>"))
        self.fail_with(2, base + ["--overwrite"], "changed since")
        (self.folder / "certificate.json").write_text("{}")
        self.fail_with(2, base[:-1] + [self.folder / "b.xml"], "certificate.json would be replaced")


if __name__ == "__main__":
    unittest.main()
