#!/usr/bin/env python3
"""A cell killed (SIGKILL) after each of its loads and resumed leaves the same bits as one left alone.

    interrupted_cell.py GAMBESON CASE    a case of the library
"""

import subprocess
import sys
import time

from common import SOURCE, Folder, check, command, run_case, same_results, summary

OPTIONS = ["--set", "solver.pieces_per_spacing=8", "--set", "output.shapes=none"]


def main():
    case = SOURCE / "cases/library" / sys.argv[2]
    with Folder() as folder:
        run_case(case, folder / "whole", "--threads", 1, *OPTIONS)
        loads = len(summary(folder / "whole")["loads"])
        killed = 0
        for unit in range(loads + 1):
            segment = folder / "cut" / f"frames/segment_{unit:06d}.h5"
            process = subprocess.Popen(command("run", case, "--out", folder / "cut", "--resume", "--threads", 2, *OPTIONS),
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None and not segment.exists():
                time.sleep(0.002)
            killed += process.poll() is None
            process.kill()
            process.wait()
        check(killed > loads / 2, f"only {killed} of {loads + 1} runs were killed before their end")
        run_case(case, folder / "cut", "--resume", "--threads", 2, *OPTIONS)
        same_results(folder / "whole", folder / "cut", f"{case.stem}, killed {killed} times")


if __name__ == "__main__":
    main()
