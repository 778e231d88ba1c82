#!/usr/bin/env python3
"""Studies as a whole: killed and resumed, they leave the same bytes; a variant that fails does not stop the rest.

    study.py [GAMBESON]

Kills hit the study itself (SIGKILL: its runs must die with it) and single runs of it (they are listed as failed, and
--resume does them). What is compared: study.json, the tables, the page, and the results of every run.
"""

import csv
import json
import os
import random
import signal
import subprocess
import time

from common import HERE, Folder, check, command, results, run

KILLS = 6


def study(folder, **more):
    case = json.loads((HERE / "sphere.json").read_text())
    case["time"]["duration"] = "0.2 s"
    case["output"]["pictures"] = []
    (folder / "sphere.json").write_text(json.dumps(case))
    text = {"name": "thin and thick", "case": "sphere.json", "pictures": [{"time": "end", "width": 200, "height": 160}],
            "axes": [{"path": "factors.thickness", "values": [0.5, 1]},
                     {"path": "contact.friction", "labels": ["slick", "rough"], "values": [0.1, 0.3]}], **more}
    (folder / "a.study.json").write_text(json.dumps(text, indent=1))
    return folder / "a.study.json"


def contents(out):
    """Everything but what timings are in."""
    files = {name: (out / name).read_bytes() for name in ("study.json", "variants.csv", "curves.csv", "exponents.csv", "elasticities.csv", "meshes.csv", "uncertainty.csv", "report.html")}
    for png in sorted((out / "pictures").glob("*.png")):
        files["pictures/" + png.name] = png.read_bytes()
    for variant in json.loads(files["study.json"])["variants"]:
        for name, content in results(out / variant["variant"]).items():
            files[variant["variant"] + "/" + name] = content
    return files


def children(pid):
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                status = open(f"/proc/{entry}/stat").read()
            except OSError:
                continue
            if int(status[status.rindex(")") + 2:].split()[1]) == pid:
                found.append(int(entry))
    return found


def state(pid):
    """R, S, D, T (stopped), Z (ended, its parent has not asked yet); Z too where there is none."""
    try:
        return open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()[0]
    except OSError:
        return "Z"


def killed(pid):
    """Kills a run by SIGKILL; False where it had ended by itself. Only one that stands still has surely not."""
    try:
        os.kill(pid, signal.SIGSTOP)
        while state(pid) not in "TZ":
            time.sleep(0.001)
        if state(pid) == "Z":
            return False
        os.kill(pid, signal.SIGKILL)
        return True
    except ProcessLookupError:
        return False


def interrupted(folder):
    file = study(folder)
    begin = time.monotonic()
    done = run("study", file, "--out", folder / "whole", "--jobs", 2, "--threads", 2)
    check(done.returncode == 0, f"the study failed: {done.stdout} {done.stderr}")
    took_s = time.monotonic() - begin
    whole = contents(folder / "whole")
    chance = random.Random(20130620)
    died = 0
    for k in range(KILLS):
        process = subprocess.Popen(command("study", file, "--out", folder / "cut", "--resume", "--jobs", 2, "--threads", 2),
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(chance.uniform(0.02, 0.5) * took_s)
        except subprocess.TimeoutExpired:
            runs = children(process.pid)
            if k % 3 == 2 and runs and killed(chance.choice(runs)):
                check(process.wait() == 1, "a run was killed, and the study did not say so")
                check("ended by signal 9" in (folder / "cut/report.html").read_text(), "the page does not say which run was killed")
            elif k % 3 == 1:
                process.send_signal(signal.SIGINT)
                code = process.wait()
                if code == 0:  # it was done before the signal came
                    continue
                check(code in (1, -signal.SIGINT), f"an interrupted study did not say so: {code}")  # early on it only dies
            else:
                process.kill()
                process.wait()
            died += 1
            deadline = time.monotonic() + 20
            while not all(state(r) == "Z" for r in runs):
                check(time.monotonic() < deadline, "runs outlived their study")
                time.sleep(0.02)
    last = run("study", file, "--out", folder / "cut", "--resume", "--jobs", 2, "--threads", 2)
    check(last.returncode == 0, f"the resumed study failed: {last.stdout} {last.stderr}")
    cut = contents(folder / "cut")
    check(whole.keys() == cut.keys(), f"other files: {sorted(whole.keys() ^ cut.keys())}")
    other = [name for name in whole if whole[name] != cut[name]]
    check(not other, f"these differ: {other}")
    check(died >= 3, f"only {died} studies were interrupted")
    # Nothing is left to do, and nothing is done again.
    stamps = {p: p.stat().st_mtime_ns for p in (folder / "cut").glob("*/summary.json")}
    again = run("study", file, "--out", folder / "cut", "--resume")
    check(again.returncode == 0 and "4 of 4 variants are done already" in again.stdout, f"{again.stdout} {again.stderr}")
    check(all(p.stat().st_mtime_ns == t for p, t in stamps.items()), "runs that were done ran again")
    # A case that changed is run again, the others are kept.
    text = json.loads(file.read_text())
    text["axes"][1]["values"] = [0.1, 0.35]
    file.write_text(json.dumps(text))
    changed = run("study", file, "--out", folder / "cut", "--resume")
    check(changed.returncode == 0 and "2 of 4 variants are done already" in changed.stdout, f"{changed.stdout} {changed.stderr}")
    again = {p for p, t in stamps.items() if p.stat().st_mtime_ns != t}
    check({p.parent.name for p in again} == {"thickness_0.5__rough", "thickness_1__rough"}, f"other runs ran again: {again}")
    # Results that cannot be read are none.
    summary = sorted(stamps)[0]
    summary.write_text(summary.read_text().replace('"control_points": ', '"control_points": "many", "counted": ', 1))
    damaged = run("study", file, "--out", folder / "cut", "--resume")
    check(damaged.returncode == 1 and "1 of 4 variants failed" in damaged.stdout and "control_points: must be a whole number" in damaged.stdout,
          f"{damaged.returncode} {damaged.stdout} {damaged.stderr}")
    print(f"{died} interruptions, {len(whole)} files, {sum(map(len, whole.values()))} bytes, all the same")


def failing(folder):
    """A body with a face that looks the wrong way, which only building it shows, in one of three."""
    corners = "v 0.05 0 -0.04\nv -0.03 0.05 -0.04\nv -0.03 -0.05 -0.04\nv 0 0 0.04\n"
    (folder / "good.obj").write_text(corners + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    (folder / "turned.obj").write_text(corners + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 3 4\n")
    body = lambda name: [{"name": "body", "mesh": {"file": name}}]
    file = study(folder, set={"time.duration": "20 ms"},
                 axes=[{"name": "body", "path": "obstacles", "labels": ["soft", "hard", "soft too"],
                        "values": [body("good.obj"), body("turned.obj"), body("good.obj")]}])
    done = run("study", file, "--out", folder / "out", "--jobs", 2)
    check(done.returncode == 1, f"gave {done.returncode}: {done.stdout} {done.stderr}")
    numbers = json.loads((folder / "out/study.json").read_text())
    status = {v["variant"]: v["status"] for v in numbers["variants"]}
    check(status == {"soft": "done", "hard": "failed", "soft_too": "done"}, f"{status}")
    why = next(v["why"] for v in numbers["variants"] if v["variant"] == "hard")
    check(len(why) > 10 and "FAILED  hard" in done.stdout and "1 of 3 variants failed" in done.stdout, done.stdout)
    check("The variant hard failed" in (folder / "out/report.html").read_text(), "the page does not show the failure")
    rows = list(csv.DictReader((folder / "out/variants.csv").open()))
    check([r["status"] for r in rows] == ["done", "failed", "done"], f"{rows}")
    print(f"one of three failed: {why}")


def refused(folder):
    """Nothing runs where one variant is wrong; a folder that is in the way is not written to."""
    file = study(folder, axes=[{"path": "factors.thickness", "values": [0.5, 0.0]}])
    done = run("study", file, "--out", folder / "out")
    check(done.returncode == 2 and "a.study.json:" in done.stderr and "factors.thickness" in done.stderr, f"{done.returncode} {done.stderr}")
    check(not (folder / "out").exists(), "a study with a bad variant left something")
    file = study(folder)
    (folder / "out/thickness_1__slick/frames").mkdir(parents=True)  # of a run killed early, which is not in the way
    (folder / "out/thickness_1__rough").mkdir(parents=True)
    (folder / "out/thickness_1__rough/notes.txt").write_text("mine")
    done = run("study", file, "--out", folder / "out")
    check(done.returncode == 2 and "rough is in the way" in done.stderr, f"{done.returncode} {done.stderr}")
    done = run("study", file, "--out", folder / "script", "--engine", "slurm", "--jobs", 2, "--threads", 1)
    check(done.returncode == 0 and "submit.sh" in done.stdout, f"{done.stdout} {done.stderr}")
    check("sbatch" in (folder / "script/submit.sh").read_text(), "submit.sh hands nothing to Slurm")
    # One task of the array, as the queue would start it.
    task = subprocess.run(["bash", folder / "script/study.slurm"], env={**os.environ, "SLURM_ARRAY_TASK_ID": "1", "SLURM_CPUS_PER_TASK": "1"},
                          capture_output=True, text=True)
    check(task.returncode == 0 and (folder / "script/thickness_0.5__rough/report.html").exists(), task.stderr)


def batch(folder):
    file = study(folder)
    other = json.loads((folder / "sphere.json").read_text())
    other["contact"]["friction"] = 0.5
    (folder / "rough.json").write_text(json.dumps(other))
    done = run("batch", folder / "sphere.json", folder / "rough.json", "--out", folder / "out", "--jobs", 2)
    check(done.returncode == 0, f"{done.stdout} {done.stderr}")
    for name in ("report.html", "variants.csv", "sphere/report.html", "rough/report.html"):
        check((folder / "out" / name).exists(), f"the batch left no {name}")


def main():
    for test in (refused, failing, batch, interrupted):
        with Folder() as folder:
            test(folder)
            print(test.__name__, "good")


if __name__ == "__main__":
    main()
