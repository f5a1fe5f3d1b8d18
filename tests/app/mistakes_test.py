"""What a user does wrong is told clearly, with the right exit code, and nothing is lost."""

import json
import math
import os
import re
import resource
import subprocess
import unittest

from support import CONFIGS, MPIEXEC, InFolder, command, result, run, study_text


def with_records(glob):
    text = study_text(samples=50)
    start, end = text.index("motions:"), text.index("fragility:")
    return text[:start] + f'motions:\n  - {{records: "{glob}", scale_to: {{pta_g: 0.5}}}}\n' + text[end:]


class Mistakes(InFolder):
    def check(self, text, *words, code=2):
        study = self.write("study.yaml", text)
        return self.fail_with(code, ["run", study, "-o", self.folder / "out"], *words)

    def test_all_problems_of_a_study_at_once_with_their_lines(self):
        text = study_text().replace("height_m: 2.2", "height: 2.2").replace("seed: 7", "sed: 7")
        text = text.replace("{uniform: [0.3, 1.5]}", "{uniform: [1.5, 0.3]}")
        done = self.check(text, "study.yaml:1:", "study.yaml:5:", "height_m", "study.yaml:9:")
        self.assertGreaterEqual(len(done.stderr.strip().splitlines()), 3)
        self.assertFalse((self.folder / "out").exists())

    def test_problems_are_told_once_whatever_the_number_of_ranks(self):
        study = self.write("study.yaml", study_text().replace("seed: 7", "sed: 7"))
        done = self.fail_with(2, ["run", study, "-o", self.folder / "out"], "study.yaml:1:", ranks=3)
        self.assertEqual(done.stderr.count("study.yaml:1:"), 1)

    def test_check_stops_before_the_sweep(self):
        study = self.write("study.yaml", study_text())
        done = self.succeed(["run", "--check", study])
        self.assertIn("resamples: 50", done.stdout)
        again = self.write("again.yaml", done.stdout)
        self.assertEqual(self.succeed(["run", "--check", again]).stdout, done.stdout)

    def test_check_reads_the_records_that_the_study_names(self):
        self.write("bad.csv", "time_s,floor_acceleration_mps2\n0,0\n0.01,1\n0.02,1x\n0.03,0\n")
        self.write("badder.csv", "time_s,floor_acceleration_mps2\n0,0\n0.01,\n")
        study = self.write("study.yaml", with_records("bad*.csv"))
        checked = self.fail_with(3, ["run", "--check", study], "bad.csv:4", "badder.csv:3", ranks=2)
        self.assertEqual(checked.stdout, "")
        swept = self.fail_with(3, ["run", study, "-o", self.folder / "out"], "bad.csv:4", ranks=2)
        own = [done.stderr.split("-----")[0] for done in (checked, swept)]  # what mpirun says below has job numbers
        self.assertIn("bad.csv:4", own[0])
        self.assertEqual(own[0], own[1])

    def test_check_tells_what_is_doubtful_as_run_does(self):
        """A dispersion in percent, and a record with an offset."""
        rows = [(0.01 * i, 2 * math.sin(0.2 * i) if 50 < i < 350 else 0) for i in range(400)]
        self.write("plain.csv", "time_s,floor_acceleration_mps2\n" + "".join(f"{t:.2f},{a:.6f}\n" for t, a in rows))
        self.write("shifted.csv", "time_s,floor_acceleration_mps2\n" + "".join(f"{t:.2f},{a + 3:.6f}\n" for t, a in rows))
        study = self.write("study.yaml", with_records("*.csv").replace("dispersion: 0.4", "dispersion: 30"))
        checked = self.succeed(["run", "--check", study], 2).stderr
        self.assertIn("has the dispersion 30", checked)
        self.assertIn("shifted.csv has an offset of 2.96 m/s2", checked)
        for verb in ("run", "sweep"):
            swept = run([verb, study, "-o", self.folder / verb, "--quiet"], 2).stderr
            self.assertEqual([line for line in swept.splitlines() if line.startswith("doubtful")], checked.splitlines())
        self.assertEqual(self.succeed(["sweep", "--check", study]).stderr, checked)

    def test_negative_size_and_impossible_friction(self):
        self.check(study_text().replace("uniform: [0.5, 0.9]", "uniform: [-0.5, 0.9]"), "width_m")
        self.check(study_text().replace("static_ratio: 1.2", "static_ratio: 0.8"), "static_ratio")

    def test_bins_that_are_too_narrow_are_refused_before_the_sweep(self):
        text = study_text(samples=2 * 10**8).replace("count: 5", "width: 1e-6")
        self.check(text, "fragility.bins: a width of 1e-06 makes", "no more than 1000 are held")
        text = study_text(samples=2 * 10**8).replace("axes: [friction.mu_k]", "axes: [{name: friction.mu_k, bins: {width: 1e-6}}]")
        self.check(text, "fragility.axes, friction.mu_k: a width of 1e-06 makes")
        self.assertFalse((self.folder / "out" / "blocks").exists())

    def test_empty_glob(self):
        self.check(with_records("nothing/*.AT2"), "nothing/*.AT2")

    def test_record_with_a_bad_number(self):
        self.write("bad.csv", "time_s,floor_acceleration_mps2\n0,0\n0.01,1\n0.02,1x\n0.03,0\n")
        self.check(with_records("bad.csv"), "bad.csv:4", code=3)

    def test_a_converted_record_replaces_nothing_unasked(self):
        record = self.write("rec.csv", "time_s,floor_acceleration_mps2\n0,0\n0.01,1\n0.02,0\n0.03,0\n")
        before = record.read_text()
        self.fail_with(2, ["motion", record, "--convert", record], "rec.csv exists already", "--overwrite")
        self.fail_with(2, ["motion", record, "--convert", self.folder, "--overwrite"], "is no plain file")
        self.assertEqual(record.read_text(), before)
        self.succeed(["motion", record, "--convert", self.folder / "new.csv"])
        self.succeed(["motion", record, "--convert", self.folder / "new.csv", "--overwrite"])

    def test_missing_study_and_wrong_verbs(self):
        self.fail_with(2, ["run", self.folder / "none.yaml", "-o", self.folder / "out"], "none.yaml")
        self.assertEqual(run(["frobnicate"]).returncode, 2)
        self.assertEqual(run([]).returncode, 2)
        self.assertEqual(run(["--help"]).returncode, 0)

    def test_folder_that_exists_is_kept_unless_told_otherwise(self):
        study = self.write("study.yaml", study_text(samples=200))
        out = self.folder / "out"
        self.succeed(["run", study, "-o", out, "--quiet"])
        before = (out / "samples.h5").read_bytes()
        (out / "notes.txt").write_text("mine")
        self.fail_with(2, ["run", study, "-o", out], "--overwrite")
        self.assertEqual((out / "samples.h5").read_bytes(), before)
        self.succeed(["run", study, "-o", out, "--overwrite", "--quiet"])
        self.assertEqual((out / "notes.txt").read_text(), "mine")

    def test_what_is_printed_and_does_not_arrive_is_told(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(command(["effects"]), stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 74, done.stderr)
        self.assertIn("cannot write what is printed", done.stderr)

    def test_a_file_size_limit_has_to_be_cured(self):
        study = self.write("study.yaml", study_text(samples=4000, block_size=512))
        out = self.folder / "out"
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40000, 40000))
        done = run(["sweep", study, "-o", out, "--quiet"], preexec_fn=limit)
        self.assertEqual(done.returncode, 74, done.stderr)
        self.assertIn("--resume", done.stderr)
        self.succeed(["sweep", study, "-o", out, "--resume", "--quiet"])
        self.assertTrue((out / "samples.h5").exists())

    def test_a_full_disk_has_to_be_cured(self):
        study = self.write("study.yaml", study_text(samples=6000, block_size=256))
        whole, disk = self.folder / "whole", self.folder / "disk"
        self.succeed(["run", study, "-o", whole, "--quiet"])
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=600k", "tmpfs", disk], capture_output=True).returncode:
            self.skipTest("no right to mount a small file system here")
        self.addCleanup(subprocess.run, ["umount", disk])
        for ranks, options in ((1, []), (2, ["--resume"])):  # while blocks are written, and again from the start
            done = run(["run", study, "-o", disk / "out", "--quiet", *options], ranks)
            self.assertEqual(done.returncode, 74, done.stderr)
            self.assertIn("No space left", done.stderr)
        subprocess.run(["mount", "-o", "remount,size=900k", disk], check=True)  # enough for the blocks, not for samples.h5
        self.assertEqual(run(["run", study, "-o", disk / "out", "--quiet", "--resume"]).returncode, 74)
        subprocess.run(["mount", "-o", "remount,size=20m", disk], check=True)
        self.succeed(["run", study, "-o", disk / "out", "--quiet", "--resume"])
        self.assertEqual(result(disk / "out"), result(whole))
        self.assertFalse(list((disk / "out").glob(".*")))

    def test_a_folder_that_is_another_one_on_another_node_is_noticed_before_anything_is_computed(self):
        study, disk = self.write("study.yaml", study_text(samples=200)), self.folder / "disk"
        disk.mkdir()
        one = command(["run", study, "-o", disk / "out", "--quiet"])
        # An empty folder, and one in which a run that died has left its lock.
        for left in ("true", f"mkdir {disk}/out && echo '{{}}' >{disk}/out/freestand.lock"):
            alone = ["unshare", "--mount", "sh", "-c", f"mount -t tmpfs tmpfs {disk} && {left} && exec \"$@\"", "sh"]
            if subprocess.run([*alone, "true"], capture_output=True).returncode:
                self.skipTest("no right to mount a file system for one process here")
            done = subprocess.run([MPIEXEC, "-n", "1", *one, ":", "-n", "1", *alone, *one], capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("is not the same folder on every node (rank 1", done.stderr)
            self.assertEqual(done.stderr.count("not the same folder"), 1)
            self.assertEqual(list((disk / "out").iterdir()), [])

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_no_write_permission(self):
        locked = self.folder / "locked"
        locked.mkdir(mode=0o555)
        self.fail_with(2, ["run", self.write("s.yaml", study_text()), "-o", locked / "out"], "permission")

    def test_fit_of_what_is_no_sweep(self):
        self.fail_with(3, ["fit", self.folder], "samples.h5")
        (self.folder / "samples.h5").write_bytes(b"not HDF5")
        self.fail_with(3, ["fit", self.folder], "samples.h5")

    def test_what_would_take_all_memory_is_refused_at_once(self):
        case = re.sub("output_step_s.*", "", (CONFIGS / "case.yaml").read_text())
        for name, line in (("step", "output_step_s: 1e-320"), ("long", "free_vibration_s: 1e300")):
            self.fail_with(2, ["simulate", self.write(f"{name}.yaml", case + line + "\n"), "-o", self.folder / name],
                           "more than 2000000 rows", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (4 << 30,) * 2))

    def test_vertical_and_silent_records(self):
        rows = "".join(f"{0.01 * i:.2f} {0.3 * (-1) ** (i // 25)}\n" for i in range(200))
        for name in ("a-NS.txt", "a-UP.txt"):
            self.write(name, rows)
        self.write("silent.txt", "".join(f"{0.01 * i:.2f} 0\n" for i in range(200)))
        self.write("offset.csv", "time_s,floor_acceleration_mps2\n" + "".join(
            f"{0.01 * i:.2f},{3 + 3 * (-1) ** (i // 25)}\n" for i in range(1000)))
        plain = lambda text, more: text.replace("scale_to: {pta_g: 0.5}", more)
        done = self.succeed(["run", self.write("s.yaml", plain(with_records("a-*.txt"), "unit: g")), "-o", self.folder / "a"])
        self.assertIn("a-UP.txt", done.stderr)
        warnings = json.loads((self.folder / "a" / "summary.json").read_text())["warnings"]
        self.assertTrue(any("a-UP.txt" in warning for warning in warnings), warnings)
        self.check(plain(with_records("a-UP.txt"), "unit: g"), "a-UP.txt", "vertical_records")
        self.check(plain(with_records("silent.txt"), "unit: g"), "silent.txt: its horizontal acceleration is zero throughout", code=3)
        done = self.succeed(["run", self.write("s.yaml", plain(with_records("offset.csv"), "scale: 0.1")), "-o",
                             self.folder / "b"])
        self.assertRegex(done.stderr, r"offset.csv has an offset of 3\.0\d m/s2")

    def test_simulate_writes_what_the_contract_says(self):
        out = self.folder / "case"
        self.succeed(["simulate", CONFIGS / "case.yaml", "-o", out])
        header = (out / "history.csv").read_text().splitlines()[0]
        self.assertEqual(header, "time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,"
                                 "rotation_rate_radps,mode,floor_displacement_m,acceleration_mps2,"
                                 "vertical_acceleration_mps2,contact_horizontal_n,contact_vertical_n")
        for key in ("peak_slip_m", "residual_slip_m", "slid_path_m", "peak_rotation_rad", "overturned", "outcome",
                    "peak_acceleration_g", "events"):
            self.assertIn(f'"{key}"', (out / "summary.json").read_text())


if __name__ == "__main__":
    unittest.main()
