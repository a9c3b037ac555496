"""Inputs that once crashed chute, filled the memory or made it deaf: test_faults.py CHUTE SOURCES. Each is told in one line,
in little time and memory, and nothing that existed is lost."""
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from tiny_scene import TINY

chute, sources = sys.argv[1:3]
MEMORY = 2_000_000_000  # bytes that a command may take
WRONG = 2
WATCHED = "CHUTE_WATCHED" in os.environ  # by a sanitizer, which reserves terabytes and takes its time (tests/run sets it)
SECONDS = 200 if WATCHED else 20  # that it may last

SCENE = TINY + "series = { every = 0.5 }\nprofiles = { from = 0.5, bin = 1.0 }\n"


class Faults(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_chute(self, *words):
        def limit():
            if not WATCHED:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        return subprocess.run([chute, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              timeout=SECONDS, preexec_fn=limit, errors="replace")

    def refused(self, *words):
        done = self.run_chute(*words)
        self.assertEqual(done.returncode, WRONG, (words, done.stderr))
        self.assertEqual(len(done.stderr.splitlines()), 1, (words, done.stderr))
        return done.stderr

    def scene(self, **changed):
        (self.folder / "s.toml").write_text(SCENE)
        return ["s.toml"] + [w for key, value in changed.items() for w in ("--set", f"{key.replace('__', '.')}={value}")]

    def test_damaged_vtk(self):
        for name in ("appended-nowhere", "zero-block-size", "zero-blocks", "six-gigabytes"):
            file = Path(sources) / "tests/faults" / f"{name}.vtp"
            self.assertIn("damaged or cut short", self.refused("info", file))
            self.assertIn("damaged or cut short", self.refused("render", file, "-o", "pictures"))

    def test_what_stands_inside_an_array_hides_no_other(self):
        """VTK keeps ranges inside arrays; the next array's header is looked at all the same."""
        known = '<InformationKey name="RANGE" location="a"><Value index="0">AAAA</Value></InformationKey>'
        (self.folder / "f.vtp").write_text(
            '<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><PolyData>'
            f'<Piece NumberOfPoints="1"><PointData><DataArray type="Float64" Name="a" format="ascii">1{known}</DataArray>'
            f'<DataArray type="Float64" Name="b" format="binary">{known}AAAAAAAAAAAAAAAA</DataArray></PointData>'
            '<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0</DataArray></Points>'
            "</Piece></PolyData></VTKFile>")
        self.assertIn('array "b": packed into no block', self.refused("info", "f.vtp"))

    def test_deep_files(self):
        deep = 200_000
        (self.folder / "deep.vtp").write_text('<VTKFile type="PolyData">' + "<a>" * deep + "</a>" * deep + "</VTKFile>")
        self.assertIn("levels deep", self.refused("info", "deep.vtp"))
        for text in ("a" + ".a" * 50_000 + "=1", "[" + "a." * 50_000 + "a]", "x = " + "[" * 50_000, "x = " + "{a=" * 50_000,
                     "x = \'\'\'it\'s\'\'\' \"\"\"a\"b\"\"\" " + "[" * 50_000):
            (self.folder / "deep.toml").write_text(text)
            self.assertIn("deep.toml:1: more than 64 levels deep", self.refused("check", "deep.toml"))

        for setting in ("x=" + "[" * 20_000, "a" + ".a" * 20_000 + "=1"):
            self.assertIn("more than 64 levels deep", self.refused("check", *self.scene(), "--set", setting))

    def test_dots_that_are_no_levels(self):
        (self.folder / "s.toml").write_text(SCENE.replace("tiny", "." * 100) + "# " + "." * 100 + "\n")
        self.assertEqual(self.run_chute("check", "s.toml").returncode, 0)

    def test_schedules_beyond_all_steps(self):
        for key in ("output__frames__from", "output__profiles__from", "output__series__every", "output__checkpoint"):
            done = self.run_chute("run", *self.scene(**{key: "1e50"}), "-o", "out", "--force", "--quiet")
            self.assertEqual(done.returncode, 0, (key, done.stderr))
        done = self.run_chute("run", *self.scene(output__checkpoint="1e-50"), "-o", "out", "--force", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_outputs_beyond_the_end_are_told(self):
        for key, says in (("output__frames__from", "output.frames.from = 5 lies beyond the end of the run at 2"),
                          ("output__profiles__from", "output.profiles.from = 5 lies beyond the end"),
                          ("output__series__every", "output.series.every = 5 lies beyond the end")):
            self.assertIn("# warning: " + says, self.run_chute("check", *self.scene(**{key: "5"})).stdout)
            self.assertIn("warning: " + says, self.run_chute("run", *self.scene(**{key: "5"}), "-o", "out", "--force").stderr)
        self.assertNotIn("warning", self.run_chute("check", *self.scene()).stdout)

    def test_grains_that_would_sink_into_each_other_are_told(self):
        # With k = 5 m g/d a grain sinks m g/k, a fifth of d, or a little else with the damping.
        said = self.run_chute("check", *self.scene(contact__normal__stiffness="5", incline__gravity="1")).stdout
        self.assertRegex(said, r"warning: a grain sinks 0\.[1-4]\d* diameters into another one under its own weight")
        said = self.run_chute("check", *self.scene(grains__start__velocity="1e4")).stdout
        self.assertRegex(said, r"warning: the fastest grains of the start overlap by \S+ diameters")
        self.assertNotIn("diameters", self.run_chute("check", *self.scene()).stdout)

    def test_more_output_than_a_disk_takes(self):
        for every in ("1e-8", "1e-9"):
            said = self.refused("run", *self.scene(output__series__every=every), "-o", "out")
            self.assertIn("output.series.every", said)
            self.assertEqual(said, self.refused("check", *self.scene(output__series__every=every)))
            self.assertFalse((self.folder / "out").exists())

    def test_a_run_beyond_the_machine(self):
        """Fifty thousand frames of two million grains: 7 TB."""
        large = self.scene(grains__count="2000000", run__duration="5000", output__frames="{every=0.1}")
        said = self.refused("run", *large, "-o", "out")
        self.assertRegex(said, r"s.toml: \S+: the run takes about \S+ GB of (disk|memory); .* --beyond-machine")
        self.assertFalse((self.folder / "out").exists())
        self.assertEqual(said, self.refused("check", *large))
        done = self.run_chute("check", *large, "--beyond-machine")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"# disk +\S+ TB")

    def test_step_longer_than_the_run(self):
        self.assertIn("is less than half a step", self.refused("check", *self.scene(engine__time_step="1e50")))

    def test_a_sweep_of_more_places_than_can_be_run(self):
        for axis in ("count = 1000000000", "count = 1000000"):
            (self.folder / "sweep.toml").write_text(
                SCENE + f'\n[sweep]\nseeds = 1000\n[[sweep.axis]]\nkey = "seed"\nfrom = 1\nto = 9\n{axis}\n')
            self.assertIn("sweep", self.refused("sweep", "sweep.toml", "-o", "d"))
            self.assertFalse((self.folder / "d").exists())

    def test_a_figure_is_drawn_before_anything_is_replaced(self):
        (self.folder / "t.csv").write_text("panel,series,x,y\n,a,1,2\n,a,2,3\n")
        (self.folder / "r.toml").write_text('title = "r"\n[data]\ntable = "t.csv"\n[plot]\nx = { label = "x" }\ny = { label = "y" }\n')
        self.assertEqual(self.run_chute("figure", "r.toml", "-o", "out", "--quiet").returncode, 0)
        good = (self.folder / "out/r.csv").read_bytes()
        (self.folder / "t.csv").write_text("panel,series,x,y\n")
        self.refused("figure", "r.toml", "-o", "out", "--quiet")
        self.assertEqual((self.folder / "out/r.csv").read_bytes(), good)

    def test_a_figure_never_replaces_the_table_it_reads(self):
        text = "panel,series,x,y\n,a,1,2\n,a,2,3\n"
        (self.folder / "t.csv").write_text(text)
        (self.folder / "t.toml").write_text('title = "t"\n[data]\ntable = "t.csv"\n[plot]\nx = { label = "x" }\ny = { label = "y" }\n')
        self.assertEqual(self.run_chute("figure", "t.toml", "-o", ".", "--quiet").returncode, 0)
        self.assertTrue((self.folder / "t.pdf").exists())
        self.assertEqual((self.folder / "t.csv").read_text(), text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
