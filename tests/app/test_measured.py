"""What `chute measure` tells of frames, against sums by hand: test_measured.py CHUTE. Spheres of several sizes and masses at
random places of a box that repeats in all directions; every number has its definition written out here."""
import collections
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

chute = os.path.abspath(sys.argv[1])
SIDE, EVERY, COUNT, FRAMES = 6.0, 0.5, 120, 5
SPECIES = {0.2 + 0.05 * k: name for k, name in enumerate("ABC")}  # by radius


def frames():
    """Of each grain place, radius, velocity, mass."""
    some = random.Random(3)
    return [[([some.uniform(0, SIDE) for _ in range(3)], 0.2 + 0.05 * (i % 3), [some.gauss(1 + f / 4, 0.5), some.gauss(0, 0.7), some.gauss(0, 0.2)],
              1 + 0.5 * (i % 4)) for i in range(COUNT)] for f in range(FRAMES)]


def table(path):
    """Columns by their names, empty values as None."""
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split(",") for line in file if line[0] != "#"]
    return [dict(zip(lines[0], (float(x) if x and x[0] in "-.0123456789" else x or None for x in line))) for line in lines[1:]]


class Measured(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.frames = frames()
        with open(os.path.join(cls.folder, "g.xyz"), "w", encoding="utf-8") as file:
            for f, grains in enumerate(cls.frames):
                file.write('%d\nLattice="%g 0 0 0 %g 0 0 0 %g" Properties=species:S:1:pos:R:3:radius:R:1:vel:R:3:mass:R:1 pbc="T T T" '
                           "Time=%g\n" % (COUNT, SIDE, SIDE, SIDE, EVERY * f))
                for place, radius, velocity, mass in grains:
                    file.write("%s %s\n" % (SPECIES[radius], " ".join("%.17g" % x for x in (*place, radius, *velocity, mass))))
        done = subprocess.run([chute, "measure", "g.xyz", "-o", "out", "--only", "pairs", "velocities", "moments", "series", "profiles", "segregation", "--set", "segregation.bin=1.5",
                               "--set", "pairs.bin=0.05", "--set", "pairs.reach=3", "--set", "velocities.bin=0.25", "--set", "profiles.bin=1.5",
                               "--quiet"], cwd=cls.folder, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr)

    def table(self, name):
        return table(os.path.join(self.folder, "out", name))

    def near(self, found, expected, what=""):
        self.assertAlmostEqual(found, expected, delta=1e-9 * (1 + abs(expected)), msg=what)

    def test_series(self):
        """x counts on through the periods: from frame to frame grains go the shorter way."""
        x, before = 0, None
        for row, grains in zip(self.table("series.csv"), self.frames):
            mean = [sum(v[k] for _, _, v, _ in grains) / COUNT for k in range(3)]
            for k, name in enumerate("xyz"):
                self.near(row["v_" + name], mean[k])
            self.near(row["translation"], sum(0.5 * m * sum(u * u for u in v) for _, _, v, m in grains))
            if before is None:
                x = sum(place[0] for place, _, _, _ in grains) / COUNT
            else:
                ways = [now[0][0] - then[0][0] for now, then in zip(grains, before)]
                x += sum(way - SIDE * round(way / SIDE) for way in ways) / COUNT
            self.near(row["x"], x)
            before = grains

    def test_moments(self):
        """m c² about the mean velocity over D; a_2 = <(m c²)²> D / ((D + 2) <m c²>²) − 1."""
        rows = self.table("moments.csv")
        self.assertEqual(len(rows), FRAMES)
        for row, grains in zip(rows, self.frames):
            mean = [sum(v[k] for _, _, v, _ in grains) / COUNT for k in range(3)]
            squares = [m * sum((v[k] - mean[k]) ** 2 for k in range(3)) for _, _, v, m in grains]
            second, fourth = sum(squares) / COUNT, sum(s * s for s in squares) / COUNT
            self.near(row["temperature"], second / 3)
            self.near(row["a_2"], 3 * fourth / (5 * second ** 2) - 1)

    def test_velocity_histograms(self):
        """Of the samples that are told, all but those at the time of `from` itself."""
        rows = self.table("velocity_histograms.csv")
        samples = [(row["v_x"], row["v_y"], row["v_z"]) for row in self.table("velocities.csv")]
        everything = {tuple(round(u, 12) for u in v) for grains in self.frames for _, _, v, _ in grains}
        self.assertGreaterEqual(len(samples), (FRAMES - 1) * COUNT)
        self.assertTrue({tuple(round(u, 12) for u in v) for v in samples} <= everything)
        for k, name in enumerate("xyz"):
            counts = collections.Counter(math.floor(v[k] / 0.25) for v in samples)
            found = {row["v"]: row["density"] for row in rows if row["component"] == name}
            self.assertEqual(len(found), len(counts))
            for bin, count in counts.items():
                self.near(found[(bin + 0.5) * 0.25], count / (len(samples) * 0.25), name)

    def test_species(self):
        """2 (mean part of all volume below one's centre − that of all others), by volume; layers of volume and velocity."""
        for row, grains in zip(self.table("segregation.csv"), self.frames, strict=True):
            grains = sorted((place[2], R) for place, R, _, _ in grains)
            whole, below, parts = sum(R ** 3 for _, R in grains), 0, []
            for _, R in grains:
                parts.append((R, R ** 3, (below + R ** 3 / 2) / whole))
                below += R ** 3
            for size, name in SPECIES.items():
                mine, others = ([(v, u) for R, v, u in parts if (R == size) == own] for own in (True, False))
                ways = [sum(v * u for v, u in some) / sum(v for v, _ in some) for some in (mine, others)]
                self.near(row["index_" + name], 2 * (ways[0] - ways[1]), name)
                heights = [z for z, R in grains if R == size]
                self.near(row["height_" + name], sum(heights) / len(heights), name)
        for row in self.table("species.csv"):
            for size, name in SPECIES.items():
                inside = [v for grains in self.frames for p, R, v, _ in grains if R == size and abs(p[2] - row["h"]) < 0.75]
                self.near(row["grains_" + name], len(inside) / FRAMES, name)
                self.near(row["eta_" + name], len(inside) / FRAMES * 4 / 3 * math.pi * size ** 3 / (1.5 * SIDE ** 2), name)
                self.near(row["v_x_" + name], sum(v[0] for v in inside) / len(inside), name)

    def test_pairs(self):
        """g: pairs in a shell over those of grains that do not know of each other, N(N − 1)/2 (4/3)π(R_i + R_j)³(high³ − low³)/V."""
        width, bins = 0.05, 40
        counts, expected = [0] * bins, [0.0] * bins
        for grains in self.frames:
            near = []
            for i, (p, R, _, _) in enumerate(grains):
                for q, S, _, _ in grains[:i]:
                    way = [a - b - SIDE * round((a - b) / SIDE) for a, b in zip(p, q)]
                    near.append(math.sqrt(sum(w * w for w in way)) / (R + S))
            radii = [R for _, R, _, _ in grains]
            # the sizes of two grains that are drawn apart
            shells = COUNT * (COUNT - 1) / 2 * sum((R + S) ** 3 for R in radii for S in radii) / COUNT ** 2
            for r in near:
                if 1 <= r < 3:
                    counts[min(bins - 1, int((r - 1) / width))] += 1
            for b in range(bins):
                low = 1 + b * width
                expected[b] += shells * 4 / 3 * math.pi * ((low + width) ** 3 - low ** 3) / SIDE ** 3
        rows = self.table("pairs.csv")
        self.assertEqual(len(rows), bins)
        for b, row in enumerate(rows):
            self.near(row["r"], 1 + (b + 0.5) * width)
            self.near(row["g"], counts[b] / expected[b], row["r"])
        pressure, = self.table("pressure.csv")
        phi = sum(4 / 3 * math.pi * R ** 3 for _, R, _, _ in self.frames[-1]) / SIDE ** 3
        self.near(pressure["phi"], phi)
        self.near(pressure["Z"], 1 + 4 * phi * pressure["g_contact"])

    def test_profiles(self):
        """Means of a layer over grains and times; sigma² = <v²> − <v>²; of all layers together eta_exact is the volume of the grains."""
        layer = collections.defaultdict(list)
        for grains in self.frames:
            for grain in grains:
                layer[math.floor(grain[0][2] / 1.5)].append(grain)
        rows = self.table("profiles.csv")
        for b, there in layer.items():
            row = rows[b]
            self.near(row["h"], (b + 0.5) * 1.5)
            self.near(row["grains"], len(there) / FRAMES)
            self.near(row["eta"], sum(4 / 3 * math.pi * R ** 3 for _, R, _, _ in there) / (FRAMES * SIDE ** 2 * 1.5))
            squares = 0
            for k, name in enumerate("xyz"):
                mean = sum(v[k] for _, _, v, _ in there) / len(there)
                square = sum((v[k] - mean) ** 2 for _, _, v, _ in there) / len(there)
                self.near(row["v_" + name], mean)
                self.near(row["sigma_" + name], math.sqrt(square))
                squares += square
            self.near(row["temperature"], squares / 3)
        inside = [(h, R) for grains in self.frames for (_, _, h), R, _, _ in grains]
        expected = sum(4 / 3 * math.pi * R ** 3 - (math.pi * (R - h) ** 2 * (2 * R + h) / 3 if h < R else 0) for h, R in inside)
        self.near(sum(row["eta_exact"] for row in rows) * 1.5 * SIDE ** 2 * FRAMES, expected)


class Heaps(unittest.TestCase):
    """Heaps with sides of known slopes, in the plane and in space."""

    def slopes(self, grains, flat, *settings):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "heap.xyz"), "w", encoding="utf-8") as file:
                file.write("%d\nProperties=species:S:1:pos:R:3:radius:R:1 Time=0\n" % len(grains))
                for x, across, up in grains:
                    file.write("A %.17g %.17g %.17g 0.5\n" % ((x, up, 0) if flat else (x, across, up)))
            done = subprocess.run([chute, "measure", "heap.xyz", "-o", "out", "--only", "surface", "--set", "surface.bin=1", *settings,
                                   "--quiet"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return table(os.path.join(folder, "out", "slopes.csv"))[0], table(os.path.join(folder, "out", "surface.csv"))

    def heap(self, across=(0,)):
        """The surface is at 10 - 0.5 (20 - x) on the left, 10 - 0.25 (x - 20) on the right, below it grains, and one far away."""
        grains = []
        for k in range(62):
            x = k + 0.5
            top = 10 - (0.5 * (20.5 - x) if x < 20.5 else 0.25 * (x - 20.5))
            for y in across:
                grains += [(x, y, top - 0.5 - depth) for depth in range(3) if top - 0.5 - depth > 0]
        return grains + [(90.5, across[0], 0.5)]

    def test_slopes_of_both_sides(self):
        for flat, across in ((True, (0,)), (False, (0.5, 1.5, 2.5))):
            slopes, surface = self.slopes(self.heap(across), flat)
            self.assertAlmostEqual(slopes["angle_left"], math.degrees(math.atan(0.5)), places=9)
            self.assertAlmostEqual(slopes["angle_right"], math.degrees(math.atan(0.25)), places=9)
            self.assertAlmostEqual(slopes["height"], 10)
            self.assertAlmostEqual(slopes["top"], 20.5)
            heights = {row["x"]: row["height"] for row in surface}
            self.assertAlmostEqual(heights[15.5], 7.5)
            self.assertIsNone(heights[70.5])  # nothing lies there
            self.assertEqual(max(heights), 90.5)

    def test_the_mean_across_and_the_range_that_counts(self):
        slopes, surface = self.slopes(self.heap((0.5, 1.5)) + [(32.5, 0.5, 7.5)], False)
        self.assertAlmostEqual({row["x"]: row["height"] for row in surface}[32.5], (8 + 7) / 2)
        self.assertNotAlmostEqual(slopes["angle_right"], math.degrees(math.atan(0.25)), places=3)
        low, _ = self.slopes(self.heap((0.5, 1.5)) + [(32.5, 0.5, 7.5)], False, "--set", "surface.high=0.7")
        self.assertAlmostEqual(low["angle_right"], math.degrees(math.atan(0.25)), places=9)  # the bump is higher

    def test_a_wall_or_a_single_grain_has_no_slope(self):
        one_sided, _ = self.slopes([g for g in self.heap() if g[0] > 20], True)
        self.assertIsNone(one_sided["angle_left"])
        self.assertAlmostEqual(one_sided["angle_right"], math.degrees(math.atan(0.25)), places=9)
        alone, _ = self.slopes([(3.5, 0, 0.5)], True)
        self.assertIsNone(alone["angle_right"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
