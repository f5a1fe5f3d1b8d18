"""A run that is killed at any moment is completed by --resume to the same bits."""

import os
import random
import signal
import subprocess
import time
import unittest

from support import InFolder, command, datasets, finished_blocks, folder_of_class, run, study_text


def ranks_of(launcher):
    """Processes of the program below the launcher."""
    found = []
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat") as stat:
                fields = stat.read().rsplit(")", 1)
        except OSError:
            continue
        if int(fields[1].split()[1]) == launcher and "freestand" in fields[0]:
            found.append(int(entry))
    return found


class KillAndResume(InFolder):
    samples = 40000

    @classmethod
    def setUpClass(cls):
        folder = folder_of_class(cls)
        cls.study, cls.whole = folder / "study.yaml", folder / "whole"
        cls.study.write_text(study_text(samples=cls.samples))
        run(["sweep", cls.study, "-o", cls.whole, "--quiet"], 2).check_returncode()

    def start(self, folder, *options):
        return subprocess.Popen(command(["sweep", self.study, "-o", folder, "--quiet", *options], 2),
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def resume(self, folder):
        self.succeed(["sweep", self.study, "-o", folder, "--resume", "--quiet"], 3)
        self.assertEqual(datasets(folder / "samples.h5"), datasets(self.whole / "samples.h5"))

    def test_kill_nine_of_a_rank_at_random_moments(self):
        """Soon after a share of the blocks is kept, however fast the machine is at that time. Not while it starts: Open MPI's launcher may wait
        for ever for a rank that was killed before it had joined the others."""
        dice = random.Random(20051)
        kept = []
        quarters = (0, 0.25, 0.5, 0.75) if "FREESTAND_LONG_TESTS" in os.environ else (0.25, 0.75)
        for number, share in enumerate(dice.uniform(quarter, quarter + 0.25) for quarter in quarters):
            folder = self.folder / f"killed-{number}"
            launcher = self.start(folder)
            while launcher.poll() is None and finished_blocks(folder) <= share * self.samples / 64:
                time.sleep(0.01)
            time.sleep(dice.uniform(0, 0.02))
            for rank in ranks_of(launcher.pid)[:1]:
                os.kill(rank, signal.SIGKILL)
            launcher.communicate(timeout=60)
            kept.append(finished_blocks(folder))
            self.resume(folder)
        self.assertGreater(max(kept), 0, "no run was killed between its first and its last block")

    def test_a_request_to_stop_ends_with_75_and_keeps_the_blocks(self):
        folder = self.folder / "stopped"
        launcher = self.start(folder)
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline and finished_blocks(folder) < 3:
            time.sleep(0.01)
        for rank in ranks_of(launcher.pid):
            os.kill(rank, signal.SIGTERM)
        _, error = launcher.communicate(timeout=60)
        self.assertEqual(launcher.returncode, 75, error)
        self.assertIn("--resume", error)
        self.assertGreaterEqual(finished_blocks(folder), 3)
        self.assertFalse((folder / "samples.h5").exists())
        self.resume(folder)

    def test_resume_refuses_another_study(self):
        folder = self.folder / "stopped"
        launcher = self.start(folder)
        while launcher.poll() is None and finished_blocks(folder) < 2:
            time.sleep(0.01)
        for rank in ranks_of(launcher.pid):
            os.kill(rank, signal.SIGTERM)
        launcher.communicate(timeout=60)
        other = self.write("other.yaml", study_text(samples=self.samples).replace("seed: 7", "seed: 8"))
        for target in (folder, self.whole):
            refused = run(["sweep", other, "-o", target, "--resume", "--quiet"])
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("another study (seed was 7, is 8)", refused.stderr)
        study = (folder / "study.yaml").read_text()
        (folder / "study.yaml").write_text(study.replace("height_m: 2.2", "height_m: 2.3"))  # the blocks are what counts
        self.fail_with(2, ["sweep", other, "-o", folder, "--resume"], "study.yaml would be replaced")
        (folder / "study.yaml").unlink()
        self.fail_with(2, ["sweep", other, "-o", folder, "--resume"], "another study (their fingerprint differs)")
        finished = finished_blocks(folder)
        self.fail_with(2, ["sweep", self.study, "-o", folder],
                       f"--resume goes on, --overwrite throws {finished} finished blocks away")
        # Other bins are no other study: their samples are the same.
        self.study = self.write("study.yaml", study_text(samples=self.samples).replace("count: 5", "count: 7"))
        self.resume(folder)


if __name__ == "__main__":
    unittest.main()
