"""Making figures, and reading their CSV.

Tests of what figures must show are called as test_X.py CHUTE [full] [FOLDER]: with "full" the full figures are made, not the
quick ones, and with a folder those count that lie there already."""
import bisect
import csv
import os
import subprocess
import sys
import tempfile
import unittest

OPTIONS = sys.argv[2:]
THERE = next((o for o in OPTIONS if os.path.isdir(o)), None)


class Figures:
    """The figures of those names, made by the program in a folder that goes with this object."""

    def __init__(self, chute, *names):
        self.folder = THERE
        if THERE:
            return
        folder = tempfile.TemporaryDirectory()
        self.folder = folder.name
        unittest.addModuleCleanup(folder.cleanup)
        quick = [] if "full" in OPTIONS else ["--quick"]
        subprocess.run([chute, "figure", *names, *quick, "--quiet", "--jobs", "2", "-o", self.folder], check=True)

    def curves(self, name):
        return read_curves(os.path.join(self.folder, name + ".csv"))


def read_curves(path):
    """(panel, series) -> [(x, y, y_err)], in the order of the file."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            error = float(row["y_err"]) if row["y_err"] else None
            found.setdefault((row["panel"], row["series"]), []).append((float(row["x"]), float(row["y"]), error))
    return found


def interpolate(curve, x):
    """y at x, linearly between the points; None outside."""
    after = bisect.bisect([p[0] for p in curve], x)
    if after in (0, len(curve)):
        return None
    (x0, y0, _), (x1, y1, _) = curve[after - 1], curve[after]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
