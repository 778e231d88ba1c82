#!/usr/bin/env python3
"""The rooms of the sources hold what their link targets promise.

    rooms.py GAMBESON [--build DIR]    DIR: of CMake, to compile an include against the arrows

Every source has its header or says in its first line whose detail it is; no include goes by "..", round the link guard; an
include of a room above does not compile; and no two headers define types of one name in one namespace, which a linker would take
for one.
"""
import argparse
import json
import re
import shlex
import subprocess
import tempfile
from pathlib import Path

from common import SOURCE, check

ROOMS = ["analysis", "cases", "human", "tryon"]
#: (a source of the room below, a header of a room that it must not see)
AGAINST = [("cases/input/units.cpp", "cases/wear/case/case.hpp"), ("cases/structure/rules.cpp", "cases/wear/case/case.hpp"),
           ("cases/cell/rules.cpp", "cases/cloth/law_table.hpp"), ("cases/yarns/rules.cpp", "cases/cell/case.hpp"),
           ("cases/wear/case/rules.cpp", "cases/wear/scene/scenario.hpp"), ("cases/wear/results/report.cpp", "cases/study/study.hpp"),
           ("cases/wear/results/report.cpp", "gpu/step/device_steps.hpp"), ("gpu/step/device_steps.cpp", "cases/runs/options.hpp"),
           ("human/motion/walk.cpp", "human/recorded/motion_file.hpp"), ("human/body/body.cpp", "human/motion/motion.hpp")]


def sources(*endings):
    for room in ROOMS:
        for ending in endings:
            yield from sorted((SOURCE / room).rglob("*" + ending))


def without_header():
    found = []
    for file in sources(".cpp"):
        if file.name.endswith("main.cpp") or file.with_suffix(".hpp").exists():
            continue
        said = re.match(r"/// Detail of ([\w/]+\.hpp)\b", file.read_text())  # beside it, or from the root
        if not said or not ((file.parent / said[1]).exists() or (SOURCE / said[1]).exists()):
            found.append(str(file.relative_to(SOURCE)))
    return found


def by_dots():
    return [str(f.relative_to(SOURCE)) for f in sources(".cpp", ".hpp") if re.search(r'#include\s+"[^"]*\.\./', f.read_text())]


def types_of(header):
    """Types that a header defines, with their namespaces, by the house's layout: both begin a line."""
    rooms = []
    for line in header.read_text().splitlines():
        if opened := re.match(r"namespace ([\w:]+) \{", line):
            rooms.append(opened[1])
        elif re.match(r"\}\s+// namespace", line) and rooms:
            rooms.pop()
        elif named := re.match(r"(?:template ?<.*> )?(?:struct|class|enum class|enum|union) (?:alignas\(\d+\) )?(\w+)[^;()]*\{", line):
            yield "::".join([*rooms, named[1]])


def twice():
    where = {}
    for room in ["core", "gpu", *ROOMS]:
        for header in sorted((SOURCE / room).rglob("*.hpp")):  # what .cuh has stands in place of its .hpp
            for name in types_of(header):
                where.setdefault(name, []).append(str(header.relative_to(SOURCE)))
    return {name: files for name, files in where.items() if len(files) > 1}


def has(file, source):
    """Whether this compiled file is that source, or is made of it and others (cases/joined.cmake)."""
    return file == SOURCE / source or "joined" in file.parts and f'#include "{source}"\n' in file.read_text()


def compiles(build, source, header):
    """Whether an empty file with this include compiles as that source does."""
    commands = json.loads((Path(build) / "compile_commands.json").read_text())
    entry = next(c for c in commands if has(Path(c["file"]), source))
    words = shlex.split(entry["command"])
    start = next(k for k, word in enumerate(words) if re.search(r"(\+\+|clang|gcc)[^/]*$", word) and not Path(word).name.startswith("ccache"))
    keep = [w for w in words[start:] if w.startswith(("-I", "-D", "-std", "-f"))] + \
        [x for k, w in enumerate(words) if w == "-isystem" for x in words[k:k + 2]]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "try.cpp"
        file.write_text(f'#include "{header}"\n')
        done = subprocess.run([words[start], *keep, "-fsyntax-only", str(file)], cwd=entry["directory"], capture_output=True, text=True)
    check(done.returncode == 0 or "No such file or directory" in done.stderr, f"{source} with {header}: {done.stderr}")
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gambeson")
    parser.add_argument("--build", type=Path)
    options = parser.parse_args()
    check(not without_header(), f"neither a header nor a first line that says whose detail it is: {without_header()}")
    check(not by_dots(), f"includes by ..: {by_dots()}")
    check(not twice(), f"two types of one name: {twice()}")
    if options.build:
        check(compiles(options.build, "cases/wear/case/rules.cpp", "cases/input/schema.hpp"), "an include along the arrows does not compile")
        for source, header in AGAINST:
            check(not compiles(options.build, source, header), f"{source} may include {header}")
    print("rooms: well")


if __name__ == "__main__":
    main()
