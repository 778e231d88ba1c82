#!/usr/bin/env python3
"""The search of a thickness map, as a whole: killed and resumed it comes to the same map, byte for byte.

    optimise.py [GAMBESON]             three regions of tiny shorts, two maps
    optimise.py [GAMBESON] --shorts    shorts_map of the library: the map's gain is above its error bar, at equal mass,
                                       and the finer mesh has it; killed and resumed

What is compared: study.json, maps.csv, the page, and the results of every run.
"""

import csv
import json
import random
import shutil
import subprocess
import sys
import time

from common import HERE, SOURCE, Folder, check, command, results, run


def tiny(folder, **more):
    case = json.loads((HERE / "shorts.json").read_text())
    case["garment"]["shorts"]["cell"] = "80 mm"
    case["garment"]["regions"] = [
        {"name": "trunk", "parts": [{"patch": "trunk_left"}, {"patch": "trunk_right"}]},
        {"name": "outer", "parts": [{"patch": "outer_left"}, {"patch": "outer_right"}]},
        {"name": "inner", "parts": [{"patch": "inner_left"}, {"patch": "inner_right"}]}]
    case["dressing"] = {"projecting": {"clearance": "5 mm", "grow": "40 ms"}, "settle": "20 ms"}
    case["human"]["motion"]["walk"]["lead_in"] = "100 ms"
    case["time"] = {"duration": "60 ms", "max_step": "0.5 ms"}
    case["output"] = {"window": "10 ms", "frame": "20 ms", "checkpoint": "20 ms", "viewer": False}
    (folder / "shorts.json").write_text(json.dumps(case))
    text = {"name": "tiny", "case": "shorts.json", "pictures": [],
            "optimise": {"minimise": "torque", "between": [0.6, 1.5], "runs": 2, "repeats": [], **more}}
    (folder / "a.study.json").write_text(json.dumps(text, indent=1))
    return folder / "a.study.json"


def contents(out):
    files = {name: (out / name).read_bytes() for name in ("study.json", "maps.csv", "variants.csv", "report.html")}
    for row in csv.DictReader((out / "maps.csv").open()):
        for name, content in results(out / row["variant"]).items():
            files[row["variant"] + "/" + name] = content
    return files


def cut_at(wait_s, file, out):
    """Kills the search after a while."""
    process = subprocess.Popen(command("study", file, "--out", out, "--resume", "--threads", 1),
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        process.wait(wait_s)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def same_after(file, whole, out):
    """The search goes on to the end, and leaves what one that was left alone left."""
    last = run("study", file, "--out", out, "--resume", "--threads", 1)
    check(last.returncode == 0, f"the resumed search failed: {last.stdout} {last.stderr}")
    whole, cut = contents(whole), contents(out)
    other = [name for name in whole.keys() | cut.keys() if whole.get(name) != cut.get(name)]
    check(not other, f"these differ: {other}")
    return json.loads(whole["study.json"])["optimise"]


def searched(file, out):
    begin = time.monotonic()
    done = run("study", file, "--out", out, "--threads", 2)
    check(done.returncode == 0, f"the search failed: {done.stdout} {done.stderr}")
    return time.monotonic() - begin


def equal_mass(numbers, within):
    for pair in [numbers] + numbers.get("repeats", []) + ([numbers["finer"]] if "finer" in numbers else []):
        start, best = pair["start"]["mass_kg"], pair["best"]["mass_kg"]
        check(abs(best / start - 1) < within, f"the map weighs {best} kg, the start {start}")


def small(folder):
    file, whole, cut = tiny(folder), folder / "whole", folder / "cut"
    took_s = searched(file, whole)
    tried = list(csv.DictReader((whole / "maps.csv").open()))
    check([r["what"] for r in tried] == ["search"] * 2, f"other maps: {tried}")
    check(abs(float(tried[1]["mass_kg"]) / float(tried[0]["mass_kg"]) - 1) < 1e-6, f"masses differ: {tried}")
    # Its first map is done, its second is begun and killed.
    shutil.copytree(whole / tried[0]["variant"], cut / tried[0]["variant"])
    cut_at(random.Random(20130620).uniform(0.2, 0.4) * took_s, file, cut)
    check((cut / tried[0]["variant"] / "summary.json").stat().st_mtime_ns == (whole / tried[0]["variant"] / "summary.json").stat().st_mtime_ns,
          "a map that was done ran again")
    found = same_after(file, whole, cut)
    least = min(tried, key=lambda r: float(r["torque_Nm"]))
    check(found["best"]["variant"] == least["variant"], f"the best is {least}, not {found['best']}")
    check(not found["sure"], "a gain is sure that nothing was repeated of")
    done = run("study", file, "--out", whole, "--compare")
    check(done.returncode == 0, f"--compare gave {done.returncode}: {done.stderr}")
    print(f"{found['runs']} maps, the same after a kill")


def refused(folder):
    file = tiny(folder)
    for key, value, said in (("keep", ["hem"], 'optimise.keep[0]: there is no region "hem"; allowed: trunk, outer or inner'),
                             ("keep", ["trunk", "outer"], "1 region of the garment is free"),
                             ("limit", 3, "optimise.limit"), ("between", [1.2, 1.5], "leaves out the case's own factor"),
                             ("joints", ["knee_left"], "the case does not analyse"), ("runs", 1, "optimise.runs"),
                             ("repeats", [{"time.step_safety": 7}], "time.step_safety")):
        text = json.loads(file.read_text())
        text["optimise"][key] = value
        (folder / "b.study.json").write_text(json.dumps(text, indent=1))
        done = run("study", folder / "b.study.json", "--out", folder / "out", "--check")
        check(done.returncode == 2 and "b.study.json:" in done.stderr and said in done.stderr, f"{key}: {done.returncode} {done.stderr}")
    done = run("study", file, "--out", folder / "out", "--engine", "slurm")
    check(done.returncode == 2 and "--engine" in done.stderr, f"{done.returncode} {done.stderr}")
    check(not (folder / "out").exists(), "what was refused left something")


def shorts(folder):
    file, whole, cut = SOURCE / "cases/library/shorts_map.study.json", folder / "whole", folder / "cut"
    took_s = searched(file, whole)
    chance = random.Random(20130620)
    for _ in range(3):
        cut_at(chance.uniform(0.2, 0.5) * took_s, file, cut)
    numbers = same_after(file, whole, cut)
    equal_mass(numbers, 1e-5)
    check(numbers["sure"], f"the gain is not sure: {numbers['gain']} with a bar of {numbers['error_bar']}")
    check(numbers["gain_on_finer_mesh"] > numbers["noise"], f"the finer mesh gains {numbers['gain_on_finer_mesh']}")
    print(f"gain {numbers['gain']:.3f}, error bar {numbers['error_bar']:.3f}, on the finer mesh {numbers['gain_on_finer_mesh']:.3f}")


def main():
    for test in (shorts,) if "--shorts" in sys.argv else (refused, small):
        with Folder() as folder:
            test(folder)
            print(test.__name__, "good")


if __name__ == "__main__":
    main()
