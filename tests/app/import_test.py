"""Files of a laboratory become a measurement set: the walk-through's tests written as a laboratory would write them, read back
by one command, and used."""

import csv
import math
import random
import re
import unittest

from support import CONFIGS, InFolder, run

WALK = CONFIGS / "walkthrough"
G = 9.80665
LATE = 0.12  # s, by which the block's clock stamps late against the table's

LAB = """name: cabinet in our words
specimen: {width_m: 0.7916, height_m: 0.5495, mass_kg: 201}
noise: {slip_m: 0.000291}
tests:
"""
TEST = """  - id: TID
    role: ROLE
    floor: {file: "table TID.txt", time: "Time (s)", acceleration: {column: ACC1, unit: g}}
    response: {file: block_TID.csv, time: {column: t_ms, unit: ms}, slip: {column: LVDT 1, unit: mm, sign: -1}}
"""
SLIP = "{column: LVDT 1, unit: mm, sign: -1}"


def comma(value, digits=6):
    return f"{value:.{digits}f}".replace(".", ",")


class Import(InFolder):
    def setUp(self):
        super().setUp()
        self.truth = {}
        text = LAB
        for k in (1, 2, 3):
            name = f"t{k:02d}"
            with open(WALK / f"{name}.csv", encoding="utf-8") as stream:
                self.truth[name] = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
            self.write_table(name)
            self.write_block(name)
            text += TEST.replace("TID", name).replace("ROLE", "holdout" if k == 3 else "calibration")
        self.lab = self.write("lab.yaml", text)

    def write_table(self, name):
        """Accelerations in g, 200 Hz, tabs, two lines of words above and a line of units below the names."""
        rows = [f"{0.005 * i:.4f}\t{row['floor_acceleration_mps2'] / G:.9f}\t{20.0 + 0.001 * i:.3f}" for i, row in enumerate(self.truth[name])]
        self.write(f"table {name}.txt", "Shaking table 2\nrun 17, cabinet\nTime (s)\tACC1\tTemp\n(s)\t(g)\t(C)\n" + "\n".join(rows) + "\n")

    def write_block(self, name, late=LATE):
        """Millimetres, 100 Hz, semicolons and decimal commas, turned round, on a clock of its own."""
        rows = [f"{comma(1000 * (0.005 * i + late), 3)};{comma(-1000 * row['slip_m'])};" for i, row in enumerate(self.truth[name]) if i % 2 == 0]
        self.write(f"block_{name}.csv", "t_ms;LVDT 1;\n" + "\n".join(rows) + "\n")

    def test_a_floor_that_is_sampled_more_slowly_keeps_its_noise(self):
        """What is read between its samples hides it; white noise of sigma at a step h is one of sigma sqrt(h/k) at k."""
        random.seed(1)
        sigma, response = 0.03, [f"{0.005 * i:.4f},0" for i in range(2400)]
        floor = [f"{0.01 * i:.4f},{(1.5 if 200 < i < 900 else 0) * math.sin(0.12 * i) + random.gauss(0, sigma):.6f}" for i in range(1200)]
        self.write("slow.csv", "t,a\n" + "\n".join(floor) + "\n")
        self.write("fast.csv", "t,u\n" + "\n".join(response) + "\n")
        lab = self.write("slow.yaml", "name: slow floor\nnoise: {slip_m: 0.0003}\ntests:\n  - id: one\n    clock_s: 0\n"
                         "    floor: {file: slow.csv, time: {column: t, unit: s}, acceleration: {column: a, unit: m/s2}}\n"
                         "    response: {file: fast.csv, time: {column: t, unit: s}, slip: {column: u, unit: m}}\n")
        said = self.succeed(["import", lab, "-o", self.folder / "slow"]).stdout
        self.assertIn("the floor is sampled every 0.01 s, and read between its samples every 0.005 s", said)
        told = float(re.search(r"floor_acceleration_mps2: ([\d.]+)", (self.folder / "slow" / "dataset.yaml").read_text())[1])
        self.assertAlmostEqual(told / (sigma * math.sqrt(2)), 1, delta=0.1)

    def imported(self, folder="set", *more):
        return self.succeed(["import", self.lab, "-o", self.folder / folder, *more])

    def rows(self, name, folder="set"):
        with open(self.folder / folder / f"{name}.csv", encoding="utf-8") as stream:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in stream if not line.startswith("#"))]

    def test_what_was_written_comes_back(self):
        told = self.imported().stdout
        for word in ("ACC1 in g is floor_acceleration_mps2", "LVDT 1 in mm, turned round, is slip_m", "not used: Temp of table t01.txt",
                     "the response is stamped 0.1", "t01: block_t01.csv is read between its samples"):
            self.assertIn(word, told)
        # To a step: friction that follows the speed shifts it a little.
        offset = float(re.search(r"is stamped ([\d.]+) s late", told).group(1))
        self.assertAlmostEqual(offset, LATE, delta=0.005)
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("    role:", f"    clock_s: {LATE}\n    role:"))
        self.imported("set", "--overwrite", "--quiet")
        for name, truth in self.truth.items():
            rows = self.rows(name)
            self.assertEqual(set(rows[0]), {"time_s", "floor_acceleration_mps2", "slip_m"})
            shift = round(rows[0]["time_s"] / 0.005)
            self.assertEqual(shift, 0)
            self.assertGreater(len(rows), len(truth) - 4)
            # The floor comes back sample by sample; of the slip every second sample was written.
            for row, was in zip(rows, truth):
                self.assertAlmostEqual(row["floor_acceleration_mps2"], was["floor_acceleration_mps2"], delta=2e-8)
            for row, was in list(zip(rows, truth))[::2]:
                self.assertAlmostEqual(row["slip_m"], was["slip_m"], delta=2e-9)

    def test_the_set_is_used_as_any_other(self):
        self.imported()
        study = self.write("study.yaml", "measurements: set/dataset.yaml\nmodel: {friction: {mu: {calibrate: [0.03, 1.2]}}, "
                           "effects: [{name: rate_weakening, drop: 0.424, speed_mps: 0.0759}]}\n")
        self.succeed(["compare", study, "-o", self.folder / "compared", "--quiet"])
        text = (self.folder / "compared" / "comparison.json").read_text(encoding="utf-8")
        self.assertIn('"role": "holdout"', text)

    def test_a_sensor_that_is_read_in_steps_comes_as_it_was_read(self):
        """Steps of the sensor, and readings that repeat, are those of its own rate: nothing between them is taken for one."""
        study = self.write("study.yaml", "measurements: set/dataset.yaml\nmodel: {friction: {mu: {calibrate: [0.03, 1.2]}}}\n")
        for digits in (0, 2):
            for name, truth in self.truth.items():
                rows = [f"{10 * i};{comma(-1000 * row['slip_m'], digits)};" for i, row in enumerate(truth[::2])]
                self.write(f"block_{name}.csv", "t_ms;LVDT 1;\n" + "\n".join(rows) + "\n")
            self.imported("set", "--overwrite", "--quiet")
            self.assertIn("steps_a_reading: 2", (self.folder / "set" / "dataset.yaml").read_text(encoding="utf-8"))
            read = [row["slip_m"] for row in self.rows("t01")][::2]
            self.assertTrue(all(abs(value - round(value, 3 + digits)) < 1e-15 for value in read[:1000]))
            said = self.succeed(["compare", study, "-o", self.folder / "compared", "--overwrite"]).stdout
            self.assertNotIn("stays at one value", said)

    def test_each_test_keeps_its_own_step(self):
        """One of twice the rate, and one whose clock is read to whole milliseconds, make no other test a finer one."""
        rows = [f"{5 * i + (i % 3 == 0)};{comma(-1000 * row['slip_m'])};" for i, row in enumerate(self.truth["t01"])]
        self.write("block_t01.csv", "t_ms;LVDT 1;\n" + "\n".join(rows) + "\n")
        fine = [f"{0.0025 * i:.4f}\t{self.truth['t02'][i // 2]['floor_acceleration_mps2'] / G:.9f}\t20" for i in range(2 * len(self.truth["t02"]))]
        self.write("table t02.txt", "Time (s)\tACC1\tTemp\n(s)\t(g)\t(C)\n" + "\n".join(fine) + "\n")
        self.imported()
        self.assertNotIn("sampling_dt_s", (self.folder / "set" / "dataset.yaml").read_text(encoding="utf-8"))
        self.assertEqual([self.rows(name)[1]["time_s"] for name in self.truth], [0.005, 0.0025, 0.005])

    def test_rotation_alone(self):
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("slip: {column: LVDT 1, unit: mm", "rotation: {column: LVDT 1, unit: mrad").replace("slip_m:", "rotation_rad:"))
        told = self.imported().stdout
        self.assertIn("t01: the clocks of floor and response are taken as one", told)
        row, was = self.rows("t02")[100], self.truth["t02"][100 + round(LATE / 0.005)]
        self.assertEqual(set(row), {"time_s", "floor_acceleration_mps2", "rotation_rad"})
        self.assertAlmostEqual(row["floor_acceleration_mps2"], was["floor_acceleration_mps2"], delta=2e-8)
        self.write("lab.yaml", text.replace("slip: {column: LVDT 1, unit: mm", "block_acceleration: {column: LVDT 1, unit: g"))
        self.fail_with(2, ["import", self.lab, "-o", self.folder / "wrong"], "lab.yaml:8", "neither slip nor rotation")

    def test_a_unit_at_the_end_of_a_columns_name_counts_where_none_is_given(self):
        self.imported()
        text = self.lab.read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("{column: t_ms, unit: ms}", "t_ms"))
        told = self.imported("short").stdout
        self.assertIn("t_ms in ms is the time", told)
        for name in self.truth:
            self.assertEqual(self.rows(name), self.rows(name, "short"))

    def test_a_sign_that_was_forgotten_sets_no_clock(self):
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace(", sign: -1", ""))
        told = self.imported().stdout
        self.assertIn("t01, t02, t03: the slip looks mirrored, and no clock was set by it", told)
        self.assertNotIn("was set by that", told)

    def test_a_unit_that_is_another_sets_no_clock(self):
        """A floor in g is taken as m/s2: the slip goes with it if it is a tenth of what is read, at no time as it is."""
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.assertNotIn("times what is read", self.imported("right").stdout)
        self.write("lab.yaml", text.replace("{column: ACC1, unit: g}", "{column: ACC1, unit: m/s2}"))
        told = self.imported().stdout
        self.assertRegex(told, r"t01 \(0\.(0|1)\d*\).*: the slip goes with the floor, and no clock was set by it, if it is so many times what is read: check unit:")
        self.assertNotIn("was shifted by that", told)

    def test_files_that_begin_far_apart_are_told(self):
        self.assertNotIn("apart by their times", self.imported().stdout)
        for name in self.truth:
            self.write_block(name, 2.5)
        told = self.imported("apart").stdout
        for name in self.truth:
            self.assertRegex(told, f"{name}: floor in steps of .* which begin 2.5 s apart by their times: is that so, or are these of two clocks")
        text = self.lab.read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("    role:", "    clock_s: 2.5\n    role:"))
        self.assertNotIn("apart by their times", self.imported("given").stdout)

    def test_a_clock_that_is_given_is_not_estimated(self):
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("    role:", "    clock_s: 0.1\n    role:"))
        self.assertNotIn("was set by that", self.imported().stdout)
        # The response begins 0.02 s late now, and the set with it.
        row = self.rows("t02")[20]
        self.assertAlmostEqual(row["slip_m"], self.truth["t02"][20]["slip_m"], delta=2e-9)
        self.assertAlmostEqual(row["floor_acceleration_mps2"], self.truth["t02"][24]["floor_acceleration_mps2"], delta=2e-8)

    def test_noise_that_is_not_given_is_estimated_and_told(self):
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("noise: {slip_m: 0.000291}\n", ""))
        told = self.imported().stdout
        self.assertRegex(told, r"noise.slip_m is not given: 0.000[23]\d* by the quiet parts")

    def test_a_sensor_without_noise_is_told_and_may_be_given_one(self):
        """A block that never moved, as zeros, below a floor that was computed."""
        for number, name in enumerate(self.truth):
            floor = [f"{0.005 * i:.4f}\t{0.01 * (number + 1) * math.sin(0.01 * i) if 400 < i < 1000 else 0:.9f}\t20" for i in range(1600)]
            self.write(f"table {name}.txt", "Time (s)\tACC1\tTemp\n" + "\n".join(floor) + "\n")
            self.write(f"block_{name}.csv", "t_ms;LVDT 1;\n" + "\n".join(f"{comma(5 * i, 3)};0,0;" for i in range(1600)) + "\n")
        text = self.lab.read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("noise: {slip_m: 0.000291}\n", ""))
        self.assertIn("noise.slip_m is not given, and slip_m does not scatter in any test", self.imported().stdout)
        study = self.write("study.yaml", "measurements: set/dataset.yaml\nmodel: {friction: {mu: {calibrate: [0.03, 1.2]}}}\n")
        self.fail_with(3, ["compare", study, "-o", self.folder / "compared", "--quiet"], "noise.slip_m is missing")
        self.write("lab.yaml", text)
        self.imported("set", "--overwrite")
        self.succeed(["compare", study, "-o", self.folder / "compared", "--quiet"])

    def test_a_time_in_another_unit_is_told(self):
        """Both files in milliseconds, said to be seconds."""
        for name, rows in self.truth.items():
            self.write(f"table {name}.txt", "Time (s)\tACC1\tTemp\n"
                       + "\n".join(f"{5 * i}\t{row['floor_acceleration_mps2'] / G:.9f}\t20" for i, row in enumerate(rows)) + "\n")
        self.write("lab.yaml", self.lab.read_text(encoding="utf-8").replace("{column: t_ms, unit: ms}", "{column: t_ms, unit: s}"))
        told = self.imported().stdout
        self.assertIn("the time step of table t01.txt is 5 s: is its time in seconds?", told)
        self.assertIn("the time step of block_t01.csv is 10 s: is its time in seconds?", told)

    def test_what_was_taken_for_granted_is_told(self):
        """Rows that are missing, a unit that nobody gave, one that is another than the column's name says, and clocks in step."""
        text = self.lab.read_text(encoding="utf-8")
        block = (self.folder / "block_t01.csv").read_text(encoding="utf-8").split("\n")
        self.write("block_t01.csv", "\n".join(block[:40] + block[41:]))
        self.assertIn("t01: block_t01.csv lacks 1 row, filled by straight lines: 0.02 s before line 41", self.imported().stdout)
        self.write("block_t01.csv", "\n".join(line for i, line in enumerate(block) if i not in (40, 60, 80, 100, 120)))
        self.assertIn("t01: block_t01.csv lacks 5 rows", self.imported("five").stdout)
        self.write("lab.yaml", text.replace("acceleration: {column: ACC1, unit: g}", "acceleration: ACC1"))
        self.fail_with(3, ["import", self.lab, "-o", self.folder / "in_g"], "t01: ACC1 has g in its line of units", "without it m/s2 would be taken")
        for name in self.truth:
            table = self.folder / f"table {name}.txt"
            table.write_text(table.read_text(encoding="utf-8").replace("(s)\t(g)\t(C)\n", ""), encoding="utf-8")
        told = self.imported("assumed").stdout
        self.assertIn("t02: no unit of ACC1 is given, nor does its name end with one that is known: taken as m/s2", told)
        self.write("lab.yaml", text.replace("{column: t_ms, unit: ms}", "{column: t_ms, unit: s}"))
        done = run(["import", self.lab, "-o", self.folder / "clash"])
        self.assertTrue(done.returncode != 0 or "the name of t_ms ends with ms, and unit: says s: taken as s" in done.stdout, done.stdout)
        for name in self.truth:
            rows = [f"{comma(5 * i, 3)};{comma(-1000 * row['slip_m'])};" for i, row in enumerate(self.truth[name]) if i % 2 == 0]
            self.write(f"block_{name}.csv", "t_ms;LVDT 1;\n" + "\n".join(rows) + "\n")
        self.write("lab.yaml", text)
        self.assertRegex(self.imported("in_step").stdout, "no offset between the clocks of floor and response is seen by the slips, which are looked through up to 0.5 s|clock runs 0.00")
        self.write("lab.yaml", "sampling_dt_s: 0.02\n" + text)
        told = self.imported("coarse").stdout
        self.assertIn("t01: of table t01.txt one row in 4 is taken, and what is faster than 25 Hz seems slower", told)
        self.assertIn("t01: of block_t01.csv one row in 2", told)

    def test_units_are_never_passed_over(self):
        """A line of units below the names, a unit that is none, and the time that the set begins at."""
        text = self.lab.read_text(encoding="utf-8")
        block = (self.folder / "block_t01.csv").read_text(encoding="utf-8").split("\n")

        def of_first_test(slip, names, units):
            self.write("block_t01.csv", "\n".join([names, units] * (units != "") + [names] * (units == "") + block[1:]))
            self.write("lab.yaml", text.replace(SLIP, slip, 1))
            return ["import", self.lab, "-o", self.folder / "units", "--overwrite"]

        self.fail_with(3, of_first_test("LVDT 1", "t_ms;LVDT 1;", "[ms];[mm];"), "t01: LVDT 1 has mm in its line of units",
                       "unit: is not given (without it m would be taken): give it")
        self.assertIn("t01: LVDT 1 has cm in its line of units, and is taken as mm",
                      self.succeed(of_first_test(SLIP, "t_ms;LVDT 1;", "[ms];[cm];")).stdout)
        self.fail_with(2, of_first_test("LVDT 1 (inches)", "t_ms;LVDT 1 (inches);", ""), "ends with", "inches", "give unit:")
        self.fail_with(2, of_first_test("LVDT_MM", "t_ms;LVDT_MM;", ""), "ends with", "MM", "give unit:")
        late = text.replace("    role:", "    clock_s: 0.05\n    role:", 1)
        self.write("lab.yaml", late)
        self.write("block_t01.csv", "\n".join(block))
        self.assertIn("t01: time 0 is now what was 0.07 s in table t01.txt", self.imported("late").stdout)

    def test_mistakes(self):
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")

        def changed(old, new):
            self.write("lab.yaml", text.replace(old, new, 1))
            return ["import", self.lab, "-o", self.folder / "wrong"]

        self.fail_with(3, changed("column: ACC1", "column: ACC2"), "table t01.txt", "no column ACC2", "Time (s), ACC1, Temp")
        self.fail_with(2, changed("unit: mm", "unit: furlong"), "lab.yaml:8", "unit furlong is not known", "mm")
        self.fail_with(2, changed("sign: -1", "sign: 2"), "lab.yaml:8", "give 1 or -1")
        self.fail_with(2, changed("time: {column: t_ms, unit: ms}, ", ""), "lab.yaml:8", "response.time is missing")
        self.fail_with(2, changed("- id: t02", "- id: t01"), "lab.yaml", "stands twice")
        self.fail_with(3, changed("block_t01.csv", "block_t09.csv"), "block_t09.csv", "cannot be read")
        self.fail_with(3, changed("    role: calibration", "    clock_s: 1e4\n    role: calibration"), "no time in common", "less clock_s of 1e+04 s): correct clock_s")
        block = (self.folder / "block_t01.csv").read_text(encoding="utf-8").split("\n")
        self.write("block_t01.csv", "\n".join(block[:40] + [block[40].rsplit(";", 2)[0] + ";NaN;"] + block[41:]))
        self.fail_with(3, changed("nothing", ""), "block_t01.csv:41", "NaN in column LVDT 1 is no finite number")
        self.write("block_t01.csv", "\n".join(block[:40] + block[50:]))
        self.fail_with(3, changed("nothing", ""), "block_t01.csv:41", "0.1 s are missing before this line", "cut the file there")
        self.write("block_t01.csv", "\n".join(block[:40] + block[39:]))
        self.fail_with(3, changed("nothing", ""), "block_t01.csv:41", "time does not rise")
        self.write("block_t01.csv", "\n".join(block[:40] + ["1,5"] + block[41:]))
        self.fail_with(3, changed("nothing", ""), "block_t01.csv:41", "1 cells where the table has 2 columns")

    def test_names_in_any_words(self):
        """They are read back as they were written, and no test leaves the folder by its name."""
        text = (self.folder / "lab.yaml").read_text(encoding="utf-8")
        self.write("lab.yaml", text.replace("cabinet in our words", "'bench: 3'").replace("- id: t01", "- id: 'run 1, A}'"))
        self.imported()
        compared = run(["compare", self.write("odd.yaml", "measurements: set/dataset.yaml\nmodel: {friction: {mu: 0.2}, block: {width_m: 0.8, height_m: 0.6}}\n"),
                        "-o", self.folder / "odd"])
        self.assertEqual(compared.returncode, 0, compared.stderr)
        self.assertIn("run 1, A}", compared.stdout)
        for name in ("../x", "day1/run1", "''"):
            self.write("lab.yaml", text.replace("- id: t01", f"- id: '{name}'" if name != "''" else "- id: ''"))
            self.fail_with(2, ["import", self.lab, "-o", self.folder / "outside"], "lab.yaml:5", "tests[0].id is")
        self.assertFalse((self.folder / "x.csv").exists())

    def test_two_columns_of_one_name(self):
        self.write("block_t01.csv", "t_ms;LVDT 1;LVDT 1\n" + "".join(f"{10 * i},0;0,0;1,0\n" for i in range(20)))
        self.fail_with(3, ["import", self.lab, "-o", self.folder / "wrong"], "block_t01.csv has two columns LVDT 1")

    def test_a_folder_with_results_is_not_overwritten(self):
        self.imported()
        self.fail_with(2, ["import", self.lab, "-o", self.folder / "set"], "--overwrite")
        self.imported("set", "--overwrite")


if __name__ == "__main__":
    unittest.main()
