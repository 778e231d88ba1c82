#!/usr/bin/env python3
"""A run killed (SIGKILL) at random moments and resumed leaves the same bits as one left alone.

    interrupted.py [GAMBESON] CASE [--kills N] [OPTION...]    20 kills where N is not given; options of the run, such as --set

The first dies as soon as it records, before its first checkpoint. The other moments come from a fixed seed and scale with the
time that a whole run takes here: some very early, the others with time to draft the garment again before anything is computed.
A chain of kills and resumptions ends when all is computed; its results are compared, and the next kills begin with a new
run.
"""

import json
import random
import subprocess
import sys

from common import HERE, Folder, check, command, run_case, same_results, summary


def wait_for_recording(process, results):
    """Until the run has begun to record; raises TimeoutExpired as soon as it has."""
    while True:
        try:
            process.wait(0.001)
            return
        except subprocess.TimeoutExpired:
            if (results / "frames").exists():
                raise


def main():
    case, options, kills = HERE / sys.argv[2], sys.argv[3:], 20
    if options[:1] == ["--kills"]:
        kills, options = int(options[1]), options[2:]
    chance = random.Random(20130331)
    with Folder() as folder:
        run_case(case, folder / "whole", "--threads", 1, *options)
        drift = summary(folder / "whole")["energy"]["drift_ratio"]
        check(abs(drift) < 0.01, f"works leave {drift:.1%} of the energy unexplained")
        computing_s = json.loads((folder / "whole/run.json").read_text())["wall_s"]
        segments = lambda name: len(list((folder / name).glob("frames/segment_*.h5")))
        complete = segments("whole")
        reached, chain, stuck = [], 0, 0
        while len(reached) < kills:
            cut = f"cut{chain}"
            delay = chance.uniform(*((0.01, 0.05) if len(reached) < kills / 5 else (0.2, 0.9))) * (0.15 + computing_s) * (1 + stuck / 2)
            process = subprocess.Popen(command("run", case, "--out", folder / cut, "--resume", "--threads", 2, *options),
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                if reached:
                    process.wait(delay)
                else:
                    wait_for_recording(process, folder / cut)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                # Where a busy machine has hardly begun by then, the next one has longer.
                stuck = stuck + 1 if len(reached) > kills / 5 and reached[-1] == segments(cut) else 0
                reached.append(segments(cut))
            errors = process.communicate()[1].decode()
            check(process.returncode in (0, -9), f"resumed run failed: {errors}")
            if segments(cut) == complete or len(reached) == kills:
                run_case(case, folder / cut, "--resume", "--threads", 2, *options)
                same_results(folder / "whole", folder / cut, f"chain {chain}, killed and resumed")
                chain += 1
        check(0 in reached, f"no run died before its first checkpoint: {reached}")
        check(len(set(reached)) >= min(4, kills / 2), f"too few of the kills came between checkpoints: {reached}")
        print(f"{kills} kills, computing takes {computing_s:.1f} s; checkpoints at the kills: {reached}; {chain} runs compared")


if __name__ == "__main__":
    main()
