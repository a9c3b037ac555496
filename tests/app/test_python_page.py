"""The page of README.md about reading a run from Python: test_python_page.py CHUTE SOURCES. Runs its code on a run and holds what
it finds against the run's own tables. Exit status 77 without pandas or VTK's Python package."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

from tiny_scene import TINY

chute, sources = os.path.abspath(sys.argv[1]), sys.argv[2]
try:
    import pandas
    import vtk
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)


class Page(unittest.TestCase):
    def test_the_code_reads_a_run(self):
        with open(os.path.join(sources, "README.md"), encoding="utf-8") as file:
            page = file.read().split("### Reading a run from Python")[1].split("\n## ")[0]
        code = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertEqual(len(code), 1)
        with tempfile.TemporaryDirectory() as folder:
            run = os.path.join(folder, "run")
            scene = TINY + "series = { every = 0.5 }\n"
            subprocess.run([chute, "run", "-", "-o", run, "--quiet"], input=scene, text=True, check=True)
            names = {"run": run}
            exec(code[0], names)
            grains, time, units = names["frame"](4)
        self.assertEqual(units, "reduced")
        at = (names["series"]["time"] - time).abs().idxmin()
        moving = grains[grains["type"] == 1]
        self.assertEqual(len(moving), 8)
        self.assertAlmostEqual(moving["velocity_x"].mean(), names["series"]["v_x"][at], 6)
        self.assertEqual(names["record"]["seed"], 1)
        self.assertEqual(names["profile"]["count"].sum(), 8)
        self.assertIn("verdict", names["record"]["flow"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
