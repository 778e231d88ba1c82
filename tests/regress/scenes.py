#!/usr/bin/env python3
"""Every scene of the case library without intersections, by exact predicates that are not our own.

    scenes.py GAMBESON CROSSINGS_CHECK [--short] [--csv FILE] [CASE...]

Steps each case to its end and looks at every frame, in scenes below after every step. Fails where cloth passes through
cloth or a body (in a scene that starts tangled: after 0.3 s), where a frame is flagged (samples pinched), where a
sample goes farther than half a cell in a step, or where a run ends early. --short: the scenes of a few seconds.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import time

from common import SOURCE, UNTOUCHED, Folder, check

TANGLED = {"tangle_closed", "tangle_half", "tangle_open", "tangle_sleeve", "nested_tubes"}
PUT_ON_TANGLED = {"armour_projected", "armour_stitched", "armour_tangled"}
FREE_BY_S = {**{name: 0.3 for name in TANGLED}, **{name: 0 for name in PUT_ON_TANGLED}}  # before the motion starts
EVERY_STEP = TANGLED | {"flag", "sphere_drape", "vertical_drape"}
SHORT = ["tangle_half", "tangle_open"]
LONG_FIRST = ["shorts_walk", "sphere_drape", "stack_mixed", "stack_of_ten", "pedestal_soft"]


def scenes():
    """Cases of cloth in contact: those of the library without a kind of their own."""
    found = []
    for file in sorted((SOURCE / "cases/library").glob("*.json")):
        case = json.loads(file.read_text())
        if ("fabric" in case or "garments" in case) and "kind" not in case:
            found.append(file)
    first = {name: k for k, name in enumerate(LONG_FIRST)}
    return sorted(found, key=lambda f: (first.get(f.stem, len(first)), f.stem))


def look(checker, case, folder):
    numbers = folder / f"{case.stem}.json"
    arguments = [checker, str(case), "--numbers", str(numbers), "--name", "1"]
    if case.stem in FREE_BY_S:
        arguments += ["--free-by", str(FREE_BY_S[case.stem])]
    if case.stem in EVERY_STEP:
        arguments.append("--every-step")
    begin = time.monotonic()
    done = subprocess.run(arguments, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    result = json.loads(numbers.read_text()) if numbers.exists() else {}
    result["seconds"] = time.monotonic() - begin
    result["scene"] = case.stem
    faults = []
    if done.returncode == 2:
        faults.append((done.stderr.strip().splitlines() or ["no message"])[0])
    if result.get("late"):
        faults.append("cloth intersects")
    if result.get("flagged_frames"):
        faults.append("flagged frames")
    if result.get("largest_way_cells", 0) > 0.5:
        faults.append("a sample goes too far in a step")
    if not result.get("most_contacts") and case.stem not in TANGLED | UNTOUCHED:
        faults.append("nothing touches anything")
    if done.returncode == 1 and not faults:
        faults.append(f"exit {done.returncode}: {done.stdout[-300:]}")
    result["faults"] = faults
    return result


COLUMNS = [("scene", "scene", "{}"), ("steps", "steps", "{}"), ("frames", "frames", "{}"),
           ("with crossings", "looks_with_intersections", "{}"), ("most pairs", "most_pairs", "{}"),
           ("free from [s]", "free_from_s", "{:.4f}"), ("flagged frames", "flagged_frames", "{}"),
           ("largest way [cells]", "largest_way_cells", "{:.3f}"), ("contacts", "most_contacts", "{}"),
           ("cloth-cloth", "most_contacts_of_cloth_with_cloth", "{}"), ("seconds", "seconds", "{:.0f}")]


def row(result):
    cells = [form.format(result[key]) if result.get(key) is not None else "-" for _, key, form in COLUMNS]
    return " | ".join(cells + ["; ".join(result["faults"]) or "good"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gambeson")
    parser.add_argument("checker")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("cases", nargs="*")
    options = parser.parse_intermixed_args()
    wanted = options.cases or (SHORT if options.short else [])
    cases = [c for c in scenes() if not wanted or c.stem in wanted]
    check(len(cases) == len(wanted) or not wanted, f"not all of {wanted} are scenes of the library")
    results = []
    print(" | ".join([name for name, _, _ in COLUMNS] + ["verdict"]), flush=True)
    with Folder() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(look, options.checker, c, folder) for c in cases]):
            results.append(done.result())
            print(row(results[-1]), flush=True)
    if options.csv:
        names = [key for _, key, _ in COLUMNS] + ["faults"]
        lines = [",".join(names)] + [",".join(str(r.get(n, "")).replace(",", ";") for n in names) for r in results]
        options.csv.write_text("\n".join(lines) + "\n")
    bad = [r["scene"] for r in results if r["faults"]]
    check(not bad, f"these scenes fail: {bad}")
    print(f"{len(results)} scenes, all good")


if __name__ == "__main__":
    main()
