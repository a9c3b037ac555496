#!/usr/bin/env python3
"""Compares runs of chute with the stored LAMMPS profiles, bin by bin.

    compare.py --mu 0.5 RUN...

RUN are run directories of scenes/chute-2d.toml with LAMMPS's law (see README.md), one per seed. Prints the mean of both,
their standard errors over runs, and the difference in units of the combined error.
"""
import argparse
import csv
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def rows(path):
    with open(path) as text:
        table = list(csv.DictReader(line for line in text if not line.startswith("#")))
    return [{k: float(v) if v else math.nan for k, v in row.items()} for row in table]


def mean_and_error(values):
    n = len(values)
    mean = sum(values) / n
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (n - 1) / n)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mu", type=float, required=True)
    parser.add_argument("runs", nargs="+")
    arguments = parser.parse_args()
    lammps = {r["h"]: r for r in rows(os.path.join(HERE, "chute-2d.csv")) if r["mu"] == arguments.mu}
    chute = [{r["h"]: r for r in rows(os.path.join(run, "profiles.csv"))} for run in arguments.runs]
    print("%4s %-8s %18s %18s  %s" % ("h", "", "LAMMPS", "chute", "difference / error"))
    for column in ("eta", "v_x", "sigma_x", "sigma_y"):
        for h in sorted(lammps):
            ours = [run[h][column] for run in chute if h in run and not math.isnan(run[h][column])]
            if len(ours) < 2:
                continue
            mean, error = mean_and_error(ours)
            theirs, their_error = lammps[h][column], lammps[h][column + "_err"]
            print("%4.1f %-8s %9.4f ± %.4f %9.4f ± %.4f  %+.1f" % (
                h, column, theirs, their_error, mean, error, (mean - theirs) / math.hypot(error, their_error)))


if __name__ == "__main__":
    main()
