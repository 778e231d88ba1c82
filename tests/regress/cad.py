#!/usr/bin/env python3
"""CAD files, imported and compared with OpenCASCADE itself, which reads them by a way of its own: number of faces, areas and
lengths of shared edges within 0.1 %.

    cad.py GAMBESON CAD_CHECK

CAD_CHECK makes boxes, cylinders, tori and panels as STEP, IGES and .brep; files of others are in the public data. Broken files
of each format must give exit 2, and say the file and a way out.
"""

import math
import os
import pathlib
import re
import subprocess
import sys
import json

import iges_text
from common import SOURCE, Folder, check, run

DATA = pathlib.Path(os.environ.get("GAMBESON_DATA", SOURCE / ".." / "shared" / "data")).resolve() / "real" / "cad"
WITHIN = 1e-3
ROW = re.compile(r"(\S+) +([0-9.e+-]+) +(.*)")


def reference(*arguments):
    done = subprocess.run([sys.argv[2], *map(str, arguments)], capture_output=True, text=True)
    check(done.returncode == 0, f"cad_check {arguments}: {done.stderr}")
    return done.stdout.strip().split("\n")[-1]


def said(out):
    """Areas [mm^2] and lengths of seams [mm] as the command prints them."""
    table = re.split(r"\n(?:panel|patch) ", out, maxsplit=1)[1].split("\n\n")[0].split("\n")[1:]
    areas = [100 * float(ROW.match(row).group(2)) for row in table]
    seams = re.findall(r"^s\d+ +([0-9.e+-]+) ", out, re.M)
    return areas, [10 * float(s) for s in seams]


def far(found, wanted, least):
    """The worst of two lists, sorted, in parts of the number; printed digits are no error."""
    check(len(found) == len(wanted), f"{len(found)} in place of {len(wanted)}: {found} {wanted}")
    return max([max(0, abs(a - b) - least) / b for a, b in zip(sorted(found), sorted(wanted))], default=0)


def compare(file, folder, areas=None, seams=None):
    out = folder / (file.name + ".json")
    done = run("import", file, "-o", out)
    check(done.returncode == 0, f"{file.name}: {done.returncode} {done.stderr}")
    found = said(done.stdout)
    wanted = json.loads(reference("read", file))
    worst = [far(found[0], areas or wanted["areas_mm2"], 0.05 if "panel " in done.stdout else 0),
             far(found[1], seams or wanted["seams_mm"], 0.005 if "panel " in done.stdout else 0)]
    check(max(worst) <= WITHIN, f"{file.name}: areas and seams {worst} off")
    print(f"{file.name}: {len(found[0])} faces, {len(found[1])} seams; areas at most {100 * worst[0]:.4f} %, lengths {100 * worst[1]:.4f} % off")


def broken(folder):
    """Files that are no good, with what their message must say."""
    box = {end: (folder / f"box.{end}").read_bytes() for end in ("step", "igs", "brep")}
    step, igs, brep = (box[end].decode() for end in ("step", "igs", "brep"))
    lines = igs.split("\n")
    yield "empty.step", b"", "is no STEP file"
    yield "empty.igs", b"", "is no IGES file"
    yield "empty.brep", b"", "is no .brep file"
    yield "binary.step", bytes(range(256)) * 40, "is no STEP file"
    yield "binary.igs", bytes(range(256)) * 40, "is no IGES file"
    yield "binary.brep", bytes(range(256)) * 40, "is no .brep file"
    yield "half.step", box["step"][:len(step) // 2], ""
    yield "half.igs", box["igs"][:len(igs) // 2], ""
    yield "half.brep", box["brep"][:len(brep) // 2], ""
    yield "other.step", box["igs"], "is no STEP file"
    yield "other.igs", box["step"], ""
    yield "other.brep", box["step"], "is no .brep file"
    yield "curve.step", (folder / "curve.step").read_bytes(), "has no faces"
    yield "curve.igs", (folder / "curve.igs").read_bytes(), "has no faces"
    yield "curve.brep", (folder / "curve.brep").read_bytes(), "has no faces"
    yield "unit.step", re.sub(r"\( LENGTH_UNIT\(\)[^;]*;", "( LENGTH_UNIT() NAMED_UNIT(*) );", step).encode(), "unit"
    yield "far.step", re.sub(r"CARTESIAN_POINT\('',\(100\.,", "CARTESIAN_POINT('',(1.E+09,", step).encode(), ""
    yield "headless.step", step[step.index("DATA;"):].encode(), ""
    yield "unit.igs", "\n".join(line.replace(",2,2HMM,", ",77,2HMM,") for line in lines).encode(), "unit flag"
    yield "many.brep", re.sub(r"TShapes \d+", "TShapes 2000000000", brep).encode(), ""
    yield "facet.stp", b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n", ""


def main():
    with Folder() as folder:
        reference("make", folder)
        pipe, disc = 2 * math.pi * 50 * 200, math.pi * 50 * 50
        rim = 2 * math.pi * 50
        for end in ("step", "igs", "brep"):
            compare(folder / f"box.{end}", folder, [6000, 6000, 3000, 3000, 1800, 1800], [100] * 4 + [60] * 4 + [30] * 4)
            compare(folder / f"cylinder.{end}", folder, [pipe, disc, disc], [rim, rim, 200])
            for name in ("panels", "pierced", "torus"):
                compare(folder / f"{name}.{end}", folder)
        compare(folder / "box_inch.step", folder, [6000, 6000, 3000, 3000, 1800, 1800], [100] * 4 + [60] * 4 + [30] * 4)
        slant, small = math.pi * 70 * math.hypot(100, 30), math.pi * 20 * 20
        ball = 4 * math.pi * 50 * 50
        for end in ("step", "igs", "brep"):
            compare(folder / f"cone.{end}", folder, [slant, disc, small])
            compare(folder / f"tip.{end}", folder, [math.pi * 50 * math.hypot(100, 50), disc])
            compare(folder / f"sphere.{end}", folder, [ball])
            for name in ("dome", "leaf", "drawn", "turned", "vase"):
                compare(folder / f"{name}.{end}", folder)
            compare(folder / f"assembly.{end}", folder, 2 * [6000, 6000, 3000, 3000, 1800, 1800], 2 * ([100] * 4 + [60] * 4 + [30] * 4))
        compare(folder / "assembly_inch.step", folder, 2 * [6000, 6000, 3000, 3000, 1800, 1800])
        for unit in ("MM", "INCH", "M"):
            for name in (f"ap203_{unit}.step", f"ap214_{unit}.step", f"ap242_{unit}.step", f"iges144_{unit}.igs", f"iges186_{unit}.igs"):
                compare(folder / name, folder, [pipe, disc, disc], [rim, rim, 200])
        for name, text, areas in iges_text.files():
            (folder / name).write_text(text)
            compare(folder / name, folder, areas)
        real = sorted(p for p in DATA.glob("*") if p.suffix in (".igs", ".iges", ".brep"))
        if not real:
            print(f"no public data at {DATA}: only files of our own making", file=sys.stderr)
        for file in real:
            compare(file, folder)
        count = 0
        for name, content, words in broken(folder):
            (folder / name).write_bytes(content)
            done = run("import", folder / name, "-o", folder / "never.json")
            check(done.returncode == 2 and name in done.stderr and words in done.stderr and len(done.stderr) < 400,
                  f"{name}: {done.returncode} {done.stderr or done.stdout}")
            check(not (folder / "never.json").exists(), f"{name}: something was written")
            if "-v" in sys.argv:
                print(done.stderr.strip().replace(str(folder) + "/", ""))
            count += 1
        print(f"{count} broken files: refused")


if __name__ == "__main__":
    main()
