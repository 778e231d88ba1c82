"""Small good files of every kind that the program reads, for fuzz.py to break: one scene for each kind."""

import json
import math
import struct

from common import SOURCE

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
STUDY = """{
  "name": "slip", "case": "cloth.json",
  "axes": [{"path": "factors.thickness", "values": [0.5, 1]},
           {"name": "mesh", "sets": [{"garment.sheet.cells_u": 3}, {"garment.sheet.cells_u": 4}], "labels": ["coarse", "fine"]}],
  "variants": [{"label": "slow", "at": {"mesh": "fine"}, "set": {"time.max_step": "0.1 ms"}}]
}
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
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


def glb():
    scene, points = gltf("")
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


class Kind:
    """One file to break among those beside it, and the commands that read it."""

    def __init__(self, name, broken, files, main="case.json", run=False, command=None):
        self.name, self.broken, self.files, self.main, self.run = name, broken, files, main, run
        self.command = command or ["check", main]


def kinds():
    arm = {"arm.urdf": (LIBRARY / "arm.urdf").read_text(), "body.json": (LIBRARY / "arm_body.json").read_text(),
           "flex.csv": "time_s,root_x_m,elbow_flexion_rad\n0,0,0\n0.1,0,0.2\n0.2,0,0.3\n"}
    on_arm = {"case.json": CLOTH % (HUMAN % ARM), **arm}
    recorded = lambda file, more="": {"case.json": CLOTH % (HUMAN % (RECORDED % (file, more)))}
    mesh = lambda file, content, **more: {"case.json": CLOTH % (OBSTACLE % file), file: content, **more}
    scene, points = gltf("a.bin")
    joint_map = (SOURCE / "human/data/map_gait2392.json").read_text()
    bones_map = (SOURCE / "human/data/map_snu_woody.json").read_text()
    reference = json.dumps({
        "id": "plate", "title": "a plate", "group": "g", "source": "closed form", "doc": "none", "quick": True, "case": json.loads(PLATE),
        "runs": [{"name": "a", "set": {"sheet.cells_u": 5}}, {"name": "b"}],
        "checks": [{"kind": "value", "quantity": "area", "unit": "m^2", "of": {"run": "a", "summary": "area_m2"}, "reference": 1.8, "relative": 0.2}]}, indent=1)
    return [
        Kind("case", "case.json", {"case.json": CLOTH % '"supports": [{"fixed": {"edge": "v1"}}], "obstacles": [{"name": "ball", "sphere": {"radius": "5 cm"}}],'}, run=True),
        Kind("case_human", "case.json", on_arm, run=True),
        Kind("case_garments", "case.json", {"case.json": (LIBRARY / "stack_mixed.json").read_text()}),
        Kind("static", "case.json", {"case.json": PLATE}, run=True),
        Kind("modal", "case.json", {"case.json": DISC}, run=True),
        Kind("dynamic", "case.json", {"case.json": FALL}, run=True),
        Kind("study", "a.study.json", {"a.study.json": STUDY, "cloth.json": CLOTH % ""}, command=["study", "a.study.json", "--check"]),
        Kind("garment_file", "cloth.json", {"case.json": wearing('{"file": {"path": "cloth.json"}}') % '"supports": [{"fixed": {"edge": "left"}}],',
                                            "cloth.json": GARMENT}, run=True),
        Kind("urdf", "arm.urdf", on_arm, run=True),
        Kind("body", "body.json", on_arm, run=True),
        Kind("csv", "flex.csv", on_arm, run=True),
        Kind("mot", "walk.mot", {**recorded("walk.mot"), "walk.mot": mot()}),
        Kind("sto", "walk.sto", {**recorded("walk.sto"), "walk.sto": sto()}),
        Kind("bvh", "walk.bvh", {**recorded("walk.bvh"), "walk.bvh": bvh()}),
        Kind("trc", "walk.trc", {**recorded("walk.trc"), "walk.trc": trc()}),
        Kind("map_coordinates", "map.json", {**recorded("walk.mot", ', "map": "map.json"'), "walk.mot": mot(), "map.json": joint_map}),
        Kind("map_bones", "map.json", {**recorded("walk.bvh", ', "map": "map.json"'), "walk.bvh": bvh(), "map.json": bones_map}),
        Kind("obj", "a.obj", mesh("a.obj", OBJ), run=True),
        Kind("ply", "a.ply", mesh("a.ply", PLY)),
        Kind("stl", "a.stl", mesh("a.stl", stl())),
        Kind("gltf", "a.gltf", mesh("a.gltf", json.dumps(scene), **{"a.bin": points})),
        Kind("gltf_buffer", "a.bin", mesh("a.gltf", json.dumps(scene), **{"a.bin": points})),
        Kind("glb", "a.glb", mesh("a.glb", glb())),
        Kind("verify", "refs/plate.json", {"refs/plate.json": reference}, command=["verify", "--dir", "refs", "--out", "verified", "--filter", "*"]),
    ]
