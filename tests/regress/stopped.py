#!/usr/bin/env python3
"""What is left when a command is stopped or cannot say what it found, and what a run says before it fills a disk.

    stopped.py [GAMBESON]
"""

import json
import os
import signal
import subprocess
import time

from common import HERE, SOURCE, Folder, check, command, run

CASE = HERE / "sphere.json"


def processes(word):
    """Those whose command line has the word."""
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                if word.encode() in open(f"/proc/{entry}/cmdline", "rb").read():
                    found.append(int(entry))
            except OSError:
                pass
    return found


def verify_ends_its_runs(folder):
    """TERM, and KILL: no run outlives the command that started it."""
    (folder / "refs").mkdir()
    case = json.loads(CASE.read_text())
    case["time"]["duration"] = 100
    (folder / "long.json").write_text(json.dumps(case))
    (folder / "refs/tip.json").write_text(json.dumps({
        "id": "tip", "title": "t", "source": "s", "doc": "d", "case": "../long.json", "runs": [{"name": "one"}, {"name": "two"}],
        "checks": [{"kind": "value", "quantity": "q", "of": {"run": "one", "summary": "x"}, "at_least": 0}]}))
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL):
        out = folder / f"stopped_by_{number}"
        verify = subprocess.Popen(command("verify", "--dir", folder / "refs", "--out", out, "--jobs", 2), stdin=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while len(list(out.glob("tip/*/frames/segment_000000.h5"))) < 2:
            check(verify.poll() is None, "verify ended by itself")
            time.sleep(0.02)
        taken = run("verify", "--dir", folder / "refs", "--out", out)
        check(taken.returncode == 2 and "another command" in taken.stderr, f"{taken.returncode} {taken.stderr}")
        verify.send_signal(number)
        said = verify.communicate(timeout=20)[1]
        if number != signal.SIGKILL:
            check(verify.returncode == 1 and "stopped by a signal" in said, f"{verify.returncode}: {said}")
        deadline = time.monotonic() + 10
        while processes(str(out)):
            check(time.monotonic() < deadline, f"runs outlived their verify, ended by signal {number}")
            time.sleep(0.02)


def handles(pid, number):
    """Whether the process has a handler of its own for the signal."""
    with open(f"/proc/{pid}/status") as status:
        caught = next((line for line in status if line.startswith("SigCgt:")), "SigCgt: 0")
    return int(caught.split()[1], 16) >> (number - 1) & 1 == 1


def dress_says_that_it_was_stopped(folder):
    for number in (signal.SIGTERM, signal.SIGINT):
        dress = subprocess.Popen(command("dress", SOURCE / "cases/library/armour_stitched.json", "-o", folder / "on.json"), stdin=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not handles(dress.pid, number):
            check(dress.poll() is None, "dress ended by itself")
            time.sleep(0.02)
        dress.send_signal(number)
        said = dress.communicate(timeout=20)[1]
        check(dress.returncode == 1 and "stopped by a signal" in said, f"{dress.returncode}: {said}")
        check(not (folder / "on.json").exists(), "half a dressed state is left")


def a_structure_keeps_its_path(folder):
    out = folder / "swinging"
    moving = subprocess.Popen(command("run", SOURCE / "cases/library/corner_cloth_soft.json", "--out", out, "--set", "solver.end=100",
                                      "--set", "output.pictures=[]"), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
    table = out / "path.csv"
    while not table.exists() or table.read_text().count("\n") < 3:
        check(moving.poll() is None, "the run ended by itself")
        time.sleep(0.02)
    moving.send_signal(signal.SIGTERM)
    said = moving.communicate(timeout=20)[1]
    check(moving.returncode == 1 and "stopped by a signal" in said and str(table) in said, f"{moving.returncode}: {said}")
    header, *rows = table.read_text().splitlines()
    check(header.startswith("time_s,") and all(len(row.split(",")) == len(header.split(",")) for row in rows), f"{table} is no table")
    check(float(rows[-1].split(",")[0]) > 0, f"{table} has no row of a step")


def a_report_leaves_nothing(folder):
    """In the folder for temporary files, where it cannot be written."""
    check(run("run", CASE, "--out", folder / "out", "--set", "time.duration=20 ms").returncode == 0, "no results")
    temporary = folder / "tmp"
    temporary.mkdir()
    def full():
        import resource
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
    done = subprocess.run(command("report", folder / "out", "-o", folder / "page.html"), stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, env={**os.environ, "TMPDIR": str(temporary)}, preexec_fn=full, restore_signals=False)
    check(done.returncode == 1 and "File too large" in done.stderr, f"{done.returncode} {done.stderr}")
    check(not list(temporary.iterdir()), f"left {list(temporary.iterdir())}")


def what_cannot_be_said_is_no_success(folder):
    with open("/dev/full", "w") as full:
        done = subprocess.run(command("check", CASE, "--full"), stdin=subprocess.DEVNULL, stdout=full, stderr=subprocess.PIPE, text=True)
        check(done.returncode == 1 and "standard output" in done.stderr, f"{done.returncode} {done.stderr}")
        done = subprocess.run(command("run", CASE, "--out", folder / "out", "--set", "time.duration=5 ms"), stdin=subprocess.DEVNULL,
                              stdout=full, stderr=subprocess.PIPE, text=True)
        check(done.returncode == 1 and "standard output" in done.stderr, f"{done.returncode} {done.stderr}")


def much_is_said_before(folder):
    """Recording windows of 10 us, frames ten thousand times as often: said, with about how much, as the run starts."""
    case = json.loads(CASE.read_text())
    case["garment"]["sheet"].update(cells_u=60, cells_v=60)
    case["time"]["duration"] = "10 s"
    case["output"].update(window=1e-5, frame=1e-5)
    (folder / "often.json").write_text(json.dumps(case))
    often = subprocess.Popen(command("run", folder / "often.json", "--out", folder / "out"), stdin=subprocess.DEVNULL,
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    line = often.stderr.readline()
    often.terminate()
    often.communicate()
    check("note: the recording is going to take about" in line and ("GB" in line or "TB" in line), f"said: {line}")
    quiet = run("run", CASE, "--out", folder / "few", "--set", "time.duration=5 ms")
    check("is going to take" not in quiet.stderr, f"a short run warns: {quiet.stderr}")


def set_up_waits(folder):
    """Another apt that holds a lock is waited for; what else goes wrong is said at once."""
    fake = folder / "apt-get"
    fake.write_text('#!/bin/bash\necho "$@" >> "$0.asked"\n'
                    'if [ ! -e "$0.busy" ]; then exit "${fake_status:-0}"; fi\n'
                    'rm "$0.busy"\necho "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 1 (apt-get)" >&2\nexit 100\n')
    fake.chmod(0o755)
    def install(**more):
        return subprocess.run(["bash", "-c", f'set -e; . "{SOURCE}/cases/setup.sh"; as_root() {{ "$@"; }}; apt_pause_s=0.1; install_packages no-such-package-here'],
                              env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", **more}, capture_output=True, text=True, timeout=60)
    (folder / "apt-get.busy").write_text("")
    done = install()
    asked = (folder / "apt-get.asked").read_text()
    check(done.returncode == 0 and "waiting" in done.stderr, f"{done.returncode} {done.stderr}")
    check(asked.count(" update\n") == 2 and asked.count(" install -y") == 1, asked)
    check(all("DPkg::Lock::Timeout=" in line for line in asked.splitlines()), asked)
    (folder / "apt-get.asked").unlink()
    check(install(fake_status="100").returncode == 100, "a failure is no failure")
    check((folder / "apt-get.asked").read_text().count("\n") == 1, "a failure that is no lock was waited for")


def main():
    for test in (set_up_waits, what_cannot_be_said_is_no_success, a_report_leaves_nothing, dress_says_that_it_was_stopped, a_structure_keeps_its_path, much_is_said_before, verify_ends_its_runs):
        with Folder() as folder:
            test(folder)
            print(test.__name__, "good")


if __name__ == "__main__":
    main()
