#!/usr/bin/env python3
"""Every command of the tutorials does what the tutorial says.

    tutorials.py GAMBESON [NAME...]    cases/tutorials/NAME.md; all without names

Indented lines that begin with "gambeson" are run, in the order of the text, in a copy of the folder. What the text
promises stands behind it as comments, which its readers do not see:

    <!-- file: NAME -->                              the file is there, and was not before
    <!-- says: TEXT -->                              the last command said TEXT
    <!-- number: FILE PATH = N within D -->          the number at PATH of a JSON file ("a.0.b", "a[key=word].b", "... * 100") is N within D
    <!-- number: FILE PATH < N -->                   it is less (>: more)

N has to stand in the text since the last command, as it is written here; what a command says, and names of files, anywhere in the text.
"""

import json
import re
import shlex
import shutil
import sys
import time

from common import SOURCE, Folder, check, run

TUTORIALS = SOURCE / "cases/tutorials"
PROMISE = re.compile(r"<!-- (file|says|number): (.*?) -->")


def at(node, path):
    path, _, factor = path.partition(" * ")
    for key, chosen, word in re.findall(r"([\w]+)(?:\[(\w+)=([^\]]*)\])?", path):
        node = node[int(key)] if isinstance(node, list) else node[key]
        if chosen:
            node = next(item for item in node if item[chosen] == word)
    return float(node) * float(factor or 1)


def kept(folder, kind, words, said, above, text):
    if kind == "file":
        check(words.split("/")[-1] in text, f"the text does not name {words}")
        check((folder / words).is_file(), f"{words} is missing")
    elif kind == "says":
        check(words in " ".join(said.split()), f"{words!r} is not said: {said[-2000:]}")
        check(words.split(":")[-1].strip() in " ".join(text.replace("`", "").split()), f"the text does not show {words!r}")
    else:
        file, path, sign, number, within = re.fullmatch(r"(\S+) (.+) ([=<>]) (\S+)(?: within (\S+))?", words).groups()
        value, bound = at(json.loads((folder / file).read_text()), path), float(number)
        holds = {"=": abs(value - bound) <= float(within or 0) + 1e-9, "<": value < bound, ">": value > bound}[sign]
        check(holds, f"{words}: it is {value}")
        check(number in above, f"{number} does not stand above its promise")


def follow(name):
    text = (TUTORIALS / f"{name}.md").read_text()
    start, commands, promises = time.monotonic(), 0, 0
    with Folder() as temporary:
        folder = temporary / "tutorials"
        shutil.copytree(TUTORIALS, folder)
        said, above = "", ""
        for line in text.split("\n"):
            promise = PROMISE.fullmatch(line)
            command = re.fullmatch(r"    (gambeson .*)", line)
            if promise:
                promises += 1
                if promise[1] == "file":
                    check(not (TUTORIALS / promise[2]).exists(), f"{promise[2]} ships with the tutorial")
                kept(folder, promise[1], promise[2], said, above, text)
            elif command:
                done = run(*shlex.split(command[1])[1:], cwd=folder)
                said = done.stdout + done.stderr
                check(done.returncode == 0, f"{command[1]} gave {done.returncode}: {said}")
                commands, above = commands + 1, ""
            else:
                above += line + "\n"
    check(commands >= 4 and promises >= 6, f"{name}: {commands} commands and {promises} promises only")
    print(f"{name}: {commands} commands, {promises} promises kept, {time.monotonic() - start:.0f} s", flush=True)


def main():
    names = sys.argv[2:] or sorted(file.stem for file in TUTORIALS.glob("*.md"))
    check(len(names) >= 1, "there are no tutorials")
    for name in names:
        follow(name)


if __name__ == "__main__":
    main()
