"""A Slurm of one node on this machine, of the distribution's packages (slurm-wlm, munge), for tests; run by root.

Everything is in a folder of its own and on free ports of 127.0.0.1: an own key of munge, slurm.conf, states, logs. The node
has two processors. A node that is silent is given up after seconds, as a cluster does after minutes. Nothing is left: the
daemons are killed with whatever they started.
"""

import ctypes
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "scontrol", "squeue", "sinfo")

CONF = """ClusterName=gambeson
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ctl_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdPort={node_port}
SlurmdPidFile={folder}/slurmd.pid
SlurmdLogFile={folder}/slurmd.log
SlurmdSpoolDir={folder}/slurmd
StateSaveLocation={folder}/state
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0,defer
JobRequeue=1
ReturnToService=2
KillWait=2
CompleteWait=0
MinJobAge=300
InactiveLimit=0
SlurmctldTimeout=10
SlurmdTimeout={silence}
MessageTimeout=5
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 NodeHostname={host} Port={node_port} CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=short Nodes={host} Default=YES MaxTime=60 State=UP
"""


def missing():
    """What this needs and the machine has not; empty where it can start."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    lacking = [p for p in PROGRAMS if not shutil.which(p, path=path)]
    if os.geteuid() != 0:
        lacking.append("root")
    return lacking


def die_with_parent():
    """Of a daemon, before it starts: a test that is killed leaves none."""
    PR_SET_PDEATHSIG = 1
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def processes():
    """pid -> (its environment, its parent, its arguments), of all that can be read."""
    found = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            status = pathlib.Path(f"/proc/{entry}/stat").read_text()
            fields = status[status.rindex(")") + 2:].split()
            if fields[0] == "Z":
                continue
            environment = pathlib.Path(f"/proc/{entry}/environ").read_bytes()
            arguments = pathlib.Path(f"/proc/{entry}/cmdline").read_bytes()
        except OSError:
            continue
        found[int(entry)] = (environment, int(fields[1]), arguments)
    return found


class SlurmNode:
    silence_s = 5  # after which a node counts as lost

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="gambeson_slurm_", dir="/tmp"))
        self.host = socket.gethostname().split(".")[0]
        # What every process here has in its environment: by this mark they are known, whoever became their parent.
        self.mark = f"GAMBESON_SLURM_NODE={self.folder}"
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf"),
                            "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}
        name, value = self.mark.split("=")
        self.environment[name] = value
        self.daemons = {}
        try:
            self.start()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def start(self):
        for name in ("munge", "state", "slurmd"):
            (self.folder / name).mkdir(mode=0o755)
        # munge refuses sockets and keys in folders that others may write.
        os.chmod(self.folder, 0o755)
        key = self.folder / "munge/key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        (self.folder / "slurm.conf").write_text(CONF.format(folder=self.folder, host=self.host, ctl_port=free_port(), node_port=free_port(),
                                                            silence=self.silence_s))
        m = self.folder / "munge"
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={m}/socket", f"--pid-file={m}/pid", f"--log-file={m}/log",
                    f"--seed-file={m}/seed")
        self.wait(lambda: (m / "socket").exists(), "munged", 10)
        self.daemon("slurmctld", "-D", "-c")
        self.start_node()

    def daemon(self, program, *arguments):
        log = open(self.folder / f"{program}.out", "ab")
        self.daemons[program] = subprocess.Popen([program, *arguments], env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                                 start_new_session=True, preexec_fn=die_with_parent)

    def start_node(self):
        self.daemon("slurmd", "-D", "-N", self.host)
        self.wait(lambda: self.state() in ("idle", "mixed", "allocated", "mix", "alloc"), "the node", 60)

    def kill_node(self):
        """As if its power went: slurmd, and all steps with what runs in them, at once."""
        doomed = self.of_node()
        for pid in doomed:
            self.send(pid, signal.SIGSTOP)
        for pid in sorted(set(doomed) | set(self.of_node())):
            self.send(pid, signal.SIGKILL)
        self.daemons["slurmd"].wait()
        self.wait(lambda: not self.of_node(), "the node's end", 10)
        return len(doomed) - 1

    def of_node(self):
        """slurmd, and of all that bears the mark what is neither a daemon nor of ours."""
        others = {p.pid for name, p in self.daemons.items() if name != "slurmd"}
        return [pid for pid, (environment, _, arguments) in processes().items()
                if pid not in others and pid != os.getpid() and
                (pid == self.daemons["slurmd"].pid or arguments.startswith(b"slurmstepd") or b"SLURM_JOB_ID=" in environment)
                and (self.mark.encode() in environment.split(b"\0"))]

    @staticmethod
    def send(pid, what):
        try:
            os.kill(pid, what)
        except ProcessLookupError:
            pass

    def run(self, *command, **more):
        return subprocess.run([str(c) for c in command], env=self.environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, **more)

    def asked(self, *command):
        done = self.run(*command)
        if done.returncode != 0:
            raise AssertionError(f"{' '.join(map(str, command))} gave {done.returncode}: {done.stdout} {done.stderr}")
        return done.stdout

    def state(self):
        done = self.run("sinfo", "-h", "-o", "%T")
        return done.stdout.strip().rstrip("*~#!%$@^-+") if done.returncode == 0 and "*" not in done.stdout else ""

    def jobs(self):
        """Of all that waits or runs: (job, index in its array or "N/A", state)."""
        rows = self.asked("squeue", "-h", "-r", "-o", "%F %K %T").split("\n")
        return [tuple(row.split()) for row in rows if row]

    def wait(self, holds, what, limit_s):
        deadline = time.monotonic() + limit_s
        while not holds():
            for name, process in self.daemons.items():
                if process.poll() is not None and name != "slurmd":
                    raise AssertionError(f"{name} ended:\n{self.logs()}")
            if time.monotonic() > deadline:
                raise AssertionError(f"waited {limit_s} s for {what}:\n{self.logs()}")
            time.sleep(0.05)

    def logs(self):
        text = ""
        for file in sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out"), self.folder / "munge/log"]):
            if file.exists():
                text += f"--- {file.name}\n" + "\n".join(file.read_text(errors="replace").splitlines()[-25:]) + "\n"
        return text

    def __exit__(self, kind, error, trace):
        # By their ids: what bears the mark is of this node alone.
        for _ in range(100):
            ours = [pid for pid, (environment, _, _) in processes().items() if self.mark.encode() in environment.split(b"\0") and pid != os.getpid()]
            if not ours:
                break
            for pid in ours:
                self.send(pid, signal.SIGKILL)
            for process in self.daemons.values():
                process.poll()
            time.sleep(0.05)
        for process in self.daemons.values():
            process.wait()
        if kind is None or os.environ.get("GAMBESON_KEEP") is None:
            shutil.rmtree(self.folder, ignore_errors=True)
