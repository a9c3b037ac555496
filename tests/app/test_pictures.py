"""Pictures as a user makes them: test_pictures.py CHUTE SOURCES. Frames with a plot, a figure from one's own
table, comparing pictures."""
import base64
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

chute, sources = sys.argv[1:3]
DONE, FAILED, WRONG = 0, 1, 2
GOLDEN = os.path.join(sources, "golden")
SVG = "{http://www.w3.org/2000/svg}"


class Pictures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def call(self, *words, status=DONE):
        done = subprocess.run([chute, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def golden(self, name):
        return os.path.join(GOLDEN, name + ".png")


CELLS = """<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
<ImageData WholeExtent="0 2 0 2 0 0" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="0 2 0 2 0 0">
<CellData><DataArray type="Float64" Name="density" format="ascii">1 2 3 4</DataArray></CellData>
</Piece></ImageData></VTKFile>
"""


class IdleOptions(Pictures):
    """What would do nothing is refused in one line, and nothing is written."""

    def refused(self, *words):
        out = self.path("out")
        said = self.call("render", *words, *([] if "--movie" in words else ["-o", out]), status=WRONG).stderr
        self.assertEqual(said.count("\n"), 1, said)
        self.assertFalse(os.path.exists(out))
        return said

    def test_of_grains(self):
        grains = os.path.join(GOLDEN, "data", "frame-discs.vtp")
        for words, says in ((["--fps", "10"], "--fps is of a movie"),
                            (["--time-scale", "1000"], "--time-scale: say with --time what the time is in then"),
                            (["--occlusion"], "--occlusion does nothing here: these grains lie in a plane"),
                            (["--no-floor"], "--floor does nothing here: these grains lie in a plane"),
                            (["--camera", "30:20"], "--camera AZIMUTH:ELEVATION[:ZOOM] does nothing here"),
                            (["--color", "none", "--colormap", "batlow"], "--colormap does nothing here: nothing is coloured")):
            with self.subTest(words=words):
                self.assertIn(says, self.refused(grains, *words))
        told = self.call("render", grains, "--trails", "3", "--size", "160x120", "-o", self.path("trails")).stderr
        self.assertIn("--trails does nothing here: there is one frame", told)

    def test_of_maps(self):
        cells = self.write("cells.vti", CELLS)
        for words, says in ((["--arrows"], "--arrows does nothing here: these are maps of cells"),
                            (["--camera", "all"], "--camera does nothing here: these are maps of cells"),
                            (["--camera-at", "1=30:20"], "--camera-at does nothing here: these are maps of cells"),
                            (["--opacity", "0.5"], "--opacity does nothing here: these are maps of cells"),
                            (["--title", "x"], "--title does nothing here"),
                            (["--colormap", "batlow"], "--colormap batlow does nothing here: maps of cells have viridis or rdbu"),
                            (["--background", "transparent"], "maps of cells have white or dark ground")):
            with self.subTest(words=words):
                self.assertIn(says, self.refused(cells, *words))
        self.call("render", cells, "--range", "0:5", "--colormap", "rdbu", "--size", "300x200", "-o", self.path("map"))


class Compare(Pictures):
    def test_two_pictures(self):
        self.assertIn("0 of", self.call("compare", self.golden("band"), self.golden("band")).stdout)
        difference = self.path("new", "difference.png")
        said = self.call("compare", self.golden("frame-discs"), self.golden("frame-chains"), "--diff", difference,
                         status=FAILED)
        self.assertRegex(said.stdout, r"frame-chains.png: different: \d+ of 120000 pixels differ")
        self.assertEqual(said.stderr.count("\n"), 1)
        with open(difference, "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")

    def test_two_folders(self):
        for name in ("a", "b"):
            os.mkdir(self.path(name))
            for picture in ("band", "steps"):
                shutil.copy(self.golden(picture), self.path(name))
        self.call("compare", self.path("a"), self.path("b"))
        shutil.copy(self.golden("type"), self.path("b", "band.png"))
        shutil.copy(self.golden("type"), self.path("b"))
        said = self.call("compare", self.path("a"), self.path("b"), "--diff", self.path("d"), status=FAILED)
        self.assertIn("2 of 3 files differ", said.stderr)
        self.assertIn("type.png: missing", said.stdout)
        self.assertEqual(os.listdir(self.path("d")), ["band.png"])

    def test_several_pictures_and_a_folder(self):
        pictures = [self.golden(name) for name in ("band", "steps")]
        self.assertEqual(self.call("compare", GOLDEN, *pictures).stdout.count("same"), 2)
        self.call("compare", pictures[0], *pictures, status=WRONG)
        self.call("compare", GOLDEN, pictures[0], self.path("nowhere.png"), status=FAILED)

    def test_wrong_files(self):
        self.call("compare", self.golden("band"), self.write("no.png", "text"), status=WRONG)
        self.call("compare", self.golden("band"), self.path("nowhere.png"), status=WRONG)
        self.call("compare", self.golden("band"), GOLDEN, status=WRONG)


class Figure(Pictures):
    def recipe(self, plot, rows):
        self.write("mine.csv", "# my measurement\npanel,series,x,y,y_err\n" + rows)
        return self.write("mine.toml", 'title = "Mine & others"\n[data]\ntable = "mine.csv"\n[plot]\n' + plot)

    def test_its_table_says_what_its_columns_mean(self):
        self.write("profiles.csv", "h,eta,v_x,v_x_err\n0.5,0.8,1,0.1\n1.5,0.7,2,0.2\n")
        recipe = self.write("flow.toml", 'title = "Flow"\n[data]\ntable = "profiles.csv"\n'
                            'x = "h"\ny = "v_x"\ny_err = "v_x_err"\n[plot]\nx = { label = "h" }\ny = { label = "v" }\n')
        self.call("figure", recipe, "-o", self.folder)
        with open(self.path("flow.csv"), encoding="utf-8") as file:
            comments = [line for line in file.read().splitlines() if line.startswith("#")]
        for begin in ("# column h of profiles.csv (m; d): height above", "# column v_x of profiles.csv (m/s; sqrt(gd)): mean velocity",
                      "# column v_x_err of profiles.csv (m/s; sqrt(gd)): of v_x: standard error", "# column series: name of the curve",
                      "# column *_err: "):
            self.assertEqual(sum(line.startswith(begin) for line in comments), 1, (begin, comments))

    def test_a_figure_of_ones_own(self):
        recipe = self.recipe('x = { label = "$\\\\bar{v}_x$ (m/s)" }', ",mu=0.5,1,2,0.1\n,mu=0.5,2,3,\n")
        self.call("figure", recipe, "-o", self.folder)
        picture = xml.parse(self.path("mine.svg")).getroot()
        self.assertEqual(picture.find(SVG + "title").text, "Mine & others")
        self.assertIn("chute", picture.find(SVG + "desc").text)
        texts = ["".join(text.itertext()) for text in picture.iter(SVG + "text")]
        self.assertIn("v\u00afx (m/s)", texts)  # the bar and the index are letters of their own
        fonts = re.findall(r"font-family:(\w+);font-style:(\w+).*?base64,([^)]*)\)", picture.find(SVG + "style").text)
        self.assertEqual([(family, style) for family, style, _ in fonts],
                         [("STIXGeneral", "normal"), ("STIXGeneral", "italic")])
        for _, _, font in fonts:
            self.assertEqual(base64.b64decode(font)[:4], b"OTTO")
            self.assertLess(len(font), 20000)

    def test_a_slip_in_a_recipe(self):
        recipe = self.recipe('x = { lable = "x" }', ",a,1,2,\n")
        said = self.call("figure", recipe, "-o", self.folder, status=WRONG).stderr
        self.assertIn("mine.toml:5: plot.x.lable: unknown key, did you mean label?", said)

    def test_many_dots_make_small_files(self):
        state, rows = 7, []
        for i in range(100000):
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            rows.append(",impacts,%.4f,%.4f,\n" % ((state >> 40) / 2**24, (state >> 16) % 2**24 / 2**24))
        recipe = self.recipe('kind = "dots"', "".join(rows))
        self.call("figure", recipe, "-o", self.folder)
        for ending in (".png", ".pdf", ".svg"):
            self.assertLess(os.path.getsize(self.path("mine" + ending)), 4e6)


class Render(Pictures):
    def test_a_plot_beside_the_grains(self):
        with open(os.path.join(sources, "golden", "data", "frame-discs.vtp"), "rb") as file:
            frame = file.read()
        os.mkdir(self.path("run"))
        with open(self.path("run", "0.vtp"), "wb") as file:
            file.write(frame)
        self.write(os.path.join("run", "series.csv"), "time,v_x,x\n0,1,0\n30,2,4\n60,0.5,9\n")
        render = ["render", self.path("run"), "-o", self.path("out"), "--size", "400x300", "--quiet"]
        self.call(*render)
        shutil.copy(self.path("out", "000000.png"), self.path("plain.png"))
        self.call(*render, "--plot", "v_x")
        self.call("compare", self.path("plain.png"), self.path("out", "000000.png"), status=FAILED)
        self.call(*render, "--plot", "v_x,x")
        for words, told in ((["--plot", "vx"], 'no column "vx", did you mean "v_x"?'),
                            (["--plot", "v_x", "--bare"], "--bare"),
                            (["--series", self.path("run", "series.csv")], "--plot"),
                            (["--plot", "v_x", "--series", self.path("nowhere.csv")], "nowhere.csv")):
            said = self.call(*render, *words, status=WRONG).stderr
            self.assertIn(told, said)
            self.assertEqual(said.count("\n"), 1)

    def test_options_that_make_no_picture(self):
        os.mkdir(self.path("run"))
        shutil.copy(os.path.join(sources, "golden", "data", "frame-discs.vtp"), self.path("run", "0.vtp"))
        self.write("c.csv", "a,b,push\n1,2,3\n")
        self.write("empty.csv", "a,b,push\n")
        render = ["render", self.path("run"), "-o", self.path("out"), "--quiet"]
        for words, told in ((["--camera-at", "foo"], "expected TIME="), (["--camera-at", "1=follow"], "expected TIME="),
                            (["--camera-at", "1=10:20"], "does nothing here: these grains lie in a plane"),
                            (["--camera-at", "1=0:1:0:1", "--camera-at", "1=0:2:0:2"], "a time of its own"),
                            (["--opacity", "2"], "--opacity"), (["--format", "bmp"], "png, pdf, svg"),
                            (["--size", "86x60mm"], "with --dpi in mm"), (["--dpi", "1"], "1 dpi"), (["--dpi", "0"], "0 dpi"),
                            (["--copies-reach", "0"], "copies 0 periods far"),
                            (["--contacts", self.path("nowhere")], "nowhere: no such file"),
                            (["--contacts", self.path("c.csv")], "--force names one; there are: a, b, push"),
                            (["--contacts", self.path("c.csv"), "--ends", "a"], "the two columns of ids"),
                            (["--contacts", self.path("empty.csv"), "--force", "pull"], 'no array "pull"; there are: a, b, push'),
                            (["--contacts", self.path("empty.csv"), "--force", "push", "--ends", "a,c"], 'no array "c"'),
                            (["--force", "push"], "of --contacts"), (["--color", "chains"], "--contacts names")):
            said = self.call(*render, *words, status=WRONG).stderr
            self.assertIn(told, said)
            self.assertEqual(said.count("\n"), 1)
            self.assertFalse(os.path.exists(self.path("out", "000000.png")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
