"""What quick figures must show that take a minute of a core each, on their CSV: test_costly.py CHUTE, with --long."""
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]


def between(curve, low, high):
    values = [y for x, y, _ in curve if low <= x <= high]
    return sum(values) / len(values)


class Costly(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = Figures(chute, "fig-5-07", "fig-5-08", "fig-b-04", "fig-b-08")

    def test_friction_slows_a_dense_flow(self):
        curves = self.made.curves("fig-5-07")
        # Whether the bed layer is locked shifts v_x of whole runs: the error of three runs says little, and mu = 0.25 and
        # 0.5 are told apart by the shear only.
        smooth, some, rough = ({x: y for x, y, _ in curves["b", "mu=" + mu]} for mu in ("0", "0.25", "0.5"))
        for slow in (some, rough):
            for h in (4.5, 6.5, 8.5):
                self.assertGreater(smooth[h], 1.25 * slow[h], h)
        rate = [(v[8.5] - v[2.5]) / 6 for v in (smooth, some, rough)]
        self.assertGreater(rate[0], 1.3 * rate[1])
        self.assertGreater(rate[1], rate[2])
        for series in ("mu=0", "mu=0.25", "mu=0.5"):
            eta = {x: y for x, y, _ in curves["a", series]}
            for h in (2.5, 4.5, 6.5):
                self.assertGreater(eta[h], 0.65, series)
                self.assertLess(eta[h], 0.9069, series)

    def test_spin_is_half_the_shear_rate_but_in_the_top_layer(self):
        curves = self.made.curves("fig-5-08")
        for mu in ("0.25", "0.5"):
            omega, shear = curves["", "omega mu=" + mu], curves["", "shear mu=" + mu]
            self.assertAlmostEqual(between(omega, 2, 9) / between(shear, 2, 9), 1, delta=0.12, msg=mu)
            self.assertGreater(between(omega, 10.4, 10.6), 1.5 * between(shear, 10.4, 10.6), mu)

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

    def test_energy_is_carried_down_to_where_contacts_take_it(self):
        curves = self.made.curves("fig-b-08")
        for panel in "cd":
            gravity, carried, taken = (curves[panel, name] for name in ("gravity", "carried", "dissipation"))
            self.assertAlmostEqual(sum(y for _, y, _ in carried), 0, delta=0.01 * sum(abs(y) for _, y, _ in carried))
            self.assertGreater(between(carried, 0, 4), 3 * carried[0][2])
            self.assertLess(between(carried, 7, 10), 0)
            self.assertLess(between(gravity, 0, 4), between(taken, 0, 4))
            self.assertGreater(between(gravity, 7, 10), between(taken, 7, 10))
        total = {panel: [sum(y for _, y, _ in curves[panel, name]) for name in ("gravity", "dissipation")] for panel in "cd"}
        self.assertGreater(total["c"][0], total["c"][1], "a flow that starts gains")
        self.assertLess(total["d"][0], total["d"][1], "a flow that stops loses")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
