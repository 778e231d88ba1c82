"""crossings_check finds nothing in a run that is right, recorded or stepped again, and says so where cloth intersects
or the recording is another's.

usage: crossings_check.py GAMBESON CROSSINGS_CHECK
"""
import json
import shutil
import subprocess
import sys

from common import HERE, Folder, check, run_case

CASE = {
    "name": "A sheet on a block",
    "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 8, "cells_v": 8, "corner": [-0.05, -0.05, 0.032]}, "noise": "0.1 mm"},
    "fabric": {"thickness": "1 mm", "surface_density": "0.144 kg/m^2", "young": "30 kPa", "poisson": 0.3,
               "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"}},
    "obstacles": [{"name": "ball", "sphere": {"radius": "0.03 m", "rings": 9, "segments": 12}}],
    "contact": {"friction": 0.2},
    "time": {"duration": "0.06 s"},
    "output": {"window": "5 ms", "frame": "10 ms", "checkpoint": "20 ms", "pictures": []},
}


def look(expect, *arguments, say=()):
    done = subprocess.run([sys.argv[2], *map(str, arguments)], capture_output=True, text=True)
    text = done.stdout + done.stderr
    check(done.returncode == expect, f"exit {done.returncode}, expected {expect}:\n{text}")
    for words in say:
        check(words in text, f"'{words}' is missing in:\n{text}")


with Folder() as folder:
    case = folder / "sheet.json"
    case.write_text(json.dumps(CASE))
    run_case(case, folder / "run")
    look(0, folder / "run", say=["3 of 6 frames are in double", "6 frames, 0 with"])
    look(0, folder / "run", "--again", "--every-step", say=["6 of 6 frames are those recorded"])
    look(0, case, say=["7 frames and the start, 0 with"])
    # A body that begins in the cloth: both kinds of pair.
    through = ["--set", "garment.sheet.corner=[-0.05, -0.05, 0.029]", "--set", "time.duration=2 ms"]
    look(1, case, *through, say=["with ball"])
    # Another case in the same folder: not the frames that were recorded.
    shutil.copytree(folder / "run", folder / "other")
    changed = json.loads((folder / "other" / "case.json").read_text())
    changed["garment"]["sheet"]["corner"] = ["-50 mm", "-50 mm", "32.5 mm"]
    (folder / "other" / "case.json").write_text(json.dumps(changed))
    look(1, folder / "other", "--again", say=["0 of 6 frames are those recorded"])
    look(2, folder / "other", "--every-step", say=["needs --again"])
    look(2, folder / "nothing")
print("crossings_check sees what is wrong")
