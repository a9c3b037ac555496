"""contact_problem as a user meets it: test_program.py PROGRAM SOURCE. Exit status, what it says, what it writes.

The files of other programs are used where the folder shared/fclib lies beside the checkout, or CHUTE_FCLIB names one."""
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

program, source = sys.argv[1:3]
fclib = os.environ.get("CHUTE_FCLIB", os.path.join(source, "..", "shared", "fclib"))
DONE, FAILED, WRONG = 0, 1, 2
PLANAR = "2\n1\n0\n2\n2\n2 2\n1 0\n0 1\n-1 %s\n0.5\n"


def run(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=300)


def residual_of_planar(path, r):
    """The natural map of a planar file, W in blocks or dense, from its numbers alone."""
    with open(path) as file:
        words = iter(file.read().split())
    integer = lambda: int(next(words))
    number = lambda: float(next(words))
    assert integer() == 2
    m = integer()
    if integer() == 0:
        assert [integer() for _ in range(4)] == 4 * [2 * m]
        dense = [[number() for _ in range(2 * m)] for _ in range(2 * m)]  # row by row
        starts, columns = [m * i for i in range(m + 1)], [k for _ in range(m) for k in range(m)]
        values = [[dense[2 * i][2 * k], dense[2 * i + 1][2 * k], dense[2 * i][2 * k + 1], dense[2 * i + 1][2 * k + 1]]
                  for i in range(m) for k in range(m)]
    else:
        integer(), integer()
        blocks = integer()
        for _ in range(2 + 2 * m + 2):
            integer()
        starts = [integer() for _ in range(m + 1)]
        columns = [integer() for _ in range(blocks)]
        values = []
        for _ in range(blocks):
            integer()
            values.append([number() for _ in range(4)])
    q = [float(next(words)) for _ in range(2 * m)]
    mu = [float(next(words)) for _ in range(m)]
    above = below = 0
    for i in range(m):
        u = q[2 * i:2 * i + 2]
        for b in range(starts[i], starts[i + 1]):
            w, x = values[b], r[2 * columns[b]:2 * columns[b] + 2]
            u = [u[0] + w[0] * x[0] + w[2] * x[1], u[1] + w[1] * x[0] + w[3] * x[1]]
            if columns[b] == i:
                rho = 2 / (w[0] + w[3])
        n, t = r[2 * i] - rho * (u[0] + mu[i] * abs(u[1])), r[2 * i + 1] - rho * u[1]
        if mu[i] * abs(t) <= -n:
            p = 0, 0
        elif abs(t) <= mu[i] * n:
            p = n, t
        else:
            edge = (n + mu[i] * abs(t)) / (1 + mu[i] ** 2)
            p = edge, math.copysign(mu[i] * edge, t)
        above += (r[2 * i] - p[0]) ** 2 + (r[2 * i + 1] - p[1]) ** 2
        below += rho ** 2 * (q[2 * i] ** 2 + q[2 * i + 1] ** 2)
    return math.sqrt(above / below)


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, content):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)
        return path

    def solve(self, path, *options):
        out = os.path.join(self.folder.name, "r.txt")
        result = run(path, *options, "-o", out)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertEqual(result.stderr, "")
        residual = float(re.search(r"residual (\S+),", result.stdout).group(1))
        with open(out, encoding="utf-8") as file:
            return residual, [float(line) for line in file]

    def test_one_contact_sticks_slides_and_opens(self):
        for solver in ("nsgs", "exact"):
            for q, r in (("0.3", [1, -0.3]), ("3", [1, -0.5]), ("-3", [1, 0.5])):
                residual, got = self.solve(self.file("p.dat", PLANAR % q), "--solver", solver)
                self.assertLess(residual, 1e-8)
                for a, b in zip(got, r, strict=True):
                    self.assertAlmostEqual(a, b, places=12)
            _, got = self.solve(self.file("p.dat", (PLANAR % "1").replace("-1", "1")), "--solver", solver)
            self.assertEqual(got, [0, 0])

    def test_errors_are_one_line_and_have_their_status(self):
        good = self.file("good.dat", PLANAR % "1")
        for arguments, status in (((), WRONG), (("missing.dat",), WRONG), ((self.folder.name,), WRONG),
                                  ((good, "--solver", "magic"), WRONG), ((good, "--tolerance", "0"), WRONG),
                                  ((good, "--tolerance", "nan"), WRONG), ((good, "--iterations", "0"), WRONG),
                                  ((good, "--threads", "0"), WRONG), ((good, "more"), WRONG),
                                  ((self.file("half.dat", (PLANAR % "1")[:20]),), WRONG),
                                  ((self.file("nan.dat", PLANAR % "nan"),), WRONG),
                                  ((self.file("bad.hdf5", "\x89HDF\r\n\x1a\n"),), WRONG),
                                  ((good, "-o", "/nowhere/r.txt"), FAILED)):
            result = run(*arguments)
            self.assertEqual(result.returncode, status, (arguments, result.stderr))
            self.assertRegex(result.stderr, r"^contact_problem: [^\n]+\n$")

    def test_what_does_not_converge_fails_and_writes_nothing(self):
        size = 30  # a stack from the top: each contact feels its neighbours
        rows = [[2 if i == j else -1 if abs(i - j) == 2 else 0 for j in range(2 * size)] for i in range(2 * size)]
        text = "2\n%d\n0\n%d\n%d\n%d %d\n" % (size, 2 * size, 2 * size, 2 * size, 2 * size)
        text += "\n".join(" ".join(map(str, row)) for row in rows) + "\n"
        text += " ".join("-1 0" if i == 0 else "0 0" for i in range(size)) + "\n" + " ".join(["0.5"] * size) + "\n"
        path, out = self.file("stack.dat", text), os.path.join(self.folder.name, "none.txt")
        result = run(path, "--iterations", "3", "-o", out)
        self.assertEqual(result.returncode, FAILED)
        self.assertRegex(result.stderr, r"^contact_problem: [^\n]*the residual is [^\n]+\n$")
        self.assertFalse(os.path.exists(out))
        _, fast = self.solve(path, "--tolerance", "1e-12")
        _, slow = self.solve(path, "--solver", "exact")
        for a, b in zip(fast, slow, strict=True):
            self.assertAlmostEqual(a, b, places=9)

    def test_threads_give_the_same_bytes(self):
        path = self.file("p.dat", PLANAR % "0.7")
        self.assertEqual(self.solve(path, "--threads", "1"), self.solve(path, "--threads", "3"))

    @unittest.skipUnless(os.path.isdir(fclib), "no folder shared/fclib beside the checkout")
    def test_problems_of_others(self):
        names = [name for name in sorted(os.listdir(fclib)) if name.endswith((".dat", ".hdf5"))]
        self.assertGreater(len(names), 4)
        for name in names:
            residual, r = self.solve(os.path.join(fclib, name), "--tolerance", "1e-8")
            self.assertLessEqual(residual, 1e-8, name)
            if re.fullmatch(r"FrictionContactProblem\d+\.dat", name):
                self.assertLess(residual_of_planar(os.path.join(fclib, name), r), 1.01e-8, name)


unittest.main(argv=sys.argv[:1])
