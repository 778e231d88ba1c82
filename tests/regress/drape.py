#!/usr/bin/env python3
"""Cusick's drape coefficient, simulated from the numbers of a card, is within 8 points of the one that was measured on
the same cloth: the six woven fabrics of Petrak et al. 2025 (cases/library/cards/petrak_*). Minutes of one core.

    drape.py GAMBESON
"""

import json

from common import SOURCE, Folder, check, run

POINTS, AT_LEAST = 8, 3


def main():
    off = {}
    for card in sorted((SOURCE / "cases/library/cards").glob("petrak_*.card.json")):
        with Folder() as folder:
            done = run("fabric", card, "--test", "drape", "--out", folder / "lab")
            check(done.returncode == 0, f"{card.name} gave {done.returncode}: {done.stderr}")
            test = json.loads((folder / "lab/laboratory.json").read_text())["tests"][0]
            reading = test["readings"][0]
            check(reading["name"] == "drape coefficient", reading)
            off[card.stem] = reading["difference_points"]
            print(f"{card.stem}: measured {reading['card']:.1f} %, simulated {reading['measured']:.1f} %, "
                  f"{test['readings'][1]['measured']:.0f} nodes, {test['self_crossings']} crossings")
    within = [name for name, points in off.items() if abs(points) <= POINTS]
    check(len(within) >= AT_LEAST, f"only {within} are within {POINTS} points: {off}")
    print(f"{len(within)} of {len(off)} within {POINTS} points")


if __name__ == "__main__":
    main()
