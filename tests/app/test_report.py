"""`chute report`: test_report.py CHUTE. The page is read as a program reads it: nothing in it points outside, its SVG and
movies are whole, the numbers in it are those of the run's tables, and what a run has not kept is said."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from report_page import Page, rows
from tiny_scene import TINY

chute = sys.argv[1]
RICH = TINY + """series = { every = 0.05 }
profiles = { from = 0.5, bin = 1 }
fields = { from = 0.5 }
impacts = {}
impact_histograms = { from = 0 }
"""
SMALL = ("--size", "160x90", "--frames", "5", "--jobs", "1", "--quiet")
RUNS = {
    "flat": RICH,
    "steep": RICH.replace("18 deg", "26 deg"),
    "bare": TINY.replace("frames = { every = 0.5 }", "series = { every = 0.5 }"),
    "space": TINY.replace('units = "reduced"', 'units = "reduced"\ndimensions = 3').replace("count = 6", "count = 4\nkind = \"lattice\"\ncount_across = 4")
             .replace("duration = 2", "duration = 0.2").replace("every = 0.5", "every = 0.1"),
    "event": TINY.replace("[run]", '[engine]\nmethod = "event"\n[run]'),
    "gas": TINY.replace("count = 6", 'kind = "none"').replace("[contact.normal]", "start = { spread = 1.0 }\n[contact.normal]")
           .replace("[grains]", "[domain]\nsize = [12, 12]\nperiodic = [\"x\", \"y\"]\n[grains]").replace('"18 deg"', '"0 deg"')
           .replace('law = "coulomb-viscous"\nviscosity = 40\nfriction = 0.5', 'law = "frictionless"')
           .replace("[run]", '[engine]\nmethod = "monte-carlo"\ntemperature = 1.0\n[run]')
           .replace("duration = 2", "duration = 20").replace("every = 0.5", "every = 10"),
    "impact": """title = "One impact"
units = "SI"
[experiment]
kind = "normal-impact"
velocity = 0.1
[experiment.i]
radius = 0.003
mass = 0.000148
[contact.normal]
law = "spring-dashpot"
stiffness = 7.32e6
damping = 2.06
[contact.tangential]
law = "frictionless"
[output]
series = { every = 1e-7 }
""",
}


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name, scene in RUNS.items():
            path = os.path.join(cls.folder, name + ".toml")
            with open(path, "w") as file:
                file.write(scene)
            done = subprocess.run([chute, "run", path, "-o", os.path.join(cls.folder, name), "--quiet"],
                                  capture_output=True, text=True)
            assert done.returncode == 0, name + ": " + done.stderr

    def report(self, *arguments, **environment):
        done = subprocess.run([chute, "report", *arguments, "-o", "page.html"], cwd=self.folder, capture_output=True,
                              text=True, env={**os.environ, **environment})
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""))
        with open(os.path.join(self.folder, "page.html"), encoding="utf-8") as file:
            return Page(file.read())

    def assert_is_whole(self, page):
        self.assertEqual(page.slips, [])
        for address in page.addresses():
            self.assertRegex(address, r"\Adata:", "the page points outside")
        self.assertNotIn("url(", page.style())
        self.assertNotIn("@import", page.style())
        policies = [a["content"] for tag, a in page.elements if a.get("http-equiv") == "Content-Security-Policy"]
        self.assertRegex(policies[0], r"\Adefault-src 'none';")
        for drawing in page.drawings():
            self.assertEqual(drawing.tag, "{http://www.w3.org/2000/svg}svg")
            for element in drawing.iter():
                for name, value in element.attrib.items():
                    if name.endswith("href"):
                        self.assertRegex(value, r"\A(#|data:)")
        for picture in page.files("image/png"):
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        # A figure stands there twice, for light and for dark pages.
        self.assertEqual(len(page.drawings()) % 2, 0)

    def table(self, run, name):
        with open(os.path.join(self.folder, run, name), "rb") as file:
            return rows(file.read())

    def test_one_run(self):
        page = self.report("flat", *SMALL)
        self.assert_is_whole(page)
        text = page.text()
        self.assertIn("8 discs", text)
        self.assertIn("inclined by 18°", text)
        with open(os.path.join(self.folder, "flat", "run.json")) as file:
            self.assertIn(json.load(file)["flow"]["verdict"], text)
        downloads = page.downloads()
        for name in ("motion", "energy", "profiles", "stress", "fields", "impacts"):
            self.assertIn("flat-figure-%s.csv" % name, downloads)
        for name in ("series.csv", "profiles.csv", "scene.toml"):  # as they lie in the run, to the byte
            with open(os.path.join(self.folder, "flat", name), "rb") as file:
                self.assertEqual(downloads["flat.toml" if name == "scene.toml" else "flat-" + name], file.read())
        drawn = [(float(r["x"]), float(r["y"])) for r in rows(downloads["flat-figure-motion.csv"]) if r["series"] == "v_x"]
        self.assertEqual(drawn, [(float(r["time"]), float(r["v_x"])) for r in self.table("flat", "series.csv")])
        drawn = [r["y_err"] for r in rows(downloads["flat-figure-profiles.csv"]) if r["series"] == "eta"]
        self.assertEqual([float(e) if e else None for e in drawn],
                         [float(r["eta_err"]) if r["eta_err"] else None for r in self.table("flat", "profiles.csv")])

    def test_the_energy_account_is_that_of_the_series(self):
        text = re.sub(r"\s+", " ", self.report("flat", "--no-film", "--quiet").text())
        series = self.table("flat", "series.csv")
        change = {key: float(series[-1][key]) - float(series[0][key])
                  for key in ("gravity_work", "normal_loss", "shear_loss", "residual")}
        for name, key in (("work of gravity", "gravity_work"), ("normal dissipation", "normal_loss"),
                          ("tangential dissipation", "shear_loss")):
            shown = re.search(name + r" (−?)([0-9.]+)", text)
            self.assertAlmostEqual(float(shown[2]) * (-1 if shown[1] else 1) / change[key], 1, delta=6e-4)

    def test_runs_side_by_side(self):
        page = self.report("flat", "steep", *SMALL)
        self.assert_is_whole(page)
        text = page.text()
        self.assertIn("2 runs compared", text)
        self.assertIn("incline.angle", text)
        self.assertNotIn("grains.count", re.sub(r"\[grains\].*", "", text, flags=re.S))  # the same in both
        series = {r["series"] for r in rows(page.downloads()["comparison-figure-motion.csv"])}
        self.assertEqual(series, {"flat", "steep"})
        self.assertEqual(len([1 for tag, a in page.elements if tag == "video" or a.get("class") == "film card"]),
                         4 if shutil.which("ffmpeg") else 2)

    def test_every_kind_of_run_and_what_it_has_not(self):
        for run in RUNS:
            with self.subTest(run=run):
                page = self.report(run, *SMALL)
                self.assert_is_whole(page)
                self.assertTrue(page.drawings(), "no figure")
        text = self.report("bare", *SMALL).text()
        self.assertIn("What is not here", text)
        for key in ("output.frames", "output.profiles", "output.impact_histograms", "output.impacts"):
            self.assertIn(key + " = {", text)

    def test_without_ffmpeg_the_film_is_single_pictures(self):
        page = self.report("flat", *SMALL, PATH="/nowhere")
        self.assert_is_whole(page)
        self.assertEqual(page.files("video"), [])
        listed = [data for tag, data in page.texts if tag == "script" and data.lstrip().startswith("[")]
        frames = json.loads(listed[0])
        self.assertEqual(len(frames), 5)
        self.assertEqual(len(set(frames)), 5)

    def test_the_same_bytes_again(self):
        with open(os.path.join(self.folder, "page.html"), "wb") as file:
            file.write(b"old")
        first = self.report("flat", *SMALL).text()
        self.assertEqual(first, self.report("flat", *SMALL[:-3], "--jobs", "2", "--quiet").text())

    def refused(self, *arguments):
        done = subprocess.run([chute, "report", *arguments, "-o", "none.html", "--quiet"], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "none.html")))
        self.assertRegex(done.stderr, r"\Achute: [^\n]+\n\Z")
        return done.stderr

    def test_what_is_no_run_or_cannot_be_compared_is_refused(self):
        self.assertIn("not a run directory", self.refused("."))
        self.assertIn("same units", self.refused("flat", "impact"))
        self.assertIn("named twice", self.refused("flat", "flat/"))
        self.assertIn("--size", self.refused("flat", "--size", "big"))
        damaged = os.path.join(self.folder, "damaged")
        shutil.copytree(os.path.join(self.folder, "bare"), damaged)
        self.addCleanup(shutil.rmtree, damaged)
        with open(os.path.join(damaged, "run.json"), "w") as file:
            file.write("{")
        self.assertIn("run.json", self.refused("damaged"))
        shutil.copy(os.path.join(self.folder, "bare", "run.json"), damaged)
        with open(os.path.join(damaged, "series.csv"), "a") as file:
            file.write("1,2\n")
        self.assertIn("series.csv:", self.refused("damaged"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
