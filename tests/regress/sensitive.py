#!/usr/bin/env python3
"""Published references notice an input that is 2 % off: Young's modulus, thickness, density and Poisson's ratio of the material, each
raised by 2 %, must fail a gated check of each reference named for it, while the untouched reference passes.

usage: sensitive.py GAMBESON [--all]      --all: every quick reference whose material has the input; prints who notices
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent / "verify"
FACTOR = 1.02
# Loads, lengths and mass of a reference are numbers of its own: what its result is proportional to decides who can notice.
NOTICED_BY = {
    "young": ["linear_scordelis_lo", "linear_hemisphere", "linear_pinched_cylinder", "plate_frequencies", "heavy_elastica"],
    "thickness": ["linear_scordelis_lo", "linear_hemisphere", "linear_pinched_cylinder", "plate_frequencies"],
    "density": ["plate_frequencies", "heavy_elastica"],
    "poisson": ["plate_frequencies", "linear_hemisphere"],
}


def scaled(value):
    """The value times FACTOR; a text keeps its unit."""
    if isinstance(value, str):
        number, unit = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(.*)", value).groups()
        return f"{float(number) * FACTOR!r} {unit}".strip()
    return value * FACTOR


def changed(node, key):
    """A copy of the reference with every `key` of its materials changed; how many there were."""
    count = 0

    def walk(n, inside):
        nonlocal count
        if isinstance(n, dict):
            out = {}
            for k, v in n.items():
                if inside and k == key:
                    out[k] = scaled(v)
                    count += 1
                elif k == "set":  # "material.isotropic.young": 3
                    out[k] = {p: scaled(x) if p.startswith("material") and p.endswith("." + key) else x for p, x in v.items()}
                    count += sum(p.startswith("material") and p.endswith("." + key) for p in v)
                else:
                    out[k] = walk(v, inside or k == "material")
            return out
        return [walk(x, inside) for x in n] if isinstance(n, list) else n

    return walk(node, False), count


def verify(gambeson, reference, folder):
    """Gated results and why a run failed, if one did."""
    (folder / "references").mkdir(parents=True)
    (folder / "references" / f"{reference['id']}.json").write_text(json.dumps(reference))
    done = subprocess.run([gambeson, "verify", "--dir", folder / "references", "--out", folder / "out", "--jobs", "2"],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{reference['id']}: {done.stderr or done.stdout}")
    results = json.loads((folder / "out" / "verify.json").read_text())
    return [r for r in results if r["gated"]]


def main():
    gambeson = sys.argv[1]
    references = {p.stem: json.loads(p.read_text()) for p in sorted(HERE.glob("*.json"))}
    wrong = 0
    for key, named in NOTICED_BY.items():
        if "--all" in sys.argv:
            named = [i for i, r in references.items() if r.get("quick") and changed(r, key)[1]]
        for name in named:
            reference, count = changed(references[name], key)
            with tempfile.TemporaryDirectory() as scratch:
                before = verify(gambeson, references[name], Path(scratch) / "as it is")
                after = verify(gambeson, reference, Path(scratch) / "changed")
            good = count > 0 and all(r["passed"] for r in before)
            off = [r for r in after if not r["passed"]]
            ran = all(r["measured"] is not None for r in after)  # a run that breaks notices nothing
            noticed = good and ran and off
            print(f"{key:<10} {name:<28} {'fails' if noticed else 'NOT NOTICED'}: {len(off)} of {len(after)} checks"
                  + (f", {off[0]['quantity']} {off[0]['measured']:.6g} for {off[0]['reference']:.6g}" if off and ran else ""))
            wrong += not noticed
    sys.exit(1 if wrong and "--all" not in sys.argv else 0)


main()
