"""Signals in every phase, two jobs in one folder, and what a refusal leaves behind: nothing is lost, and nothing is swallowed."""

import os
import pathlib
import signal
import subprocess
import time
import unittest

from support import CONFIGS, FREESTAND, MPIEXEC, InFolder, command, datasets, finished_blocks, result, slow_fit, study_text


def contents(folder):
    """Every file below a folder: its bytes and when it was written."""
    return {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.rglob("*") if path.is_file()}


def ranks_that_start_mpi(folder):
    """Processes of the program, with this folder on their command line, that have loaded the first of Open MPI's parts."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().split(b"\0")
            if words[0] == FREESTAND.encode() and str(folder).encode() in words and "/mca_" in (process / "maps").read_text():
                found.append(int(process.name))
        except OSError:  # it has ended
            continue
    return found


class Stopping(InFolder):
    def start(self, arguments, ranks=1):
        process = subprocess.Popen(command(arguments, ranks), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, true, process):
        deadline = time.monotonic() + 100
        while not true():
            self.assertTrue(time.monotonic() < deadline and process.poll() is None, "what was to be interrupted never came")
            time.sleep(0.002)

    def stop(self, process, number):
        """Asks it to stop; its exit code, and the seconds it took."""
        start = time.monotonic()
        process.send_signal(number)
        _, self.error = process.communicate(timeout=100)
        return process.returncode, time.monotonic() - start

    def whole(self, study):
        folder = self.folder / "whole"
        self.succeed(["run", study, "-o", folder, "--quiet"], 2)
        return result(folder)


class Signals(Stopping):
    def test_while_blocks_are_computed(self):
        study = self.write("study.yaml", study_text(samples=12000))
        whole, folder = self.whole(study), self.folder / "out"
        for ranks, number in ((1, signal.SIGTERM), (2, signal.SIGUSR1)):
            process = self.start(["run", study, "-o", folder, "--quiet", *(["--resume"] if folder.exists() else [])], ranks)
            before = finished_blocks(folder)
            self.wait_for(lambda: finished_blocks(folder) > before, process)
            code, seconds = self.stop(process, number)
            self.assertEqual(code, 75, self.error)
            self.assertLess(seconds, 15)  # 10 s, and what a busy machine adds
            self.assertIn("go on with --resume", self.error)
            self.assertFalse((folder / "freestand.lock").exists())
        self.succeed(["run", study, "-o", folder, "--resume", "--quiet"], 3)
        self.assertEqual(result(folder), whole)
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         ["bins.csv", "fragility.h5", "freestand.files", "ranking.csv", "samples.h5", "study.yaml", "summary.json", "surface.csv"])

    def test_while_samples_are_written(self):
        """It is soon done: a sweep may end whole, with 0, or stopped, with 75. A run never goes on to fit."""
        study = self.write("study.yaml", study_text(samples=20000, block_size=1024))
        for verb, codes in (("sweep", (0, 75)), ("run", (75,))):
            folder = self.folder / verb
            process = self.start([verb, study, "-o", folder, "--quiet"])
            self.wait_for(lambda: (folder / ".samples.h5.part").exists(), process)
            code, seconds = self.stop(process, signal.SIGTERM)
            self.assertIn(code, codes, self.error)
            self.assertEqual((folder / "samples.h5").exists(), code == 0 or verb == "run")
            self.assertLess(seconds, 15)  # 10 s, and what a busy machine adds
            self.succeed(["run", study, "-o", folder, "--resume", "--quiet"], 2)
        self.assertEqual(result(self.folder / "run"), result(self.folder / "sweep"))

    def test_while_it_fits(self):
        """A fit of many seconds, by itself and at the end of a run, on one rank and on two."""
        study = self.write("study.yaml", slow_fit(study_text(samples=16000)))
        folder = self.folder / "out"
        self.succeed(["sweep", study, "-o", folder, "--quiet"], 2)
        for arguments, ranks, number, expected in ((["fit", folder], 1, signal.SIGTERM, 75),
                                                   (["run", study, "-o", folder, "--resume", "--quiet"], 2, signal.SIGUSR1, 74)):
            process = self.start(arguments, ranks)
            self.wait_for(lambda: (folder / "freestand.begun").exists() and (folder / "freestand.lock").exists(), process)
            time.sleep(0.5)
            code, seconds = self.stop(process, number)
            self.assertEqual(code, expected, self.error)  # the second time in a row nothing was finished: more time is asked for
            self.assertLess(seconds, 15)
            self.assertFalse((folder / "fragility.h5").exists())
            self.assertFalse((folder / "freestand.lock").exists())

    def test_while_mpi_starts(self):
        """To one rank, once the parts of MPI are in its memory: it may be met before MPI has started, or in the first steps of the run."""
        study = self.write("study.yaml", study_text(samples=200000))
        for number in (signal.SIGTERM, signal.SIGUSR1, signal.SIGTERM, signal.SIGUSR1):
            folder = self.folder / f"out-{number}-{time.monotonic_ns()}"
            process = self.start(["run", study, "-o", folder, "--quiet"], 2)
            starting = []
            self.wait_for(lambda: starting.extend(ranks_that_start_mpi(folder)) or starting, process)
            os.kill(starting[0], number)
            _, error = process.communicate(timeout=100)
            self.assertEqual(process.returncode, 75, error)

    def test_what_keeps_nothing_ends_at_once(self):
        """Fits of a set, which are begun anew: no result, no word but that."""
        process = self.start(["compare", CONFIGS / "walkthrough" / "cabinet.yaml", "-o", self.folder / "compared", "--quiet"])
        time.sleep(0.2)
        code, seconds = self.stop(process, signal.SIGTERM)
        self.assertEqual(code, 75, self.error)
        self.assertLess(seconds, 5)
        self.assertRegex(self.error, r"stopped on request \(nothing (of the fits )?is kept\): start again")
        self.assertEqual(list(self.folder.glob("compared/*.json")), [])


class Logs(Stopping):
    def test_a_log_that_cannot_be_written_ends_no_run(self):
        """A full disk, and a pipe whose reader has left."""
        study = self.write("study.yaml", study_text(samples=600))
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(command(["run", study, "-o", self.folder / "full"]), stdout=full, stderr=full, timeout=100)
        self.assertEqual(done.returncode, 0)
        process = subprocess.Popen(command(["run", study, "-o", self.folder / "left"]), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.close()
        process.stderr.close()
        self.assertEqual(process.wait(100), 0)
        self.assertEqual(result(self.folder / "left"), result(self.folder / "full"))


class OneFolder(Stopping):
    def test_a_second_job_is_refused_and_the_first_is_not_disturbed(self):
        study = self.write("study.yaml", study_text(samples=12000))
        whole, folder = self.whole(study), self.folder / "out"
        first = self.start(["run", study, "-o", folder, "--quiet"])
        self.wait_for(lambda: finished_blocks(folder), first)
        first.send_signal(signal.SIGSTOP)  # it must not be done before it is disturbed
        for option in ("--resume", "--overwrite"):
            self.fail_with(2, ["run", study, "-o", folder, "--quiet", option], "in use", "process", ranks=2)
        case = self.write("case.yaml", "block: {width_m: 0.6, height_m: 1, mass_kg: 50}\nfriction: {mu: 0.3}\nmotion: {pulse: A, period_s: 0.5, peak_acceleration_g: 0.5}\n")
        self.fail_with(2, ["simulate", case, "-o", folder, "--overwrite"], "in use", "process")
        first.send_signal(signal.SIGCONT)
        _, error = first.communicate(timeout=100)
        self.assertEqual(first.returncode, 0, error)
        self.assertEqual(result(folder), whole)

    def test_a_resume_that_refuses_changes_nothing(self):
        text = study_text(samples=12000)
        study = self.write("study.yaml", "name: first\n" + text)
        other = self.write("other.yaml", "name: second\n" + text.replace("seed: 7", "seed: 8"))
        folder = self.folder / "out"
        process = self.start(["sweep", study, "-o", folder, "--quiet"])
        self.wait_for(lambda: finished_blocks(folder) > 2, process)
        self.assertEqual(self.stop(process, signal.SIGTERM)[0], 75)
        with open(folder / "blocks" / "run-0001.node-000000.log", "ab") as log:
            log.write(b"half a block")
        before = contents(folder)
        self.fail_with(2, ["sweep", other, "-o", folder, "--resume", "--quiet"], "another study")
        self.assertEqual(contents(folder), before)
        self.succeed(["sweep", study, "-o", folder, "--resume", "--quiet"], 2)
        before = contents(folder)
        self.fail_with(2, ["sweep", other, "-o", folder, "--resume", "--quiet"], "another study")
        self.assertEqual(contents(folder), before)

    def test_blocks_of_a_program_that_gives_other_numbers_are_refused(self):
        """The number that says so is in the header of each block, between its format and its checksum."""
        study, folder = self.write("study.yaml", study_text(samples=12000)), self.folder / "out"
        process = self.start(["sweep", study, "-o", folder, "--quiet"])
        self.wait_for(lambda: finished_blocks(folder) > 1, process)
        self.assertEqual(self.stop(process, signal.SIGTERM)[0], 75)
        log = folder / "blocks" / "run-0001.node-000000.log"
        header = bytearray(log.read_bytes())
        header[12] ^= 1
        checksum = 14695981039346656037
        for byte in header[:112]:
            checksum = (checksum ^ byte) * 1099511628211 % 2**64
        header[112:120] = checksum.to_bytes(8, "little")
        log.write_bytes(header)
        self.fail_with(2, ["sweep", study, "-o", folder, "--resume", "--quiet"], "another version of freestand")

    def test_machines_whose_mathematical_library_gives_other_bits_do_not_work_together(self):
        # The C library's functions without fused multiply-add, as on processors that have none.
        older = "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX2_Usable,-FMA_Usable"
        study, folder = self.write("study.yaml", study_text(samples=200)), self.folder / "out"
        self.succeed(["run", study, "-o", folder, "--quiet"])
        self.write("study.yaml", study_text(samples=400))
        command_line = command(["run", study, "-o", folder, "--quiet", "--resume"])
        resumed = subprocess.run(command_line, capture_output=True, text=True, timeout=100, env={**os.environ, "GLIBC_TUNABLES": older})
        if resumed.returncode == 0 and " fma " not in pathlib.Path("/proc/cpuinfo").read_text():
            self.skipTest("this processor has no fused multiply-add")
        self.assertEqual(resumed.returncode, 2, resumed.stderr)
        self.assertIn("kind of machine", resumed.stderr)
        mixed = [MPIEXEC, "-n", "1", *command_line, ":", "-n", "1", "env", f"GLIBC_TUNABLES={older}", *command_line]
        done = subprocess.run(mixed, capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("rank 1 would give other numbers than rank 0"), 1, done.stderr)
        self.succeed(["run", study, "-o", folder, "--quiet", "--resume"])

    def test_a_block_that_cannot_be_read_is_computed_again(self):
        study = self.write("study.yaml", study_text(samples=12000))
        self.succeed(["sweep", study, "-o", self.folder / "whole", "--quiet"], 2)
        folder = self.folder / "out"
        process = self.start(["sweep", study, "-o", folder, "--quiet"])
        self.wait_for(lambda: finished_blocks(folder) > 3, process)
        self.assertEqual(self.stop(process, signal.SIGTERM)[0], 75)
        log = folder / "blocks" / "run-0001.node-000000.log"
        whole = log.read_bytes()
        log.write_bytes(whole[:200] + b"?" + whole[201:-1])  # the first block's values, and the last one's end
        unreadable = log.with_name("run-0002.node-000000.log")
        unreadable.symlink_to(unreadable.name)  # to itself: not even root reads it
        told = self.succeed(["sweep", study, "-o", folder, "--resume", "--quiet"], 2).stderr
        self.assertRegex(told, r"1 of \d+ finished blocks in .*blocks cannot be used \(torn or damaged\): computed again")
        self.assertEqual(datasets(folder / "samples.h5"), datasets(self.folder / "whole" / "samples.h5"))


if __name__ == "__main__":
    unittest.main()
