"""What figures of hard grains must show, on the CSV of the quick ones: test_hard_grains.py CHUTE."""
import math
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]


class HardGrains(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Figures(chute, "fig-m-02", "fig-m-03", "fig-m-06")

    def test_cooling(self):
        """While the gas is homogeneous it cools by Haff's law, and the exact methods cool alike."""
        curves = self.made.curves("fig-m-02")
        for method in ("event", "hybrid", "dsmc"):
            for x, y, _ in curves["a", method]:
                if x < 1.1:  # a quick gas is small
                    self.assertLess(abs(y / (1 + x) - 1), 0.06, "%s at t/tau = %g: %g" % (method, x, y))
        for x, y, _ in curves["a", "event"]:
            if x > 3.5:
                continue
            other = dict((round(t, 6), v) for t, v, _ in curves["a", "hybrid"])[round(x, 6)]
            self.assertLess(abs(y / other - 1), 0.03, "event %g, hybrid %g at t/tau = %g" % (y, other, x))
        for method in ("event", "hybrid"):
            late = [y for x, y, _ in curves["b", method] if 0.4 < x < 4]
            self.assertLess(abs(sum(late) / len(late) + 0.0269), 0.015, method)

    def test_two_frictions(self):
        """Between mu_d and mu_s a block at rest stays and a pushed one slides; a ball has two accelerations, too."""
        curves = self.made.curves("fig-m-03")
        slides = lambda x: (x - 0.3) / math.sqrt(1 + x * x)
        rolls = lambda x: x / 1.4 / math.sqrt(1 + x * x)
        for panel, unit, held in (("a", 1, lambda x: 0), ("b", 3.5, rolls)):
            for start, mu in (("from rest", 0.5), ("pushed", 0.3)):
                points = curves[panel, "contact " + start]
                self.assertGreater(len(points), 6)
                for x, a, _ in points:
                    expected = held(x) if x < unit * mu else slides(x)
                    self.assertLess(abs(a - expected), 1e-3, "%s %s at tan theta = %g" % (panel, start, x))

    def test_network(self):
        """The floor bears what weighs, and forces grow with depth along chains."""
        curves = self.made.curves("fig-m-06")
        place, branch, force = (curves["", name] for name in ("network", "branch", "force"))
        self.assertEqual(len(place), len(force))
        self.assertEqual(len(branch), len(force))
        floor = sum(f for (_, y, _), (_, f, _) in zip(place, force) if y < 1e-2)
        self.assertGreater(floor, 700)  # the walls bear the rest by friction
        self.assertLess(floor, 1030)
        mean = lambda low, high: sum(f for f, y in deep if low < y < high) / sum(low < y < high for _, y in deep)
        deep = [(f, y) for (_, y, _), (_, f, _) in zip(place, force)]
        self.assertGreater(mean(2, 6), 2 * mean(18, 22))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
