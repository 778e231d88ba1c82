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

# A law in place of moduli: its curves end at 20 %, where nobody said that the cloth does.
CURVES = {
    "name": "Curved cloth", "surface_density": "700 g/m^2", "thickness": "1.75 mm",
    "law": {"curves": {"weft": [["5 %", "15 N/m"], ["20 %", "80 N/m"]], "warp": [["5 %", "15 N/m"], ["20 %", "80 N/m"]],
                       "shear": "100 N/m", "rigidity_weft": 1e-4, "rigidity_warp": 1e-4}},
}

STRIP = {
    "kind": "static", "name": "strip",
    "sheet": {"plate": {"width": 0.2, "height": 0.05}, "cells_u": 4, "cells_v": 1},
    "material": {"fabric": {"card": "limited.card.json"}},
    "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz", "move": [0.012, 0, 0]},
                 {"edge": "v0", "hold": "yz"}, {"edge": "v1", "hold": "yz"}],
    "solver": {"steps": 2}, "output": {"shapes": "none"},
}


def worn(fabric=None):
    """Coarse shorts over a moment of walking, without pictures: tight ones."""
    case = json.loads((HERE / "shorts.json").read_text())
    case["fabric"] = fabric or {"card": "limited.card.json"}
    case["time"]["duration"] = "0.05 s"
    case["output"].update({"pictures": []})
    return case


def failing(checks):
    return {c["check"]: c for c in checks if not c["holds"] and c["check"].startswith("Stretch")}


def strip(fabric):
    return {**STRIP, "material": {"fabric": fabric}}


def try_case(folder, case, key, limits, expected, who="Limited cloth (card limited.card.json)"):
    (folder / "limited.card.json").write_text(json.dumps({**CARD, **limits}))
    (folder / "case.json").write_text(json.dumps(case))
    done = run("run", "case.json", "--out", "out", "--threads", 1, cwd=folder)
    # A check that fails is said, and shown; the run itself is done.
    check(done.returncode == 0, f"exit status {done.returncode}: {done.stderr}")
    found = failing(summary(folder / "out")[key])
    check(set(found) == set(expected), f"{sorted(found)} fail, not {sorted(expected)}")
    page = (folder / "out/report.html").read_text()
    for name in expected:
        check(name.endswith(who), name)
        check("is stretched by" in done.stderr or name in done.stderr, f"{name} is not said: {done.stderr}")
        check(who in page and "is stretched by" in page, f"{name} is not on the page")
    if not expected:
        check("is stretched by" not in page, "the page speaks of a stretch")
    # The card has no thickness: the run and its page say what is taken; so does a check of the case.
    if "card" in json.dumps(case):
        said = run("check", "case.json", cwd=folder)
        for text in (done.stderr, page, said.stdout):
            check("1.75 mm is assumed" in text, f"the thickness is not said to be assumed: {text[:2000]}")
    else:
        check("is assumed, the weight" not in done.stderr + page, "a given thickness is said to be assumed")


def main():
    weft, warp = (f"Stretch along the {t}, Limited cloth (card limited.card.json)" for t in ("weft", "warp"))
    with Folder() as folder:
        # Pulled by 6 %: past an elongation of 5 %, and past the strength of the weft, which is reached at 4.4 %.
        try_case(folder, STRIP, "checks", {"elongation": "5 %"}, [weft])
        try_case(folder, STRIP, "checks", {"strength_weft": "14 N/m", "strength_warp": "100 N/m"}, [weft])
        try_case(folder, STRIP, "checks", {"elongation": "7 %"}, [])
        try_case(folder, worn(), "audit", {"elongation": "0.5 %"}, [weft, warp])
        try_case(folder, worn(), "audit", {"elongation": "300 %"}, [])
        # Of a law the limit that the case states counts by name, the range of its curves does not.
        weft, warp = (f"Stretch along the {t}, Curved cloth" for t in ("weft", "warp"))
        curved = {"who": "Curved cloth"}
        try_case(folder, strip({**CURVES, "limit_strain": 0.05}), "checks", {}, [weft], **curved)
        try_case(folder, strip({**CURVES, "limit_strain_warp": 0.05}), "checks", {}, [], **curved)
        try_case(folder, worn({**CURVES, "limit_strain": 0.005}), "audit", {}, [weft, warp], **curved)
        try_case(folder, worn({**CURVES, "limit_strain_warp": 0.005}), "audit", {}, [warp], **curved)
        try_case(folder, worn(CURVES), "audit", {}, [], **curved)
    print("limits of cards and of laws: strips and garments fail by name, others hold")


if __name__ == "__main__":
    main()
