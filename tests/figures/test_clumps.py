"""What figures of grains that are not round must show, on the CSV of the quick ones: test_clumps.py CHUTE."""
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]


class Clumps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Figures(chute, "fig-b-09", "fig-b-11")

    def test_free_top(self):
        curves = self.made.curves("fig-b-11")
        self.assertGreater(len(curves["d", "chute"]), 100)
        self.assertLess(max(off for _, off, _ in curves["d", "chute"]), 1e-8)
        for panel in "abc":
            exact = {t: spin for t, spin, _ in curves[panel, "jacobi"]}
            self.assertGreater(max(exact.values()) - min(exact.values()), 0.3)
            for t, spin, _ in curves[panel, "chute"]:
                self.assertAlmostEqual(spin, exact[t], delta=1e-8)

    def test_elongated_grains_hold_steeper(self):
        curves = self.made.curves("fig-b-09")
        for kind, least in (("discs", 4), ("spheres", 3)):
            angles = {aspect: angle for aspect, angle, _ in curves["a", kind]}
            self.assertEqual(sorted(angles), [1, 1.5, 3])
            self.assertGreater(angles[3] - angles[1], least, "%s: %s" % (kind, angles))
            self.assertGreater(angles[1.5] - angles[1], least, "%s: %s" % (kind, angles))
        repose = {aspect: angle for aspect, angle, _ in curves["c", "discs"]}
        self.assertGreater(repose[3] - repose[1], 5, repose)
        # At rest with friction: more contacts than the least that hold grains, and in 3D more between rods than between spheres.
        touched = {kind: {aspect: z for aspect, z, _ in curves["b", kind]} for kind in ("discs", "spheres")}
        for z in touched["discs"].values():
            self.assertTrue(2.7 < z < 4.2, touched)
        self.assertGreater(touched["spheres"][3] - touched["spheres"][1], 0.3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
