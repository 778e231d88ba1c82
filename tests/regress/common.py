"""Shared by the regression tests: runs the command, compares results folders."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
# Cases of the library in which nothing touches: cloth so stiff that it keeps off itself (Zheng 2013, section 2.5.2).
UNTOUCHED = {"pedestal"}
SKIPPED = 77  # exit status of a test that cannot run here; ctest shows it as skipped


def binary():
    """The command under test: the first argument, or the release build's."""
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else SOURCE / "build/release/bin/gambeson"
    if not path.exists():
        sys.exit(f"{path} is not built")
    return str(path.resolve())


def command(*arguments):
    return [binary(), *map(str, arguments)]


def run(*arguments, **options):
    return subprocess.run(command(*arguments), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace", **options)


def run_case(case, out, *options, **how):
    done = run("run", case, "--out", out, *options, **how)
    check(done.returncode == 0, f"run of {case} gave {done.returncode}: {done.stderr}")
    return done


class Folder:
    """A temporary folder, removed where the test went well; kept, and named, where not."""

    def __enter__(self):
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="gambeson_regress_"))
        return self.path

    def __exit__(self, kind, error, trace):
        if kind is None or os.environ.get("GAMBESON_KEEP") is None:
            shutil.rmtree(self.path, ignore_errors=True)
        else:
            print("left:", self.path, file=sys.stderr)


def check(holds, why):
    if not holds:
        raise AssertionError(why)


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def sound(done, out, what):
    """The summary of a run that ended well: all its checks hold, no cloth crosses."""
    check(done.returncode == 0, f"{what} gave {done.returncode}: {done.stderr}")
    numbers = summary(out)
    failed = [c for c in numbers["audit"] if not c["holds"]]
    check(not failed, f"checks of {what}: {failed}")
    check(numbers["collisions"]["most_intersections"] == 0, f"{what} crosses: {numbers['collisions']}")
    return numbers


def results(folder):
    """Everything that must not depend on threads or interruptions: name -> content."""
    content = {}
    for file in sorted(folder.rglob("*")):
        name = str(file.relative_to(folder))
        if file.is_dir() or name in ("summary.json", "run.json", "timings.csv", "report.html"):
            continue  # they hold timings; the summary comes below without them
        if file.name.startswith(".gambeson"):
            continue  # lists what was written, in runs before too
        content[name] = file.read_bytes()
    numbers = summary(folder)
    check("timings" in numbers, "the summary has no timings")
    del numbers["timings"]
    content["summary.json"] = json.dumps(numbers).encode()
    if "kind" not in json.loads(content["case.json"]):
        for needed in ("contact.csv", "stress.csv", "frames.xdmf", "frames/layout.h5", "frames/segment_000000.h5"):
            check(needed in content, f"{folder} lacks {needed}")
    return content


def same_results(a, b, what):
    first, second = results(a), results(b)
    check(first.keys() == second.keys(), f"{what}: other files: {sorted(first.keys() ^ second.keys())}")
    other = [name for name in first if first[name] != second[name]]
    check(not other, f"{what}: these differ: {other}")
    print(f"{what}: {len(first)} files, {sum(map(len, first.values()))} bytes, all the same")
