"""Slurm on this machine, as plain processes with separate files and keys, for tests."""

import os
import pathlib
import shutil
import socket
import subprocess
import time

CONFIGURATION = """ClusterName=pastefit
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=2,sched_min_interval=2,batch_sched_delay=0
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """The first program of Slurm that is not here; None if all are."""
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    return next((name for name in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue") if not shutil.which(name)), None)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """One node with the processors of this machine. `start` says whether its jobs run here."""

    def __init__(self, folder):
        self.folder, self.processes = pathlib.Path(folder), []
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))

    def _start(self, *command):
        log = open(self.folder / f"{command[0]}.txt", "w")
        self.processes.append(subprocess.Popen(command, stdout=log, stderr=log, env=self.environment))
        log.close()

    def start(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        os.chmod(self.folder, 0o711)
        host = socket.gethostname().split(".")[0]
        key = self.folder / "key"
        key.write_bytes(os.urandom(256))
        key.chmod(0o400)
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, user=user, folder=self.folder, ports=free_ports(2), cpus=len(os.sched_getaffinity(0))))
        self._start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                    f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                    f"--seed-file={self.folder}/seed")
        self._start("slurmctld", "-D")
        self._start("slurmd", "-D", "-N", host)
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline and all(one.poll() is None for one in self.processes):
            if "idle" in self.run("sinfo", "--noheader").stdout:
                return True
            time.sleep(0.2)
        return False

    def run(self, *command):
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, env=self.environment, timeout=60)

    def jobs(self):
        """The elements that wait or run: [(id, state)]."""
        lines = self.run("squeue", "--noheader", "--array", "--format=%i %T").stdout.splitlines()
        return [tuple(line.split()) for line in lines]

    def waits_no_longer(self):
        """Slurm lets two minutes pass before it starts again what it was told to queue again."""
        for job, state in self.jobs():
            if state == "PENDING":
                self.run("scontrol", "update", f"jobid={job}", "StartTime=now")

    def stop(self):
        if self.processes:
            self.run("scancel", "--state=PENDING", f"--user={os.getuid()}")
            self.run("scancel", "--state=RUNNING", f"--user={os.getuid()}")
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
