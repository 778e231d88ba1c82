#!/usr/bin/env python3
"""The coarse armour and the coarse shorts on everyone who can wear them: shorts, belt and shirt put on and worn
standing by the six manikins with their skins and by the public characters, each drafted on its wearer, and the shorts
worn through a stride of the public recordings, on a skin and on ellipsoids. Trousers down to the ankle and shirts with
sleeves down to the wrist walk, climb stairs, step over an obstacle and sit down on all of them; the shirts also take
aim.

    wearers.py GAMBESON CROSSINGS_CHECK [--jobs N] [--walk] [--no-pictures] [--duration TIME] [NAME...]

Of each run: no intersection at any frame by exact predicates that are not our own, no point of the cloth, four times
finer than its samples, inside the skin at any frame, and every other check that a run makes of itself. Of the armour
also: nothing intersects at any step, the first one and those of settling included, no point of it is inside the skin by
anything at all, and its strap legs add up to 15.4 cm. --walk: the characters also walk and
climb stairs, in shorts. --duration: only so much of each motion, "0.5 s". Those that need public data that are not
there are named and left out; 77 where none is left. A line for each run: seconds of the processor, steps, those whose
contacts were not solved, pairs of triangles that intersect at most, millimetres inside the skin, torques or masses;
"ok" where its own checks hold and no triangles intersect.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

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


MANIKINS = ("male_p5", "male_p50", "male_p95", "female_p5", "female_p50", "female_p95")
RECORDED = ("mot", "mot_full_body", "trc", "bvh", "bvh_low", "bvh_clip")
CHARACTERS = {"gltf": MALE, "makehuman": MAKEHUMAN}


TROUSERS = {"trousers_stand": STAND, "trousers_walk": {"walk": {"lead_in": "0.5 s", "strides": 1}},
            "trousers_stairs": {"stairs": {"strides": 1, "lead_in_strides": 0}},
            "trousers_step_over": {"step_over": {"height": "0.3 m"}}, "trousers_sit": {"sit": {}}}
SLEEVES = {task.replace("trousers", "sleeves"): motion for task, motion in TROUSERS.items() if task != "trousers_stand"}
SLEEVES["sleeves_aim"] = {"aim": {"duration": "1.5 s", "rifle": "3.5 kg"}}


def stands(human):
    return "stand" in human["motion"]


def in_trousers(name):
    return "_trousers_" in name


def in_sleeves(name):
    return "_sleeves_" in name


def wearers(walk):
    """Name of the run -> human; and the names of those that cannot run here."""
    out = {name: {"manikin": name, "skin": {}, "motion": STAND} for name in MANIKINS}
    # Limbs are held apart where the recorded subject's were thinner than ours.
    motions = (
        recorded("opensim_gait2392_subject01_walk1_ik.mot", **{"from": 1, "to": 2.4}, travel="feet"),
        recorded("opencap_walking1.mot", **{"from": 0, "to": 1.57}, hips_apart="3 deg"),
        recorded("opensim_gait2392_subject01_walk_free_01.trc", **{"from": 3.067, "to": 4.267}, travel="feet",
                 hips_apart="3 deg", arms_apart="10 deg",
                 model=str(DATA / "human" / "opensim_subject01_gait2392_scaled.osim")),
        recorded("snu_woody_walk_normal_straight.bvh", **{"from": 3, "to": 4.6}, hips_apart="4 deg",
                 arms_apart="12 deg"),
        recorded("snu_woody_low_walk.bvh", **{"from": 2, "to": 3.8}, hips_apart="4 deg", arms_apart="12 deg"),
        recorded("makehuman_walk1.bvh", slower=1.8, travel="feet", hips_apart="8 deg", arms_apart="12 deg"))
    for name in MANIKINS:
        out |= {f"{name}_{task}": {"manikin": name, "skin": {"cell": "14 mm"}, "motion": motion}
                for task, motion in (TROUSERS | SLEEVES).items()}
    absent = []
    if MOTION.exists():
        for name, motion in zip(RECORDED, motions):
            out[name] = {"manikin": "male_p50", "skin": {"cell": "14 mm"}, "motion": motion}
            out[name + "_ellipsoids"] = {"manikin": "male_p50", "motion": motion}
    else:
        absent += RECORDED
    if BODY.exists():
        for name, character in CHARACTERS.items():
            out[name] = {"character": character, "motion": STAND}
            # The quaternius man's thighs clear 0.26 m.
            lower = {f"{worn}_step_over": {"step_over": {"height": "0.25 m"}} for worn in ("trousers", "sleeves")}
            out |= {f"{name}_{task}": {"character": {**character, "bridge_folds": "10 mm"}, "motion": motion}
                    for task, motion in (TROUSERS | SLEEVES | lower).items()}
            if walk:
                out[name + "_walks"] = {"character": character, "motion": {"walk": {"strides": 1}}}
                out[name + "_climbs"] = {"character": {**character, "bridge_folds": "10 mm"},
                                         "motion": {"stairs": {"strides": 1, "lead_in_strides": 0}}}
    else:
        absent += CHARACTERS
    return out, absent


def longest(program, made, folder, shape, key):
    """The longest legs or sleeves [cm] that `check` says can be drafted on this wearer."""
    file = folder / f"{made['name']}_longest.json"
    file.write_text(json.dumps(made | {"garment": {shape: {**made["garment"][shape], key: "1 m"}}}))
    said = subprocess.run([program, "check", str(file)], capture_output=True, text=True).stderr
    found = re.search(key + r": .*at most ([0-9.]+) cm on ", said)
    check(found is not None, f"{made['name']}: check says no longest {key}: {said}")
    return float(found.group(1))


def case(name, human, program, folder):
    # Every frame in double precision.
    output = {"window": "10 ms", "frame": "20 ms", "checkpoint": "20 ms"}
    if stands(human) and not in_trousers(name):  # no sleeves stand
        made = json.loads((SOURCE / "cases/library/armour_stand.json").read_text())
        return made | {"name": name, "human": human, "output": output}
    made = json.loads((SOURCE / "cases/library/shorts_walk_skin.json").read_text())
    made |= {"name": name, "human": human, "output": output}
    # Three samples per cell: with two the cloth bulges up to 0.8 mm into a walking body between them.
    crouches = "low_walk" in human["motion"].get("file", {}).get("path", "")
    made["garment"] = {"shorts": {"inseam": "20 cm", "ease": "12 %" if crouches else "6 %", "cell": "26.5 mm"}, "samples_per_cell": 3}
    if crouches:  # the seat needs room, and the waist a band: it is drawn down by 6 cm else
        made["supports"] = [{"springs": {"edge": "waist", "stiffness": "8000 N/m^2", "link": "pelvis"}}]
    # Skins of characters have cells of their own, some of 5 mm, and floors of bridged folds.
    samples = 4 if "character" in human else 3
    if in_trousers(name):
        made["garment"] = {"shorts": {"ease": "12 %", "waist_ease": "6 %", "cell": "35 mm"}, "samples_per_cell": samples}
        made["supports"] = [{"springs": {"edge": "waist", "stiffness": "8000 N/m^2", "link": "pelvis"}}]
        made["output"] = output | {"pictures": []}
        made["analysis"] = {"joints": ["hip_flexion_left", "hip_flexion_right", "knee_flexion_left",
                                       "knee_flexion_right"], "counting": "all_distal"}
        made.pop("air")
        inseam = longest(program, made, folder, "shorts", "inseam") - 1
        made["garment"]["shorts"]["inseam"] = f"{inseam:.1f} cm"
        return made
    if in_sleeves(name):
        made["garment"] = {"shirt": {"sleeve_ease": "15 %", "cell": "35 mm"}, "samples_per_cell": samples}
        made["fabric"] = {"thickness": "0.762 mm", "density": "436 kg/m^3", "young": "200 kPa", "poisson": 0.3,
                          "bending": {"law": "linear", "rigidity": "1e-4 N m"}}
        made["supports"] = []
        made["dressing"] = {"settle": "0.3 s"}
        made["output"] = output | {"pictures": []}
        made["analysis"] = {"joints": ["elbow_flexion_left", "elbow_flexion_right", "shoulder_flexion_left",
                                       "shoulder_flexion_right"], "counting": "all_distal"}
        made.pop("air")
        made["garment"]["shirt"]["sleeve_length"] = f"{longest(program, made, folder, 'shirt', 'sleeve_length') - 1:.1f} cm"
        return made
    made["air"] = {"drag": "4 kg/(m^2 s)", "velocity": "pelvis_mean"}
    made["analysis"] = {"joints": ["hip_flexion_left", "hip_flexion_right"], "counting": "all_distal"}
    return made


def armour_faults(summary):
    """What the audit of a run does not ask for."""
    faults, depth = [], summary["deepest_penetration_of_finer_surface"]
    most = summary["collisions"]["most_intersections"]
    if most != 0:
        faults.append(f"{most} intersections at a step")
    if not depth["deepest_m"] <= 0:
        faults.append(f"{1e3 * depth['deepest_m']:.3f} mm inside the skin")
    legs = summary["straps"]["width_m"]
    if not abs(legs - 0.154) < 0.001:
        faults.append(f"strap legs of {100 * legs:.2f} cm")
    return faults


def words(summary, human, name):
    depth = summary["deepest_penetration_of_finer_surface"]
    said = (f"{summary['steps']['count']:6} steps, {summary['contact_solver']['unconverged_steps']} unsolved, "
            f"{1e3 * depth['deepest_m']:.3f} mm deep, ")
    if stands(human) and not in_trousers(name):
        return said + ", ".join(f"{g['garment']} {g['mass_kg']:.3f} kg" for g in summary["garments"])
    peaks = {}  # of left and right
    for j in summary["joints"]:
        joint = re.sub("_(left|right)$", "", j["joint"])
        peaks[joint] = max(abs(j["peak_Nm"]), peaks.get(joint, 0))
    return said + ", ".join(f"{joint} {peak:.2f} N m" for joint, peak in peaks.items())


def spent(arguments):
    """Runs a program on one thread. Returns its exit status, what it wrote, and its seconds of the processor."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
        started = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=out, stderr=errors, text=True,
                                   env={**os.environ, "OMP_NUM_THREADS": "1"})
        _, status, usage = os.wait4(started.pid, 0)
        started.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0), errors.seek(0)
        return started.returncode, out.read(), errors.read(), usage.ru_utime + usage.ru_stime


def last(text):
    return (text.strip().splitlines() or ["no message"])[-1]


def wear(program, checker, name, human, folder, options):
    """Name, faults, numbers."""
    file, out = folder / f"{name}.json", folder / name
    made = case(name, human, program, folder)
    if options.no_pictures:
        made["output"]["pictures"] = []
    if options.duration:
        made["time"] = made.get("time", {}) | {"duration": options.duration}
    file.write_text(json.dumps(made))
    status, _, errors, seconds = spent([program, "run", str(file), "--out", str(out)])
    said = f"{seconds:6.0f} s of CPU"
    if status != 0:
        return name, [last(errors)], said
    summary = json.loads((out / "summary.json").read_text())
    faults = [f"{c['check']} {c['value']:.3g} {c['unit']}" for c in summary["audit"] if not c["holds"]]
    if stands(human) and not in_trousers(name):
        faults += armour_faults(summary)
    status, looked, errors, _ = spent([checker, str(out)])
    found = re.search(r"(\d+) frames, (\d+) with intersections, (\d+) pairs at most", looked)
    if status != 0 or not found:
        faults.append("cloth intersects: " + last(looked) if found else "crossings not checked: " + last(errors))
    crossings = f"{found.group(3)} crossings" if found else "crossings unknown"
    return name, faults, f"{said}, {words(summary, human, name)}, {crossings}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gambeson")
    parser.add_argument("checker")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--walk", action="store_true")
    parser.add_argument("--no-pictures", action="store_true")
    parser.add_argument("--duration")
    options = parser.parse_intermixed_args()
    todo, absent = wearers(options.walk)
    if options.names:
        unknown = [n for n in options.names if n not in todo and n not in absent]
        check(not unknown, f"no such runs: {', '.join(unknown)}")
        todo = {n: h for n, h in todo.items() if n in options.names}
        absent = [n for n in absent if n in options.names]
    if absent:
        print(f"left out, for there are no public data at {DATA}: {', '.join(absent)}", flush=True)
    if not todo:
        return SKIPPED
    bad = 0
    with Folder() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        program, checker = (str(pathlib.Path(p).resolve()) for p in (options.gambeson, options.checker))
        runs = [pool.submit(wear, program, checker, n, h, pathlib.Path(folder), options) for n, h in todo.items()]
        for r in concurrent.futures.as_completed(runs):
            name, faults, said = r.result()
            bad += bool(faults)
            print(f"{name:26} {said}  {'; '.join(faults) or 'ok'}", flush=True)
        check(bad == 0, f"{bad} of {len(todo)} do not wear what they should as they should")
    return 0


if __name__ == "__main__":
    sys.exit(main())
