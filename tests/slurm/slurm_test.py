"""jobs/freestand.slurm under a real Slurm: signalled while it sweeps and while it fits, queued again, and in the end the bits of mpirun."""

import os
import pathlib
import re
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))

from catalogue_test import HEAD
from cluster import Cluster, why_not
from support import FREESTAND, InFolder, datasets, finished_blocks, numbers, result, slow_fit, study_text, walkthrough

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "jobs/freestand.slurm"


class Slurm(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.cluster = cls.enterClassContext(Cluster())

    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.out, self.log = self.folder / "out", self.folder / "log"

    def submit(self, study, *options, verb=()):
        sent = self.cluster.run("sbatch", "--parsable", "--nodes=2", "--ntasks-per-node=2", "--time=10", f"--output={self.log}", *options, SCRIPT,
                                study, self.out, *verb, cwd=self.folder, env={**self.cluster.environment, "FREESTAND": FREESTAND})
        self.assertEqual(sent.returncode, 0, sent.stderr)
        self.job = sent.stdout.strip()

    def facts(self):
        text = self.cluster.run("scontrol", "show", "job", self.job).stdout
        return {key: re.search(rf"\b{key}=(\S+)", text).group(1) for key in ("JobState", "Restarts", "ExitCode")}

    def wait_until(self, true, what, seconds=120, every=0.02):
        deadline = time.monotonic() + seconds
        while not true():
            log = self.log.read_text() if self.log.exists() else ""
            self.assertLess(time.monotonic(), deadline, f"never: {what}\n{self.facts()}\n{log}")
            time.sleep(every)

    def wait_for_slurm(self, true, what):
        """Each question starts a program and is answered by another: asked as often as files are looked at, they take a core."""
        self.wait_until(true, what, every=0.3)

    def ends(self, state, code):
        self.wait_for_slurm(lambda: self.facts()["JobState"] not in ("PENDING", "RUNNING", "COMPLETING"), "the end of the job")
        facts = self.facts()
        self.assertEqual((facts["JobState"], facts["ExitCode"]), (state, f"{code}:0"), self.log.read_text())

    def is_queued_again(self, times):
        def again():
            facts = self.facts()
            return (facts["Restarts"], facts["JobState"]) == (str(times), "PENDING")

        self.wait_for_slurm(again, f"back in the queue, {times}")
        self.assertFalse((self.out / "freestand.lock").exists())

    def starts_again(self):
        self.cluster.run("scontrol", "update", f"JobId={self.job}", "StartTime=now")  # Slurm waits two minutes before it does

    def signal(self, *options):
        self.assertEqual(self.cluster.run("scancel", *options, self.job).returncode, 0)

    def blocks(self):
        return finished_blocks(self.out)

    def test_signalled_in_every_phase_it_ends_with_the_bits_of_mpirun(self):
        """The limit's SIGTERM goes to the step, as by --signal=TERM@..., or to the script, as by --signal=B:..."""
        study = self.folder / "study.yaml"
        study.write_text(slow_fit(study_text(samples=60000)).replace("15000", "6000"))
        self.submit(study)
        while_it_sweeps = [["--signal=TERM"]] + [["--batch", "--signal=USR1"]] * ("FREESTAND_LONG_TESTS" in os.environ)
        for times, options in enumerate(while_it_sweeps, 1):
            before = self.blocks()
            self.wait_until(lambda: self.blocks() > before, "blocks")
            self.signal(*options)
            self.is_queued_again(times)
            self.assertFalse((self.out / "samples.h5").exists())
            self.starts_again()
        self.wait_until(lambda: (self.out / "samples.h5").exists() and (self.out / "freestand.begun").exists(), "a fit")
        self.signal("--batch", "--signal=USR1")
        self.is_queued_again(len(while_it_sweeps) + 1)
        self.assertFalse((self.out / "fragility.h5").exists())
        self.starts_again()
        self.ends("COMPLETED", 0)
        whole = self.folder / "whole"
        self.succeed(["run", study, "-o", whole, "--quiet"], 3)
        self.assertEqual(result(self.out), result(whole))

    def nothing_is_queued(self):
        return not self.cluster.run("squeue", "--noheader", "--states=all", f"--job={self.job}", "--Format=State").stdout.replace("COMPLETED", "").replace("FAILED", "").split()

    def test_short_jobs_of_an_array_go_on_where_the_last_one_ended(self):
        study = self.folder / "study.yaml"
        study.write_text(study_text(samples=100000) + "keep: none\n")
        self.submit(study, "--array=1-2%1", "--open-mode=append")
        self.wait_until(lambda: list(self.out.glob("blocks/run-0001.*.sums")), "counts")
        self.cluster.run("scancel", "--signal=TERM", f"{self.job}_1")
        self.wait_for_slurm(self.nothing_is_queued, "the end of the array")
        self.assertIn("the next job of the array goes on", self.log.read_text())
        whole = self.folder / "whole"
        self.succeed(["run", study, "-o", whole, "--quiet"], 3)
        self.assertEqual(result(self.out), result(whole))
        self.assertEqual(datasets(self.out / "tally.h5"), datasets(whole / "tally.h5"))

    def test_a_wide_job_short_ones_and_a_catalogue_give_the_same_database(self):
        """One study as a job of its own, in an array whose first job is stopped, and as an entry of a catalogue; and under mpirun."""
        box = "block: {width_m: 0.5, height_m: 2}, friction: {mu: 0.3}"
        head = HEAD.replace("samples: 600", "samples: 40000")
        catalogue, study = self.folder / "catalogue.yaml", self.folder / "study.yaml"
        catalogue.write_text(head + f"  - {{id: box, class: box, {box}}}\n  - {{id: wide, class: box, {box.replace('0.5', '0.8')}}}\n")
        study.write_text(head.split("\n", 1)[1].replace("entries:\n", box.replace(", friction", "\nfriction") + "\n"))
        self.submit(study)
        self.ends("COMPLETED", 0)
        wide, self.out = self.out, self.folder / "short"
        self.submit(study, "--array=1-2%1", "--open-mode=append")
        self.wait_until(lambda: self.blocks() > 0, "blocks")
        self.cluster.run("scancel", "--signal=TERM", f"{self.job}_1")
        self.wait_for_slurm(self.nothing_is_queued, "the end of the array")
        self.assertIn("the next job of the array goes on", self.log.read_text())
        short, self.out = self.out, self.folder / "database"
        self.submit(catalogue, verb=["catalogue"])
        self.ends("COMPLETED", 0)
        whole, here = self.folder / "whole", self.folder / "here"
        self.succeed(["run", study, "-o", whole, "--quiet"], 3)
        self.succeed(["catalogue", catalogue, "-o", here], 3)
        for one in (wide, short):
            self.assertEqual(result(one), result(whole))
        for database in (self.out, here):
            self.assertEqual(datasets(database / "entries/box/samples.h5"), datasets(whole / "samples.h5"))
            self.assertEqual((database / "fragility.csv").read_text(), (here / "fragility.csv").read_text())

    @unittest.skipUnless("FREESTAND_LONG_TESTS" in os.environ, "a minute more: FREESTAND_LONG_TESTS")
    def test_a_diagnosis_that_was_stopped_goes_on(self):
        """Of the shortest tests: what it finds is of no concern here, but that a stop does not change it."""
        study = walkthrough(self.folder / "study", ("t01", "t02", "t05"))
        self.submit(study, verb=["diagnose"])
        self.wait_until(lambda: self.blocks() > 5, "answers of fits")
        self.signal("--signal=TERM")
        self.is_queued_again(1)
        self.assertGreater(self.blocks(), 5)
        self.starts_again()
        self.ends("COMPLETED", 0)
        self.succeed(["diagnose", study, "-o", self.folder / "whole", "--quiet"], 3)
        self.assertEqual(*(numbers(folder / "diagnosis.json") for folder in (self.out, self.folder / "whole")))

    def test_what_is_cancelled_or_has_to_be_cured_does_not_come_back(self):
        study = self.folder / "study.yaml"
        study.write_text(study_text(samples=400000))
        self.submit(study)
        self.wait_until(lambda: self.blocks() > 2, "blocks")
        self.cluster.run("scancel", self.job)
        self.wait_for_slurm(lambda: self.facts()["JobState"] == "CANCELLED", "the end of the job")
        time.sleep(2)
        self.assertEqual((self.facts()["JobState"], self.facts()["Restarts"]), ("CANCELLED", "0"), self.log.read_text())

        study.write_text(study_text(samples=400000).replace("seed: 7", "seed: 8"))
        self.submit(study)  # another study
        self.ends("FAILED", 2)


if __name__ == "__main__":
    reason = why_not()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    unittest.main()
