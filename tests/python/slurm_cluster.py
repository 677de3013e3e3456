"""A cluster of Slurm on this machine: real daemons with a munge key, ports and folders of their own, without systemd, cgroups or accounting.
One node, on which four tasks run at a time."""

import os
import pathlib
import socket
import subprocess

from support import eventually

PROGRAMS = ("/usr/sbin/munged", "/usr/sbin/mungekey", "/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/bin/sbatch", "/usr/bin/squeue",
            "/usr/bin/scancel", "/usr/bin/sinfo")


def why_not():
    """Empty if a cluster can run; else the missing part."""
    for program in PROGRAMS:
        if not pathlib.Path(program).exists():
            return f"{program} is not installed (packages munge, slurmctld, slurmd, slurm-client)"
    return "" if os.geteuid() == 0 else "Slurm's daemons start tasks as others: this test runs as root"


def free_ports():
    """Two ports that nobody listens at now."""
    with socket.socket() as one, socket.socket() as other:
        for each in (one, other):
            each.bind(("127.0.0.1", 0))
        return one.getsockname()[1], other.getsockname()[1]


def configuration(folder):
    host = socket.gethostname().partition(".")[0]
    controller_port, node_port = free_ports()
    return f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
SlurmdParameters=config_overrides
KillWait=1
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP
"""


class SlurmCluster:
    def __init__(self, folder):
        self.env = os.environ | {"SLURM_CONF": f"{folder}/slurm.conf"}
        for name in ("state", "spool"):
            (folder / name).mkdir(parents=True)
        (folder / "slurm.conf").write_text(configuration(folder))
        self.said("/usr/sbin/mungekey", "--create", "--keyfile", f"{folder}/munge.key")
        # Their own words go to a file: nobody reads them here.
        self.log = (folder / "said.log").open("ab")
        self.daemons = [subprocess.Popen(words, env=self.env, stdout=self.log, stderr=self.log, stdin=subprocess.DEVNULL) for words in (
            ["/usr/sbin/munged", "--foreground", "--force", "--key-file", f"{folder}/munge.key", "--socket", f"{folder}/munge.socket",
             "--pid-file", f"{folder}/munged.pid", "--seed-file", f"{folder}/munged.seed", "--log-file", f"{folder}/munged.log"],
            ["/usr/sbin/slurmctld", "-D"], ["/usr/sbin/slurmd", "-D"])]
        if not eventually(lambda: self.said("/usr/bin/sinfo", "-h", "-o", "%T") == "idle\n"):
            self.close()
            raise RuntimeError(f"Slurm's node does not take work; see {folder}")

    def close(self):
        self.said("/usr/bin/scancel", "--user=root")
        eventually(lambda: not self.said("/usr/bin/squeue", "-h"))
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait()
        self.log.close()

    def said(self, *words):
        return subprocess.run(words, env=self.env, capture_output=True, text=True).stdout

    def submit(self, variables, *words):
        """sbatch with these variables and words; the job's number."""
        return subprocess.run(["/usr/bin/sbatch", "--parsable", *words], env=self.env | variables, check=True, capture_output=True,
                              text=True).stdout.strip()

    def tasks(self, job):
        """Tasks of a job that wait or run, such as "7_2"; none once it has ended."""
        return self.said("/usr/bin/squeue", "-h", "-r", "-o", "%i", f"--jobs={job}").split()

    def cancel(self, task):
        self.said("/usr/bin/scancel", task)
