"""Does any steady flow have its granular temperature falling from the bottom up, or its density highest in between, as
kinetic theories for nearly elastic grains have it? Thesis 5.3 found none. Flows in the plane and in space over
inclination, restitution and friction: test_steady_flows.py CHUTE [FOLDER that keeps the runs], with --long, for it takes
ten minutes of a core.

In the plane it comes out for the density, and for the temperature of all flows with friction and of slow ones without. Discs
without friction on steeper planes are hotter below though their verdict is steady: flows such as the thesis follows in its
figure 5.6, which last for hundreds of units of time, and then run away. In space it does not come out: steady flows at 23 and 25
degrees are two to three times as hot below as above, as the shear rate of Bagnold's profile falls with height, and 2 to 3 % looser
there than in between.
"""
import concurrent.futures
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

chute = sys.argv[1]
SCENES = os.path.join(os.path.dirname(__file__), "..", "..", "scenes")
CLEAR = 3  # standard errors

PLANE = ["contact.normal.stiffness=1e6", "contact.tangential.viscosity=500", "run.duration=250",
         "output.profiles={from='steady', bin=1.0}"]
SPACE = ["bed.size=[8, 6]", "bed.count=38", "grains.count=600", "contact.normal.stiffness=1e4", "run.duration=300",
         "output.profiles={from='steady', bin=1.0, every=0.1}"]
FLOWS = [("chute-2d", angle, e_n, mu, seed, PLANE) for mu, angles in ((0, (12.6, 14.4, 16.2)), (0.5, (18, 20)))
         for angle in angles for e_n in (0.6, 0.8) for seed in (1, 2)]
FLOWS += [("chute-silbert", angle, e_n, mu, seed, SPACE) for angle in (21, 23, 25) for e_n in (0.6, 0.88) for mu in (0.5,)
          for seed in (1, 2)]


def run(flow, folder):
    """(verdict, rows of the profiles) of a flow."""
    scene, angle, e_n, mu, seed, settings = flow
    out = os.path.join(folder, "-".join(map(str, flow[:5])))
    settings = settings + ["incline.angle=%g deg" % angle, "contact.normal.restitution=%g" % e_n,
                           "contact.tangential.friction=%g" % mu, "seed=%d" % seed, "output.frames="]
    if not os.path.exists(os.path.join(out, "profiles.csv")):
        command = [chute, "run", os.path.join(SCENES, scene + ".toml"), "-o", out, "--threads", "1", "--quiet"]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True)
    with open(os.path.join(out, "run.json"), encoding="utf-8") as file:
        verdict = json.load(file)["flow"]["verdict"]
    with open(os.path.join(out, "profiles.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return verdict, [{name: float(value or "nan") for name, value in row.items()} for row in rows]


def mean(rows, name):
    errors = [0 if math.isnan(row[name + "_err"]) else row[name + "_err"] for row in rows]
    return sum(row[name] for row in rows) / len(rows), math.sqrt(sum(e * e for e in errors)) / len(rows)


def rise(low, high, name):
    """From these layers to those, in standard errors, and the two means."""
    (a, a_err), (b, b_err) = mean(low, name), mean(high, name)
    return (b - a) / math.hypot(a_err, b_err), a, b


def shape(rows):
    """How temperature rises from the lower third of the bulk to its upper third, and the density from the lower third to what
    lies in between. The bulk is what is half as dense as the densest layer, without the layer on the bed and the uppermost."""
    densest = max(row["eta_exact"] for row in rows)
    bulk = [row for row in rows if row["h"] > 1 and row["eta_exact"] > densest / 2][:-1]
    third = len(bulk) // 3
    return (rise(bulk[:third], bulk[-third:], "temperature"), rise(bulk[:third], bulk[third:-third], "eta_exact"))


class SteadyFlows(unittest.TestCase):
    def test_hot_above_and_dense_below(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = sys.argv[2] if len(sys.argv) > 2 else scratch
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as side_by_side:
                runs = list(side_by_side.map(lambda flow: run(flow, folder), FLOWS))
        steady = {2: 0, 3: 0}
        for flow, (verdict, rows) in zip(FLOWS, runs):
            scene, angle, e_n, mu = flow[:4]
            hotter, denser = shape(rows)
            print("%-14s theta %5.1f e_n %.2f mu %.1f seed %d: %-12s T %.4f -> %.4f (%+5.1f), eta %.3f -> %.3f (%+5.1f)" %
                  (flow[:5] + (verdict, hotter[1], hotter[2], hotter[0], denser[1], denser[2], denser[0])))
            if verdict != "steady":
                continue
            steady[2 if scene == "chute-2d" else 3] += 1
            with self.subTest(flow[:5]):
                if scene == "chute-2d":
                    self.assertLess(denser[0], CLEAR, "the density is highest in between")
                    if mu > 0 or angle < 16:
                        self.assertGreater(hotter[0], -CLEAR, "the temperature falls from the bottom up")
                elif angle >= 23:
                    self.assertLess(hotter[0], -CLEAR, "the temperature falls from the bottom up")
                    self.assertGreater(denser[0], CLEAR, "the density is highest in between")
                    self.assertLess(denser[2] - denser[1], 0.03, "but hardly")
        self.assertGreaterEqual(steady[2], 8)
        self.assertGreaterEqual(steady[3], 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
