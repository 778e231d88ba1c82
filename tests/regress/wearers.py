#!/usr/bin/env python3
"""Coarse shorts on everyone who can wear them: put on and worn standing by the six manikins with their skins and by the
public characters, and worn through a stride of the public recordings.

    wearers.py GAMBESON CROSSINGS_CHECK [--jobs N] [--walk] [NAME...]

Of each run: no intersection at any frame by exact predicates that are not our own, no point of the cloth, four times
finer than its samples, inside the skin at any frame, and every other check that a run makes of itself but the balance
of energy of those who stand, which is printed (its works are a few millijoule). --walk: the characters also walk and climb stairs.
Those that need public data that are not there are left out; 77 where none is left.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import time

from common import SKIPPED, SOURCE, Folder, check

DATA = pathlib.Path(os.environ.get("GAMBESON_DATA", SOURCE / ".." / "shared" / "data")).resolve() / "real"
MOTION, BODY = DATA / "motion", DATA / "body"
MALE = {"file": str(BODY / "quaternius_Superhero_Male_FullBody.gltf")}
MAKEHUMAN = {"file": str(BODY / "makehuman_base.obj"), "skeleton": str(BODY / "makehuman_default.mhskel"),
             "weights": str(BODY / "makehuman_default_weights.mhw"),
             "targets": [{"file": str(BODY / "makehuman_caucasian_male_young.target")},
                         {"file": str(BODY / "makehuman_male_maxmuscle_averageweight.target")}]}
STAND = {"stand": {"duration": "0.2 s"}}


def recorded(name, **options):
    return {"file": {"path": str(MOTION / name), **options}}


def wearers(walk):
    """Name of the run -> human."""
    skin = {"cell": "14 mm"}
    out = {name: {"manikin": name, "skin": skin, "motion": STAND}
           for name in ("male_p5", "male_p50", "male_p95", "female_p5", "female_p50", "female_p95")}
    # Limbs are held apart where the recorded subject's were thinner than ours.
    motions = {
        "mot": recorded("opensim_gait2392_subject01_walk1_ik.mot", **{"from": 1, "to": 2.4}, travel="feet"),
        "mot_full_body": recorded("opencap_walking1.mot", **{"from": 0, "to": 1.57}, hips_apart="3 deg"),
        "trc": recorded("opensim_gait2392_subject01_walk_free_01.trc", **{"from": 3.067, "to": 4.267}, travel="feet",
                        hips_apart="3 deg", arms_apart="10 deg",
                        model=str(DATA / "human" / "opensim_subject01_gait2392_scaled.osim")),
        "bvh": recorded("snu_woody_walk_normal_straight.bvh", **{"from": 3, "to": 4.6}, hips_apart="4 deg",
                        arms_apart="12 deg")}
    if MOTION.exists():
        out |= {name: {"manikin": "male_p50", "skin": skin, "motion": m} for name, m in motions.items()}
    if BODY.exists():
        for name, character in (("gltf", MALE), ("makehuman", MAKEHUMAN)):
            out[name] = {"character": character, "motion": STAND}
            if walk:
                out[name + "_walks"] = {"character": character, "motion": {"walk": {"strides": 1}}}
                out[name + "_climbs"] = {"character": {**character, "switch_off_folds": True},
                                         "motion": {"stairs": {"strides": 1, "lead_in_strides": 0}}}
    return out


def case(name, human):
    made = json.loads((SOURCE / "cases/library/shorts_walk_skin.json").read_text())
    moves = "stand" not in human["motion"]
    made |= {"name": name, "human": human}
    # Three samples per cell: with two the cloth bulges up to 0.8 mm into a walking body between them.
    made["garment"] = {"shorts": {"inseam": "20 cm", "ease": "6 %", "cell": "26.5 mm"}, "samples_per_cell": 3}
    made["air"] = {"drag": "4 kg/(m^2 s)", "velocity": "pelvis_mean" if moves else [0, 0, 0]}
    made["output"] = {"window": "10 ms", "frame": "20 ms", "checkpoint": "20 ms"}  # every frame in double precision
    made["analysis"] = {"joints": ["hip_flexion_left", "hip_flexion_right"], "counting": "all_distal"}
    return made


def wear(program, checker, name, human, folder):
    file, out = folder / f"{name}.json", folder / name
    file.write_text(json.dumps(case(name, human)))
    begin, one = time.monotonic(), {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run([program, "run", str(file), "--out", str(out)], capture_output=True, text=True, env=one)
    faults, numbers, energy = [], {}, float("nan")
    if done.returncode != 0:
        faults.append((done.stderr.strip().splitlines() or ["no message"])[-1])
    else:
        summary = json.loads((out / "summary.json").read_text())
        stands = "stand" in human["motion"]
        faults += [f"{c['check']} {c['value']:.3g} {c['unit']}" for c in summary["audit"]
                   if not c["holds"] and not (stands and c["check"] == "Energy")]
        energy = next(c["value"] for c in summary["audit"] if c["check"] == "Energy")
        numbers = {j["joint"]: j["peak_Nm"] for j in summary["joints"] if j["joint"].startswith("hip_flexion")}
        exact = subprocess.run([checker, str(out)], capture_output=True, text=True, env=one)
        if exact.returncode != 0:
            faults.append("cloth intersects: " + (exact.stdout.strip().splitlines() or ["no message"])[-1])
    return name, faults, numbers, energy, time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gambeson")
    parser.add_argument("checker")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--walk", action="store_true")
    options = parser.parse_args()
    todo = wearers(options.walk)
    if options.names:
        todo = {n: h for n, h in todo.items() if n in options.names}
    if not todo:
        print(f"none of {', '.join(options.names)}: no public data at {DATA}")
        return SKIPPED
    bad = 0
    with Folder() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        program, checker = (str(pathlib.Path(p).resolve()) for p in (options.gambeson, options.checker))
        runs = [pool.submit(wear, program, checker, n, h, pathlib.Path(folder)) for n, h in todo.items()]
        for r in concurrent.futures.as_completed(runs):
            name, faults, numbers, energy, seconds = r.result()
            bad += bool(faults)
            peaks = ", ".join(f"{j} {v:.2f} N m" for j, v in numbers.items())
            print(f"{name:16} {seconds:6.0f} s  {peaks}  energy {energy:.1f} %  {'; '.join(faults) or 'ok'}", flush=True)
        check(bad == 0, f"{bad} of {len(todo)} do not wear the shorts as they should")
    return 0


if __name__ == "__main__":
    sys.exit(main())
