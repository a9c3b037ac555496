"""Runs a tiny scene with chute and reads its files with VTK's own Python package: read_run.py CHUTE SCENE.

Exit status 77 where the package is missing."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

try:
    import vtk
except ImportError:
    print("python3-vtk9 is not installed")
    sys.exit(77)

chute, scene = sys.argv[1:]
failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print("FAILED:", what)


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    check(reader.GetErrorCode() == 0, path + " is readable")
    return reader.GetOutput()


def names(data):
    return {data.GetArrayName(i): data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())}


def check_field_data(data, path):
    fields = names(data.GetFieldData())
    check(fields["units"].GetValue(0) == "reduced", path + ": units")
    domain = [fields["domain"].GetComponent(k, 0) for k in range(6)]
    check(domain == [0, 10, 0, 0, 0, 0], path + ": domain is the line, periodic along x only: %s" % domain)
    gravity = [fields["gravity"].GetComponent(k, 0) for k in range(3)]
    truth = [math.sin(math.radians(18)), -math.cos(math.radians(18)), 0]
    check(all(abs(a - b) < 1e-12 for a, b in zip(gravity, truth)), path + ": gravity %s" % gravity)
    return fields


with tempfile.TemporaryDirectory() as folder:
    run = os.path.join(folder, "run")
    settings = ["grains.count=20", "bed.count=10", "run.duration=8", "contact.normal.stiffness=1e5",
                "contact.tangential.viscosity=100", "output.frames={every=2}", "output.series={every=1}",
                "output.impacts={from=2}", "output.contacts=true", "output.profiles={from=4, bin=1.0}"]
    command = [chute, "run", scene, "-o", run, "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, "the run: " + done.stderr)
    check(done.stderr == "" and done.stdout == "", "--quiet says nothing: %r %r" % (done.stdout, done.stderr))

    index = xml.parse(os.path.join(run, "frames.pvd")).getroot()
    entries = index.findall("./Collection/DataSet")
    check(index.get("type") == "Collection" and len(entries) == 5, "frames.pvd names 5 frames")
    dt = json.load(open(os.path.join(run, "run.json")))["time_step"]
    touching = 0
    for k, entry in enumerate(entries):
        path = os.path.join(run, entry.get("file"))
        data = read(path)
        check(data.GetNumberOfPoints() == 30, path + ": 20 grains and 10 of the bed")
        check(data.GetNumberOfVerts() == 30, path + ": a vertex each")
        arrays = names(data.GetPointData())
        wanted = {"id": 1, "type": 1, "radius": 1, "mass": 1, "velocity": 3, "angular_velocity": 3,
                  "force": 3, "angle": 1, "material": 1}
        shapes = {name: a.GetNumberOfComponents() for name, a in arrays.items()}
        check(shapes == wanted, path + ": arrays %s" % shapes)
        check([arrays["type"].GetValue(i) for i in range(30)] == [1] * 20 + [0] * 10, path + ": type")
        check([arrays["id"].GetValue(i) for i in range(30)] == list(range(30)), path + ": id")
        for i in range(30):
            r = arrays["radius"].GetValue(i)
            check(abs(arrays["mass"].GetValue(i) - (2 * r) ** 3) < 1e-12, path + ": m = d³ in reduced units")
            check(arrays["velocity"].GetComponent(i, 2) == 0, path + ": 2D grains stay in the plane")
            if i >= 20:
                check(data.GetPoint(i) == (0.5 + i - 20, 0, 0), path + ": the bed is a row")
        fields = check_field_data(data, path)
        time = fields["TimeValue"].GetValue(0)
        check(abs(time - 2 * k) <= dt and abs(float(entry.get("timestep")) - time) < 1e-12, path + ": time")

        network = read(os.path.join(run, "contacts", os.path.basename(path)))
        check_field_data(network, path + " (contacts)")
        cells = names(network.GetCellData())
        check(set(cells) == {"a", "b", "point", "normal", "branch", "overlap", "force", "normal_force", "shear_force",
                             "state"}, path + ": contacts' arrays")
        touching += network.GetNumberOfLines()
        for c in range(network.GetNumberOfLines()):
            ends = network.GetCell(c).GetPoints()
            length = math.dist(ends.GetPoint(0), ends.GetPoint(1))
            check(0.5 < length < 1.3, path + ": a contact is as long as two radii, got %g" % length)
            check(0 < cells["overlap"].GetValue(c) < 0.25, path + ": overlap")
    check(touching > 0, "some frame has contacts")

    impacts = read(os.path.join(run, "impacts.vtp"))
    check_field_data(impacts, "impacts.vtp")
    arrays = names(impacts.GetPointData())
    check(set(arrays) == {"time", "gamma", "phi", "v_n", "v_t", "flight", "gamma_before", "rolling",
                          "bead", "grain"}, "impacts' arrays")
    check(impacts.GetNumberOfPoints() > 10, "some impacts")
    last = 0
    for i in range(impacts.GetNumberOfPoints()):
        now = arrays["time"].GetValue(i)
        check(2 <= now + dt and now <= 8 + dt and now >= last, "impacts are in order of time, from 2 on")
        last = now
        check(0 <= arrays["grain"].GetValue(i) < 20, "a moving grain hits")
        v_n = arrays["v_n"].GetValue(i)
        check(v_n < 0, "impacts approach: v_n = %g at t = %g" % (v_n, now))

    for name in ("series.csv", "profiles.csv"):
        text = open(os.path.join(run, name)).read()
        check("nan" not in text.lower() and "inf" not in text.lower(), name + " has no nan")
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        check(len(rows) >= 2 and all(None not in row.values() for row in rows), name + ": rows are complete")
        if name == "series.csv":
            check(len(rows) == 9, "series.csv: t = 0 … 8")
            for row in rows:
                row = {key: float(value) for key, value in row.items()}
                stored = sum(row[c] - float(rows[0][c]) for c in ("translation", "rotation", "elastic"))
                left = row["gravity_work"] - stored - row["normal_loss"] - row["shear_loss"]
                check(abs(left - row["residual"]) < 1e-8, "series.csv: the balance adds up")

print("%d failures" % len(failures))
sys.exit(1 if failures else 0)
