#!/usr/bin/env python3
"""Studies and batches by a real Slurm of one node: whatever becomes of their jobs, they leave the bytes of --engine local.

    slurm.py [GAMBESON] [--kills N] [--only KIND]    each kind N times: scancel, requeue, loss (of the node); 1 where N is not given

Skipped where slurm-wlm or munge is not installed, and for others than root. The N moments are spread over the study by
how many of all checkpoints of its variants are on the disk.
"""

import csv
import json
import random
import shutil
import sys
import time

import population
from common import HERE, SKIPPED, SOURCE, Folder, check, run
from slurm_node import SlurmNode, missing
from study import contents

QUEUE = ["--time", "0:10:00", "--mem", "300M", "--partition", "short", "--job-name", "spheres"]


def study(folder):
    """Three variants on two processors: one waits while two run."""
    case = json.loads((HERE / "sphere.json").read_text())
    case["time"]["duration"] = "0.3 s"
    case["output"]["pictures"] = []
    (folder / "sphere.json").write_text(json.dumps(case))
    file = folder / "a.study.json"
    file.write_text(json.dumps({"name": "thin, usual and thick", "case": "sphere.json", "pictures": [{"time": "end", "width": 200, "height": 160}],
                                "axes": [{"path": "factors.thickness", "values": [0.5, 1, 1.5]}]}))
    return file


def differing(whole, out):
    cut = contents(out)
    check(whole.keys() == cut.keys(), f"other files: {sorted(whole.keys() ^ cut.keys())}")
    return [name for name in whole if whole[name] != cut[name]]


def written(*arguments):
    done = run(*arguments, "--engine", "slurm")
    check(done.returncode == 0 and "submit.sh" in done.stdout, f"{done.returncode} {done.stdout} {done.stderr}")


def submitted(node, out):
    """The job of the runs and that which compares."""
    words = node.asked("bash", out / "submit.sh").replace(";", "").split()
    return words[4], words[6]


def ended(node, limit_s=240):
    """Once nothing waits or runs."""
    deadline = time.monotonic() + limit_s
    while node.jobs():
        check(time.monotonic() < deadline, f"jobs do not end: {node.jobs()}\n{node.asked('scontrol', 'show', 'job')}\n{node.logs()}")
        time.sleep(0.3)


def segments(out):
    """Checkpoints by variant, in the order of the array."""
    return {file.stem: len(list((out / file.stem).glob("frames/segment_*.h5"))) for file in sorted((out / "cases").glob("*.json"))}


def in_the_middle(node, out, job, part):
    """Waits until that part of all checkpoints is there; those that run."""
    wanted = part * node.checkpoints * len(segments(out))
    deadline = time.monotonic() + 240
    while sum(segments(out).values()) < wanted:
        check(time.monotonic() < deadline, f"waited for {wanted:.0f} checkpoints: {segments(out)}\n{node.logs()}")
        time.sleep(0.02)
    running = []
    while not running:
        jobs = [j for j in node.jobs() if j[0] == job]
        check(jobs, f"all had ended at {segments(out)}")
        running = [j for j in jobs if j[2] == "RUNNING"]
    return running


def went_on(out, before):
    """That runs with checkpoints were not done again from the beginning: each says so itself."""
    for variant, count in before.items():
        facts = json.loads((out / variant / "run.json").read_text())
        check(facts["resumed"] or count == 0, f"{variant} had {count} checkpoints and began again")


def half_done(node, out):
    """Checkpoints of variants that are not about to end; 0 of the others."""
    return {v: n if n < node.checkpoints - 2 and not (out / v / "run.json").exists() else 0 for v, n in segments(out).items()}


def scancel(node, file, out, part, k):
    """Cancelled, and handed in again: the same scripts, or new ones of what is left."""
    job, compares = submitted(node, out)
    in_the_middle(node, out, job, part)
    node.asked("scancel", job)
    ended(node)
    before, reached = half_done(node, out), sum(segments(out).values())
    rows = list(csv.DictReader((out / "variants.csv").open()))  # afterany: of what there was
    check(any(r["status"] == "failed" for r in rows), f"nothing was cancelled in the middle: {rows}")
    check("FAILED" in (out / "compare.log").read_text(), "the log does not say what is not done")
    if k % 2 == 0:
        written("study", file, "--out", out, "--resume", *QUEUE)
    submitted(node, out)
    ended(node)
    went_on(out, before)
    return reached


def requeue(node, file, out, part, k):
    """One job of those that run, or all that run, or whatever the array has."""
    job, compares = submitted(node, out)
    running = in_the_middle(node, out, job, part)
    if k % 3 == 0:
        running = running[:1]
    names, counts = list(segments(out)), half_done(node, out)
    before = {names[int(i)]: counts[names[int(i)]] for _, i, _ in running}
    which = [job] if k % 3 == 2 else [f"{j}_{i}" for j, i, _ in running]
    reached = sum(segments(out).values())
    hit = [node.run("scontrol", "requeue", one).returncode == 0 for one in which]  # it may just have ended
    # Of a whole array those that wait are refused, and the others put back.
    check(any(hit) or k % 3 == 2 and not set(running) <= set(node.jobs()), f"nothing was put back at {reached} checkpoints: {which} {node.jobs()}")
    ended(node)
    went_on(out, before)
    return reached


def loss(node, file, out, part, k):
    """The node dies with all that runs on it. It comes back after it was given up, or before that is noticed."""
    job, compares = submitted(node, out)
    in_the_middle(node, out, job, part)
    check(node.kill_node() > 0, "nothing ran on the node")
    before, reached = half_done(node, out), sum(segments(out).values())
    if k % 2 == 0:
        node.wait(lambda: "down" in node.asked("sinfo", "-h", "-o", "%T"), "the loss to be noticed", 90)
        check(all(state == "PENDING" for _, _, state in node.jobs()), f"{node.jobs()}")
    node.start_node()
    ended(node)
    went_on(out, before)
    return reached


def compared(out, whole):
    check("Report, after" in (out / "compare.log").read_text(), (out / "compare.log").read_text())
    other = differing(whole, out)
    check(not other, f"these differ from those of the local engine: {other}")


def plain(node, file, out, whole):
    """Without anything in the way; and what Slurm was asked for."""
    written("study", file, "--out", out, *QUEUE)
    with (out / "study.slurm").open("a") as script:
        script.write("# a line of the user's\n")
    job, compares = submitted(node, out)
    said = node.asked("scontrol", "show", "job", job) + node.asked("scontrol", "show", "job", compares)
    for word in ("JobName=spheres\n", "JobName=spheres_compare\n", "TimeLimit=00:10:00", "MinMemoryNode=300M", "Partition=short", "Requeue=1",
                 f"Dependency=afterany:{job}_"):
        check(word in said, f"{word} is not in {said}")
    ended(node)
    compared(out, whole)
    (out / "study.slurm").unlink()  # one that was changed is not written over
    done = run("study", file, "--out", out, "--resume", "--engine", "slurm")
    check(done.returncode == 0 and "all variants are done" in done.stdout, f"{done.stdout} {done.stderr}")


def batch(node, folder):
    """A worn sheet and a structure, which starts from the beginning when it is put back."""
    files = [folder / "sphere.json", SOURCE / "cases/library/hinged_roof.json"]
    done = run("batch", *files, "--out", folder / "batch_local", "--jobs", 2, "--threads", 2)
    check(done.returncode == 0, f"{done.stdout} {done.stderr}")
    out = folder / "batch_slurm"
    written("batch", *files, "--out", out, "--time", "10")
    job, compares = submitted(node, out)
    in_the_middle(node, out, job, 0.3)
    node.asked("scontrol", "requeue", f"{job}_0")
    ended(node)
    for name in ("variants.csv", "study.json", "report.html"):
        check((folder / "batch_local" / name).read_bytes() == (out / name).read_bytes(), f"{name} of the batch differs")


def wearers(node, folder):
    """A population: its wearers are the tasks, and the job that compares answers for all."""
    file = population.study(folder)
    done = run("study", file, "--out", folder / "wearers_local", "--jobs", 2, "--threads", 2)
    check(done.returncode == 0, f"{done.stdout} {done.stderr}")
    out = folder / "wearers_slurm"
    written("study", file, "--out", out, "--time", "10")
    submitted(node, out)
    ended(node)
    population.answers(out, 2)
    local, here = population.contents(folder / "wearers_local"), population.contents(out)
    check(local.keys() == here.keys(), f"other files: {sorted(local.keys() ^ here.keys())}")
    other = [name for name in local if local[name] != here[name]]
    check("population.csv" in local and not other, f"these differ from those of the local engine: {other}")


def main():
    lacking = missing()
    if lacking:
        print(f"skipped: there is no {', '.join(lacking)} (apt-get install slurm-wlm munge)")
        sys.exit(SKIPPED)
    options = sys.argv[2:]
    kills = int(options[options.index("--kills") + 1]) if "--kills" in options else 1
    only = options[options.index("--only") + 1] if "--only" in options else None
    chance = random.Random(20130620)
    with Folder() as folder, SlurmNode() as node:
        file = study(folder)
        done = run("study", file, "--out", folder / "local", "--jobs", 2, "--threads", 2)
        check(done.returncode == 0, f"{done.stdout} {done.stderr}")
        whole = contents(folder / "local")
        counts = segments(folder / "local")
        node.checkpoints = min(counts.values())
        check(node.checkpoints == max(counts.values()) > 10, f"other checkpoints than this test counts on: {counts}")
        if only is None:
            plain(node, file, folder / "plain", whole)
            batch(node, folder)
            wearers(node, folder)
            print("plain, batch, wearers of a population: good", flush=True)
        for kind in (scancel, requeue, loss):
            if only not in (None, kind.__name__):
                continue
            reached, begin = [], time.monotonic()
            parts = [0.9 * (k + chance.random()) / kills for k in range(kills)]
            chance.shuffle(parts)
            for k, part in enumerate(parts):
                out = folder / f"{kind.__name__}{k}"
                written("study", file, "--out", out, *QUEUE)
                reached.append(kind(node, file, out, part, k))
                compared(out, whole)
                shutil.rmtree(out)
                print(f"{kind.__name__} {k + 1} of {kills}, at {reached[-1]} checkpoints: the same", flush=True)
            print(f"{kind.__name__}: {kills} times, all ended with the bytes of the local engine; of {sum(counts.values())} checkpoints there "
                  f"were {reached}; {time.monotonic() - begin:.0f} s", flush=True)


if __name__ == "__main__":
    main()
