"""What figures beyond the thesis must show, on the CSV of the quick ones: test_beyond.py CHUTE."""
import sys
import unittest

from figure_csv import QuickFigures

chute = sys.argv[1]


class Beyond(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = QuickFigures(chute, "fig-b-04", "fig-b-15")

    def test_plane_shear_follows_da_cruz(self):
        curves = self.made.curves("fig-b-04")
        for panel, law, apart, mean_apart in (("a", lambda I: 0.25 + 1.1 * I, 0.08, 0.03), ("b", lambda I: 0.81 - 0.3 * I, 0.02, 0.006)):
            points = curves[panel, "chute"]
            self.assertEqual(len(points), 12)
            # Three densities span a range of I in which the law changes by far more than points may lie off it.
            self.assertGreater(max(x for x, _, _ in points) - min(x for x, _, _ in points), 0.06)
            off = [y - law(x) for x, y, _ in points]
            self.assertLess(max(map(abs, off)), apart, "panel " + panel)
            self.assertLess(abs(sum(off) / len(off)), mean_apart, "panel " + panel)

    def test_beyond_the_steady_state(self):
        curves = self.made.curves("fig-b-15")
        for name, steady in (("ball", (0.05, 0.12)), ("layer", (0.2, 0.36))):
            points = curves["", name]
            for (x, y, _), (u, v, _) in zip(points, points[1:]):
                self.assertGreater(v, y, "%s: %g at sin = %g, %g at %g" % (name, y, x, v, u))
            for x, y, _ in points:
                self.assertEqual(y > 0, x > steady[1], "%s: %g at sin = %g" % (name, y, x))
        # What bounces from bead to bead and turns with them gains as a ball that rolls: 5/7 of g sin θ, less a constant.
        ball = [(x, y) for x, y, _ in curves["", "ball"] if x > 0.12]
        slope = (ball[-1][1] - ball[0][1]) / (ball[-1][0] - ball[0][0])
        self.assertLess(abs(slope - 5 / 7), 0.05)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
