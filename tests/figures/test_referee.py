"""A referee finds nothing wrong with the figures that are cheap to make: test_referee.py CHUTE."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

chute = sys.argv[1]
CHEAP = ["fig-1-04", "fig-1-06", "fig-2-02", "fig-2-15", "fig-3-01", "fig-3-02", "fig-3-03", "fig-3-04", "fig-3-05", "fig-3-06",
         "fig-3-07", "fig-3-08", "fig-3-09", "fig-3-10", "table-3-1", "fig-4-01", "fig-4-03", "fig-4-04", "fig-4-08", "fig-4-09", "fig-4-12", "fig-4-13",
         "fig-4-19", "fig-4-21", "fig-4-22", "fig-4-31", "fig-m-03", "fig-m-09"]


def run(folder, *arguments):
    return subprocess.run([chute, "figure", *arguments, "--quick", "--quiet", "--referee", "--jobs", "2", "-o", folder],
                          capture_output=True, text=True)


class Referee(unittest.TestCase):
    def test_cheap_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            made = run(folder, *CHEAP)
            self.assertEqual((made.returncode, made.stdout), (0, ""), made.stdout + made.stderr)
            # an error is never 0, and every panel of a simulated figure tells what was held fixed
            for name in CHEAP:
                with open(os.path.join(folder, name + ".csv"), encoding="utf-8") as file:
                    text = file.read()
                for line in text.splitlines():
                    if not line.startswith("#"):
                        self.assertIsNone(re.search(r",0(\\.0*)?$", line.split(",", 4)[-1]), name)
            with open(os.path.join(folder, "fig-4-13.csv"), encoding="utf-8") as file:
                told = [line for line in file if line.startswith("# parameters")]
            self.assertEqual(len(told), 4)
            self.assertIn("# parameters d: Phi=2.25 sin(theta)=0.088 eps=0.1 e_n=0.7 mu=0.13\n", told)
            self.assertIn("# parameters b: Phi=2.25 sin(theta)=0.088 eps_max=0.2 e_n=0.7 mu=0.13\n", told)

    def test_a_figure_of_a_user(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "mine.csv"), "w", encoding="utf-8") as file:
                file.write("series,x,y\nslow,0,1\nslow,1,2\nfast,0,2\nfast,1,9\n")
            recipe = os.path.join(folder, "mine.toml")
            with open(recipe, "w", encoding="utf-8") as file:
                file.write('title = "mine"\n[data]\ntable = "mine.csv"\n[plot]\nkind = "line"\n'
                           '[[plot.series]]\nmatch = "*"\ndash = "solid"\n')
            made = run(os.path.join(folder, "out"), recipe)
            self.assertEqual(made.returncode, 1, made.stderr)
            self.assertIn("mine: colour alone: fast and slow", made.stdout)
            self.assertIn("mine: no parameters", made.stdout)


unittest.main(argv=sys.argv[:1])
