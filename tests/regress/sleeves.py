#!/usr/bin/env python3
"""Long sleeves of a coarse draft: what check calls valid can be drafted and worn while the arms swing.

    sleeves.py GAMBESON

The longest sleeve that check names on a small woman is accepted and a centimetre more is not; a sleeve that ends at the
armhole is told the shortest. With sleeves of 44 cm the shirt is worn through the first moments of walking without any check of
the run failing, with torques at the elbows. Laid flat, its seams say the armholes.
"""

import json
import pathlib
import re
import sys

from common import Folder, check, run, sound

WEARER = "female_p5"
CASE = {
    "name": "Long sleeves on a small woman, the first moments of walking",
    "garment": {"shirt": {"sleeve_length": "90 cm", "sleeve_ease": "15 %", "cell": "40 mm"}, "samples_per_cell": 2},
    "fabric": {"thickness": "0.762 mm", "density": "436 kg/m^3", "young": "100 kPa", "poisson": 0.3,
               "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
    "human": {"manikin": WEARER, "motion": {"walk": {"lead_in": "0.4 s", "strides": 1}}},
    "contact": {"layer": "1 mm", "friction": 0.3},
    "air": {"drag": "4 kg/(m^2 s)"},
    "dressing": {"settle": "0.06 s"},
    "time": {"duration": "0.12 s"},
    "output": {"window": "10 ms", "frame": "20 ms", "checkpoint": "100 ms", "pictures": []},
    "analysis": {"joints": ["elbow_flexion_left", "elbow_flexion_right"], "counting": "all_distal"},
}


def main():
    with Folder() as folder:
        folder = pathlib.Path(folder)
        file = folder / "sleeves.json"

        def write(length):
            CASE["garment"]["shirt"]["sleeve_length"] = length
            file.write_text(json.dumps(CASE))

        def limit(length, word):
            write(length)
            done = run("check", file)
            found = re.search(r"sleeves.json:1: garment.shirt.sleeve_length: .*; allowed: at " + word +
                              r" ([0-9.]+) cm on " + WEARER, done.stderr)
            check(done.returncode == 2 and found, f"check of {length}: exit {done.returncode}, {done.stderr}")
            return float(found.group(1))

        longest, shortest = limit("90 cm", "most"), limit("6 cm", "least")
        check(44 < longest < 50, f"the longest sleeve is {longest} cm")
        check(10 < shortest < 24, f"the shortest sleeve is {shortest} cm")
        for length, valid in ((longest + 1, 2), (shortest, 0), (longest, 0)):
            write(f"{length} cm")
            done = run("check", file)
            check(done.returncode == valid, f"{length} cm: exit {done.returncode}, {done.stderr}")

        write("44 cm")
        out = folder / "out"
        done = run("run", file, "--out", out)
        numbers = sound(done, out, "the shirt")
        elbows = [j for j in numbers["joints"] if j["joint"].startswith("elbow")]
        check(len(elbows) == 2 and all(abs(j["peak_Nm"]) > 0 for j in elbows), f"elbows: {elbows}")

        flat = folder / "flat.json"
        done = run("draft", file, "--flat", "-o", flat)
        check(done.returncode == 0, done.stderr)
        pattern = json.loads(flat.read_text())
        names = [panel["name"] for panel in pattern["panels"]]
        check(len(names) == 14 and len(pattern["seams"]) == 24, f"{len(names)} panels, {len(pattern['seams'])} seams")
    return 0


if __name__ == "__main__":
    sys.exit(main())
