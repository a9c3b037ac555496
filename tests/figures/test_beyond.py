"""What figures beyond the thesis must show, on the CSV of the quick ones: test_beyond.py CHUTE."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

from figure_csv import Figures, read_curves

chute = sys.argv[1]


class Beyond(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Figures(chute, "fig-b-15")

    def test_beyond_the_steady_state(self):
        curves = self.made.curves("fig-b-15")
        for name, steady in (("ball", (0.05, 0.12)), ("layer", (0.2, 0.36))):
            points = curves["", name]
            for (x, y, _), (u, v, _) in zip(points, points[1:]):
                self.assertGreater(v, y, "%s: %g at sin = %g, %g at %g" % (name, y, x, v, u))
            for x, y, _ in points:
                self.assertEqual(y > 0, x > steady[1], "%s: %g at sin = %g" % (name, y, x))
        # What bounces from bead to bead and turns with them gains as a ball that rolls: 5/7 of g sin θ, less a constant.
        ball = [(x, y) for x, y, _ in curves["", "ball"] if x > 0.12]
        slope = (ball[-1][1] - ball[0][1]) / (ball[-1][0] - ball[0][0])
        self.assertLess(abs(slope - 5 / 7), 0.05)

    def test_a_run_after_another_goes_on_from_its_end(self):
        scene = """
units = "reduced"
incline.angle = "18 deg"
bed = { kind = "row", count = 12 }
grains = { count = 24, diameter = { mean = 1.0, std = 0.05 } }
contact.normal = { stiffness = 1e4, restitution = 0.6 }
contact.tangential = { law = "coulomb-viscous", viscosity = 20.0, friction = 0.5 }
run.duration = 2.0
output.series.every = 0.5
"""
        recipe = """
title = "Steeper at once"
[data]
scene = "flow.toml"
set = ["run.duration=1"]
x = "t"
y = "v_x"
[[data.curve]]
series = "then"
set = ["incline.angle=30 deg"]
after = ["incline.angle=18 deg", "run.duration=2"]
extract = "series"
column = "v_x"
[[data.curve]]
series = "pushed"
set = ["incline.angle=30 deg"]
after = ["incline.angle=18 deg", "run.duration=2"]
go_on = ["grains.start.velocity=2"]
extract = "series"
column = "v_x"
[plot]
"""
        with tempfile.TemporaryDirectory() as folder:
            at = lambda name: os.path.join(folder, name)
            for name, text in (("flow.toml", scene), ("after.toml", recipe)):
                with open(at(name), "w", encoding="utf-8") as file:
                    file.write(text)
            subprocess.run([chute, "figure", at("after.toml"), "-o", at("figures"), "--quiet"], check=True)
            curves = read_curves(at("figures/after.csv"))
            told, pushed = curves["", "then"], curves["", "pushed"]
            subprocess.run([chute, "run", at("flow.toml"), "-o", at("first"), "--quiet"], check=True)
            subprocess.run([chute, "run", at("flow.toml"), "-o", at("second"), "--quiet", "--set", "incline.angle=30 deg", "--set",
                            "run.duration=1", "--set", "grains={start={from='%s'}}" % at("first")], check=True)
            with open(at("second/series.csv"), encoding="utf-8") as file:
                true = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual(len(told), len(true))
        for (x, y, _), row in zip(told, true):
            self.assertAlmostEqual(x, float(row["time"]))
            self.assertAlmostEqual(y, float(row["v_x"]), delta=1e-9)
        self.assertGreater(told[0][1], 0.3, "it did not begin with what flowed before")
        self.assertAlmostEqual(pushed[0][1], told[0][1] + 2, delta=1e-9)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
