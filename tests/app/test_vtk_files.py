"""Files that VTK's own writers make: test_vtk_files.py CHUTE [NUMBER]. Grains on a lattice in every kind of data set, as every
combination of format that the writers know, with arrays of every type beside them: each must be drawn, and all pictures are the
same. Exit status 77 without VTK's Python package."""
import itertools
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

chute = os.path.abspath(sys.argv[1])
wanted = int(sys.argv[2]) if len(sys.argv) > 2 else 160
try:
    import vtk
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

SIDES = (4, 3, 2)
PLACES = [(float(x), float(y), float(z)) for z in range(SIDES[2]) for y in range(SIDES[1]) for x in range(SIDES[0])]
TYPES = ("Char", "SignedChar", "UnsignedChar", "Short", "UnsignedShort", "Int", "UnsignedInt", "Long", "UnsignedLong", "LongLong",
         "UnsignedLongLong", "Float", "Double", "IdType", "Bit", "String")


def array(kind, name, values, components=1):
    made = getattr(vtk, "vtk%sArray" % kind)()
    made.SetName(name)
    made.SetNumberOfComponents(components)
    made.SetNumberOfTuples(len(values) // components)
    for i, value in enumerate(values):
        made.SetValue(i, value)
    return made


def points(double):
    made = vtk.vtkPoints()
    made.SetDataTypeToDouble() if double else made.SetDataTypeToFloat()
    for place in PLACES:
        made.InsertNextPoint(place)
    return made


def fill(data, some, double, extra=True):
    """The arrays that are drawn, and some that are not."""
    number = "Double" if double else "Float"
    kinds = data.GetPointData()
    kinds.AddArray(array(number, "radius", [0.25 + 0.0625 * (i % 3) for i in range(len(PLACES))]))
    kinds.AddArray(array(number, "velocity", [0.5 * (i % 7) for i in range(3 * len(PLACES))], 3))
    if extra:
        for kind in some.sample(TYPES, 3):
            values = [i % 2 for i in range(len(PLACES))]
            if kind == "String":
                values = ["t %d" % i for i in values]
            if kind == "Char":
                values = ["AB"[i] for i in values]
            kinds.AddArray(array(kind, "of " + kind, values))
        kinds.AddArray(array(number, "tensor", [0.5] * (9 * len(PLACES)), 9))
        if some.random() < 0.5:
            kinds.SetActiveScalars("radius")
            kinds.SetActiveVectors("velocity")
    data.GetFieldData().AddArray(array("Double", "TimeValue", [1.5]))
    return data


def poly_data(some, double, extra=True):
    made = vtk.vtkPolyData()
    made.SetPoints(points(double))
    if some.random() < 0.7:
        cells = vtk.vtkCellArray()
        for i in range(len(PLACES)):
            cells.InsertNextCell(1, [i])
        made.SetVerts(cells)
    if some.random() < 0.3:
        lines = vtk.vtkCellArray()
        lines.InsertNextCell(3, [0, 1, 2])
        made.SetLines(lines)
    return fill(made, some, double, extra)


def unstructured(some, double):
    made = vtk.vtkUnstructuredGrid()
    made.SetPoints(points(double))
    for i in range(len(PLACES)):
        made.InsertNextCell(vtk.VTK_VERTEX, 1, [i])
    if some.random() < 0.3:
        made.InsertNextCell(vtk.VTK_TETRA, 4, [0, 1, 4, 12])
    return fill(made, some, double)


def structured(some, double):
    made = vtk.vtkStructuredGrid()
    made.SetDimensions(*SIDES)
    made.SetPoints(points(double))
    return fill(made, some, double)


def rectilinear(some, double):
    made = vtk.vtkRectilinearGrid()
    made.SetDimensions(*SIDES)
    for name, side in zip("XYZ", SIDES):
        getattr(made, "Set%sCoordinates" % name)(array("Double" if double else "Float", name, [float(i) for i in range(side)]))
    return fill(made, some, double)


def multi_block(some, double):
    made = vtk.vtkMultiBlockDataSet()
    made.SetBlock(0, poly_data(some, double, extra=False))
    empty = vtk.vtkPolyData()
    made.SetBlock(1, empty)
    if some.random() < 0.5:
        outer = vtk.vtkMultiBlockDataSet()
        outer.SetBlock(0, made)
        return outer
    return made


KINDS = (("vtp", poly_data, "PolyData"), ("vtu", unstructured, "UnstructuredGrid"), ("vts", structured, "StructuredGrid"),
         ("vtr", rectilinear, "RectilinearGrid"), ("vtm", multi_block, "MultiBlockData"))
COMPRESSORS = (None, "ZLib", "LZ4", "LZMA")
XML = list(itertools.product(KINDS, ("Ascii", "Binary", "Appended"), (False, True), COMPRESSORS, ("Little", "Big"), (32, 64), (False, True)))
LEGACY = [(kind, binary, version, double) for kind in KINDS[:4] for binary in (False, True) for version in (42, 51)
          for double in (False, True)]


def write_xml(path, some, kind, mode, raw, compressor, order, header, double):
    extension, make, name = kind
    writer = getattr(vtk, "vtkXML%sWriter" % name)()
    writer.SetFileName(path + "." + extension)
    writer.SetInputData(make(some, double))
    getattr(writer, "SetDataModeTo" + mode)()
    writer.SetEncodeAppendedData(not raw)
    writer.SetCompressor(getattr(vtk, "vtk%sDataCompressor" % compressor)() if compressor else None)
    writer.SetBlockSize(some.choice((64, 4096, 32768)))
    getattr(writer, "SetByteOrderTo%sEndian" % order)()
    getattr(writer, "SetHeaderTypeToUInt%d" % header)()
    if not writer.Write():
        raise RuntimeError("VTK does not write " + path)


def write_legacy(path, some, kind, binary, version, double):
    writer = getattr(vtk, "vtk%sWriter" % kind[2])()
    writer.SetFileName(path + ".vtk")
    writer.SetInputData(kind[1](some, double))
    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    writer.SetFileVersion(version)
    if not writer.Write():
        raise RuntimeError("VTK does not write " + path)


class Pieces(VTKPythonAlgorithmBase):
    """What a parallel writer asks for piece by piece: parts as they are, or of a whole grid what lies in an extent."""
    def __init__(self, kind, parts, whole=None):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=kind)
        self.parts, self.whole = parts, whole

    def RequestInformation(self, request, inputs, outputs):
        info, pipeline = outputs.GetInformationObject(0), vtk.vtkStreamingDemandDrivenPipeline
        if self.whole:
            info.Set(pipeline.WHOLE_EXTENT(), self.whole.GetExtent(), 6)
            info.Set(vtk.vtkDataObject.ORIGIN(), self.whole.GetOrigin(), 3)
            info.Set(vtk.vtkDataObject.SPACING(), self.whole.GetSpacing(), 3)
            info.Set(vtk.vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        else:
            info.Set(vtk.vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        info, pipeline = outputs.GetInformationObject(0), vtk.vtkStreamingDemandDrivenPipeline
        made = vtk.vtkDataObject.GetData(outputs)
        if self.whole:
            made.ShallowCopy(self.whole)
            made.Crop([info.Get(pipeline.UPDATE_EXTENT(), k) for k in range(6)])
        else:
            made.ShallowCopy(self.parts[info.Get(pipeline.UPDATE_PIECE_NUMBER())])
        return 1


def write_pieces(path, name, source, count, ghosts=0):
    writer = getattr(vtk, "vtkXMLP%sWriter" % name)()
    writer.SetFileName(path)
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetNumberOfPieces(count), writer.SetStartPiece(0), writer.SetEndPiece(count - 1), writer.SetGhostLevel(ghosts)
    if not writer.Write():
        raise RuntimeError("VTK does not write " + path)


def write_one(path, name, data):
    writer = getattr(vtk, "vtkXML%sWriter" % name)()
    writer.SetFileName(path)
    writer.SetInputData(data)
    if not writer.Write():
        raise RuntimeError("VTK does not write " + path)


def grid(factor=1):
    """Fields of cells and of points, which tell each place from all others."""
    made = vtk.vtkImageData()
    made.SetDimensions(9, 6, 1), made.SetOrigin(1, 2, 0), made.SetSpacing(0.5, 0.25, 1)
    made.GetCellData().AddArray(array("Double", "eta", [factor * i ** 1.5 for i in range(8 * 5)]))
    made.GetCellData().AddArray(array("Float", "flow", [i % 17 for i in range(3 * 8 * 5)], 3))
    made.GetPointData().AddArray(array("Double", "height", [50 - i for i in range(9 * 6)]))
    made.GetFieldData().AddArray(array("Double", "TimeValue", [1.5]))
    return made


def network(pairs, forces):
    """Contacts of the grains in PLACES, as lines."""
    made, lines = vtk.vtkPolyData(), vtk.vtkCellArray()
    made.SetPoints(points(True))
    for pair in pairs:
        lines.InsertNextCell(2, pair)
    made.SetLines(lines)
    made.GetCellData().AddArray(array("Double", "force", forces))
    return made


class Written(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def draw(self, source, output):
        return subprocess.run([chute, "render", source, "-o", output, "--size", "64x64", "--bare", "--range", "0:3", "--quiet"],
                              capture_output=True, text=True)

    def test_each_is_drawn_and_all_alike(self):
        some = random.Random(9)
        jobs = [(write_xml, job) for job in XML] + [(write_legacy, job) for job in LEGACY]
        some.shuffle(jobs)
        if wanted < len(jobs):  # a sample that has every kind of data set in every format
            jobs.sort(key=lambda job: 0)
            seen, first, rest = set(), [], []
            for writer, job in jobs:
                key = (writer.__name__, job[0][0], job[1], job[2])
                (rest if key in seen else first).append((writer, job))
                seen.add(key)
            jobs = (first + rest)[:max(wanted, len(first))]
        reference, count = None, 0
        for batch in range(0, wanted, 100):
            chosen = [jobs[i % len(jobs)] for i in range(batch, min(batch + 100, max(wanted, len(jobs))))]
            for k, (writer, job) in enumerate(chosen):
                # a folder each: blocks and pieces lie beside their index
                os.mkdir(os.path.join(self.folder, "%03d" % k))
                writer(os.path.join(self.folder, "%03d" % k, "f"), some, *job)
            entries = []
            for k in range(len(chosen)):
                name = [n for n in sorted(os.listdir(os.path.join(self.folder, "%03d" % k))) if n.startswith("f.")][0]
                entries.append('<DataSet timestep="%d" file="%03d/%s"/>' % (k, k, name))
            index = os.path.join(self.folder, "all.pvd")
            with open(index, "w") as file:
                file.write('<?xml version="1.0"?><VTKFile type="Collection"><Collection>%s</Collection></VTKFile>' % "".join(entries))
            pictures = os.path.join(self.folder, "pictures")
            done = self.draw(index, pictures)
            self.assertEqual(done.returncode, 0, done.stderr)
            for k in range(len(chosen)):
                with open(os.path.join(pictures, "%06d.png" % k), "rb") as file:
                    pixels = file.read().split(b"IDAT", 1)[1]
                reference = reference or pixels
                self.assertEqual(pixels == reference, True, (chosen[k], entries[k]))
                count += 1
            shutil.rmtree(self.folder), os.mkdir(self.folder)
        print("%d files" % count)

    def call(self, *words, status=0):
        done = subprocess.run([chute, *words], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def pixels(self, source, *options):
        self.call("render", source, "-o", "p", "--size", "640x480", *options)
        with open(os.path.join(self.folder, "p", "000000.png"), "rb") as file:
            pixels = file.read().split(b"IDAT", 1)[1]
        shutil.rmtree(os.path.join(self.folder, "p"))
        return pixels

    def told(self, source):
        found = json.loads(self.call("info", source, "--json").stdout)
        del found["file"]
        return found

    def test_a_grid_in_pieces_is_the_whole_grid(self):
        """With seams that pieces share, and with cells that they repeat; what changes in a piece is drawn anew."""
        write_one(os.path.join(self.folder, "whole.vti"), "ImageData", grid())
        told = self.told("whole.vti")
        self.assertEqual((told["points"], told["cells"], told["grid"], told["x"], told["y"]), (54, 40, [9, 6, 1], [1, 5], [2, 3.25]))
        fields = ("eta", "height", "flow:y")
        pictures = [self.pixels("whole.vti", "--color", field) for field in fields]
        self.assertEqual(len(set(pictures)), 3)
        for ghosts in (0, 1):
            os.mkdir(os.path.join(self.folder, "g%d" % ghosts))
            index = "g%d/f.pvti" % ghosts
            write_pieces(os.path.join(self.folder, index), "ImageData", Pieces("vtkImageData", None, grid()), 4, ghosts)
            with open(os.path.join(self.folder, index)) as file:
                self.assertEqual(len(set(line.split("Source")[0] for line in file if "<Piece" in line)), 4)
            self.assertEqual(self.told(index), told)
            for source in (index, os.path.dirname(index)):  # in a folder the pieces are no frames
                self.assertEqual([self.pixels(source, "--color", field) for field in fields], pictures)
        write_pieces(os.path.join(self.folder, index), "ImageData", Pieces("vtkImageData", None, grid(-1)), 4)
        self.assertNotEqual(self.pixels(index, "--color", "eta"), pictures[0])
        os.remove(os.path.join(self.folder, "g1", "f_2.vti"))
        for words in (("info", index), ("render", index, "-o", "p")):
            said = self.call(*words, status=2).stderr
            self.assertEqual((said.count("\n"), said[:17]), (1, "chute: g1/f.pvti:"), said)

    def test_contacts_in_parts_are_one_network(self):
        pairs = [(i, i + 1) for i in range(len(PLACES) - 1) if i % SIDES[0] < SIDES[0] - 1]
        forces = [1.0 + i % 5 for i in range(len(pairs))]
        cuts = (0, 7, 7, 12, len(pairs))  # one part has none
        parts = [network(pairs[a:b], forces[a:b]) for a, b in zip(cuts, cuts[1:])]
        path = lambda name: os.path.join(self.folder, name)
        write_one(path("grains.vtp"), "PolyData", poly_data(random.Random(1), True, extra=False))
        write_one(path("whole.vtp"), "PolyData", network(pairs, forces))
        write_pieces(path("pieces.pvtp"), "PolyData", Pieces("vtkPolyData", parts), len(parts))
        blocks = vtk.vtkMultiBlockDataSet()
        for k, part in enumerate(parts):
            blocks.SetBlock(k, part)
            write_one(path("part%d.vtp" % k), "PolyData", part)
        blocks.SetBlock(len(parts), poly_data(random.Random(1), True, extra=False))  # grains beside the contacts
        write_one(path("blocks.vtm"), "MultiBlockData", blocks)
        with open(path("parts.pvd"), "w") as file:
            file.write('<VTKFile type="Collection"><Collection>%s</Collection></VTKFile>' %
                       "".join('<DataSet timestep="0" part="%d" file="part%d.vtp"/>' % (k, k) for k in range(len(parts))))
        for name, some in [("whole", range(len(pairs)))] + [("local.%d" % k, range(a, b)) for k, (a, b) in enumerate(zip(cuts, cuts[1:]))]:
            with open(path(name), "w") as file:
                file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n%d\nITEM: ENTRIES x1 y1 z1 x2 y2 z2 force\n" % len(some))
                for i in some:
                    file.write("%g %g %g %g %g %g %g\n" % (*PLACES[pairs[i][0]], *PLACES[pairs[i][1]], forces[i]))
        drawn = lambda contacts: self.pixels("grains.vtp", "--opacity", "0.3", "--contacts", contacts)
        whole = drawn("whole.vtp")
        self.assertNotEqual(drawn("part0.vtp"), whole)
        for contacts in ("pieces.pvtp", "blocks.vtm", "parts.pvd", "whole", "local.%"):
            self.assertTrue(drawn(contacts) == whole, contacts)
        self.assertIn("give 'local.%'", self.call("render", "grains.vtp", "-o", "p", "--contacts", "local.*", status=2).stderr)
        again = lambda: self.call("render", "grains.vtp", "-o", "p", "--size", "96x96", "--contacts", "pieces.pvtp").stderr
        again()
        self.assertNotIn("1 frame drawn", again())
        write_one(path("pieces_3.vtp"), "PolyData", network(pairs[12:], [9.0] * len(pairs[12:])))
        self.assertIn("1 frame drawn", again())
        strange = network(pairs[12:], forces[12:])
        strange.GetCellData().GetArray(0).SetName("strength")
        write_one(path("pieces_3.vtp"), "PolyData", strange)
        self.assertIn("no array \"normal_force\" or \"force\"",
                      self.call("render", "grains.vtp", "-o", "p", "--contacts", "pieces.pvtp", status=2).stderr)

    def test_a_damaged_file_ends_nothing(self):
        """What ends VTK's own readers, or makes them ask for all memory, is a line and exit status 2."""
        some = random.Random(2)
        originals = []
        for job in ((KINDS[2], "Appended", True, "ZLib", "Little", 32, True), (KINDS[3], "Binary", False, None, "Little", 64, False)):
            write_xml(os.path.join(self.folder, "x"), some, *job)
            originals.append(os.path.join(self.folder, "x." + job[0][0]))
        for binary in (False, True):
            write_legacy(os.path.join(self.folder, "l%d" % binary), some, KINDS[2], binary, 42, True)
            originals.append(os.path.join(self.folder, "l%d.vtk" % binary))
        refused = 0
        for trial in range(24 if wanted < 1000 else 2000):
            with open(originals[trial % 4], "rb") as file:
                data = bytearray(file.read())
            if trial % 3 == 0:
                del data[some.randrange(len(data)):]
            for _ in range(trial % 6):
                if data:
                    data[some.randrange(len(data))] = some.randrange(256)
            if trial % 8 == 1:
                data = data.replace(b"DIMENSIONS 4 3 2", b"DIMENSIONS 40000 30000 20000").replace(b'"0 3 0 2 0 1"', b'"0 9999 0 9999 0 9999"')
            name = "d" + os.path.splitext(originals[trial % 4])[1]
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(data)
            done = subprocess.run([chute, "info", os.path.join(self.folder, name)], capture_output=True, text=True,
                                  errors="replace")
            self.assertIn(done.returncode, (0, 2), done.stderr)
            if done.returncode == 2:
                refused += 1
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertGreater(refused, 5)

class Cells(Written):
    def test_fields_of_cells_are_sums_over_their_grains(self):
        """Grains of several masses and speeds in three cells of 2 x 3 x 4, against sums by hand."""
        some, side, count = random.Random(5), (2.0, 3.0, 4.0), 40
        places = [[side[k] * ((i % 3 if k == 0 else 0) + some.uniform(0.1, 0.9)) for k in range(3)] for i in range(count)]
        masses = [some.uniform(1, 3) for _ in range(count)]
        speeds = [[some.gauss(k + i % 3, 1 + k) for k in range(3)] for i in range(count)]
        spins = [[some.gauss(0, 1) for _ in range(3)] for _ in range(count)]
        radii = [some.uniform(0.05, 0.1) for _ in range(count)]
        frame, at = vtk.vtkPolyData(), vtk.vtkPoints()
        at.SetDataTypeToDouble()
        for place in places:
            at.InsertNextPoint(place)
        frame.SetPoints(at)
        for name, values, components in (("radius", radii, 1), ("mass", masses, 1), ("velocity", sum(speeds, []), 3), ("spin", sum(spins, []), 3)):
            frame.GetPointData().AddArray(array("Double", name, values, components))
        frame.GetFieldData().AddArray(array("Double", "TimeValue", [1.5]))
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetInputData(frame)
        writer.SetFileName(os.path.join(self.folder, "grains.vtp"))
        writer.Write()
        done = subprocess.run([chute, "measure", "grains.vtp", "-o", "out", "--only", "cells", "--set", "cells.width_x=2", "--set",
                               "cells.width=12", "--spin", "spin", "--quiet"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(os.path.join(self.folder, "out", "cells", "000000.vti"))
        reader.Update()
        cells = reader.GetOutput()
        fields, volume = cells.GetCellData(), 2 * 12 * 12
        self.assertEqual(cells.GetNumberOfCells(), 3)
        for c in range(3):
            there = range(c, count, 3)
            mass = sum(masses[i] for i in there)
            mean = [sum(masses[i] * speeds[i][k] for i in there) / mass for k in range(3)]

            def excess(k, l):
                return sum(masses[i] * (speeds[i][k] - mean[k]) * (speeds[i][l] - mean[l]) for i in there)
            expected = {"number": [len(there)], "density": [mass / volume], "velocity": mean,
                        "packing_fraction": [sum(4 / 3 * math.pi * radii[i] ** 3 for i in there) / volume],
                        "temperature": [sum(excess(k, k) for k in range(3)) / (3 * len(there))],
                        "temperature_rotation": [sum(0.4 * masses[i] * radii[i] ** 2 * w * w for i in there for w in spins[i]) / (3 * len(there))],
                        "kinetic_stress": [excess(k, l) / volume for k, l in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]}
            for name, values in expected.items():
                found = fields.GetArray(name).GetTuple(c)
                self.assertEqual(len(found), len(values), name)
                for a, b in zip(found, values):
                    self.assertAlmostEqual(a, b, delta=1e-9 * (1 + abs(b)), msg=name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
