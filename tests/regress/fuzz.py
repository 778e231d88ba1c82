#!/usr/bin/env python3
"""Mutated inputs of every kind through the binary: no signal, no hang, no message as long as the file, no memory without
bounds, and nothing that `check` accepts and `run` refuses as input.

    fuzz.py [GAMBESON] [--count N] [--seed S] [--kinds a,b] [--state DIR] [--seconds T] [--warm WARM_COMMAND]

Mutation i of a kind is the same wherever it is made (seed, kind and i are all that it depends on; where the command under test makes
the files itself, what it makes too). With --state the
counts and the broken files of faults are kept in DIR, and a later call goes on where this one ended. --seconds ends it
after so long. --warm splits the calls off a program that has started already (tests/tools/warm_command.cpp), which for readers of
foreign formats is some ten times as fast; what it finds wrong is asked of the command itself again. Prints how many of each kind were accepted, refused and answered wrongly; exit 1 where any was.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from common import binary
from fuzz_seeds import kinds

LONGEST_S = 20  # of the processor
LARGEST_MB = 1024
LONGEST_MESSAGE = 400
RUN_ONE_IN = 4  # of what `check` accepts and is cheap to run
#: Numbers, words and signs that files are made of, or break on.
PIECES = ["0", "-1", "1e999", "-1e300", "1e-320", "nan", "inf", "4294967296", "2147483648", "-0", "0.5.5", '"', "'", "{", "}", "[", "]", "<", ">", "/>",
          ",", ":", "null", "true", "\n", "\r", "\t", "\xff", "\xc3", "<!--", "]]>", "&lt;", "é", "/", "#", "\\u0000", "\\", "%s%n", " m", " kg", "deg",
          "1", "2", "3", "7", "64", "200", "1000", "8192", "1e6", "1e-6", "0.999999", "1e9", "..", "\0", "mm", "xyz", "u0", "0.u1", "thigh_left"]
NUMBERS = [p for p in PIECES if re.fullmatch(r"-?[0-9.]+(e-?[0-9]+)?|nan|inf", p)] + ["4", "5", "8", "0.5", "16", "100", "1e300", "1e-300", "-1e-9"]
NUMBER = re.compile(rb"[0-9][0-9.eE+-]*")
WORD = re.compile(rb"[A-Za-z_]{3,}")


def mutated(text, other, chance):
    """One to three changes of bytes: bits, parts cut, doubled or taken from elsewhere, numbers and words replaced."""
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        if not text:
            return text
        at = chance.randrange(len(text))
        length = 1 + chance.randrange(min(60, len(text) - at))
        piece = chance.choice(PIECES).encode("latin-1" if chance.random() < 0.5 else "utf-8", "replace")
        kind = chance.randrange(20)
        if kind == 0:
            text = text[:at] + bytes([text[at] ^ 1 << chance.randrange(8)]) + text[at + 1:]
        elif kind == 1:
            text = text[:at] + text[at + length:]
        elif kind == 2:
            text = text[:at] + text[at:at + length] * chance.choice([2, 2, 3, 200]) + text[at + length:]
        elif kind == 3:
            text = text[:at] + piece + text[at:]
        elif kind == 4:
            text = text[:at]
        elif kind == 5:
            start = chance.randrange(len(other))
            text = text[:at] + other[start:start + length] + text[at + length:]
        elif kind == 6:
            words = WORD.findall(other)  # none in files of numbers
            if words and (found := WORD.search(text, at)):
                text = text[:found.start()] + chance.choice(words) + text[found.end():]
        elif found := NUMBER.search(text, at):  # mostly numbers: they get past the syntax
            old = found.group()
            new = chance.choice(NUMBERS).encode()
            if chance.random() < 0.7:
                try:
                    new = repr(float(old) * chance.choice([-1, 0.1, 10, 1e3, 1e-3, 1.01, 1.3, 0.7, 1e6, 1e-6, 2, 0.5])).encode()
                except ValueError:
                    pass
            text = text[:found.start()] + new + text[found.end():]
    return text


class Answer:
    def __init__(self, status, out, cpu_s, wall_s, mb, in_time):
        self.status, self.out, self.cpu_s, self.wall_s, self.mb, self.in_time = status, out, cpu_s, wall_s, mb, in_time


def call(arguments, folder, longest_s):
    """Runs the command on one thread; what it used counts its own children too."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive")
    with tempfile.TemporaryFile() as err:
        start = time.monotonic()
        process = subprocess.Popen([binary(), *arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=err,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (longest_s, longest_s + 5)))
        in_time = True
        while True:
            pid, raw, used = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > 15 * longest_s:  # much of it may be other work's
                in_time = False
                process.kill()
                _, raw, used = os.wait4(process.pid, 0)
                break
            time.sleep(0.003)
        process.returncode = os.waitstatus_to_exitcode(raw)
        err.seek(0)
        text = err.read().decode("utf-8", "replace")
    return Answer(process.returncode, text, used.ru_utime + used.ru_stime, time.monotonic() - start, used.ru_maxrss / 1024, in_time)


class Warm:
    """Calls through warm_command, which has read the files of CAD programs that the kinds have."""

    def __init__(self, program, seeds):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="gambeson_warm_"))
        files = []
        for name, content in seeds.items():
            (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
            files.append(self.folder / name)
        environment = dict(os.environ, OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive")
        self.process = subprocess.Popen([program, *files], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True, errors="replace")

    def __call__(self, arguments, folder, longest_s):
        start = time.monotonic()
        err = self.folder / "stderr"
        self.process.stdin.write("\t".join(map(str, [folder, err, longest_s, 15 * longest_s, *arguments])) + "\n")
        self.process.stdin.flush()
        # OpenCASCADE prints to standard output as it reads what warms it.
        while not re.fullmatch(r"-?\d+ [0-9.e+-]+ \d+ [01]", line := self.process.stdout.readline().strip()):
            if self.process.poll() is not None:
                sys.exit("warm_command has ended")
        status, cpu_s, kilobytes, in_time = line.split()
        return Answer(int(status), err.read_text("utf-8", "replace"), float(cpu_s), time.monotonic() - start, int(kilobytes) / 1024, in_time == "1")

    def end(self):
        self.process.stdin.close()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


def wrong(answer, longest_s):
    """What is wrong with any answer, or None."""
    if not answer.in_time:
        return "hangs"
    if answer.status == -24 or answer.cpu_s > longest_s:
        return f"takes more than {longest_s} s"
    if answer.status not in (0, 1, 2):
        return f"ends with {answer.status}"
    if re.search(r"Sanitizer|runtime error:|terminate called|Assertion", answer.out):
        return "wakes a check of the machine's"
    if re.search(r"_M_|std::|\b(vector|map|basic_string|array|stoi|stod)::", answer.out):
        return "speaks of the program's own matters"
    if answer.mb > LARGEST_MB:
        return f"takes {answer.mb:.0f} MB"
    if answer.status == 2 and not answer.out.strip():
        return "says nothing"
    longest = max(map(len, answer.out.splitlines()), default=0)
    if longest > LONGEST_MESSAGE:
        return f"says {longest} characters in a line"
    return None


def one(kind, number, seed, keep, call=call):
    """Mutation `number` of a kind: what became of it, and what was wrong or None."""
    chance = random.Random(f"{seed} {kind.name} {number}")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="gambeson_fuzz_"))
    try:
        for name, content in kind.files.items():
            data = content if isinstance(content, bytes) else content.encode()
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            broken = name == kind.broken and number >= 0
            (folder / name).write_bytes(data if not broken else kind.spoil(data, chance) if kind.spoil else mutated(data, data, chance))
        answer = call(kind.command, folder, LONGEST_S)
        if kind.command[0] == "batch" and answer.cpu_s > LONGEST_S:  # a run may take its time, what comes before it not
            answer = call(["check", kind.main], folder, LONGEST_S)
        fault, what = wrong(answer, LONGEST_S), "accepted" if answer.status == 0 else "refused"
        if answer.status == 1 and kind.command[0] == "check" and not fault:
            what = "not built"
        if not fault and answer.status == 0 and kind.run and chance.randrange(RUN_ONE_IN) == 0:
            what = "run"
            answer = call(["run", kind.main, "--out", "out", "--threads", "1"], folder, LONGEST_S)
            if answer.status == 2:
                fault = "is accepted by check, refused by run"
            elif answer.status not in (-24, -9) and answer.in_time:  # a run may take its time
                fault = wrong(answer, float("inf"))
                fault = fault and "as a run " + fault
        if fault and keep:
            kept = keep / f"{kind.name}_{number}"
            shutil.rmtree(kept, ignore_errors=True)
            shutil.copytree(folder, kept)
            (kept / "answer.txt").write_text(f"{fault}\n{answer.status} {answer.cpu_s:.1f} s {answer.mb:.0f} MB\n{answer.out[:2000]}")
        if fault:
            print(f"{kind.name} {number}: {fault}\n    {answer.out.strip()[:300]}", flush=True)
        return what, fault
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def keep(folder, state):
    unfinished = folder / "state.json.tmp"
    unfinished.write_text(json.dumps(state, indent=1))
    unfinished.replace(folder / "state.json")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gambeson", nargs="?")
    parser.add_argument("--count", type=int, default=240, help="mutations in all, shared by the kinds")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default="")
    parser.add_argument("--state", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--warm", type=pathlib.Path)
    options = parser.parse_args()
    chosen = [k for k in kinds() if not options.kinds or k.name in options.kinds.split(",")]
    if options.count < len(chosen):  # one of each of as many kinds, spread over all
        chosen = [chosen[i * len(chosen) // options.count] for i in range(options.count)]
    state = {"done": 0, "counts": {}, "faults": []}
    if options.state:
        options.state.mkdir(parents=True, exist_ok=True)
        if (options.state / "state.json").exists():
            state = json.loads((options.state / "state.json").read_text())
    if state["done"] == 0:
        for kind in chosen:
            what, fault = one(kind, -1, options.seed, None)
            if what == "refused" or fault:
                sys.exit(f"the unbroken files of {kind.name} are not accepted")
    caller = call
    if options.warm:
        caller = Warm(options.warm.resolve(), {k.name + "_" + k.broken: k.files[k.broken] for k in chosen
                                               if k.command[0] == "import" and k.broken.endswith((".step", ".igs", ".brep"))})
    start = time.monotonic()
    while state["done"] < options.count and time.monotonic() - start < options.seconds:
        kind, number = chosen[state["done"] % len(chosen)], state["done"] // len(chosen)
        what, fault = one(kind, number, options.seed, options.state, caller)
        if fault and options.warm:
            what, fault = one(kind, number, options.seed, options.state)
        counts = state["counts"].setdefault(kind.name, collections.Counter())
        counts[what] = counts.get(what, 0) + 1
        if fault:
            counts["wrong"] = counts.get("wrong", 0) + 1
            state["faults"].append(f"{kind.name} {number}: {fault}")
        state["done"] += 1
        if options.state and (state["done"] % 50 == 0 or fault):
            keep(options.state, state)
    if options.state:
        keep(options.state, state)
    if options.warm:
        caller.end()
    words = ["accepted", "run", "refused", "not built", "wrong"]
    print(f"{'kind':16}" + "".join(f"{w:>11}" for w in words))
    for name, counts in state["counts"].items():
        print(f"{name:16}" + "".join(f"{counts.get(w, 0):11}" for w in words))
    print(f"{state['done']} mutations, {len(state['faults'])} answered wrongly")
    return 1 if state["faults"] else 0


if __name__ == "__main__":
    sys.exit(main())
