"""Catalogue and query: two entries from a file to an answer, and what becomes of them when the file grows or changes."""

import csv
import json
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml

from support import CONFIGS, InFolder, command, datasets, finished_blocks, h5py, write_records

HEAD = """\
format: freestand-catalogue/1
name: two boxes
samples: 600
block_size: 64
motions: [{pulse: [A, B], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {log_uniform: [0.1, 2]}}]
fragility: {im: pga_g, bins: {count: 4}, edp: [peak_slip_m, overturned], capacities: {peak_slip_m: [0.05, 0.2]}, resamples: 20}
entries:
"""
FRIDGE = "  - {id: fridge, class: refrigerator, block: {width_m: 0.7, height_m: 1.8}, friction: {mu: 0.2}, source: assumed}\n"
GRIPPY = "  - {id: grippy, class: refrigerator, block: {width_m: 0.7, height_m: 1.8}, friction: {mu: 0.4}, source: 'a book, a shelf'}\n"
RACK = "  - {id: rack, class: server rack, block: {width_m: 0.6, height_m: 2}, friction: {mu: 0.3}}\n"
NRML = "{http://openquake.org/xmlns/nrml/0.5}"
TALL = "  - {id: tall, class: box, block: {width_m: 0.3, height_m: 2}, friction: {mu: 0.5}}\n"
FIXED = {"created_utc", "git_commit", "program"}  # of the run, not of its numbers


class Catalogue(InFolder):
    def build(self, entries, name="db", ranks=1, *more):
        return self.succeed(["catalogue", self.write("some.yaml", HEAD + entries), "-o", self.folder / name, *more], ranks)

    def tables(self, name="db"):
        """Everything in the database but when and by whom."""
        return {key: value for key, value in datasets(self.folder / name / "database.h5").items() if key.split("/")[-1] not in FIXED}

    def rows(self, file, name="db"):
        with open(self.folder / name / file, newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))

    def ask(self, *arguments):
        done = self.succeed(["query", self.folder / "db", *arguments, "--json"])
        return json.loads(done.stdout)

    def test_it_grows_entry_by_entry_to_the_same_bits(self):
        said = self.build(FRIDGE).stdout
        self.assertIn("1 entries: 1 computed in", said)
        samples = self.folder / "db" / "entries" / "fridge" / "samples.h5"
        before = (samples.stat().st_mtime_ns, (self.folder / "db" / "entries.csv").read_text().splitlines()[1])
        said = self.build(FRIDGE + GRIPPY + RACK, "db", 2).stdout
        self.assertIn("3 entries: 2 computed, 1 kept", said)
        self.assertEqual((samples.stat().st_mtime_ns, (self.folder / "db" / "entries.csv").read_text().splitlines()[1]), before)
        self.build(FRIDGE + GRIPPY + RACK, "at_once")
        self.assertEqual(self.tables(), self.tables("at_once"))
        # Entries that another file names are kept.
        self.assertIn("1 entries: 0 computed, 1 kept, 2 more in the database", self.build(RACK).stdout)
        self.assertEqual(sorted(row["id"] for row in self.rows("entries.csv")), ["fridge", "grippy", "rack"])

    def test_an_entry_is_what_run_makes_of_its_study(self):
        self.build(FRIDGE)
        alone = self.folder / "alone"
        study = HEAD.replace("format: freestand-catalogue/1\n", "").replace("entries:\n", "") + "block: {width_m: 0.7, height_m: 1.8}\nfriction: {mu: 0.2}\n"
        self.succeed(["run", self.write("alone.yaml", study), "-o", alone])
        with h5py.File(alone / "fragility.h5") as file, h5py.File(self.folder / "db" / "database.h5") as db:
            surface, centre = file["edp/peak_slip_m/surface"], file["im/centre"][()]
            mine = [i for i, demand in enumerate(db["curves/demand"].asstr()[()]) if demand == "peak_slip_m"]
            for k, curve in enumerate(mine):
                points = db["points/curve"][()] == curve
                self.assertEqual(list(db["points/im"][points]), list(centre))
                for name in ("probability", "lower", "upper"):
                    self.assertEqual(list(db[f"points/{name}"][points]), list(surface[name][:, k]))
            functions = file["edp/peak_slip_m/functions"]
            self.assertEqual(list(db["curves/median"][mine]), list(functions["median"][()]))
            self.assertEqual(list(db["curves/dispersion_se"][mine]), list(functions["dispersion_se"][()]))

    def test_numbers_and_words_say_cell_by_cell_what_the_database_says(self):
        self.build(FRIDGE + GRIPPY)
        words = json.loads((self.folder / "db" / "words.json").read_text())
        with h5py.File(self.folder / "db" / "database.h5") as db:
            ids = list(db["entries/id"].asstr()[()])
            self.assertEqual(sorted(words["entries"]), sorted(ids))
            self.assertEqual(words["classes"], list(db["classes"].asstr()[()]))
            columns = set()
            for table, file, key in (("entries", "entries.csv", lambda i: ids[i]), ("curves", "fragility.csv", lambda i: ids[db["curves/entry"][i]]),
                                     ("points", "points.csv", lambda i: ids[db["curves/entry"][db["points/curve"][i]]])):
                rows = self.rows(file)
                self.assertEqual(len(rows), len(db[table][next(iter(db[table]))]))
                for i, row in enumerate(rows):
                    self.assertEqual(row.pop("id"), key(i))
                    for name, cell in row.items():
                        if name not in db[table]:
                            self.assertIn(name, ("intensity", "demand", "capacity"))  # of the curve of a point
                            continue
                        columns.add(f"{table}/{name}")
                        value = db[table][name][i]
                        if isinstance(value, bytes):
                            self.assertEqual(cell, value.decode())
                        elif value != value:
                            self.assertEqual(cell, "")
                        else:
                            self.assertEqual(float(cell), value)
            for i, name in enumerate(ids):
                for column, text in words["entries"][name].items():
                    columns.add(f"entries/{column}")
                    self.assertEqual(text, db["entries"][column].asstr()[i])
            everything = {f"{table}/{name}" for table in ("entries", "curves", "points") for name in db[table]}
            self.assertEqual(everything - columns, {"entries/id", "curves/curve", "curves/entry", "points/point", "points/curve"})
            # Words are a closed list.
            self.assertLessEqual(set(db["curves/demand"].asstr()[()]), set(words["demands"]))
            self.assertLessEqual(set(db["curves/intensity"].asstr()[()]), set(words["intensities"]))
            self.assertLessEqual(set(db["curves/family"].asstr()[()]), set(words["families"]))
            self.assertLessEqual({name.split("/")[1] for name in everything} - {"entry", "curve", "point"}, set(words["columns"]))

    def test_what_is_doubtful_of_all_entries_is_told_once(self):
        text = (HEAD + FRIDGE + RACK.replace("mu: 0.3", "mu: 30")).replace("log_uniform: [0.1, 2]", "log_uniform: [10, 200]").replace("samples: 600", "samples: 64").replace("count: 4", "count: 1")
        for arguments, ranks in ((["-o", self.folder / "db"], 2), (["--check"], 1)):
            told = self.succeed(["catalogue", self.write("some.yaml", text), *arguments], ranks).stderr
            self.assertEqual((told.count("is it in g?"), told.count("is it a friction coefficient?")), (1, 1), told)

    def test_a_changed_entry_is_refused_or_computed_anew(self):
        self.build(FRIDGE + RACK)
        kept = self.tables()
        changed = FRIDGE.replace("mu: 0.2", "mu: 0.25")
        arguments = ["catalogue", self.write("some.yaml", HEAD + changed + RACK), "-o", self.folder / "db"]
        self.fail_with(2, arguments, "some.yaml:8: entry fridge", "friction.mu was 0.2, is 0.25", "--redo")
        self.assertEqual(self.tables(), kept)
        self.assertIn("2 entries: 1 computed, 1 kept", self.succeed(arguments + ["--redo"]).stdout)
        versions = {row["id"]: row["version"] for row in self.rows("entries.csv")}
        self.assertEqual(versions, {"fridge": "2", "rack": "1"})
        self.build(changed + RACK, "fresh")
        self.assertEqual({k: v for k, v in self.tables().items() if k != "entries/version"}, {k: v for k, v in self.tables("fresh").items() if k != "entries/version"})

    def test_what_is_computed_anew_goes_on_where_it_was_stopped(self):
        self.build(FRIDGE)
        text = (HEAD + FRIDGE).replace("samples: 600", "samples: 60000")
        arguments = ["catalogue", self.write("some.yaml", text), "-o", self.folder / "db", "--redo"]
        fridge, finished = self.folder / "db" / "entries" / "fridge", 0
        for _ in range(2):
            process = subprocess.Popen(command(arguments), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(process.kill)
            while finished_blocks(fridge) <= finished and process.poll() is None:
                time.sleep(0.005)
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(timeout=60), 75)
            self.assertGreater(finished_blocks(fridge), finished)
            finished = finished_blocks(fridge)
        self.assertIn("1 computed", self.succeed(arguments).stdout)
        self.succeed(arguments[:3] + [self.folder / "fresh"])
        self.assertEqual({k: v for k, v in self.tables().items() if k != "entries/version"}, {k: v for k, v in self.tables("fresh").items() if k != "entries/version"})

    def test_other_capacities_need_no_new_samples(self):
        self.build(FRIDGE)
        samples = self.folder / "db" / "entries" / "fridge" / "samples.h5"
        before = samples.stat().st_mtime_ns
        left = samples.parent / "blocks"  # by a sweep whose end was interrupted
        left.mkdir()
        (left / "run-0001.node-000000.log").write_bytes(b"")
        text = (HEAD + FRIDGE).replace("[0.05, 0.2]", "[0.05, 0.1, 0.2]")
        self.assertIn("0 computed, 1 fitted again", self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"]).stdout)
        self.assertEqual(samples.stat().st_mtime_ns, before)
        self.assertFalse(left.exists())
        self.assertEqual(sorted({row["capacity"] for row in self.rows("fragility.csv") if row["demand"] == "peak_slip_m"}), ["0.05", "0.1", "0.2"])

    def test_more_intensities_need_no_new_samples(self):
        self.build(FRIDGE)
        samples = self.folder / "db" / "entries" / "fridge" / "samples.h5"
        before = samples.stat().st_mtime_ns
        text = (HEAD + FRIDGE).replace("im: pga_g, ", "").replace("entries:", "intensities: [pga_g, pgv_mps, {name: sa_g, period_s: 0.5}]\nentries:")
        self.assertIn("0 computed, 1 fitted again", self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"]).stdout)
        self.assertEqual(samples.stat().st_mtime_ns, before)
        self.assertEqual({row["intensity"] for row in self.rows("fragility.csv")}, {"pga_g", "pgv_mps", "sa_g:0.5"})
        self.succeed(["fit", self.folder / "db" / "entries" / "fridge", "--im", "pgv_mps", "-o", self.folder / "alone"])
        with h5py.File(self.folder / "alone" / "fragility.h5") as file:
            medians = [str(m) for m in file["edp/peak_slip_m/functions/median"][()]]
        self.assertEqual([row["median"] for row in self.rows("fragility.csv") if (row["intensity"], row["demand"]) == ("pgv_mps", "peak_slip_m")], medians)
        self.ask("--id", "fridge", "--im", "sa_g:0.5=0.6", "--demand", "overturned")
        self.fail_with(2, ["catalogue", self.write("bad.yaml", text.replace("pgv_mps", "pgw_mps")), "-o", self.folder / "db"], "bad.yaml:7", "did you mean pgv_mps?")

    def test_damage_states_and_drawn_capacities_are_demands_of_the_database(self):
        text = (HEAD + FRIDGE).replace("[0.05, 0.2]", "[0.05, {lognormal: {median: 0.1, dispersion: 0.3}}]")
        text = text.replace("resamples: 20}", "resamples: 20, damage: {blocked_door: 'residual_slip_m > 0.08 or overturned'}}").replace("peak_slip_m, overturned]", "peak_slip_m, residual_slip_m, overturned]")
        command = lambda text: ["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"]
        self.succeed(command(text))
        words = json.loads((self.folder / "db" / "words.json").read_text())["demands"]
        self.assertEqual(words["blocked_door"]["unit"], "1")
        self.assertEqual(words["blocked_door"]["summary"], "residual_slip_m > 0.08 or overturned")
        drawn = words["peak_slip_m_over_capacity_1"]["summary"]
        self.assertIn("peak_slip_m > capacity", drawn)
        self.assertIn("lognormal: {median: 0.1, dispersion: 0.3}", drawn)
        for demand in ("blocked_door", "peak_slip_m_over_capacity_1"):
            answer = self.ask("--id", "fridge", "--im", "pga_g=0.6", "--demand", demand)["answers"][0]
            self.assertTrue(0 <= answer["lower"][0] <= answer["probability"][0] <= answer["upper"][0] <= 1)
        # Entries that a later revision does not name keep the words of their states; one name for two conditions tells both.
        self.succeed(command(text.replace(FRIDGE, RACK).replace("0.08", "0.12")))
        self.assertEqual(json.loads((self.folder / "db" / "words.json").read_text())["demands"]["blocked_door"]["summary"],
                         "residual_slip_m > 0.08 or overturned (fridge); residual_slip_m > 0.12 or overturned (rack)")
        self.assertIn("blocked_door", self.succeed(["query", self.folder / "db"]).stdout)

    def test_intensities_whose_names_hold_a_dot_are_exported_into_folders_too(self):
        write_records(self.folder / "records")
        text = (HEAD + TALL).replace("im: pga_g, ", "").replace("entries:", "intensities: [pga_g, record.pga_g]\nexports: [openquake]\nentries:")
        text = re.sub(r"motions: .*", "motions: [{records: records.csv, scale_to: {pga_g: {log_uniform: [0.1, 2]}}}]", text)
        self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"])
        self.assertEqual([len(list(folder.glob("fragility.xml"))) for folder in (self.folder / "db" / "exports" / "openquake").iterdir()], [1, 1])

    def test_advice_on_what_cannot_be_exported_names_whose_options_it_means(self):
        text = (HEAD + TALL).replace("bins: {count: 4}", "bins: {edges: [0.01, 0.02, 0.3, 0.8, 2.2]}").replace("entries:", "exports: [openquake]\nentries:")
        said = self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"]).stdout
        self.assertIn("add --skip-empty", said)
        advice = f"freestand export {self.folder / 'db'} --format openquake --im pga_g -o OUT"
        self.assertIn("options named here are those of: " + advice, said)
        self.succeed([self.folder / "one.xml" if word == "OUT" else word for word in advice.split()[1:]] + ["--skip-empty"])

    def test_all_entries_are_exported_into_one_file_under_their_ids(self):
        # The low box slips and never falls: of what nobody asked for that is told and left out, where one list need not hold all.
        low = "  - {id: low-box, class: box, block: {width_m: 3, height_m: 0.5}, friction: {mu: 0.2}}\n"
        text = (HEAD + TALL + low).replace("im: pga_g, ", "").replace("entries:", "intensities: [pga_g, pgv_mps]\nexports: [openquake, csv]\nentries:")
        said = self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"]).stdout
        db = self.folder / "db"
        self.assertIn("2 entries over pgv_mps in", said)
        self.assertEqual(sorted(path.name for path in (db / "exports" / "openquake" / "pgv_mps").iterdir()), ["certificate.json", "fragility.xml"])
        self.assertEqual(sorted(path.name for path in (db / "exports" / "csv" / "pga_g").iterdir()), ["certificate.json", "fragility.csv"])
        with open(db / "exports" / "csv" / "pga_g" / "fragility.csv", newline="", encoding="utf-8") as stream:
            table = list(csv.DictReader(stream))
        self.assertEqual(sorted({row["id"] for row in table}), ["low-box", "tall"])
        own = [row for row in self.rows("points.csv") if (row["id"], row["intensity"], row["demand"], row["capacity"]) == ("tall", "pga_g", "peak_slip_m", "0.05")]
        self.assertEqual([(float(row["im_value"]), float(row["probability"])) for row in table if (row["id"], row["demand"], row["capacity"]) == ("tall", "peak_slip_m", "0.05")],
                         [(float(row["im"]), float(row["probability"])) for row in own])
        self.succeed(["catalogue", self.folder / "some.yaml", "-o", db])  # and again
        self.fail_with(2, ["catalogue", self.write("bad.yaml", text.replace("[openquake", "[openqake")), "-o", db], "exports names openqake", "openquake")
        said = self.succeed(["export", db, "--to", "openquake", "--im", "pgv_mps", "--demand", "peak_slip_m", "-o", self.folder / "all.xml"]).stdout
        self.assertIn("one of 2 intensities", said)
        model = xml.parse(self.folder / "all.xml").getroot()[0]
        functions = model.findall(NRML + "fragilityFunction")
        self.assertEqual([one.get("id") for one in functions], ["tall", "low-box"])
        self.assertEqual({one[0].get("imt") for one in functions}, {"PGV"})
        self.assertEqual(model.find(NRML + "limitStates").text.split(), ["peak_slip_m_over_0p05", "peak_slip_m_over_0p2"])
        entry = json.loads((self.folder / "certificate.json").read_text())["files"]["all.xml"]
        self.assertEqual(sorted(entry["functions"]), ["low-box", "tall"])
        self.assertLess(entry["largest_difference"], 1e-6)
        # Each function is its entry's surface, in cm/s.
        points = [row for row in self.rows("points.csv") if (row["id"], row["intensity"], row["demand"], row["capacity"]) == ("low-box", "pgv_mps", "peak_slip_m", "0.05")]
        if functions[1].get("format") == "discrete":
            self.assertEqual([float(level) for level in functions[1][0].text.split()], [100 * float(row["im"]) for row in points])
        said = self.succeed(["export", db, "--to", "openquake", "-o", self.folder / "usual"]).stdout
        self.assertIn("overturned never happened", said)  # in one list of states, as zeros
        again = self.fail_with(3, ["export", db, "--to", "openquake", "--each", "--limit-state", "peak_slip_m:7", "-o", self.folder / "seven"], "2 of 2 entries").stderr
        self.assertEqual(again.count("has no capacity 7"), 1)
        self.assertIn("and the same of low-box", again)
        said = self.succeed(["export", db, "--to", "pelicun", "-o", self.folder / "pelicun"]).stdout
        self.assertIn("left out: overturned never happened", said)
        with open(self.folder / "pelicun" / "fragility.csv", newline="", encoding="utf-8") as stream:
            table = {row["ID"]: row for row in csv.DictReader(stream)}
        self.assertEqual(sorted(table), ["low_box", "tall"])
        self.assertTrue(table["tall"]["LS3-Family"])
        self.assertFalse(table["low_box"]["LS3-Family"])
        self.assertEqual(sorted(json.loads((self.folder / "pelicun" / "fragility.json").read_text())), ["_GeneralInformation", "low_box", "tall"])
        self.fail_with(3, ["export", db, "--to", "pelicun", "--limit-state", "overturned", "-o", self.folder / "some"], "1 of 2 entries are not exported", "low-box: overturned never happened")
        self.fail_with(2, ["export", db, "--to", "openquake", "--im", "pgd_m", "-o", self.folder / "no"], "it has pga_g, pgv_mps")
        # Verbs that take one sweep say where those of a database lie.
        curve = self.write("hazard.csv", "pga_g,annual_rate\n0.05,0.01\n1,0.0001\n")
        self.fail_with(2, ["risk", db, "--hazard", curve, "-o", self.folder / "no"], "is a database of 2 entries", "db/entries/tall")
        self.fail_with(2, ["sensitivity", db], "is a database of 2 entries", "db/entries/tall")

    def test_demands_that_an_export_leaves_out_are_told(self):
        text = (HEAD + FRIDGE + TALL).replace("edp: [peak_slip_m", "edp: [slid_path_m, peak_slip_m")
        self.succeed(["catalogue", self.write("some.yaml", text), "-o", self.folder / "db"])
        said = self.succeed(["export", self.folder / "db", "--to", "openquake", "-o", self.folder / "some.xml"]).stdout
        self.assertEqual(said.count("left out: peak_slip_m (--limit-state takes them)"), 1)

    def test_each_entry_is_exported_into_a_file_of_its_name_where_that_is_asked(self):
        self.build(FRIDGE + TALL)
        db, ids = self.folder / "db", sorted(path.name for path in (self.folder / "db" / "entries").iterdir())
        self.assertEqual(len(ids), 2)
        self.assertIn("2 entries in", self.succeed(["export", db, "--format", "openquake", "--each", "-o", self.folder / "nrml"]).stdout)
        self.assertEqual(sorted(path.name for path in (self.folder / "nrml").iterdir()), sorted([f"{one}.xml" for one in ids] + ["certificate.json"]))
        self.assertEqual(sorted(json.loads((self.folder / "nrml" / "certificate.json").read_text())["files"]), [f"{one}.xml" for one in ids])
        self.assertIn(ids[0], (self.folder / "nrml" / f"{ids[0]}.xml").read_text())
        some = ["export", db, "--format", "pelicun", "--limit-state", "overturned", "--each", "-o", self.folder / "pelicun"]
        self.fail_with(3, some, "1 of 2 entries are not exported", "fridge: overturned never happened")
        self.assertEqual([path.name for path in (self.folder / "pelicun").iterdir()], ["tall"])
        self.fail_with(2, ["export", db, "--format", "openquake", "--each", "-o", self.folder / "one.xml"], "name a folder")
        self.fail_with(3, ["export", db, "--format", "openquake", "--each", "-o", self.folder / "nrml"], "2 of 2 entries are not exported", "--overwrite")

    def test_a_run_that_was_killed_goes_on_to_the_same_bits(self):
        self.build(FRIDGE + GRIPPY + RACK, "whole")
        path = self.write("some.yaml", HEAD + FRIDGE + GRIPPY + RACK)
        going = subprocess.Popen(command(["catalogue", path, "-o", self.folder / "db"]), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while going.poll() is None and time.monotonic() < until and not (self.folder / "db" / "entries" / "grippy").exists():
            time.sleep(0.002)
        going.send_signal(signal.SIGKILL)
        going.wait()
        self.assertFalse((self.folder / "db" / "database.h5").exists() and going.returncode != 0)
        self.build(FRIDGE + GRIPPY + RACK)
        self.assertEqual(self.tables(), self.tables("whole"))

    def test_questions(self):
        self.build(FRIDGE + GRIPPY + RACK)
        database = self.folder / "db"
        said = self.succeed(["query", database]).stdout
        for words in ("two boxes, revision 1: 3 entries", "refrigerator", "server rack", "0.2 to 0.4", "pga_g (0.1", "peak_slip_m > 0.05, 0.2 m; overturned", "freestand query"):
            self.assertIn(words, said)
        example = said[said.index("freestand query"):].strip().replace("'", "")
        self.assertIn("--class refrigerator --im pga_g=", example)
        asked = ["--class", "refrigerator", "--im", "pga_g=0.6", "--demand", "peak_slip_m", "--capacity", "0.05"]
        said = self.succeed(["query", database, *asked]).stdout
        self.assertRegex(said, r"P\(peak_slip_m > 0.05 m \| pga_g = 0.6 g\), with its 95 % band\n0\.\d{4}  \[0\.\d{4}, [01]\.\d{4}\]  fridge\n")
        self.assertRegex(said, r"\nread by (straight lines|the lognormal)")
        ends = [answer["probability"][0] for answer in self.ask(*asked)["answers"]]
        between = self.ask(*asked, "--mu", "0.3")["answers"]
        self.assertEqual(len(between), 1)
        self.assertEqual([part["id"] for part in between[0]["entries"]], ["fridge", "grippy"])
        self.assertTrue(min(ends) < between[0]["probability"][0] < max(ends))
        self.assertTrue(between[0]["lower"][0] <= between[0]["probability"][0] <= between[0]["upper"][0])
        curve = self.ask("--id", "rack", "--im", "pga_g", "--demand", "overturned", "--curve")["answers"][0]
        self.assertEqual(len(curve["im"]), 4)
        self.assertTrue(self.ask(*asked, "--mu", "0.45")["answers"][0]["extrapolated"])
        self.assertEqual(len(self.ask("--class", "refrigerator")["entries"]), 2)

    def test_between_points_a_question_and_an_export_have_one_answer(self):
        self.build(GRIPPY)
        self.succeed(["export", self.folder / "db", "--format", "openquake", "--demand", "peak_slip_m:0.05", "-o", self.folder / "some.xml"])
        function = xml.parse(self.folder / "some.xml").getroot().find(f".//{NRML}fragilityFunction")
        self.assertEqual(function.get("format"), "discrete")
        levels, shares = ([float(x) for x in function.find(NRML + what).text.split()] for what in ("imls", "poes"))
        for i in range(len(levels) - 1):
            middle = (levels[i] + levels[i + 1]) / 2
            answer = self.ask("--im", f"pga_g={middle!r}", "--demand", "peak_slip_m", "--capacity", "0.05")["answers"][0]
            self.assertAlmostEqual(answer["probability"][0], (shares[i] + shares[i + 1]) / 2, delta=1e-9)
            self.assertIn("straight lines between the points", answer["rule"])
        self.assertGreater(shares[-1] - shares[0], 0.2)

    def test_mistakes_of_questions_are_told_with_the_choices(self):
        self.build(FRIDGE)
        ask = ["query", self.folder / "db", "--im", "pga_g=0.5", "--demand", "peak_slip_m", "--capacity", "0.05"]
        self.fail_with(2, ask + ["--class", "fridge"], "class \"fridge\" is not in the database", "refrigerator")
        self.fail_with(2, ask[:2] + ["--im", "pgv=0.5", "--demand", "overturned"], "intensity \"pgv\"", "pga_g")
        self.fail_with(2, ask[:2] + ["--im", "pga_g=fast", "--demand", "overturned"], "--im pga_g=fast")
        self.fail_with(2, ask + ["--mu", "0.9"], "mu = 0.9 lies in no grid", "mu 0.2")
        self.fail_with(2, ask[:2] + ["--im", "pga_g=50", "--demand", "overturned"], "too far outside")
        self.fail_with(2, ask[:2] + ["--mu", "0.2"], "--im and --demand are missing", "freestand query")
        self.fail_with(3, ["query", self.folder / "nowhere"], "nowhere", "holds no database")
        self.fail_with(3, ["query", self.folder / "db" / "entries" / "fridge" / "fragility.h5"], "is no database", "freestand-fragility")

    def test_entries_that_differ_beside_the_coordinates_each_have_an_answer(self):
        high = TALL.replace("tall", "high").replace("height_m: 2}", "height_m: 2, centre_height_m: 1.3}")
        leant = TALL.replace("tall", "leant").replace("friction:", "start: {rotation_rad: 0.1}, friction:")
        held = TALL.replace("tall", "held").replace("{mu: 0.5}", "{mu_k: 0.5, static_ratio: 1.5}")
        self.build(TALL + high + leant + held)
        answers = self.ask("--class", "box", "--mu", "0.5", "--im", "pga_g=0.5", "--demand", "overturned")["answers"]
        self.assertEqual([answer["entries"][0]["id"] for answer in answers], ["tall", "high", "leant", "held"])
        again = self.ask("--class", "box", "--height", "2", "--im", "pga_g=0.5", "--demand", "overturned")["answers"]
        self.assertEqual([answer["probability"] for answer in again], [answer["probability"] for answer in answers])

    def test_a_target_is_what_its_curves_are_of(self):
        aimed = ("  - {id: aimed, class: box, block: {width_m: 0.7, height_m: 1.8}, friction: {mu_k: {uniform: [0.1, 0.3]}}, samples: 2000,\n"
                 "     fragility: {target: {friction.mu_k: {uniform: [0.1, 0.15]}}}}\n")
        self.build(aimed)
        self.assertAlmostEqual(float(self.rows("entries.csv")[0]["mu_k"]), 0.125)

    def test_bands_of_one_database_have_one_confidence(self):
        other = RACK.replace("friction:", "fragility: {confidence: 0.5}, friction:")
        self.fail_with(2, ["catalogue", self.write("mixed.yaml", HEAD + FRIDGE + other), "-o", self.folder / "db"],
                       "entry fridge has confidence 0.95 and entry rack has 0.5")
        self.build(FRIDGE)
        self.fail_with(2, ["catalogue", self.write("mixed.yaml", HEAD + other), "-o", self.folder / "db"],
                       "that of entry fridge, which the database keeps, 0.95")

    def test_an_export_is_of_the_curves_that_the_database_holds(self):
        self.build(FRIDGE)
        self.succeed(["fit", self.folder / "db" / "entries" / "fridge", "--im", "pgv_mps", "--quiet"])
        export = ["export", self.folder / "db", "--format", "csv", "-o", self.folder / "db.csv"]
        self.fail_with(3, export, "holds another fit than the database", "gives it back")
        self.succeed(["fit", self.folder / "db" / "entries" / "fridge", "--quiet"])
        self.succeed(export)

    def test_a_folder_of_somebody_else_is_left_alone(self):
        (self.folder / "db").mkdir()
        (self.folder / "db" / "letter.txt").write_text("mine")
        path = self.write("some.yaml", HEAD + FRIDGE)
        self.fail_with(2, ["catalogue", path, "-o", self.folder / "db"], "is not empty and holds no database", "letter.txt")
        self.fail_with(2, ["catalogue", path], "-o is missing")

    def test_a_table_row_without_a_unit_is_refused_with_its_row(self):
        self.write("t.csv", "id,class,width_m,height_m,mu\nfridge,refrigerator,0.7 m,1.8,0.2\n")
        path = self.write("some.yaml", HEAD.replace("entries:\n", "table: t.csv\n"))
        self.fail_with(2, ["catalogue", path, "-o", self.folder / "db"], "t.csv:2: block.width_m is \"0.7 m\"")
        self.assertFalse((self.folder / "db").exists())

    def test_the_catalogues_of_the_program_are_accepted(self):
        for name in ("equipment", "p58"):
            done = self.succeed(["catalogue", CONFIGS / "catalogue" / f"{name}.yaml", "--check"])
            self.assertIn("entries", done.stdout)


if __name__ == "__main__":
    unittest.main()
