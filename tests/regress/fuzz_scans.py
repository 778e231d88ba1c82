"""A body scan for fuzz_seeds.py, and what may be wrong with its shape: holes, spikes, limbs that are missing or touch, other bodies."""

import functools
import math

#: Limbs as cones with round ends: from, to (of the left side where x > 0), radii. x to the left, y up, z forward [m].
CONES = [((0.06, 0.95, 0), (0.06, 1.30, 0), 0.115, 0.115), ((0.0, 1.30, 0), (0.17, 1.38, 0), 0.09, 0.06), ((0, 1.35, 0), (0, 1.52, 0), 0.06, 0.055),
         ((0, 1.57, 0.01), (0, 1.65, 0.01), 0.085, 0.09), ((0.095, 0.90, 0), (0.115, 0.49, 0), 0.085, 0.058),
         ((0.115, 0.49, 0), (0.135, 0.09, -0.01), 0.058, 0.042), ((0.135, 0.04, -0.04), (0.14, 0.035, 0.15), 0.04, 0.035),
         ((0.17, 1.38, 0), (0.38, 1.17, 0), 0.06, 0.045), ((0.38, 1.17, 0), (0.56, 0.99, 0), 0.045, 0.033), ((0.56, 0.99, 0), (0.67, 0.88, 0), 0.033, 0.03)]
CELL = 0.029  # at 0.03 a cell of an arm is cut twice


def depth(x, y, z):
    """How deep a point lies in the body; negative outside."""
    x, deepest = abs(x), -1.0
    for a, b, ra, rb in CONES:
        dx, dy, dz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        px, py, pz = x - a[0], y - a[1], z - a[2]
        t = min(1, max(0, (px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz)))
        deepest = max(deepest, ra + t * (rb - ra) - math.sqrt((px - t * dx) ** 2 + (py - t * dy) ** 2 + (pz - t * dz) ** 2))
    return deepest


@functools.cache
def surface():
    """Vertices and triangles of the body by surface nets: a vertex in each cell of a grid through which it goes."""
    n = (52, 65, 14)
    low = (-CELL * (n[0] - 1) / 2, -0.045, -0.165)
    at = lambda k, i: low[k] + CELL * i
    inside = {(i, j, k): depth(at(0, i), at(1, j), at(2, k)) for i in range(n[0]) for j in range(n[1]) for k in range(n[2])}
    vertices, number = [], {}

    def vertex(cell):
        if cell not in number:
            corners = [(cell[0] + a, cell[1] + b, cell[2] + c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
            points = []
            for p in corners:
                for k in range(3):
                    q = (*p[:k], p[k] + 1, *p[k + 1:])
                    if q in corners and (inside[p] > 0) != (inside[q] > 0):
                        s = inside[p] / (inside[p] - inside[q])
                        points.append([at(m, p[m] + s * (m == k)) for m in range(3)])
            number[cell] = len(vertices)
            vertices.append([sum(c) / len(points) for c in zip(*points)])
        return number[cell]

    triangles = []
    for p, d in inside.items():
        for k in range(3):
            q = (*p[:k], p[k] + 1, *p[k + 1:])
            if q not in inside or (d > 0) == (inside[q] > 0):
                continue
            a, b = (k + 1) % 3, (k + 2) % 3
            around = []
            for u, v in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                cell = list(p)
                cell[a] += u
                cell[b] += v
                around.append(vertex(tuple(cell)))
            if d <= 0:
                around.reverse()
            triangles += [(around[0], around[1], around[2]), (around[0], around[2], around[3])]
    return vertices, triangles


def obj(vertices, triangles, per_m=1000):
    """Millimetres, as scanners write them."""
    return ("".join("v %s\n" % " ".join(c if isinstance(c, str) else f"{per_m * c:.6g}" for c in v) for v in vertices)
            + "".join("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)).encode()


def ply(vertices, triangles):
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head + "".join("%.5g %.5g %.5g\n" % tuple(1000 * c for c in v) for v in vertices) + "".join("3 %d %d %d\n" % t for t in triangles)).encode()


def turned(v, axis, angle):
    a, b, c, s = (axis + 1) % 3, (axis + 2) % 3, math.cos(angle), math.sin(angle)
    v = list(v)
    v[a], v[b] = c * v[a] - s * v[b], s * v[a] + c * v[b]
    return v


def spoilt(_, chance):
    """The body with one to three faults of its shape, as OBJ."""
    vertices, triangles = surface()
    per_m, text = 1000, []
    for _ in range(chance.choice([1, 1, 2, 3])):
        if not triangles:
            break
        kind = chance.randrange(22)
        middle = [c + 0.1 * chance.uniform(-1, 1) for c in chance.choice(vertices)]
        reach = 10 ** chance.uniform(-2, -0.3)
        near = lambda v: math.dist(v, middle) < reach
        axis, share = chance.randrange(3), chance.random()
        if kind == 0:  # holes
            triangles = [t for t in triangles if not near(vertices[t[0]])]
        elif kind == 1:  # many small ones
            triangles = [t for t in triangles if chance.random() > 0.2 * share]
        elif kind == 2:  # some faces turned over
            triangles = [t[::-1] if chance.random() < share else t for t in triangles]
        elif kind == 3:  # a spike
            vertices = [[c + chance.choice([0.1, 1, 100, 1e9]) for c in v] if near(v) and chance.random() < 0.1 else v for v in vertices]
        elif kind == 4:  # the same body again, beside or in itself
            n, shift = len(vertices), chance.choice([0, 1e-7, 0.01, 0.3, 2])
            vertices = vertices + [[v[0] + shift, *v[1:]] for v in vertices]
            triangles = triangles + [tuple(i + n for i in t) for t in triangles]
        elif kind == 5:  # what is no number, or a large one
            text.append((chance.randrange(len(vertices)), axis, chance.choice(["nan", "inf", "-inf", "1e300", "-1e38", "1e-310", "1e12"])))
        elif kind == 6:  # cut off at a level
            level = chance.uniform(0, 1.75)
            side = chance.choice([-1, 1])
            triangles = [t for t in triangles if side * (vertices[t[0]][1] - level) > 0]
        elif kind == 7:  # limbs missing
            x = chance.uniform(0.02, 0.7)
            triangles = [t for t in triangles if not (vertices[t[0]][0] > x or (share < 0.5 and vertices[t[0]][0] < -x))]
        elif kind == 8:  # flat or stretched
            factor = chance.choice([0, 1e-9, 0.01, 0.3, 0.8, 1.2, 3, 100, -1])
            vertices = [[c * factor if k == axis else c for k, c in enumerate(v)] for v in vertices]
        elif kind == 9:  # turned
            angle = chance.choice([math.pi, math.pi / 2, 0.1, 0.5, 6 * share])
            vertices = [turned(v, axis, angle) for v in vertices]
        elif kind == 10:  # noise
            most = 10 ** chance.uniform(-3.5, -0.5)
            vertices = [[c + chance.uniform(-most, most) for c in v] for v in vertices]
        elif kind == 11:  # vertices that became one
            to = list(range(len(vertices)))
            for _ in range(1 + int(60 * share)):
                to[chance.randrange(len(to))] = chance.randrange(len(to))
            triangles = [tuple(to[i] for i in t) for t in triangles]
        elif kind == 12:  # sheets between anything
            triangles = triangles + [tuple(chance.randrange(len(vertices)) for _ in range(3)) for _ in range(1 + int(30 * share))]
        elif kind == 13:  # only a part
            triangles = chance.sample(triangles, 1 + int(share * (len(triangles) - 1)))
        elif kind == 14:  # another unit
            per_m *= chance.choice([1e-6, 1e-3, 0.1, 0.03937, 10, 1e6, 1e30, -1])
        elif kind == 15:  # legs together, or one over the other
            vertices = [[v[0] * share if v[1] < 0.85 else v[0], *v[1:]] for v in vertices]
        elif kind == 16:  # arms raised, hanging, or on one side
            angle = chance.uniform(-1.5, 2.5)
            about = (0.17, 1.38, 0)
            vertices = [[c + a for c, a in zip(turned([c - a for c, a in zip(v, about)], 2, angle), about)] if v[0] > 0.2 else v for v in vertices]
        elif kind == 17:  # a hand at the hip
            vertices = [[0.9 * v[0] - 2 * (v[0] - 0.45), *v[1:]] if v[0] > 0.45 else v for v in vertices]
        elif kind == 18:  # a hand or foot swollen or gone
            factor = chance.choice([0, 0.2, 3])
            vertices = [[m + factor * (c - m) for c, m in zip(v, middle)] if near(v) else v for v in vertices]
        elif kind == 19:  # facing backwards, or feet without length
            vertices = [[v[0], v[1], v[2] * chance.choice([-1, 0.2]) if v[1] < 0.09 else v[2]] for v in vertices]
        elif kind == 20:  # all inside out
            triangles = [t[::-1] for t in triangles]
        else:  # something beside the body
            n = len(vertices)
            at = [chance.uniform(-1, 1) for _ in range(3)]
            vertices = vertices + [[c + 0.4 * share * (k == m) for k, c in enumerate(at)] for m in range(3)] + [at]
            triangles = triangles + [(n, n + 1, n + 2), (n, n + 3, n + 1), (n + 1, n + 3, n + 2), (n, n + 2, n + 3)]
    written = [[per_m * c / 1000 for c in v] for v in vertices]
    for i, axis, word in text:
        written[i][axis] = word
    return obj(written, triangles)
