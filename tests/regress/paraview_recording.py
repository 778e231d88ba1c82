#!/usr/bin/env python3
"""The distribution's ParaView opens a recording, also one whose writer was killed, and sees what summary.json says.

    paraview_recording.py [GAMBESON]
"""

import json
import shutil
import subprocess
import sys
import time

from common import HERE, SKIPPED, Folder, check, command, run_case, summary

CASE = HERE / "shorts.json"


def seen(folder):
    done = subprocess.run(["pvpython", "--force-offscreen-rendering", HERE / "paraview_check.py", folder, "stress"],
                          capture_output=True, text=True, timeout=120, cwd="/")
    check(done.returncode == 0, f"ParaView does not open {folder}: {done.stderr}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def main():
    if not shutil.which("pvpython"):
        print("pvpython is not installed: skipped")
        return SKIPPED
    with Folder() as folder:
        whole, cut = folder / "whole", folder / "cut"
        run_case(CASE, whole)
        picture, numbers = seen(whole), summary(whole)
        recorded = numbers["recording"]
        expected = {
            "range_all_frames": [recorded["stress_low_N_per_m"], recorded["stress_high_N_per_m"]],
            "range_last_frame": [recorded["last_frame_stress_low_N_per_m"], recorded["last_frame_stress_high_N_per_m"]],
            "bounds": [x for pair in zip(recorded["last_frame_low_m"], recorded["last_frame_high_m"]) for x in pair],
            "points": [numbers["samples"], numbers["control_points"]],
        }
        for key, value in expected.items():
            check(picture[key] == value, f"{key}: ParaView sees {picture[key]}, summary.json says {value}")
        times = picture["times"]
        check(times == sorted(set(times)) and times[-1] == numbers["recorded_to_s"], f"times: {times}")
        check(all(b - a < 0.02 + 1e-9 for a, b in zip(times, times[1:])), f"frames are missing: {times}")
        for name, components in (("velocity", 3), ("contact_force", 3), ("pressure", 1), ("stress", 1), ("strain", 1)):
            check(picture["arrays"].get(name) == components, f"arrays: {picture['arrays']}")
        print("times", times, "bounds", picture["bounds"], "stress", picture["range_all_frames"], "N/m")

        process = subprocess.Popen(command("run", CASE, "--out", cut), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (cut / "frames/segment_000003.h5").exists():
            check(process.poll() is None, "the run ended before it could be killed")
            time.sleep(0.002)
        process.kill()
        process.wait()
        check(not (cut / "summary.json").exists(), "the run had ended before it was killed")
        after = seen(cut)
        check(0 < len(after["times"]) < len(times) and after["times"] == times[:len(after["times"])],
              f"after the kill: {after['times']}")
        check(expected["range_all_frames"][0] <= after["range_all_frames"][0] <= after["range_all_frames"][1]
              <= expected["range_all_frames"][1], f"after the kill: {after['range_all_frames']}")
        print("after a kill:", len(after["times"]), "frames, bounds", after["bounds"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
