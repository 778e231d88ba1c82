"""ccd_check accepts what is right and refuses the rest: a wrong truth, a truncated file, a folder without data; and a
query whose coordinates are no doubles is not missed.

usage: ccd_check.py CCD_CHECK
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HIT = [("0", "0", "1"), ("-1", "-1", "0"), ("3", "-1", "0"), ("-1", "3", "0"),
       ("0", "0", "-1"), ("-1", "-1", "0"), ("3", "-1", "0"), ("-1", "3", "0")]


def rows(points, truth):
    cells = lambda c: c.replace("/", ",") if "/" in c else c + ",1"
    return "".join(",".join(cells(c) for c in p) + f",{truth}\n" for p in points)


def check(content, expect, name="vertex-face.csv", say=None):
    with tempfile.TemporaryDirectory() as folder:
        if content is not None:
            Path(folder, name).write_text(content)
        run = subprocess.run([sys.argv[1], folder], capture_output=True, text=True)
        text = run.stdout + run.stderr
        assert run.returncode == expect, f"exit {run.returncode}, expected {expect}:\n{text}"
        assert say is None or say in text, f"'{say}' is missing in:\n{text}"


check(rows(HIT, 1), 0)
check(rows(HIT, 0), 1, say="refuted")
miss = [(x, y, "1/2") if i == 4 else (x, y, z) for i, (x, y, z) in enumerate(HIT)]
check(rows(miss, 0), 0)
check(rows(miss, 1), 1, say="refuted")
check(rows(HIT, 1)[:-20], 2, say="vertex-face.csv:7")
check("".join(rows(HIT, 1).splitlines(True)[:5]), 2, say="5 of 8 rows")
check(rows(HIT, 1), 2, name="data.csv", say="name the kind")
check(None, 77)
# Touches at the end, exactly, at a third: in doubles it stays short of the plane by an ulp or passes it.
for third in ("1/3", "2/3", "1/7"):
    touch = [(x, y, "1") if i == 0 else (x, y, third) for i, (x, y, _) in enumerate(HIT)]
    check(rows(touch, 1), 0, say="1 queries whose coordinates are no doubles")
print("ccd_check refuses what is wrong")
