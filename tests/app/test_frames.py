"""Frames as files of other programs, and measured as a run measures its own: test_frames.py CHUTE."""
import csv
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

chute = os.path.abspath(sys.argv[1])
FLAT = """title = "discs"
seed = 3
[incline]
angle = "20 deg"
[bed]
count = 20
[grains]
count = 60
diameter = { mean = 1, std = 0.05 }
start = { velocity = 2, spread = 1 }
[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
restitution = 0.6
[contact.tangential]
law = "coulomb-viscous"
viscosity = 40
friction = 0.5
[run]
duration = 6
[output]
contacts = true
frames = { every = 0.5 }
series = { every = 0.5 }
profiles = { from = 1, every = 0.5, fine = 0.25 }
fields = { from = 1, every = 0.5 }
forces = { from = 1, every = 0.5 }
moments = { from = 1, every = 0.5 }
heights = { from = 1, every = 0.5 }
"""
SPACE = FLAT.replace("[incline]", "dimensions = 3\n[incline]").replace("duration = 6", "duration = 3") \
    .replace("[bed]\ncount = 20", '[bed]\nkind = "lattice"\ncount = 8\ncount_across = 8')
MEASURED = ("profiles.csv", "fields.csv", "forces.csv", "moments.csv", "heights.csv")


def table(path):
    """Columns of a table of chute's, as texts."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name, scene in (("flat", FLAT), ("space", SPACE)):
            with open(os.path.join(cls.folder, name + ".toml"), "w", encoding="utf-8") as file:
                file.write(scene)
            cls.call(None, "run", name + ".toml", "-o", name, "--quiet")

    def call(self, *words, status=0):
        done = subprocess.run([chute, *map(str, words)], capture_output=True, text=True, cwd=Frames.folder)
        assert done.returncode == status, (words, done.stdout, done.stderr)
        return done

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def new(self):
        return "out-%d" % len(os.listdir(self.folder))

    def test_a_runs_frames_give_its_own_tables(self):
        for run in ("flat", "space"):
            out = self.new()
            self.call("measure", run, "-o", out, "--from", 1, "--only", "profiles,fields,forces,moments,heights", "--set",
                      "profiles.fine=0.25")
            for name in MEASURED + ("profiles_fine.csv",):
                self.assertEqual(table(self.path(run, name)), table(self.path(out, name)), (run, name))
            out = self.new()
            self.call("measure", run, "-o", out, "--only", "series")
            own, measured = table(self.path(run, "series.csv")), table(self.path(out, "series.csv"))
            for name in ("time", "x", "v_x", "v_y", "omega", "contacts", "translation", "rotation", "gravity_work"):
                for a, b in zip(own[name], measured[name], strict=True):  # sums run over other orders of grains, at most
                    self.assertAlmostEqual(float(a), float(b), delta=1e-12 * max(1, abs(float(a))), msg=(run, name))
            # what frames cannot tell is empty, not 0
            for name in ("elastic", "normal_loss", "residual"):
                self.assertEqual(set(measured[name]), {""})

    def test_frames_of_other_programs(self):
        """What a dump holds is measured with the same numbers; what it lacks is told in a line, and empty."""
        for run in ("flat", "space"):
            for form in ("lammps-dump", "xyz"):
                frames, out = self.new(), None
                self.call("convert", run, "--to", form, "-o", frames)
                out = self.new()
                said = self.call("measure", frames, "-o", out, "--from", 1, "--bed", 0, "--only", "profiles").stderr
                self.assertIn("measure: no array normal_force: contacts are those whose surfaces overlap", said)
                own, measured = table(self.path(run, "profiles.csv")), table(self.path(out, "profiles.csv"))
                for name in own:
                    if name.startswith("contact_"):
                        continue
                    # a period is read as its ends' difference, so that the area may differ in its last digit
                    for a, b in zip(own[name], measured[name], strict=True):
                        self.assertEqual(a == "", b == "")
                        if a:
                            self.assertAlmostEqual(float(a), float(b), delta=1e-13 * max(1, abs(float(a))), msg=name)
                stressed = [b for a, b in zip(own["contact_xx"], measured["contact_xx"]) if a and float(a) != 0]
                self.assertEqual(set(stressed), {""}, run)
                # the networks that were found have as many contacts as the run's own
                for k in (2, 5):
                    name = "contacts/%06d.vtp"
                    found = self.call("info", os.path.join(out, name % (k - 2))).stdout.splitlines()
                    there = self.call("info", os.path.join(run, name % k)).stdout.splitlines()
                    self.assertEqual([line for line in found if "cells" in line], [line for line in there if "cells" in line])

    def test_files_are_taken_in_the_order_of_their_times(self):
        dumps, out, back = self.new(), None, None
        self.call("convert", "flat", "--to", "lammps-dump", "-o", dumps)
        files = sorted(os.listdir(self.path(dumps)), reverse=True)
        out = self.new()
        self.call("measure", *[os.path.join(dumps, name) for name in files], "-o", out, "--only", "moments", "--bed", 0)
        whole = table(self.path("flat", "moments.csv"))
        times = table(self.path(out, "moments.csv"))
        self.assertEqual(whole["temperature"], times["temperature"][2:])
        back = self.new()
        self.call("convert", *[os.path.join(dumps, name) for name in files], "--to", "vtp", "-o", back)
        with open(self.path(back, "frames.pvd"), encoding="utf-8") as file:
            told = [line.split('"')[1] for line in file if "timestep" in line]
        self.assertEqual(told, sorted(told, key=float))

    def test_there_and_back(self):
        """chute -> dump -> chute: profiles of what came back are those of the run."""
        dumps, back, out = self.new(), None, None
        self.call("convert", "space", "--to", "lammps-dump", "--one-file", "-o", dumps)
        back = self.new()
        self.call("convert", os.path.join(dumps, "frames.dump"), "--to", "vtp", "-o", back)
        out = self.new()
        self.call("measure", back, "-o", out, "--from", 1, "--only", "moments")
        self.assertEqual(table(self.path("space", "moments.csv")), table(self.path(out, "moments.csv")))
        self.call("render", back, "-o", self.new(), "--size", "160x120", "--frames", "2", "--jobs", "1", "--quiet")

    def test_what_is_wrong_is_one_line(self):
        def line(*words):
            said = self.call(*words, status=2).stderr
            self.assertEqual(said.count("\n"), 1, said)
            return said
        out = self.new()
        self.assertIn("--to vtk: not known, did you mean vtp?", line("convert", "flat", "--to", "vtk", "-o", out))
        self.assertIn("no such file", line("convert", "nowhere", "--to", "csv", "-o", out))
        self.assertIn("did you mean profiles?", line("measure", "flat", "-o", out, "--only", "profile"))
        self.assertIn("seen only while a run goes on", line("measure", "flat", "-o", out, "--only", "impacts"))
        self.assertIn("did you mean bin?", line("measure", "flat", "-o", out, "--set", "profiles.bn=1"))
        self.assertIn("--from and --until say which", line("measure", "flat", "-o", out, "--set", "profiles.every=1"))
        self.assertIn("no frame lies there", line("measure", "flat", "-o", out, "--from", 99))
        self.assertIn("needs a domain that repeats", line("measure", "flat", "-o", out, "--only", "pairs"))
        self.assertIn("is not empty", line("measure", "flat", "-o", "flat"))
        self.assertFalse(os.path.exists(self.path(out)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
