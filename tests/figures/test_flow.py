"""What figures of chapter 5 must show, on the CSV of the quick ones: test_flow.py CHUTE. Seeds are fixed, so the numbers
are the same on every machine; limits leave room for other seeds."""
import csv
import math
import subprocess
import sys
import tempfile

chute = sys.argv[1]
failed = []


def check(holds, what):
    print("%s %s" % ("ok  " if holds else "FAIL", what))
    if not holds:
        failed.append(what)


def rows(folder, figure):
    with open("%s/%s.csv" % (folder, figure), encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def curve(table, panel, series):
    """x -> (y, error) of one series; an error that is not known is 0."""
    return {float(r["x"]): (float(r["y"]), float(r["y_err"] or 0)) for r in table
            if r["panel"] == panel and r["series"] == series}


def between(points, low, high):
    values = [y for x, (y, _) in points.items() if low <= x <= high]
    return sum(values) / len(values)


with tempfile.TemporaryDirectory() as out:
    subprocess.run([chute, "figure", "fig-5-02", "fig-5-03", "--quick", "--jobs", "2", "--quiet", "-o", out], check=True)

    gamma_max = math.pi / 6  # (4.21) for touching discs of equal size
    angles = rows(out, "fig-5-02")
    for panel in "ab":
        density = curve(angles, panel, "gamma")
        width = math.pi / len(density)
        check(abs(sum(y for y, _ in density.values()) * width - 1) < 1e-6, "5.2 %s: integral is 1" % panel)
        peaks = [between(density, at - 0.1, at + 0.1) for at in (math.pi / 2, math.pi - gamma_max, gamma_max)]
        check(peaks[0] > peaks[1] > peaks[2], "5.2 %s: highest at pi/2, then pi - gamma_max, gamma_max" % panel)
        valley = max(between(density, 0.8, 1.2), between(density, 1.95, 2.35))
        check(peaks[2] > 2 * valley, "5.2 %s: peaks stand out of the valleys" % panel)
    speeds = rows(out, "fig-5-03")
    mean = {panel: sum(x * y for x, (y, _) in curve(speeds, panel, "v_n").items()) for panel in "ab"}
    check(mean["b"] > mean["a"], "5.3: impacts are faster with e_n = 0.8 and the steeper plane")

sys.exit(1 if failed else 0)
