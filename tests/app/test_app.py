"""The chute program as a user meets it: test_app.py CHUTE SOURCES. Exit status, the one line that it says,
and what it leaves behind."""
import json
import os
import re
import resource
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest

from tiny_scene import TINY

chute, sources = sys.argv[1:3]
DONE, FAILED, WRONG = 0, 1, 2

def verbs():
    """The verbs that this program has, from its own help."""
    text = subprocess.run([chute, "--help"], capture_output=True, text=True).stdout
    listed = text.split("Subcommands:")[1] if "Subcommands:" in text else text.split("SUBCOMMANDS:")[1]
    return re.findall(r"^  (\w+)", listed, re.MULTILINE)


class App(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.scene = self.write("tiny.toml", TINY)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "wb" if isinstance(text, bytes) else "w") as file:
            file.write(text)
        return self.path(name)

    def tree(self):
        found = {}
        for at, folders, names in os.walk(self.folder):
            for name in names:
                with open(os.path.join(at, name), "rb") as file:
                    found[os.path.relpath(os.path.join(at, name), self.folder)] = file.read()
            for name in folders:
                found[os.path.relpath(os.path.join(at, name), self.folder) + "/"] = None
        return found

    def run_chute(self, *arguments, **options):
        return subprocess.run([chute, *arguments], capture_output=True, text=True, cwd=self.folder,
                              timeout=60, **options)

    def refused(self, *arguments, status=WRONG, **options):
        """The one line that the program says, with nothing else said and nothing left behind."""
        before = self.tree()
        done = self.run_chute(*arguments, **options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"\Achute: [^\n]+\n\Z")
        self.assertEqual(self.tree(), before, "something was left behind")
        return done.stderr[len("chute: "):-1]

    def changed(self, old, new):
        self.assertEqual(TINY.count(old), 1, old)
        return self.write("changed.toml", TINY.replace(old, new))


class BadScenes(App):
    CASES = [
        ("restitution = 0.6", "resitution = 0.6",
         r":14: contact\.normal\.resitution: unknown key, did you mean restitution\?"),
        ("angle = \"18 deg\"", "angle = 18", r":5: incline\.angle: 18 is not a text in quotes"),
        ("count = 8", "count = \"eight\"", r":9: grains\.count: 'eight' is not a whole number"),
        ("mean = 1.0", "mean = -1.0", r":10: grains\.diameter\.mean: -1 is not allowed, must be > 0"),
        ("restitution = 0.6", "restitution = 1.5",
         r":14: contact\.normal\.restitution: 1\.5 is not allowed, must be in \(0, 1\]"),
        ("friction = 0.5\n", "", r":15: contact\.tangential\.friction: missing, but required"),
        ("[bed]", "[bed", r":6: not TOML: "),
        ("count = 6", "count = 6\ncount = 7", r":8: not TOML: "),
    ]

    def test_run_and_check_refuse_them_with_file_and_line(self):
        for old, new, says in self.CASES:
            scene = self.changed(old, new)
            for arguments in (["run", scene, "-o", self.path("out")], ["check", scene]):
                with self.subTest(new=new, verb=arguments[0]):
                    self.assertRegex(self.refused(*arguments), r"\A" + re.escape(scene) + says)

    def test_missing_files_and_folders(self):
        self.assertIn("none.toml: cannot read: No such file", self.refused("run", "none.toml"))
        self.assertIn("none.toml: cannot read: No such file", self.refused("check", "none.toml"))
        self.assertIn(": is a directory, not a file", self.refused("check", self.folder))

    def test_bytes_that_are_no_text(self):
        self.assertIn(":1: not TOML", self.refused("check", self.write("noise.toml", bytes(range(128, 256)))))

    def test_settings(self):
        for setting, says in (("grains.count", "--set grains.count: expected key=value"),
                              ("grains.count=-1", "--set grains.count: grains.count: -1 is not allowed"),
                              ("grains.cuont=1", "did you mean count?"),
                              ("incline.angle=steep", "\"steep\" is not an angle")):
            with self.subTest(setting=setting):
                self.assertIn(says, self.refused("run", self.scene, "-o", self.path("out"), "--set", setting))

    def test_every_key_has_a_set_of_its_own(self):
        out = self.path("out")
        says = self.refused("run", self.scene, "-o", out, "--set", "grains.count=3", "seed=2")
        self.assertIn("seed=2: each key needs its own --set: --set grains.count=3 --set seed=2", says)
        for verb in (["run"], ["check"], ["sweep"]):
            help_text = self.run_chute(*verb, "--help").stdout
            self.assertIn("--set KEY=VALUE  ", help_text)
        # a scene may stand behind a setting, and settings may come one by one
        done = self.run_chute("check", "--set", "grains.count=3", "--set", "seed=2", self.scene)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("count = 3\n", done.stdout)

    def test_a_shorter_demo_has_frames_from_the_start(self):
        out = self.path("demo")
        done = self.run_chute("run", os.path.join(sources, "scenes", "demo.toml"), "-o", out, "--quiet", "--set", "run.duration=0.5")
        self.assertEqual((done.returncode, done.stderr), (DONE, ""))
        self.assertEqual(sorted(os.listdir(os.path.join(out, "frames"))), ["%06d.vtp" % k for k in range(6)])

    def test_grains_that_do_not_fit_leave_no_folder(self):
        says = self.refused("run", self.scene, "-o", self.path("out"), "--set", "grains.start.spacing=0.1")
        self.assertIn("spacing", says)


class BadCommands(App):
    def test_words_that_are_no_verb_or_option(self):
        for arguments in ([], ["frobnicate"], ["run"], ["check"], ["run", self.scene, "--bogus"],
                          ["run", self.scene, "-o", self.path("out"), "--threads", "0"],
                          ["run", self.scene, "-o", self.path("out"), "--threads", "many"],
                          ["run", self.scene, "-o", self.path("out"), "--resume", "--force"]):
            with self.subTest(arguments=arguments):
                self.refused(*arguments)
        self.assertIn("sweeep: no such verb, did you mean sweep?", self.refused("sweeep", self.scene))

    def test_info_of_what_is_no_run(self):
        self.assertIn("none", self.refused("info", self.path("none")))
        self.assertIn("not a run directory", self.refused("info", self.folder))
        self.refused("info", self.scene)


class Help(App):
    def test_every_verb_has_help_with_an_example(self):
        found = verbs()
        self.assertLessEqual({"run", "check", "info"}, set(found))
        for verb in found:
            with self.subTest(verb=verb):
                done = self.run_chute(verb, "--help")
                self.assertEqual(done.returncode, DONE)
                self.assertEqual(done.stderr, "")
                self.assertRegex(done.stdout, r"Example: chute " + verb)

    def test_the_readme_has_the_keys(self):
        keys = self.run_chute("check", "--keys").stdout.strip()
        self.assertGreater(len(keys), 5000)
        with open(os.path.join(sources, "README.md"), encoding="utf-8") as readme:
            self.assertIn(keys, readme.read(), "put what `chute check --keys` prints at the end of README.md")

    def test_version(self):
        done = self.run_chute("--version")
        self.assertEqual(done.returncode, DONE)
        self.assertRegex(done.stdout, r"\Achute \d+\.\d+\.\d+ \([^)]+\)\n\Z")


class Disk(App):
    def test_a_folder_that_cannot_be_made(self):
        file = self.write("file", "")
        says = self.refused("run", self.scene, "-o", os.path.join(file, "out"), status=FAILED)
        self.assertIn("cannot write: Not a directory", says)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_that_may_not_be_written(self):
        os.mkdir(self.path("locked"))
        os.chmod(self.path("locked"), stat.S_IRUSR | stat.S_IXUSR)
        self.addCleanup(os.chmod, self.path("locked"), stat.S_IRWXU)
        for out in (self.path("locked"), self.path("locked", "out")):
            says = self.refused("run", self.scene, "-o", out, status=FAILED)
            self.assertIn("cannot write: Permission denied", says)

    def test_a_full_disk(self):
        """No file may grow beyond 6 kB: the run starts and fails at some file, none of them half-written."""
        def small_disk():
            resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))

        scene = self.changed("count = 8", "count = 100")
        done = self.run_chute("run", scene, "-o", self.path("out"), "--quiet", preexec_fn=small_disk,
                              restore_signals=False)
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertRegex(done.stderr, r"\Achute: [^\n]+: cannot write: File too large\n\Z")
        left = self.tree()
        for name, content in left.items():
            self.assertFalse(os.path.basename(name).startswith("."), name + " was left behind")
            if content is not None and name.endswith(".vtp"):
                self.assertTrue(content.endswith(b"</VTKFile>\n"), name + " is half a file")


class Runs(App):
    def go(self, *arguments):
        return self.run_chute("run", self.scene, "-o", self.path("out"), *arguments)

    def results(self):
        return {name: text for name, text in self.tree().items()
                if name.startswith("out/") and name not in ("out/", "out/run.json", "out/checkpoint")}

    def test_a_run_and_its_replacement(self):
        done = self.go()
        self.assertEqual((done.returncode, done.stdout), (DONE, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Arun: \d+ steps in ")
        whole = self.results()
        self.assertEqual(set(whole), {"out/scene.toml", "out/series.csv", "out/frames.pvd", "out/frames/"} |
                         {"out/frames/%06d.vtp" % k for k in range(5)})
        with open(self.path("out", "run.json")) as file:
            facts = json.load(file)
        self.assertEqual((facts["end"], facts["seed"]), ("finished", 1))
        self.assertIn("tiny.toml", facts["command"])
        self.assertIn("a run is already there", self.refused("run", self.scene, "-o", self.path("out")))
        self.assertEqual(self.go("--force", "--threads", "2", "--quiet").stderr, "")
        self.assertEqual(self.results(), whole)
        self.assertEqual(self.go("--resume").returncode, DONE)
        self.assertEqual(self.results(), whole)
        self.assertIn("belongs to another scene",
                      self.refused("run", self.scene, "-o", self.path("out"), "--resume", "--set", "seed=2"))

    def test_the_resolved_scene_runs_to_the_same_bytes(self):
        self.go("--quiet", "--set", "seed=5")
        whole = self.results()
        self.run_chute("run", self.path("out", "scene.toml"), "-o", self.path("again"), "--quiet")
        again = self.tree()
        for name, text in whole.items():
            self.assertEqual(again[name.replace("out/", "again/")], text, name)

    def test_other_peoples_folders_are_not_touched(self):
        os.mkdir(self.path("home"))
        self.write("home/thesis.txt", "years of work")
        for flags in ([], ["--force"], ["--resume"]):
            says = self.refused("run", self.scene, "-o", self.path("home"), *flags)
            self.assertIn("holds files that are not a run", says)

    def wait_for(self, path):
        """Until the file is there, but no longer than a loaded machine takes."""
        for _ in range(6000):
            if os.path.exists(path):
                return
            time.sleep(0.01)

    def wait_for_handler(self, process):
        """Until the program catches SIGINT: before that, a signal ends it as it ends any other."""
        for _ in range(3000):
            try:
                status = open(f"/proc/{process.pid}/status").read()
            except FileNotFoundError:
                return
            caught = [int(line.split()[1], 16) for line in status.splitlines() if line.startswith("SigCgt")]
            if process.poll() is not None or not caught or caught[0] >> (signal.SIGINT - 1) & 1:
                return
            time.sleep(0.01)

    def test_a_stopped_run_goes_on(self):
        """Stopped by a signal, or killed outright, and resumed: the bytes of a run that nobody disturbed."""
        long = ["--quiet", "--set", "run.duration=400", "--set", "output.frames.every=50", "--set",
                "output.checkpoint=10"]
        self.assertEqual(self.go(*long).returncode, DONE)
        whole = self.results()
        shutil.rmtree(self.path("out"))
        for how in (signal.SIGTERM, signal.SIGKILL, signal.SIGINT, None):
            flags = ["--resume"] if os.path.exists(self.path("out", "checkpoint")) else ["--force"]
            run = subprocess.Popen([chute, "run", self.scene, "-o", self.path("out"), *long, *flags],
                                   stderr=subprocess.PIPE, text=True)
            if how is None:
                self.assertEqual(run.communicate()[1], "")
                break
            self.wait_for(self.path("out", "run.json"))  # before it, a signal ends it with nothing written
            self.wait_for_handler(run)
            time.sleep(0.3)
            run.send_signal(how)
            said = run.communicate(timeout=60)[1]
            if run.returncode == DONE:
                continue  # it was faster than the signal
            if how != signal.SIGKILL:
                self.assertEqual(run.returncode, FAILED)
                self.assertRegex(said, r"\Achute: stopped; go on with: chute run [^\n]+ --resume\n\Z")
        left = self.results().items()  # a kill may leave a file that was being written, under a hidden name
        self.assertEqual({k: v for k, v in left if not os.path.basename(k).startswith(".")}, whole)

    def test_leaving_physics(self):
        done = self.go("--quiet", "--set", "contact.normal.stiffness=10", "--set",
                       "contact.tangential.viscosity=1")
        self.assertEqual(done.returncode, FAILED)
        self.assertRegex(done.stderr,
                         r"\Achute: the run left physics at t = [\d.]+ \(step \d+\): grain \d+: [^\n]+\n\Z")
        with open(self.path("out", "run.json")) as file:
            self.assertEqual(json.load(file)["end"], "left physics")
        self.assertTrue(os.path.exists(self.path("out", "checkpoint")))


class Check(App):
    def test_it_prints_the_complete_scene_and_what_follows(self):
        done = self.run_chute("check", self.scene)
        self.assertEqual((done.returncode, done.stderr), (DONE, ""))
        for key in ("[incline]", "stiffness = 10000.0", "steps_per_contact = 50.0", "# t_n ", "# dt ",
                    "# gamma_n ", "# gamma_max ", "# v_bf ", "# cost "):
            self.assertIn(key, done.stdout)
        # complete: what it prints is a scene that resolves to itself
        resolved = self.write("resolved.toml", done.stdout)
        again = self.run_chute("check", resolved)
        self.assertEqual(again.stdout.replace("resolved.toml", "tiny.toml"), done.stdout)

    def test_every_scene_of_the_collection_is_valid(self):
        folder = os.path.join(sources, "scenes")
        checked = 0
        for name in sorted(os.listdir(folder)):
            if not name.endswith(".toml"):
                continue
            with open(os.path.join(folder, name)) as file:
                if re.search(r"^\[\[?data", file.read(), re.MULTILINE):
                    continue  # recipes are no scenes
            done = self.run_chute("check", os.path.join(folder, name))
            self.assertEqual((done.returncode, done.stderr), (DONE, ""), name)
            checked += 1
        self.assertGreater(checked, 7)


class Experiments(App):
    def test_an_experiment_prints_and_leaves_its_results(self):
        scene = os.path.join(sources, "scenes", "impact-oblique.toml")
        done = self.run_chute("run", scene, "-o", "impact", "--set", "experiment.psi=0.5")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^psi_i +0\.5 ")
        with open(self.path("impact", "result.csv")) as file:
            values = dict(line.strip().split(",")[::2] for line in file if "," in line and line[0] != "#")
        self.assertAlmostEqual(float(values["psi_f"]), -0.5, delta=0.1)  # k_s/k_n = 2/7 turns the slip round
        with open(self.path("impact", "run.json")) as file:
            self.assertEqual(json.load(file)["end"], "finished")

    def test_slips_are_answered_with_line_and_key(self):
        with open(os.path.join(sources, "scenes", "column.toml")) as file:
            slip = self.write("slip.toml", file.read().replace("gap_time", "gap_tme"))
        said = self.refused("run", slip, "-o", self.path("out"))
        self.assertIn("slip.toml:8: experiment.gap_tme: unknown key, did you mean gap_time?", said)


class Info(App):
    def setUp(self):
        super().setUp()
        done = self.run_chute("run", self.scene, "-o", self.path("out"), "--quiet")
        self.assertEqual(done.returncode, DONE, done.stderr)

    def test_a_run_is_told(self):
        done = self.run_chute("info", self.path("out"))
        self.assertEqual((done.returncode, done.stderr), (DONE, ""))
        self.assertIn("finished", done.stdout)

    def test_damaged_vtk(self):
        """A frame that is cut or is no VTK at all, given to whatever reads one."""
        frame = self.path("out", "frames", "000001.vtp")
        with open(frame, "rb") as file:
            whole = file.read()
        readers = [["info"]] + ([["render", "-o", self.path("pictures")]] if "render" in verbs() else [])
        for content in (whole[:len(whole) // 2], whole[:100], b"", b"not VTK\n"):
            broken = self.write("broken.vtp", content)
            for verb, *options in readers:
                with self.subTest(verb=verb, size=len(content)):
                    self.assertIn("broken.vtp", self.refused(verb, broken, *options))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=0)
