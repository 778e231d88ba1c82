#!/usr/bin/env python3
"""Runs whose steps are made on a device: what they leave, what goes on from what, and what is said where something fails.

    device.py [GAMBESON]

Faults are provoked (GAMBESON_FAULT=FAULT[@STEP[@FOLDER]], gpu/device/fault_switch.hpp), so that the reference shows them without
a GPU. Where there is one, cuda and reference are compared and go on from each other.
"""

import json
import os
import select
import shlex
import signal
import subprocess
import time

from common import HERE, Folder, check, command, results, run, run_case, same_results
from study import children, killed, state

CASE = HERE / "sphere.json"
SHORT = ("--threads", 1, "--set", "time.duration=60 ms", "--set", "output.pictures=[]")  # some 240 steps, 72 from checkpoint to checkpoint
ON = ("--device", "reference")
PATIENCE_S = 300  # on a machine that is busy otherwise


def with_fault(fault):
    return {"env": {**os.environ, "GAMBESON_FAULT": fault}}


def refused(done, *words):
    check(done.returncode == 2, f"gave {done.returncode} instead of 2: {done.stderr}")
    for word in words:
        check(str(word) in done.stderr, f"the message lacks {word!r}: {done.stderr}")


def facts(folder):
    return json.loads((folder / "run.json").read_text())["device"]


def has_gpu(folder):
    return run("run", CASE, "--out", folder / "try", *SHORT, "--set", "time.duration=1 ms", "--device", "cuda").returncode == 0


def left(folder):
    """What a run says of its device, and how many steps the CPU made."""
    run_case(CASE, folder / "cpu", *SHORT)
    check(facts(folder / "cpu") == {"kind": "cpu"}, f"{facts(folder / 'cpu')}")
    check("steps_on" not in (folder / "cpu/summary.json").read_text(), "steps by the processor are called those of a device")
    run_case(CASE, folder / "one", *SHORT, *ON)
    of = facts(folder / "one")
    check(of["kind"] == "reference" and len(of["kernels"]) == 12 and of["steps"] >= 240, f"{of}")
    check(of["steps_by_cpu"] == sum(of["reasons"].values()), f"{of}")
    check(json.loads((folder / "one/summary.json").read_text())["steps_on"] == "device", "the summary does not say so")
    page = (folder / "one/report.html").read_text()
    for words in ("--device reference", "Steps handed to the CPU", f"of {of['steps']}", of["kernels"]):
        check(words in page, f"the page lacks {words!r}")
    run_case(CASE, folder / "two", "--threads", 2, *SHORT[2:], *ON)
    same_results(folder / "one", folder / "two", "reference, one thread and two")


def goes_on(folder):
    """Checkpoints of a device go on under a device alone, those of the processor under the processor."""
    out = folder / "out"
    for made, other in (((), ON), (ON, ("--device", "cpu")), (ON, ())):
        run_case(CASE, out, *SHORT, *made)
        before = results(out)
        name = "cpu" if other != ON else "reference"
        refused(run("run", CASE, "--out", out, *SHORT, *other, "--resume"), "--device", out,
                "with --device reference or cuda" if made else "with --device cpu", f"--device {name} does not go on")
        check(results(out) == before, "a refused run changed the results")
        run_case(CASE, out, *SHORT, *made, "--resume")
        check(results(out) == before, "a finished run that went on has other results")


def on_the_way(folder):
    """A fault on the way: exit status 1, and the line that is said goes on to the same bits."""
    run_case(CASE, folder / "whole", *SHORT, *ON)
    words = {"device_lost": "the GPU was lost", "out_of_memory": "no memory left", "kernel_limit": "ran into its limit"}
    for fault, said in words.items():
        out = folder / f"cut by {fault}"
        done = run("run", CASE, "--out", out, *SHORT, *ON, **with_fault(f"{fault}@150"))
        check(done.returncode == 1 and said in done.stderr and "last checkpoint are in" in done.stderr, f"{done.returncode}: {done.stderr}")
        check(len(list(out.glob("frames/segment_*.h5"))) == 3, "not the segments up to the last checkpoint are left")
        check(not (out / "report.html").exists(), "a run that failed has a page")
        line = next(text for text in done.stderr.splitlines() if text.startswith("To go on"))
        resumed = shlex.split(line.split(": ", 1)[1])
        check(resumed[0] == "gambeson" and "--resume" in resumed, line)
        again = run(*resumed[1:])
        check(again.returncode == 0, again.stderr)
        same_results(folder / "whole", out, f"gone on after {fault}")
    # The processor's own runs have no device that could fail.
    run_case(CASE, folder / "cpu", *SHORT, **with_fault("device_lost@150"))


def before_anything(folder):
    out = folder / "out"
    words = {"not_built": ("built without CUDA", "-DGAMBESON_CUDA=ON", "reference"), "no_driver": ("no driver", "nvidia-smi"),
             "old_driver": ("older than this program's CUDA", "newer driver"), "no_device": ("finds no GPU", "CUDA_VISIBLE_DEVICES"),
             "old_device": ("too old", "8.0")}
    for fault, said in words.items():
        for device in ("reference", "cuda"):
            refused(run("run", CASE, "--out", out, *SHORT, "--device", device, **with_fault(fault)), "command line: --device", f'"{device}"', *said)
            check(not out.exists(), f"{fault} left a folder")
    run_case(CASE, out, *SHORT)
    before = results(out)
    refused(run("run", CASE, "--out", out, *SHORT, *ON, **with_fault("little_memory")), "--device", "too little free memory", "needed", "free of", "halve")
    check(results(out) == before, "a refused run changed the results")
    # What is not carried, by file, line and key; of structures the kind.
    case = (HERE / "sphere.json").read_text().replace('"max_step"', '\n "scheme": "rk4", "max_step"')
    (folder / "rk4.json").write_text(case)
    refused(run("run", folder / "rk4.json", "--out", folder / "rk4", *ON), "rk4.json:19: time.scheme", "--device reference")
    check(not (folder / "rk4").exists(), "a refused run left a folder")
    library = HERE.parents[1] / "cases/library"
    refused(run("run", library / "cantilever.json", "--out", folder / "structure", *ON), "cantilever.json:", "kind", "structures")
    if not has_gpu(folder):
        refused(run("run", CASE, "--out", folder / "none", *SHORT, "--device", "cuda"), '--device: "cuda"')
    nonsense = run("run", CASE, "--out", folder / "none", *SHORT, *ON, **with_fault("gremlins"))
    check(nonsense.returncode == 1 and "gremlins" in nonsense.stderr, nonsense.stderr)


def let_go(folder):
    """Supports that let go change the model: steps are made anew there, and the counts go on."""
    case = json.loads(CASE.read_text())
    case["supports"][0]["fixed"]["release"] = "20 ms"
    (folder / "release.json").write_text(json.dumps(case))
    run_case(folder / "release.json", folder / "whole", *SHORT, *ON)
    held = facts(folder / "whole")
    done = run("run", folder / "release.json", "--out", folder / "cut", *SHORT, *ON, **with_fault("device_lost@150"))
    check(done.returncode == 1, f"{done.returncode}: {done.stderr}")
    run_case(folder / "release.json", folder / "cut", *SHORT, *ON, "--resume")
    same_results(folder / "whole", folder / "cut", "gone on after supports have let go")
    check(held["steps"] >= 240, f"steps before the supports let go are not counted: {held}")
    check(facts(folder / "cut")["steps"] < held["steps"], "a resumed run counts what another did")


def study_of(folder, duration, pictures=()):
    case = json.loads(CASE.read_text())
    case["time"]["duration"] = duration
    case["output"]["pictures"] = list(pictures)
    (folder / "sphere.json").write_text(json.dumps(case))
    (folder / "a.study.json").write_text(json.dumps({
        "name": "thin and thick", "case": "sphere.json",
        "axes": [{"path": "factors.thickness", "values": [0.5, 1]}]}))
    return case, folder / "a.study.json"


def stopped_study(folder):
    """The process that makes the runs ends with its study, however that ends; --resume goes on to the same bits."""
    _, study = study_of(folder, "0.18 s")
    words = ("--jobs", 2, "--threads", 2, *ON)
    whole = run("study", study, "--out", folder / "whole", *words)
    check(whole.returncode == 0, f"{whole.stdout} {whole.stderr}")
    out, checkpoints = folder / "cut", 0
    for signal_to_send in (signal.SIGKILL, signal.SIGINT):
        process = subprocess.Popen(command("study", study, "--out", out, "--resume", *words), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while len(list(out.glob("*/frames/segment_*.h5"))) < checkpoints + 4 and process.poll() is None:
            check(time.monotonic() < deadline, "no checkpoint came")
            time.sleep(0.01)
        check(process.poll() is None, "the study was over before it was stopped")
        process.send_signal(signal_to_send)
        code = process.wait(30)
        check(code == (1 if signal_to_send == signal.SIGINT else -signal.SIGKILL), f"a stopped study gave {code}")
        time.sleep(0.2)  # its process dies with it
        checkpoints = len(list(out.glob("*/frames/segment_*.h5")))
    last = run("study", study, "--out", out, "--resume", *words)
    check(last.returncode == 0, f"{last.stdout} {last.stderr}")
    for variant in ("thickness_0.5", "thickness_1"):
        same_results(folder / "whole" / variant, out / variant, f"{variant} of a study that was stopped twice")
    check(not any((out / name).exists() for name in (".together.json", ".together.ended")), "what study and process told each other is left")


def page_of(study, variant):
    """The process that makes the results of a variant, stopped; nothing is written by it from then on."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        check(study.poll() is None and time.monotonic() < deadline, "no process came that makes the results")
        for pid in children(study.pid):
            try:
                words = open(f"/proc/{pid}/cmdline").read().split("\0")
            except OSError:
                continue
            if words[1:2] == ["results"] and words[2].endswith(variant):
                os.kill(pid, signal.SIGSTOP)
                return pid
        time.sleep(0.002)


def pages(folder):
    """Results of variants are made side by side, by processes of their own: as a run makes them, whatever becomes of one of them."""
    _, study = study_of(folder, "60 ms", [{"time": "end", "width": 160, "height": 120}])
    words = ("--jobs", 2, "--threads", 2, *ON)
    out = folder / "out"

    def begun():
        return subprocess.Popen(command("study", study, "--out", out, "--resume", *words), stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    # One that stands still keeps none of the others, and is no orphan when the study ends.
    process = begun()
    page = page_of(process, "thickness_1")
    told = select.select([process.stdout], [], [], PATIENCE_S)[0]
    check(told and process.stdout.readline().startswith("done    thickness_0.5 "), "the results of one variant wait for those of another")
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=PATIENCE_S)[0]
    check(process.returncode == 1 and "stopped by a signal" in said, f"{process.returncode}: {said}")
    check(state(page) == "Z", "a process that makes results outlived its study")
    check(not (out / "thickness_1/report.html").exists(), "a process that stood still has made a page")
    # One that is killed, and one that fails, name their run; the other is not made again.
    in_the_way = out / "thickness_1/report.html"
    for why in ("ended by signal 9", "report.html"):
        process = begun()
        page = page_of(process, "thickness_1")
        if why == "report.html":
            in_the_way.mkdir()
            os.kill(page, signal.SIGCONT)
        else:
            check(killed(page), "the process that makes the results had ended")
        said = process.communicate(timeout=PATIENCE_S)[0]
        check(process.returncode == 1 and "1 of 2 variants are done already" in said, f"{process.returncode}: {said}")
        check(any(line.startswith("FAILED  thickness_1 ") and why in line for line in said.splitlines()), said)
    in_the_way.rmdir()
    last = run("study", study, "--out", out, "--resume", *words)
    check(last.returncode == 0 and "1 of 2 variants are done already" in last.stdout, f"{last.stdout} {last.stderr}")
    for variant in ("thickness_0.5", "thickness_1"):
        check((out / f"logs/{variant}.log").read_text().endswith(f"Report: {out / variant / 'report.html'}\n"), "the log does not name the page")
        run_case(out / f"cases/{variant}.json", folder / variant, "--threads", 1, *ON)
        same_results(folder / variant, out / variant, f"{variant}, alone and in a study")
        again = run("report", out / variant, "-o", folder / "again.html")
        check(again.returncode == 0 and (folder / "again.html").read_bytes() == (out / variant / "report.html").read_bytes(), f"{variant} has another page")


def studied(folder):
    case, study = study_of(folder, "60 ms")
    words = ("--jobs", 2, "--threads", 2, *ON)
    whole = run("study", study, "--out", folder / "whole", *words)
    check(whole.returncode == 0, f"{whole.stdout} {whole.stderr}")
    done = run("study", study, "--out", folder / "cut", *words, **with_fault("device_lost@150@thickness_1"))
    check(done.returncode == 1 and "FAILED  thickness_1 " in done.stdout and "done    thickness_0.5 " in done.stdout and "the GPU was lost" in done.stdout,
          f"{done.stdout} {done.stderr}")
    done = run("study", study, "--out", folder / "cut", "--resume", "--device", "cpu")
    refused(done, "--device", "reference or cuda", "cpu")
    done = run("study", study, "--out", folder / "cut", "--resume", *words)
    check(done.returncode == 0 and "1 of 2 variants are done already" in done.stdout, f"{done.stdout} {done.stderr}")
    for variant in ("thickness_0.5", "thickness_1"):
        check(facts(folder / "whole" / variant)["kind"] == "reference", "a variant ran elsewhere")
        same_results(folder / "whole" / variant, folder / "cut" / variant, variant)
    refused(run("study", study, "--out", folder / "none", *words, **with_fault("no_driver")), "--device")
    check(not (folder / "none").exists(), "a study that is refused left a folder")
    (folder / "sphere.json").write_text(json.dumps({**case, "time": {"duration": "60 ms", "audit": True}}))
    refused(run("study", study, "--out", folder / "none", *words), "time.audit", "--device reference")
    refused(run("batch", folder / "sphere.json", "--out", folder / "none", *words), "time.audit", "--device reference")
    (folder / "sphere.json").write_text(json.dumps(case))
    for device, asks in (("cuda", True), ("cpu", False)):
        done = run("study", study, "--out", folder / device, "--engine", "slurm", "--device", device)
        script = (folder / device / "study.slurm").read_text()
        check(done.returncode == 0 and f"--device {device} " in script and ("#SBATCH --gres=gpu:1" in script) == asks, script)


def on_a_gpu(folder):
    if not has_gpu(folder):
        print("no GPU: cuda was not compared with reference")
        return
    run_case(CASE, folder / "reference", *SHORT, *ON)
    run_case(CASE, folder / "cuda", *SHORT, "--device", "cuda")
    same_results(folder / "reference", folder / "cuda", "reference and cuda")
    of = facts(folder / "cuda")
    check(of["kind"] == "cuda" and of["gpu"] and "CUDA" in of["driver"] and "CUDA" in of["runtime"], f"{of}")
    for first, then in (("cuda", "reference"), ("reference", "cuda")):
        out = folder / f"{first}_{then}"
        check(run("run", CASE, "--out", out, *SHORT, "--device", first, **with_fault("device_lost@150")).returncode == 1, "it did not fail")
        run_case(CASE, out, *SHORT, "--device", then, "--resume")
        same_results(folder / "reference", out, f"{first}, gone on under {then}")
    note = run("run", CASE, "--out", folder / "auto", *SHORT).stderr
    check("has a GPU" in note and "--device cuda" in note, note)
    check(facts(folder / "auto") == {"kind": "cpu"}, "auto is not the processor")


def main():
    for test in (left, goes_on, on_the_way, before_anything, let_go, studied, stopped_study, pages, on_a_gpu):
        with Folder() as folder:
            test(folder)
            print(test.__name__, "good")


if __name__ == "__main__":
    main()
