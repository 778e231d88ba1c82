#!/usr/bin/env python3
"""The drape coefficient, simulated from the numbers of a card, is within 8 points of the one that was measured on the
same cloth, with no doubt left by starts and mesh: the six woven fabrics of Petrak et al. 2025 (cases/library/cards). Minutes of one core.

    drape.py GAMBESON
"""

import json

from common import SOURCE, Folder, check, run

POINTS, AT_LEAST = 8, 3


def main():
    off, doubt = {}, {}
    for card in sorted((SOURCE / "cases/library/cards").glob("petrak_*.card.json")):
        with Folder() as folder:
            done = run("fabric", card, "--test", "drape", "--out", folder / "lab")
            check(done.returncode == 0, f"{card.name} gave {done.returncode}: {done.stderr}")
            test = json.loads((folder / "lab/laboratory.json").read_text())["tests"][0]
            reading = test["readings"][0]
            check(reading["name"] == "drape coefficient", reading)
            check(test["at_rest"], f"{card.name}: {test['starts']}")
            off[card.stem] = reading["difference_points"]
            doubt[card.stem] = test["spread_points"] + abs(test["mesh_points"])
            print(f"{card.stem}: measured {reading['card']:.1f} %, simulated {reading['measured']:.1f} %, "
                  f"{test['readings'][1]['measured']:.0f} nodes, {test['self_crossings']} crossings, "
                  f"spread {test['spread_points']:.1f}, mesh {test['mesh_points']:+.1f}")
    within = [name for name, points in off.items() if abs(points) + doubt[name] <= POINTS]
    check(len(within) >= AT_LEAST, f"only {within} are within {POINTS} points: {off}, in doubt by {doubt}")
    print(f"{len(within)} of {len(off)} within {POINTS} points")


if __name__ == "__main__":
    main()
