#!/usr/bin/env python3
"""Patterns of other programs, imported and read again here from the raw files, independently: number of panels, areas and
lengths of seams within 0.1 %.

    patterns.py GAMBESON

Reads GarmentCode and DXF by itself: curves sampled at 20,000 points, areas by the shoelace formula, lengths as sums of
chords. Compares what the command prints, and what its file says, sampled likewise. Of meshes it reads vertices and faces: their area, the
length of edges that one triangle has, and the area of their uv. Files of others are in the public data;
without these a small file of our own making is all there is. The second import, of the written file, must write the same
bytes.
"""

import cmath
import json
import math
import os
import pathlib
import re
import sys

from common import SOURCE, Folder, check, run
from fuzz_seeds import GARMENTCODE, dxf, uv_tube

DATA = pathlib.Path(os.environ.get("GAMBESON_DATA", SOURCE / ".." / "shared" / "data")).resolve() / "real" / "garment"
SAMPLES = 20000
WITHIN = 1e-3


def bezier(points, t):
    while len(points) > 1:
        points = [(1 - t) * a + t * b for a, b in zip(points, points[1:])]
    return points[0]


def arc(a, b, turn, t):
    """From a to b, the tangent turning by `turn`: about the centre that sees the chord under that angle."""
    center = (a + b) / 2 + 1j * (b - a) / (2 * math.tan(turn / 2))
    return center + (a - center) * cmath.exp(1j * turn * t)


def sampled(curve):
    return [curve(k / SAMPLES) for k in range(SAMPLES)]  # the end is the next edge's start


def area(loop):
    points = [p for edge in loop for p in edge]
    return abs(sum((a.conjugate() * b).imag for a, b in zip(points, points[1:] + points[:1]))) / 2


def length(loop, edge):
    points = loop[edge] + loop[(edge + 1) % len(loop)][:1]
    return sum(abs(b - a) for a, b in zip(points, points[1:]))


def garmentcode(text):
    """Panels by name as loops of sampled edges, cm; pairs of seams' sides as (panel, edge)."""
    file = json.loads(text)
    unit = 100 / file["properties"]["units_in_meter"]
    panels = {}
    for name, panel in file["pattern"]["panels"].items():
        corners = [unit * complex(*v) for v in panel["vertices"]]
        loop = []
        for edge in panel["edges"]:
            a, b = (corners[k] for k in edge["endpoints"])
            curve = edge.get("curvature")
            if curve is None:
                loop.append([a])
            elif isinstance(curve, dict) and curve["type"] == "circle":
                radius, large, right = curve["params"]
                turn = 2 * math.asin(min(1, abs(b - a) / (2 * unit * radius)))
                turn = 2 * math.pi - turn if large else turn
                loop.append(sampled(lambda t, a=a, b=b, turn=turn if right else -turn: arc(a, b, turn, t)))
            else:
                inner = [curve] if isinstance(curve, list) else curve["params"]
                points = [a, *(a + complex(*p) * (b - a) for p in inner), b]
                loop.append(sampled(lambda t, points=points: bezier(points, t)))
        panels[name] = loop
    seams = [[(side["panel"], side["edge"]) for side in stitch[:2]] for stitch in file["pattern"]["stitches"]]
    return panels, seams


def dxf_panels(text):
    """Panels by name as loops of one edge, cm: the sew line, else the boundary."""
    lines = [line.strip() for line in text.replace("\r", "").split("\n")]
    pairs = list(zip(lines[::2], lines[1::2]))
    entities, current = [], None
    for code, value in pairs:
        if code == "0":
            current = [value, {}]
            entities.append(current)
        elif current:
            current[1].setdefault(code, value)
    blocks, units = {}, None
    block = loop = None
    for kind, values in entities:
        layer = values.get("8")
        if kind == "BLOCK":
            block = {"name": values["2"], "1": [], "14": [], "circles": []}
        elif kind == "ENDBLK":
            if block["1"]:
                blocks[block["name"]] = block
            block = None
        elif kind == "TEXT":
            text = values.get("1", "")
            if block is not None and text.startswith("PIECE NAME:"):
                block["name"] = text[11:].strip()
            if text.startswith("UNITS:"):
                units = text[6:].strip()
        elif kind == "POLYLINE":
            loop = [] if block is not None and layer in ("1", "14") else None
            if loop is not None:
                block[layer].append(loop)
        elif kind == "VERTEX" and loop is not None:
            loop.append((complex(float(values["10"]), float(values["20"])), float(values.get("42", 0))))
        elif kind == "SEQEND":
            loop = None
        elif kind == "CIRCLE" and block is not None and layer == "11":
            block["circles"].append(float(values["40"]))
    unit = {"METRIC": 0.1, "ENGLISH": 2.54}[units]
    panels, holes = {}, {}
    for name, block in blocks.items():
        points = (block["14"] or block["1"])[0]
        loop = []
        for (a, bulge), (b, _) in zip(points, points[1:] + points[:1]):
            a, b = unit * a, unit * b
            loop.append(sampled(lambda t, a=a, b=b, turn=4 * math.atan(bulge): arc(a, b, turn, t)) if bulge else [a])
        panels[name] = loop
        holes[name] = sum(math.pi * (unit * r) ** 2 for r in block["circles"])
    return panels, holes


def written(text):
    """The same of a file of ours, cm."""
    file = json.loads(text)
    panels = {}
    for panel in file["panels"]:
        loop = []
        edges = panel["outline"]
        for edge, following in zip(edges, edges[1:] + edges[:1]):
            a, b = (100 * complex(*e["start"]) for e in (edge, following))
            inner = lambda key: [100 * complex(*p) for p in edge[key]]
            if "arc" in edge:
                loop.append(sampled(lambda t, a=a, b=b, turn=edge["arc"]: arc(a, b, turn, t)))
            elif "bezier" in edge:
                loop.append(sampled(lambda t, points=[a, *inner("bezier"), b]: bezier(points, t)))
            else:
                loop.append([a, *(inner("polyline") if "polyline" in edge else [])])
        panels[panel["name"]] = loop
    return panels


def said(out):
    """Areas [cm^2] by panel, lengths [cm] of the sides of each seam with their words, as the command prints them."""
    first, rest = out.split("\npanel ", 1)
    rows = rest.split("\n\n")[0].split("\n")[1:]
    areas = {}
    for row in rows:
        name, found = re.match(r"(.*?) +([0-9.]+) +[0-9.]+ +\d+ +\d+  ", row).groups()
        areas[name] = float(found)
    seams = []
    if "\nseam " in out:
        for row in out.split("\nseam ", 1)[1].split("\n\n")[0].split("\n")[1:]:
            _, a, b, sides = re.match(r"(\S+) +([0-9.]+) +([0-9.]+)   (.*)", row).groups()
            one, other = (re.match(r"(.*)\.(\d+)( reversed)?", s).groups()[:2] for s in sides.split(", ")[:2])
            seams.append(((one[0], int(one[1]), float(a)), (other[0], int(other[1]), float(b))))
    return areas, seams


def near(found, wanted, what, least=0):
    # What is printed has three digits behind the point.
    off = max(0, abs(found - wanted) - 5e-4) / wanted
    check(off <= WITHIN, f"{what}: {found} in place of {wanted}")
    return max(least, off)


def compare(file, folder):
    text = file.read_text(errors="replace")
    is_dxf = file.suffix == ".dxf"
    panels, other = dxf_panels(text) if is_dxf else garmentcode(text)
    holes = other if is_dxf else {}
    out, svg = folder / f"{file.stem}.out.json", folder / f"{file.stem}.svg"
    done = run("import", file, "-o", out, "--svg", svg)
    check(done.returncode == 0, f"{file.name}: {done.returncode} {done.stderr}")
    areas, seams = said(done.stdout)
    check(areas.keys() == panels.keys(), f"{file.name}: panels {sorted(areas)} in place of {sorted(panels)}")
    ours = written(out.read_text())
    worst = 0
    for name, loop in panels.items():
        worst = near(areas[name], area(loop) - holes.get(name, 0), f"{file.name}: area of {name}", worst)
        worst = near(area(ours[name]), area(loop), f"{file.name}: area of {name} as written", worst)
    if is_dxf:
        for side in (side for seam in seams for side in seam):
            worst = near(side[2], length(ours[side[0]], side[1]), f"{file.name}: length of {side[:2]}", worst)
    else:
        check(len(seams) == len(other), f"{file.name}: {len(seams)} seams in place of {len(other)}")
        for found, wanted in zip(seams, other):
            for side, (panel, edge) in zip(found, wanted):
                check((side[0], side[1]) == (panel, edge), f"{file.name}: seam of {side} in place of {panel} {edge}")
                worst = near(side[2], length(panels[panel], edge), f"{file.name}: length of {panel} {edge}", worst)
    again = folder / f"{file.stem}.again.json"
    done = run("import", out, "-o", again)
    check(done.returncode == 0 and again.read_bytes() == out.read_bytes(), f"{file.name}: not the same when read again {done.stderr}")
    print(f"{file.name}: {len(panels)} panels, {len(seams)} seams, at most {100 * worst:.4f} % off")


def compare_mesh(file, folder, unit, *options):
    """`unit`: cm of a 1."""
    points, uv, triangles = [], [], []
    for line in file.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append(tuple(unit * float(x) for x in words[1:4]))
        elif words and words[0] == "vt":
            uv.append(tuple(map(float, words[1:3])))
        elif words and words[0] == "f":
            corners = [[int(k) - 1 if k else -1 for k in w.split("/")[:2]] for w in words[1:]]
            triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    area = flat = 0
    edges = {}
    for t in triangles:
        a, b, c = (points[k[0]] for k in t)
        ab, ac = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        area += math.hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]) / 2
        for p, q in ((a, b), (b, c), (c, a)):
            key = tuple(sorted((tuple(round(x, 6) for x in p), tuple(round(x, 6) for x in q))))
            edges[key] = edges.get(key, 0) + 1
        if len(t[0]) > 1:
            (u, v), (w, x), (y, z) = (uv[k[1]] for k in t)
            flat += abs((w - u) * (z - v) - (y - u) * (x - v)) / 2
    border = sum(math.dist(*e) for e, count in edges.items() if count == 1)
    out = folder / f"{file.stem}.mesh.json"
    done = run("import", file, "-o", out, *options)
    check(done.returncode == 0, f"{file.name}: {done.returncode} {done.stderr}")
    rows = [r.split() for r in re.search(r"\npatch .*\n((?:.+\n)+)", done.stdout).group(1).splitlines()]
    worst = near(sum(float(r[2]) for r in rows), area, f"{file.name}: area")
    lengths = re.findall(r"^border_\d+ +([0-9.]+)$", done.stdout, re.M)
    worst = near(sum(map(float, lengths)), border, f"{file.name}: borders", worst)
    scale = re.search(r"a 1 of it is ([0-9.e+-]+) m", done.stdout)
    if scale:
        worst = near(sum(float(r[3]) for r in rows), flat * (100 * float(scale.group(1))) ** 2, f"{file.name}: flat area", worst)
    again = folder / f"{file.stem}.mesh2.json"
    done = run("import", out, "-o", again)
    kept = json.loads(out.read_text())
    check(done.returncode == 0 and all(json.loads(again.read_text())[k] == kept[k] for k in ("vertices_m", "patches", "edges")),
          f"{file.name}: not the same when read again {done.stderr}")
    print(f"{file.name}: {len(rows)} patches, {len(lengths)} borders, at most {100 * worst:.4f} % off")


def main():
    with Folder() as folder:
        (folder / "tube.obj").write_text(uv_tube())
        compare_mesh(folder / "tube.obj", folder, 1, "--unit", "cm")
        (folder / "small_specification.json").write_text(GARMENTCODE)
        (folder / "small.dxf").write_text(dxf())
        files = [folder / "small_specification.json", folder / "small.dxf"]
        real = sorted(DATA.glob("*_specification.json")) + sorted(DATA.glob("*.dxf"))
        if not real:
            print(f"no public data at {DATA}: only files of our own making", file=sys.stderr)
        for file in files + real:
            compare(file, folder)


if __name__ == "__main__":
    main()
