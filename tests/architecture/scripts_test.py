#!/usr/bin/python3
"""The shell scripts against stand-ins for dpkg-query, apt-get, sudo, mpirun, srun and freestand: what they call, say and return."""
import os
import pathlib
import shlex
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = [*(path for path in (ROOT / "jobs").glob("*") if path.suffix != ".md"), ROOT / "tests/run", ROOT / "tests/memcheck", ROOT / "tests/faults/run", ROOT / ".ci/run"]


def packages(optional=False):
    lines = [line for line in (ROOT / "jobs/packages.txt").read_text().splitlines() if line and not line.startswith("#")]
    return {line.split()[0] for line in lines if ("# optional" in line) == optional}


class Stage(unittest.TestCase):
    """A folder of stand-ins that comes first in PATH; each notes how it was called."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        self.bin, self.calls = self.folder / "bin", self.folder / "calls"
        self.bin.mkdir()
        self.calls.write_text("")
        self.environment = {**os.environ, "PATH": f"{self.bin}:/usr/bin:/bin", "LC_ALL": "C"}
        self.environment.pop("FREESTAND_INSTALL", None)

    def stand_in(self, name, body):
        path = self.bin / name
        path.write_text(f'#!/bin/bash\necho "{name} $*" >>"{self.calls}"\n{body}\n')
        path.chmod(0o755)
        return path

    def called(self, name):
        return [line for line in self.calls.read_text().splitlines() if line.split()[0] == name]

    def run_script(self, *command, **options):
        return subprocess.run(command, capture_output=True, text=True, env=self.environment, timeout=60, stdin=subprocess.DEVNULL, **options)


class Install(Stage):
    def installed(self, names):
        listing = "\n".join(f"ii  {name}" for name in names)
        self.stand_in("dpkg-query", f"cat <<'END'\n{listing}\nEND\nexit 1")

    def user(self, number):
        self.stand_in("id", f"echo {number}")

    def install(self):
        return self.run_script(ROOT / "jobs/install")

    def test_quick_and_silent_when_nothing_is_missing(self):
        self.installed(packages())  # the optional ones may be missing
        self.stand_in("apt-get", "exit 9")
        result = self.install()
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.assertEqual(self.called("apt-get"), [])

    def test_root_installs_what_is_missing_and_the_optional(self):
        self.installed(packages() - {"cmake", "python3-h5py"})
        self.user(0)
        self.stand_in("apt-get", "exit 0")
        self.assertEqual(self.install().returncode, 0)
        update, install = self.called("apt-get")
        self.assertTrue(update.endswith(" update"))
        wanted = install.split("--no-install-recommends ")[1].split()
        self.assertEqual(set(wanted), {"cmake", "python3-h5py"} | packages(optional=True))

    def test_user_with_sudo(self):
        self.installed(packages() - {"cmake"})
        self.user(1000)
        self.stand_in("sudo", '[ "$1" = -n ] && exit 0\n"$@"')
        self.stand_in("apt-get", "exit 0")
        self.assertEqual(self.install().returncode, 0)
        self.assertTrue(any("apt-get" in call and "install" in call for call in self.called("sudo")))

    def refused(self, reason, missing):
        result = self.install()
        self.assertEqual(result.returncode, 2)
        self.assertIn(reason, result.stderr)
        self.assertIn(f"  sudo apt-get install --yes --no-install-recommends {missing}", result.stderr.splitlines()[-1])

    def test_user_whose_sudo_wants_a_password(self):
        self.installed(packages() - {"cmake", "ninja-build"})
        self.user(1000)
        self.stand_in("sudo", "exit 1")
        self.stand_in("apt-get", "exit 0")
        self.refused("sudo needs a password", "cmake ninja-build")
        self.assertEqual(self.called("apt-get"), [])

    def test_apt_that_fails_is_heard(self):
        self.installed(packages() - {"cmake"})
        self.user(0)
        self.stand_in("apt-get", "echo E: no network; exit 100")
        self.refused("apt-get failed", "cmake")
        self.assertIn("E: no network", self.install().stderr)

    def test_may_be_switched_off(self):
        self.installed([])
        self.environment["FREESTAND_INSTALL"] = "no"
        self.assertEqual(self.install().returncode, 0)
        self.assertEqual(self.called("dpkg-query"), [])


class Build(Stage):
    def build(self, output):
        self.stand_in("cmake", f'case "$*" in --build*) echo "{output}";; esac')
        script = f'set -euo pipefail; . {ROOT}/jobs/lib.sh; freestand_root={self.folder}; build_without_warnings release'
        return self.run_script("bash", "-c", script)

    def test_a_warning_is_a_mistake(self):
        result = self.build("a.cpp:1:2: warning: unused variable x")
        self.assertEqual(result.returncode, 1)
        self.assertIn("a.cpp:1:2: warning: unused variable x", result.stdout)
        self.assertIn("the build warns", result.stderr)

    def test_silence_is_none(self):
        self.assertEqual(self.build("[1/2] Building CXX object a.cpp.o").returncode, 0)


class Mpirun(Stage):
    def setUp(self):
        super().setUp()
        self.environment["FREESTAND"] = str(self.stand_in("freestand", "exit ${CODE:-0}"))
        self.script = ROOT / "jobs/freestand.mpirun.sh"
        self.stand_in("mpirun", 'while [ "$1" != "$FREESTAND" ]; do shift; done\n"$@"')

    def test_sweep_and_fit_on_all_ranks(self):
        self.assertEqual(self.run_script(self.script, "s.yaml", self.folder / "new", "3").returncode, 0)
        self.assertIn(" -n 3 ", self.called("mpirun")[0])
        self.assertEqual([call.split()[1] for call in self.called("freestand")], ["run"])
        self.assertNotIn("--resume", self.called("freestand")[0])

    def test_goes_on_where_the_folder_is_there(self):
        self.run_script(self.script, "s.yaml", self.folder)
        self.assertIn("--resume", self.called("freestand")[0])

    def test_stopped_early_is_75(self):
        self.environment["CODE"] = "75"
        result = self.run_script(self.script, "s.yaml", self.folder / "new")
        self.assertEqual(result.returncode, 75)
        self.assertIn("to go on", result.stdout)

    def test_the_line_that_goes_on_can_be_pasted(self):
        self.environment["CODE"] = "75"
        folder = self.folder / "new one"
        told = self.run_script(self.script, "my study.yaml", folder, "2").stdout.split("to go on: ")[1]
        self.assertEqual(shlex.split(told), [str(self.script), "my study.yaml", str(folder), "2"])

    def test_what_has_to_be_cured_first_is_not_to_be_started_again(self):
        self.environment["CODE"] = "74"
        result = self.run_script(self.script, "s.yaml", self.folder / "new")
        self.assertEqual(result.returncode, 74)
        self.assertNotIn("to go on", result.stdout)

    def test_mistakes_keep_their_code(self):
        self.environment["CODE"] = "3"
        self.assertEqual(self.run_script(self.script, "s.yaml", self.folder / "new").returncode, 3)
        self.assertEqual(self.run_script(self.script).returncode, 2)
        for ranks in ("two", "0", "-1"):
            self.assertEqual(self.run_script(self.script, "s.yaml", "x", ranks).returncode, 2)
        self.environment["FREESTAND"] = "/nowhere/freestand"
        self.assertEqual(self.run_script(self.script, "s.yaml", "x").returncode, 2)

    def code_when_asked(self, mpirun, ask):
        """What the script ends with where ask(process) comes a little after this stand-in of mpirun has started."""
        self.stand_in("mpirun", mpirun)
        process = subprocess.Popen([self.script, "s.yaml", self.folder / "new"], stdout=subprocess.PIPE, env=self.environment, start_new_session=True)
        for _ in range(200):
            if self.called("mpirun"):
                break
            time.sleep(0.02)
        time.sleep(0.2)
        ask(process)
        process.communicate(timeout=30)
        return process.returncode

    def test_termination_becomes_a_request_to_stop(self):
        mpirun = "trap 'exit 75' USR1\ntrap 'exit 99' TERM\nfor i in $(seq 200); do sleep 0.05; done"
        self.assertEqual(self.code_when_asked(mpirun, lambda process: process.send_signal(signal.SIGTERM)), 75)

    def test_a_request_that_comes_while_mpirun_starts_is_not_lost(self):
        mpirun = "trap '' USR1\nsleep 1\ntrap 'exit 75' USR1\nfor i in $(seq 200); do sleep 0.05; done; exit 98"
        self.assertEqual(self.code_when_asked(mpirun, lambda process: process.send_signal(signal.SIGTERM)), 75)

    def test_so_does_what_a_terminal_sends_to_all_that_it_started(self):
        mpirun = "trap 'exit 75' USR1\ntrap 'exit 1' INT\nfor i in $(seq 200); do sleep 0.05; done"
        self.assertEqual(self.code_when_asked(mpirun, lambda process: os.killpg(process.pid, signal.SIGINT)), 75)


class Slurm(Stage):
    def setUp(self):
        super().setUp()
        self.stand_in("scontrol", 'echo "JobId=77 JobState=${STATE:-RUNNING} Reason=None"')
        self.stand_in("srun", '[ ${CODE:-0} != 0 ] || { mkdir -p results; date +%N >results/summary.json; }; exit ${CODE:-0}')
        self.environment.update(FREESTAND=str(self.stand_in("freestand", "exit 0")), SLURM_JOB_ID="77", SLURM_SUBMIT_DIR=str(self.folder))

    def submit(self, *arguments):
        return self.run_script("bash", ROOT / "jobs/freestand.slurm", *arguments)

    def requeued(self):
        return "scontrol requeue 77" in self.called("scontrol")

    def test_sweep_and_fit_in_one_step_of_all_ranks(self):
        self.assertEqual(self.submit("s.yaml", "results").returncode, 0)
        (step,) = self.called("srun")
        self.assertTrue(step.endswith(" run s.yaml -o results"))
        self.assertIn(" --kill-on-bad-exit=1 ", step)
        self.assertEqual(self.called("scontrol"), [])

    def test_stopped_early_goes_back_into_the_queue(self):
        self.environment["CODE"] = "75"
        (self.folder / "results").mkdir()
        self.assertEqual(self.submit("s.yaml", "results").returncode, 0)
        self.assertTrue(self.requeued())
        self.assertEqual(len(self.called("srun")), 1)
        self.assertIn("--resume", self.called("srun")[0])

    def test_a_step_that_was_not_launched_is_tried_again(self):
        """Slurm 22.05 ends such a step with 0, or where some of its tasks were launched with 137."""
        self.environment["FREESTAND_PAUSE"] = "0"
        self.stand_in("srun", f'[ "$(grep -c ^srun {self.calls})" = 1 ] || {{ mkdir -p results; date >results/summary.json; }}')
        self.assertEqual(self.submit("s.yaml", "results").returncode, 0)
        self.assertEqual(len(self.called("srun")), 2)
        self.stand_in("srun", "exit 0")  # never, beside what an earlier run has written
        lost = self.submit("s.yaml", "results")
        self.assertEqual((lost.returncode, len(self.called("srun"))), (1, 5))
        self.assertIn("not launched", lost.stderr)
        self.stand_in("srun", f'[ "$(grep -c ^srun {self.calls})" != 6 ] || exit 137; date +%N >results/summary.json')
        self.assertEqual((self.submit("s.yaml", "results").returncode, len(self.called("srun"))), (0, 7))
        self.environment["CODE"] = "137"
        self.stand_in("srun", "exit 137")
        self.assertEqual((self.submit("s.yaml", "results").returncode, len(self.called("srun"))), (137, 10))
        self.assertEqual(self.called("scontrol"), [])

    def test_mistakes_and_what_has_to_be_cured_do_not(self):
        """Nor does a rank that was killed, which leaves its lock."""
        (self.folder / "results").mkdir()
        (self.folder / "results" / "freestand.lock").touch()
        for code in (2, 3, 74, 137):
            self.environment["CODE"] = str(code)
            self.assertEqual(self.submit("s.yaml", "results").returncode, code)
        self.assertEqual(self.called("scontrol"), [])
        self.assertEqual(self.submit().returncode, 2)

    def test_in_an_array_the_next_job_goes_on_instead(self):
        self.environment.update(CODE="75", SLURM_ARRAY_JOB_ID="70")
        self.assertEqual(self.submit("s.yaml", "results").returncode, 75)
        self.assertEqual(self.called("scontrol"), [])

    def test_a_catalogue_goes_on_by_itself(self):
        (self.folder / "results").mkdir()
        self.stand_in("srun", "date +%N >results/words.json")
        self.assertEqual(self.submit("c.yaml", "results", "catalogue").returncode, 0)
        (step,) = self.called("srun")
        self.assertTrue(step.endswith(" catalogue c.yaml -o results"))
        self.assertEqual(self.submit("c.yaml", "results", "query").returncode, 2)

    def test_a_cancelled_job_does_not_come_back(self):
        self.environment.update(CODE="75", STATE="COMPLETING")
        self.assertEqual(self.submit("s.yaml", "results").returncode, 75)
        self.assertFalse(self.requeued())

    def test_a_signal_to_the_script_reaches_the_step(self):
        self.stand_in("srun", "trap 'exit 75' USR1\ntrap 'exit 99' TERM\nfor i in $(seq 200); do sleep 0.05; done")
        script = ["bash", ROOT / "jobs/freestand.slurm", "s.yaml", "results"]
        process = subprocess.Popen(script, stdout=subprocess.PIPE, env=self.environment)
        for _ in range(200):
            if self.called("srun"):
                break
            time.sleep(0.02)
        time.sleep(0.2)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 0)
        self.assertTrue(self.requeued())

    def test_asks_for_time_to_stop_and_may_be_requeued(self):
        text = (ROOT / "jobs/freestand.slurm").read_text()
        for line in ("#SBATCH --signal=TERM@120", "#SBATCH --requeue", "#SBATCH --open-mode=append"):
            self.assertIn(line, text)


class Text(unittest.TestCase):
    def test_bash_reads_every_script(self):
        for script in SCRIPTS:
            if script.suffix != ".txt":
                with self.subTest(script.name):
                    self.assertEqual(subprocess.run(["bash", "-n", script]).returncode, 0)
                    if script.name != "lib.sh":
                        self.assertTrue(os.access(script, os.X_OK))
                        self.assertRegex(script.read_text(), r"set -euo pipefail|\nexec ")

    def test_a_check_runs_the_tests(self):
        self.assertIn("tests/run", (ROOT / ".ci/run").read_text())


if __name__ == "__main__":
    unittest.main()
