#!/usr/bin/env python3
"""What Man 2006, section 5.3, says of his sleeve, of the studies of the library that were run.

    sleeve.py [RESULTS]     the folder in which sleeve, sleeve_fit, sleeve_material and sleeve_starts lie [results]

`gambeson study cases/library/sleeve.study.json --resume` and so on make them; what was not run is left out, by name.
Torques at the elbow are judged by their means from 55 to 57 degrees; beside them stand means from 20 degrees, as the
course of one mesh scatters by a few per cent and its peak by a quarter. How much shows sleeve_starts: of each sleeve five
runs that start a little apart. There the ratio of the means counts, with its standard error and the range of the ratios of
single runs beside. Exit status 1 where an order does not hold.
"""

import csv
import json
import math
import pathlib
import statistics
import sys

MESHES = ("I", "II", "III", "IV")
RATE_PER_S, END_S, END_DEG = 1.0, 1.05, 57.0  # arm_flex.csv, after its start


class Study:
    """Torques of a study's variants, found by their levels."""

    def __init__(self, folder):
        self.folder = folder
        self.variants = {v["variant"]: v for v in json.loads((folder / "study.json").read_text())["variants"]}
        self.curves = {}
        with open(folder / "curves.csv", newline="") as stream:
            for row in csv.DictReader(stream):
                self.curves.setdefault(row["variant"], []).append((float(row["time_s"]), float(row["elbow_flexion_Nm"])))

    def name(self, **levels):
        """The shortest folder of these levels: variants with more set beside have longer ones."""
        found = [n for n, v in self.variants.items() if v["status"] == "done" and v["levels"] == levels]
        return min(found, key=len) if found else None

    def mean(self, begin_deg, **levels):
        """Mean torque [N m] from an angle to the end; None where the variant was not run."""
        return self.mean_of(self.name(**levels), begin_deg)

    def mean_of(self, name, begin_deg):
        begin_s = END_S - math.radians(END_DEG - begin_deg) / RATE_PER_S
        torques = [torque for time, torque in self.curves.get(name, []) if time >= begin_s]
        return sum(torques) / len(torques) if torques else None

    def meshes(self):
        return sorted({v["levels"]["mesh"] for v in self.variants.values()}, key=MESHES.index)

    def wall_s(self, name):
        return json.loads((self.folder / name / "run.json").read_text())["wall_s"]


class Judge:
    def __init__(self):
        self.failed = 0

    def say(self, what, value, low, high=math.inf, whole=None, counts=True):
        """`whole`: the same from 20 degrees on, shown beside. What does not `count` is shown alone."""
        if value is None:
            return print(f"  -     {what}: not run")
        holds = low <= value <= high
        self.failed += counts and not holds
        allowed = f"{low} to {high}".replace("-inf to", "at most").replace(" to inf", " and more")
        beside = f"; from 20 degrees {whole:.3g}" if whole is not None else ""
        print(f"  {'holds' if holds else 'FAILS' if counts else 'off  '} {what}: {value:.3g} ({allowed}){beside}")


def ratio(a, b):
    return a / b if a is not None and b is not None else None


def show(title, rows):
    print(title)
    for name, late, whole in rows:
        if late is not None:
            print(f"  {name:40s} {late:8.3f} N m from 55 degrees {whole:8.3f} from 20")


def mesh_and_friction(study, judge):
    for cloth in ("nurbs", "shell"):
        at, whole = ({(mesh, mu): study.mean(begin, cloth=cloth, mesh=mesh, friction=mu)
                      for mesh in MESHES for mu in ("0.1", "0.5")} for begin in (55, 20))
        show(f"Mesh and friction, {cloth}", [(f"mesh {m}, friction {mu}", at[m, mu], whole[m, mu]) for m, mu in at])
        for mu in ("0.1", "0.5"):
            steps = [ratio(at[a, mu], at[b, mu]) for a, b in zip(MESHES, MESHES[1:])]
            before = [ratio(whole[a, mu], whole[b, mu]) for a, b in zip(MESHES, MESHES[1:])]
            if None not in steps:
                judge.say(f"least step from mesh to mesh, friction {mu}", min(steps), 1, whole=min(before))
        spread, before = ([ratio(of["I", mu], of["IV", mu]) for mu in ("0.1", "0.5")] for of in (at, whole))
        judge.say("spread I/IV at friction 0.1 over that at 0.5", ratio(*spread), 1, whole=ratio(*before))
        if None not in spread:
            print(f"        spreads {spread[0]:.2f} and {spread[1]:.2f}; from 20 degrees {before[0]:.2f} and {before[1]:.2f}")
        judge.say("friction 0.5 over 0.1, mesh IV", ratio(at["IV", "0.5"], at["IV", "0.1"]), 1.3, 2.0,
                  whole=ratio(whole["IV", "0.5"], whole["IV", "0.1"]))
    smooth, cell = (study.name(cloth=cloth, mesh="IV", friction="0.1") for cloth in ("nurbs", "shell"))
    exact = [n for n in study.variants if cell and n.startswith(cell) and n != cell]
    if smooth and cell:
        judge.say("time of the shell with rotary cell over that of nurbs, mesh IV",
                  study.wall_s(cell) / study.wall_s(smooth), -math.inf, 2)
    for name in exact:
        print(f"        rotary exact: {study.wall_s(name) / study.wall_s(smooth):.2f} of the time of nurbs, "
              f"{study.mean_of(name, 20) / study.mean_of(cell, 20):.3f} of the torque of rotary cell from 20 degrees on")


def fit(study, judge):
    for cloth in ("nurbs", "shell"):
        for mesh in study.meshes():  # the finest counts
            counts = mesh == study.meshes()[-1]
            sleeves = ("tight", "loose", "thick", "thick, bending unchanged")
            late, whole = ({s: study.mean(begin, cloth=cloth, mesh=mesh, sleeve=s) for s in sleeves} for begin in (55, 20))
            show(f"Fit and thickness, {cloth}, mesh {mesh}", [(s, late[s], whole[s]) for s in sleeves])
            loose, tight = (study.mean(25, cloth=cloth, mesh=mesh, sleeve=s) for s in ("loose", "tight"))
            judge.say("70 over 60 mm, from 25 degrees on", ratio(loose, tight), -math.inf, 0.8, counts=counts)
            for sleeve, low, high in (("thick", 2.0, 2.6), ("thick, bending unchanged", 1.9, 2.1)):
                judge.say(f"{sleeve} (2 mm) over tight (1 mm)", ratio(late[sleeve], late["tight"]), low, high,
                          ratio(whole[sleeve], whole["tight"]), counts)


def material(study, judge):
    for mesh in study.meshes():
        names = ("crimped cotton", "straight cotton", "straight Kevlar", "crimped cotton, shear of 5.3")
        late = {n: study.mean(55, material=n, mesh=mesh) for n in names}
        show(f"Material, mesh {mesh}", [(n, late[n], study.mean(20, material=n, mesh=mesh)) for n in names])
        judge.say("straight over crimped cotton", ratio(late["straight cotton"], late["crimped cotton"]), 1)
        judge.say("straight Kevlar over straight cotton", ratio(late["straight Kevlar"], late["straight cotton"]), 1)


def starts(study, judge):
    """Ratios of sleeves over several starts: what one run of each would have said lies anywhere in the range."""
    labels = sorted({v["levels"]["start"] for v in study.variants.values()})
    torques = {}
    for begin in (55, 20):
        for sleeve in dict.fromkeys(v["levels"]["sleeve"] for v in study.variants.values()):
            runs = [study.mean(begin, sleeve=sleeve, start=label) for label in labels]
            torques[sleeve, begin] = [torque for torque in runs if torque is not None]
    print(f"Scatter over {len(labels)} starts, mesh IV unless II is said; +- is the standard deviation of one run")
    for sleeve, begin in torques:
        if begin == 55 and len(torques[sleeve, 55]) > 1:
            spread = [f"{statistics.mean(torques[sleeve, b]):8.3f} N m +- {100 * relative_deviation(torques[sleeve, b]):4.1f} %"
                      for b in (55, 20)]
            print(f"  {sleeve:40s} {spread[0]} from 55 degrees {spread[1]} from 20")
    for what, over, under, low, high in (
            ("2 mm over 1 mm", "smooth, thick", "smooth", 2.0, 2.6),
            ("2 mm that bends as 1 mm over 1 mm", "smooth, thick as limp", "smooth", 1.9, 2.1),
            ("the same, mesh II", "smooth II, thick as limp", "smooth II", 1.9, 2.1),
            ("friction 0.5 over 0.1", "smooth", "smooth, slick", 1.3, 2.0),
            ("friction 0.5 over 0.1, shell", "shell", "shell, slick", 1.3, 2.0)):
        a, b = ([torques.get((sleeve, begin), []) for begin in (55, 20)] for sleeve in (over, under))
        if any(len(runs) < 2 for runs in a + b):
            judge.say(what, None, low)
            continue
        late, whole = (statistics.mean(x) / statistics.mean(y) for x, y in zip(a, b))
        judge.say(what, late, low, high, whole=whole)
        for begin, x, y in zip((55, 20), a, b):
            error = math.hypot(relative_deviation(x) / math.sqrt(len(x)), relative_deviation(y) / math.sqrt(len(y)))
            single = [p / q for p in x for q in y]
            print(f"        from {begin} degrees +- {error * statistics.mean(x) / statistics.mean(y):.2f}; of single runs "
                  f"{min(single):.2f} to {max(single):.2f}")


def relative_deviation(values):
    return statistics.stdev(values) / statistics.mean(values)


def main():
    results = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "results")
    judge = Judge()
    for name, of in (("sleeve", mesh_and_friction), ("sleeve_fit", fit), ("sleeve_material", material),
                     ("sleeve_starts", starts)):
        if (results / name / "study.json").exists():
            of(Study(results / name), judge)
        else:
            print(f"{name}: not run in {results}")
    sys.exit(judge.failed > 0)


if __name__ == "__main__":
    main()
