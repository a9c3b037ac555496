"""What the thesis says that a reader must see in the figures of 4.2 that are made from sweeps, on their CSV:
test_sweeps.py CHUTE (see figure_csv.py). Where it does not come out, the test holds what does, and says so."""
import math
import sys
import unittest

from figure_csv import Figures, interpolate

chute = sys.argv[1]
FIGURES = ["fig-4-05", "fig-4-06", "fig-4-07", "fig-4-14", "fig-4-15", "fig-4-16", "fig-4-17", "fig-4-18", "fig-4-20"]
made = None


def setUpModule():
    global made
    made = Figures(chute, *FIGURES)


def curves(figure):
    """Without the fits that are drawn through them, and without the places where starts part."""
    return {(panel, name): curve for (panel, name), curve in made.curves(figure).items()
            if not name.endswith((" fit", " apart"))}


def against(curve, reference):
    """(x, relative deviation from the reference) wherever that exists."""
    pairs = ((x, y, interpolate(reference, x)) for x, y, _ in curve)
    return [(x, y / r - 1) for x, y, r in pairs if r]


def straightness(points):
    """Correlation coefficient."""
    n = len(points)
    mx, my = sum(p[0] for p in points) / n, sum(p[1] for p in points) / n
    xy = sum((p[0] - mx) * (p[1] - my) for p in points)
    return xy / math.sqrt(sum((p[0] - mx) ** 2 for p in points) * sum((p[1] - my) ** 2 for p in points))


class Sweeps(unittest.TestCase):
    def test_4_05_growth_jump_and_plateau(self):
        c = curves("fig-4-05")
        for (_, series), curve in c.items():
            with self.subTest(series):
                self.assertGreater(curve[0][1], 0.05)  # an offset: nothing rolls slower
                for (_, v, _), (_, w, _) in zip(curve[:5], curve[1:5]):
                    self.assertGreater(w, v)
        # larger balls are faster at the same inclination
        for slow, fast in (("1.5", "2"), ("2", "2.5"), ("2.5", "3")):
            for x, ratio in against(c["", "Phi=" + fast][:5], c["", "Phi=" + slow]):
                self.assertGreater(ratio, 0.1, (fast, x))
        # behind the jump v_x stays where it is
        top = [v for x, v, _ in c["", "Phi=1.5"] if x > 0.16]
        self.assertLess(max(top) / min(top), 1.15)
        before = interpolate(c["", "Phi=1.5"], 0.135)
        self.assertGreater(min(top), 1.2 * before)

    def test_4_06_straight_lines(self):
        c = curves("fig-4-06")
        for (panel, series), curve in c.items():
            with self.subTest(panel + " " + series):
                self.assertGreater(straightness([p for p in curve if p[0] < 0.095]), 0.99)
        for x, deviation in against(c["b", "eps_max=0.2"], c["b", "eps=0.1"]):
            if 0.055 < x < 0.11:
                self.assertLess(abs(deviation), 0.15, x)  # disorder rolls like order with the mean gap

    def test_4_07_phases(self):
        c = curves("fig-4-07")
        for name in ("eps=0", "eps=0.1", "eps=0.2", "eps_max=0.2"):
            below, above = c["", "AB " + name], c["", "BC " + name]
            self.assertEqual(len(below), len(above), name)
            for (_, ab, _), (_, bc, _) in zip(below, above):
                self.assertLess(ab, bc, name)
            for line in (below, above):  # larger balls pass, and run away, earlier
                self.assertEqual([y for _, y, _ in line], sorted((y for _, y, _ in line), reverse=True))
        # wider gaps stop earlier; disorder lies between its mean gap and its largest
        for k in range(len(c["", "AB eps=0"])):
            ab = [c["", "AB " + name][k][1] for name in ("eps=0", "eps=0.1", "eps_max=0.2", "eps=0.2")]
            self.assertEqual(ab, sorted(ab))

    def test_4_14_one_curve_for_all_restitutions(self):
        c = curves("fig-4-14")
        best = c["", "e_n=0.4"]
        for name, worst in (("e_n=0.5", 0.06), ("e_n=0.6", 0.12), ("e_n=0.8", 0.35)):
            for x, deviation in against(c["", name], best):
                if 0.04 < x < 0.08:  # behind it e_n = 0.8 has jumped
                    self.assertLess(deviation, 0.01, (name, x))  # velocity falls slightly with e_n
                    self.assertGreater(deviation, -worst, (name, x))
        steepest = {name: max(x for x, _, _ in curve) for (_, name), curve in c.items()}
        self.assertGreater(steepest["e_n=0.4"], steepest["e_n=0.6"])  # the range grows as e_n falls
        self.assertGreater(steepest["e_n=0.6"], steepest["e_n=0.8"])

    def test_4_15_friction_hardly_matters_and_the_ball_rolls(self):
        c = curves("fig-4-15")
        rough = {x: v for x, v, _ in c["a", "mu=1.0"] if x < 0.09}
        self.assertGreater(len(rough), 3)
        for mu in ("0.1", "0.3", "0.5", "0.7"):
            same = {x: v for x, v, _ in c["a", "mu=" + mu]}
            for x, v in rough.items():
                self.assertAlmostEqual(same[x], v, delta=0.02 * v, msg=mu)
        # the thesis has a = b. The arc that it rolls on is 1.7 % longer than the line; the rest it slips in bounces
        spin = {x: w for x, w, _ in c["b", "mu=1.0"]}
        for x, v in rough.items():
            self.assertGreater(spin[x] / v, 1.03)
            self.assertLess(spin[x] / v, 1.07)

    def test_4_16_without_rotation_friction_counts(self):
        c = curves("fig-4-16")
        lowest = [min(x for x, _, _ in c["", f"mu={mu} e_n=0.3"]) for mu in ("0", "0.13", "0.25", "0.53")]
        for low, high in zip(lowest, lowest[1:]):
            self.assertGreater(high, low + 0.08)
        for x, deviation in against(c["", "rotating"], c["", "mu=0 e_n=0.7"]):
            if 0.055 < x < 0.12:  # not where it just gets over the beads
                self.assertLess(abs(deviation), 0.25, x)  # without friction it slides as it would roll, nearly

    def test_4_17_theory_from_above(self):
        c = curves("fig-4-17")
        for phi, e_n, low, high, worst in (("1.75", "0.1", 0.06, 0.25, 0.035), ("2.25", "0.1", 0.05, 0.22, 0.03),
                                           ("3", "0.1", 0.03, 0.16, 0.045), ("2.25", "0.5", 0.05, 0.11, 0.05),
                                           ("3", "0.5", 0.03, 0.09, 0.04), ("3", "0.7", 0.03, 0.06, 0.065)):
            with self.subTest(phi + " " + e_n):
                deviations = [d for x, d in against(c["", f"e_n={e_n} Phi={phi}"], c["", "theory corrected Phi=" + phi])
                              if low < x < high]
                self.assertGreater(len(deviations), 1)
                self.assertLess(max(deviations), 0)
                self.assertGreater(min(deviations), -worst)
        # the printed closed form is 2 to 5 % higher still
        for x, ratio in against(c["", "theory Phi=2.25"], c["", "theory corrected Phi=2.25"]):
            if 0.045 < x < 0.22:
                self.assertGreater(ratio, 0.02, x)
                self.assertLess(ratio, 0.08, x)

    def test_4_18_disorder_is_close_too(self):
        c = curves("fig-4-18")
        for series in ("eps_max=0.2 e_n=0.1", "eps_max=0.2 e_n=0.7", "eps=0.1 e_n=0.7"):
            for x, deviation in against(c["", series], c["", "theory corrected"]):
                if x > 0.03:
                    self.assertLess(deviation, 0.01, (series, x))
                    self.assertGreater(deviation, -0.13, (series, x))

    def test_4_20_theory_is_a_lower_bound(self):
        # within the bracket of the bisection; short quick runs let a heavy ball pass that stops later
        c = curves("fig-4-20")
        for panel in "ab":
            for series in ("e_n=0.1", "e_n=0.7"):
                for x, deviation in against(c[panel, series], c[panel, "theory corrected"]):
                    if x < 3.5:
                        self.assertGreater(deviation, 0, (panel, series, x))
        ratio = dict(against(c["a", "e_n=0.1"], c["a", "theory corrected"]))
        self.assertLess(ratio[1.5], 0.05)


unittest.main(argv=sys.argv[:1])
