"""Two groups of ranks, in two network namespaces that a pair of virtual cables joins, each with a host name of its own: all that they tell each other goes by
TCP. The bits are those of ranks on one machine, and a rank that is killed takes the others with it."""

import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from support import FREESTAND, MPIEXEC, InFolder, finished_blocks, result, study_text

NAMES = ("first", "second")
NETWORK = "10.81.7"

AGENT = """\
#!/bin/sh
# What mpirun starts a group of ranks by: agent HOST COMMAND...
shift
exec {enter} /bin/sh -c "hostname second; $*"
"""


def ip(*arguments):
    return subprocess.run(["ip", *arguments], capture_output=True, text=True, check=True)


class Networks:
    def __enter__(self):
        self.spaces = [f"freestand-{os.getpid()}-{name}" for name in NAMES]
        with contextlib.ExitStack() as undo:
            for space in self.spaces:
                ip("netns", "add", space)
                undo.callback(subprocess.run, ["ip", "netns", "del", space], check=False)
            ip("link", "add", "first", "netns", self.spaces[0], "type", "veth", "peer", "name", "second", "netns", self.spaces[1])
            for number, (space, name) in enumerate(zip(self.spaces, NAMES), 1):
                ip("-n", space, "address", "add", f"{NETWORK}.{number}/24", "dev", name)
                for device in ("lo", name):
                    ip("-n", space, "link", "set", device, "up")
            self.undo = undo.pop_all()
        return self

    def __exit__(self, *_):
        self.undo.close()

    def enter(self, number):
        return ["ip", "netns", "exec", self.spaces[number], "unshare", "--uts"]


def why_not():
    if os.geteuid() != 0 or not all(map(shutil.which, ("ip", "unshare", "hostname"))):
        return "only root makes networks, by ip and unshare (Debian: iproute2, util-linux)"
    try:
        with Networks() as networks:
            subprocess.run([*networks.enter(1), "hostname", "second"], check=True, capture_output=True)
    except (subprocess.CalledProcessError, OSError) as why:
        return f"no networks can be made here ({getattr(why, 'stderr', '') or why})"
    return None


class TwoNetworks(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.networks = cls.enterClassContext(Networks())

    def setUp(self):
        super().setUp()
        self.agent = self.write("agent", AGENT.format(enter=" ".join(self.networks.enter(1))))
        self.agent.chmod(0o755)

    def start(self, study, out):
        by_tcp = {"plm_rsh_agent": str(self.agent), "oob_tcp_if_include": f"{NETWORK}.0/24", "btl_tcp_if_include": f"{NETWORK}.0/24",
                  "btl": "tcp,self", "pml": "ob1", "osc": "pt2pt"}
        settings = {f"OMPI_MCA_{name}": value for name, value in by_tcp.items()}
        launch = f'hostname first; exec "{MPIEXEC}" --host {NETWORK}.1:2,{NETWORK}.2:2 -n 4 {FREESTAND} run {study} -o {out} --quiet --resume'
        return subprocess.Popen([*self.networks.enter(0), "/bin/sh", "-c", launch], env={**os.environ, **settings}, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def ranks(self, out):
        """Process -> the network that it is in."""
        found = {}
        for entry in pathlib.Path("/proc").iterdir():
            with contextlib.suppress(OSError):
                words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
                if words and words[0] == FREESTAND.encode() and str(out).encode() in words:
                    found[int(entry.name)] = os.readlink(entry / "ns/net")
        return found

    def test_the_bits_of_one_machine_whoever_is_killed(self):
        study, out, whole = self.write("study.yaml", study_text(samples=10000)), self.folder / "out", self.folder / "whole"
        self.succeed(["run", study, "-o", whole, "--quiet"], 2)
        killed = self.start(study, out)
        deadline = time.monotonic() + 60
        while finished_blocks(out) < 3 if (out / "blocks").exists() else True:
            self.assertTrue(time.monotonic() < deadline and killed.poll() is None, "no block was finished")
            time.sleep(0.01)
        ranks = self.ranks(out)
        self.assertEqual(sorted(list(ranks.values()).count(network) for network in set(ranks.values())), [2, 2])
        victim = next(process for process, network in ranks.items() if network != os.readlink(f"/proc/{min(ranks)}/ns/net"))
        os.kill(victim, signal.SIGKILL)
        killed.communicate(timeout=60)
        self.assertEqual(self.ranks(out), {})
        self.assertFalse((out / "fragility.h5").exists())
        again = self.start(study, out)
        _, error = again.communicate(timeout=120)
        self.assertEqual(again.returncode, 0, error)
        self.assertEqual(result(out), result(whole))


if __name__ == "__main__":
    reason = why_not()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    unittest.main()
