#!/usr/bin/env python3
"""Malformed inputs through the binary: exit status 2, the file, its line or key, the reason; nothing of a sanitizer.

    malformed.py [GAMBESON] [--table]

Each input breaks one place of a good set of files (a case, its URDF, body file, trajectory, mesh and garment file).
`where` must stand in the message right after the file's name: ":12: key" or ": key"; "" only where a whole file is at
fault. --table prints how many inputs there are of each kind and class.
"""

import collections
import os
import pathlib
import re
import shutil
import struct
import sys

from common import SOURCE, Folder, binary, check, run

CASE = """{
  "name": "good",
  "garment": {
    "tube": {"radius": "6 cm", "length": "0.3 m", "cells_around": 8, "cells_along": 8, "axis": [1, 0, 0]}
  },
  "fabric": {
    "thickness": "1 mm", "density": "436 kg/m^3",
    "young": "1.2 MPa", "poisson": 0.1,
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "human": {
    "urdf": "arm.urdf", "body": "body.json",
    "motion": {"trajectory": {"file": "flex.csv"}}
  },
  "obstacles": [
    {"name": "ball", "mesh": {"file": "ball.obj", "position": [0, 0, -1]}}
  ],
  "supports": [
    {"fixed": {"edge": "start"}}
  ],
  "contact": {"friction": 0.1},
  "output": {"window": "10 ms", "frame": "20 ms", "checkpoint": "40 ms"},
  "analysis": {"joints": ["elbow_flexion"]}
}
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
CSV = "time_s,root_x_m,elbow_flexion_rad\n0,0,0\n0.1,0,0.2\n0.2,0,0.3\n"
PATCH = """{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "weft": [1, 0, 0],
   "points_m": [%s]}"""
GARMENT = """{"format": "gambeson garment 1",
 "name": "two squares",
 "patches": [
  """ + PATCH % "[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]" + """,
  """ + PATCH % "[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0.5]" + """],
 "seams": [{"a": {"patch": 0, "side": "u1"}, "b": {"patch": 1, "side": "u0"}, "kind": "C0", "stiffness_N": 0.1}]}
"""
PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
GLTF = ('{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], '
        '"nodes": [{"children": [1]}, {"children": [%s]}]}')

FILES = {"case.json": CASE, "arm.urdf": (SOURCE / "cases/library/arm.urdf").read_text(),
         "body.json": (SOURCE / "cases/library/arm_body.json").read_text(), "flex.csv": CSV, "ball.obj": OBJ,
         "cloth.json": GARMENT}
KINDS = {"case.json": "case", "arm.urdf": "urdf", "body.json": "body", "flex.csv": "trajectory", "ball.obj": "mesh",
         "cloth.json": "garment"}


class Bad:
    def __init__(self, kind_of, error_class, change, where, reason, arguments=("check", "case.json"), names=None):
        self.file, self.error_class, self.change, self.where, self.reason = kind_of, error_class, change, where, reason
        self.arguments, self.names = arguments, names or kind_of


def swap(old, new):
    def change(text):
        assert text.count(old) >= 1, old
        return text.replace(old, new, 1)
    return change


def whole(content):
    return lambda text: content


def cut(part):
    return lambda text: text[:int(len(text) * part)]


def as_mesh(name, content):
    """The case's mesh in another format: the second file is written beside, and named in the case."""
    def change(text, folder):
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        case = folder / "case.json"
        case.write_text(case.read_text().replace("ball.obj", name))
        return text
    change.places = True
    return change


def place(make):
    """Something else than a file under the file's name."""
    def change(text, folder, file):
        (folder / file).unlink()
        make(folder / file)
    change.replaces = True
    return change


def stl(count, triangles):
    t = struct.pack("<12fH", 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return b" " * 80 + struct.pack("<I", count) + t * triangles


C, U, B, T, M, G = FILES
WITH_GARMENT = ("check", "case.json", "--set", 'garment={"file": {"path": "cloth.json"}}', "--set",
                "supports=[]")


def all_bad():
    case = lambda *a, **k: Bad(C, *a, **k)
    urdf = lambda *a: Bad(U, *a)
    body = lambda *a: Bad(B, *a)
    table = lambda *a: Bad(T, *a)
    mesh = lambda *a, **k: Bad(M, *a, **k)
    cloth = lambda *a, **k: Bad(G, *a, arguments=("check", "with_cloth.json"), **k)
    return [
        # syntax
        case("syntax", swap('"6 cm",', '"6 cm"'), ":4:", "string literal"),
        case("syntax", swap("{", "{{"), ":1:", ""),
        case("syntax", swap('"name"', "'name'"), ":2:", ""),
        case("syntax", whole("\x89PNG\r\n"), ":1:", ""),
        case("syntax", swap('"name": "good"', '"name": "good", "name": "bad"'), ":2: name", "twice"),
        urdf("syntax", swap("</joint>", "</joined>"), ":", "not XML"),
        urdf("syntax", swap('name="arm"', 'name=arm"'), ":", ""),
        body("syntax", swap('"mass_kg": 84.6,', '"mass_kg": 84.6'), ":3:", "not JSON"),
        table("syntax", swap("0.1,0,0.2", "0.1;0;0.2"), ":3:", "has 1 values"),
        table("syntax", swap("0.1,0,0.2", '0.1,0,"0.2"'), ":3: column 3", "not a finite number"),
        mesh("syntax", as_mesh("m.ply", "plx\n"), "", "", names="m.ply"),
        mesh("syntax", as_mesh("m.gltf", '{"asset": '), "", "", names="m.gltf"),
        mesh("syntax", whole("\xff" * 1000), "", ""),
        cloth("syntax", swap('"name": "two squares",', '"name": "two squares"'), ":3:", ""),
        cloth("syntax", swap('"name": "two squares"', '"name": "two squares" "again"'), ":2:", ""),
        # units
        case("units", swap('"6 cm"', '"6 kg"'), ":4: garment.tube.radius", "wrong unit"),
        case("units", swap('"1 mm"', '"1"'), ":7: fabric.thickness", "has no unit"),
        case("units", swap('"1.2 MPa"', '"1.2 MegaPa"'), ":8: fabric.young", "unknown"),
        urdf("units", swap('xyz="0.25 0 0"', 'xyz="0.25m 0 0"'), ":11:", "not a finite number"),
        urdf("units", swap('upper="2.5"', 'upper="140deg"'), ":13:", "not a finite number"),
        body("units", swap("84.6", '"84.6 kg"'), ": mass_kg", "without a unit"),
        table("units", swap("elbow_flexion_rad", "elbow_flexion"), ":1: column 3 'elbow_flexion'", "unit"),
        table("units", swap("elbow_flexion_rad", "elbow_flexion_m"), ":1: column 3", "turns"),
        table("units", swap("time_s", "time_ms"), ":1: column 1", "time_s"),
        cloth("units", swap("[1, 0, 0], [0, 1, 0]", '["1 m", 0, 0], [0, 1, 0]'), ": patches[0].points_m[1][0]", "number"),
        # range
        case("range", swap('"1 mm"', '"-1 mm"'), ":7: fabric.thickness", "out of range"),
        case("range", swap('"poisson": 0.1', '"poisson": 1.5'), ":8: fabric.poisson", "out of range"),
        case("range", swap('"frame": "20 ms"', '"frame": "25 ms"'), ":22: output.frame", "multiple"),
        urdf("range", swap('axis xyz="0 -1 0"', 'axis xyz="0 0 0"'), ":12:", "longer than"),
        urdf("range", swap('lower="0"', 'lower="3"'), ":13:", "above"),
        body("range", swap("[0.175,", "[-0.175,"), ": shapes[0].semi_axes_m[0]", "not allowed"),
        table("range", swap("0.2,0,0.3", "0.2,0,3"), ":4: column 3", "outside"),
        table("range", swap("0.2,0,0.3", "0.1,0,0.3"), ":4: time_s", "does not come after"),
        mesh("range", swap("f 2 3 4", "f 2 3 9"), "", ""),
        mesh("range", as_mesh("m.ply", PLY.replace("3 1 2 3", "3 1 2 77")), ":", "", names="m.ply"),
        cloth("range", swap('"degree": [1, 1]', '"degree": [99, 1]'), ": patches[0]", "99"),
        cloth("range", swap('"patch": 1', '"patch": 7'), ": seams[0]", "7"),
        cloth("range", swap('"stiffness_N": 0.1', '"stiffness_N": -1'), ": seams[0].stiffness_N", "negative"),
        cloth("range", swap("[0, 0, 1, 1]", "[1, 1, 0, 0]"), ": patches[0].", ""),
        # NaN and infinity
        case("NaN", swap('"6 cm"', '"nan m"'), ":4: garment.tube.radius", "not a finite number"),
        case("NaN", swap('"poisson": 0.1', '"poisson": NaN'), ":8: fabric.poisson", ""),
        case("NaN", swap('"poisson": 0.1', '"poisson": 1e999'), ":8: fabric.poisson", ""),
        urdf("NaN", swap('xyz="0.25 0 0"', 'xyz="0.25 nan 0"'), ":11:", "nan"),
        urdf("NaN", swap('upper="2.5"', 'upper="inf"'), ":13:", "inf"),
        body("NaN", swap("84.6", "NaN"), ":2:", "not JSON"),
        table("NaN", swap("0.2,0,0.3", "0.2,nan,0.3"), ":4: column 2", "nan"),
        table("NaN", swap("0.1,0,0.2", "inf,0,0.2"), ":3: column 1", "inf"),
        mesh("NaN", swap("v 1 0 0", "v nan 0 0"), "", ""),
        mesh("NaN", as_mesh("m.ply", PLY.replace("1 0 0\n", "nan 0 0\n", 1)), ":", "", names="m.ply"),
        cloth("NaN", swap("[1, 0, 0], [0, 1, 0]", "[NaN, 0, 0], [0, 1, 0]"), ":5:", ""),
        cloth("NaN", swap("[1, 0, 0], [0, 1, 0]", "[1e999, 0, 0], [0, 1, 0]"), "", "1e999"),
        # missing
        case("missing", swap('"thickness": "1 mm", ', ""), ":6: fabric.thickness", "is required"),
        case("missing", swap('"contact": {"friction": 0.1},', ""), ":1: contact", "is required"),
        case("missing", swap('"arm.urdf"', '"leg.urdf"'), ":12: human.urdf", "there is no file"),
        urdf("missing", swap('<parent link="upper_arm"/>', ""), ":8:", "<parent>"),
        urdf("missing", swap('<link name="forearm"/>', ""), ":", "forearm"),
        body("missing", swap('"stature_m": 1.755,', ""), ": stature_m", "is missing"),
        table("missing", swap("0.1,0,0.2", "0.1,0,"), ":3: column 3", ""),
        table("missing", swap("0.1,0,0.2", "0.1,0"), ":3:", "has 2 values"),
        mesh("missing", whole("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "", ""),
        mesh("missing", as_mesh("m.ply", PLY.replace("3 1 2 3", "0")), ": face 3", "no corner", names="m.ply"),
        mesh("missing", as_mesh("m.ply", PLY.replace("end_header\n", "")), "", "", names="m.ply"),
        cloth("missing", swap('"weft": [1, 0, 0],', ""), ": patches[0].weft", "is missing"),
        cloth("missing", swap('"kind": "C0", ', ""), ": seams[0].kind", "is missing"),
        case("missing", lambda t: t, "", "there is no such file", arguments=("check", "none.json"), names="none.json"),
        # unknown
        case("unknown", swap('"friction"', '"fricton"'), ":21: contact.fricton", "did you mean"),
        case("unknown", swap('"linear"', '"cubic"'), ":9: fabric.bending.law", "allowed"),
        case("unknown", swap('["elbow_flexion"]', '["elbow"]'), ":23: analysis.joints[0]", "no joint"),
        case("unknown", lambda t: t, ": fabric.thicknes", "", names="command line",
             arguments=("check", "case.json", "--set", "fabric.thicknes=1 mm")),
        urdf("unknown", swap('type="revolute"', 'type="screw"'), ":8:", "screw"),
        urdf("unknown", swap('<link name="forearm"/>', '<link name="forearm"/><bone/>'), ":7:", "bone"),
        body("unknown", swap('"link": "forearm"', '"link": "tail"'), ": shapes[1].link", "tail"),
        body("unknown", swap('"stature_m"', '"height_m"'), ": height_m", "not known"),
        table("unknown", swap("root_x_m", "tail_m"), ":1: column 2", "no joint"),
        mesh("unknown", as_mesh("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "", "read from", names="m.off"),
        cloth("unknown", swap('"kind"', '"kinds"'), ": seams[0]", ""),
        cloth("unknown", swap('"side": "u1"', '"side": "w1"'), ": seams[0].a.side", "w1"),
        cloth("unknown", swap("garment 1", "garment 9"), ": format", "garment 9"),
        # truncated
        case("truncated", cut(0.5), ":12:", "missing closing quote"),
        case("truncated", cut(0.97), ":23:", ""),
        urdf("truncated", cut(0.6), ":", ""),
        body("truncated", cut(0.5), ":", "not JSON"),
        table("truncated", cut(0.9), ":", ""),
        table("truncated", whole(CSV.split("\n")[0] + "\n0,0,0\n"), ":", "two rows"),
        mesh("truncated", as_mesh("m.ply", PLY[:-30]), ":14: face", "", names="m.ply"),
        mesh("truncated", as_mesh("m.stl", stl(4, 4)[:200]), "", "", names="m.stl"),
        cloth("truncated", cut(0.7), ":", ""),
        # empty
        case("empty", whole(""), "", "empty"),
        case("empty", whole("{}"), ":1: one of garment or garments", "is required"),
        urdf("empty", whole(""), "", "empty"),
        urdf("empty", whole('<robot name="x"/>'), ":1:", "<link>"),
        body("empty", whole(""), "", "empty"),
        body("empty", whole("{}"), ":", "is missing"),
        table("empty", whole(""), "", "empty"),
        table("empty", whole("\n\n\n"), ":1:", ""),
        mesh("empty", whole(""), "", "empty"),
        mesh("empty", whole("# nothing\n"), "", ""),
        cloth("empty", whole(""), "", ""),
        cloth("empty", whole('{"format": "gambeson garment 1", "name": "", "patches": [], "seams": []}'), ": patches", "none"),
        # cyclic
        case("cyclic", place(lambda p: p.symlink_to(p.name)), "", "symbolic link"),
        urdf("cyclic", swap('<child link="forearm"/>', '<child link="upper_arm"/>'), ":8:", ""),
        urdf("cyclic", swap("</robot>", '<joint name="back" type="fixed"><parent link="forearm"/><child link="upper_arm"/>'
                            "</joint></robot>"), ":", ""),
        urdf("cyclic", swap('<axis xyz="0 -1 0"/>', '<axis xyz="0 -1 0"/><mimic joint="elbow_flexion"/>'), ":8:", "itself"),
        urdf("cyclic", swap("</robot>", '<link name="a"/><link name="b"/><joint name="ab" type="fixed"><parent link="a"/>'
                            '<child link="b"/></joint><joint name="ba" type="fixed"><parent link="b"/><child link="a"/>'
                            "</joint></robot>"), ":", ""),
        urdf("cyclic", place(lambda p: p.symlink_to(p.name)), ":12: human.urdf", "symbolic link"),
        mesh("cyclic", as_mesh("m.gltf", GLTF % "0"), "", "", names="m.gltf"),
        mesh("cyclic", as_mesh("m.gltf", GLTF % "1"), "", "", names="m.gltf"),
        cloth("cyclic", swap('{"patch": 1, "side": "u0"}', '{"patch": 0, "side": "u1"}'), ": seams[0]", ""),
        cloth("cyclic", swap('"seams": [', '"seams": [{"a": {"patch": 0, "side": "u1"}, "b": {"patch": 1, "side": "u0"}, '
                             '"kind": "C0", "stiffness_N": 0.1}, '), ": seams[1]", "already"),
        # enormous
        case("enormous", whole('{"name": "' + "x" * (2 << 20) + '"}'), "", "at most"),
        case("enormous", whole("[" * 100000), ":1:", "nested"),
        case("enormous", swap('"cells_around": 8', '"cells_around": 2000000000'), ":4: garment.tube.cells_around", "range"),
        case("enormous", swap('"6 cm"', '"6e300 km"'), ":4: garment.tube.radius", ""),
        urdf("enormous", swap("<link", "<link name='a'>" * 100000 + "<link"), ":6:", "nested"),
        urdf("enormous", swap('xyz="0.25 0 0"', 'xyz="1e30 0 0"'), ":11:", "not within"),
        body("enormous", swap("84.6", "1e300"), ": mass_kg", "not allowed"),
        table("enormous", swap("0.2,0,0.3", "0.2,1e300,0.3"), ":4: column 2", ""),
        table("enormous", swap("0.2,0,0.3", "1e300,0,0.3"), ":4: time_s", "beyond"),
        mesh("enormous", swap("v 1 0 0", "v 1e20 0 0"), ": vertex", "not within"),
        mesh("enormous", as_mesh("m.ply", PLY.replace("vertex 4", "vertex 4000000000")), ":3:", "announces", names="m.ply"),
        mesh("enormous", as_mesh("m.stl", stl(4000000000, 4)), "", "", names="m.stl"),
        cloth("enormous", whole('{"format": ' + "[" * 3000000 + "]" * 3000000 + "}"), "", "nested"),
        body("enormous", whole('{"mass_kg": ' + "[" * 3000000 + "]" * 3000000 + "}"), ": ", ""),
        cloth("enormous", swap("[1, 0, 0], [0, 1, 0]", "[1e200, 0, 0], [0, 1, 0]"), ": patches[0].points_m[1]", "not within"),
        cloth("enormous", swap('"degree": [1, 1]', '"degree": [1, 900000]'), ": patches[0]", ""),
        cloth("enormous", swap('"patch": 1', '"patch": 1e300'), ": seams[0].b.patch", ""),
        # unreadable
        case("unreadable", place(lambda p: p.mkdir()), "", "folder"),
        case("unreadable", place(lambda p: p.symlink_to("/dev/zero")), "", "regular file"),
        urdf("unreadable", place(lambda p: p.mkdir()), ":12: human.urdf", "not a file"),
        urdf("unreadable", whole("\x7fELF\0\0"), "", "zero byte"),
        body("unreadable", place(lambda p: p.symlink_to("/dev/full")), ":12: human.body", "not a file"),
        table("unreadable", place(lambda p: os.mkfifo(p)), ":13: human.motion.trajectory.file", "not a file"),
        table("unreadable", whole("time_s,root_x_m\n0,\0\n1,1\n"), "", "zero byte"),
        mesh("unreadable", place(lambda p: p.symlink_to("nowhere")), ":16: obstacles[0].mesh.file", "no file"),
        cloth("unreadable", place(lambda p: p.mkdir()), ":3: garment.file.path", "not a file"),
        cloth("unreadable", whole("\x7fELF\0\0"), ":1:", ""),
    ]


def prepare(folder, bad):
    for name, text in FILES.items():
        (folder / name).write_bytes(text.encode())
    tube = CASE[CASE.index('    "tube"'):CASE.index('\n  },\n  "fabric"')]
    (folder / "with_cloth.json").write_text(
        CASE.replace('{\n' + tube, '{"file": {"path": "cloth.json"}').replace('"edge": "start"', '"edge": "0.u0"'))
    if bad is None:
        return
    if getattr(bad.change, "replaces", False):
        bad.change(None, folder, bad.file)
    elif getattr(bad.change, "places", False):
        bad.change(None, folder)
    else:
        text = bad.change(FILES[bad.file])
        (folder / bad.file).write_bytes(text.encode("latin-1" if any(ord(c) > 127 for c in text) else "utf-8"))


def fault(folder, bad):
    """What is wrong with the answer to one input, or None."""
    prepare(folder, bad)
    done = run(*bad.arguments, cwd=folder, timeout=60)
    if done.returncode != 2:
        return f"gave {done.returncode}"
    if re.search(r"Sanitizer|runtime error", done.stderr):
        return "woke a sanitizer"
    line = done.stderr.strip().splitlines()[0] if done.stderr.strip() else ""
    # What the case says of a file that is none stands at the key of the case.
    names = bad.names
    if bad.error_class in ("unreadable", "cyclic") and re.match(r":\d+: (human|obstacles|garment)\.|:\d+: obstacles\[", bad.where):
        names = bad.arguments[1]
    at = line.find(names)
    if at < 0:
        return f"does not name {names}"
    rest = line[at + len(names):]
    if not rest.startswith(bad.where if bad.where else ":"):
        return f"says {rest[:40]!r}, not {bad.where!r}, after the file's name"
    if bad.where == ":" and not re.match(r":\d+:|: [\w.\[\]<>' ]+: ", rest):
        return "names no line or key"
    if bad.reason not in line:
        return f"lacks {bad.reason!r}"
    return None if len(rest[len(bad.where):].strip(": ")) > 6 else "gives no reason"


def main():
    if "--table" in sys.argv:
        sys.argv.remove("--table")
        count = collections.Counter((KINDS[b.file], b.error_class) for b in all_bad())
        classes = list(dict.fromkeys(b.error_class for b in all_bad()))
        kinds = list(KINDS.values())
        print("class       " + "".join(f"{k:>11}" for k in kinds) + "        all")
        for c in classes:
            print(f"{c:12}" + "".join(f"{count[k, c]:11}" for k in kinds) + f"{sum(count[k, c] for k in kinds):11}")
    with Folder() as folder:
        prepare(folder, None)
        for good in ("case.json", "with_cloth.json"):
            done = run("check", good, cwd=folder)
            check(done.returncode == 0, f"the unbroken files are refused: {done.stderr}")
    bads, faults = all_bad(), 0
    for number, bad in enumerate(bads):
        with Folder() as folder:
            wrong = fault(folder, bad)
            if wrong:
                faults += 1
                answer = run(*bad.arguments, cwd=folder).stderr.strip()[:300]
                print(f"{number} {bad.file}, {bad.error_class}: {wrong}\n    {answer}")
    each = collections.Counter(b.error_class for b in bads)
    check(len(each) == 11 and min(each.values()) >= 4, f"too few inputs of a class: {each}")
    print(f"{len(bads)} malformed inputs, {faults} answered wrongly")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
