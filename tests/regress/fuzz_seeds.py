"""Small good files of every kind that the program reads, for fuzz.py to break: one scene for each kind."""

import functools
import json
import math
import struct

import fuzz_bodies
import fuzz_scans
import iges_text
from common import SOURCE, Folder, run

LIBRARY = SOURCE / "cases/library"

CLOTH = """{
  "name": "cloth",
  "garment": {"sheet": {"width": "20 cm", "height": "20 cm", "cells_u": 4, "cells_v": 4, "axis_v": [0, 0, 1]}},
  "fabric": {"thickness": "1 mm", "density": "436 kg/m^3", "young": "1.2 MPa", "poisson": 0.1, "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  %s
  "contact": {"friction": 0.1},
  "time": {"duration": "10 ms"},
  "output": {"window": "5 ms", "frame": "5 ms", "checkpoint": "10 ms", "pictures": []}
}
"""
HUMAN = '"human": {%s}, "dressing": {"settle": 0}, "supports": [{"fixed": {"edge": "v1"}}],'
OBSTACLE = '"obstacles": [{"name": "ball", "mesh": {"file": "%s", "position": [0, 0, -2]}}], "supports": [{"fixed": {"edge": "v1"}}],'

ARM = '"urdf": "arm.urdf", "body": "body.json", "motion": {"trajectory": {"file": "flex.csv"}}'
RECORDED = '"manikin": "male_p50", "motion": {"file": {"path": "%s"%s}}'

PLATE = """{
  "kind": "static", "name": "plate",
  "sheet": {"plate": {"width": 2, "height": 1}, "degree": 2, "cells_u": 4, "cells_v": 3,
            "trim": [{"circle": {"center": [0.5, 0.5], "radius": 0.2}}, {"polygon": {"points": [[1.2, 0.3], [1.6, 0.3], [1.6, 0.7]]}}],
            "fields": [{"patch": 0, "thickness": {"degree": 1, "values": [[1, 1.5], [1, 1.5]]}}]},
  "material": {"isotropic": {"young": "1 MPa", "poisson": 0.3, "thickness": "1 cm", "density": 1000}},
  "supports": [{"edge": "u0", "hold": "xyz", "clamp": true}, {"edge": "u1", "hold": "z", "move": [0, 0, 0.01], "program": "up"}],
  "loads": [{"gravity": [0, 0, -0.1]}, {"point": [1, 0.5], "force": [0, 0.1, 0]}],
  "programs": {"up": [[0, 0], [0.5, 1], [1, 1]]},
  "solver": {"steps": 2},
  "output": {"points": [{"name": "tip", "point": [1, 0.5]}], "edges": [{"name": "root", "edge": "u0"}], "pictures": []}
}
"""
DISC = """{
  "kind": "modal", "name": "disc",
  "sheet": {"nurbs": {"patches": [{"degree": [2, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
    "points": [[-0.7, -0.7, 0], [0, -1.4, 0], [0.7, -0.7, 0], [-1.4, 0, 0], [0, 0, 0.1], [1.4, 0, 0], [-0.7, 0.7, 0], [0, 1.4, 0], [0.7, 0.7, 0]],
    "weights": [1, 0.7, 1, 0.7, 1, 0.7, 1, 0.7, 1]}]}, "degree": 3, "split": 3},
  "material": {"laminate": {"plies": [{"thickness": 0.001, "young1": 3300, "young2": 1100, "shear": 660, "poisson12": 0.25, "angle": "30 deg"}], "density": 1000}},
  "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "v1", "hold": "xyz"}],
  "solver": {"count": 3}, "output": {"pictures": []}
}
"""
FALL = """{
  "kind": "dynamic", "name": "fall",
  "sheet": {"cylinder": {"radius": 0.1, "length": 0.2, "end_angle": "90 deg"}, "cells_u": 3, "cells_v": 3},
  "material": {"fabric": {"thickness": "1 mm", "density": "436 kg/m^3", "young": "1.2 MPa", "poisson": 0.1, "bending": {"law": "linear", "rigidity": "1e-4 N m"}}},
  "supports": [{"edge": "v0", "hold": "xyz"}], "loads": [{"gravity": [0, 0, -9.81]}],
  "solver": {"scheme": "explicit", "end": "5 ms"}, "output": {"pictures": []}
}
"""
CELL = """{
  "kind": "cell", "name": "cell", "weave": {"pattern": "twill", "over": 2, "under": 1},
  "weft": {"spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.2 mm", "half_thickness": "0.16 mm", "moduli": {"young": "8 GPa", "axial_shear": "0.4 GPa"}},
  "warp": {"spacing": "1.2 mm", "amplitude": "0.16 mm", "half_width": "0.2 mm", "half_thickness": "0.16 mm",
           "section": {"stretch": 1000, "shear_across": 50, "shear_through": 40, "torsion": 1e-6, "bending_through": 3e-6, "bending_in_plane": 5e-6}},
  "compression": {"half_force": "10 N", "exponent": 3}, "height": "0.64 mm",
  "loads": [{"name": "both", "biaxial": {"extension": 0.02, "ratio": 0.5}, "steps": 1},
            {"name": "turned", "trellis": {"angle": "10 deg", "extension": 0.02}, "steps": 1, "cycles": 1}],
  "bars": [{"name": "two", "lengths": [0.5, 0.5], "young": [1e9, 3e9]}],
  "solver": {"pieces_per_spacing": 6}, "output": {"shapes": "none"}
}
"""
STUDY = """{
  "name": "slip", "case": "cloth.json",
  "axes": [{"path": "factors.thickness", "values": [0.5, 1]},
           {"name": "mesh", "sets": [{"garment.sheet.cells_u": 3}, {"garment.sheet.cells_u": 4}], "labels": ["coarse", "fine"]}],
  "variants": [{"label": "slow", "at": {"mesh": "fine"}, "set": {"time.max_step": "0.1 ms"}}],
  "uncertainty": {"runs": 12, "seed": 2, "spread": {"bending": "10 %", "friction": 0.2}, "finer": 1.5, "step_duration": "10 ms"}
}
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
WORN = ("v 0 0 0\nv 0.2 0 0\nv 0.2 0.2 0\nv 0 0.2 0\nv 0.4 0 0.1\nv 0.4 0.2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\n"
        "g front\nf 1/1 2/2 3/3 4/4\ng back\nf 2/2 5/5 6/6 3/3\ng edge hem front\nl 1 2\n")
TRIANGLES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]


def stl():
    return b" " * 80 + struct.pack("<I", 4) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *[x for k in t for x in CORNERS[k]], 0) for t in TRIANGLES)


def gltf(uri):
    points = b"".join(struct.pack("<3f", *CORNERS[k]) for t in TRIANGLES for k in t)
    buffer = {"byteLength": len(points)}
    if uri:
        buffer["uri"] = uri
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [1]}, {"name": "end"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}],
            "bufferViews": [{"buffer": 0, "byteLength": len(points)}], "buffers": [buffer]}, points


def glb(scene, points):
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    points += b"\0" * (-len(points) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(points), len(text), 0x4E4F534A) + text + struct.pack(
        "<II", len(points), 0x004E4942) + points


COORDINATES = ["pelvis_tilt", "pelvis_list", "pelvis_rotation", "pelvis_tx", "pelvis_ty", "pelvis_tz", "hip_flexion_r", "hip_adduction_r", "hip_rotation_r",
               "knee_angle_r", "ankle_angle_r", "hip_flexion_l", "hip_adduction_l", "hip_rotation_l", "knee_angle_l", "ankle_angle_l",
               "lumbar_extension", "lumbar_bending", "lumbar_rotation"]


def rows(paths):
    lines = []
    for k in range(12):
        t = 0.05 * k
        value = {"pelvis_tx": t, "pelvis_ty": 0.95, "hip_flexion_r": 20 * math.sin(5 * t), "hip_flexion_l": -20 * math.sin(5 * t), "knee_angle_r": -10}
        unit = math.pi / 180 if paths else 1
        lines.append("\t".join([f"{t:g}"] + [f"{value.get(c, 0) * (1 if '_t' in c and c != 'pelvis_tilt' else unit):.6g}" for c in COORDINATES]))
    return "\n".join(lines) + "\n"


def mot():
    return "walk\ndatacolumns 20\ndatarows 12\nrange 0 0.55\nendheader\n" + "\t".join(["time"] + COORDINATES) + "\n" + rows(False)


def sto():
    names = [f"/jointset/joint/{c}/value" for c in COORDINATES]
    return "walk\nversion=1\nnRows=12\nnColumns=20\ninDegrees=no\nendheader\n" + "\t".join(["time"] + names) + "\n" + rows(True)


def bvh():
    """Woody (human/data/map_snu_woody.json), whose feet end in end sites, channels in capitals."""
    tree = ("Hips", (0, 95, 0), [
        ("Spine", (0, 10, 0), [("Spine1", (0, 15, 0), [
            ("HEad", (0, 30, 0), []),
            ("LeftArm", (18, 25, 0), [("LeftForeArm", (28, 0, 0), [("LeftHand", (25, 0, 0), [])])]),
            ("RightArm", (-18, 25, 0), [("RightForeArm", (-28, 0, 0), [("RightHand", (-25, 0, 0), [])])])])]),
        ("LeftUpLeg", (9, -5, 0), [("LeftLeg", (0, -42, 0), [("LeftFoot", (0, -40, 0), [("LeftToes", (0, -6, 14), [])])])]),
        ("RightUpLeg", (-9, -5, 0), [("RightLeg", (0, -42, 0), [("RightFoot", (0, -40, 0), [("RightToes", (0, -6, 14), [])])])])])
    count = 0

    def write(node, word, pad):
        nonlocal count
        name, offset, children = node
        count += 6 if word == "ROOT" else 3
        channels = "6 XPOSITION YPOSITION ZPOSITION ZROTATION XROTATION YROTATION" if word == "ROOT" else "3 Zrotation Xrotation Yrotation"
        text = f"{pad}{word} {name}\n{pad}{{\n{pad} OFFSET {offset[0]} {offset[1]} {offset[2]}\n{pad} CHANNELS {channels}\n"
        for c in children:
            text += write(c, "JOINT", pad + " ")
        if not children:
            text += f"{pad} End Site\n{pad} {{\n{pad}  OFFSET 0 0 5\n{pad} }}\n"
        return text + pad + "}\n"

    head = "HIERARCHY\n" + write(tree, "ROOT", "")
    frames = [" ".join([str(x) for x in (0, 95, 2 * k)] + [f"{2 * math.sin(k + i):.3f}" for i in range(count - 3)]) for k in range(8)]
    return head + "MOTION\nFrames: 8\nFrame Time: 0.05\n" + "\n".join(frames) + "\n"


def trc():
    points = {"RHJC": (0, 0.9, 0.08), "LHJC": (0, 0.9, -0.08), "RKJC": (0.02, 0.5, 0.08), "LKJC": (0.02, 0.5, -0.08), "RAJC": (0, 0.1, 0.08),
              "LAJC": (0, 0.1, -0.08), "RHEE": (-0.05, 0.03, 0.08), "LHEE": (-0.05, 0.03, -0.08), "RTOE": (0.15, 0.03, 0.08),
              "LTOE": (0.15, 0.03, -0.08), "SACR": (-0.1, 0.95, 0), "RTHI": (0.01, 0.7, 0.16), "LTHI": (0.01, 0.7, -0.16)}
    head = ("PathFileType\t4\t(X/Y/Z)\twalk.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n20\t20\t8\t13\tm\nFrame#\tTime\t"
            + "\t\t\t".join(points) + "\n\t\t" + "\t".join(f"X{k}\tY{k}\tZ{k}" for k in range(1, 14)) + "\n")
    lines = []
    for k in range(8):
        cells = [str(k + 1), f"{0.05 * k:g}"]
        for x, y, z in points.values():
            cells += [f"{x + 0.02 * k:.4f}", f"{y:.4f}", f"{z:.4f}"]
        lines.append("\t".join(cells))
    return head + "\n".join(lines) + "\n"


GARMENT = """{"format": "gambeson garment 1", "name": "two squares",
 "patches": [
  {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "weft": [1, 0, 0], "points_m": [[0, 0, 0], [0.2, 0, 0], [0, 0.2, 0], [0.2, 0.2, 0]]},
  {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "weft": [1, 0, 0], "points_m": [[0.2, 0, 0], [0.4, 0, 0], [0.2, 0.2, 0], [0.4, 0.2, 0.1]]}],
 "seams": [{"a": {"patch": 0, "side": "u1"}, "b": {"patch": 1, "side": "u0"}, "kind": "C0", "stiffness_N": 0.01}],
 "edges": [{"name": "left", "of": [{"patch": 0, "side": "u0"}]}]}
"""


def wearing(garment):
    start = CLOTH.index('"garment"')
    end = CLOTH.index('\n  "fabric"')
    return CLOTH[:start] + f'"garment": {garment},' + CLOTH[end:]


CHARACTER = '"character": {"file": "%s"%s}, "motion": {"stand": {"duration": "20 ms"}}'
MAKEHUMAN = ', "skeleton": "a.mhskel", "weights": "a.mhw", "targets": [{"file": "wide.target", "share": 0.5}]'
SCAN = '"scan": {"file": "%s"%s}, "motion": {"stand": {"duration": "10 ms"}}'
MANIKIN = '"manikin": "male_p50", "motion": {"stand": {"duration": "10 ms"}}'
SEQUENCE = ('"obstacles": [{"name": "ball", "sequence": {"folder": "frames", "rate": "100 Hz", "scale": 0.1}}], '
            '"supports": [{"fixed": {"edge": "v1"}}],')
SLIP = {"name": "slip", "case": "cloth.json", "axes": [{"path": "contact.friction", "values": [0, 1], "labels": ["0", "1"]}], "pictures": []}
STRIP = {"id": "strip", "title": "a strip", "source": "closed form", "doc": "none", "quick": True, "why": "an example", "case": {
    "kind": "static", "name": "strip", "sheet": {"plate": {"width": 10, "height": 1}, "degree": 3, "cells_u": 4, "cells_v": 1},
    "material": {"isotropic": {"young": 1.2e6, "poisson": 0, "thickness": 0.1}}, "supports": [{"edge": "u0", "hold": "xyz", "clamp": True}],
    "loads": [{"edge": "u1", "force": [0, 0, 1]}], "solver": {"steps": 4}, "output": {"points": [{"name": "tip", "point": [1, 0.5]}], "pictures": []}},
    "table": {"columns": ["part", "rise"], "rows": [[0.25, 0.66], [0.5, 1.31], [1, 2.49]]},
    "runs": [{"name": "a"}, {"name": "c", "set": {"sheet.cells_u": 5}}, {"name": "b", "set": {"sheet.cells_u": 6}, "time_limit": "1 min"}], "checks": [
        {"kind": "curve", "quantity": "rise", "run": "b", "also": ["a"], "x": {"column": "tip_uz_m", "reference": "rise"},
         "y": {"column": "factor", "reference": "part"}, "bound": 0.3},
        {"kind": "table", "quantity": "rise by rows", "run": "b", "x": {"column": "factor", "reference": "part"},
         "y": {"column": "tip_uz_m", "reference": "rise", "scale": 1}, "bound": 0.3},
        {"kind": "value", "quantity": "tip", "unit": "m", "of": {"runs": ["a", "b"], "reduce": "mean", "column": "tip_uz_m", "along": "factor", "at": 0.6},
         "minus": {"run": "a", "column": "tip_uz_m", "at": 0.5}, "at_least": 0},
        {"kind": "rate", "quantity": "order", "of": {"column": "tip_uz_m"}, "runs": ["a", "c", "b"], "sizes": [0.5, 0.25, 0.125], "reference": 2.5, "absolute": 100},
        {"kind": "history", "quantity": "likeness", "course": "correlation", "first": {"run": "a", "table": "path.csv", "columns": ["tip_uz_m"]},
         "second": {"run": "b", "table": "path.csv", "columns": ["tip_uz_m"]}, "from": 0.3, "to": 0.9, "at_least": 0.5}]}
EXAMPLES = {"id": "work", "title": "a work", "source": "nobody", "examples": [
    {"section": "1.2", "title": "a plate", "figures": ["3"], "tables": ["4"], "cases": ["../../case.json"], "doc": "none", "statements": [
        {"where": "table 4", "published": "1.8", "reference": "plate", "quantity": "area"}, {"where": "text", "published": "flat", "without": "none"}]}]}


GARMENTCODE = """{
  "pattern": {
    "panels": {
      "back": {"translation": [20, 0, -20], "rotation": [0, 0, 0], "label": "body", "vertices": [[0, 0], [0, 30], [20, 30], [20, 0]],
               "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3], "curvature": {"type": "quadratic", "params": [[0.5, 0.1]]}},
                         {"endpoints": [3, 0], "curvature": {"type": "cubic", "params": [[0.3, 0.1], [0.6, -0.1]]}}]},
      "front": {"translation": [10, 90, 25], "rotation": [0, 90, 0], "vertices": [[0, 0], [20, 0], [20, 30], [15, 30], [5, 30], [0, 30]],
                "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]},
                          {"endpoints": [3, 4], "curvature": {"type": "circle", "params": [5, 0, 0]}}, {"endpoints": [4, 5]}, {"endpoints": [5, 0]}]}
    },
    "stitches": [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 1}], [{"panel": "front", "edge": 5}, {"panel": "back", "edge": 3}, "right_wrong"]],
    "panel_order": ["front", "back"]
  },
  "properties": {"curvature_coords": "relative", "units_in_meter": 100}
}
"""


#: Files as OpenCASCADE writes them: a cylinder, and two panels of which one has a hole.
CAD = SOURCE / "tests/regress/cad_seeds"


def importing(name):
    return ["import", name, "-o", "written.json", "--svg", "written.svg"]


def dxf():
    """Two pieces as DXF-ASTM has them: one with a sew line, one with a bulge and a hole."""
    at = lambda x, y: f"10\n{x}\n20\n{y}\n"
    text = lambda words: f"0\nTEXT\n8\n1\n{at(50, 50)}40\n5\n1\n{words}\n"
    line = lambda layer, points: (f"0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n1\n"
                                  + "".join(f"0\nVERTEX\n8\n{layer}\n{at(x, y)}42\n{b}\n" for x, y, b in points) + f"0\nSEQEND\n8\n{layer}\n")
    point = lambda layer, x, y: f"0\nPOINT\n8\n{layer}\n{at(x, y)}"
    box = [(0, 0), (300, 0), (300, 200), (0, 200)]
    front = (text("PIECE NAME: FRONT") + text("SIZE: M") + text("QUANTITY: 1,1") + line(1, [(*p, 0) for p in box])
             + line(14, [(10, 10, 0), (290, 10, 0), (290, 190, 0), (10, 190, 0)]) + "".join(point(2, *p) for p in box)
             + point(4, 100, 0) + point(80, 290, 100) + point(13, 200, 150) + f"0\nLINE\n8\n7\n{at(150, 50)}11\n150\n21\n150\n")
    back = (text("PIECE NAME: BACK") + line(1, [(0, 0, 0), (0, 200, 0), (100, 200, -1), (200, 200, 0), (300, 200, 0), (300, 0, 0)])
            + f"0\nCIRCLE\n8\n11\n{at(150, 100)}40\n10\n")
    block = lambda name, content: f"0\nBLOCK\n8\n0\n2\n{name}\n70\n64\n{at(0, 0)}{content}0\nENDBLK\n8\n0\n"
    insert = lambda name: f"0\nINSERT\n8\n1\n2\n{name}\n{at(0, 0)}"
    return ("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" + block("F", front) + block("B", back)
            + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + insert("F") + insert("B") + text("STYLE NAME: s") + text("UNITS: METRIC") + "0\nENDSEC\n0\nEOF\n")


def uv_tube():
    """A garment of two panels, each a half of a tube of 8 sides: OBJ in cm with materials and uv."""
    points, uv, faces, side = "", "", "", 2 * 15 * math.sin(math.pi / 8)
    for half in (0, 1):
        faces += f"usemtl {('front', 'back')[half]}\n"
        for j in range(3):
            for i in range(5):
                angle = math.pi * (half + i / 4)
                points += f"v {15 * math.cos(angle):.6f} {15 * math.sin(angle):.6f} {20 * j}\n"
                uv += f"vt {(i if half == 0 else 4 - i) * side / 50:.6f} {20 * j / 50:.6f}\n"
        for j in range(2):
            for i in range(4):
                a = 15 * half + 5 * j + i + 1
                faces += "f " + " ".join(f"{k}/{k}" for k in (a, a + 1, a + 6, a + 5)) + "\n"
    return points + uv + faces


UV_PLY = ("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
          "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n0.2 0 0 1 0\n0.2 0.2 0 1 1\n0 0.2 0 0 1\n0.1 0.1 0.01 0.5 0.5\n"
          "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")


def dxf_parts():
    """A half with its border in parts, by a spline and an arc, in two nested sizes, and its mirror line, with rule numbers."""
    at = lambda x, y: f"10\n{x}\n20\n{y}\n"
    text = lambda words, layer=1: f"0\nTEXT\n8\n{layer}\n{at(5, 5)}40\n.25\n1\n{words}\n7\nSTANDARD\n"
    line = lambda layer, points: (f"0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n0\n" + "".join(f"0\nVERTEX\n8\n{layer}\n{at(*p)}" for p in points) + "0\nSEQEND\n")
    blocks = ""
    for size, w in (("36", 10), ("38", 11)):
        spline = "0\nSPLINE\n8\n1\n70\n8\n71\n2\n72\n6\n73\n3\n74\n0\n" + "".join(f"40\n{k}\n" for k in (0, 0, 0, 1, 1, 1))
        spline += "".join(f"{at(x, y)}30\n0\n" for x, y in ((w, 0), (w + 2, 6), (w, 12)))
        arc = f"0\nARC\n8\n1\n{at(0, 12)}40\n{w}\n50\n0\n51\n90\n"
        points = "".join(f"0\nPOINT\n8\n2\n{at(x, y)}" for x, y in ((0, 0), (w, 0), (w, 12), (0, 12 + w)))
        piece = (text("Piece Name: HALF") + text(f"SIZE: {size}") + text("# 12", 2) + line(1, [(0, 0), (w / 2, 0), (w, 0)]) + spline + arc
                 + line(1, [(0, 12 + w), (0, 0)]) + line(6, [(0, 0), (0, 12 + w)]) + points + f"0\nLINE\n8\n7\n{at(3, 1)}11\n3\n21\n9\n")
        blocks += f"0\nBLOCK\n8\n0\n2\nHALF_{size}\n70\n64\n{at(0, 0)}{piece}0\nENDBLK\n8\n0\n"
    return ("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + text("Sample Size: 36")
            + text("Units: ENGLISH") + "0\nENDSEC\n0\nEOF\n")


def lab_loop():
    """A raw loop of bending: curvature up, down, and up again."""
    way = [0.15 * i for i in range(-16, 17)]
    rows = [(k, 0.17 * k + 0.07 * sign) for sign, ks in ((1, way), (-1, way[::-1]), (1, way)) for k in ks]
    return "curvature_per_cm,moment_gf_cm_per_cm\n" + "".join(f"{k:.2f},{m:.5f}\n" for k, m in rows)


LAB_POINTS = """{"source": "a laboratory, 2026",
 "tension_weft": [[0.005, "10 N/m"], [0.01, "25 N/m"], [0.02, "80 N/m"], [0.04, "300 N/m"], [0.05, "490 N/m"]],
 "tension_warp": [[0.005, "12 N/m"], [0.01, "30 N/m"], [0.02, "95 N/m"], [0.04, "350 N/m"]]}
"""


class Kind:
    """One file to break among those beside it, and the commands that read it. `made`: a command that makes more files of those before the
    first of them is broken. `spoil`: what breaks it, of its bytes and chance, in place of changes of bytes."""

    def __init__(self, name, broken, files, main="case.json", run=False, command=None, made=None, spoil=None):
        self.name, self.broken, self.given, self.main, self.run = name, broken, files, main, run
        self.command = command or ["check", main]
        self.made, self.spoil = made, spoil

    @functools.cached_property
    def files(self):
        if not self.made:
            return self.given
        with Folder() as folder:
            for name, content in self.given.items():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
            done = run(*self.made, cwd=folder)
            if done.returncode != 0:
                raise RuntimeError(f"{self.name}: {' '.join(self.made)} gave {done.returncode}: {done.stderr}")
            return {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file()}


def kinds():
    arm = {"arm.urdf": (LIBRARY / "arm.urdf").read_text(), "body.json": (LIBRARY / "arm_body.json").read_text(),
           "flex.csv": "time_s,root_x_m,elbow_flexion_rad\n0,0,0\n0.1,0,0.2\n0.2,0,0.3\n"}
    on_arm = {"case.json": CLOTH % (HUMAN % ARM), **arm}
    recorded = lambda file, more="": {"case.json": CLOTH % (HUMAN % (RECORDED % (file, more)))}
    mesh = lambda file, content, **more: {"case.json": CLOTH % (OBSTACLE % file), file: content, **more}
    worn = lambda file, content: {"case.json": wearing('{"mesh_file": {"path": "%s"}, "model": "triangles"}' % file) % "", file: content}
    scene, points = gltf("a.bin")
    body, body_points = fuzz_bodies.character_gltf("a.bin")
    character = lambda file, more="", **files: {"case.json": CLOTH % (HUMAN % (CHARACTER % (file, more))), **files}
    scan = lambda file, content, more="": {"case.json": CLOTH % (HUMAN % (SCAN % (file, more))), file: content}
    scan_obj = fuzz_scans.obj(*fuzz_scans.surface())
    base, skeleton, weights, target = fuzz_bodies.makehuman()
    on_makehuman = character("a.obj", MAKEHUMAN, **{"a.obj": base, "a.mhskel": skeleton, "a.mhw": weights, "wide.target": target})
    on_subject = {**recorded("walk.trc", ', "model": "a.osim"'), "walk.trc": fuzz_bodies.trc_of_subject()}
    marker_map = (SOURCE / "human/data/map_gait2392_markers.json").read_text()
    frames = {f"frames/{k}.obj": OBJ.replace("0 0 1", f"0 0 {1 + 0.1 * k:g}").replace("v 0", "v 10") for k in range(3)}
    sequence = {"case.json": CLOTH % SEQUENCE, **frames}
    dressed_case = CLOTH % (HUMAN % MANIKIN)
    dressed = dict(main="dressed_case.json", made=["dress", "case.json", "-o", "dressed.json"])
    on_dressed = {"case.json": dressed_case, "dressed_case.json": dressed_case.replace('"settle": 0', '"settle": 0, "from": "dressed.json"')}
    on_ball = CLOTH % '"supports": [{"fixed": {"edge": "v1"}}], "obstacles": [{"name": "ball", "sphere": {"radius": "5 cm"}}],'
    results = lambda name, broken, case, *command: Kind(name, broken, {"case.json": case}, made=["run", "case.json", "--out", "out", "--threads", "1"],
                                                         command=command)
    studied_case = dressed_case.replace('"contact"', '"analysis": {"joints": ["hip_flexion_left"]},\n  "contact"')
    studying = ["study", "a.study.json", "--out", "out", "--threads", "1"]
    studied = lambda name, broken: Kind(name, "out/1/" + broken, {"a.study.json": json.dumps(SLIP), "cloth.json": studied_case}, made=studying,
                                        command=[*studying, "--resume"])
    reference = json.dumps({
        "id": "plate", "title": "a plate", "group": "g", "source": "closed form", "doc": "none", "quick": True, "case": json.loads(PLATE),
        "runs": [{"name": "a", "set": {"sheet.cells_u": 5}}, {"name": "b"}],
        "checks": [{"kind": "value", "quantity": "area", "unit": "m^2", "of": {"run": "a", "summary": "area_m2"}, "reference": 1.8, "relative": 0.2}]}, indent=1)
    verifying = ["verify", "--dir", "refs", "--out", "verified", "--filter", "*", "--jobs", "1"]
    kept = json.dumps({**json.loads(reference), "id": "cloth", "case": json.loads(on_ball), "runs": [{"name": "a"}], "checks": [
        {"kind": "value", "quantity": "time", "unit": "s", "of": {"run": "a", "summary": "recorded_to_s"}, "reference": 0.01, "relative": 0.1},
        {"kind": "value", "quantity": "push", "unit": "N", "of": {"run": "a", "table": "contact.csv", "column": "ball_x_N", "at": 0.005}, "at_least": -10}]})
    denim = {"a.card.json": (LIBRARY / "cards/denim_a.card.json").read_text()}
    joint_map = (SOURCE / "human/data/map_gait2392.json").read_text()
    bones_map = (SOURCE / "human/data/map_snu_woody.json").read_text()
    return [
        Kind("case", "case.json", {"case.json": on_ball}, run=True),
        Kind("case_human", "case.json", on_arm, run=True),
        Kind("case_garments", "case.json", {"case.json": (LIBRARY / "stack_mixed.json").read_text()}),
        Kind("static", "case.json", {"case.json": PLATE}, run=True),
        Kind("modal", "case.json", {"case.json": DISC}, run=True),
        Kind("dynamic", "case.json", {"case.json": FALL}, run=True),
        Kind("cell", "case.json", {"case.json": CELL}, run=True),
        Kind("study", "a.study.json", {"a.study.json": STUDY, "cloth.json": CLOTH % ""}, command=["study", "a.study.json", "--check"]),
        Kind("garment_file", "cloth.json", {"case.json": wearing('{"file": {"path": "cloth.json"}}') % '"supports": [{"fixed": {"edge": "left"}}],',
                                            "cloth.json": GARMENT}, run=True),
        Kind("mesh_file_obj", "worn.obj", worn("worn.obj", WORN), run=True),
        Kind("mesh_file_ply", "worn.ply", worn("worn.ply", PLY), run=True),
        Kind("urdf", "arm.urdf", on_arm, run=True),
        Kind("body", "body.json", on_arm, run=True),
        Kind("csv", "flex.csv", on_arm, run=True),
        Kind("mot", "walk.mot", {**recorded("walk.mot"), "walk.mot": mot()}, run=True),
        Kind("sto", "walk.sto", {**recorded("walk.sto"), "walk.sto": sto()}, run=True),
        Kind("bvh", "walk.bvh", {**recorded("walk.bvh"), "walk.bvh": bvh()}, run=True),
        Kind("trc", "walk.trc", {**recorded("walk.trc"), "walk.trc": trc()}, run=True),
        Kind("map_coordinates", "map.json", {**recorded("walk.mot", ', "map": "map.json"'), "walk.mot": mot(), "map.json": joint_map}, run=True),
        Kind("map_bones", "map.json", {**recorded("walk.bvh", ', "map": "map.json"'), "walk.bvh": bvh(), "map.json": bones_map}, run=True),
        Kind("obj", "a.obj", mesh("a.obj", OBJ), run=True),
        Kind("ply", "a.ply", mesh("a.ply", PLY), run=True),
        Kind("stl", "a.stl", mesh("a.stl", stl()), run=True),
        Kind("gltf", "a.gltf", mesh("a.gltf", json.dumps(scene), **{"a.bin": points}), run=True),
        Kind("gltf_buffer", "a.bin", mesh("a.gltf", json.dumps(scene), **{"a.bin": points}), run=True),
        Kind("glb", "a.glb", mesh("a.glb", glb(*gltf(""))), run=True),
        Kind("verify", "refs/plate.json", {"refs/plate.json": reference}, command=verifying),
        Kind("osim", "a.osim", {**on_subject, "a.osim": fuzz_bodies.osim()}, run=True),
        Kind("osim_joints", "a.osim", {**on_subject, "a.osim": fuzz_bodies.osim_joints()}, run=True),
        Kind("trc_subject", "walk.trc", {**on_subject, "a.osim": fuzz_bodies.osim()}, run=True),
        Kind("map_markers", "map.json", {**recorded("walk.trc", ', "model": "a.osim", "map": "map.json"'), "walk.trc": on_subject["walk.trc"],
                                         "a.osim": fuzz_bodies.osim(), "map.json": marker_map}, run=True),
        Kind("map_points", "map.json", {**recorded("walk.trc", ', "map": "map.json"'), "walk.trc": trc(),
                                        "map.json": (SOURCE / "human/data/map_joint_centres.json").read_text()}, run=True),
        Kind("case_recorded", "case.json", {**recorded("walk.mot", ', "from": 0.1, "to": "0.5 s", "stand": 0.1, "lead_in": "0.2 s", "slower": 2, "scale": 1, '
                                                       '"floor": 0, "forward": "x", "up": "y", "heading": "keep", "travel": "file"'), "walk.mot": mot()}, run=True),
        Kind("character", "a.gltf", character("a.gltf", **{"a.gltf": json.dumps(body), "a.bin": body_points}), run=True),
        Kind("character_buffer", "a.bin", character("a.gltf", **{"a.gltf": json.dumps(body), "a.bin": body_points}), run=True),
        Kind("character_glb", "a.glb", character("a.glb", **{"a.glb": glb(*fuzz_bodies.character_gltf(""))}), run=True),
        Kind("character_fbx", "a.fbx", character("a.fbx", **{"a.fbx": fuzz_bodies.character_fbx()}), run=True),
        Kind("case_character", "case.json", character("a.gltf", ', "like": "male_p50", "height": 1.8, "mass": 80, "bridge_folds": "8 mm"',
                                                      **{"a.gltf": json.dumps(body), "a.bin": body_points}), run=True),
        Kind("makehuman", "a.obj", on_makehuman, run=True),
        Kind("makehuman_bones", "a.mhskel", on_makehuman, run=True),
        Kind("makehuman_weights", "a.mhw", on_makehuman, run=True),
        Kind("makehuman_target", "wide.target", on_makehuman, run=True),
        Kind("scan_obj", "a.obj", scan("a.obj", scan_obj), run=True),
        Kind("scan_ply", "a.ply", scan("a.ply", fuzz_scans.ply(*fuzz_scans.surface())), run=True),
        Kind("scan_shape", "a.obj", scan("a.obj", scan_obj), run=True, spoil=fuzz_scans.spoilt),
        Kind("case_scan", "case.json", scan("a.obj", scan_obj, ', "height": "175 cm", "up": "y", "facing": "z", "close_holes": 0.3, "like": "male_p50", '
                                                                '"mass": "80 kg", "bridge_folds": "8 mm"'), run=True),
        Kind("sequence", "frames/1.obj", sequence, run=True),
        Kind("sequence_first", "frames/0.obj", sequence, run=True),
        Kind("case_sequence", "case.json", sequence, run=True),
        Kind("static_file", "cloth.json", {"case.json": json.dumps({**json.loads(PLATE), "sheet": {"file": {"path": "cloth.json"}},
                                                                    "loads": [{"gravity": [0, 0, -0.1]}],
                                                                    "supports": [{"edge": "0.u0", "hold": "xyz"}], "output": {"pictures": []}}),
                                           "cloth.json": GARMENT}, run=True),
        Kind("draft", "cloth.json", {"case.json": wearing('{"file": {"path": "cloth.json"}}') % "", "cloth.json": GARMENT},
             command=["draft", "case.json", "-o", "drafted.json"]),
        Kind("dress", "case.json", {"case.json": dressed_case}, command=["dress", "case.json", "-o", "dressed.json", "--threads", "1"]),
        Kind("dressed", "dressed.json", on_dressed, run=True, **dressed),
        Kind("batch", "case.json", {"case.json": on_ball}, command=["batch", "case.json", "--out", "out", "--threads", "1"]),
        Kind("examples", "refs/examples/work.json", {"refs/plate.json": reference, "refs/examples/work.json": json.dumps(EXAMPLES, indent=1), "case.json": PLATE},
             command=verifying),
        results("resume_segment", "out/frames/segment_000001.h5", on_ball, "run", "case.json", "--out", "out", "--threads", "1", "--resume"),
        results("resume_layout", "out/frames/layout.h5", on_ball, "run", "case.json", "--out", "out", "--threads", "1", "--resume"),
        results("resume_list", "out/.gambeson", on_ball, "run", "case.json", "--out", "out", "--threads", "1", "--resume"),
        results("report_segment", "out/frames/segment_000001.h5", on_ball, "report", "out", "-o", "page.html"),
        results("report_case", "out/case.json", on_ball, "report", "out", "-o", "page.html"),
        results("report_facts", "out/run.json", on_ball, "report", "out", "-o", "page.html"),
        results("report_summary", "out/summary.json", PLATE, "report", "out", "-o", "page.html"),
        results("report_path", "out/path.csv", PLATE, "report", "out", "-o", "page.html"),
        results("report_cell", "out/frames/segment_000001.h5", CELL, "report", "out", "-o", "page.html"),
        results("resume_cell", "out/frames/segment_000001.h5", CELL, "run", "case.json", "--out", "out", "--threads", "1", "--resume"),
        results("render_layout", "out/frames/layout.h5", on_ball, "render", "out", "-o", "a.png", "--size", "160x120"),
        results("report_human", "out/frames/segment_000001.h5", dressed_case, "report", "out", "-o", "page.html"),
        results("export_layout", "out/frames/layout.h5", dressed_case, "export", "out", "--iges", "a.igs", "--opensim", "loads"),
        results("export_segment", "out/frames/segment_000001.h5", dressed_case, "export", "out", "--iges", "a.igs", "--opensim", "loads"),
        studied("study_summary", "summary.json"),
        studied("study_torques", "torques.csv"),
        studied("study_pressures", "pressures.csv"),
        Kind("import_garmentcode", "a.json", {"a.json": GARMENTCODE}, command=importing("a.json")),
        Kind("import_dxf", "a.dxf", {"a.dxf": dxf()}, command=importing("a.dxf")),
        Kind("import_step", "a.step", {"a.step": (CAD / "cylinder.step").read_text()}, command=["import", "a.step", "-o", "written.json"]),
        Kind("import_iges", "a.igs", {"a.igs": (CAD / "panels.igs").read_text()}, command=["import", "a.igs", "-o", "written.json"]),
        Kind("import_iges_trimmed", "a.igs", {"a.igs": {n: t for n, t, _ in iges_text.files()}["trimmed_INCH.igs"]}, command=["import", "a.igs", "-o", "written.json"]),
        Kind("import_brep", "a.brep", {"a.brep": (CAD / "half_pipe.brep").read_text()}, command=["import", "a.brep", "-o", "written.json"]),
        Kind("import_dxf_parts", "a.dxf", {"a.dxf": dxf_parts()}, command=[*importing("a.dxf"), "--unfold"]),
        Kind("import_obj", "a.obj", {"a.obj": uv_tube()}, command=[*importing("a.obj"), "--unit", "cm"]),
        Kind("import_ply", "a.ply", {"a.ply": UV_PLY}, command=importing("a.ply")),
        Kind("import_mesh", "b.json", {"a.obj": uv_tube()}, made=["import", "a.obj", "-o", "b.json", "--unit", "cm"], command=importing("b.json")),
        Kind("mesh_file_json", "b.json", {"case.json": worn("b.json", "")["case.json"], "a.obj": uv_tube()}, made=["import", "a.obj", "-o", "b.json", "--unit", "cm"], run=True),
        Kind("card", "a.card.json", {"a.card.json": (LIBRARY / "cards/denim_a.card.json").read_text()}, command=["check", "a.card.json"]),
        Kind("lab_loop", "loop.csv", {**denim, "loop.csv": lab_loop()}, command=["fabric", "a.card.json", "--fit", "loop.csv", "-o", "out.json"]),
        Kind("lab_points", "points.json", {**denim, "points.json": LAB_POINTS}, command=["fabric", "a.card.json", "--fit", "points.json", "-o", "out.json"]),
        Kind("import_pattern", "b.json", {"a.json": GARMENTCODE}, made=["import", "a.json", "-o", "b.json"], command=importing("b.json")),
        Kind("verify_checks", "refs/strip.json", {"refs/strip.json": json.dumps(STRIP, indent=1)}, command=verifying),
        Kind("verify_kept", "verified/cloth/a/summary.json", {"refs/cloth.json": kept}, made=verifying, command=[*verifying, "--results", "verified"]),
        Kind("verify_table", "verified/cloth/a/contact.csv", {"refs/cloth.json": kept}, made=verifying, command=[*verifying, "--results", "verified"]),
    ]
