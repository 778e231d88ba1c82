#!/usr/bin/env python3
"""A run killed (SIGKILL) at 20 random moments and resumed leaves the same bits as one left alone.

    interrupted.py [GAMBESON] CASE

The moments come from a fixed seed and scale with the time that the run takes here. The first are very early, so that
runs die before their first checkpoint too. A kill after the end of the computation hits the writing of the results, or
a resumed run that has nothing left to do.
"""

import random
import subprocess
import sys
import time

from common import HERE, Folder, check, command, run_case, same_results

KILLS = 20


def main():
    case = HERE / sys.argv[2]
    chance = random.Random(20130331)
    with Folder() as folder:
        begin = time.monotonic()
        run_case(case, folder / "whole", "--threads", 1)
        whole_s = time.monotonic() - begin
        segments = lambda: len(list((folder / "cut").glob("frames/segment_*.h5")))
        killed = finished = before_checkpoint = tries = 0
        reached = []
        while killed < KILLS:
            tries += 1
            check(tries < 10 * KILLS, f"only {killed} of {tries} runs lived long enough to be killed")
            delay = chance.uniform(0, 0.02 if killed < 4 else 0.7) * whole_s
            process = subprocess.Popen(command("run", case, "--out", folder / "cut", "--resume", "--threads", 2),
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                process.wait(delay)
            except subprocess.TimeoutExpired:
                process.kill()
                killed += 1
                process.wait()
                before_checkpoint += segments() == 0
                reached.append(segments())
            else:
                check(process.returncode == 0, f"resumed run gave {process.returncode}")
                finished += 1
            errors = process.communicate()[1].decode()
            check(process.returncode in (0, -9), f"resumed run failed: {errors}")
        check(before_checkpoint > 0, "no run died before its first checkpoint")
        check(len(set(reached)) >= 4, f"too few of the kills came between checkpoints: {reached}")
        print(f"{killed} kills of a run of {whole_s:.1f} s, {before_checkpoint} before the first checkpoint, "
              f"{finished} runs came to their end; checkpoints at the kills: {reached}")
        run_case(case, folder / "cut", "--resume", "--threads", 2)
        same_results(folder / "whole", folder / "cut", "killed and resumed")


if __name__ == "__main__":
    main()
