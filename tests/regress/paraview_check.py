#!/usr/bin/env pvpython
"""Opens a recording as a ParaView user would and prints what is there, as JSON.

    pvpython --force-offscreen-rendering tests/regress/paraview_check.py DIR [ARRAY] [--expect JSON]

Prints the reader that OpenDataFile chose, the times, and of the last frame: the bounds, the number of points and cells,
the arrays with their components, and the range of ARRAY (default "stress"; over all frames too). With --expect, a JSON
object of some of these, exits with 1 and says which differ. Exit status 1 also where the recording does not open.
"""

import argparse
import json
import math
import os
import sys

from paraview import servermanager
from paraview.simple import OpenDataFile


def surface_leaves(data):
    """The data sets of a (nested) composite, in its order."""
    if data.IsA("vtkDataSet"):
        return [data]
    leaves = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


def array_range(leaves, name):
    """Lowest and highest value of an array (the magnitude where it has several components), or None."""
    low, high = math.inf, -math.inf
    for leaf in leaves:
        array = leaf.GetPointData().GetArray(name)
        if array is None or array.GetNumberOfTuples() == 0:
            continue
        a, b = array.GetRange(0 if array.GetNumberOfComponents() == 1 else -1)
        low, high = min(low, a), max(high, b)
    return None if low > high else [low, high]


def look(directory, name):
    sidecar = os.path.join(directory, "frames.xdmf")
    reader = OpenDataFile(sidecar)
    if reader is None:
        raise RuntimeError("ParaView does not open " + sidecar)
    reader.UpdatePipeline()
    # One time step reads as a plain number.
    times = reader.TimestepValues
    times = [times] if isinstance(times, float) else list(times)
    overall = None
    for time in times:
        reader.UpdatePipeline(time)
        leaves = surface_leaves(servermanager.Fetch(reader))
        found = array_range(leaves, name)
        if found:
            overall = [min(found[0], overall[0]), max(found[1], overall[1])] if overall else found
    arrays = {}
    for leaf in leaves:
        for i in range(leaf.GetPointData().GetNumberOfArrays()):
            array = leaf.GetPointData().GetArray(i)
            arrays[array.GetName()] = array.GetNumberOfComponents()
    return {
        "reader": reader.SMProxy.GetXMLName(),
        "times": times,
        "bounds": list(leaves[0].GetBounds()),
        "points": [leaf.GetNumberOfPoints() for leaf in leaves],
        "cells": [leaf.GetNumberOfCells() for leaf in leaves],
        "arrays": arrays,
        "array": name,
        "range_last_frame": found,
        "range_all_frames": overall,
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("directory")
    parser.add_argument("array", nargs="?", default="stress")
    parser.add_argument("--expect", default="{}")
    options = parser.parse_args()
    try:
        seen = look(options.directory, options.array)
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return 1
    print(json.dumps(seen))
    status = 0
    for key, value in json.loads(options.expect).items():
        if seen[key] != value:
            print(f"{key}: expected {value}, got {seen[key]}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
