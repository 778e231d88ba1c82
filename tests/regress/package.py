#!/usr/bin/env python3
"""The package on a machine that has nothing but Debian: built without CUDA, installed, it runs the case of cases/quickstart,
and leaves nothing behind when it is removed. Minutes, as root (mmdebstrap). Skipped where that cannot be done.

    package.py [BUILD] [--keep FOLDER]

BUILD: a build folder of a release without CUDA; made in build/package where none is given. --keep: the folder in which the
package and the results of the run are left. 77: no mmdebstrap, or not root.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

from common import SKIPPED, SOURCE, Folder, check

SUITE = "bookworm"


def do(*arguments, **options):
    done = subprocess.run([*map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)
    check(done.returncode == 0, f"{' '.join(map(str, arguments))} gave {done.returncode}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def built(build):
    if not (build / "CPackConfig.cmake").exists():
        do("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DGAMBESON_TESTS=OFF",
           "-DGAMBESON_BENCH=OFF", "-DGAMBESON_JOINED=ON")
    do("cmake", "--build", build)
    return build


def sources_of_packages():
    """What this machine's own apt reads, so that the bare one gets the same packages."""
    lines = []
    for file in [pathlib.Path("/etc/apt/sources.list"), *pathlib.Path("/etc/apt/sources.list.d").glob("*")]:
        if not file.is_file():
            continue
        text = file.read_text()
        if file.suffix == ".sources":
            for part in re.split(r"\n\s*\n", text):
                keys = dict(re.findall(r"^([A-Za-z-]+): *(.*)$", part, re.M))
                lines += [f"deb {uri} {suite} {keys['Components']}" for uri in keys.get("URIs", "").split()
                          for suite in keys["Suites"].split()]
        else:
            lines += re.findall(r"^deb .*", text, re.M)
    own = re.compile(rf" {SUITE}(-updates|-security)? ")  # Debian's, and nobody else's
    return [line for line in lines if own.search(line)]


def files_of(root):
    """All files but those that packages are installed through and that loaders and fonts remember them in."""
    # Nor the home of who ran it, where Mesa keeps shaders.
    changing = {"root", "var/cache", "var/lib/apt", "var/lib/dpkg", "var/log", "etc/ld.so.cache", "proc", "sys", "dev", "tmp", "run"}
    files = set()
    for folder, below, names in os.walk(root):
        at = pathlib.Path(folder).relative_to(root)
        below[:] = [d for d in below if str(at / d) not in changing]
        files |= {str(at / name) for name in names if str(at / name) not in changing}
    return files


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", nargs="?", type=pathlib.Path, default=SOURCE / "build/package")
    parser.add_argument("--keep", type=pathlib.Path)
    a = parser.parse_args()
    if shutil.which("mmdebstrap") is None or os.geteuid() != 0:
        print("skipped: needs mmdebstrap, as root")
        sys.exit(SKIPPED)
    build = built(a.build.resolve())
    with Folder() as folder:
        do("cpack", "--config", build / "CPackConfig.cmake", "-B", folder / "packed", cwd=build)
        package, = (folder / "packed").glob("*.deb")
        fields = do("dpkg-deb", "--field", package)
        print(package.name, f"{package.stat().st_size / 1e6:.1f} MB", fields, sep="\n")
        check(all(name in fields for name in ("libcholmod3", "fonts-dejavu-core", "libosmesa6")), "what it needs is not listed")
        root = folder / "root"
        do("mmdebstrap", "--variant=apt", SUITE, root, *sources_of_packages())
        shutil.copy(package, root / "tmp")

        def inside(*arguments):
            return do("chroot", root, "env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "HOME=/root", "DEBIAN_FRONTEND=noninteractive",
                      *arguments)

        do("mount", "-t", "proc", "proc", root / "proc")
        try:
            inside("apt-get", "update")
            before = files_of(root)
            inside("apt-get", "install", "-y", "--no-install-recommends", f"/tmp/{package.name}")
            print(inside("gambeson", "--version").strip())
            said = inside("sh", "-c", "cd /root && gambeson run /usr/share/gambeson/library/armour_walk.json --out /root/armour 2>&1")
            check("not met" not in said, said[-3000:])
            check((root / "root/armour/report.html").stat().st_size > 1e6, "no page")
            if a.keep:
                a.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(package, a.keep)
                shutil.copytree(root / "root/armour", a.keep / "armour", dirs_exist_ok=True)
            shutil.rmtree(root / "root/armour")
            inside("apt-get", "purge", "-y", "gambeson")
            inside("apt-get", "autoremove", "--purge", "-y")
            # Of what came with it apt keeps tzdata, which Debian holds important.
            left = {name for name in files_of(root) - before
                    if not name.startswith(("usr/share/zoneinfo", "etc/localtime", "etc/timezone")) and "tzdata" not in name}
            check(not left, f"left behind: {sorted(left)[:20]}")
        finally:
            subprocess.run(["umount", root / "proc"])
        print("installs, runs, uninstalls clean")


main()
