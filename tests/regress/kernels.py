#!/usr/bin/env python3
"""What the compiler made of the kernels: registers, stack and traps of each, against gpu/kernels.json.

    kernels.py GAMBESON LIBRARY TABLE NVCC [--write]    LIBRARY: libgambeson_gpu.a; NVCC: its version; --write: makes the table

The machine code in the objects says it all, so nothing is compiled again and no GPU is asked. Registers and stack (spills
are part of it) may not grow over the table, which is of one version of nvcc; a trap is what nvcc makes of what a device
cannot do, a call of a host's function say, without a warning: there must be none.
"""

import argparse
import json
import struct
import subprocess
from pathlib import Path

from common import SKIPPED, check

PTX_OR_CUBIN_MAGIC, CUBIN = 0xBA55ED50, 2
REGISTERS, FRAME, STACK = 0x2F, 0x11, 0x12  # attributes of .nv.info
BPT = 0x95C  # the opcode of a trap, in the low 12 bits of an instruction of 16 bytes
OURS = "gambeson::gpu::"


def members(archive):
    """The objects of an archive."""
    data = archive.read_bytes()
    check(data.startswith(b"!<arch>\n"), f"{archive} is no archive")
    at = 8
    while at + 60 <= len(data):
        size = int(data[at + 48:at + 58])
        yield data[at + 60:at + 60 + size]
        at += 60 + size + size % 2


def text(data, at):
    return data[at:data.index(b"\0", at)].decode()


def sections(elf):
    """(name, offset, size) of each."""
    start, = struct.unpack_from("<Q", elf, 0x28)
    size, count, names = struct.unpack_from("<HHH", elf, 0x3A)
    heads = [struct.unpack_from("<IIQQQQ", elf, start + k * size) for k in range(count)]
    return [(text(elf, heads[names][4] + h[0]), h[4], h[5]) for h in heads]


def cubins(elf):
    """The machine code for GPUs in an object of the host."""
    for name, at, size in sections(elf):
        end = at + size
        while name == ".nv_fatbin" and at < end:
            magic, _, head, body = struct.unpack_from("<IHHQ", elf, at)
            check(magic == PTX_OR_CUBIN_MAGIC, "the fat binary is of an unknown form")
            entry, at = at + head, at + head + body
            while entry < at:
                kind, _, start, length, packed = struct.unpack_from("<HHIQI", elf, entry)
                if kind == CUBIN:
                    check(packed == 0, "the machine code is compressed")
                    yield elf[entry + start:entry + start + length]
                entry += start + length
            while at < end and elf[at] == 0:
                at += 1


def kernels(cubin):
    """Mangled name -> [registers, stack in bytes, traps] of each function."""
    parts = sections(cubin)
    place = {name: (at, size) for name, at, size in parts}
    (symbols, size), (strings, _) = place[".symtab"], place[".strtab"]
    names = [text(cubin, strings + struct.unpack_from("<I", cubin, symbols + k)[0]) for k in range(0, size, 24)]
    found = {}
    for name, at, size in parts:
        if name.startswith(".text."):
            traps = sum(struct.unpack_from("<H", cubin, k)[0] & 0xFFF == BPT for k in range(at, at + size, 16))
            found[name[6:]] = [0, 0, traps]
    at, size = place.get(".nv.info", (0, 0))
    end = at + size
    while at < end:
        form, attribute, length = struct.unpack_from("<BBH", cubin, at)
        at += 4
        if form != 4:  # the value stands in the place of the length
            continue
        if length == 8 and attribute in (REGISTERS, FRAME, STACK):
            symbol, value = struct.unpack_from("<II", cubin, at)
            if names[symbol] in found:
                of = found[names[symbol]]
                of[attribute != REGISTERS] = max(of[attribute != REGISTERS], value)
        at += length
    return found


def readable(mangled):
    """gambeson::gpu::kernel::forEach<gambeson::gpu::MapPoints>(int, ...) -> forEach<MapPoints>."""
    said = subprocess.run(["c++filt"], input="\n".join(mangled), capture_output=True, text=True, check=True).stdout.splitlines()
    short = {}
    for name, whole in zip(mangled, said):
        whole = whole.replace("(anonymous namespace)::", "").removeprefix("void ")
        depth, end = 0, len(whole)
        for k, c in enumerate(whole):
            depth += (c == "<") - (c == ">")
            if c == "(" and depth == 0:
                end = k
                break
        short[name] = whole[:end].replace("gambeson::gpu::kernel::", "").replace(OURS, "").replace("gambeson::", "")
    return short


def measured(library):
    worst = {}
    for elf in members(library):
        if not elf.startswith(b"\x7fELF"):
            continue
        for cubin in cubins(elf):
            for name, numbers in kernels(cubin).items():
                worst[name] = [max(pair) for pair in zip(worst.get(name, numbers), numbers)]
    short = readable(sorted(worst))
    ours = {}
    for name, numbers in worst.items():
        if "cub::" not in short[name].split("<")[0]:
            ours[short[name]] = [max(pair) for pair in zip(ours.get(short[name], numbers), numbers)]
    return ours


def line(name, numbers):
    return f"{json.dumps(name)}: {json.dumps(numbers[:2])}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gambeson")
    parser.add_argument("library", type=Path)
    parser.add_argument("table", type=Path)
    parser.add_argument("nvcc")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    found = measured(options.library)
    check(len(found) > 10, f"only {len(found)} kernels were found in {options.library}")
    nvcc = ".".join(options.nvcc.split(".")[:2])
    if options.write:
        rows = ",\n  ".join(line(name, found[name]) for name in sorted(found))
        options.table.write_text(f'{{"nvcc": "{nvcc}",\n "registers, stack in bytes": {{\n  {rows}\n}}}}\n')
    table = json.loads(options.table.read_text())
    limits = table["registers, stack in bytes"]
    wrong = [f"{name}: {traps} traps: it calls what a device has not, such as std::max of a static constexpr member"
             for name, (_, _, traps) in sorted(found.items()) if traps > 0]
    same = table["nvcc"] == nvcc
    if same:
        for name, numbers in sorted(found.items()):
            if name not in limits:
                wrong.append(f"a kernel that is not in {options.table.name}; the line to add: {line(name, numbers)}")
            elif numbers[0] > limits[name][0] or numbers[1] > limits[name][1]:
                wrong.append(f"{name}: {numbers[0]} registers, {numbers[1]} bytes of stack; allowed: {limits[name]}")
        wrong += [f"a line of {options.table.name} without a kernel: {name}" for name in sorted(limits.keys() - found.keys())]
    check(not wrong, "\n".join(["", *wrong]))
    print(f"{len(found)} kernels, none traps; most registers {max(n[0] for n in found.values())}, "
          f"most stack {max(n[1] for n in found.values())} bytes")
    if not same:
        print(f"registers and stack were not compared: the table is of nvcc {table['nvcc']}, this is {nvcc}")
        raise SystemExit(SKIPPED)


if __name__ == "__main__":
    main()
