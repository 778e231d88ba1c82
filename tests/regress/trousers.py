#!/usr/bin/env python3
"""Trousers of a coarse draft: what check calls valid can be drafted and worn, and flat panels come back from DXF.

    trousers.py GAMBESON

The longest inseam that check names on a small woman is accepted and a centimetre more is not; so long, the trousers are
worn through the first moments of a walk without any check of the run failing. Laid flat, they are written as DXF, whose
panels are measured here from its text, and read again: areas within 1e-6, the same seams.
"""

import json
import pathlib
import re
import sys

from common import Folder, check, run, sound

WEARER = "female_p5"
CASE = {
    "name": "Trousers on a small woman, the first moments of walking",
    "garment": {"shorts": {"inseam": "1.1 m", "ease": "12 %", "waist_ease": "6 %", "cell": "45 mm"}, "samples_per_cell": 2},
    "fabric": {"thickness": "0.762 mm", "density": "436 kg/m^3", "young": "200 kPa", "poisson": 0.3,
               "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
    "human": {"manikin": WEARER, "motion": {"walk": {"lead_in": "0.4 s", "strides": 1}}},
    "supports": [{"springs": {"edge": "waist", "stiffness": "8000 N/m^2", "link": "pelvis"}}],
    "contact": {"layer": "2 mm", "friction": 0.3},
    "air": {"drag": "4 kg/(m^2 s)", "velocity": "pelvis_mean"},
    "dressing": {"projecting": {"clearance": "5 mm", "grow": "0.05 s"}, "settle": "0.06 s"},
    "time": {"duration": "0.12 s"},
    "output": {"window": "10 ms", "frame": "20 ms", "checkpoint": "100 ms", "pictures": []},
    "analysis": {"joints": ["hip_flexion_left", "hip_flexion_right", "knee_flexion_left", "knee_flexion_right"],
                 "counting": "all_distal"},
}


def shoelace(points):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))


def panels_of_dxf(text):
    """Name -> area [m^2] of the boundaries (layer 1), from the text alone."""
    lines = text.split("\n")
    pairs = list(zip((int(code) for code in lines[0:-1:2]), lines[1::2]))
    areas, name, points, entity, layer = {}, None, [], None, None
    for code, value in pairs:
        if code == 0:
            if entity == "POLYLINE" and value == "VERTEX":
                points, in_line = [], layer == "1"
            if value == "SEQEND" and in_line:
                areas[name] = 1e-6 * shoelace(points)
            entity = value
        elif code == 8:
            layer = value
        elif code == 1 and value.startswith("PIECE NAME: "):
            name = value[12:]
        elif entity == "VERTEX" and code == 10:
            points.append([float(value), 0])
        elif entity == "VERTEX" and code == 20:
            points[-1][1] = float(value)
    return areas


def area_of(panel):
    points = []
    for edge in panel["outline"]:
        points += [edge["start"]] + edge.get("polyline", [])
    return shoelace(points)


def main():
    with Folder() as folder:
        folder = pathlib.Path(folder)
        file = folder / "trousers.json"

        def write(inseam):
            CASE["garment"]["shorts"]["inseam"] = inseam
            file.write_text(json.dumps(CASE))

        write("1.1 m")
        done = run("check", file)
        found = re.search(r"trousers.json:1: garment.shorts.inseam: .*; allowed: at most ([0-9.]+) cm on " + WEARER,
                          done.stderr)
        check(done.returncode == 2 and found, f"check of 1.1 m: exit {done.returncode}, {done.stderr}")
        longest = float(found.group(1))
        check(58 < longest < 64, f"the longest inseam is {longest} cm")
        write(f"{longest + 1} cm")
        check(run("check", file).returncode == 2, f"{longest + 1} cm is accepted")
        write(f"{longest} cm")
        check(run("check", file).returncode == 0, f"{longest} cm is refused")

        out = folder / "out"
        done = run("run", file, "--out", out)
        numbers = sound(done, out, "the pair of trousers")
        knees = [j for j in numbers["joints"] if j["joint"].startswith("knee")]
        check(len(knees) == 2 and all(abs(j["peak_Nm"]) > 0 for j in knees), f"knees: {knees}")

        dxf, again, flat = folder / "t.dxf", folder / "again.json", folder / "flat.json"
        for target in (dxf, flat, folder / "t.svg"):
            done = run("draft", file, "--flat", "-o", target)
            check(done.returncode == 0, done.stderr)
        check("strain rms" in done.stdout, done.stdout)
        done = run("import", dxf, "-o", again)
        check(done.returncode == 0, done.stderr)
        first, second = json.loads(flat.read_text()), json.loads(again.read_text())
        measured = panels_of_dxf(dxf.read_text())
        check(len(measured) == 6, f"{len(measured)} panels in the DXF")
        for a, b in zip(first["panels"], second["panels"]):
            for area in (area_of(b), measured[a["name"]]):
                check(abs(area / area_of(a) - 1) < 1e-6, f"{a['name']}: {area} m^2, {area_of(a)} m^2 went out")
        check(first["seams"] == second["seams"] and len(first["seams"]) == 9, "the seams are not those that went out")
        done = run("draft", file, "--flat", "-o", folder / "t.pdf")
        check(done.returncode == 2 and "t.pdf" in done.stderr, f"t.pdf: {done.returncode}, {done.stderr}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
