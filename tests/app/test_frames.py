"""Frames as files of other programs, and measured as a run measures its own: test_frames.py CHUTE."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from tiny_scene import LAWS, SIXTY, table

chute = os.path.abspath(sys.argv[1])
FLAT = 'title = "discs"\n' + SIXTY + LAWS + """[run]
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

    def test_a_mixtures_frames_give_its_own_tables(self):
        """Of species by chute's names; other programs' files have numbers, or words."""
        mixture = FLAT + """segregation = { from = 1, every = 0.5 }
[[material]]
name = "sand"
share = 0.5
[[material]]
name = "lead"
share = 0.5
density = 11
"""
        with open(self.path("mixture.toml"), "w", encoding="utf-8") as file:
            file.write(mixture)
        self.call("run", "mixture.toml", "-o", "mixture", "--set", "run.duration=3", "--quiet")
        out = self.new()
        self.call("measure", "mixture", "-o", out, "--from", 1, "--quiet")
        for name in ("segregation.csv", "species.csv"):
            own, measured = table(self.path("mixture", name)), table(self.path(out, name))
            self.assertGreater(len(own), 4)  # a run tells of the segregation from the start on
            self.assertEqual({column: values[-len(measured[column]):] for column, values in own.items()}, measured, name)
        dumps, of_types = self.new(), self.new() + "-types"
        self.call("convert", "mixture", "--to", "lammps-dump", "-o", dumps)
        named = self.new()
        self.call("measure", dumps, "-o", named, "--from", 1, "--bed", 0, "--quiet")
        self.assertEqual(table(self.path(named, "segregation.csv"))["index_lead"], table(self.path(out, "segregation.csv"))["index_lead"])
        for name in os.listdir(self.path(dumps)):  # types 1 and 2, and 0 of the bed, in place of the materials' arrays
            path = self.path(dumps, name)
            with open(path, encoding="utf-8") as file:
                text = file.read()
            head, rows = text.split("ITEM: ATOMS ")
            columns, *lines = rows.splitlines()
            names = columns.split()
            kept = [k for k, column in enumerate(names) if column not in ("material", "species")]
            changed = [" ".join(names[k] for k in kept)]
            for line in lines:
                words = dict(zip(names, line.split()))
                words["type"] = str(int(words["type"]) * (1 + int(words["material"])))
                changed.append(" ".join(words[names[k]] for k in kept))
            with open(path, "w", encoding="utf-8") as file:
                file.write(head + "ITEM: ATOMS " + "\n".join(changed) + "\n")
        self.call("measure", dumps, "-o", of_types, "--from", 1, "--bed", 0, "--quiet")
        own, measured = table(self.path("mixture", "segregation.csv")), table(self.path(of_types, "segregation.csv"))
        for mine, theirs in (("index_sand", "index_1"), ("height_lead", "height_2")):
            self.assertEqual(own[mine][-len(measured[theirs]):], measured[theirs])
        with open(self.path("nameless.dump"), "w", encoding="utf-8") as file:
            file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n0 9\n0 9\n0 9\n"
                       "ITEM: ATOMS id x y z radius\n1 1 1 1 0.5\n")
        said = self.call("measure", "nameless.dump", "-o", self.new(), "--only", "segregation", status=2).stderr
        self.assertIn("no array material, type or species, of which segregation tells", said)

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

    def test_a_bed_that_no_grain_is_of(self):
        dumps = self.new()
        self.call("convert", "flat", "--to", "lammps-dump", "-o", dumps)
        said = self.call("measure", dumps, "-o", self.new(), "--bed", "0,nope", status=2).stderr
        self.assertIn("no grain is of type nope, which --bed names; there are: 0, 1", said)

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

    def test_any_number_of_jobs_writes_the_same_files(self):
        made = []
        for jobs in (1, 3):
            out = self.new()
            self.call("convert", "space", "--to", "vtp", "-o", out, "--jobs", jobs, "--quiet")
            files = {}
            for at, _, names in os.walk(self.path(out)):
                for name in names:
                    with open(os.path.join(at, name), "rb") as file:
                        files[name] = file.read()
            made.append(files)
        self.assertEqual(len(made[0]), 8)
        self.assertEqual(made[0], made[1])
        # a file that cannot be read ends all
        shutil.copytree(self.path("flat"), self.path("broken"))
        with open(self.path("broken", "frames", "000009.vtp"), "r+b") as file:
            file.truncate(1000)
        said = self.call("convert", "broken", "--to", "csv", "-o", self.new(), "--jobs", 3, "--quiet", status=2).stderr
        self.assertIn("000009.vtp", said)

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

    def test_what_a_file_lacks_is_empty(self):
        with open(self.path("bare.xyz"), "w", encoding="utf-8") as file:
            for step in range(4):
                file.write("64\n\n" + "".join("A %g %g %g\n" % (i % 4 + 0.01 * step, i // 4 % 4, i // 16) for i in range(64)))
        out = self.new()
        said = self.call("measure", "bare.xyz", "--radius", 0.51, "-o", out).stderr
        for array in ("velocity", "angular_velocity", "mass", "normal_force"):
            self.assertIn("measure: no array %s: " % array, said)
        profile = table(self.path(out, "profiles.csv"))
        filled = [k for k, n in enumerate(profile["grains"]) if float(n) > 0]
        for name in profile:
            values = {profile[name][k] for k in filled}
            if name in ("h", "grains", "eta", "eta_err", "eta_exact", "eta_exact_err", "coordination", "coordination_err"):
                self.assertNotIn("", values, name)
            elif not name.endswith("_err"):
                self.assertEqual(values, {""}, name)
        # a cube of 4 by 4 by 4 that touches: 3 * 4 * 4 * 3 contacts
        self.assertEqual(set(table(self.path(out, "series.csv"))["contacts"]), {"144"})
        self.assertFalse(os.path.exists(self.path(out, "moments.csv")))
        said = self.call("measure", "bare.xyz", "--radius", 0.51, "-o", self.new(), "--only", "moments", status=2).stderr
        self.assertIn("bare.xyz: no array velocity, of which moments tells", said)

    def test_times_are_those_of_the_files(self):
        def xyz(name, times):
            with open(self.path(name), "w", encoding="utf-8") as file:
                for time in times:
                    file.write("2\nProperties=species:S:1:pos:R:3 Time=%s\nA 0 0 0\nA 3 1 2\n" % time)
            return name
        for name, times in (("one.xyz", [0.3]), ("two.xyz", [0.3, 1.3]), ("uneven.xyz", [0, 0.1, 0.35, 2])):
            out = self.new()
            self.call("measure", xyz(name, times), "--diameter", 1, "-o", out, "--only", "series")
            told = [float(t) for t in table(self.path(out, "series.csv"))["time"]]
            self.assertEqual(len(told), len(times))
            for a, b in zip(told, times):
                self.assertAlmostEqual(a, b, delta=1e-12)
        said = self.call("measure", xyz("far.xyz", [0, 1e-300, 1]), "--diameter", 1, "-o", self.new(), status=2).stderr
        self.assertIn("that can be counted", said)

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

    def test_what_fails_on_its_way_leaves_nothing(self):
        """The first frame is good, a later one is not: what was written goes again, and what was there stays."""
        good = "2\n%s\nA 0 0 0 .5\nA 0.9 0 0 .5\n"
        header = 'Lattice="8 0 0 0 8 0 0 0 8" Properties=species:S:1:pos:R:3:radius:R:1 Time=%d'
        os.mkdir(self.path("later"))
        os.mkdir(self.path("empty"))
        for k, text in enumerate((good % (header % 0), "2\nProperties=species:S:1:pos:R:3 Time=1\nA 0 0 0\nA 1 0 0\n")):
            with open(self.path("later", "%d.xyz" % k), "w", encoding="utf-8") as file:
                file.write(text)
        made = os.path.join("made", "for", "it")
        for words in (("measure",), ("convert", "--to", "csv"), ("convert", "--to", "vtp", "--jobs", 1),
                      ("convert", "--to", "xyz", "--one-file")):
            for out in (made, "empty"):
                said = self.call(words[0], "later", *words[1:], "-o", out, status=2).stderr
                self.assertIn("later/1.xyz: no array of radii", said)
                self.assertEqual(said.count("\n"), 1, said)
                self.assertFalse(os.path.exists(self.path("made")))
                self.assertEqual(os.listdir(self.path("empty")), [])
        for words in (("convert", "flat", "--to", "csv", "-o"), ("measure", "flat", "-o"), ("export", "flat", "--lammps")):
            self.assertIn("is a file; name a new folder", self.call(*words, "flat.toml", status=2).stderr)
            self.assertIn("its name is empty", self.call(*words, "", status=2).stderr)

    def test_what_a_killed_one_left_is_taken_over(self):
        """Killed at its second frame, which is a pipe that nobody writes into; not while it lives, nor what others put there."""
        text = "2\n" + 'Lattice="8 0 0 0 8 0 0 0 8" Properties=species:S:1:pos:R:3:radius:R:1 Time=%d' + "\nA 0 0 0 .5\nA 0.9 0 0 .5\n"
        os.mkdir(self.path("halts"))
        with open(self.path("halts", "0.xyz"), "w", encoding="utf-8") as file:
            file.write(text % 0)
        os.mkfifo(self.path("halts", "1.xyz"))
        sources = [os.path.join("halts", "%d.xyz" % k) for k in (0, 1)]
        for words in (("--to", "csv"), ("--to", "vtp", "--jobs", 1), ("--to", "xyz", "--one-file")):
            out = self.new()
            killed = subprocess.Popen([chute, "convert", *sources, *map(str, words), "-o", out], cwd=self.folder,
                                      stderr=subprocess.DEVNULL)
            for _ in range(1000):
                if os.path.isdir(self.path(out)) and os.listdir(self.path(out)):
                    break
                time.sleep(0.01)
            whole = ("convert", "flat", *words, "-o", out)
            self.assertIn("in use by process", self.call(*whole, status=1).stderr)
            killed.kill()
            killed.wait()
            time.sleep(0.1)
            self.assertNotEqual(os.listdir(self.path(out)), [])
            with open(self.path(out, "notes.txt"), "w", encoding="utf-8") as file:
                file.write("years of work")
            self.assertIn("is not empty", self.call(*whole, status=2).stderr)
            os.remove(self.path(out, "notes.txt"))
            again = self.new()
            self.call(*whole)
            self.call(*whole[:-1], again)
            self.assertEqual(sorted(os.listdir(self.path(out))), sorted(os.listdir(self.path(again))))
            self.assertIn("is not empty", self.call(*whole, status=2).stderr)  # a whole one is nobody's to take

    def test_asked_to_stop_it_does_not_blame_a_file(self):
        """A terminal's Ctrl-C reaches the processes that read, too; one of these waits at a pipe that nobody writes into."""
        os.mkfifo(self.path("1.xyz"))
        with open(self.path("0.xyz"), "w", encoding="utf-8") as file:
            file.write("1\nProperties=species:S:1:pos:R:3:radius:R:1\nA 0 0 0 .5\n")
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            out = self.new()
            converts = subprocess.Popen([chute, "convert", "0.xyz", "1.xyz", "--to", "csv", "--jobs", "2", "-o", out], cwd=self.folder,
                                        stderr=subprocess.PIPE, text=True, start_new_session=True)
            for _ in range(1000):
                if os.path.isdir(self.path(out)) and "000000.csv" in os.listdir(self.path(out)):
                    break
                time.sleep(0.01)
            time.sleep(0.2)
            os.killpg(converts.pid, how)
            said = converts.communicate(timeout=20)[1]
            self.assertEqual((converts.returncode, said), (1, "chute: stopped\n"))
            self.assertFalse(os.path.exists(self.path(out)))

    def test_numbers_beyond_all_bounds_are_refused(self):
        frame = "2\nProperties=species:S:1:pos:R:3:radius:R:1\nA 0 0 0 .5\nA %s 3 3 .5\n"
        with open(self.path("far.xyz"), "w", encoding="utf-8") as file:
            file.write(frame % "1e5")
        for gap in ("nan", "inf", "1.5", "-1"):
            self.assertIn("must be from 0 to the largest diameter, 1:", self.call("measure", "far.xyz", "-o", "beyond", "--gap", gap, status=2).stderr)
        said = self.call("measure", "far.xyz", "-o", "beyond", "--only", "cells", "--set", "cells.width=0.01", status=2).stderr
        self.assertIn("output.cells.width: ", said)
        box = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 4\n4 0\n0 4\n"
               "ITEM: ATOMS id type x y z radius\n1 1 1 1 1 0.5\n")
        with open(self.path("backwards.dump"), "w", encoding="utf-8") as file:
            file.write(box)
        said = self.call("measure", "backwards.dump", "-o", "beyond", status=2).stderr
        self.assertIn("backwards.dump:7: an edge of the box ends before it begins", said)
        self.assertFalse(os.path.exists(self.path("beyond")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
