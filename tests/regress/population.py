#!/usr/bin/env python3
"""A study of wearers that are drawn: killed and resumed it leaves the same bytes, and says whom the garment fits.

    population.py [GAMBESON] [--whole]

Always: two wearers in very coarse shorts, who stand for a moment, killed twice. --whole: the 24 wearers of the library's
study with two cores, killed ten times; how long they take is printed and must be 40 minutes at most.
"""

import csv
import json
import random
import shutil
import subprocess
import sys
import time

from common import SOURCE, Folder, check, command, results, run

WHOLE = "--whole" in sys.argv
LIBRARY = SOURCE / "cases/library"
KILLS = 10 if WHOLE else 2
MOST_S = 40 * 60


def study(folder):
    text = json.loads((LIBRARY / "shorts_population.study.json").read_text())
    text["case"] = str(LIBRARY / "shorts_walk.json")
    if not WHOLE:
        text["population"]["count"] = 2
        text["pictures"] = []
        text["set"].update({"garment.shorts.cell": "90 mm", "human.motion": {"stand": {"duration": "20 ms"}}, "time.duration": "20 ms",
                            "air.velocity": [0, 0, 0], "analysis.task": "none", "dressing.settle": "20 ms",
                            "dressing.projecting.grow": "40 ms", "output.viewer": False, "output.checkpoint": "20 ms"})
    file = folder / "whom.study.json"
    file.write_text(json.dumps(text))
    return file


def contents(out):
    files = {p.name: p.read_bytes() for p in out.iterdir() if p.suffix in (".json", ".csv", ".html")}
    for png in (out / "pictures").glob("*.png"):
        files["pictures/" + png.name] = png.read_bytes()
    for variant in json.loads(files["study.json"])["variants"]:
        for name, content in results(out / variant["variant"]).items():
            files[variant["variant"] + "/" + name] = content
    return files


def answers(out, count):
    """What the study says of each wearer stands in its table and its numbers alike."""
    numbers = json.loads((out / "study.json").read_text())["population"]
    rows = list(csv.DictReader((out / "population.csv").open()))
    check(len(rows) == count and len(numbers["wearers"]) == count, f"{len(rows)} rows for {count} wearers")
    on = next(s for s in numbers["shares"] if s["what"] == "can put it on")
    check(on["yes"] + on["no"] == count and on["yes"] == sum(r["put_on"] == "yes" for r in rows), f"{on}")
    check({r["sex"] for r in rows} == {"male", "female"}, "one sex only")
    check(all(0.9 < float(r["mass_kg"]) / w["mass_kg"] < 1.1 for r, w in zip(rows, numbers["wearers"])), "another order")
    page = (out / "report.html").read_text()
    check(numbers["sentence"].split(";")[0] in page and "Whom it fits, whom it burdens" in page, "the page does not answer")
    print(numbers["sentence"])


def main():
    with Folder() as folder:
        file = study(folder)
        options = ("--jobs", 2, "--threads", 2)
        begin = time.monotonic()
        done = run("study", file, "--out", folder / "whole", *options)
        took_s = time.monotonic() - begin
        check(done.returncode == 0, f"the study failed: {done.stdout} {done.stderr}")
        print(f"{took_s:.0f} s")
        check(took_s <= MOST_S, f"it took {took_s / 60:.0f} minutes")
        answers(folder / "whole", 24 if WHOLE else 2)
        chance = random.Random(20130620)
        died = 0
        while died < KILLS:
            process = subprocess.Popen(command("study", file, "--out", folder / "cut", "--resume", *options), stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(chance.uniform(0.1, 0.9) * took_s / KILLS * (1 if WHOLE else 2))
                # It ended before: the machine has become quicker, and all begins again.
                shutil.rmtree(folder / "cut")
                took_s, died = took_s / 2, 0
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                died += 1
        last = run("study", file, "--out", folder / "cut", "--resume", *options)
        check(last.returncode == 0, f"the resumed study failed: {last.stdout} {last.stderr}")
        whole, cut = contents(folder / "whole"), contents(folder / "cut")
        check(whole.keys() == cut.keys(), f"other files: {sorted(whole.keys() ^ cut.keys())}")
        other = [name for name in whole if whole[name] != cut[name]]
        check(not other, f"these differ: {other}")
        print(f"{died} kills, {len(whole)} files, {sum(map(len, whole.values()))} bytes, all the same")


if __name__ == "__main__":
    main()
