#!/usr/bin/env python3
"""What a run does to its results folder, and what it says where it cannot write there.

    folders.py [GAMBESON]
"""

import json
import resource
import shutil
import signal
import subprocess

from common import HERE, Folder, check, command, results, run, run_case, same_results

CASE = HERE / "sphere.json"
SHORT = ("--threads", 1, "--set", "time.duration=40 ms")


def refused(done, *words):
    check(done.returncode == 2, f"gave {done.returncode} instead of 2: {done.stderr}")
    for word in words:
        check(str(word) in done.stderr, f"the message lacks {word!r}: {done.stderr}")


def finished_and_changed(folder):
    out = folder / "out"
    run_case(CASE, out, *SHORT)
    shutil.copytree(out, folder / "first")
    facts = (out / "run.json").read_bytes()
    run_case(CASE, out, *SHORT, "--resume")
    same_results(folder / "first", out, "a finished run resumed")
    check((out / "run.json").read_bytes() == facts, "resuming a finished run changed what is known of the run itself")
    # Another case: refused, nothing touched.
    before = results(out)
    refused(run("run", CASE, "--out", out, *SHORT, "--resume", "--set", "contact.friction=0.3"), out, "another case")
    check(results(out) == before, "a refused run changed the results")
    # Without --resume the other case replaces the results, whole.
    run_case(CASE, out, "--threads", 1, "--set", "time.duration=10 ms")
    case = json.loads((out / "case.json").read_text())
    check(abs(case["time"]["duration"] - 0.01) < 1e-9, "case.json is not of the last run")
    check(len(list(out.glob("frames/segment_*.h5"))) == 2, "segments of the earlier run are left")
    # A damaged segment is named.
    (out / "frames/segment_000000.h5").write_bytes(b"not one")
    refused(run("run", CASE, "--out", out, "--threads", 1, "--set", "time.duration=10 ms", "--resume"),
            "segment_000000.h5", "damaged")


def keeps_others(folder):
    """A folder with other things in it keeps them; names that the run would overwrite are refused."""
    out = folder / "mine"
    (out / "frames/deep").mkdir(parents=True)
    (out / "snapshots").mkdir()
    others = ("thesis.txt", "notes.json", "frames/photo.png", "frames/deep/x", "frames/segment_1.h5.bak",
              "snapshots/holiday.png", "work.tmp", "frames/work.tmp")
    for name in others:
        (out / name).write_text(name)
    run_case(CASE, out, *SHORT)
    run_case(CASE, out, *SHORT)  # over an earlier recording
    for name in others:
        check((out / name).read_text() == name, f"{name} was touched")
    own = folder / "own"
    own.mkdir()
    shutil.copy(CASE, own / "case.json")
    refused(run("run", "case.json", "--out", ".", *SHORT, cwd=own), "--out", "case.json")
    check((own / "case.json").read_bytes() == CASE.read_bytes(), "the user's own case was overwritten")
    check([f.name for f in own.iterdir()] == ["case.json"], "a refused run left files")


def cannot_write(folder):
    (folder / "file").write_text("")
    refused(run("run", CASE, "--out", folder / "file", *SHORT), "--out", folder / "file", "not a folder")
    refused(run("run", CASE, "--out", folder / "file/out", *SHORT), "--out", "cannot be made")
    refused(run("run", CASE, "--out", "/proc/gambeson", *SHORT), "--out", "cannot be made")
    # A full disk, played by a limit on the size of files: 1 with the reason, and the folder resumes afterwards.
    for limit in (0, 100, 4000, 9000, 14000):
        def full():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        out = folder / f"full_{limit}"
        done = subprocess.run(command("run", CASE, "--out", out, *SHORT), stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=full,
                              restore_signals=False)
        check(done.returncode == 1, f"limit {limit}: gave {done.returncode}: {done.stderr}")
        check(str(out) in done.stderr and "File too large" in done.stderr, f"limit {limit}: {done.stderr}")
        check(not list(out.rglob("*.tmp")), f"limit {limit}: a temporary file is left")
        run_case(CASE, out, *SHORT, "--resume")
        same_results(folder / "first", out, f"after a disk full at {limit} bytes a file")


def main():
    with Folder() as folder:
        finished_and_changed(folder)
        keeps_others(folder)
        cannot_write(folder)


if __name__ == "__main__":
    main()
