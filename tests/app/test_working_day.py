"""A physicist's day, by the commands of the README: test_working_day.py CHUTE SOURCES. Each task of its section "A working day" is run
as it stands, in one folder; then it is looked at what came of it."""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

chute, sources = (os.path.abspath(word) for word in sys.argv[1:3])


def tasks():
    """The commands of each task, in order."""
    with open(os.path.join(sources, "README.md"), encoding="utf-8") as readme:
        section = readme.read().split("\n## A working day\n")[1].split("\n## ")[0]
    return re.findall(r"\n```sh\n(.*?)\n```", section, re.DOTALL)


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class WorkingDay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        os.mkdir(os.path.join(cls.folder, "bin"))
        os.symlink(os.path.abspath(chute), os.path.join(cls.folder, "bin", "chute"))
        environment = dict(os.environ, PATH=os.path.join(cls.folder, "bin") + ":" + os.environ["PATH"])
        cls.said = []
        for commands in tasks():
            done = subprocess.run(["bash", "-e", "-c", commands], cwd=cls.folder, env=environment, capture_output=True,
                                  text=True, timeout=600)
            cls.said.append(done)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def good(self, task):
        """What a task said, which ended well."""
        done = self.said[task - 1]
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def test_0_all_tasks_stand_in_the_readme(self):
        self.assertEqual(len(self.said), 8)

    def test_1_own_flow_with_three_seeds(self):
        done = self.good(1)
        self.assertIn("# chosen: contact.normal.stiffness = ", done.stdout)
        self.assertIn("chosen: contact.tangential.viscosity = ", done.stderr)
        self.assertRegex(done.stderr, r"run: the energy account closes to \S+ %: good")
        self.assertIn("overlay.toml: ", done.stdout)  # --check
        for seed in "123":
            with open(self.path("out", "flow-" + seed, "run.json"), encoding="utf-8") as file:
                self.assertEqual(json.load(file)["energy"]["verdict"], "good")
        rows = table(self.path("out", "figures", "overlay.csv"))
        self.assertEqual({row["series"] for row in rows}, {"seed 1", "seed 2", "seed 3", "law", "a model"})
        model = [row for row in rows if row["series"] == "a model"]
        self.assertEqual(len(model), 200)
        self.assertAlmostEqual(float(model[-1]["y"]), 0.3 * (1 - 2.718281828459045 ** -2))
        profile = table(self.path("out", "flow-2", "profiles.csv"))
        drawn = [row for row in rows if row["series"] == "seed 2"]
        self.assertEqual([row["y"] for row in drawn], [row["v_x"] for row in profile if row["v_x"]])
        with open(self.path("out", "figures", "overlay.svg"), encoding="utf-8") as file:
            picture = file.read().lower()
        self.assertTrue("#c00000" in picture)
        self.assertTrue('width="243.78pt"' in picture)  # 86 mm
        strokes = {float(width) for width in re.findall(r'stroke-width="([^"]*)"', picture)}
        self.assertGreater(min(strokes), 0.1)
        with open(self.path("out", "figures", "overlay.pdf"), "rb") as file:
            self.assertEqual(file.read(5), b"%PDF-")

    def test_2_a_film_in_slow_motion(self):
        done = self.good(2)
        self.assertEqual(done.stderr.count("a second of the movie is 2 sqrt(d/g)\n"), 2)
        with open(self.path("out", "stills", "000020.pdf"), "rb") as file:
            self.assertIn(b"/MediaBox [ 0 0 243.8", file.read())  # 86 mm
        for name in ("slow.gif", "closer.gif"):
            with open(self.path("out", name), "rb") as file:
                self.assertEqual(file.read(4), b"GIF8")

    def test_3_a_phase_diagram(self):
        done = self.good(3)
        self.assertRegex(done.stdout, r"# cost of all ")
        places = table(self.path("out", "figures", "diagram.csv"))
        self.assertEqual(len(places), 20)
        self.assertLessEqual({row["series"] for row in places},
                             {"stopped", "steady", "accelerating", "runaway", "unsettled"})
        phases = {row["series"] for row in places}
        self.assertGreater(len(phases), 1)
        with open(self.path("out", "figures", "diagram.svg"), encoding="utf-8") as file:
            picture = file.read().lower()
        tints = ["#b6c7d8", "#e8bdb3", "#b6dbcf", "#cab7c9", "#f3dfbf"]  # 0.3 of the first colours on white
        drawn = sum('fill="%s"' % tint in picture for tint in tints)
        self.assertEqual(drawn, len(phases))  # every phase has cells

    def test_4_spheres_of_another_program(self):
        self.assertIn("3 points", self.good(4).stdout)
        # the network is in the picture
        def drawn(*words):
            done = subprocess.run([chute, "render", "dump.vtk", "--color", "type", "--size", "480x360", "-o", "other",
                                   "--quiet", "--species", "sand,steel", *words],
                                  cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.path("other", "000000.png"), "rb") as picture:
                return picture.read()

        with open(self.path("out", "dump", "000000.png"), "rb") as picture:
            first = picture.read()
        self.assertEqual(first, drawn("--contacts", "contacts.csv", "--opacity", "0.35"))
        self.assertNotEqual(first, drawn("--opacity", "0.35"))

    def test_5_columns_are_told(self):
        said = self.good(5).stdout
        self.assertRegex(said, r"v_x_err +sqrt\(gd\) +of v_x: standard error")
        self.assertRegex(said, r"angular_velocity +sqrt\(g/d\) +anticlockwise")
        self.assertNotIn("not known", said)
        self.assertIn("v_x at the end:", said)
        with open(self.path("out", "flow-1", "profiles.csv"), encoding="utf-8") as file:
            self.assertIn("\n# column v_* (sqrt(gd)): mean velocity", file.read())

    def test_5_with_pandas_and_vtk(self):
        self.good(1)
        with open(os.path.join(sources, "README.md"), encoding="utf-8") as readme:
            page = readme.read().split("### Reading a run from Python")[1].split("\n## ")[0]
        code = 'run = "out/flow-1"\n' + re.findall(r"```python\n(.*?)```", page, re.DOTALL)[0]
        python = "/usr/bin/python3"  # Debian's, whose packages the page names
        done = subprocess.run([python, "-c", code], cwd=self.folder, capture_output=True, text=True)
        if "ModuleNotFoundError" in done.stderr or not os.path.exists(python):
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"t = 0.0 \(reduced\): 60 grains move, mean v_x [12]\.\d+")

    def test_6_pictures_and_tables_are_compared(self):
        done = self.said[5]
        if "install librsvg2-bin" in done.stderr or "install poppler-utils" in done.stderr:
            self.skipTest(done.stderr.strip())
        self.assertEqual(self.good(6).stdout.count("same"), 4)

    def test_7_runs_and_sweeps_grow(self):
        done = self.good(7)
        self.assertRegex(done.stderr, r"chute run out/stopped --resume|out/stopped: .*finished")
        stopped = table(self.path("out", "stopped", "series.csv"))
        self.assertAlmostEqual(float(stopped[-1]["time"]), 150)
        self.assertEqual(len(stopped), 1501)
        self.assertIn("the flow is ", done.stdout)
        self.assertIn("24 of 24 points are there", done.stdout)
        times = [float(row["time"]) for row in table(self.path("out", "flow-1", "series.csv"))]
        self.assertAlmostEqual(times[-1], 50)
        self.assertEqual(len(times), 501)
        self.assertTrue(os.path.exists(self.path("out", "flow-1", "frames", "000120.vtp")))  # 81 + 40
        quench = table(self.path("out", "quench", "series.csv"))
        self.assertLess(abs(float(quench[-1]["v_x"])), 0.05)  # on the level it stops
        self.assertGreater(float(quench[0]["v_x"]), 0.05)

    def test_8_a_page_of_slips(self):
        lines = self.good(8).stderr.splitlines()
        self.assertEqual([line.split(": ")[1] for line in lines],
                         ["slips.toml:5", "slips.toml:7", "slips.toml:10", "slips.toml:12", "slips.toml:1"])
        self.assertIn("did you mean incline.gravity?", lines[-1])


class InAFolder(unittest.TestCase):
    """Small files, in a folder of their own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
        return os.path.join(self.folder, name)


class Compare(InAFolder):
    """Budgets and tolerances do what they say."""

    def compare(self, *words):
        return subprocess.run([chute, "compare", *words], capture_output=True, text=True)

    def test_tables(self):
        a = self.write("a.csv", "# then\nname,x,y\none,1,2\ntwo,3,\n")
        self.assertEqual(self.compare(a, self.write("b.csv", "# now\nname,x,y\none,1,2\ntwo,3,\n")).returncode, 0)
        near = self.write("c.csv", "name,x,y\none,1.0001,2\ntwo,3,\n")
        said = self.compare(a, near)
        self.assertEqual(said.returncode, 1)
        self.assertIn("different: 1 of 6 cells, the worst in line 2, x: 1 and 1.0001", said.stdout)
        self.assertEqual(self.compare(a, near, "--rtol", "1e-3").returncode, 0)
        self.assertEqual(self.compare(a, near, "--atol", "2e-4").returncode, 0)
        self.assertEqual(self.compare(a, near, "--rtol", "1e-5").returncode, 1)
        for other, says in (("name,x,y\none,1,2\ntwo,3,7\n", "1 of 6 cells"), ("name,x,y\none,1,2\n", "1 rows, expected 2"),
                            ("name,x,z\none,1,2\ntwo,3,\n", "column y is missing"),
                            ("name,x,y\none,1,2\nthree,3,\n", "name: two and three")):
            said = self.compare(a, self.write("d.csv", other), "--rtol", "1")
            self.assertEqual(said.returncode, 1, other)
            self.assertIn(says, said.stdout)
        whole = json.loads(self.compare(a, near, "--json").stdout)
        self.assertEqual((whole["different"], whole["pictures"][0]["over"]), (1, 1))

    def test_budgets(self):
        golden = os.path.join(sources, "golden")
        a, b = (os.path.join(golden, name + ".png") for name in ("frame-discs", "frame-chains"))
        n = json.loads(self.compare(a, b, "--json").stdout)["pictures"][0]
        for budget, holds in ((("--max-pixels", str(n["over"])), True), (("--max-pixels", str(n["over"] - 1)), False),
                              (("--max-pixels", "100%"), True), (("--max-pixels", "0.001%"), False),
                              (("--rms", str(n["rms"] + 1e-6)), True), (("--rms", str(n["rms"] * 0.9)), False),
                              (("--ssim", str(n["ssim"] - 1e-6)), True), (("--ssim", "0.99999"), False)):
            self.assertEqual(self.compare(a, b, *budget).returncode, 0 if holds else 1, budget)
        self.assertEqual(self.compare(a, b, "--max-pixels", "many").returncode, 2)

    def test_a_program_that_is_not_there_is_named_with_its_package(self):
        drawing = self.write("a.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10"/>')
        said = subprocess.run([chute, "compare", drawing, drawing], capture_output=True, text=True,
                              env=dict(os.environ, PATH=self.folder))
        self.assertEqual(said.returncode, 1)
        self.assertIn("is drawn by rsvg-convert, which is not here: install librsvg2-bin", said.stderr)


class Recipes(InAFolder):
    """What a recipe leaves unsaid, or says in vain, is told."""

    def figure(self, text, *words):
        self.write("r.toml", text)
        return subprocess.run([chute, "figure", "r.toml", "-o", "out", "--quiet", *words], cwd=self.folder,
                              capture_output=True, text=True)

    def test_several_slips_at_once(self):
        said = self.figure('titel = "x"\n[data]\nexpression = "sin(x"\nseries = "a"\nrange = [0, 3]\n'
                           '[plot]\nwidht_mm = 80\n[style]\ncolors = ["#c000"]\n')
        self.assertEqual(said.returncode, 2)
        self.assertEqual(sorted(line.split(": ")[1] for line in said.stderr.splitlines()),
                         ["r.toml:" + number for number in ("1", "3", "7", "9")], said.stderr)

    def test_an_axis_along_which_nothing_counts(self):
        for axis, key in (("right", "axis"), ("top", "x_axis")):
            said = self.figure('title = "x"\n[data]\nexpression = "x"\nseries = "a"\nrange = [0, 3]\n'
                               '[plot.%s]\nlabel = "b"\n' % axis)
            self.assertEqual(said.returncode, 2)
            self.assertIn('%s: no series counts along it: [[plot.series]] with %s = "%s"' % (axis, key, axis), said.stderr)

    def test_rows_of_a_map_without_a_map_and_a_map_with_an_axis_above(self):
        self.write("t.csv", "a,b,c\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n")
        data = 'title = "x"\n[[data]]\ntable = "t.csv"\nx = "a"\ny = "b"\nz = "c"\n'
        said = self.figure(data)
        self.assertEqual(said.returncode, 2)
        self.assertIn('z = "c" is of a map: [[plot.panel]] with map = { series = "c b=*" } draws it', said.stderr)
        panel = '[[plot.panel]]\nmap = { series = "c b=*" }\n'
        self.assertEqual(self.figure(data + panel).returncode, 0)
        line = '[[data]]\nexpression = "x/10"\nseries = "l"\nrange = [0, 9]\n'
        series = '[[plot.series]]\nmatch = "l"\n'
        said = self.figure(data + line + panel + series + 'x_axis = "top"\n[plot.top]\nlabel = "above"\n')
        self.assertEqual(said.returncode, 0, said.stderr)
        with open(os.path.join(self.folder, "out", "r.svg"), encoding="utf-8") as file:
            self.assertIn("above", file.read())
        said = self.figure(data + line + panel + series + 'axis = "right"\n[plot.right]\nlabel = "R"\n')
        self.assertEqual(said.returncode, 2)
        self.assertIn("right: the colour bar of the map stands there", said.stderr)

    def test_averages_of_what_did_not_settle_are_drawn_hollow(self):
        self.write("p.csv", "# averages\n# no steady state was found (the flow is unsettled): averages from t = 3 on all the same\n"
                   "h,v_x\n0.5,1\n1.5,2\n")
        said = self.figure('title = "x"\n[data]\ntable = "p.csv"\nx = "h"\ny = "v_x"\nseries = "one"\n')
        self.assertEqual(said.returncode, 0, said.stderr)
        with open(os.path.join(self.folder, "out", "r.csv"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertIn("# hollow: one", lines)
        self.assertIn("# one: no steady state was found (the flow is unsettled): averages from t = 3 on all the same", lines)
        with open(os.path.join(self.folder, "out", "r.svg"), encoding="utf-8") as file:
            self.assertIn("not settled", file.read())

    def test_the_profiles_of_a_run_say_so(self):
        run = os.path.join(self.folder, "run")
        done = subprocess.run([chute, "run", os.path.join(sources, "scenes", "demo.toml"), "-o", run, "--quiet",
                               "--set", "grains.count=20", "--set", "bed.count=10", "--set", "run.duration=2", "--set",
                               "output.profiles={from=\"steady\"}", "--set", "contact.normal.stiffness=1e4", "--set",
                               "contact.tangential.viscosity=40"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ('[data]\ntable = "run/profiles.csv"\nx = "h"\ny = "v_x"\nseries = "one"\n',
                     '[data]\nx = "h"\ny = "v"\n[[data.curve]]\nseries = "one"\nruns = ["run"]\nextract = "profile"\n'
                     'column = "v_x"\n'):
            said = self.figure('title = "x"\n' + text)
            self.assertEqual(said.returncode, 0, said.stderr)
            with open(os.path.join(self.folder, "out", "r.csv"), encoding="utf-8") as file:
                lines = file.read()
            self.assertIn("\n# hollow: one\n", lines)
            self.assertIn("\n# one: no steady state was found", lines)

    def test_a_key_of_all_scenes_is_set_on_top(self):
        recipe = ('title = "x"\n[data]\nscene = "%s"\nset = ["grains.count=20", "bed.count=10", "run.duration=1", "output.series={every=0.25}"]\n'
                  'x = "t"\ny = "v"\n[[data.curve]]\nseries = "one"\nset = ["incline.angle=\'%d deg\'"]\nextract = "series"\n'
                  'column = "v_x"\n')
        scene, tables = os.path.join(sources, "scenes", "demo.toml"), {}
        for name, angle, words in (("own", 20, ()), ("other", 24, ()), ("on top", 20, ("--set", "incline.angle='24 deg'"))):
            said = self.figure(recipe % (scene, angle), *words)
            self.assertEqual(said.returncode, 0, said.stderr)
            with open(os.path.join(self.folder, "out", "r.csv"), encoding="utf-8") as file:
                tables[name] = file.read()
        rows = {name: [line for line in text.splitlines() if line[0] != "#"] for name, text in tables.items()}
        self.assertGreater(len(rows["own"]), 4)
        self.assertEqual(rows["on top"], rows["other"])
        self.assertNotEqual(rows["on top"], rows["own"])
        self.assertIn("\n# not as the recipe has it: incline.angle='24 deg'\n", tables["on top"])
        said = self.figure('title = "x"\n[data]\nexpression = "x"\nseries = "a"\nrange = [0, 3]\n', "--set", "seed=2")
        self.assertEqual((said.returncode, said.stderr.count("\n")), (2, 1))
        self.assertIn("r.toml: no scene is simulated, of which --set could change a key", said.stderr)

    def test_numbers_of_options_say_what_they_must_be(self):
        for words, says in ((("render", ".", "--speed", "0", "--movie", "a.gif"), "0 is not allowed, must be a number > 0"),
                            (("compare", "a.csv", "b.csv", "--rtol", "-1"), "-1 is not allowed, must be a number >= 0"),
                            (("compare", "a.png", "b.png", "--ssim", "2"), "--ssim: Value 2 not in range")):
            said = subprocess.run([chute, *words], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(said.returncode, 2)
            self.assertIn(says, said.stderr)


class Columns(unittest.TestCase):
    """Whatever runs write, `chute info --columns` knows what it means."""

    RUNS = {
        "flow": ["demo.toml", "grains.count=40", "bed.count=12", "run.duration=4", "contact.normal.stiffness=1e4",
                 "contact.tangential.viscosity=40", "output.frames={every=2}", "output.contacts=true",
                 "output.profiles={bin=1.0, fine=0.5}", "output.fields={every=0.2}", "output.impacts={from=1}",
                 "output.impact_histograms={from=1}", "output.velocities={every=0.5}", "output.moments={every=0.5}",
                 "output.heights={every=0.5}", "output.forces={every=0.5}"],
        "ball": ["ball-3d.toml", "run.duration=0.2", "grains.independent=true", "grains.count=3",
                 "output.velocities={every=0.01}", "output.diffusion={every=0.01, longest=0.2}", "output.beads={}",
                 "output.trapping={every=0.01}", "output.bed=true", "output.frames={every=0.1}"],
        "gas": ["hard-discs.toml", "run.duration=100", "output.pairs={every=10}"],
        "mixture": ["mixture.toml", "run.duration=3", "output.frames={every=2}", "output.segregation={every=0.5}"],
        "pile": ["rice-pile.toml", "run.duration=2000"],
    }

    def test_all_columns_and_arrays(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        seen = set()
        for name, (scene, *settings) in self.RUNS.items():
            run = os.path.join(folder, name)
            changes = [word for setting in settings for word in ("--set", setting)]
            done = subprocess.run([chute, "run", os.path.join(sources, "scenes", scene), "-o", run, "--quiet", *changes],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            for at, _, files in os.walk(run):
                for file in files:
                    if not file.endswith((".csv", ".vtp")) or file == "walls.vtp":
                        continue
                    told = subprocess.run([chute, "info", "--columns", os.path.join(at, file)], capture_output=True,
                                          text=True)
                    self.assertEqual(told.returncode, 0, told.stderr)
                    self.assertNotIn("not known:", told.stdout, file)
                    seen.add(file)
        self.assertGreater(len(seen), 18, seen)


class Keys(unittest.TestCase):
    def test_the_readme_has_the_keys_of_recipes_and_the_columns(self):
        with open(os.path.join(sources, "README.md"), encoding="utf-8") as readme:
            text = readme.read()
        for words in (["figure", "--keys"], ["info", "--columns"]):
            printed = subprocess.run([chute, *words], capture_output=True, text=True).stdout.strip()
            self.assertGreater(len(printed), 3000)
            self.assertIn(printed, text, "put what `chute %s` prints into README.md" % " ".join(words))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
