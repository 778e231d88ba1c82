"""Bodies for fuzz_seeds.py: a blocky skinned character in a T-pose as glTF, FBX and MakeHuman's files, and a subject of OpenSim's
with its markers. All axes are the files': x to the left (OpenSim: forward), y up, z forward."""

import json
import struct

XS = [-0.80, -0.72, -0.66, -0.48, -0.42, -0.24, -0.18, -0.04, 0.04, 0.18, 0.24, 0.42, 0.48, 0.66, 0.72, 0.80]
YS = [0, 0.08, 0.14, 0.42, 0.54, 0.84, 0.90, 1.02, 1.10, 1.30, 1.45, 1.50, 1.70]
ZS = [-0.10, 0.08, 0.22]
#: Segment, whose child it is, where its joint is (of a limb: the left one's), Unreal's name and MakeHuman's.
JOINTS = [("pelvis", "", (0, 0.95, 0), "pelvis", "root"), ("belly", "pelvis", (0, 1.02, 0), "spine_01", "spine04"),
          ("torso", "belly", (0, 1.08, 0), "spine_03", "spine01"), ("head", "torso", (0, 1.47, 0), "neck_01", "neck01"),
          ("thigh", "pelvis", (0.11, 0.87, 0), "thigh", "upperleg01"), ("shank", "thigh", (0.11, 0.48, 0), "calf", "lowerleg01"),
          ("foot", "shank", (0.11, 0.10, 0), "foot", "foot"), ("toes", "foot", (0.11, 0.03, 0.15), "ball", "toe2-1"),
          ("upper_arm", "torso", (0.20, 1.38, 0), "upperarm", "upperarm01"), ("forearm", "upper_arm", (0.45, 1.38, 0), "lowerarm", "lowerarm01"),
          ("hand", "forearm", (0.69, 1.38, 0), "hand", "wrist")]


def surface():
    """Vertices and triangles of the body: the outer faces of blocks between the planes."""
    blocks = {(i, j, 0) for i in (6, 7, 8) for j in range(6, 10)} | {(7, j, 0) for j in (10, 11)}
    for i in (6, 8):
        blocks |= {(i, j, 0) for j in range(6)} | {(i, 0, 1)}
    blocks |= {(i, 9, 0) for i in range(15)}
    number, triangles = {}, []
    for block in sorted(blocks):
        for axis in range(3):
            for end in (0, 1):
                beside = list(block)
                beside[axis] += 2 * end - 1
                if tuple(beside) in blocks:
                    continue
                b, c = (axis + 1) % 3, (axis + 2) % 3
                quad = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = list(block)
                    corner[axis] += end
                    corner[b] += u
                    corner[c] += v
                    quad.append(number.setdefault(tuple(corner), len(number)))
                if not end:
                    quad.reverse()
                triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return [(XS[i], YS[j], ZS[k]) for i, j, k in number], triangles


def bones(rig):
    """Name, number of the parent and place of each bone; `rig`: 0 Unreal's names, 1 MakeHuman's."""
    out, at = [], {}
    for segment, parent, place, *names in JOINTS:
        for side, sign in [("", 1)] if place[0] == 0 else [("l", 1), ("r", -1)]:
            suffix = "" if not side else (f"_{side}" if rig == 0 else f".{side.upper()}")
            at[segment + side] = len(out)
            out.append((names[rig] + suffix, at.get(parent + side, at.get(parent, -1)), (sign * place[0], *place[1:])))
    if rig == 1:  # its map asks for a bone above the neck
        out.append(("head", at["head"], (0, 1.55, 0)))
        out.append(("spine05", at["pelvis"], (0, 0.98, 0)))
    return out, at


def weights(vertices, at):
    """Two bones of each vertex and how much of it they have."""
    out = []
    for x, y, z in vertices:
        side = "l" if x > 0 else "r"
        limb = "hand" if abs(x) > 0.69 else "forearm" if abs(x) > 0.45 else "upper_arm" if abs(x) > 0.2 else None
        low = "thigh" if y > 0.48 else "shank" if y > 0.11 else "foot"
        name = limb + side if limb else "head" if y > 1.47 else "torso" if y > 1.06 else "pelvis" if y > 0.87 else low + side
        out.append([(at[name], 0.75), (at["pelvis"], 0.25)])
    return out


def character_gltf(uri):
    """A scene and its buffer."""
    vertices, triangles = surface()
    tree, at = bones(0)
    held = weights(vertices, at)
    chunks = [b"".join(struct.pack("<3f", *v) for v in vertices),
              b"".join(struct.pack("<4H", *[b for b, _ in w], 0, 0) for w in held),
              b"".join(struct.pack("<4f", *[s for _, s in w], 0, 0) for w in held),
              b"".join(struct.pack("<3H", *t) for t in triangles),
              b"".join(struct.pack("<16f", 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1) for _, _, (x, y, z) in tree)]
    views, start = [], 0
    for k, chunk in enumerate(chunks):
        views.append({"buffer": 0, "byteOffset": start, "byteLength": len(chunk)})
        chunks[k] = chunk + b"\0" * (-len(chunk) % 4)
        start += len(chunks[k])
    accessor = lambda view, kind, count, shape, **more: {"bufferView": view, "componentType": kind, "count": count, "type": shape, **more}
    nodes = []
    for k, (name, parent, place) in enumerate(tree):
        origin = tree[parent][2] if parent >= 0 else (0, 0, 0)
        node = {"name": name, "translation": [round(p - o, 6) for p, o in zip(place, origin)]}
        if children := [c for c, bone in enumerate(tree) if bone[1] == k]:
            node["children"] = children
        nodes.append(node)
    nodes.append({"name": "Body", "mesh": 0, "skin": 0})
    buffer = {"byteLength": start, **({"uri": uri} if uri else {})}
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, len(tree)]}], "nodes": nodes,
            "meshes": [{"name": "Body", "primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]}],
            "skins": [{"inverseBindMatrices": 4, "joints": list(range(len(tree)))}],
            "accessors": [accessor(0, 5126, len(vertices), "VEC3", min=[XS[0], YS[0], ZS[0]], max=[XS[-1], YS[-1], ZS[-1]]),
                          accessor(1, 5123, len(vertices), "VEC4"), accessor(2, 5126, len(vertices), "VEC4"),
                          accessor(3, 5123, 3 * len(triangles), "SCALAR"), accessor(4, 5126, len(tree), "MAT4")],
            "bufferViews": views, "buffers": [buffer]}, b"".join(chunks)


def character_fbx():
    """FBX as text, in centimetres."""
    vertices, triangles = surface()
    tree, at = bones(0)
    held = weights(vertices, at)
    listed = lambda name, values: f"\t\t{name}: *{len(values)} {{\n\t\t\ta: {','.join(f'{v:.6g}' for v in values)}\n\t\t}}\n"
    cm = lambda v: [100 * x for x in v]
    matrix = lambda place: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *place, 1]
    objects = ('\tGeometry: 1000, "Geometry::Body", "Mesh" {\n' + listed("Vertices", [x for v in vertices for x in cm(v)]) +
               listed("PolygonVertexIndex", [x for a, b, c in triangles for x in (a, b, -c - 1)]) + "\t\tGeometryVersion: 124\n\t}\n"
               '\tModel: 2000, "Model::Body", "Mesh" {\n\t\tVersion: 232\n\t}\n\tDeformer: 4000, "Deformer::Skin", "Skin" {\n\t\tVersion: 101\n\t}\n')
    links = '\tC: "OO",2000,0\n\tC: "OO",1000,2000\n\tC: "OO",4000,1000\n'
    for k, (name, parent, place) in enumerate(tree):
        origin = tree[parent][2] if parent >= 0 else (0, 0, 0)
        shift = ",".join(f"{100 * (p - o):.6g}" for p, o in zip(place, origin))
        objects += (f'\tModel: {3000 + k}, "Model::{name}", "LimbNode" {{\n\t\tVersion: 232\n\t\tProperties70:  {{\n'
                    f'\t\t\tP: "Lcl Translation", "Lcl Translation", "", "A",{shift}\n\t\t}}\n\t}}\n')
        links += f'\tC: "OO",{3000 + k},{3000 + parent if parent >= 0 else 0}\n'
        mine = [(v, s) for v, w in enumerate(held) for b, s in w if b == k]
        if mine:
            objects += (f'\tDeformer: {5000 + k}, "SubDeformer::{name}", "Cluster" {{\n\t\tVersion: 100\n' + listed("Indexes", [v for v, _ in mine]) +
                        listed("Weights", [s for _, s in mine]) + listed("Transform", matrix(cm([-x for x in place]))) +
                        listed("TransformLink", matrix(cm(place))) + "\t}\n")
            links += f'\tC: "OO",{5000 + k},4000\n\tC: "OO",{3000 + k},{5000 + k}\n'
    return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n"
            '\tProperties70:  {\n\t\tP: "UpAxis", "int", "Integer", "",1\n\t\tP: "UpAxisSign", "int", "Integer", "",1\n'
            '\t\tP: "FrontAxis", "int", "Integer", "",2\n\t\tP: "FrontAxisSign", "int", "Integer", "",1\n\t\tP: "CoordAxis", "int", "Integer", "",0\n'
            '\t\tP: "CoordAxisSign", "int", "Integer", "",1\n\t\tP: "UnitScaleFactor", "double", "Number", "",1\n\t}\n}\n'
            "Objects:  {\n" + objects + "}\nConnections:  {\n" + links + "}\n")


def makehuman():
    """Base mesh (decimetres), skeleton, weights and a target that widens the hips."""
    vertices, triangles = surface()
    tree, at = bones(1)
    mesh = "# body\n" + "".join("v " + " ".join(f"{10 * x:g}" for x in v) + "\n" for v in vertices)
    mesh += "".join("v " + " ".join(f"{10 * x:g}" for x in place) + "\n" for _, _, place in tree)
    mesh += "vt 0 0\ng body\n" + "".join("f " + " ".join(f"{v + 1}/1" for v in t) + "\n" for t in triangles)
    skeleton = {"bones": {name: {"head": name + "____head", "parent": tree[parent][0] if parent >= 0 else None} for name, parent, _ in tree},
                "joints": {name + "____head": [len(vertices) + k] for k, (name, _, _) in enumerate(tree)}}
    of = {}
    for v, list_of in enumerate(weights(vertices, at)):
        for b, share in list_of:
            of.setdefault(tree[b][0], []).append([v, share])
    target = "# wider\n" + "".join(f"{k} {0.2 if v[0] > 0 else -0.2:g} 0 0\n" for k, v in enumerate(vertices) if abs(v[0]) == 0.18)
    return mesh, json.dumps(skeleton), json.dumps({"weights": of}), target


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def subject():
    """Bodies (parent, joint in the parent) of a subject and its markers (body, place), legs straight under the hips."""
    bodies, markers = {"pelvis": ("ground", (0, 0, 0)), "torso": ("pelvis", (-0.1, 0.08, 0))}, {}
    for name, at in {"R.ASIS": (0.1, 0.1, 0.13), "L.ASIS": (0.1, 0.1, -0.13), "V.Sacral": (-0.1, 0.1, 0)}.items():
        markers[name] = ("pelvis", at)
    for name, at in {"Sternum": (0.1, 0.3, 0), "R.Acromium": (0, 0.4, 0.17), "L.Acromium": (0, 0.4, -0.17)}.items():
        markers[name] = ("torso", at)
    for side, sign in (("r", 1), ("l", -1)):
        bodies[f"femur_{side}"] = ("pelvis", (-0.07, -0.07, 0.08 * sign))
        bodies[f"tibia_{side}"] = (f"femur_{side}", (0, -0.4, 0))
        bodies[f"talus_{side}"] = (f"tibia_{side}", (0, -0.42, 0))
        bodies[f"calcn_{side}"] = (f"talus_{side}", (-0.05, -0.04, 0))
        for name, body in (("Thigh", "femur"), ("Shank", "tibia")):
            for end, at in {"Upper": (0, -0.15, 0.08 * sign), "Front": (0.1, -0.2, 0), "Rear": (-0.02, -0.28, 0.08 * sign)}.items():
                markers[f"{side.upper()}.{name}.{end}"] = (f"{body}_{side}", at)
        for name, at in {"Heel": (-0.02, 0.01, 0), "Toe.Tip": (0.25, 0, 0), "Midfoot.Lat": (0.12, 0.01, 0.06 * sign)}.items():
            markers[f"{side.upper()}.{name}"] = (f"calcn_{side}", at)
    return bodies, markers


def words(at):
    return " ".join(f"{x:g}" for x in at)


KNEE = ("<SpatialTransform><TransformAxis name=\"translation1\"><axis>1 0 0</axis>%s</TransformAxis><TransformAxis name=\"translation2\">"
        "<axis>0 1 0</axis>%s</TransformAxis></SpatialTransform>")
SPLINE = "<%s><x>-2 -1 0 0.2</x><y>-0.004 -0.002 0 0</y></%s>"
STRAIGHT = "<LinearFunction><coefficients>0.001 0</coefficients></LinearFunction>"


def marker_set(markers, holder, path):
    return "<MarkerSet><objects>\n" + "".join(
        f'<Marker name="{name}"><{holder}>{path}{body}</{holder}><location>{words(at)}</location></Marker>\n'
        for name, (body, at) in markers.items()) + "</objects></MarkerSet>\n"


def osim():
    """Version 2: each body holds its joint."""
    bodies, markers = subject()
    knee = KNEE % ("<function>" + SPLINE % ("natCubicSpline", "natCubicSpline") + "</function>",
                   f"<MultiplierFunction><function>{STRAIGHT}</function><scale>0.5</scale></MultiplierFunction>")
    text = '<OpenSimDocument Version="20303"><Model name="subject"><BodySet><objects>\n<Body name="ground"/>\n'
    for name, (parent, at) in bodies.items():
        text += (f'<Body name="{name}"><Joint><CustomJoint><parent_body>{parent}</parent_body><location_in_parent>{words(at)}</location_in_parent>'
                 f"<orientation>0 0 0</orientation>{knee if 'tibia' in name else ''}</CustomJoint></Joint></Body>\n")
    return text + "</objects></BodySet>\n" + marker_set(markers, "body", "") + "</Model></OpenSimDocument>\n"


def osim_joints():
    """Version 4: joints name the frames that they are between."""
    bodies, markers = subject()
    knee = KNEE % (SPLINE % ("SimmSpline", "SimmSpline"), "<Constant><value>0</value></Constant>")
    text = '<OpenSimDocument Version="40000"><Model name="subject"><BodySet><objects>\n' + "".join(f'<Body name="{n}"/>\n' for n in bodies)
    text += "</objects></BodySet>\n<JointSet><objects>\n"
    for name, (parent, at) in bodies.items():
        text += (f'<CustomJoint name="to_{name}"><socket_parent_frame>{parent}_offset</socket_parent_frame><socket_child_frame>/bodyset/{name}'
                 f'</socket_child_frame><frames><PhysicalOffsetFrame name="{parent}_offset"><socket_parent>/bodyset/{parent}</socket_parent>'
                 f"<translation>{words(at)}</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame></frames>"
                 f"{knee if 'tibia' in name else ''}</CustomJoint>\n")
    return text + "</objects></JointSet>\n" + marker_set(markers, "socket_parent_frame", "/bodyset/") + "</Model></OpenSimDocument>\n"


def trc_of_subject():
    bodies, markers = subject()

    def placed(body):
        parent, at = bodies[body]
        return at if parent == "ground" else plus(placed(parent), at)

    head = ("PathFileType\t4\t(X/Y/Z)\twalk.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n20\t20\t4\t%d\tmm\nFrame#\tTime\t" % len(markers)
            + "\t\t\t".join(markers) + "\n\t\t" + "\t".join(f"X{k}\tY{k}\tZ{k}" for k in range(1, len(markers) + 1)) + "\n")
    lines = []
    for k in range(4):
        cells = [str(k + 1), f"{0.05 * k:g}"]
        for body, at in markers.values():
            cells += [f"{1000 * x:.2f}" for x in plus(plus(placed(body), at), (0.02 * k, 0.98, 0))]
        lines.append("\t".join(cells))
    return head + "\n".join(lines) + "\n"
