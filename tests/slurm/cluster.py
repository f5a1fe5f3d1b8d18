"""A Slurm cluster of this machine alone: munged, slurmctld and two slurmd on loopback, in a folder that goes when it ends.

Two nodes, so that a step has ranks on both. Nothing of an installed Slurm is touched: configuration, keys, sockets, ports, logs
and spool folders are its own. Only processes that were started here are stopped, by their numbers.
"""

import os
import pathlib
import pwd
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "scontrol", "squeue")
NODES = ("first", "second")

CONFIGURATION = """\
ClusterName=freestand
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
TmpFS={folder}/tmp-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1,requeue_delay=1,sched_min_interval=100000
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
KillWait=5
MinJobAge=300
OverTimeLimit=0
SlurmctldTimeout=30
SlurmdTimeout=30
NodeName=first NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=2 RealMemory=2000
NodeName=second NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=2 RealMemory=2000
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
"""


def why_not():
    """Why no cluster can be started here, or nothing."""
    missing = [program for program in PROGRAMS if not find(program)]
    if missing:
        return f"Slurm is not installed ({', '.join(missing)} missing; Debian: slurm-wlm munge)"
    if os.geteuid() != 0:
        return "slurmd has to be started by root"
    try:
        pwd.getpwnam("munge")
    except KeyError:
        return "there is no user munge"
    return None


def find(program):
    return shutil.which(program, path=f"{os.environ['PATH']}:/usr/sbin:/sbin")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="freestand-slurm-", dir="/tmp"))
        self.folder.chmod(0o755)
        self.started = []
        # Ranks of both nodes talk by TCP: Open MPI's shared memory takes two nodes of one name for one.
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf"), "OMPI_MCA_btl": "tcp,self",
                            "OMPI_MCA_btl_tcp_if_include": "lo", "OMPI_MCA_pml": "ob1", "OMPI_MCA_osc": "pt2pt"}

    def __enter__(self):
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self._end_jobs()
        for process in reversed(self.started):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _end_jobs(self):
        """A test that failed may leave one, which outlives the daemons."""
        if not any(process.poll() is None and "slurmctld" in str(process.args[0]) for process in self.started):
            return
        self.run("scancel", "--full", "--me")
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline and self.run("squeue", "--noheader").stdout.strip():
            time.sleep(0.1)

    def _start(self):
        text = CONFIGURATION.format(host=socket.gethostname(), ports=free_ports(3), folder=self.folder)
        (self.folder / "slurm.conf").write_text(text)
        (self.folder / "state").mkdir()
        for node in NODES:
            (self.folder / f"spool-{node}").mkdir()
            (self.folder / f"tmp-{node}").mkdir()  # of PMIx, which names its files by the step alone
        self._start_munge()
        self._daemon("slurmctld", "-D", "-f", self.folder / "slurm.conf", "-i")
        for node in NODES:
            self._daemon("slurmd", "-D", "-N", node, "-f", self.folder / "slurm.conf")
        self._wait_until(lambda: self.run("sinfo", "-h", "-t", "idle", "-o", "%D").stdout.strip() == str(len(NODES)), 40, "no idle nodes")

    def _start_munge(self):
        home = self.folder / "munge"
        home.mkdir(mode=0o755)
        (home / "key").write_bytes(os.urandom(128))
        (home / "key").chmod(0o600)
        munge = pwd.getpwnam("munge")
        for path in (home, home / "key"):
            os.chown(path, munge.pw_uid, munge.pw_gid)
        self._daemon("munged", "--foreground", "--force", f"--socket={self.folder}/munge/socket", f"--key-file={home}/key",
                     f"--pid-file={home}/pid", f"--log-file={home}/log", f"--seed-file={home}/seed", user=munge.pw_uid, group=munge.pw_gid)

    def _daemon(self, program, *arguments, **options):
        log = open(self.folder / f"{program}.out", "ab")  # it lives as long as the daemon
        self.started.append(subprocess.Popen([find(program), *map(str, arguments)], env=self.environment, stdin=subprocess.DEVNULL,
                                             stdout=log, stderr=log, start_new_session=True, **options))
        log.close()

    def _wait_until(self, true, seconds, otherwise):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if true():
                return
            time.sleep(0.1)
        logs = "\n".join(f"-- {log.name}\n{log.read_text(errors='replace')[-2000:]}" for log in self.folder.glob("*.log"))
        raise TimeoutError(f"{otherwise} after {seconds} s\n{logs}")

    def run(self, program, *arguments, **options):
        options.setdefault("env", self.environment)
        return subprocess.run([find(program), *map(str, arguments)], capture_output=True, text=True, timeout=60, **options)
