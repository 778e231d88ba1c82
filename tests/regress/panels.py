#!/usr/bin/env python3
"""A tube of two flat panels is sewn around a ball and worn, and a vest of two around a woman.

    panels.py GAMBESON

One that fits closes, crosses nothing and passes all checks of its run; one that is too narrow is worn too, and said to be
short, by what the ball is wider; one with a dart and one whose side is open but for two buttons are worn as well; seams
that have no time to close end the run by name; one of triangles is worn as well; what is wrong in a pattern is said with file, panel and seam. Panels with
armholes and necklines, whose corners trimming leaves slivers of, start below the shoulders that they close over, hang
and cross nothing.
"""

import json
import math
import re

from common import Folder, check, run, sound

RADIUS = 0.10  # m


def pattern(width):
    def panel(name, sign):
        outline = [{"start": [width * x, y]} for x, y in ((-0.5, 0), (0.5, 0), (0.5, 0.12), (-0.5, 0.12))]
        return {"name": name, "outline": outline,
                "placement": {"origin": [sign * 0.13, 0, -0.06], "along_x": [0, sign, 0], "along_y": [0, 0, 1]}}

    return {"format": "gambeson pattern 1", "name": "tube", "panels": [panel("front", 1), panel("back", -1)],
            "seams": [{"name": "left", "a": ["front.1"], "b": ["back.3 reversed"]},
                      {"name": "right", "a": ["back.1"], "b": ["front.3 reversed"]}]}


CASE = {
    "name": "a tube of two panels on a ball",
    "garment": {"pattern": {"path": "tube.json", "cell": "20 mm"}},
    "fabric": {"name": "cotton", "thickness": "0.5 mm", "surface_density": "200 gsm", "young": "300 kPa", "poisson": 0.2,
               "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
    "obstacles": [{"name": "ball", "sphere": {"radius": RADIUS}}],
    "contact": {"friction": 0.5},
    "air": {"drag": "0.5 kg/(m^2 s)"},
    "time": {"duration": "0.03 s"},
}


def vest():
    def panel(name, sign, neck):
        outline = [{"name": "hem", "start": [-0.27, 0]}, {"start": [0.27, 0]},
                   {"name": "armhole", "start": [0.26, 0.24], "bezier": [[0.19, 0.26], [0.16, 0.40]]},
                   {"name": "shoulder", "start": [0.17, 0.565]},
                   {"name": "neckline", "start": [0.08, 0.60], "bezier": [[0.06, neck], [-0.06, neck]]},
                   {"name": "shoulder", "start": [-0.08, 0.60]},
                   {"name": "armhole", "start": [-0.17, 0.565], "bezier": [[-0.16, 0.40], [-0.19, 0.26]]},
                   {"start": [-0.26, 0.24]}]
        return {"name": name, "outline": outline,
                "placement": {"origin": [sign * 0.2, 0, 0.78], "along_x": [0, sign, 0], "along_y": [0, 0, 1]}}

    return {"format": "gambeson pattern 1", "name": "vest", "panels": [panel("front", 1, 0.46), panel("back", -1, 0.56)],
            "seams": [{"name": "left side", "a": ["front.1"], "b": ["back.7 reversed"]},
                      {"name": "right side", "a": ["front.7"], "b": ["back.1 reversed"]},
                      {"name": "left shoulder", "a": ["front.3"], "b": ["back.5 reversed"]},
                      {"name": "right shoulder", "a": ["front.5"], "b": ["back.3 reversed"]}]}


VEST = {
    **{key: value for key, value in CASE.items() if key != "obstacles"},
    "name": "a vest of two panels on a woman",
    "garment": {"pattern": {"path": "tube.json", "cell": "40 mm", "close_within": "2 s"}},
    "human": {"manikin": "female_p50", "motion": {"stand": {"duration": "0.1 s"}}},
    "dressing": {"layer_by_layer": True, "settle": "0.2 s"},
}


def worn(folder, name, pattern_of, case=CASE):
    place = folder / name
    place.mkdir()
    (place / "tube.json").write_text(json.dumps(pattern_of))
    (place / "case.json").write_text(json.dumps(case))
    return run("run", place / "case.json", "--out", place / "out"), place


def main():
    with Folder() as folder:
        girth = 2 * math.pi * RADIUS
        done, place = worn(folder, "fits", pattern(0.51 * girth))
        sound(done, place / "out", "the tube that fits")
        check("does not fit" not in done.stderr, f"the tube that fits does not: {done.stderr}")

        width = 0.45 * girth
        done, place = worn(folder, "short", pattern(width))
        check(done.returncode == 0, f"the narrow tube gave {done.returncode}: {done.stderr}")
        said = re.search(r"it is ([0-9.]+) cm around and worn ([0-9.]+) cm: ([0-9.]+) cm short", done.stderr)
        check(said, f"the narrow tube is not said to be short: {done.stderr}")
        rest, at, short = map(float, said.groups())
        check(abs(rest - 200 * width) < 0.2, f"the narrow tube is {200 * width} cm around, not {rest}")
        check(abs(at - 100 * girth) < 0.02 * 100 * girth, f"the ball is {100 * girth} cm around, not {at}")
        print(f"narrow tube: {said.group(0)}")

        done, place = worn(folder, "vest", vest(), VEST)
        sound(done, place / "out", "the vest")

        # A dart at the top of the front: a wedge of 2 cm on 5 cm, cut on through its tip.
        darted = pattern(0.53 * girth)
        half, wedge = 0.265 * girth, 0.01
        darted["panels"][0]["outline"] = [
            {"start": [x, y]} for x, y in ((-half, 0), (half, 0), (half, 0.12), (wedge, 0.12), (0, 0.07), (-wedge, 0.12),
                                           (-half, 0.12))]
        darted["seams"] = [{"name": "left", "a": ["front.1"], "b": ["back.3 reversed"]},
                           {"name": "right", "a": ["back.1"], "b": ["front.6 reversed"]},
                           {"name": "dart", "a": ["front.3"], "b": ["front.4 reversed"], "use": "dart"}]
        done, place = worn(folder, "dart", darted)
        sound(done, place / "out", "the tube with a dart")
        again = run("check", place / "out/case.json", cwd=folder)
        check(again.returncode == 0, f"the case of the results gave {again.returncode}: {again.stderr}")

        # The same as triangles, which meet vertex to vertex and are one once closed; one side seam is pressed open.
        cut = json.loads(json.dumps(CASE))
        cut["garment"]["model"] = "triangles"
        done, place = worn(folder, "triangles", darted, cut)
        sound(done, place / "out", "the tube of triangles")
        again = run("check", place / "out/case.json", cwd=folder)
        check(again.returncode == 0, f"the case of its results gave {again.returncode}: {again.stderr}")
        cut["garment"]["pattern"]["seams"] = [{"seam": "left", "stiffness": "1 mN"}]
        done, place = worn(folder, "sprung", darted, cut)
        sound(done, place / "out", "the tube of triangles with a spring along a seam")

        # Two darts of 3 mm on 5 cm, with a strip of 9 mm between them, and a band from 4 to 14 mm: all less than a cell wide.
        narrow = pattern(0.53 * girth)
        top = [(half, 0.12), (0.006, 0.12), (0.0045, 0.07), (0.003, 0.12), (-0.006, 0.12), (-0.0075, 0.07), (-0.009, 0.12),
               (-half, 0.12)]
        narrow["panels"][0]["outline"] = [{"start": [x, y]} for x, y in [(-half, 0), (half, 0)] + top]
        narrow["panels"].append({
            "name": "band", "outline": [{"start": [x, y]} for x, y in ((-half, 0), (half, 0), (half, 0.004), (-half, 0.014))],
            "placement": {"origin": [-0.14, 0, 0.07], "along_x": [0, -1, 0], "along_y": [0, 0, 1]}})
        narrow["seams"] = [{"name": "left", "a": ["front.1"], "b": ["back.3 reversed"]},
                           {"name": "right", "a": ["back.1"], "b": ["front.9 reversed"]},
                           {"name": "dart", "a": ["front.3"], "b": ["front.4 reversed"], "use": "dart"},
                           {"name": "other dart", "a": ["front.6"], "b": ["front.7 reversed"], "use": "dart"},
                           {"name": "band", "a": ["back.2"], "b": ["band.0 reversed"]}]
        done, place = worn(folder, "narrow", narrow)
        sound(done, place / "out", "the tube with narrow darts")

        # A side that the case has worn open and buttoned twice; the other one is stiffer than the file has it.
        opened = json.loads(json.dumps(CASE))
        opened["garment"]["pattern"]["seams"] = [
            {"seam": "left", "use": "opening", "open": True, "buttons": 2}, {"seam": "front.3", "stiffness": "1 mN"}]
        done, place = worn(folder, "open", pattern(0.53 * girth), opened)
        sound(done, place / "out", "the tube that is buttoned")
        opened["garment"]["pattern"]["seams"][0]["seam"] = "lfet"
        done, place = worn(folder, "misnamed", pattern(0.53 * girth), opened)
        check(done.returncode == 2 and 'case.json:1: garment.pattern.seams[0].seam: "lfet"' in done.stderr,
              f"a seam that is not there: {done.returncode}, {done.stderr}")
        for wrong_seam, said in (({"open": True}, "can be opened"), ({"use": "opening", "buttons": 2}, "is open"),
                                 ({"rest_angle": 1}, "of a spring")):
            wrong = pattern(0.53 * girth)
            wrong["seams"][0] |= wrong_seam
            done, place = worn(folder, f"wrong_{len(said)}", wrong)
            check(done.returncode == 2 and "tube.json" in done.stderr and said in done.stderr,
                  f"{wrong_seam}: {done.returncode}, {done.stderr}")

        hasty = json.loads(json.dumps(CASE))
        hasty["garment"]["pattern"]["close_within"] = "50 ms"
        done, place = worn(folder, "hasty", pattern(0.51 * girth), hasty)
        check(done.returncode == 1 and '"left: front.1 to back.3" by' in done.stderr,
              f"seams without time to close: {done.returncode}, {done.stderr}")

        wrong = pattern(0.51 * girth)
        del wrong["panels"][1]["placement"]
        done, place = worn(folder, "unplaced", wrong)
        check(done.returncode == 2 and "tube.json" in done.stderr and 'panel "back" has no placement' in done.stderr,
              f"a panel without placement: {done.returncode}, {done.stderr}")
        wrong = pattern(0.51 * girth)
        wrong["seams"][0]["a"] = ["front.1 from 0 to 0.3"]
        done, place = worn(folder, "unequal", wrong)
        check(done.returncode == 2 and "tube.json" in done.stderr and '"left: front.1 to back.3"' in done.stderr,
              f"a seam of unequal sides: {done.returncode}, {done.stderr}")
        limited = {**CASE, "strain_limit": {"mode": "upper_limit", "limit": 0.05}}
        done, place = worn(folder, "limited", pattern(0.51 * girth), limited)
        check(done.returncode == 2 and "strain_limit" in done.stderr, f"a limit of strain: {done.returncode}, {done.stderr}")


main()
