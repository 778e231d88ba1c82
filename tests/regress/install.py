#!/usr/bin/env python3
"""What `cmake --install` puts in a folder works from there: cases are checked and run, CAD files are read, films are made.

    install.py GAMBESON BUILD
"""

import os
import pathlib
import subprocess
import sys

from common import HERE, Folder, check


def main():
    with Folder() as folder:
        done = subprocess.run(["cmake", "--install", sys.argv[2], "--prefix", folder / "usr"], capture_output=True, text=True)
        check(done.returncode == 0, done.stdout + done.stderr)
        share = folder / "usr/share"
        for name in ("gambeson/library/armour_walk.json", "gambeson/library/cards/denim_a.card.json", "doc/gambeson/README.md",
                     "doc/gambeson/copyright"):
            check((share / name).is_file(), f"{name} is not installed")
        # As people find it: by its name, from another folder.
        around = os.environ | {"PATH": f"{folder / 'usr/bin'}:{os.environ['PATH']}"}
        elsewhere = folder / "elsewhere"
        elsewhere.mkdir()

        def works(*arguments):
            done = subprocess.run(["gambeson", *map(str, arguments)], env=around, cwd=elsewhere, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True)
            check(done.returncode == 0, f"{arguments}: {done.returncode}, {done.stderr}")
            return done.stdout

        check(works("--version") == subprocess.run([sys.argv[1], "--version"], capture_output=True, text=True).stdout,
              "another version than that of the build")
        works("check", share / "gambeson/library/shorts_walk.json")
        step = next(iter(sorted((HERE / "cad_seeds").glob("*.st*p"))))
        works("import", step, "-o", "panels.json")
        works("run", HERE / "sphere.json", "--out", "fall")
        works("render", "fall", "-o", "fall.mp4")
        check((elsewhere / "fall/report.html").stat().st_size > 0, "no page")
        check((elsewhere / "fall.mp4").stat().st_size > 0, "no film")


main()
