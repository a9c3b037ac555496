"""Figures of soft grains do not depend on the time step: a few points of each are made with the step of the recipe and with half of it.

test_halved_step.py CHUTE [FIGURE …], with --long. A figure's first and last series are made, quick, but of eight runs each, so that
errors come from how runs scatter. The two do not know of each other beyond the start: grains that meet part after other times, and a
flow forgets in some collisions. So points differ by chance, by their combined standard error Δ/σ, whose square has the mean 1.17 of
Student's distribution with 14 degrees of freedom, or less, for the two share their beds and starts; one of a hundred lies beyond 3.
"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

chute = os.path.abspath(sys.argv[1])
SCENES = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", "scenes"))
FIGURES = sys.argv[2:] or ["fig-4-05", "fig-4-15", "fig-4-20", "fig-5-08", "fig-b-02", "fig-b-04", "fig-b-06", "fig-b-13",
                           "fig-b-15", "fig-e-02", "fig-e-03"]
RUNS, ENOUGH = 8, 5
USUAL_STEPS = 50  # in a contact time, where neither recipe nor scene names another number


def toml(value):
    if isinstance(value, dict):
        return "{%s}" % ", ".join("%s = %s" % (key, toml(v)) for key, v in value.items())
    if isinstance(value, list):
        return "[%s]" % ", ".join(map(toml, value))
    return json.dumps(value, ensure_ascii=False)


def ends(items, same):
    """The first and the last, with all those that are of the same runs."""
    kept = {same(items[0]), same(items[-1])}
    return [item for item in items if same(item) in kept]


def reduced(name):
    """The recipe with few series and points, as TOML, and how many steps a contact has in it."""
    with open(os.path.join(SCENES, name + ".toml"), "rb") as file:
        recipe = tomllib.load(file)
    data, panels, steps = [], [], USUAL_STEPS
    for part in recipe["data"] if isinstance(recipe["data"], list) else [recipe["data"]]:
        if "scene" not in part:
            continue  # theory
        scene = os.path.join(SCENES, part["scene"])
        part = {**part, "scene": scene, "quick_seeds": RUNS}
        if "sweep" in part:
            part["sweep"] = [{**s, "x": {**s["x"], "quick_count": 3}} for s in ends(part["sweep"], json.dumps)]
        if "curve" in part:
            part["curve"] = [{**c, **({"quick_count": 2} if "quick_count" in c else {})}
                             for c in ends(part["curve"], lambda c: json.dumps(c.get("set", [])))]
        data.append(part)
        for series in part.get("curve", []) + part.get("sweep", []):
            if series.get("panel", "") not in panels:
                panels.append(series.get("panel", ""))
        with open(scene, encoding="utf-8") as file:
            told = re.findall(r"steps_per_contact *= *(\d+)", file.read()) + re.findall(r"engine.steps_per_contact *= *(\d+)", json.dumps(part))
        steps = int(told[-1]) if told else steps
    plot = {"x": {"label": "$x$"}, "y": {"label": "$y$"}}
    if panels != [""]:
        plot["panel"] = [{"label": panel} for panel in panels]
    return "title = %s\ndata = %s\nplot = %s\n" % (toml(recipe["title"]), toml(data), toml(plot)), steps


def points(path):
    """Of series whose errors come from enough settled runs, or where none settles from all: (panel, series, place) -> [(value, error) …].
    The place is x where that is set, else, where it was measured with an error of its own, the how manieth it is."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    few = set()
    for told in (re.fullmatch(r"# (.*): (\d+ runs? \w+(?:, \d+ runs? \w+)*)", line) for line in lines):
        settled = sum(int(n) for n, word in re.findall(r"(\d+) runs? (\w+)", told[2]) if word in ("steady", "stopped")) if told else 0
        if 0 < settled < ENOUGH:
            few.add(told[1])
    rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
    found = {}
    for k, row in enumerate(rows):
        numbers = [(float(row[a]), float(row[a + "_err"])) for a in "xy" if row[a + "_err"] and float(row[a + "_err"]) > 0]
        if numbers and row["series"] not in few and not row["series"].endswith(" unsettled"):
            found[row["panel"], row["series"], "#%d" % k if row["x_err"] else round(float(row["x"]), 9)] = numbers
    return found


def deviations(name, folder):
    """(panel, series, place) -> Δ/σ of each of its numbers."""
    recipe, steps = reduced(name)
    path = os.path.join(folder, name + ".toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(recipe)
    made = []
    for k in (1, 2):
        out = os.path.join(folder, str(k))
        subprocess.run([chute, "figure", path, "--quick", "--quiet", "--jobs", "2", "-o", out, "--set", "engine.steps_per_contact=%d" % (k * steps)],
                       check=True)
        made.append(points(os.path.join(out, name + ".csv")))
    return compared(*made)


def compared(first, second):
    return {key: [(b - a) / math.hypot(a_err, b_err) for (a, a_err), (b, b_err) in zip(first[key], second[key])] for key in first if key in second}


class HalvedStep(unittest.TestCase):
    def test_points_stay_where_they_are(self):
        everything = []
        for name in FIGURES:
            with tempfile.TemporaryDirectory() as folder, self.subTest(name):
                found = deviations(name, folder)
                numbers = [d for ds in found.values() for d in ds]
                mean = sum(d * d for d in numbers) / max(1, len(numbers))
                far = [key for key, ds in found.items() if max(map(abs, ds)) > 3]
                print("%-10s %3d numbers, mean (D/s)^2 %.2f, beyond 3: %s" % (name, len(numbers), mean, far or "none"), flush=True)
                self.assertGreaterEqual(len(numbers), 2)
                everything += numbers
        self.assertLess(sum(d * d for d in everything) / len(everything), 1.5)
        self.assertLessEqual(sum(abs(d) > 3 for d in everything), 1 + 0.02 * len(everything))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
