#!/usr/bin/env python3
"""Every case of the library, to its end, passes the checks that its run makes of itself.

    library.py GAMBESON [CASE...]           these, or all
    library.py GAMBESON --threads [CASE...]  with one thread and with two: the same bits
"""

import json
import sys

from common import SOURCE, UNTOUCHED, Folder, check, run_case, summary
from threads import same

#: Examples of the thesis that stretch cloth beyond the range of its own law: their pages have to say so.
STRETCHED = {"corner_cloth_soft", "corner_cloth_stiff", "trimmed_sheet"}


def library():
    for file in sorted((SOURCE / "cases/library").glob("*.json")):
        case = json.loads(file.read_text())
        if "kind" in case or "fabric" in case or "garments" in case:
            yield file, case


def numbers_of(file, case, threads):
    if threads:
        return same(file, touches=file.stem not in UNTOUCHED and "kind" not in case)
    with Folder() as folder:
        run_case(file, folder / "out", "--set", "output.pictures=[]", "--threads", 1)
        return summary(folder / "out")


def main():
    threads = "--threads" in sys.argv
    wanted = [name for name in sys.argv[2:] if name != "--threads"]
    cases = [c for c in library() if not wanted or c[0].stem in wanted]
    check(len(cases) == len(wanted) or not wanted, f"not all of {wanted} are cases of the library")
    failures = []
    for file, case in cases:
        try:
            numbers = numbers_of(file, case, threads)
            checks = numbers["checks" if "kind" in case else "audit"]
            unmet = [f"{c['check']} {c['value']:.3g} {c['unit']} (allowed {c['limit']:.3g})" for c in checks if not c["holds"]]
            if file.stem in STRETCHED:
                check(any(c["check"] == "Strain" and not c["holds"] for c in checks), "its strain is within the law's range")
                unmet = [u for u in unmet if not u.startswith("Strain ")]
            check(checks and not unmet, "; ".join(unmet) or "no checks")
            print(f"{file.stem}: {len(checks) - (file.stem in STRETCHED)} checks hold", flush=True)
        except AssertionError as e:
            print(f"FAILED {file.stem}: {e}", flush=True)
            failures.append(file.stem)
    check(not failures, f"these cases fail: {failures}")


if __name__ == "__main__":
    main()
