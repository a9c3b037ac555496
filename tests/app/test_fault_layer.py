"""A disk that fails, and a machine that stops, at each call that changes a file, one after the other:
test_fault_layer.py CHUTE LAYER [all]. What a command did until then must not be in the way: the error is one line with exit
status 1, what was there before is there still, and the same work can be done again, to the same bytes. Without `all` a part
of the calls has its turn, other ones for each way to fail."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from tiny_scene import TINY

chute, layer = sys.argv[1:3]
EVERY = 1 if sys.argv[3:] == ["all"] else 72
SECONDS = 300  # a loaded machine takes its time; nothing here may wait for ever
KILLED = -9
WAYS = {"kill": "", "ENOSPC": "No space left on device", "EIO": "Input/output error"}

SCENE = TINY.replace("duration = 2", "duration = 1") + "checkpoint = 0.5\nseries = { every = 0.5 }\n"
SWEEP = SCENE + '\n[sweep]\nseeds = 2\n[[sweep.axis]]\nkey = "grains.count"\nvalues = [7, 8]\n'
RECIPE = '''title = "r"
[data]
scene = "s.toml"
x = "time"
y = "velocity"
[[data.curve]]
series = "a"
extract = "series"
column = "v_x"
[plot]
x = { label = "x" }
y = { label = "y" }
'''


def tree(folder):
    """What every file holds; of run.json, which tells times, what the run's files should hold and how it ended."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            name, content = str(path.relative_to(folder)), path.read_bytes()
            if path.name == "run.json":
                facts = json.loads(content)
                content = (facts["end"], facts.get("files"))
            found[name] = content
    return found


class FaultLayer(unittest.TestCase):
    def setUp(self):
        # In memory, where it can be: the test is of what is asked of the disk, not of how long that takes.
        memory = "/dev/shm"
        self.top = Path(tempfile.mkdtemp(dir=memory if os.access(memory, os.W_OK) else None))
        self.addCleanup(shutil.rmtree, self.top)

    def go(self, folder, command, fault=None, program="chute", more=()):
        environment = dict(os.environ, LC_ALL="C", **dict(more))
        if fault is not None:
            environment.update(LD_PRELOAD=layer, CHUTE_FAULT_PROGRAM=program, CHUTE_FAULT_AT=str(fault[0]),
                               CHUTE_FAULT_HOW=fault[1])
        return subprocess.run([chute, *command], cwd=folder, capture_output=True, text=True, timeout=SECONDS,
                              env=environment)

    def folder(self, name, old=None):
        folder = self.top / name
        shutil.rmtree(folder, ignore_errors=True)
        if old:
            shutil.copytree(old, folder)
        else:
            folder.mkdir()
            (folder / "s.toml").write_text(SCENE)
            (folder / "sweep.toml").write_text(SWEEP)
            (folder / "r.toml").write_text(RECIPE)
        return folder

    def good(self, folder, *command):
        done = self.go(folder, [*command, "--quiet"])
        self.assertEqual(done.returncode, 0, (self.at, command, done.stderr))
        return folder

    def calls(self, command, old, program="chute", more=()):
        """How many calls of the command change files."""
        folder, log = self.folder("counted", old), self.top / "count"
        log.unlink(missing_ok=True)
        self.go(folder, command, (0, ""), program, [*more, ("CHUTE_FAULT_COUNT", str(log))])
        count = len(log.read_text().splitlines())
        self.assertGreater(count, 3)
        return count

    def faults(self, command, old=None, program="chute", more=()):
        """Lets the command fail, each time in a folder of its own, and gives that folder and whether the command did its
        work in spite of it."""
        command = [*command, "--quiet"]
        every = max(1, EVERY if program == "chute" else EVERY // 8)
        for first, (how, words) in enumerate(WAYS.items()):
            for k in range(1 + first * every // 3, self.calls(command, old, program, more) + 1, every):
                self.at = f"{how} at call {k} of {program} in {' '.join(command)}"
                folder = self.folder("broken", old)
                done = self.go(folder, command, (k, how), program, more)
                self.said = done.stderr
                if program == "chute" and how == "kill":
                    self.assertEqual(done.returncode, KILLED, (self.at, done.stderr))
                elif done.returncode != 0:
                    self.assertEqual(done.returncode, 1, (self.at, done.stderr))
                    self.assertEqual(len(done.stderr.splitlines()), 1, (self.at, done.stderr))
                    self.assertTrue(done.stderr.startswith("chute: "), (self.at, done.stderr))
                    if program == "chute":
                        self.assertIn(words, done.stderr, self.at)
                yield folder, done.returncode == 0

    def nothing_is_left(self, folder):
        self.assertEqual([p.name for p in folder.rglob(".chute-*")], [], self.at)

    RUN = ["run", "s.toml", "-o", "out"]

    def test_run(self):
        self.at = "whole"
        whole = tree(self.good(self.folder("whole"), *self.RUN))
        for folder, finished in self.faults(self.RUN):
            if finished:  # a disk that refuses to remove a file keeps the lock's, which the next process takes away
                left = tree(folder)
                left.pop("out/.chute-lock", None)
                self.assertEqual(left, whole, self.at)
            elif not self.at.startswith("kill"):
                self.assertEqual((folder / "out/checkpoint").exists(), "go on with: chute run out --resume" in self.said, (self.at, self.said))
                if (folder / "out").exists():  # then it holds something to go on from, and a full disk is not physics
                    self.assertIn(json.loads((folder / "out/run.json").read_text())["end"], ("running", "finished"), self.at)
                    self.assertTrue((folder / "out/checkpoint").exists(), (self.at, self.said))
            for flag in "--resume", "--force":
                again = self.good(self.folder("again", folder), *self.RUN, flag)
                self.nothing_is_left(again)
                self.assertEqual(tree(again), whole, (self.at, flag))

    def replace(self, more=()):
        self.at = "whole"
        whole = tree(self.good(self.folder("whole"), *self.RUN))
        old = self.good(self.folder("old"), *self.RUN, "--set", "seed=7")
        (old / "out/notes.txt").write_text("years of work")
        (old / "out/pictures").mkdir()
        (old / "out/pictures/000000.png").write_text("of the old run")
        before = tree(old / "out")
        for folder, finished in self.faults([*self.RUN, "--force"], old, more=more):
            new_is_whole = False
            try:
                new_is_whole = json.loads((folder / "out/run.json").read_text())["end"] == "finished" and \
                    json.loads((folder / "out/run.json").read_text())["seed"] == 1
            except FileNotFoundError:
                pass
            if not new_is_whole:  # then the old one must be there, in its place or beside it
                places = [p for p in folder.iterdir() if p.is_dir()]
                trees = [{n: c for n, c in tree(p).items() if not n.startswith(".chute-")} for p in places]
                self.assertIn(before, trees, (self.at, [p.name for p in places]))
            notes = [p.read_text() for p in folder.rglob("notes.txt")]
            self.assertEqual(notes, ["years of work"], self.at)
            if not finished:
                resumed = self.go(self.folder("resumed", folder), [*self.RUN, "--resume", "--quiet"], more=more)
                if resumed.returncode:  # the old run stands there
                    self.assertIn("another scene", resumed.stderr, self.at)
            again = self.good(self.folder("again", folder), *self.RUN, "--force")
            self.nothing_is_left(again)
            self.assertEqual((again / "out/notes.txt").read_text(), "years of work", self.at)
            (again / "out/notes.txt").unlink()
            self.assertEqual(tree(again), whole, self.at)

    def test_replace(self):
        self.replace()

    def test_replace_on_a_disk_that_cannot_exchange_names(self):
        self.replace([("CHUTE_FAULT_OLD", "1")])

    def test_sweep(self):
        command = ["sweep", "sweep.toml", "-o", "out"]
        self.at = "whole"
        whole = tree(self.good(self.folder("whole"), *command))
        for folder, finished in self.faults(command):
            again = self.good(folder, *command, "--resume")
            self.nothing_is_left(again)
            self.assertEqual(tree(again), whole, self.at)

    def test_figure(self):
        command = ["figure", "r.toml", "-o", "out"]
        self.at = "whole"
        whole = tree(self.good(self.folder("whole"), *command))
        for folder, finished in self.faults(command):
            again = self.good(folder, *command)
            self.nothing_is_left(again)
            self.assertEqual(tree(again), whole, self.at)

    def movie(self, program, name):
        command = ["render", "out", "--movie", name, "--size", "320x200", "--jobs", "1"]
        self.at = "whole"
        old = self.good(self.folder("old"), *self.RUN)
        whole = tree(self.good(self.folder("whole", old), *command))
        (old / name).write_text("the old one")
        for folder, finished in self.faults(command, old, program):
            content = (folder / name).read_bytes()
            self.assertIn(content, [whole[name]] if finished else [b"the old one", whole[name]], self.at)
            again = self.good(folder, *command)
            self.nothing_is_left(again)
            self.assertEqual(tree(again), whole, self.at)

    def test_movie(self):
        self.movie("chute", "m.mp4")

    def test_a_movie_whose_ffmpeg_fails(self):
        self.movie("ffmpeg", "m.mp4")
        self.movie("ffmpeg", "m.gif")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
