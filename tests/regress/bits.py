#!/usr/bin/env python3
"""What every case of the library leaves, kept before a change and compared after it: the safety net of a rebuild.

    bits.py GAMBESON keep FILE [CASE...]       hashes of these cases, or all, into FILE; goes on where it ended
    bits.py GAMBESON compare FILE [CASE...]    runs them again, one thread and two, and names each file that differs

Files as `results` has them: tables, frames, checkpoints, the summary without its timings. Hours for the whole library.
"""

import hashlib
import json
import pathlib
import sys

from common import Folder, check, results, run_case
from library import library


def cases(wanted):
    found = [file for file, _ in library() if not wanted or file.stem in wanted]
    check(not wanted or len(found) == len(wanted), f"not all of {wanted} are cases of the library")
    return found


def hashes(file, threads):
    with Folder() as folder:
        run_case(file, folder / "out", "--threads", threads, "--set", "output.pictures=[]")
        return {name: hashlib.sha256(content).hexdigest() for name, content in results(folder / "out").items()}


def differing(kept, now):
    return sorted(name for name in kept.keys() | now.keys() if kept.get(name) != now.get(name))


def keep(path, wanted):
    kept = json.loads(path.read_text()) if path.exists() else {}
    for file in cases(wanted):
        if file.stem in kept:
            continue
        one, two = hashes(file, 1), hashes(file, 2)
        check(one == two, f"{file.stem}: one thread and two differ in {differing(one, two)}")
        kept[file.stem] = one
        path.write_text(json.dumps(kept, indent=1) + "\n")
        print(f"{file.stem}: {len(one)} files kept", flush=True)


def compare(path, wanted):
    kept = json.loads(path.read_text())
    other = []
    for file in cases(wanted or list(kept)):
        check(file.stem in kept, f"{file.stem} was not kept")
        for threads in (1, 2):
            names = differing(kept[file.stem], hashes(file, threads))
            print(f"{file.stem}, {threads} threads: {'the same' if not names else f'OTHER: {names}'}", flush=True)
            if names:
                other.append(file.stem)
    check(not other, f"not as kept: {sorted(set(other))}")


def main():
    if len(sys.argv) < 4 or sys.argv[2] not in ("keep", "compare"):
        sys.exit(__doc__)
    {"keep": keep, "compare": compare}[sys.argv[2]](pathlib.Path(sys.argv[3]), sys.argv[4:])


if __name__ == "__main__":
    main()
