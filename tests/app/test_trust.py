"""Two at once, processes that die, streams that take nothing, files that are not what they were: test_trust.py CHUTE [ROUNDS].
ROUNDS: how often eight shards of a sweep start at the same moment."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from tiny_scene import TINY

chute = sys.argv[1]
ROUNDS = int(sys.argv[2]) if len(sys.argv) > 2 else 2
SHARDS = 8
SECONDS = 300  # a loaded machine takes its time; nothing here may wait for ever

SCENE = TINY + "series = { every = 0.5 }\n"
SWEEP = SCENE + '\n[sweep]\nseeds = 4\n[[sweep.axis]]\nkey = "grains.count"\nvalues = [7, 8]\n'
ENDLESS = ["--set", "run.duration=1000000", "--set", "output.series.every=1000", "--set", "output.frames.every=1000"]


class Trust(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "s.toml").write_text(SCENE)
        (self.folder / "sweep.toml").write_text(SWEEP)

    def start(self, *words, **more):
        return subprocess.Popen([chute, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, **more)

    def go(self, *words, **more):
        return subprocess.run([chute, *words], cwd=self.folder, capture_output=True, text=True, timeout=SECONDS, **more)

    def good(self, *words):
        done = self.go(*words, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def failed(self, done):
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def wait_for(self, what):
        until = time.monotonic() + SECONDS
        while not what():
            self.assertLess(time.monotonic(), until)
            time.sleep(0.01)

    def hidden(self):
        return [p.name for p in self.folder.rglob(".chute-*")]

    def test_a_run_is_one_process(self):
        first = self.start("run", "s.toml", "-o", "out", "--quiet", *ENDLESS)
        self.wait_for(lambda: (self.folder / "out/checkpoint").exists())
        for flags in ([], ["--force"], ["--resume"]):
            said = self.failed(self.go("run", "s.toml", "-o", "out", *ENDLESS, *flags))
            self.assertRegex(said, rf"\Achute: out: in use by process {first.pid} on [^\n]+\n\Z")
        first.send_signal(signal.SIGKILL)
        first.communicate()
        self.good("run", "s.toml", "-o", "out", "--force")  # the lock went with the process
        self.assertEqual(self.hidden(), [])

    def test_a_sweep_is_one_process_or_its_shards(self):
        slow = ["--set", "run.duration=1000000"]
        first = self.start("sweep", "sweep.toml", "-o", "out", "--quiet", "--shard", "1/2", *slow)
        self.wait_for(lambda: (self.folder / "out/points").exists())
        for shard in ([], ["--shard", "1/2"]):
            said = self.failed(self.go("sweep", "sweep.toml", "-o", "out", "--resume", *shard, *slow))
            self.assertIn("in use by", said)
        first.send_signal(signal.SIGTERM)
        self.assertRegex(first.communicate(timeout=SECONDS)[1], r"\Achute: stopped; what is done is kept: go on with: chute sweep out [^\n]+\n\Z")
        self.assertEqual(self.hidden(), [])

    def test_shards_that_start_together(self):
        self.good("sweep", "sweep.toml", "-o", "whole")
        whole = (self.folder / "whole/sweep.csv").read_bytes()
        for k in range(ROUNDS):
            shards = [self.start("sweep", "sweep.toml", "-o", "out", "--quiet", "--shard", f"{i}/{SHARDS}")
                      for i in range(1, SHARDS + 1)]
            said = [(shard.communicate(timeout=SECONDS)[1], shard.returncode) for shard in shards]
            self.assertEqual(said, [("", 0)] * SHARDS, k)
            self.assertEqual((self.folder / "out/sweep.csv").read_bytes(), whole, k)
            self.assertEqual(self.hidden(), [], k)
            shutil.rmtree(self.folder / "out")

    def test_a_process_that_draws_is_killed(self):
        self.good("run", "s.toml", "-o", "out")
        for more in (["--movie", "m.mp4"], []):
            (self.folder / "m.mp4").write_text("the old one")
            render = self.start("render", "out", "--quiet", "--jobs", "2", "--size", "3000x2000", *more)
            children = Path(f"/proc/{render.pid}/task/{render.pid}/children")

            def workers():
                found = [int(p) for p in children.read_text().split()]
                return [p for p in found if Path(f"/proc/{p}/comm").read_text() == "chute\n"]
            self.wait_for(lambda: len(workers()) == 2)
            os.kill(workers()[0], signal.SIGKILL)
            said = render.communicate(timeout=SECONDS)[1]
            self.assertEqual(render.returncode, 1, said)
            self.assertRegex(said, r"\Achute: a process that draws frames was ended by force[^\n]*\n\Z")
            self.assertEqual((self.folder / "m.mp4").read_text(), "the old one")
            self.assertEqual(self.hidden(), [])

    def test_streams_that_take_nothing(self):
        self.good("run", "s.toml", "-o", "out")
        with open("/dev/full", "w") as full:
            def to_full(stream, *words):
                return subprocess.run([chute, *words], cwd=self.folder, timeout=SECONDS, text=True,
                                      **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, stream: full})
            for words in (["info", "out"], ["--help"], ["check", "s.toml"], ["check", "--keys"], ["figure", "--list"]):
                done = to_full("stdout", *words)
                self.assertEqual((done.returncode, done.stderr),
                                 (1, "chute: standard output: cannot write: No space left on device\n"), words)
            self.assertEqual(to_full("stderr", "run", "s.toml", "-o", "out", "--force").returncode, 0)
            self.assertEqual(to_full("stderr", "run", "s.toml", "-o", "out").returncode, 2)
        closed = self.go("run", "s.toml", "-o", "out", "--force", preexec_fn=lambda: os.close(2))
        self.assertEqual(closed.returncode, 0)
        self.assertEqual(self.failed(self.go("info", "out", preexec_fn=lambda: os.close(1))),
                         "chute: standard output: cannot write: Bad file descriptor\n")

    def test_files_are_compared_with_their_sums(self):
        self.good("run", "s.toml", "-o", "out")
        done = self.go("info", "--verify", "out")
        self.assertEqual((done.returncode, done.stdout), (0, "out: 9 files are as the run wrote them\n"), done.stderr)
        self.assertNotIn("sha256", self.go("info", "out").stdout)
        for name in ("series.csv", "frames/000002.vtp", "checkpoint", "scene.toml"):
            file = self.folder / "out" / name
            whole = file.read_bytes()
            for damaged in (whole[:-1], b"", whole[:-1] + bytes([whole[-1] ^ 1])):
                file.write_bytes(damaged)
                done = self.go("info", "--verify", "out")
                self.assertIn("1 of 9 files are not as the run wrote them", self.failed(done))
                self.assertIn(f"out/{name}: ", done.stdout)
            file.write_bytes(whole)

    def test_frames_cut_short_are_not_kept(self):
        self.good("run", "s.toml", "-o", "out")
        (self.folder / "out/frames/000001.vtp").write_bytes(b"")
        done = self.go("run", "s.toml", "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Achute: out/frames/000001.vtp: 0 bytes, should be \d+; give --force")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
