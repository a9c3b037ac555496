"""Averages across a channel, over the height in time, and the count of what ran out, against the frames of the same run:
test_flow_outputs.py CHUTE. And starts that are pressed."""
import csv
import math
import os
import subprocess
import sys
import tempfile
import unittest

chute = sys.argv[1]

LAWS = """[contact.normal]
law = "spring-dashpot"
stiffness = %s
restitution = 0.6
[contact.tangential]
law = "coulomb-viscous"
viscosity = 10
friction = 0.5
[engine]
method = "soft"
"""

SCENE = """
title = "Spheres beside one wall run out over the edge of their bed"
units = "reduced"
dimensions = 3
seed = 3
[incline]
angle = "30 deg"
[domain]
periodic = ["x"]
size = [6, 5]
[bed]
kind = "lattice"
arrangement = "square"
count = 6
count_across = 5
[[wall]]
point = [0, 0, 0]
normal = [0, 1, 0]
[grains]
count = 60
diameter = { mean = 1.0, std = 0.05 }
start = { lattice = "square", spacing = 1.2, velocity = 1.0, spread = 0.5 }
""" + LAWS % "1e3" + """[run]
duration = 4
[output]
frames = { every = 0.5 }
series = { every = 0.5 }
across = { from = 1, bin = 0.8, above = 0.2, every = 0.5 }
history = { every = 1, bin = 1, samples = 2 }
discharge = { every = 0.5, below = 0.3 }
"""

MIXTURE = """
title = "Discs of two materials run down a line"
units = "reduced"
seed = 2
[incline]
angle = "25 deg"
[bed]
kind = "row"
count = 10
[[material]]
name = "light"
share = 0.6
[[material]]
name = "heavy"
share = 0.4
density = 4
[grains]
count = 40
diameter = { mean = 1.0, std = 0.05 }
start = { lattice = "square", spacing = 1.25, velocity = 2.0, spread = 1.0 }
""" + LAWS % "1e4" + """[run]
duration = 4
[output]
frames = { every = 0.5 }
segregation = { every = 0.5, from = 1, bin = 1.2 }
heights = { every = 0.5, from = 1 }
"""

OPEN = """
title = "Discs come in above and leave below"
units = "reduced"
seed = 4
[incline]
angle = "20 deg"
[domain]
periodic = []
size = [12, 20]
[bed]
kind = "row"
count = 12
[[wall]]
point = [0, 0]
normal = [1, 0]
[inflow]
rate = 4
from = [0, 1]
to = [3, 6]
velocity = [1.5, 0]
spread = 0.3
[outflow]
beyond = 13
below = -4
[grains]
count = 30
diameter = { mean = 1.0, std = 0.05 }
start = { lattice = "square", spacing = 1.25, velocity = 1.5, spread = 0.5 }
""" + LAWS % "1e4" + """[run]
duration = 4
[output]
series = { every = 0.5 }
"""

SHEAR = """
title = "Discs pressed between two heights"
units = "reduced"
seed = 5
[incline]
angle = "0 deg"
gravity = 0
[bed]
kind = "row"
count = 12
[[wall]]
point = [0, 8]
normal = [0, -1]
[grains]
count = 91
diameter = { mean = 1.0, std = 0.1 }
start = { kind = "pressed", low = 0.5, high = 8 }
""" + LAWS % "1e4" + """[run]
duration = 0.01
[output]
frames = { every = 0.01 }
series = { every = 0.01 }
"""


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def run(folder, scene, *more):
    path = os.path.join(folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene)
    subprocess.run([chute, "run", path, "-o", os.path.join(folder, "run"), "--quiet", *more], check=True)
    return os.path.join(folder, "run")


def frames(folder, at):
    """Moving grains of each frame."""
    to = os.path.join(folder, "csv")
    subprocess.run([chute, "convert", at, "--to", "csv", "-o", to], check=True, capture_output=True)
    return [[g for g in table(os.path.join(to, name)) if float(g["type"]) == 1] for name in sorted(os.listdir(to))]


class FlowOutputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.at = run(cls.folder, SCENE)
        cls.frames = frames(cls.folder, cls.at)

    def near(self, told, true, what):
        self.assertAlmostEqual(float(told), true, delta=1e-9 * (1 + abs(true)), msg=what)

    def test_discharge_counts_what_lies_below(self):
        rows = table(os.path.join(self.at, "discharge.csv"))
        self.assertEqual(len(rows), len(self.frames))
        for row, grains in zip(rows, self.frames):
            out = [g for g in grains if float(g["z"]) < 0.3]
            self.assertEqual(float(row["out"]), len(out))
            self.near(row["out_mass"], sum(float(g["mass"]) for g in out), "mass")
        self.assertGreater(float(rows[-1]["out"]), 5, "nothing ran out, so that this tests nothing")

    def test_across_is_the_mean_of_strips(self):
        strips = {}
        looks = self.frames[2:]  # from t = 1
        for grains in looks:
            for g in grains:
                if float(g["z"]) >= 0.2:
                    strips.setdefault(math.floor(float(g["y"]) / 0.8), []).append(g)
        rows = table(os.path.join(self.at, "across.csv"))
        self.assertEqual(len(rows), len(strips))
        for row, strip in zip(rows, sorted(strips)):
            inside = strips[strip]
            self.near(row["y"], (strip + 0.5) * 0.8, "y")
            self.near(row["grains"], len(inside) / len(looks), "grains")
            T = 0
            for axis in "xyz":
                v = [float(g["velocity_" + axis]) for g in inside]
                mean = sum(v) / len(v)
                self.near(row["v_" + axis], mean, "v_" + axis)
                T += sum((u - mean) ** 2 for u in v) / len(v) / 3
            self.near(row["temperature"], T, "temperature")

    def test_history_averages_over_its_looks(self):
        rows = table(os.path.join(self.at, "history.csv"))
        for time, looks in ((0, self.frames[:1]), (2, self.frames[3:5]), (4, self.frames[7:9])):
            layers = {}
            for grains in looks:
                for g in grains:
                    if float(g["z"]) >= 0:
                        layers.setdefault(math.floor(float(g["z"])), []).append(float(g["velocity_x"]))
            told = [r for r in rows if abs(float(r["time"]) - time) < 1e-6]
            self.assertEqual([float(r["h"]) for r in told], [h + 0.5 for h in sorted(layers)])
            for row in told:
                v = layers[math.floor(float(row["h"]))]
                mean = sum(v) / len(v)
                self.near(row["grains"], len(v) / len(looks), "grains")
                self.near(row["v_x"], mean, "v_x")
                self.near(row["sigma_x"], math.sqrt(sum((u - mean) ** 2 for u in v) / len(v)), "sigma_x")

    def test_powers_of_layers_add_up_to_the_account(self):
        """Over all layers and in time: gravity's work, nothing carried, the losses with what springs store, and so what the motion gains."""
        for scene, volume in ((MIXTURE, 10 * 0.3), (SCENE, 6 * 5 * 0.3)):
            with tempfile.TemporaryDirectory() as folder:
                at = run(folder, scene, "--set", "output.history={every=0.001, bin=0.3, powers=true}", "--set", "run.duration=1.5",
                         "--set", "output.frames=", "--set", "output.segregation=", "--set", "output.heights=", "--set", "output.across=",
                         "--set", "output.discharge=", "--set", "output.series.every=0.5")
                account = [{k: float(v) for k, v in row.items() if v} for row in table(os.path.join(at, "series.csv"))]
                layers = table(os.path.join(at, "history.csv"))
            sums = {}
            for row in layers:
                now = sums.setdefault(float(row["time"]), [0, 0, 0, 0])
                for k, name in enumerate(("gravity_power", "carried_power", "dissipation")):
                    now[k] += float(row[name]) * volume
                now[3] += abs(float(row["carried_power"])) * volume
            empty = [row for row in layers if float(row["grains"]) == 0]
            self.assertTrue(empty, "no contact lies in a layer without a centre, so that this tests nothing")
            self.assertEqual({(row["v_x"], row["sigma_x"]) for row in empty}, {("", "")})
            carried = [now[1:] for now in sums.values()]
            self.assertLess(max(abs(c) for c, _, _ in carried), 1e-9)
            self.assertGreater(max(size for _, _, size in carried), 1, "nothing was carried, so that this tests nothing")
            for before, now in zip(account, account[1:]):
                # By trapezoids: a contact lasts for twenty looks and more.
                looks = [v for t, v in sorted(sums.items()) if before["time"] - 1e-6 < t < now["time"] + 1e-6]
                gravity, taken = (0.001 * (sum(v[k] for v in looks) - (looks[0][k] + looks[-1][k]) / 2) for k in (0, 2))
                change = {name: now[name] - before[name] for name in ("gravity_work", "elastic", "normal_loss", "shear_loss", "translation", "rotation")}
                lost = change["elastic"] + change["normal_loss"] + change["shear_loss"]
                self.assertAlmostEqual(gravity, change["gravity_work"], delta=0.001 * abs(gravity))
                self.assertAlmostEqual(taken, lost, delta=0.01 * abs(lost))
                self.assertAlmostEqual(gravity - taken, change["translation"] + change["rotation"], delta=0.01 * abs(lost))

    def test_strips_along_the_flow_and_histories_of_a_stretch_of_it(self):
        with tempfile.TemporaryDirectory() as folder:
            at = run(folder, SCENE, "--set", "output.across.axis=x", "--set", "output.history.between=[2, 5]")
            strips, layers = {}, {}
            for k, grains in enumerate(frames(folder, at)):
                for g in grains:
                    x, z, v = (float(g[key]) for key in ("x", "z", "velocity_x"))
                    if k >= 2 and z >= 0.2:
                        strips.setdefault(math.floor(x / 0.8), []).append(v)
                    if k in (7, 8) and z >= 0 and 2 <= x < 5:
                        layers.setdefault(math.floor(z), []).append(v)
            rows = table(os.path.join(at, "across.csv"))
            self.assertEqual([round(float(r["x"]), 6) for r in rows], [round((s + 0.5) * 0.8, 6) for s in sorted(strips)])
            for row, s in zip(rows, sorted(strips)):
                self.near(row["v_x"], sum(strips[s]) / len(strips[s]), "v_x")
            told = [r for r in table(os.path.join(at, "history.csv")) if abs(float(r["time"]) - 4) < 1e-6]
            self.assertEqual([float(r["h"]) for r in told], [h + 0.5 for h in sorted(layers)])
            for row in told:
                v = layers[math.floor(float(row["h"]))]
                self.near(row["grains"], len(v) / 2, "grains")
                self.near(row["v_x"], sum(v) / len(v), "v_x")

    def test_a_longer_run_has_the_same_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            at = run(folder, SCENE, "--set", "run.duration=2.5")
            subprocess.run([chute, "run", at, "--resume", "--quiet", "--set", "run.duration=4"], check=True)
            for name in ("history.csv", "discharge.csv"):
                self.assertEqual(table(os.path.join(at, name)), table(os.path.join(self.at, name)), name)

    def test_forces_have_the_mean_one(self):
        """Density of forces in units of their mean: its integral is 1, and so is the mean force, to a part of a bin."""
        with tempfile.TemporaryDirectory() as folder:
            at = run(folder, MIXTURE, "--set", "output.forces={from=1, every=0.1, bin=0.2, most=20}")
            rows = [(float(r["force"]), float(r["density"])) for r in table(os.path.join(at, "forces.csv"))]
        self.assertAlmostEqual(rows[0][0], 0.1)
        self.assertAlmostEqual(sum(p * 0.2 for _, p in rows), 1, delta=1e-9)
        self.assertAlmostEqual(sum(f * p * 0.2 for f, p in rows), 1, delta=0.02)

    def test_the_way_of_an_open_chute_is_that_of_its_mean_velocity(self):
        with tempfile.TemporaryDirectory() as folder:
            at = run(folder, OPEN)
            rows = table(os.path.join(at, "series.csv"))
        self.assertEqual(len(rows), 9)
        x = float(rows[0]["x"])
        for before, now in zip(rows, rows[1:]):
            x += (float(now["time"]) - float(before["time"])) * (float(before["v_x"]) + float(now["v_x"])) / 2
            self.near(now["x"], x, "x")
        self.assertGreater(x - float(rows[0]["x"]), 3)

    def test_materials_by_height(self):
        with tempfile.TemporaryDirectory() as folder:
            at = run(folder, MIXTURE)
            looks = frames(folder, at)
            risen, layers, heights = (table(os.path.join(at, name)) for name in ("segregation.csv", "species.csv", "heights.csv"))
        self.assertEqual(len(risen), len(looks))
        for row, grains in zip(risen, looks):
            for k, name in enumerate(("light", "heavy")):
                y = [float(g["y"]) for g in grains if float(g["material"]) == k]
                self.near(row["height_" + name], sum(y) / len(y), "height")
        looks = looks[2:]  # from t = 1
        for row in layers:
            low = float(row["h"]) - 0.6
            for k, name in enumerate(("light", "heavy")):
                inside = [g for grains in looks for g in grains if float(g["material"]) == k and low <= float(g["y"]) < low + 1.2]
                self.near(row["grains_" + name], len(inside) / len(looks), "grains")
                self.near(row["eta_" + name], sum(math.pi * float(g["radius"]) ** 2 for g in inside) / (len(looks) * 10 * 1.2), "eta")
                if not inside:
                    continue
                T = 0
                for axis in "xy":
                    v = [float(g["velocity_" + axis]) for g in inside]
                    mean = sum(v) / len(v)
                    self.near(row["v_%s_%s" % (axis, name)], mean, "v_" + axis)
                    T += sum((u - mean) ** 2 for u in v) / len(v) / 2
                self.near(row["temperature_" + name], T, "temperature")
        self.assertEqual(len(heights), 40)
        for row in heights:
            y = [float(g["y"]) for grains in looks for g in grains if g["id"] == row["grain"]]
            self.assertEqual(len(y), len(looks))
            self.near(row["height"], sum(y) / len(y), "height")

    def test_pressed_grains_are_dense_and_apart(self):
        with tempfile.TemporaryDirectory() as folder:
            grains = frames(folder, run(folder, SHEAR))[0]
        places = [(float(g["x"]), float(g["y"]), float(g["radius"])) for g in grains]
        self.assertEqual(len(places), 91)
        self.assertGreater(sum(math.pi * r * r for _, _, r in places) / (12 * 7.5), 0.75)
        for k, (x, y, r) in enumerate(places):
            self.assertGreaterEqual(y - r, 0.5 - 1e-9)
            self.assertLessEqual(y + r, 8 + 1e-9)
            for u, v, s in places[:k]:
                dx = (x - u + 6) % 12 - 6
                self.assertGreater(math.hypot(dx, y - v), (r + s) - 1.1e-3 * min(r, s))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
