#!/usr/bin/env python3
"""The same bits for one thread and for two: recording, checkpoints, tables, pictures, summary.

    threads.py GAMBESON CASE...       these cases of the folder of the tests
"""

import sys

from common import HERE, Folder, check, run_case, same_results, summary


def same(case, *options, touches=False):
    with Folder() as folder:
        for out, threads in (("one", 1), ("two", 2)):
            run_case(case, folder / out, "--threads", threads, *options)
        numbers = summary(folder / "one")
        contacts = numbers.get("collisions", {}).get("most_contacts", 0)
        same_results(folder / "one", folder / "two", f"{case.stem}, {contacts} contacts, 1 and 2 threads")
        check(contacts > 0 or not touches, f"{case.stem}: nothing touches, so nothing is shown")
        return numbers


if __name__ == "__main__":
    for name in sys.argv[2:]:
        same(HERE / name)
