#!/usr/bin/env python3
"""A skirt and a shirt whose panels have regions and no placements are sewn around wearers.

    placing.py GAMBESON

Both close around male_p50 and female_p5 and cross nothing when they are worn; a pattern without regions is refused with the
list of them; import proposes regions by name and says which panels have none.
"""

import json
import math

from common import Folder, check, run


def edge(x, y, control=None):
    return {"start": [x, y], **({"bezier": [control]} if control else {})}


def panel(name, region, outline):
    return {"name": name, "region": region, "outline": outline}


def seam(name, a, b):
    return {"name": name, "a": [a], "b": [b + " reversed"]}


def skirt(k):
    hem, waist, length = 0.3 * k, 0.235 * k, 0.5 * k
    outline = [edge(-hem, 0), edge(hem, 0), edge(waist, length), edge(-waist, length)]
    return {"format": "gambeson pattern 1", "name": "skirt",
            "panels": [panel("front", "skirt_front", outline), panel("back", "skirt_back", outline)],
            "seams": [seam("left side", "front.1", "back.3"), seam("right side", "back.1", "front.3")]}


def quadratic_length(a, c, b, n=400):
    points = [[(1 - t) ** 2 * a[i] + 2 * t * (1 - t) * c[i] + t * t * b[i] for i in (0, 1)] for t in (k / n for k in range(n + 1))]
    return sum(math.dist(p, q) for p, q in zip(points, points[1:]))


def shirt(k):
    w, length, neck, tip, depth = 0.28 * k, 0.6 * k, 0.08 * k, 0.2 * k, 0.25 * k

    def body(name, low):
        bend = tip - 0.01 * k, length - 0.8 * depth
        return panel(name, name, [edge(-w, 0), edge(w, 0), edge(w, length - depth, list(bend)), edge(tip, length - 0.045 * k),
                                  edge(neck, length, [0, length - 2 * low]), edge(-neck, length),
                                  edge(-tip, length - 0.045 * k, [-bend[0], bend[1]]), edge(-w, length - depth)])

    cap = quadratic_length((w, length - depth), (tip - 0.01 * k, length - 0.8 * depth), (tip, length - 0.045 * k))
    b, sleeve = 0.75 * cap, 0.3 * k
    low = sleeve - math.sqrt(cap * cap - b * b)

    def arm(side):
        return panel(f"{side} sleeve", f"{side}_sleeve",
                     [edge(-0.9 * b, 0), edge(0.9 * b, 0), edge(b, low), edge(0, sleeve), edge(-b, low)])

    return {"format": "gambeson pattern 1", "name": "shirt",
            "panels": [body("front", 0.07 * k), body("back", 0.02 * k), arm("left"), arm("right")],
            "seams": [seam("left side", "front.1", "back.7"), seam("right side", "back.1", "front.7"),
                      seam("left shoulder", "front.3", "back.5"), seam("right shoulder", "front.5", "back.3"),
                      seam("left armhole, front", "left sleeve.3", "front.2"),
                      seam("left armhole, back", "left sleeve.2", "back.6"),
                      seam("left sleeve", "left sleeve.1", "left sleeve.4"),
                      seam("right armhole, front", "right sleeve.2", "front.6"),
                      seam("right armhole, back", "right sleeve.3", "back.2"),
                      seam("right sleeve", "right sleeve.1", "right sleeve.4")]}


def case(manikin, cell):
    return {"name": "worn by regions", "garment": {"pattern": {"path": "pattern.json", "cell": cell}},
            "fabric": {"name": "cotton", "thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa",
                       "poisson": 0.2, "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
            "human": {"manikin": manikin, "motion": {"stand": {"duration": "0.02 s"}}}, "contact": {"friction": 0.5},
            "air": {"drag": "0.3 kg/(m^2 s)"}, "dressing": {"layer_by_layer": True, "settle": "50 ms"}}


def main():
    with Folder() as folder:
        def place(name, pattern, manikin="male_p50", cell="50 mm"):
            (folder / name).mkdir()
            (folder / name / "pattern.json").write_text(json.dumps(pattern))
            (folder / name / "case.json").write_text(json.dumps(case(manikin, cell)))
            return folder / name / "case.json"

        for manikin, size in (("male_p50", 1.0), ("female_p5", 0.86)):
            for pattern in (skirt(size), shirt(size)):
                name = f"{pattern['name']}_{manikin}"
                done = run("run", place(name, pattern, manikin), "--out", folder / name / "out")
                check(done.returncode == 0, f"{name} gave {done.returncode}: {done.stderr}")
                numbers = json.loads((folder / name / "out" / "summary.json").read_text())
                check(numbers["collisions"]["most_intersections"] == 0, f"{name} crosses: {numbers['collisions']}")
                check(0 < numbers["widest_seam_gap"]["cells"] < 0.01, f"{name} gapes: {numbers['widest_seam_gap']}")
                print(f"{name}: {done.stderr.strip()}")

        lost = skirt(1.0)
        for p in lost["panels"]:
            del p["region"]
        done = run("check", place("lost", lost))
        check(done.returncode == 2 and "pattern.json" in done.stderr and '"front" has no placement and no region' in done.stderr
              and "right_leg_back" in done.stderr, f"panels without regions: {done.returncode}, {done.stderr}")

        named = skirt(1.0)
        for p, name in zip(named["panels"], ("Vorderrock", "piece 7")):
            del p["region"]
            p["name"] = name
        named["seams"] = []
        (folder / "named.json").write_text(json.dumps(named))
        done = run("import", folder / "named.json", "--output", folder / "proposed.json")
        check(done.returncode == 0 and 'Vorderrock: "skirt_front", by its name' in done.stdout
              and "not told by the name: piece 7" in done.stdout, f"import: {done.returncode}, {done.stdout}{done.stderr}")
        check([p.get("region") for p in json.loads((folder / "proposed.json").read_text())["panels"]] == ["skirt_front", None],
              "regions in the written file")


main()
