#!/usr/bin/env python3
"""The same bits for one thread and for two: recording, checkpoints, tables, pictures, summary.

    threads.py GAMBESON CASE...       these cases of the folder of the tests
    threads.py GAMBESON --library [CASE...]   every case of the library, or these; long ones end early, once something has touched
"""

import json
import sys

from common import HERE, SOURCE, UNTOUCHED, Folder, check, run_case, same_results, summary

# Where less than the whole case shows contact.
UNTIL = {"sphere_drape": "0.4 s", "stack_of_ten": "0.1 s", "stack_mixed": "0.1 s", "flag": "1.5 s", "pedestal_soft": "1.2 s",
         "vertical_drape": "0.3 s", "ring_pull": "0.3 s", "inclined_plane": "0.4 s"}


def library():
    for file in sorted((SOURCE / "cases/library").glob("*.json")):
        case = json.loads(file.read_text())
        if "kind" in case or "fabric" in case or "garments" in case:
            yield file


def same(case, *options, touches=False):
    with Folder() as folder:
        for out, threads in (("one", 1), ("two", 2)):
            run_case(case, folder / out, "--threads", threads, *options)
        contacts = summary(folder / "one").get("collisions", {}).get("most_contacts", 0)
        same_results(folder / "one", folder / "two", f"{case.stem}, {contacts} contacts, 1 and 2 threads")
        check(contacts > 0 or not touches, f"{case.stem}: nothing touches, so nothing is shown")


def main():
    if sys.argv[2:3] != ["--library"]:
        for name in sys.argv[2:]:
            same(HERE / name)
        return
    failures = []
    wanted = sys.argv[3:]
    cases = [c for c in library() if not wanted or c.stem in wanted]
    check(len(cases) == len(wanted) or not wanted, f"not all of {wanted} are cases of the library")
    for case in cases:
        options = []
        if case.stem in UNTIL:  # pictures may be later than that
            options = ["--set", f"time.duration={UNTIL[case.stem]}", "--set", 'output.pictures=[{"time": "end"}]']
        try:
            same(case, *options, touches=case.stem not in UNTOUCHED and "kind" not in json.loads(case.read_text()))
        except AssertionError as e:
            print(f"FAILED {case.stem}: {e}", flush=True)
            failures.append(case.stem)
        sys.stdout.flush()
    check(not failures, f"these cases fail: {failures}")


if __name__ == "__main__":
    main()
