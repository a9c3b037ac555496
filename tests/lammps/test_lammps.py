"""LAMMPS moves grains as the soft engine does: test_lammps.py CHUTE. Exit status 77 where the program lmp is missing."""
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "app"))
from tiny_scene import LAWS, SIXTY, table

chute = os.path.abspath(sys.argv[1])
THERE = bool(shutil.which("lmp"))
TWO = """title = "two grains"
[incline]
angle = "0 deg"
gravity = 0
[domain]
periodic = []
[bed]
kind = "none"
[grains]
start = { from = "two.vtk" }
""" + LAWS.replace("viscosity = 40", "viscosity = 20") + """[engine]
integrator = "verlet"
[run]
duration = 0.2
[output]
contacts = true
frames = { every = 0.1 }
series = { every = 0.1 }
"""
# damping and viscosity with the reduced mass, as gran/hooke has them: the same to the last digits with any sizes
FLOW = 'title = "a flow"\n' + SIXTY + """[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
damping = 50
mass_scaling = "damping"
[contact.tangential]
law = "coulomb-viscous"
viscosity = 50
friction = 0.5
mass_scaling = "damping"
[engine]
integrator = "verlet"
[run]
duration = 1
[output]
contacts = true
frames = { every = 0.1 }
series = { every = 0.1 }
profiles = { from = 0.5, every = 0.1 }
"""
BOX = FLOW.replace("seed = 3", "seed = 3\ndimensions = 3").replace("[bed]\ncount = 20", """[domain]
periodic = ["x"]
size = [8, 6]
[[wall]]
point = [0, 0, 0]
normal = [0, 1, 0]
friction = 0.3
[[wall]]
point = [0, 6, 0]
normal = [0, -1, -0.1]
[bed]
kind = "flat\"""").replace(", std = 0.05", "")


# Three materials, a wall of one and a flat bed of another; each two meet in their own way.
MIXED = """title = "mixed"
seed = 3
dimensions = 3
[incline]
angle = "20 deg"
[domain]
periodic = ["x"]
size = [8, 6]
[[wall]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "bed"
friction = 0.3
[[wall]]
point = [0, 6, 0]
normal = [0, -1, 0]
material = "heavy"
restitution = 0.4
[bed]
kind = "flat"
material = "bed"
[[material]]
name = "light"
share = 0.7
diameter = { mean = 1.0 }
[[material]]
name = "heavy"
share = 0.3
density = 2
diameter = { mean = 1.2 }
[[material]]
name = "bed"
[grains]
count = 60
start = { velocity = 2, spread = 1 }
[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
restitution = 0.8
[contact.tangential]
law = "frictionless"
[engine]
integrator = "verlet"
[run]
duration = 1
[output]
frames = { every = 0.1 }
series = { every = 0.1 }
"""
BETWEEN = ["""[[contact.between]]
materials = ["light", "heavy"]
restitution = 0.5
""", """[[contact.between]]
materials = ["heavy", "heavy"]
normal = { stiffness = 3e4 }
""", """[[contact.between]]
materials = ["bed", "light"]
restitution = 0.3
"""]


def grains(file, rows):
    """Two grains as VTK: (place, radius, velocity, spin) each."""
    def text(values):
        return " ".join("%.17g" % v for v in values)
    lines = ["# vtk DataFile Version 3.0", "two", "ASCII", "DATASET POLYDATA", "POINTS 2 double"]
    lines += [text(r) for r, _, _, _ in rows] + ["POINT_DATA 2", "FIELD FieldData 3", "radius 1 2 double"]
    lines += [text(R for _, R, _, _ in rows), "velocity 3 2 double"] + [text(v) for _, _, v, _ in rows]
    lines += ["angular_velocity 3 2 double"] + [text(w) for _, _, _, w in rows]
    with open(file, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


HEAD_ON = [((2, 2, 0), .5, (1, 0, 0), (0, 0, 0)), ((3.05, 2, 0), .5, (-1, 0, 0), (0, 0, 0))]
OBLIQUE = [((2, 2, 0), .5, (1, .1, 0), (0, 0, .5)), ((3, 2.4, 0), .4, (-1, 0, 0), (0, 0, -2))]
IN_SPACE = [((2, 2, 2), .5, (1, .1, .2), (.3, 1, .5)), ((3, 2.3, 2.1), .4, (-1, 0, .1), (0, .4, -2))]


class Lammps(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        os.mkdir(self.path("tmp"))  # where LAMMPS works

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def call(self, *words, status=0, path=None):
        around = dict(os.environ, TMPDIR=self.path("tmp"), **({"PATH": path} if path else {}))
        done = subprocess.run([chute, *map(str, words)], capture_output=True, text=True, cwd=self.folder, env=around)
        self.assertEqual(done.returncode, status, (words, done.stdout, done.stderr))
        return done

    def run_both(self, scene, *settings):
        for method in ("soft", "lammps"):
            words = [word for setting in settings for word in ("--set", setting)]
            self.call("run", scene, "-o", method, "--force", "--quiet", "--set", "engine.method=" + method, *words)

    def after(self, run, frame):
        """Places, velocities and spins of a frame."""
        shutil.rmtree(self.path("csv"), ignore_errors=True)
        self.call("convert", run, "--to", "csv", "-o", "csv", "--quiet")
        columns = table(self.path("csv", "%06d.csv" % frame))
        return [float(v) for name, values in columns.items() if name[0] in "xyz" or name.startswith(("vel", "angular"))
                for v in values]

    def apart(self, *settings, place=OBLIQUE):
        """Largest difference between both after a collision."""
        grains(self.path("two.vtk"), place)
        self.write("two.toml", TWO)
        self.run_both("two.toml", *settings, *(["dimensions=3"] if place is IN_SPACE else []))
        before = self.after("soft", 0)
        soft, other = self.after("soft", 2), self.after("lammps", 2)
        self.assertGreater(max(abs(a - b) for a, b in zip(before, soft)), 0.5)  # they did collide
        return max(abs(a - b) for a, b in zip(soft, other))

    @unittest.skipUnless(THERE, "lmp")
    def test_a_collision_is_the_same_to_the_last_digits(self):
        hertz = 'contact.normal={law="%s",young=1e5,poisson=0.3,at_velocity=2%s}'
        smooth = 'contact.tangential={law="frictionless"}'
        self.assertLess(self.apart(place=HEAD_ON), 2e-13)
        for place in (OBLIQUE, IN_SPACE):
            for settings in ([], ["contact.attraction=false"], [hertz % ("hertz", ""), smooth],
                             [hertz % ("hertz-linear-damping", ",restitution=0.7"), smooth],
                             [hertz % ("hertz-kuwabara-kono", ",restitution=0.7"), smooth]):
                self.assertLess(self.apart(*settings, place=place), 2e-13, (place, settings))

    @unittest.skipUnless(THERE, "lmp")
    def test_springs_across_agree_as_the_step_shrinks(self):
        """LAMMPS's begin with a whole step of slip, chute's when the surfaces met. In space chute's also turn with the grains."""
        spring = 'contact.tangential={law="%s",friction=0.5,stiffness_ratio=0.8%s}'
        hertz = 'contact.normal={law="hertz",young=1e5,poisson=0.3,at_velocity=2}'
        steps = "engine.steps_per_contact=%d"
        hooke = [self.apart(spring % ("cundall-strack", ""), steps % n) for n in (50, 1600)]
        self.assertLess(hooke[0], 0.1)
        self.assertLess(hooke[1], hooke[0] / 8)
        slow = [self.apart(hertz, spring % ("mindlin", ",shrink=false"), steps % n) for n in (50, 400)]
        self.assertLess(slow[0], 1e-6)
        self.assertLess(slow[1], slow[0] / 6)
        # `granular` has the lever R - xi/2: what it differs by does not go away, and is of that size
        self.assertLess(self.apart(hertz, spring % ("mindlin", "")), 0.01)

    @unittest.skipUnless(THERE, "lmp")
    def test_a_flow_is_the_same_here_there_and_on_two_ranks(self):
        self.write("flow.toml", FLOW)
        self.run_both("flow.toml")
        self.call("run", "flow.toml", "--set", "engine.method=lammps", "--ranks", 2, "-o", "ranks", "--quiet")
        self.call("export", "flow.toml", "--lammps", "deck", "--quiet")
        subprocess.run(["lmp", "-in", "in.lammps", "-log", "none", "-screen", "none"], cwd=self.path("deck"), check=True)
        self.call("import", "deck", "-o", "back", "--quiet")
        soft = table(self.path("soft", "series.csv"))
        for run in ("lammps", "ranks", "back"):
            other = table(self.path(run, "series.csv"))
            for name in ("time", "x", "v_x", "v_y", "omega", "contacts", "translation", "gravity_work"):
                for a, b in zip(soft[name], other[name], strict=True):
                    self.assertAlmostEqual(float(a), float(b), delta=1e-9 * max(1, abs(float(a))), msg=(run, name))
            self.assertEqual(set(other["elastic"]), {""})
            profile, own = table(self.path(run, "profiles.csv")), table(self.path("soft", "profiles.csv"))
            for name in ("h", "grains", "eta", "v_x", "coordination"):
                for a, b in zip(own[name], profile[name], strict=True):
                    self.assertAlmostEqual(float(a or 0), float(b or 0), delta=1e-8, msg=(run, name))
            # forces between steps are those of the step's end, in chute those of its middle
            stress = [(float(a), float(b)) for a, b in zip(own["contact_yy"], profile["contact_yy"]) if float(a) > 0.1]
            self.assertTrue(stress)
            for a, b in stress:
                self.assertAlmostEqual(a, b, delta=0.05 * a)
        self.call("render", "back", "-o", "pictures", "--size", "160x120", "--frames", "3", "--chains", "--jobs", "1", "--quiet")
        self.call("measure", "back", "-o", "measured", "--from", 0.5, "--only", "profiles", "--quiet")
        self.assertEqual(table(self.path("back", "profiles.csv")), table(self.path("measured", "profiles.csv")))

    @unittest.skipUnless(THERE, "lmp")
    def test_an_import_is_as_long_as_its_dumps(self):
        """What LAMMPS has written so far, without a last dump that is cut short."""
        self.write("flow.toml", FLOW)
        self.call("export", "flow.toml", "--lammps", "deck", "--quiet")
        subprocess.run(["lmp", "-in", "in.lammps", "-log", "none", "-screen", "none"], cwd=self.path("deck"), check=True)
        dumps = sorted(os.listdir(self.path("deck", "dumps")))
        for name in dumps[8:]:
            os.remove(self.path("deck", "dumps", name))
        with open(self.path("deck", "dumps", dumps[7]), "r+", encoding="utf-8") as file:
            file.truncate(3000)
        said = self.call("import", "deck", "--quiet").stderr
        self.assertIn("no whole frame of a dump: cut short: left out", said)
        self.assertEqual(len(os.listdir(self.path("deck", "run", "frames"))), 7)
        # the folder of dumps is one that render and measure take
        os.remove(self.path("deck", "dumps", dumps[7]))
        self.call("measure", "deck/dumps", "-o", "measured", "--bed", 61, "--only", "moments", "--quiet")
        self.assertEqual(len(table(self.path("measured", "moments.csv"))["time"]), 7)
        os.remove(self.path("deck", "dumps", dumps[3]))
        said = self.call("import", "deck", "-o", "other", status=2).stderr
        self.assertIn("the dump of step", said)

    @unittest.skipUnless(THERE, "lmp")
    def test_lammps_reads_what_convert_wrote(self):
        for scene in (FLOW, BOX):
            shutil.rmtree(self.path("deck"), ignore_errors=True)
            shutil.rmtree(self.path("dumps"), ignore_errors=True)
            self.write("flow.toml", scene)
            self.call("run", "flow.toml", "-o", "run", "--force", "--quiet")
            self.call("export", "flow.toml", "--lammps", "deck", "--quiet")
            self.call("convert", "run", "--to", "lammps-dump", "--from-one", "-o", "dumps", "--quiet")
            with open(self.path("deck", "in.lammps"), encoding="utf-8") as file:
                begin = file.read().split("shell mkdir")[0]
            shutil.copy(self.path("dumps", "000007.dump"), self.path("deck"))
            places = "x y vx vy" if scene is FLOW else "x y z vx vy vz"
            self.write("deck/in.read", begin + "read_dump 000007.dump 7 " + places + " box yes replace yes\n"
                       "write_dump all custom read.dump id x y z vx vy vz modify sort id format float %.17g\n")
            subprocess.run(["lmp", "-in", "in.read", "-log", "none", "-screen", "none"], cwd=self.path("deck"), check=True)
            with open(self.path("deck", "read.dump"), encoding="utf-8") as file:
                rows = [[float(word) for word in line.split()] for line in file.read().split("vz")[1].splitlines() if line.strip()]
            self.call("convert", "run", "--to", "csv", "-o", "csv%d" % len(scene), "--quiet")
            own = table(self.path("csv%d" % len(scene), "000007.csv"))
            self.assertEqual(len(rows), len(own["x"]))
            for k, row in enumerate(rows):
                for name, value in zip(("x", "y", "z", "velocity_x", "velocity_y", "velocity_z"), row[1:]):
                    # LAMMPS scales places to its box and back
                    self.assertAlmostEqual(float(own[name][k]), value, delta=1e-12, msg=(k, name))

    @unittest.skipUnless(THERE, "lmp")
    def test_walls_and_many_sizes(self):
        self.write("box.toml", BOX)
        self.run_both("box.toml")
        soft, other = self.after("soft", 10), self.after("lammps", 10)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-9)
        counts = [self.call("info", run + "/contacts/000002.vtp").stdout.split("\n")[1] for run in ("soft", "lammps")]
        self.assertEqual(counts[0], counts[1])
        self.run_both("box.toml", "contact.attraction=false")
        soft, other = self.after("soft", 10), self.after("lammps", 10)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-9)
        # more sizes than types: one restitution for all by `damping tsuji`
        self.write("flow.toml", FLOW)
        self.run_both("flow.toml", "grains.rotation=false")
        soft, other = self.after("soft", 10), self.after("lammps", 10)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-9)
        self.run_both("flow.toml", "grains.count=450", "bed.count=150", "run.duration=0.1", 'contact.tangential={law="frictionless"}',
                      'contact.normal={law="spring-dashpot",stiffness=1e4,restitution=0.6}')
        soft, other = self.after("soft", 1), self.after("lammps", 1)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-10)

    @unittest.skipUnless(THERE, "lmp")
    def test_materials_meet_in_their_own_ways(self):
        """Laws by pair, and walls and a bed of a material: the same places; laws that are all one are the older, exact style."""
        scene = MIXED.replace("friction = 0.3\n", "")
        self.write("mixed.toml", scene + "".join(BETWEEN))
        self.run_both("mixed.toml")
        soft, other = self.after("soft", 10), self.after("lammps", 10)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-9)
        without = [scene + "".join(BETWEEN[:k] + BETWEEN[k + 1:]) for k in range(3)]
        without.append(scene.replace("restitution = 0.4\n", "") + "".join(BETWEEN))
        for k, text in enumerate(without):  # each of them matters
            self.write("without.toml", text)
            self.call("run", "without.toml", "-o", "without", "--force", "--quiet")
            self.assertGreater(max(abs(a - b) for a, b in zip(soft, self.after("without", 10))), 1e-6, k)
        self.call("export", "mixed.toml", "--lammps", "deck", "--quiet")
        with open(self.path("deck", "in.lammps"), encoding="utf-8") as file:
            self.assertIn("pair_style granular", file.read())
        # friction by pair, in `granular` with the lever R - xi/2: the same but for that
        rubs = MIXED.replace('law = "frictionless"', 'law = "cundall-strack"\nstiffness_ratio = 0.3\nfriction = 0.5')
        self.write("rubs.toml", rubs + "".join(BETWEEN) + BETWEEN[2].replace("bed", "light").replace("restitution = 0.3", "friction = 0.1"))
        fine = ("run.duration=0.6", "engine.steps_per_contact=400")
        self.run_both("rubs.toml", *fine)
        soft, other = self.after("soft", 6), self.after("lammps", 6)
        lever = math.dist(soft, other)
        self.assertLess(lever, 0.2)
        self.write("rubs.toml", rubs + "".join(BETWEEN))
        self.run_both("rubs.toml", *fine)
        self.assertGreater(math.dist(soft, self.after("soft", 6)), 5 * lever)
        # more sizes than types, by material
        self.write("many.toml", scene[:scene.index("[[wall]]")] + scene[scene.index("[bed]"):].replace("mean = 1.0", "mean = 1.0, std = 0.02")
                   + "".join(BETWEEN))
        self.run_both("many.toml", "grains.count=600", "domain.size=[20,15]", "run.duration=0.1")
        soft, other = self.after("soft", 1), self.after("lammps", 1)
        self.assertLess(max(abs(a - b) for a, b in zip(soft, other)), 1e-9)
        # nothing between them is their own: as one material
        plain = FLOW.replace("[grains]", '[[material]]\nname = "a"\nshare = 1\n[grains]')
        self.write("plain.toml", plain)
        self.call("export", "plain.toml", "--lammps", "plain", "--quiet")
        with open(self.path("plain", "in.lammps"), encoding="utf-8") as file:
            self.assertIn("pair_style gran/hooke", file.read())

    @unittest.skipUnless(THERE, "lmp")
    def test_walls_that_move(self):
        """One that pushes steadily is the same to the last digits, one that shakes as the step shrinks."""
        scene = TWO.replace("gravity = 0", "gravity = 1").replace('kind = "none"', 'kind = "none"\n[[wall]]\npoint = [0, 1.4]\nnormal = [0, 1]\nMOTION')
        grains(self.path("two.vtk"), OBLIQUE)
        apart = {}
        for name, motion, steps in (("steady", "velocity = [0.3, 0.5]", 50), ("shakes", "oscillation = { amplitude = 0.1, frequency = 2 }", 50),
                                    ("shakes", "oscillation = { amplitude = 0.1, frequency = 2 }", 800)):
            self.write("two.toml", scene.replace("MOTION", motion))
            self.run_both("two.toml", "engine.steps_per_contact=%d" % steps, "run.duration=0.5")
            soft, other = self.after("soft", 5), self.after("lammps", 5)
            apart[name, steps] = max(abs(a - b) for a, b in zip(soft, other))
        self.assertLess(apart["steady", 50], 1e-12)
        self.assertLess(apart["shakes", 50], 0.01)
        self.assertLess(apart["shakes", 800], apart["shakes", 50] / 10)

    @unittest.skipUnless(THERE, "lmp")
    def test_it_goes_on_where_it_stopped(self):
        self.write("flow.toml", FLOW)
        self.call("run", "flow.toml", "--set", "engine.method=lammps", "-o", "run", "--set", "run.duration=0.5", "--quiet")
        self.call("run", "run", "--resume", "--set", "run.duration=1", "--quiet")
        self.run_both("flow.toml")
        series, whole = table(self.path("run", "series.csv")), table(self.path("soft", "series.csv"))
        self.assertEqual(len(series["x"]), len(whole["x"]))
        self.assertAlmostEqual(float(series["x"][-1]), float(whole["x"][-1]), delta=1e-3)
        self.assertEqual([name for name in os.listdir(self.path("tmp")) if name.startswith("chute-")], [])

    def at_work(self):
        """Command lines of the processes that work in the folder for temporary files: LAMMPS, its ranks and mpirun."""
        there = {}
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                if os.readlink("/proc/%s/cwd" % pid).startswith(os.path.realpath(self.path("tmp"))):
                    with open("/proc/%s/cmdline" % pid, encoding="utf-8") as file:
                        there[int(pid)] = file.read().split("\0")[0]
            except OSError:  # ended meanwhile, or another user's
                pass
        return there

    def within(self, seconds, is_so):
        end = time.monotonic() + seconds
        while not is_so() and time.monotonic() < end:
            time.sleep(0.05)
        return is_so()

    @unittest.skipUnless(THERE and shutil.which("mpirun"), "lmp and mpirun")
    def test_nothing_that_it_started_outlives_it(self):
        """Killed while LAMMPS is at steps that do not end: it is halted, as nothing else is sure to take long. Asked to end, chute
        ends it in order."""
        self.write("flow.toml", FLOW)
        around = dict(os.environ, TMPDIR=self.path("tmp"))
        self.addCleanup(lambda: [os.kill(pid, signal.SIGKILL) for pid in self.at_work()])
        for how, ranks in ((signal.SIGKILL, 1), (signal.SIGKILL, 2), (signal.SIGTERM, 1), (signal.SIGINT, 2)):
            run = subprocess.Popen([chute, "run", "flow.toml", "--set", "engine.method=lammps", "--set", "run.duration=2e5",
                                    "--set", "output={series={every=1e5}}", "--ranks", str(ranks), "-o", "run", "--force", "--quiet"],
                                   cwd=self.folder, env=around, stderr=subprocess.DEVNULL)

            def lmps():
                return [pid for pid, word in self.at_work().items() if os.path.basename(word) == "lmp"]
            self.assertTrue(self.within(60, lambda: len(lmps()) == ranks), self.at_work())
            self.assertTrue(self.within(60, lambda: os.path.exists(self.path("run", "checkpoint"))))
            self.assertIsNone(run.poll())
            if how == signal.SIGKILL:
                for pid in lmps():
                    os.kill(pid, signal.SIGSTOP)
            run.send_signal(how)
            run.wait()
            self.assertTrue(self.within(5, lambda: not self.at_work()), (how, ranks, self.at_work()))

    def test_what_it_has_not_is_refused_in_a_line(self):
        self.write("flow.toml", FLOW)

        def line(*words, **how):
            said = self.call(*words, status=2, **how).stderr
            self.assertEqual(said.count("\n"), 1, said)
            return said
        out = ("--lammps", "deck")
        self.write("gear.toml", FLOW.replace('"verlet"', '"gear5"'))
        self.assertIn('gear.toml:22: engine.integrator: "gear5" is no integrator of LAMMPS', line("export", "gear.toml", *out))
        self.write("gear.toml", FLOW.replace('integrator = "verlet"', ""))
        self.assertIn('"gear5", the default,', line("export", "gear.toml", *out))
        self.write("law.toml", FLOW.replace('law = "coulomb-viscous"\nviscosity = 50', 'law = "coulomb"')
                   .replace('friction = 0.5\nmass_scaling = "damping"', "friction = 0.5"))
        self.assertIn('law.toml:17: contact.tangential.law: "coulomb": LAMMPS has no such law', line("export", "law.toml", *out))
        self.assertIn("LAMMPS moves soft grains", line("export", "flow.toml", "--set", "engine.method=event", *out))
        self.assertIn("knows only planes", line("export", "flow.toml", "--set", "wall=[{from=[0,9],to=[5,9]}]", *out))
        self.assertIn("--ranks", line("run", "flow.toml", "--ranks", 2))
        self.assertIn("has LAMMPS run there", line("import", self.exported()))
        self.assertFalse(os.path.exists(self.path("deck")))
        self.write("impacts.toml", FLOW + "impacts = { from = 0 }\n")
        said = self.call("export", "impacts.toml", "--lammps", "impacts", "--quiet").stderr
        self.assertEqual(said, "export: output.impacts is left out: LAMMPS tells of no impacts\n")
        said = line("run", "flow.toml", "--set", "engine.method=lammps", "-o", "run", path=self.folder)
        self.assertIn('"lammps" needs the program lmp, Debian\'s package lammps: apt-get install lammps', said)
        self.assertFalse(os.path.exists(self.path("run")))

    @unittest.skipUnless(THERE and shutil.which("mpirun"), "lmp and mpirun")
    def test_more_processes_than_start_are_refused(self):
        self.write("flow.toml", FLOW)
        said = self.call("run", "flow.toml", "--set", "engine.method=lammps", "-o", "run", "--ranks", 99999, status=2).stderr
        self.assertIn("--ranks 99999: at most", said)
        self.assertFalse(os.path.exists(self.path("run")))

    @unittest.skipUnless(THERE, "lmp")
    def test_a_bad_dump_in_the_middle_costs_nothing(self):
        self.write("flow.toml", FLOW)
        folder = self.path(self.exported())
        subprocess.run(["lmp", "-in", "in.lammps"], cwd=folder, capture_output=True, check=True)
        self.call("import", "there", "-o", "run", "--quiet")
        before = table(self.path("run", "series.csv"))
        for kind in ("contacts", "dumps"):
            middle = os.path.join(folder, kind, sorted(os.listdir(os.path.join(folder, kind)))[2])
            whole = self.text_of(middle)
            self.spoilt(folder, middle, before)
            self.write(middle, whole)

    def text_of(self, path):
        with open(path, encoding="utf-8") as file:
            return file.read()

    def spoilt(self, folder, middle, before):
        lines = self.text_of(middle).splitlines()
        last = lines[-1].split()
        for wrong, what in ((lines[:-3], "cut short"), (lines[:-1] + [" ".join([last[0], "nan", *last[2:]])], "a value is no number")):
            with open(middle, "w", encoding="utf-8") as file:
                file.write("\n".join(wrong) + "\n")
            for words in (("-o", "run", "--force"), ()):
                said = self.call("import", "there", *words, status=2).stderr
                self.assertIn(what, said)
                self.assertEqual(said.count("\n"), 1, said)
            self.assertEqual(table(self.path("run", "series.csv")), before)
            self.assertFalse(os.path.exists(os.path.join(folder, "run")))

    def exported(self):
        self.call("export", "flow.toml", "--lammps", "there", "--quiet")
        return "there"


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 0 if THERE else 77)
