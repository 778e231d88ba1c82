"""What `export` writes for other programs: a .glb that the Khronos validator takes, an OBJ of each frame, the body for
OpenSim with its motion, tables with decimal commas; each against the others, read here from their formats alone.

    exports.py GAMBESON

The validator (npm's gltf-validator) is asked where node finds it (NODE_PATH, or installed globally)."""

import csv
import json
import math
import os
import shutil
import struct
import subprocess
import xml.etree.ElementTree as xml

from common import HERE, Folder, check, run, run_case

VALIDATE = """
const fs = require('fs');
require('gltf-validator').validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])), {maxIssues: 100})
  .then(report => console.log(JSON.stringify(report.issues)));
"""


def rotate(q, p):
    """p turned by the quaternion (x, y, z, w)."""
    u, w = q[:3], q[3]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    once = cross(u, p)
    twice = cross(u, once)
    return [p[c] + 2 * w * once[c] + 2 * twice[c] for c in range(3)]


class Glb:
    def __init__(self, file):
        data = file.read_bytes()
        magic, version, length, text = struct.unpack_from("<4sIII", data)
        check(magic == b"glTF" and version == 2 and length == len(data), "the header of the .glb")
        self.json = json.loads(data[20:20 + text])
        self.buffer = data[28 + text:]
        self.parent = {child: n for n, node in enumerate(self.json["nodes"]) for child in node.get("children", [])}
        self.names = {}
        for n, node in enumerate(self.json["nodes"]):
            self.names.setdefault((node["name"], "mesh" in node), n)
        animation = self.json["animations"][0]
        self.keys = {(c["target"]["node"], c["target"]["path"]): self.numbers(animation["samplers"][c["sampler"]]["output"])
                     for c in animation["channels"]}
        self.times = [t[0] for t in self.numbers(animation["samplers"][0]["input"])]

    def numbers(self, accessor):
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        per = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[a["type"]]
        kind = {5122: "h", 5123: "H", 5125: "I", 5126: "f"}[a["componentType"]]
        stride = view.get("byteStride", per * struct.calcsize(kind))
        begin = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        return [struct.unpack_from(f"<{per}{kind}", self.buffer, begin + i * stride) for i in range(a["count"])]

    def value(self, node, path, k, otherwise):
        if (node, path) in self.keys:
            return self.keys[node, path][k]
        return self.json["nodes"][node].get(path, otherwise)

    def ours(self, node, k, p):
        while node is not None:
            s = self.value(node, "scale", k, [1, 1, 1])
            t = self.value(node, "translation", k, [0, 0, 0])
            turned = rotate(self.value(node, "rotation", k, [0, 0, 0, 1]), [s[c] * p[c] for c in range(3)])
            p = [turned[c] + t[c] for c in range(3)]
            node = self.parent.get(node)
        return [p[2], p[0], p[1]]  # from y up, z forward

    def vertices(self, name, k):
        node = self.names[name, True]
        primitive = self.json["meshes"][self.json["nodes"][node]["mesh"]]["primitives"][0]
        x = self.numbers(primitive["attributes"]["POSITION"])
        if k > 0 and "targets" in primitive:  # weight 1 on the one target of the time
            weights = [w[0] for w in self.keys[node, "weights"]][k * (len(self.times) - 1):(k + 1) * (len(self.times) - 1)]
            check(sorted(weights)[-1] == 1 and sum(weights) == 1, "more than one shape at once")
            change = self.numbers(primitive["targets"][weights.index(1)]["POSITION"])
            x = [[a + b for a, b in zip(v, d)] for v, d in zip(x, change)]
        return [self.ours(node, k, v) for v in x]


def obj_groups(file):
    groups = {}
    for line in file.read_text().splitlines():
        words = line.split()
        if words[0] == "g":
            vertices = groups.setdefault(words[1], [])
        if words[0] == "v":
            vertices.append([float(w) for w in words[1:]])
    return groups


def storage(file):
    head, _, table = file.read_text().partition("endheader\n")
    check("inDegrees=no" in head, f"{file.name}: radians")
    rows = [line.split("\t") for line in table.splitlines()]
    check(f"nRows={len(rows) - 1}\n" in head and f"nColumns={len(rows[0])}\n" in head, f"{file.name}: its counts")
    return [dict(zip(rows[0], map(float, row))) for row in rows[1:]]


def matrix(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    return [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)]]


def times(a, b):
    """Poses (rotation, origin) one after the other."""
    R = [[sum(a[0][i][k] * b[0][k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return R, [sum(a[0][i][k] * b[1][k] for k in range(3)) + a[1][i] for i in range(3)]


def inverse(a):
    R = [list(column) for column in zip(*a[0])]
    return R, [-sum(R[i][k] * a[1][k] for k in range(3)) for i in range(3)]


ONE = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def turns(axes, angles):
    pose = (ONE, [0, 0, 0])
    for axis, angle in zip(axes, angles):
        pose = times(pose, (matrix(axis, angle), [0, 0, 0]))
    return pose[0]


def bodies(model, q):
    """Forward kinematics of an .osim by OpenSim's definition of its joints."""
    triple = lambda e: [float(w) for w in e.text.split()]
    at = {"/ground": (ONE, [0, 0, 0])}
    for joint in model.find("Model/JointSet/objects"):
        frames = {f.get("name"): (f.findtext("socket_parent"),
                                  (turns(ONE, triple(f.find("orientation"))), triple(f.find("translation"))))
                  for f in joint.find("frames")}
        parent, X_PF = frames[joint.findtext("socket_parent_frame")]
        child, X_CM = frames[joint.findtext("socket_child_frame")]
        moved = (ONE, [0, 0, 0])
        if joint.tag == "PinJoint":
            moved = (matrix([0, 0, 1], q[joint.find("coordinates/Coordinate").get("name")]), [0, 0, 0])
        elif joint.tag == "CustomJoint":
            for axis in joint.find("SpatialTransform"):
                value, along = q[axis.findtext("coordinates")], triple(axis.find("axis"))
                if axis.get("name").startswith("rotation"):
                    moved = (times(moved, (matrix(along, value), [0, 0, 0]))[0], moved[1])
                else:
                    moved = (moved[0], [moved[1][c] + value * along[c] for c in range(3)])
        else:
            check(joint.tag == "WeldJoint", f"joint {joint.tag}")
        at[child] = times(times(times(at[parent], X_PF), moved), inverse(X_CM))
    return at


def animation(results, folder):
    done = run("export", results, "-o", folder / "walk.glb", folder / "walk.obj")
    check(done.returncode == 0, done.stderr)
    stated = float(done.stdout.split("cloth within ")[1].split(" mm")[0]) * 1e-3
    glb = Glb(folder / "walk.glb")
    objs = sorted(folder.glob("walk_*.obj"))
    check(len(objs) == len(glb.times) > 3, f"{len(objs)} OBJ files for {len(glb.times)} times")
    worst = 0
    for k in (0, len(objs) // 2, len(objs) - 1):
        groups = obj_groups(objs[k])
        check("garment" in groups and len(groups) > 5, f"groups {sorted(groups)}")
        for name, x in groups.items():
            if not glb.names.get((name, True)):
                continue
            for a, b in zip(x, glb.vertices(name, k), strict=True):
                worst = max(worst, math.dist(a, b))
    check(worst <= 1.01 * stated + 1e-6, f"the .glb is {worst} m from the OBJ, not {stated}")
    check(glb.json["extensionsRequired"] == ["KHR_mesh_quantization"], "quantised")
    few = folder / "few.glb"
    check(run("export", results, "-o", few, "--frames", 3).returncode == 0, "--frames")
    thin = Glb(few)
    check(run("export", results, "-o", folder / "walk.obj", "--frames", 3).returncode == 0, "--frames of OBJ")
    check(len(list(folder.glob("walk_*.obj"))) == 3, "frames of a longer sequence are left")
    check(len(thin.times) == 3 and thin.times[-1] == glb.times[-1], f"--frames 3 gave the times {thin.times}")
    print(f"animation: {len(glb.times)} frames, {(folder / 'walk.glb').stat().st_size} bytes, "
          f"{worst * 1e3:.4f} mm from the OBJ, {stated * 1e3:.4f} mm stated")
    return glb


def validator(file):
    node = shutil.which("node")
    paths = [os.environ.get("NODE_PATH", "")]
    if node and shutil.which("npm"):
        paths.append(subprocess.run(["npm", "root", "-g"], capture_output=True, text=True).stdout.strip())
    environment = {**os.environ, "NODE_PATH": ":".join(p for p in paths if p)}
    if not node or subprocess.run([node, "-e", "require('gltf-validator')"], env=environment, capture_output=True).returncode:
        print("validator: skipped, npm's gltf-validator is not installed")
        return
    done = subprocess.run([node, "-e", VALIDATE, file], env=environment, capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    issues = json.loads(done.stdout)
    check(issues["numErrors"] == 0 and issues["numWarnings"] == 0, done.stdout)
    print(f"validator: 0 errors, 0 warnings, {issues['numInfos']} infos, {issues['numHints']} hints")


def opensim(results, folder, glb):
    done = run("export", results, "--opensim", folder / "loads")
    check(done.returncode == 0, done.stderr)
    loads, motion = storage(folder / "loads.mot"), storage(folder / "loads_motion.mot")
    check([r["time"] for r in loads] == [r["time"] for r in motion], "other times for loads and motion")
    model = xml.parse(folder / "loads.osim").getroot()
    names = {c.get("name") for c in model.iter("Coordinate")}
    check(names == set(motion[0]) - {"time"}, "the coordinates of the .mot are not those of the .osim")
    worst = counted = 0
    for load, q in zip(loads, motion):
        at = bodies(model, q)
        for column in load:
            if not column.endswith("_force_px"):
                continue
            body = column.removesuffix("_force_px")
            point = [load[f"{body}_force_p{c}"] for c in "xyz"]
            worst = max(worst, math.dist(point, at[f"/bodyset/{body}"][1]))
            counted += 1
    check(counted > 10 and worst < 1e-6, f"{counted} joint centres, {worst} m off")
    applied = {f.findtext("applied_to_body") for f in xml.parse(folder / "loads.xml").iter("ExternalForce")}
    check(applied <= {b.get("name") for b in model.iter("Body")}, f"loads on {applied}")
    print(f"OpenSim: {counted} joint centres within {worst:.2g} m, {len(names)} coordinates")


def formats(results, folder):
    for words, ending in ((["export", results, "-o", "walk.mp4"], ".mp4"), (["export", results, "-o", "walk"], "walk"),
                          (["render", results, "-o", "walk.avi"], ".avi"), (["render", results, "-o", "picture.glb"], ".glb"),
                          (["report", results, "-o", "page.pdf"], ".pdf"),
                          (["draft", results / "case.json", "-o", "garment.stl"], ".stl"),
                          (["draft", results / "case.json", "-o", "garment"], "garment"),
                          (["export", results, "-o", "a.glb", "b.glb"], "second"),
                          (["export", results, "-o", "a.glb", "--frames", "0"], "--frames"),
                          (["export", results, "-o", "a.glb", "--field", "body_pressure"], "body_pressure"),
                          (["run", results / "case.json", "--csv", "german"], "european"),
                          (["export", folder / "none", "--csv", "european"], "none")):
        done = run(*words, cwd=folder)
        check(done.returncode == 2 and ending in done.stderr, f"{words}: {done.returncode}, {done.stderr}")
        check(not (folder / words[-1]).exists(), f"{words} left a file")
    print("formats: unknown endings are refused")


def tables(results):
    before = {f.name: f.read_bytes() for f in results.glob("*.csv")}
    check(run("export", results, "--csv", "european").returncode == 0, "--csv")
    check({f.name: f.read_bytes() for f in results.glob("*.csv")} == before, "our own tables changed")
    check({f.name for f in (results / "european").iterdir() if f.suffix == ".csv"} == set(before), "not every table")
    cells = 0
    for name, text in before.items():
        ours = list(csv.reader(text.decode().splitlines()))
        theirs = list(csv.reader((results / "european" / name).read_text().splitlines(), delimiter=";"))
        check([len(r) for r in ours] == [len(r) for r in theirs], f"{name}: other cells")
        for a, b in zip(sum(ours[1:], []), sum(theirs[1:], [])):
            try:
                check("." not in b and float(b.replace(",", ".")) == float(a) or a in ("nan", "inf"), f"{name}: {a} became {b}")
                cells += 1
            except ValueError:
                check(a == b, f"{name}: {a} became {b}")
    check(run("report", results, "-o", results.parent / "again.html").returncode == 0, "the report reads no tables")
    print(f"tables: {len(before)}, {cells} numbers")


with Folder() as folder:
    results = folder / "run"
    run_case(HERE / "shorts.json", results, "--set", "output.pictures=[]")
    glb = animation(results, folder)
    validator(folder / "walk.glb")
    opensim(results, folder, glb)
    formats(results, folder)
    tables(results)
