#!/usr/bin/env python3
"""A run that stretches cloth past the limit of its card fails a check that names the card, from the card's file to the
page; one within it does not.

    cards.py GAMBESON
"""

import json

from common import HERE, Folder, check, run, summary

CARD = {
    "name": "Limited cloth", "source": "made up for a test", "description": "what no laboratory measured",
    "weight": "700 g/m^2", "tensile": {"modulus": "300 N/m"}, "shear": {"G": "100 N/(m rad)"},
    "bending": {"B": "1e-4 N m"},
}

STRIP = {
    "kind": "static", "name": "strip",
    "sheet": {"plate": {"width": 0.2, "height": 0.05}, "cells_u": 4, "cells_v": 1},
    "material": {"fabric": {"card": "limited.card.json"}},
    "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz", "move": [0.012, 0, 0]},
                 {"edge": "v0", "hold": "yz"}, {"edge": "v1", "hold": "yz"}],
    "solver": {"steps": 2}, "output": {"shapes": "none"},
}


def worn():
    """Coarse shorts over a moment of walking, without pictures: tight ones."""
    case = json.loads((HERE / "shorts.json").read_text())
    case["fabric"] = {"card": "limited.card.json"}
    case["time"]["duration"] = "0.05 s"
    case["output"].update({"pictures": []})
    return case


def failing(checks):
    return {c["check"]: c for c in checks if not c["holds"] and c["check"].startswith("Stretch")}


def try_case(folder, case, key, limits, expected):
    (folder / "limited.card.json").write_text(json.dumps({**CARD, **limits}))
    (folder / "case.json").write_text(json.dumps(case))
    done = run("run", "case.json", "--out", "out", "--threads", 1, cwd=folder)
    # A check that fails is said, and shown; the run itself is done.
    check(done.returncode == 0, f"exit status {done.returncode}: {done.stderr}")
    found = failing(summary(folder / "out")[key])
    check(set(found) == set(expected), f"{sorted(found)} fail, not {sorted(expected)}")
    page = (folder / "out/report.html").read_text()
    for name in expected:
        who = "Limited cloth (card limited.card.json)"
        check(name.endswith(who), name)
        check("is stretched by" in done.stderr or name in done.stderr, f"{name} is not said: {done.stderr}")
        check(who in page and "is stretched by" in page, f"{name} is not on the page")
    if not expected:
        check("is stretched by" not in page, "the page speaks of a stretch")


def main():
    weft, warp = (f"Stretch along the {t}, Limited cloth (card limited.card.json)" for t in ("weft", "warp"))
    with Folder() as folder:
        # Pulled by 6 %: past an elongation of 5 %, and past the strength of the weft, which is reached at 4.4 %.
        try_case(folder, STRIP, "checks", {"elongation": "5 %"}, [weft])
        try_case(folder, STRIP, "checks", {"strength_weft": "14 N/m", "strength_warp": "100 N/m"}, [weft])
        try_case(folder, STRIP, "checks", {"elongation": "7 %"}, [])
        try_case(folder, worn(), "audit", {"elongation": "0.5 %"}, [weft, warp])
        try_case(folder, worn(), "audit", {"elongation": "300 %"}, [])
    print("limits of cards: two strips and a garment fail by name, one of each holds")


if __name__ == "__main__":
    main()
