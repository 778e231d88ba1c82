#!/usr/bin/env python3
"""What people bring: values as laboratories and shops write them, and files that are foreign, mistaken or of another
sort. Each works, or `gambeson check` says file, place, reason and way out, with exit status 2.

    foreign.py [GAMBESON]
"""

import json
import sys

from common import SOURCE, Folder, check, run

LIBRARY = SOURCE / "cases/library"
CASE = """{
  "name": "sheet",
  "garment": {"sheet": {"width": "0.2 m", "height": "0.2 m", "cells_u": 4, "cells_v": 4}},
  "fabric": {
    "thickness": "0.8 mm", "surface_density": "0.32 kg/m^2",
    "young": "1.2 MPa", "poisson": 0.1,
    "bending": {"law": "linear", "rigidity": "1e-5 N m"}
  },
  "supports": [{"fixed": {"edge": "u0"}}],
  "time": {"duration": "0.1 s"}
}
"""
CARD = """{
  "name": "sheeting", "source": "a laboratory",
  "thickness": "0.8 mm", "weight": "320 g/m^2",
  "tensile": {"EMT": "5.5 %", "load": "500 gf/cm"},
  "shear": {"G": "1.5 gf/(cm deg)"},
  "bending": {"B": "0.172 gf cm^2/cm"}
}
"""
G, LB, IN, DEG = 9.80665, 0.45359237, 0.0254, 3.141592653589793 / 180

# Text of a case's value, its place, what it is in SI.
LAB = [
    ('"0.03 inch"', "thickness", 0.03 * IN),
    ('"0.03\\""', "thickness", 0.03 * IN),
    ('"30 mil"', "thickness", 0.03 * IN),
    ('"0,45 mm"', "thickness", 0.45e-3),
    ('"0.45\u202fmm"', "thickness", 0.45e-3),
    ('"9.4 oz/yd^2"', "surface_density", 9.4 * LB / 16 / (36 * IN) ** 2),
    ('"320 g/m2"', "surface_density", 0.32),
    ('"320 GSM"', "surface_density", 0.32),
    ('"0.172 gf.cm2/cm"', "bending.rigidity", 0.172e-5 * G),
    ('"0,172 gf\u00b7cm\u00b2/cm"', "bending.rigidity", 0.172e-5 * G),
    ('"17 uNm"', "bending.rigidity", 17e-6),
    ('"17 \u00b5N\u00b7m"', "bending.rigidity", 17e-6),
    ('"170 psi"', "young", 170 * LB * G / IN**2),
    ('"12,5 kgf/cm2"', "young", 12.5 * G * 1e4),
    ('"12.5%"', "poisson", 0.125),
    ('"0.5 lbf.in2/in"', "bending.rigidity", 0.5 * LB * G * IN),
]
# The same of a card: text, what it replaces.
CARD_LAB = [
    ('"900 N/5cm"', '"500 gf/cm"'), ('"900 N/50mm"', '"500 gf/cm"'), ('"5 lbf/in"', '"500 gf/cm"'), ('"0.5 kgf/cm"', '"500 gf/cm"'),
    ('"1.5 gf/cm/degree"', '"1.5 gf/(cm deg)"'), ('"5,5 %"', '"5.5 %"'), ('"9.4 oz/yd2"', '"320 g/m^2"'),
]
PLACES = {"thickness": '"0.8 mm"', "surface_density": '"0.32 kg/m^2"', "young": '"1.2 MPa"', "poisson": '"poisson": 0.1',
          "bending.rigidity": '"1e-5 N m"'}

MOT = "a motion\nversion=1\nnRows=2\nnColumns=2\ninDegrees=yes\nendheader\ntime\tknee\n0\t1\n0.1\t2\n"
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def case(old, new):
    assert CASE.count(old) == 1, old
    return "case.json", CASE.replace(old, new)


def card(old, new):
    assert CARD.count(old) == 1, old
    return "a.card.json", CARD.replace(old, new)


# File, what must stand in its messages: one text for each line that is expected, in their order.
REFUSED = [
    # units
    (case('"0.8 mm"', '"0.8"'), [":5: fabric.thickness: ", ]),
    (case('"0.8 mm"', '"0.8 MM"'), [":5: fabric.thickness: \"MM\" is not a unit: \"MM\" can be mm or Mm"]),
    (case('"0.8 mm"', '"1,234 mm"'), ["can be 1.234 or 1234"]),
    (case('"0.8 mm"', '"1.234,5 mm"'), [":5: fabric.thickness: "]),
    (case('"0.8 mm"', '"0.8 furlong"'), ["\"furlong\" is unknown; known are"]),
    (case('"0.8 mm"', '"8 oz/yd^2"'), ["(a mass per area); expected a length, such as mm, cm or in"]),
    (case('"0.8 mm"', '"3 in"'), ["3 in is out of range; allowed: > 0 and <= 1.9685 in"]),
    (case('"0.32 kg/m^2"', '"320 kg/m^3"'), ["(a mass per volume); expected a mass per area, such as g/m^2, gsm or oz/yd^2"]),
    (case('"0.32 kg/m^2"', '"30 tex"'), ["(a mass per length); expected a mass per area"]),
    (case('"1.2 MPa"', '"1.2 mpa"'), ["\"mpa\" can be mPa or MPa"]),
    (case('"1.2 MPa"', '"25 cN/cm"'), ["(a force per length); expected a force per area, such as Pa, kPa or psi"]),
    (case('"1.2 MPa"', '"200 cN/tex"'), ["expected a force per area"]),
    (case('"1e-5 N m"', '"0.1 gf cm"'), None),
    (case('"1e-5 N m"', '"0.1 gf cm2"'), ["expected a moment, such as N m, uNm or gf cm"]),
    (case('"1e-5 N m"', '"1 N/m s"'), ["write parentheses around a product"]),
    (case('"0.1 s"', '"0.1 sec ond"'), [":10: time.duration: "]),
    (case('"0.1 s"', '"0,1,2 s"'), ["commas between its digits"]),
    (card('"320 g/m^2"', '320'), [":3: weight: 320 has no unit"]),
    (card('"0.172 gf cm^2/cm"', '"0.172"'), [":6: bending.B: \"0.172\" has no unit"]),
    (card('"1.5 gf/(cm deg)"', '"1.5 gf/cm deg"'), [":5: shear.G: ", ]),
    (card('"1.5 gf/(cm deg)"', '"1.5 gf/cm"'), ["(a force per length); expected a force per length and angle"]),
    (card('"5.5 %"', '"5.5 mm"'), [":4: tensile.EMT: "]),
    # several at once
    (case('"1.2 MPa", "poisson": 0.1', '"1.2 mm", "poisson": 3'), [":6: fabric.young", ":6: fabric.poisson"]),
    (("case.json", CASE.replace('"cells_u": 4, "cells_v": 4', '"cells_u": 0, "cells_v": "4"').replace("0.8 mm", "-1 mm")
      .replace('"u0"', "3")), [":3: garment.sheet.cells_u", ":3: garment.sheet.cells_v", ":5: fabric.thickness: -1 mm",
                               ":9: supports[0].fixed.edge"]),
    (card('"0.8 mm", "weight": "320 g/m^2"', '0.8, "weight": "320"'), [":3: thickness", ":3: weight"]),
    # keys
    (case('"poisson"', '"poison"'), ["fabric.poison: unknown key; did you mean \"poisson\"?"]),
    (case('"name"', '"//": "my first case", "name"'), [":2: //: unknown key"]),
    (case('"name": "sheet"', '"name": "sheet", "friction": 0.2'), ["\"friction\" belongs under contact"]),
    (case('"poisson"', '"friction": 0.2, "poisson"'), ["\"friction\" belongs under contact"]),
    (case('"thickness"', '"gravity": [0, 0, 0], "thickness"'), ["\"gravity\" belongs at the top of the file"]),
    (case('"garment": {', '"garment": {"inseam": "10 cm", '), ["\"inseam\" belongs under garment.shorts"]),
    (case('"name": "sheet"', '"name": "sheet", "material": {}'), ["cases of \"kind\" static, dynamic or modal have it"]),
    (case('"name": "sheet"', '"name": "sheet", "weft": {}'), ["cases of \"kind\" cell have it"]),
    (card('"MIU"' if '"MIU"' in CARD else '"name"', '"nam"'), ["did you mean \"name\"?"]),
    # files that are none, or of another sort
    (("empty.json", ""), ["empty.json: the file is empty"]),
    (("list.json", "[1, 2]"), ["list.json:1: expected an object"]),
    (("page.json", "<!DOCTYPE html><html></html>"), ["page.json:1: "]),
    (("comment.json", "// my case\n" + CASE), ["comment.json:1: "]),
    (("trailing.json", CASE.replace('"0.1 s"}', '"0.1 s"},')), ["trailing.json:11: "]),
    (("single.json", "{'name': 1}"), ["single.json:1: "]),
    (("excel.csv", "thickness;0,8 mm\n"), ["files that are checked are JSON, or end in .mot, .sto"]),
    (("body.step", "ISO-10303-21;\nHEADER;\n"), ["files that are checked are JSON, or end in .mot, .sto"]),
    (("body.json", (LIBRARY / "arm_body.json").read_text()), ["is a body file; it is checked with its URDF"]),
    (("summary.json", '{"name": "x", "case_hash": "0", "timings": {}}'), ["is the summary of a run; check the folder"]),
    (("case.schema.json", '{"$schema": "https://json-schema.org/draft/2020-12/schema", "properties": {}}'), ["is a JSON Schema"]),
    (("old.json", '{"format": "gambeson pattern 9", "name": "x", "panels": []}'), ["old.json:1: format"]),
    (("cut.mot", MOT.replace("0.1\t2", "0.1")), ["cut.mot:9"]),
    (("twice.mot", MOT.replace("0.1\t2", "0\t2")), ["twice.mot:9"]),
    (("a.bvh", "HIERARCHY\nROOT hips\n{\n"), ["a.bvh:"]),
    (("a.trc", "nothing\n"), ["a.trc"]),
    (("a.obj", "v 0 0 0\n"), ["a.obj"]),
    (("far.obj", OBJ.replace("f 1 2 3", "f 1 2 9")), ["far.obj"]),
    (("far.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 9\n"), ["far.ply: face 1: names a vertex"]),
    (("a.urdf", "<robot name='x'/>"), ["a.urdf:1"]),
    (("g.json", '{"format": "gambeson garment 1", "name": "", "patches": [], "seams": []}'), ["g.json: patches"]),
    (("l.law.json", (LIBRARY / "laws/spun.law.json").read_text().replace('"J/m^2"', '"kJ/m^2"')), ["l.law.json:"]),
    (("s.study.json", '{"name": "x", "case": "none.json", "axes": []}'), ["s.study.json:1: case"]),
]
# What works, and what `check` calls it.
TAKEN = [
    (("case.json", CASE), "case.json: valid"),
    (("case.json", CASE.replace('"name"', '"$schema": "x.json", "name"', 1)), "case.json: valid"),
    (("a.card.json", CARD), "fabric card, valid"),
    (("a.card.json", CARD.replace('"name"', '"$schema": "x.json", "name"', 1)), "fabric card, valid"),
    (("a.mot", MOT), "recorded motion of OpenSim, valid"),
    (("a.obj", OBJ), "triangle mesh, valid"),
    (("a.law.json", (LIBRARY / "laws/spun.law.json").read_text()), "law table, valid"),
    (("a.json", (LIBRARY / "garments/capped_sleeve.json").read_text()), "garment, valid"),
    (("a.json", (LIBRARY / "garments/capped_sleeve.json").read_text().replace("{", '{"$schema": "x.json", ', 1)), "garment, valid"),
]
# What is read, with a warning.
UNUSUAL = [
    (case('"0.8 mm"', '"40 mm"'), ":5: fabric.thickness: 40 mm is unusual: fabrics have >= 0.02 and <= 20 mm"),
    (case('"1.2 MPa"', '"210 GPa"'), ":6: fabric.young: 210 GPa is unusual"),
    (case('"surface_density": "0.32 kg/m^2"', '"density": 0.32'), ":5: fabric.density: 0.32 kg/m^3 is unusual"),
    (card('"320 g/m^2"', '"0.32 g/m^2"'), ":3: weight: 0.32 g/m^2 is unusual"),
]


def at(tree, path):
    for key in path.split("."):
        tree = tree[key]
    return tree


def looked_at(folder, file, *options):
    (folder / file[0]).write_text(file[1])
    return run("check", file[0], *options, cwd=folder, timeout=60)


def wrong_with_results(folder):
    """A run that is warned of leaves the warning in its log, its summary and its page; its folder is known for what it is."""
    (folder / "thick.json").write_text(UNUSUAL[0][0][1].replace('"0.1 s"', '"20 ms"'))
    done = run("run", "thick.json", "--out", "thick", cwd=folder, timeout=300)
    if done.returncode != 0:
        return [f"run gave {done.returncode}: {done.stderr}"]
    wrong = []
    for name, text in {"log": done.stderr, "summary": (folder / "thick/summary.json").read_text(),
                       "page": (folder / "thick/report.html").read_text()}.items():
        if "fabric.thickness: 0.04 m is unusual" not in text:
            wrong.append(f"the {name} does not say what is unusual")
    sound = run("check", "thick", cwd=folder)
    if sound.returncode != 0 or "thick: results of worn cloth, 1 frame at 0.02 s, valid" not in sound.stdout:
        wrong.append(f"a folder of results: {sound.stdout}{sound.stderr}")
    case = folder / "thick/case.json"
    case.write_text(case.read_text().replace("0.04", "0.05"))
    damaged = run("check", "thick", cwd=folder)
    if damaged.returncode != 2 or "case.json" not in damaged.stderr:
        wrong.append(f"a damaged folder: {damaged.returncode} {damaged.stdout}{damaged.stderr}")
    (folder / "nothing").mkdir()
    none = run("check", "nothing", cwd=folder)
    if none.returncode != 2 or "has no case.json" not in none.stderr:
        wrong.append(f"a folder of nothing: {none.returncode} {none.stderr}")
    return wrong


def main():
    wrong = []
    with Folder() as folder:
        for text, key, si in LAB:
            done = looked_at(folder, ("case.json", CASE.replace(PLACES[key], text if key != "poisson" else f'"poisson": {text}')), "--full")
            key = {"young": "young_weft", "surface_density": "density"}.get(key, key)
            if done.returncode != 0:
                wrong.append(f"{text}: {done.stderr}")
                continue
            fabric = json.loads(done.stdout)["fabric"]
            found = at(fabric, key if key != "bending.rigidity" else "bending.rigidity_weft"
                       if "rigidity_weft" in fabric["bending"] else key)
            si = si / 0.8e-3 if key == "density" else si
            if abs(found - si) > 1e-9 * si:
                wrong.append(f"{text}: gave {found}, not {si}")
        for text, old in CARD_LAB:
            done = looked_at(folder, card(old, text))
            if done.returncode != 0:
                wrong.append(f"{text}: {done.stderr}")
        for file, expected in REFUSED:
            done = looked_at(folder, file)
            lines = done.stderr.strip().splitlines()
            status = 0 if expected is None else 2
            if done.returncode != status:
                wrong.append(f"{file[0]} for {expected}: gave {done.returncode}: {done.stdout}{done.stderr}")
            elif expected and (len(lines) != len(expected) or any(
                    part not in line or file[0] not in line for part, line in zip(expected, lines))):
                wrong.append(f"{file[0]}: expected {expected}, got {lines}")
        for file, expected in TAKEN:
            done = looked_at(folder, file)
            if done.returncode != 0 or expected not in done.stdout or "unusual" in done.stderr:
                wrong.append(f"{file[0]}: expected {expected}, got {done.returncode} {done.stdout}{done.stderr}")
        for file, expected in UNUSUAL:
            done = looked_at(folder, file)
            if done.returncode != 0 or expected not in done.stderr:
                wrong.append(f"{file[0]}: expected {expected}, got {done.returncode} {done.stdout}{done.stderr}")
        wrong += wrong_with_results(folder)
    for text in wrong:
        print(text, file=sys.stderr)
    check(not wrong, f"{len(wrong)} of {len(LAB) + len(CARD_LAB) + len(REFUSED) + len(TAKEN) + len(UNUSUAL)}")
    print(f"{len(LAB) + len(CARD_LAB)} values of laboratories, {len(REFUSED)} inputs refused, {len(TAKEN)} taken, "
          f"{len(UNUSUAL)} warned of")


if __name__ == "__main__":
    main()
