#!/usr/bin/env python3
"""The same bits for one thread and for two (and for two again).

    threads.py [GAMBESON] CASE...
"""

import sys

from common import HERE, Folder, run_case, same_results


def main():
    for name in sys.argv[2:]:
        with Folder() as folder:
            for out, threads in (("one", 1), ("two", 2)):
                run_case(HERE / name, folder / out, "--threads", threads)
            same_results(folder / "one", folder / "two", f"{name}, 1 and 2 threads")


if __name__ == "__main__":
    main()
