"""What figures of gases by chance and of automata must show, on the CSV of the quick ones: test_by_chance.py CHUTE."""
import math
import os
import sys
import unittest

from figure_csv import Figures, interpolate

chute = sys.argv[1]


class ByChance(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Figures(chute, "fig-m-09", "fig-m-10", "fig-m-11", "fig-m-15", "fig-m-16")

    def test_heads_tell_a_restitution_only_of_methods_that_have_one(self):
        told = {}
        for figure in ("fig-m-09", "fig-m-10"):  # Monte Carlo; dsmc and event, both with gravity
            with open(os.path.join(self.made.folder, figure + ".csv"), encoding="utf-8") as file:
                told[figure] = " ".join(line for line in file if line.startswith("# parameters"))
        self.assertIn("theta=0deg", told["fig-m-09"])
        self.assertNotIn("e_n=", told["fig-m-09"])
        self.assertIn("e_n=", told["fig-m-10"])

    def test_rice_pile(self):
        curves = self.made.curves("fig-m-16")
        for L, mean, error in curves["c", "mean"]:
            self.assertLess(abs(mean / L - 1), 0.05, "the mean avalanche of L = %g is %g" % (L, mean))
        # Collapse: curves of the longest piles lie on each other where neither the smallest sizes nor the cut-off rule.
        long, longer = curves["b", "L=128"], curves["b", "L=256"]
        for x in (0.003, 0.01, 0.03, 0.1):
            a, b = interpolate(long, x), interpolate(longer, x)
            self.assertLess(abs(math.log(a / b)), 0.35, "at s/L^2.25 = %g: %g and %g" % (x, a, b))
        # Without the collapse the largest avalanches differ by 2^2.25 = 4.8.
        ends = [max(s for s, _, _ in curves["a", "L=%d" % L]) for L in (64, 128, 256)]
        for small, large in zip(ends, ends[1:]):
            self.assertGreater(large / small, 3)
            self.assertLess(large / small, 7.5)

    def test_pipe(self):
        curves = self.made.curves("fig-m-15")
        rows = [c for (panel, _), c in curves.items() if panel == "a"]
        self.assertGreater(len(rows), 100)
        # Waves travel downhill: what is here now is there later. The correlation of rows 200 updates apart, by the shift.
        def correlation(shift):
            sums = [0, 0]
            for early, late in zip(rows, rows[10:]):
                n = len(early)
                means = [sum(y for _, y, _ in row) / n for row in (early, late)]
                a = [y - means[0] for _, y, _ in early]
                b = [y - means[1] for _, y, _ in late]
                sums[0] += sum(a[i] * b[(i + shift) % n] for i in range(n))
                sums[1] += math.sqrt(sum(v * v for v in a) * sum(v * v for v in b))
            return sums[0] / sums[1]

        by_shift = {shift: correlation(shift) for shift in range(-30, 31)}
        best = max((s for s in by_shift if s != 0), key=by_shift.get)
        self.assertGreater(best, 0)
        self.assertGreater(by_shift[best], 0.1, "best shift %d" % best)
        # The spectrum falls with a power, published near 4/3, over the decade from 1e-4 on.
        decade = [(math.log(x), math.log(y)) for x, y, _ in curves["b", "spectrum"] if 1e-4 < x < 1e-3]
        mx, my = (sum(v) / len(decade) for v in zip(*decade))
        slope = sum((x - mx) * (y - my) for x, y in decade) / sum((x - mx) ** 2 for x, _ in decade)
        self.assertLess(slope, -0.8)
        self.assertGreater(slope, -1.8)

    def test_profiles_agree(self):
        """Where the gas is dilute both methods have the same profiles."""
        for figure, heights in (("fig-m-10", (5, 11, 21, 31)), ("fig-m-11", (2.5, 4.5, 6.5))):
            curves = self.made.curves(figure)
            for panel, near in (("a", 0.25), ("b", 0.2)):
                event, dsmc = curves[panel, "event"], curves[panel, "dsmc"]
                for h in heights:
                    a, b = interpolate(event, h), interpolate(dsmc, h)
                    self.assertLess(abs(a / b - 1), near, "%s %s at h = %g: event %g, dsmc %g" % (figure, panel, h, a, b))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
