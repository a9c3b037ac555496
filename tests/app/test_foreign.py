"""Files of other programs as a user meets them: test_foreign.py CHUTE. Dumps and XYZ files, arrays that are said, species, up, and
movies of every kind."""
import collections
import gzip
import json
import math
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

import png_pixels

chute = os.path.abspath(sys.argv[1])
BOX = (10.0, 8.0, 6.0)
TILT = (3.0, -2.0, 1.5)


def dump_frame(step, columns, grains=60):
    """The same grains, however the columns tell places."""
    rows = []
    some = random.Random(4)
    for i in range(grains):
        f = [some.uniform(0.02, 0.98) for _ in range(3)]
        turns = [some.randint(-2, 2), some.randint(-2, 2), 0]
        if "u" in columns:
            f = [a + n for a, n in zip(f, turns)]
        place = [f[0] * BOX[0] + f[1] * TILT[0] + f[2] * TILT[1], f[1] * BOX[1] + f[2] * TILT[2], f[2] * BOX[2]]
        told = f if columns.startswith("xs") else place
        rows.append("%d %d %.17g %.17g %.17g %d %d %d %g %g 0 0" % (i + 1, i % 3 + 1, *told, *turns, 0.3 + 0.02 * (i % 5), i))
    xs = (0, TILT[0], TILT[1], TILT[0] + TILT[1])
    head = ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(grains), "ITEM: BOX BOUNDS xy xz yz pp pp ff",
            "%g %g %g" % (min(xs), BOX[0] + max(xs), TILT[0]), "%g %g %g" % (0, BOX[1] + TILT[2], TILT[1]),
            "%g %g %g" % (0, BOX[2], TILT[2]), "ITEM: ATOMS id type %s ix iy iz radius vx vy vz" % columns]
    return "\n".join(head + rows) + "\n"


def vtk(arrays, points=4):
    """Grains in a row as a legacy file; `arrays` are name: values."""
    text = "# vtk DataFile Version 3.0\nfrom elsewhere\nASCII\nDATASET POLYDATA\nPOINTS %d double\n" % points
    text += "".join("%d 0 %g\n" % (i, 0.5 * (i % 2)) for i in range(points))
    text += "POINT_DATA %d\nFIELD FieldData %d\n" % (points, len(arrays))
    for name, values in arrays.items():
        text += "%s %d %d double\n%s\n" % (name, len(values) // points, points, " ".join(map(str, values)))
    return text


class Foreign(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())

    def call(self, *words, status=0, memory=None):
        def limit():
            if memory and "CHUTE_WATCHED" not in os.environ:  # a sanitizer reserves terabytes (tests/run)
                resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        done = subprocess.run([chute, *map(str, words)], capture_output=True, text=True, cwd=self.folder, preexec_fn=limit)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def picture(self, source, *options):
        name = "out-%d" % len(os.listdir(self.folder))
        self.call("render", source, "-o", name, "--size", "240x180", "--jobs", "1", *options)
        names = sorted(os.listdir(self.path(name)))
        return [self.pixels(self.path(name, one)) for one in names]

    def pixels(self, path):
        if path.endswith(".png") and not path.endswith("m.png"):  # that is a film, too
            return png_pixels.rgb(path)
        done = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                              capture_output=True, check=True)
        return done.stdout

    def probe(self, name):
        done = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_name,width,height,pix_fmt,nb_read_frames,"
                               "color_space", "-count_frames", "-of", "json", self.path(name)], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)["streams"][0]


class Dumps(Foreign):
    def test_all_ways_to_tell_places_are_one_picture(self):
        pictures = []
        for columns in ("x y z", "xs ys zs", "xu yu zu", "xsu ysu zsu"):
            self.write("d.lammpstrj", dump_frame(0, columns) + dump_frame(50, columns))
            pictures.append(self.picture("d.lammpstrj", "--box"))
        with gzip.open(self.path("d.gz"), "wt") as file:
            file.write(dump_frame(0, "x y z") + dump_frame(50, "x y z"))
        pictures.append(self.picture("d.gz", "--box"))
        if shutil.which("zstd"):
            self.write("d", dump_frame(0, "x y z") + dump_frame(50, "x y z"))
            subprocess.run(["zstd", "-q", self.path("d"), "-o", self.path("d.zst")], check=True)
            pictures.append(self.picture("d.zst", "--box"))
        os.mkdir(self.path("one"))
        for step in (0, 50):
            self.write("one/dump.%d" % step, dump_frame(step, "x y z"))
        pictures.append(self.picture("one", "--box"))
        self.assertEqual(len(pictures[0]), 2)
        for other in pictures[1:]:
            self.assertEqual(len(other), 2)
            for a, b in zip(pictures[0], other):
                self.assertLess(sum(abs(p - q) > 2 for p, q in zip(a, b)), 30)  # places differ in their last digits

    def test_the_same_from_any_number_of_processes(self):
        with gzip.open(self.path("d.gz"), "wt") as file:
            file.write("".join(dump_frame(10 * k, "x y z", 60 + k) for k in range(7)))
        for jobs in (1, 3):
            self.call("render", "d.gz", "-o", "j%d" % jobs, "--size", "96x96", "--jobs", jobs, "--trails", 3)
        for k in range(7):
            with open(self.path("j1", "%06d.png" % k), "rb") as a, open(self.path("j3", "%06d.png" % k), "rb") as b:
                self.assertEqual(a.read(), b.read())

    def test_info_tells_what_is_inside(self):
        self.write("d", dump_frame(0, "xs ys zs") + dump_frame(50, "xs ys zs"))
        found = json.loads(self.call("info", "d", "--json").stdout)
        self.assertEqual((found["kind"], found["frames"], found["time"], found["points"]), ("dump", 2, [0, 50], 60))
        self.assertEqual(found["box"]["edges"][2], [TILT[1], TILT[2], BOX[2]])
        self.assertEqual(found["box"]["periodic"], [True, True, False])
        self.assertIn("2 frames, steps 0 … 50", self.call("info", "d").stdout)
        self.write("m.xyz", '2\nProperties=species:S:1:pos:R:3 Time=0.5\nSi 0 0 0\nO 1 0 0\n')
        found = json.loads(self.call("info", "m.xyz", "--json").stdout)
        self.assertEqual((found["kind"], found["time"]), ("xyz", [0.5, 0.5]))
        self.assertEqual(found["arrays"][0]["words"], ["Si", "O"])

    def test_info_takes_whatever_render_takes(self):
        """A pattern, a folder, an index, one file a process: the same frames as those that are drawn."""
        def part(step, grains):
            rows = "".join("%d %d 0 0 0.5\n" % (i, i + step) for i in grains)
            return ("ITEM: TIMESTEP\n%d\nITEM: NUMBER OF ATOMS\n%d\nITEM: BOX BOUNDS pp pp pp\n0 20\n0 20\n0 20\n"
                    "ITEM: ATOMS id x y z radius\n" % (step, len(grains)) + rows)
        os.mkdir(self.path("split"))
        for k, grains in enumerate((range(0, 4), range(4, 10), range(0))):  # a process may have none
            self.write("split/dump.%d" % k, part(0, grains) + part(7, grains))
        os.mkdir(self.path("vtk"))
        for k in range(3):
            self.write("vtk/s%d.vtk" % (9 + k), vtk({"radius": [0.4] * 4}))
        self.write("vtk.vtk.series", json.dumps({"files": [{"name": "vtk/s%d.vtk" % (9 + k), "time": 0.5 * k} for k in range(3)]}))
        sets = "".join('<DataSet timestep="%d" part="%d" file="vtk/s%d.vtk"/>' % (k // 2, k % 2, 9 + k) for k in range(2))
        self.write("parts.pvd", '<VTKFile type="Collection"><Collection>%s</Collection></VTKFile>' % sets)
        with gzip.open(self.path("packed.vtk.gz"), "wt") as file:
            file.write(vtk({"radius": [0.4] * 4}))
        for source, frames, files, time, points in (
                ("split/dump.%", 2, 3, [0, 7], 10), ("split/dump.0", 2, None, [0, 7], 4), ("vtk", 3, 3, None, 4),
                ("vtk/s*.vtk", 3, 3, None, 4), ("vtk.vtk.series", 3, 3, [0, 1], 4), ("parts.pvd", 1, 2, [0, 0], 8),
                ("packed.vtk.gz", None, None, None, 4)):
            found = json.loads(self.call("info", source, "--json").stdout)
            self.assertEqual((found.get("frames"), found.get("files"), found.get("time"), found["points"]), (frames, files, time, points), source)
            if frames:
                self.assertEqual(len(self.picture(source)), frames)
                self.assertIn("%d frame" % frames, self.call("info", source).stdout)
        for command in (["info", "split"], ["render", "split", "-o", "p"], ["convert", "split", "--to", "csv", "-o", "c"],
                        ["measure", "split", "-o", "m"]):
            self.assertIn("give 'split/dump.%'", self.call(*command, status=2).stderr)
        self.call("convert", "split/dump.%", "--to", "csv", "-o", "c")
        self.call("measure", "split/dump.%", "-o", "m", "--quiet")
        self.assertIn("no such file", self.call("info", "other.%", status=2).stderr)
        self.assertIn("no such file", self.call("info", "other", status=2).stderr)

    def test_info_of_a_grid_of_cells(self):
        self.write("g.vti", '<VTKFile type="ImageData"><ImageData WholeExtent="0 3 0 2 0 0" Origin="1 0 0" Spacing="2 1 1"><Piece Extent="0 3 0 2 0 0">'
                   '<CellData><DataArray type="Float64" Name="eta" format="ascii">0 1 2 3 4 5</DataArray></CellData></Piece></ImageData></VTKFile>')
        found = json.loads(self.call("info", "g.vti", "--json").stdout)
        self.assertEqual((found["points"], found["cells"], found["grid"]), (12, 6, [4, 3, 1]))
        self.assertEqual((found["x"], found["y"], found["arrays"][0]["range"]), ([1, 7], [0, 2], [0, 5]))
        self.assertIn("12 points, 6 cells", self.call("info", "g.vti").stdout)

    def test_pictures_of_indexes_follow_all_their_files(self):
        """Blocks in blocks, partitions and pieces: all grains are there, and what changes in any file is drawn anew."""
        def points(y, kind):
            places = "".join("%d %g 0 " % (i, y) for i in range(3))
            radii = '<PointData><DataArray type="Float64" Name="radius" format="ascii">0.4 0.4 0.4</DataArray></PointData>'
            xyz = '<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">%s</DataArray></Points>' % places
            if kind == "vtp":
                return ('<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
                        'NumberOfPolys="0">%s%s</Piece></PolyData></VTKFile>' % (radii, xyz))
            return ('<VTKFile type="StructuredGrid"><StructuredGrid WholeExtent="0 2 0 0 0 0"><Piece Extent="0 2 0 0 0 0">%s%s</Piece>'
                    '</StructuredGrid></VTKFile>' % (radii, xyz))
        blocks = lambda *names: ('<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>%s</vtkMultiBlockDataSet></VTKFile>' %
                                 "".join('<DataSet index="%d" file="%s"/>' % pair for pair in enumerate(names)))
        os.mkdir(self.path("in"))
        self.write("in/a.vtp", points(0, "vtp")), self.write("b.vtp", points(1, "vtp")), self.write("c.vts", points(2, "vts"))
        self.write("in/inner.vtm", blocks("a.vtp"))
        self.write("outer.vtm", blocks("in/inner.vtm", "b.vtp"))
        self.write("parts.vtpd", blocks("in/inner.vtm", "b.vtp").replace("vtkMultiBlockDataSet", "vtkPartitionedDataSet"))
        self.write("pieces.pvts", '<VTKFile type="PStructuredGrid"><PStructuredGrid WholeExtent="0 2 0 0 0 0" GhostLevel="0"><PPoints>'
                   '<PDataArray type="Float64" NumberOfComponents="3"/></PPoints><PPointData><PDataArray type="Float64" Name="radius"/></PPointData>'
                   '<Piece Extent="0 2 0 0 0 0" Source="c.vts"/></PStructuredGrid></VTKFile>')
        draw = lambda source: self.call("render", source, "-o", "p-" + source, "--size", "96x96").stderr
        for source, file, kind, count in (("outer.vtm", "in/a.vtp", "vtp", 6), ("outer.vtm", "b.vtp", "vtp", 6), ("parts.vtpd", "in/a.vtp", "vtp", 6),
                                          ("pieces.pvts", "c.vts", "vts", 3)):
            self.assertEqual(json.loads(self.call("info", source, "--json").stdout)["points"], count)
            draw(source)
            self.assertNotIn("1 frame drawn", draw(source))
            self.write(file, points(random.Random(source + file).uniform(3, 5), kind))
            self.assertIn("1 frame drawn", draw(source), (source, file))
        self.write("circle.vtm", blocks("circle.vtm"))
        self.assertIn("indexes lead to indexes", self.call("info", "circle.vtm", status=2).stderr)

    def test_colours_of_any_doubles(self):
        """Ranges at both ends of what a double holds: each picture has the colours of the same grains from 0 to 1."""
        usual = self.colours([0, 1, 0, 1], "0:1")
        for low, high in ((-1.7e308, 1.7e308), (1e308, 1.7e308), (0, 5e-324), (5e-324, 1e-323), (1e17, 1e17 + 16)):
            self.assertEqual(self.colours([low, high, low, high], "%r:%r" % (low, high)), usual, (low, high))
            self.colours([low, high, low, high])  # a range of its own choice
            self.colours([high] * 4)

    def colours(self, values, *range_):
        self.write("c.vtk", vtk({"radius": [0.4] * 4, "v": values}))
        seen = self.picture("c.vtk", "--color", "v", "--bare", *(["--range", *range_] if range_ else []))[0]
        return {colour for colour, many in collections.Counter(seen[k:k + 3] for k in range(0, len(seen), 3)).items() if many > 300}

    def test_usual_names_of_sizes_and_of_components(self):
        sizes, speeds = [0.3, 0.4] * 2, [1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0]
        self.write("usual.vtk", vtk({"radius": sizes, "velocity": speeds}))
        usual = self.picture("usual.vtk")
        for radius in ("particle_radius", "ParticleRadius", "sphereRadius", "grain-radius", "Radius%20[m]"):
            self.write("other.vtk", vtk({radius: sizes, "vel": speeds}))
            self.assertTrue(self.picture("other.vtk") == usual, radius)
        for names in (("vx", "vy", "vz"), ("Velocity_X", "Velocity_Y", "Velocity_Z"), ("v_x", "v_y")):
            parts = {name: speeds[k::3] for k, name in enumerate(names)}
            self.write("other.vtk", vtk({"radius": sizes, **parts}))
            self.assertTrue(self.picture("other.vtk") == usual, names)

    def test_contacts_of_processes_are_put_together(self):
        part = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ENTRIES a b force\n%d %d 1\n"
        self.write("grains", dump_frame(0, "x y z"))
        for k in range(2):
            self.write("local.%d" % k, part % (2 * k + 1, 2 * k + 2))
        whole = part.replace("ENTRIES\n1\n", "ENTRIES\n2\n", 1) + "%d %d 1\n"
        self.write("all", whole % (1, 2, 3, 4))
        pictures = [self.picture("grains", "--opacity", "0.3", "--contacts", source) for source in ("all", "local.%", "local.0")]
        self.assertTrue(pictures[0] == pictures[1])
        self.assertFalse(pictures[0] == pictures[2])
        self.assertIn("give 'local.%'", self.call("render", "grains", "-o", "p", "--contacts", "local.*", status=2).stderr)

    def test_packed_frames_of_a_folder_and_of_a_pattern(self):
        os.mkdir(self.path("post"))
        for k in range(3):
            with gzip.open(self.path("post", "s%d.vtk.gz" % k), "wt") as file:
                file.write(vtk({"radius": [0.4] * 4}))
        for source in ("post", "post/*.vtk.gz"):
            self.assertEqual(len(self.picture(source)), 3)
        with gzip.open(self.path("g.vti.gz"), "wt") as file:
            file.write('<VTKFile type="ImageData"><ImageData WholeExtent="0 3 0 2 0 0" Origin="1 0 0" Spacing="2 1 1"><Piece Extent="0 3 0 2 0 0">'
                       '<CellData><DataArray type="Float64" Name="eta" format="ascii">0 1 2 3 4 5</DataArray></CellData></Piece></ImageData></VTKFile>')
        self.call("render", "g.vti.gz", "-o", "cells", "--size", "640x480", "--color", "eta")

    def test_one_that_is_being_written(self):
        self.write("d", dump_frame(0, "x y z") + dump_frame(50, "x y z")[:900])
        said = self.call("render", "d", "-o", "p", "--size", "96x96").stderr
        self.assertRegex(said, r"d:\d+: cut short: .* that frame is left out")
        self.assertEqual(len(os.listdir(self.path("p"))), 1)

    def test_hostile_ones_take_little_memory(self):
        most = 700 << 20  # the program itself maps some 300 MB of libraries
        with gzip.open(self.path("bomb.gz"), "wb", 6) as file:  # 1 GB in a line
            file.write(dump_frame(0, "x y z")[:-1].encode())
            for _ in range(128):
                file.write(b" " * (8 << 20))
        self.assertIn("a line of more than", self.call("info", "bomb.gz", status=2, memory=most).stderr)
        head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n%d\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS x y z radius\n0 0 0 1\n"
        for count in (10**9, 2**63, 2**64 - 1):
            self.write("d", head % count)
            self.assertIn("cut short", self.call("render", "d", status=2, memory=most).stderr)
        self.write("d", head % 2**64)
        self.assertIn("not a whole number", self.call("render", "d", status=2).stderr)


class Said(Foreign):
    def test_arrays_that_are_said_are_drawn_like_those_that_are_found(self):
        sizes, speeds, kinds = [0.5, 0.4, 0.3, 0.2], [1, 0, 0, 0, 2, 0, 0, 0, 3, 4, 0, 0], [2, 7, 2, 7]
        self.write("usual.vtk", vtk({"radius": sizes, "velocity": speeds, "type": kinds}))
        self.write("other.vtk", vtk({"size": sizes, "uvw": speeds, "u": speeds[::3], "v": speeds[1::3], "w": speeds[2::3],
                                     "twice": [2 * x for x in sizes], "phase": kinds, "same": [0.25] * 4, "number": [4, 3, 2, 1]}))
        usual = self.picture("usual.vtk")
        for radius, velocity in ((("--radius", "size"), "uvw"), (("--diameter", "twice"), "u,v,w")):
            self.assertTrue(self.picture("other.vtk", *radius, "--velocity", velocity) == usual)
        self.assertTrue(self.picture("other.vtk", "--radius", "size", "--type", "phase", "--color", "type") ==
                        self.picture("usual.vtk", "--color", "type"))
        same = self.picture("other.vtk", "--radius", "same")
        self.assertTrue(self.picture("other.vtk", "--radius", "0.25") == same)
        self.assertTrue(self.picture("other.vtk", "--diameter", "0.5") == same)
        self.picture("other.vtk", "--radius", "size", "--velocity", "u,v", "--arrows")  # a plane's
        self.picture("other.vtk", "--radius", "size", "--velocity", "uvw", "--id", "number", "--camera", "follow:3")

    def test_what_is_not_there_is_told_with_what_is(self):
        self.write("other.vtk", vtk({"size": [1] * 4, "uvw": [0] * 12}))
        self.assertIn("no array of radii or diameters (arrays: size, uvw); say which it is",
                      self.call("render", "other.vtk", status=2).stderr)
        for options, what in ((("--radius", "sise"), 'radius "sise": no such array, did you mean "size"?; arrays: size, uvw'),
                              (("--radius", "uvw"), 'radius "uvw": it has 3 components, expected 1; arrays: size, uvw'),
                              (("--radius", "size", "--velocity", "size"), "it has 1 components, expected 3 or 2"),
                              (("--radius", "-1"), "--radius -1: expected a number > 0"),
                              (("--radius", "1", "--diameter", "size"), "one of them says how large"),
                              (("--radius", "size", "--up", "sideways"), "--up sideways: expected"),
                              (("--radius", "size", "--species", "a,b"), "species: the grains are not coloured by kinds")):
            said = self.call("render", "other.vtk", *options, status=2).stderr
            self.assertIn(what, said)
            self.assertEqual(said.count("\n"), 1)


class Species(Foreign):
    def colours(self, pixels):
        count = collections.Counter(pixels[i:i + 3] for i in range(0, len(pixels), 3))
        return {c: n for c, n in count.items() if max(c) - min(c) > 40}

    def test_each_has_one_colour_in_all_frames_and_stands_in_the_legend(self):
        frame = "%d\nProperties=species:S:1:pos:R:3:radius:R:1\n%s"
        self.write("m.xyz", frame % (2, "Zr 0 0 0 1\nAl 3 0 0 1\n") + frame % (3, "Cu 0 0 0 1\nZr 3 0 0 1\nAl 6 0 0 1\n"))
        bare = [{c for c, n in self.colours(p).items() if n > 400} for p in self.picture("m.xyz", "--bare")]
        self.assertEqual((len(bare[0]), len(bare[1])), (2, 3))
        self.assertTrue(bare[0] < bare[1])
        for picture in self.picture("m.xyz"):  # of the first, the third kind stands in the legend only
            for colour in bare[1]:
                self.assertGreater(self.colours(picture).get(colour, 0), 40)
        self.assertFalse(self.picture("m.xyz") == self.picture("m.xyz", "--species", "Aluminium,Copper,Zircon"))


class View(Foreign):
    def test_one_grain_that_flew_away_does_not_make_all_small(self):
        rows = ["%d %d 0 0.5" % (i % 40, i // 40) for i in range(400)]
        frame = "%d\nProperties=pos:R:3:radius:R:1\n%s\n"
        self.write("whole.xyz", frame % (400, "\n".join(rows)))
        self.write("flown.xyz", frame % (401, "\n".join(rows + ["300 200 0 0.5"])))
        whole, flown = self.picture("whole.xyz")[0], self.picture("flown.xyz")[0]
        self.assertLess(sum(a != b for a, b in zip(whole, flown)), 30)
        said = self.call("render", "flown.xyz", "-o", "again", "--size", "96x96").stderr
        self.assertIn("1 grain (of all frames) out of view; --camera all shows every one", said)
        everything = self.picture("flown.xyz", "--camera", "all")[0]
        self.assertGreater(sum(a != b for a, b in zip(whole, everything)), 10000)

    def test_up_turns_a_plane(self):
        self.write("row.vtk", vtk({"radius": [0.5] * 4}))
        def size(pixels):
            ink = [i for i in range(0, len(pixels), 3) if pixels[i:i + 3] != pixels[:3]]
            xs, ys = [i // 3 % 240 for i in ink], [i // 3 // 240 for i in ink]
            return max(xs) - min(xs), max(ys) - min(ys)
        wide, high = size(self.picture("row.vtk", "--bare")[0])
        self.assertGreater(wide, 2 * high)
        wide, high = size(self.picture("row.vtk", "--bare", "--up", "x")[0])
        self.assertGreater(high, 2 * wide)


class Movies(Foreign):
    def setUp(self):
        super().setUp()
        self.write("m.xyz", "".join("3\nProperties=pos:R:3:radius:R:1 Time=%g\n0 0 0 1\n%g 0 0 1\n9 0 0 1\n" % (0.02 * k, 3 + 0.3 * k)
                                    for k in range(12)))

    def test_every_kind_of_any_size_ends_in_its_ground(self):
        for name, codec, format, sides in (("m.mp4", "h264", "yuv420p", (98, 78)), ("m.webm", "vp9", "yuv420p", (98, 78)),
                                           ("m.mov", "prores", "yuv422p10le", (98, 78)), ("m.gif", "gif", "bgra", (97, 77)),
                                           ("m.png", "apng", "rgba", (97, 77))):
            for background, bright in (("dark", False), ("white", True)):
                self.call("render", "m.xyz", "--movie", name, "--size", "97x77", "--background", background, "--bare", "--quiet")
                found = self.probe(name)
                self.assertEqual((found["codec_name"], int(found["nb_read_frames"])), (codec, 12))
                self.assertEqual((found["width"], found["height"]), sides)
                if codec not in ("gif", "apng"):
                    self.assertEqual(found["pix_fmt"], format)
                width, height = sides
                pixels = self.pixels(self.path(name))[:3 * width * height]
                edge = [pixels[3 * (y * width + x):][:3] for y in range(height) for x in (0, width - 1)]
                edge += [pixels[3 * (y * width + x):][:3] for x in range(width) for y in (0, height - 1)]
                for pixel in edge:
                    self.assertTrue(min(pixel) > 225 if bright else max(pixel) < 45, (name, background, tuple(pixel)))

    def test_colours_survive(self):
        """A grain's colour in the film is that of the picture."""
        self.call("render", "m.xyz", "-o", "p", "--size", "98x78", "--bare", "--frames", "0", "--quiet")
        still = self.pixels(self.path("p", "000000.png"))
        middle = 3 * (98 * 39 + 10)
        for name in ("m.mp4", "m.webm", "m.mov"):
            self.call("render", "m.xyz", "--movie", name, "--size", "98x78", "--bare", "--quiet")
            film = subprocess.run(["ffmpeg", "-v", "error", "-i", self.path(name), "-frames:v", "1", "-vf",
                                   "scale=in_color_matrix=bt709:in_range=tv", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                  capture_output=True, check=True).stdout
            for a, b in zip(still[middle:middle + 3], film[middle:middle + 3]):
                self.assertLess(abs(a - b), 10, name)

    def test_the_same_bytes_again(self):
        for name in ("m.webm", "m.mov"):
            films = []
            for jobs in (1, 3):
                self.call("render", "m.xyz", "--movie", name, "--size", "98x78", "--jobs", jobs, "--quiet")
                with open(self.path(name), "rb") as file:
                    films.append(file.read())
            self.assertEqual(films[0], films[1])

    def test_transparent_prores_has_an_alpha_channel(self):
        self.call("render", "m.xyz", "--movie", "m.mov", "--size", "96x96", "--background", "transparent", "--bare", "--quiet")
        self.assertIn("yuva444p", self.probe("m.mov")["pix_fmt"])

    def test_the_ratio_to_true_time_is_told(self):
        said = self.call("render", "m.xyz", "--movie", "m.mp4", "--size", "96x96", "--fps", 10).stderr
        self.assertIn("a second of the movie is 0.2 in the files' unit of time", said)
        head = "ITEM: UNITS\nsi\n"
        self.write("d", "".join((head if k == 0 else "") + "ITEM: TIME\n%g\n" % (0.01 * k) + dump_frame(k, "x y z", 9) for k in range(6)))
        said = self.call("render", "d", "--movie", "m.mp4", "--size", "96x96", "--fps", 25).stderr
        self.assertIn("a second of the movie is 0.25 s: 4 times slower than true", said)
        said = self.call("render", "d", "--movie", "m.mp4", "--size", "96x96", "--fps", 100).stderr
        self.assertIn("as fast as true", said)
        self.write("d", "".join("ITEM: TIME\n%g\n" % (k * k) + dump_frame(k, "x y z", 9) for k in range(6)))
        said = self.call("render", "d", "--movie", "m.mp4", "--size", "96x96").stderr
        self.assertIn("frames are 1 to 9 apart and shown equally long", said)

    def test_another_ending_is_refused(self):
        self.assertIn("must end in .mp4, .webm, .mov, .gif or .png", self.call("render", "m.xyz", "--movie", "m.avi", status=2).stderr)

    def test_grains_beyond_all_measures_are_told_in_a_line(self):
        rows = "".join("%d 0 0 0.5\n" % i for i in range(5))
        for last in ("1e300 1 1 0.5", "1 1 1 1e200"):
            self.write("far.xyz", "6\nProperties=pos:R:3:radius:R:1\n%s%s\n" % (rows, last))
            said = self.call("render", "far.xyz", "-o", "far", "--size", "160x120", "--quiet", status=1).stderr
            self.assertIn("far.xyz: the picture came out blank: no grain is in view", said)
            self.assertEqual(said.count("\n"), 1)

    def test_a_map_of_rows_that_lie_on_no_grid_is_refused(self):
        rows = "".join("%d,%d,1\n" % (i, i * 7 % 2003) for i in range(2003))
        self.write("t.csv", "a,b,z\n" + rows)
        self.write("m.toml", 'title = "m"\n[data]\ntable = "t.csv"\nx = "a"\ny = "b"\nz = "z"\nseries = "c"\n[[plot.panel]]\n'
                   'x = { label = "$a$" }\ny = { label = "$b$" }\nmap = { series = "c*", filled = 4 }\n')
        said = self.call("figure", "m.toml", "-o", "m", "--quiet", status=2).stderr
        self.assertIn("map: 2003 values of x in 2003 rows make more than 4000000 cells", said)
        self.assertFalse(os.path.exists(self.path("m")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
