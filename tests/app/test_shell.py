"""Habits of the shell: test_shell.py CHUTE. Standard input in place of a file, --json for programs, a bar only on a terminal."""
import json
import os
import pty
import shutil
import subprocess
import sys
import tempfile
import unittest

from tiny_scene import TINY

chute = sys.argv[1]


class Shell(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def run_chute(self, *arguments, given=None, status=0):
        done = subprocess.run([chute, *arguments], capture_output=True, text=True, cwd=self.folder, input=given)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def read(self, *names):
        with open(os.path.join(self.folder, *names), "rb") as file:
            return file.read()

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)

    def test_a_scene_from_standard_input_is_the_same_run(self):
        self.write("tiny.toml", TINY)
        self.run_chute("run", "tiny.toml", "-o", "file", "--quiet")
        self.run_chute("run", "-", "-o", "pipe", "--quiet", given=TINY)
        for name in ("scene.toml", "frames/000004.vtp"):
            self.assertEqual(self.read("file", name), self.read("pipe", name))
        self.assertIn("out/standard-input", self.run_chute("run", "-", given=TINY).stderr)
        wrong = self.run_chute("run", "-", given=TINY.replace("count = 8", "cuont = 8"), status=2)
        self.assertIn("standard-input:9: grains.cuont: unknown key, did you mean count?", wrong.stderr)

    def test_a_recipe_from_standard_input(self):
        self.write("mine.csv", "series,x,y\na,0,1\na,1,2\n")
        recipe = 'title = "Mine"\n[data]\ntable = "mine.csv"\n'
        self.write("mine.toml", recipe)
        self.run_chute("figure", "mine.toml", "-o", "file", "--quiet")
        self.run_chute("figure", "-", "-o", "pipe", "--quiet", given=recipe)
        self.assertEqual(self.read("file", "mine.csv"), self.read("pipe", "standard-input.csv"))
        self.assertGreater(len(self.read("pipe", "standard-input.svg")), 1000)

    def test_words_for_groups_of_figures(self):
        """Each figure belongs to one group besides all of them."""
        checked = lambda word: {line.split(": ")[0] for line in self.run_chute("figure", word, "--quick", "--check").stdout.splitlines()}
        groups = [checked(word) for word in ("thesis", "experiments", "methods", "beyond")]
        self.assertEqual(len(groups[0]), 62)  # 57 from data, four sketches and a table
        self.assertEqual(sum(map(len, groups)), len(set.union(*groups)))
        listed = self.run_chute("figure", "--list").stdout.split("\n")
        self.assertEqual({os.path.basename(name).removesuffix(".toml") for name in set.union(*groups)},
                         {line.split()[0] for line in listed if line.startswith(("fig-", "table-"))})
        # To look at all of them once more would take half a minute: the word is known.
        said = self.run_chute("figure", "all", "nonsense", status=2).stderr
        self.assertIn("nonsense", said)
        self.assertNotIn("all:", said)
        self.assertIn("did you mean thesis?", self.run_chute("figure", "thessis", status=2).stderr)

    def test_check_for_programs(self):
        self.write("tiny.toml", TINY)
        found = json.loads(self.run_chute("check", "--json", "tiny.toml", "-", given=TINY).stdout)
        self.assertEqual([scene["file"] for scene in found["scenes"]], ["tiny.toml", "standard-input"])
        scene = found["scenes"][0]
        self.assertEqual(set(scene), {"file", "scene", "facts", "chosen", "warnings"})
        self.assertEqual(scene["scene"]["grains"]["count"], 8)
        theta = [fact for fact in scene["facts"] if fact["name"] == "theta"]
        self.assertAlmostEqual(theta[0]["value"], 18)
        self.assertEqual(set(theta[0]), {"name", "value", "unit", "meaning"})

    def test_info_for_programs(self):
        self.run_chute("run", "-", "-o", "run", "--quiet", given=TINY + "series = { every = 0.5 }\n")
        run = json.loads(self.run_chute("info", "run", "--json").stdout)
        self.assertEqual((run["kind"], run["record"]["seed"]), ("run", 1))
        self.assertIn({"name": "series.csv", "bytes": len(self.read("run", "series.csv"))}, run["files"])
        frame = json.loads(self.run_chute("info", "run/frames/000000.vtp", "--json").stdout)
        self.assertEqual((frame["kind"], frame["points"], frame["texts"]["units"]), ("vtk", 14, "reduced"))
        arrays = {array["name"]: array for array in frame["arrays"]}
        self.assertEqual((arrays["velocity"]["components"], arrays["type"]["range"]), (3, [0, 1]))
        self.write("t.csv", "day;force\n2026-03-07;0,5\n2026-03-08;\n")
        table = json.loads(self.run_chute("info", "t.csv", "--json").stdout)
        self.assertEqual(table["columns"], [
            {"name": "day", "type": "time", "gaps": 0, "different": 2, "range": ["2026-03-07", "2026-03-08"]},
            {"name": "force", "type": "number", "gaps": 1, "different": 2, "range": [0.5, 0.5]}])
        self.assertIn("1 gap", self.run_chute("info", "t.csv").stdout)

    def test_compare_for_programs(self):
        self.run_chute("run", "-", "-o", "run", "--quiet", given=TINY)
        self.run_chute("render", "run", "-o", "pictures", "--size", "80x64", "--quiet")
        picture = os.path.join("pictures", "%06d.png")
        same = json.loads(self.run_chute("compare", picture % 0, picture % 0, "--json").stdout)
        self.assertEqual((same["different"], same["pictures"][0]["same"], same["pictures"][0]["rms"]), (0, True, 0))
        other = json.loads(self.run_chute("compare", picture % 0, picture % 4, "--json", status=1).stdout)
        self.assertEqual(other["different"], 1)
        self.assertGreater(other["pictures"][0]["worst"], 2)

    def said_on_a_terminal(self, *more):
        ours, theirs = pty.openpty()
        worker = subprocess.Popen([chute, "run", "-", "-o", "terminal" + "".join(more), *more], stdin=subprocess.PIPE,
                                  stdout=subprocess.DEVNULL, stderr=theirs, cwd=self.folder)
        os.close(theirs)
        worker.stdin.write(TINY.encode()), worker.stdin.close()
        said = b""
        try:
            while chunk := os.read(ours, 4096):
                said += chunk
        except OSError:  # the terminal's other end is closed
            pass
        os.close(ours)
        self.assertEqual(worker.wait(), 0)
        return said.decode()

    def test_a_bar_stands_on_a_terminal_alone(self):
        said = self.said_on_a_terminal()
        self.assertRegex(said, "run █+ 100 %")
        self.assertNotRegex(said, "\x1b\\[[0-9;]*m")  # no colours
        self.assertEqual(self.said_on_a_terminal("--quiet"), "")
        self.assertNotIn("█", self.run_chute("run", "-", "-o", "pipe", given=TINY).stderr)

    def test_the_end_of_a_run_names_the_next_step(self):
        self.assertIn("chute report pipe -o report.html", self.run_chute("run", "-", "-o", "pipe", given=TINY).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
