#!/usr/bin/env python3
"""What a run does to its results folder, and what it says where it cannot write there.

    folders.py [GAMBESON]
"""

import json
import pathlib
import resource
import shutil
import signal
import subprocess
import time

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
    whole = (out / "frames/segment_000000.h5").read_bytes()
    (out / "frames/segment_000000.h5").write_bytes(b"not one")
    refused(run("run", CASE, "--out", out, "--threads", 1, "--set", "time.duration=10 ms", "--resume"),
            "segment_000000.h5", "damaged")
    # Nor is it replaced: it is not what the run left.
    refused(run("run", CASE, "--out", out, "--threads", 1), "segment_000000.h5", "changed")
    (out / "frames/segment_000000.h5").write_bytes(whole)
    # Pictures and the dressed state are of the last run; what others put there stays.
    (out / "snapshots/holiday.png").write_text("mine")
    pictures = json.dumps([{"time": "end", "field": "plain", "view": "back", "width": 320, "height": 240}])
    run_case(CASE, out, "--threads", 1, "--set", "time.duration=10 ms", "--set", f"output.pictures={pictures}")
    check({p.name for p in (out / "snapshots").glob("*.png")} == {"01_plain_end_back.png", "holiday.png"},
          "pictures of the run before are left")


def put_on_anew(folder):
    """A dressed state is of the last run: one without dressing has none."""
    out = folder / "out"
    worn = ("--threads", 1, "--set", "time.duration=10 ms", "--set", "dressing.settle=10 ms", "--set", "output.pictures=[]")
    run_case(HERE / "shorts.json", out, *worn)
    check((out / "dressed.json").exists(), "a run that dresses leaves no dressed state")
    run_case(CASE, out, *SHORT)
    check(not (out / "dressed.json").exists(), "the dressed state of the run before is left")


def keeps_others(folder):
    """A folder with other things in it keeps them; names that the run would overwrite are refused."""
    out = folder / "mine"
    (out / "frames/deep").mkdir(parents=True)
    (out / "snapshots").mkdir()
    others = ("thesis.txt", "notes.json", "frames/photo.png", "frames/deep/x", "frames/segment_1.h5.bak",
              "snapshots/holiday.png", "work.tmp", "frames/work.tmp", "report.html.tmp")
    for name in others:
        (out / name).write_text(name)
    run_case(CASE, out, *SHORT)
    run_case(CASE, out, *SHORT)  # over an earlier recording
    for name in others:
        check((out / name).read_text() == name, f"{name} was touched")
    # What is edited or put there later is the user's.
    for name in ("report.html", "dressed.json", "frames/segment_000007.h5", "snapshots/01_mine.png", "case.json"):
        before = (out / name).read_bytes() if (out / name).exists() else None
        (out / name).write_text("mine")
        refused(run("run", CASE, "--out", out, *SHORT), "--out", name)
        check((out / name).read_text() == "mine", f"{name} was overwritten")
        (out / name).unlink() if before is None else (out / name).write_bytes(before)
    own = folder / "own"
    own.mkdir()
    shutil.copy(CASE, own / "case.json")
    refused(run("run", "case.json", "--out", ".", *SHORT, cwd=own), "--out", "case.json")
    check((own / "case.json").read_bytes() == CASE.read_bytes(), "the user's own case was overwritten")
    check([f.name for f in own.iterdir()] == ["case.json"], "a refused run left files")


def links(folder):
    """What is linked into a results folder is not written through."""
    (folder / "outside").mkdir()
    for name in ("report.html", "frames", "snapshots", "summary.json", ".lock", ".gambeson"):
        out = folder / ("linked_" + name)
        out.mkdir()
        (out / name).symlink_to(folder / "outside" if "." not in name else folder / "outside" / name)
        if "." in name:
            (folder / "outside" / name).write_text("mine")
        done = run("run", CASE, "--out", out, *SHORT)
        check(done.returncode == 2 and name in done.stderr, f"{name}: {done.returncode} {done.stderr}")
    for file in (folder / "outside").iterdir():
        check(file.read_text() == "mine", f"{file} was written through a link")


def inputs_and_others(folder):
    """No command writes over what it reads, or over what others wrote; nothing is computed before that is said."""
    cloth = CASE.read_text()
    case = lambda name: (folder / name).parent.mkdir(parents=True, exist_ok=True) or (folder / name).write_text(cloth) and name
    text = lambda name: (folder / name).parent.mkdir(parents=True, exist_ok=True) or (folder / name).write_text("mine") and name
    copy_of = lambda name: shutil.copy(HERE / name, folder / name) and name
    study = {"name": "s", "case": "sphere.json", "axes": [{"path": "contact.friction", "values": [0.1, 0.3]}]}
    case("sphere.json")
    (folder / "a.study.json").write_text(json.dumps(study))
    check(run("run", "sphere.json", "--out", "R", *SHORT, cwd=folder).returncode == 0, "no results to begin with")
    reference = {"id": "tip", "title": "t", "source": "s", "doc": "d", "case": "../sphere.json", "runs": [{"name": "one"}],
                 "checks": [{"kind": "value", "quantity": "q", "of": {"run": "one", "summary": "x"}, "at_least": 0}]}
    (folder / "refs").mkdir()
    (folder / "refs/tip.json").write_text(json.dumps(reference))
    trials = [
        (["batch", case("cases/plane.json"), "--out", "."], "cases/plane.json"),
        (["batch", "sphere.json", "--out", "B"], text("B/report.html")),
        (["study", "a.study.json", "--out", "S1"], text("S1/study.json")),
        (["study", "a.study.json", "--out", "S2"], text("S2/variants.csv")),
        (["study", "a.study.json", "--out", "S3"], text("S3/pictures/friction_0.1_01.png")),
        (["study", "a.study.json", "--out", "S4"], text("S4/pictures")),
        (["study", "a.study.json", "--out", "S5"], text("S5/logs/friction_0.1.log")),
        (["study", "a.study.json", "--out", "S6", "--engine", "slurm"], text("S6/study.slurm")),
        (["study", "a.study.json", "--out", "S7"], text("S7/friction_0.3/summary.json")),
        (["verify", "--dir", "refs", "--out", "V1"], text("V1/verify.html")),
        (["verify", "--dir", "refs", "--out", "V2"], text("V2/tip/one/summary.json")),
        (["verify", "--dir", "refs", "--out", "V3"], text("V3/tip/one.log")),
        (["draft", "sphere.json", "-o", "sphere.json"], "sphere.json"),
        (["draft", "sphere.json", "-o", text("drafted.json")], "drafted.json"),
        (["dress", str(HERE / "shorts.json"), "-o", text("dressed.json")], "dressed.json"),
        (["dress", copy_of("shorts.json"), "-o", "shorts.json"], "shorts.json"),
        (["render", "R", "-o", text("a.png")], "a.png"),
        (["report", "R", "-o", text("a.html")], "a.html"),
        (["report", "R", "-o", "R/case.json"], "R/case.json"),
        (["export", "R", "--iges", text("a.igs")], "a.igs"),
        (["export", "R", "--opensim", "walk"], text("walk.mot")),
        (["run", "R/case.json", "--out", "R"], "R/case.json"),
    ]
    for words, file in trials:
        before = (folder / file).read_bytes()
        names = {p for p in folder.rglob("*")}
        done = run(*words, cwd=folder)
        check(done.returncode == 2 and pathlib.Path(file).name in done.stderr, f"{words}: {done.returncode} {done.stdout} {done.stderr}")
        check((folder / file).read_bytes() == before, f"{words}: {file} was overwritten")
        check({p for p in folder.rglob("*")} == names, f"{words}: left {sorted({p for p in folder.rglob('*')} - names)}")
    # What a command wrote itself, it may write again.
    for words in (["draft", "sphere.json", "-o", "cloth.json"], ["render", "R", "-o", "b.png"], ["report", "R", "-o", "R/report.html"],
                  ["export", "R", "--iges", "b.igs"]):
        for _ in range(2):
            done = run(*words, cwd=folder)
            check(done.returncode == 0, f"{words}: {done.stderr}")
    # Until somebody edits it.
    drafted = (folder / "cloth.json").read_text() + "\n"
    (folder / "cloth.json").write_text(drafted)
    refused(run("draft", "sphere.json", "-o", "cloth.json", cwd=folder), "cloth.json", "changed")
    check((folder / "cloth.json").read_text() == drafted, "an edited garment was overwritten")


def one_at_a_time(folder):
    """A run waits some seconds for its folder, and says that it is taken."""
    out = folder / "out"
    started = []
    def begin(*words):
        started.append(subprocess.Popen(command("run", CASE, "--out", out, "--threads", 1, "--set", "time.duration=100", *words),
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
        return started[-1]
    try:
        take_turns(out, begin)
    finally:
        for process in started:
            process.kill()


def batches_and_studies_wait(folder):
    """`batch` and `study` have the folder to themselves as `run` has."""
    (folder / "a.study.json").write_text(json.dumps(
        {"name": "s", "case": str(CASE), "axes": [{"path": "contact.friction", "values": [0.1, 0.3]}]}))
    long = json.loads(CASE.read_text())
    long["time"]["duration"] = 100
    (folder / "long.json").write_text(json.dumps(long))
    begin = lambda out: subprocess.Popen(command("batch", folder / "long.json", "--out", out, "--threads", 1), stdin=subprocess.DEVNULL,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for words in (["batch", CASE], ["study", folder / "a.study.json"]):
        out = folder / ("beside_" + words[0])
        first = begin(out)
        try:
            while not list(out.glob("*/frames/segment_000000.h5")) and first.poll() is None:
                time.sleep(0.02)
            refused(run(*words, "--out", out), "--out", "another command")
        finally:
            first.send_signal(signal.SIGTERM)
            first.wait(timeout=20)


def take_turns(out, begin):
    long = begin()
    while not (out / "frames/segment_000000.h5").exists() and long.poll() is None:
        time.sleep(0.02)
    before = (out / "case.json").read_bytes()
    for words in (["run", CASE], ["run", CASE, "--resume"]):
        refused(run(*words, "--out", out, *SHORT), "--out", "another command")
    check((out / "case.json").read_bytes() == before, "a run wrote into the folder of another")
    # Stopped, it says how it goes on, which it does.
    long.send_signal(signal.SIGTERM)
    said = long.communicate(timeout=20)[1]
    check(long.returncode == 1 and "--resume" in said and str(out) in said, f"{long.returncode}: {said}")
    done = run("run", CASE, "--out", out, *SHORT, "--resume")
    refused(done, "another case")
    again = begin("--resume")
    segments = lambda: len(list(out.glob("frames/segment_*.h5")))
    recorded = segments()
    while segments() == recorded and again.poll() is None:
        time.sleep(0.02)
    again.send_signal(signal.SIGINT)
    said = again.communicate(timeout=20)[1]
    check(again.returncode == 1 and "checkpoint to resume" not in said, f"the stopped run does not go on: {again.returncode} {said}")


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
        links(folder)
        cannot_write(folder)
    for test in (inputs_and_others, put_on_anew, one_at_a_time, batches_and_studies_wait):
        with Folder() as folder:
            test(folder)


if __name__ == "__main__":
    main()
