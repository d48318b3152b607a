"""A Slurm of three nodes on this machine for a test: munged, slurmctld and three slurmd, in a folder of their own.

Debian's packages slurmctld, slurmd, slurm-client and munge; it takes root, and ends all that it started. On the nodes n1 and
n2, of one processor each, jobs of the partition `high` preempt those of `low`, which are warned with SIGUSR1 and queued again;
n3 is the partition `apart`.
"""
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

NODES = ("n1", "n2", "n3")
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo")
SETTINGS = """ClusterName=test
SlurmctldHost={host}({address})
AuthInfo=socket={folder}/munge.socket,cred_expire=5
SlurmUser=root
SlurmctldPort={ports[0]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdTimeout=10
KillWait=5
SchedulerParameters=sched_interval=2,bf_interval=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SlurmctldParameters=preempt_send_user_signal
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
NodeName=n1 NodeHostname={host} NodeAddr={address} Port={ports[1]} CPUs=1
NodeName=n2 NodeHostname={host} NodeAddr={address} Port={ports[2]} CPUs=1
NodeName=n3 NodeHostname={host} NodeAddr={address} Port={ports[3]} CPUs=1
PartitionName=low Nodes=n1,n2 Default=YES PriorityTier=1 GraceTime=10
PartitionName=high Nodes=n1,n2 PriorityTier=10
PartitionName=apart Nodes=n3
"""


class Unavailable(Exception):
    """Says why no Slurm can be started here."""


def free_ports(address, count):
    """Ports of an address of this machine that nobody listens at."""
    sockets = [socket.create_server((address, 0)) for _ in range(count)]
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def wait_for(holds, seconds, what):
    """Waits until something holds."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {seconds} s")
        time.sleep(0.2)


class Cluster:
    """A context in which the commands of Slurm work."""

    def __enter__(self):
        """Starts all; Unavailable says why it cannot."""
        missing = [name for name in PROGRAMS if not shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")]
        if missing:
            raise Unavailable(f"there is no {', '.join(missing)} (Debian: slurmctld slurmd slurm-client munge)")
        if os.getuid() != 0:
            raise Unavailable("it takes root to start slurmd")
        self.before = dict(os.environ)
        os.environ["PATH"] += ":/usr/sbin:/sbin"
        self.folder = Path(tempfile.mkdtemp(prefix="slurm-"))
        self.folder.chmod(0o755)
        self.processes = {}
        try:
            self.start()
        except (OSError, TimeoutError, subprocess.CalledProcessError) as reason:
            said = "".join(path.read_text(errors="replace")[-500:] for path in sorted(self.folder.glob("*.log")))
            self.__exit__()
            raise Unavailable(f"Slurm does not start: {reason}; {said.strip()}") from None
        return self

    def start(self):
        """Key, settings, daemons."""
        folder, host = self.folder, socket.gethostname().split(".")[0]
        address = socket.gethostbyname(socket.gethostname())  # often of the loopback; what Slurm listens at by its settings
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        (folder / "state").mkdir()
        (folder / "slurm.conf").write_text(SETTINGS.format(folder=folder, host=host, address=address,
                                                            ports=free_ports(address, 1 + len(NODES))))
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        version = subprocess.run(["sinfo", "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
        plugin = "cgroup/v1" if version < "24" else "disabled"  # one is loaded, though none is used
        (folder / "cgroup.conf").write_text(f"CgroupPlugin={plugin}\n")
        self.spawn("munged", "--foreground", "--force", f"--socket={folder}/munge.socket", f"--key-file={key}",
                   f"--log-file={folder}/munged.log", f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munge.seed")
        wait_for((folder / "munge.socket").exists, 10, "munged")
        self.spawn("slurmctld", "-D")
        for node in NODES:
            self.start_node(node)
        wait_for(lambda: self.ask("sinfo", "-h", "-N", "-o", "%N %T").count("idle") == len(NODES), 30, "idle nodes")

    def spawn(self, name, *words, key=None):
        """Starts a daemon in the foreground, in a session of its own."""
        with open(self.folder / f"{key or name}.out", "ab") as said:
            self.processes[key or name] = subprocess.Popen([name, *words], stdout=said, stderr=said, start_new_session=True)

    def start_node(self, node):
        """Starts the slurmd of a node."""
        self.spawn("slurmd", "-D", "-N", node, key=node)

    @staticmethod
    def ask(*words):
        """The lines that a command prints, each of them once."""
        said = subprocess.run(words, capture_output=True, text=True, check=False).stdout
        return "\n".join(dict.fromkeys(line.strip() for line in said.splitlines()))

    def kill_node(self, node):
        """Loses a node as by a power failure: its daemon, the step daemons and all that they run."""
        doomed = [self.processes[node].pid, *step_daemons(self.folder / node)]
        for pid in list(doomed):
            doomed += [child for child in descendants_of(pid) if child not in doomed]
        for pid in doomed:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.processes[node].wait()

    def __exit__(self, *_):
        """Cancels what runs, ends the daemons and removes the folder."""
        if "slurmctld" in self.processes:
            subprocess.run(["scancel", "--user=root"], capture_output=True, check=False)
            time.sleep(1.0)
        for process in reversed(self.processes.values()):
            process.terminate()
        for process in self.processes.values():
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for pid in [pid for node in NODES for pid in step_daemons(self.folder / node)]:
            os.kill(pid, signal.SIGKILL)
        os.environ.clear()
        os.environ.update(self.before)
        shutil.rmtree(self.folder, ignore_errors=True)


def children_of(pid):
    """Ids of the processes that a process has started and that are still its own."""
    try:
        return [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def descendants_of(pid):
    """Children, their children, and so on."""
    found = children_of(pid)
    for child in found:
        found += [each for each in children_of(child) if each not in found]
    return found


def step_daemons(node):
    """Ids of the step daemons that write the log of a node, FOLDER/NODE."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if process.joinpath("comm").read_text().startswith("slurmstepd") \
                    and f"{node}.log" in [os.readlink(link) for link in (process / "fd").iterdir()]:
                found.append(int(process.name))
        except OSError:
            pass  # it has ended
    return found
