#!/usr/bin/env python3
"""GarmentCode's shirt and jumpsuit on the body that they were drafted for: imported, sewn around it, worn.

    garmentcode.py GAMBESON CROSSINGS_CHECK DATA [NAME ...]

Standing and for a stride (the jumpsuit's with "newton", which solves what sweeps leave of its strips of 2.4 mm between a dart and an
armhole), both as triangles, and the shirt standing as NURBS too: all checks of their runs are met, and
what is recorded in double precision crosses nothing; of frames in single precision, in which cloth that lies on a corner
of the skin may be rounded into it, the pairs are printed. Skipped where the public files are not (DATA/real).
"""

import json
import pathlib
import re
import subprocess
import sys

from common import SKIPPED, Folder, check, run

DATA = pathlib.Path(sys.argv[3]).resolve() / "real"
FABRIC = {"thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa", "poisson": 0.3,
          "bending": {"law": "linear", "rigidity": "10 uNm"}}
TRIANGLES = {"model": "triangles", "bending_elements": "quadratic"}
SHIRT, JUMPSUIT = "garmentcode_shirt_mean", "garmentcode_jumpsuit_mean_all"
STAND, STRIDE = {"stand": {"duration": "0.2 s"}}, {"walk": {"strides": 1}}
CASES = {"shirt": (SHIRT, TRIANGLES, STAND), "shirt_nurbs": (SHIRT, {}, STAND), "jumpsuit": (JUMPSUIT, TRIANGLES, STAND),
         "jumpsuit_stride": (JUMPSUIT, TRIANGLES, STRIDE), "shirt_stride": (SHIRT, TRIANGLES, STRIDE)}


def case(name, folder):
    file, model, motion = CASES[name]
    done = run("import", DATA / f"garment/{file}_specification.json", "-o", folder / f"{name}.json")
    check(done.returncode == 0, f"import of {file}: {done.stderr}")
    pattern = json.loads((folder / f"{name}.json").read_text()) | {"placing": "regions"}
    (folder / f"{name}.json").write_text(json.dumps(pattern))
    path = folder / f"{name}.case.json"
    path.write_text(json.dumps({
        "name": name, "garment": {"pattern": {"path": f"{name}.json", "cell": "40 mm", "close_within": "4 s"}} | model, "fabric": FABRIC,
        "human": {"scan": {"file": str(DATA / "body/garmentcode_mean_all.obj"), "bridge_folds": "10 mm"},
                  "motion": motion},
        "contact": {"friction": 0.3, "newton": name == "jumpsuit_stride"}, "dressing": {"layer_by_layer": True, "settle": "0.5 s"}, "output": {"pictures": []}}))
    return path


def main():
    if not DATA.exists():
        print(f"skipped: no {DATA}")
        sys.exit(SKIPPED)
    with Folder() as folder:
        for name in sys.argv[4:] or CASES:
            path = case(name, folder)
            done = run("run", path, "--out", folder / name)
            check(done.returncode == 0, f"{name} gave {done.returncode}: {done.stderr}")
            missed = [line for line in done.stderr.splitlines() if line.startswith("check not met")]
            check(not missed, f"{name}: {missed}")
            crossed = subprocess.run([sys.argv[2], folder / name], capture_output=True, text=True)
            frames = re.findall(r"^ +(-?[0-9.]+) +(single|double) +([0-9]+) +([0-9]+)", crossed.stdout, re.M)
            check(len(frames) > 30, f"{name}: {crossed.stdout}{crossed.stderr}")
            pairs = {kind: [(at, int(a) + int(b)) for at, k, a, b in frames if k == kind and int(a) + int(b)]
                     for kind in ("single", "double")}
            check(not pairs["double"], f"{name} crosses: {pairs}")
            print(name, f"{len(frames)} frames, pairs: {pairs}", *missed, sep="\n  ")


main()
