#!/usr/bin/env python3
"""Every case of the library, to its end, passes the checks that its run makes of itself.

    library.py GAMBESON [CASE...]            these, or all
    library.py GAMBESON --threads [CASE...]  with one thread and with two: the same bits
    library.py GAMBESON --study FILE         so does every variant of a study of the library
"""

import json
import sys

from common import SOURCE, UNTOUCHED, Folder, check, run, run_case, summary
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


def unmet_of(checks):
    return [f"{c['check']} {c['value']:.3g} {c['unit']} (allowed {c['limit']:.3g})" for c in checks if not c["holds"]]


def study(name):
    with Folder() as folder:
        done = run("study", SOURCE / "cases/library" / name, "--out", folder / "out")
        check(done.returncode == 0, f"{name} gave {done.returncode}: {done.stderr}")
        variants = sorted((folder / "out").glob("*/summary.json"))
        unmet = {file.parent.name: unmet_of(json.loads(file.read_text())["audit"]) for file in variants}
        check(variants and not any(unmet.values()), f"{name}: {unmet}")
        print(f"{name}: all checks of {len(variants)} variants hold")


def main():
    if "--study" in sys.argv:
        return study(sys.argv[-1])
    threads = "--threads" in sys.argv
    wanted = [name for name in sys.argv[2:] if name != "--threads"]
    cases = [c for c in library() if not wanted or c[0].stem in wanted]
    check(len(cases) == len(wanted) or not wanted, f"not all of {wanted} are cases of the library")
    failures = []
    for file, case in cases:
        try:
            numbers = numbers_of(file, case, threads)
            checks = numbers["checks" if "kind" in case else "audit"]
            unmet = unmet_of(checks)
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
