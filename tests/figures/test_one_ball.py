"""What the thesis says that a reader must see in the figures of one ball on a line (4.2), on their
CSV: test_one_ball.py CHUTE (see figure_csv.py)."""
import math
import random
import statistics
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]
FIGURES = ["fig-4-08", "fig-4-09", "fig-4-10", "fig-4-11", "fig-4-12", "fig-4-13", "fig-4-21", "fig-4-22"]
made = None


def setUpModule():
    global made
    made = Figures(chute, *FIGURES)


def curves(figure):
    return made.curves(figure)


def gamma_max(size_ratio, gap=0):
    return math.asin((1 + gap) / (1 + size_ratio))  # (4.21)


def moments(histogram, low, high):
    """Weight, mean and standard deviation of the part of a histogram between two angles."""
    part = [(x, y) for x, y, _ in histogram if low < x < high]
    weight = sum(y for _, y in part)
    mean = sum(x * y for x, y in part) / weight
    return weight, mean, math.sqrt(sum((x - mean) ** 2 * y for x, y in part) / weight)


def local_scatter(points, neighbours=16):
    """Median over the points of the scatter of their neighbours across the line through these."""
    across = []
    for x, y in points:
        near = sorted(points, key=lambda p: (p[0] - x) ** 2 + (p[1] - y) ** 2)[:neighbours]
        mx, my = (statistics.fmean(p[k] for p in near) for k in (0, 1))
        xx, yy = (statistics.fmean((p[k] - m) ** 2 for p in near) for k, m in ((0, mx), (1, my)))
        xy = statistics.fmean((p[0] - mx) * (p[1] - my) for p in near)
        root = math.hypot((xx - yy) / 2, xy)
        across.append(math.sqrt(max(0.0, (xx + yy) / 2 - root)))
    return statistics.median(across)


def slope(points):
    """Of the least-squares line of y against x."""
    mx, my = (statistics.fmean(p[k] for p in points) for k in (0, 1))
    return sum((p[0] - mx) * (p[1] - my) for p in points) / sum((p[0] - mx) ** 2 for p in points)


class OneBall(unittest.TestCase):
    def test_4_21_no_terminal_velocity(self):
        """In region C v_x grows without end, and v_z rises and falls on the way up."""
        c = curves("fig-4-21")
        for panel, sine in (("a", 0.15), ("b", 0.3)):
            v_x, v_z = c[panel, "v_x"], c[panel, "v_z"]
            self.assertEqual(len(v_x), len(v_z))
            self.assertGreater(len(v_x), 30)
            for part in ([p for p in v_x if p[0] < 10], [p for p in v_x if p[0] >= 10]):
                self.assertGreater(slope(part), 0.03 * 9.81 * sine)
            self.assertLess(slope(v_x), 9.81 * sine)
            self.assertGreater(slope(v_z), 0)
            steps = [(before[1], after[1]) for before, after in zip(v_z, v_z[1:])]
            self.assertGreater(sum(after < before for before, after in steps), len(v_z) / 4)
            self.assertGreater(sum(after > 1.5 * before for before, after in steps), 3)

    def test_4_08_clusters(self):
        c, most = curves("fig-4-08"), gamma_max(4)
        v_n, v_t = c["", "v_n"], c["", "v_t"]
        self.assertGreater(len(v_n), 1000)
        first = [v for gamma, v, _ in v_n if gamma < -most + 0.02]
        last = [v for gamma, v, _ in v_n if gamma > most - 0.01]
        middle = [v for gamma, v, _ in v_n if abs(gamma) < 0.1]
        self.assertGreater(statistics.median(first), 1.3 * statistics.median(middle))
        self.assertLess(statistics.median(last), 0.3 * statistics.median(first))
        self.assertLess(min(last), 0.03 * statistics.median(first))
        # a quarter of the uphill side is never hit
        hit = {int((gamma + most) / most * 20) for gamma, _, _ in v_n if gamma < 0}
        self.assertGreaterEqual(20 - len(hit), 5)
        # the translation along the bead is almost the ball's whole velocity
        self.assertGreater(min(v for _, v, _ in v_t), max(v for _, v, _ in v_n))

    def test_4_09_flights_are_short(self):
        flights, most = curves("fig-4-09")["", "tau"], gamma_max(4)
        v_x = statistics.mean(v for _, v, _ in curves("fig-4-08")["", "v_t"])
        ways = [v_x * tau for _, tau, _ in flights]
        self.assertLess(statistics.median(ways), 3e-3)
        self.assertLess(max(ways), 2 * 5e-3 * 0.7)  # always less than a bead: several impacts on each
        longest = max(flights, key=lambda f: f[1])
        self.assertLess(longest[0], -most + 0.04)
        # the ball arrives at gamma_max in touch
        self.assertEqual(statistics.median(tau for gamma, tau, _ in flights if gamma > 0.98 * most), 0)

    def test_4_10_peaks(self):
        c, most = curves("fig-4-10"), gamma_max(2.5)
        width = {}
        for panel in "abcd":
            histogram = c[panel, "gamma"]
            bin_width = histogram[1][0] - histogram[0][0]
            self.assertAlmostEqual(sum(y for _, y, _ in histogram) * bin_width, 1, places=6)
            uphill = max(y for x, y, _ in histogram if x < -most + 0.06)
            if panel in "abc":  # in a every peak is as sharp as a bin
                self.assertGreaterEqual(uphill * 1.01, max(y for _, y, _ in histogram))
            width[panel] = moments(histogram, -0.3, -most + 0.09)[2]
        self.assertLess(width["a"], 1.1 * bin_width)
        self.assertLess(1.5 * width["b"], width["c"])
        self.assertLess(1.3 * width["c"], width["d"])
        # closer to AB the distribution breaks off before gamma_max: the ball rolls from there on
        self.assertEqual(sum(y for x, y, _ in c["a", "gamma"] if x > 0.75 * most), 0)
        self.assertGreater(moments(c["b", "gamma"], 0, 0.3)[0], moments(c["b", "gamma"], -0.3, 0)[0])

    def test_4_11_peaks_move_towards_zero(self):
        c = curves("fig-4-11")
        self.assertEqual(sorted(series for _, series in c), ["peak %d" % k for k in range(1, 6)])
        for k in range(1, 6):
            peak = c["", "peak %d" % k]
            self.assertGreater(len(peak), 5)
            for (_, before, _), (_, after, _) in zip(peak, peak[1:]):
                self.assertLess(before, after)
            self.assertLess(peak[0][1], 0)
        widths = [error for _, _, error in c["", "peak 1"]]
        self.assertGreater(widths[-1], 10 * widths[0])

    def test_4_12_a_curve_not_a_cloud(self):
        thick = {}
        for panel in "ab":
            points = [(x, y) for x, y, _ in curves("fig-4-12")[panel, "return"]][-1000:]
            self.assertEqual(len(points), 1000)
            following = [y for _, y in points]
            random.Random(1).shuffle(following)
            cloud = local_scatter([(x, y) for (x, _), y in zip(points, following)])
            thick[panel] = local_scatter(points)
            print("fig-4-12 %s: points scatter by %.2g rad across the line through their neighbours; %.2g rad without "
                  "correlation" % (panel, thick[panel], cloud))
            self.assertLess(3.5 * thick[panel], cloud)
        self.assertGreater(thick["b"], 1.3 * thick["a"])  # b is a smeared a

    def test_4_13_disorder_lies_between(self):
        c = curves("fig-4-13")
        first = {panel: moments(c[panel, "gamma"], -0.27, low)[1]
                 for panel, low in zip("abcd", (-0.03, -0.08, -0.15, -0.08))}
        self.assertLess(first["c"], first["b"] - 0.03)
        self.assertLess(first["b"], first["a"] - 0.03)
        self.assertAlmostEqual(first["b"], first["d"], delta=0.006)
        second = {panel: moments(c[panel, "gamma"], -0.07, 0.035) for panel in "bd"}
        self.assertAlmostEqual(second["b"][1], second["d"][1], delta=0.01)
        self.assertGreater(second["b"][2], second["d"][2])  # disorder smears the peaks

    def test_4_22_terminal_velocities_of_soft_grains_are_false(self):
        c = curves("fig-4-22")

        def mean(curve, low, high):
            return statistics.mean(v for t, v, _ in curve if low <= t <= high)
        end = {key: mean(curve, 75, 100) for key, curve in c.items()}
        growth = {key: end[key] / mean(curve, 50, 75) for key, curve in c.items()}
        for soft in (("a", "k_n=1e6"), ("a", "k_n=1e7"), ("b", "k_n=1e4")):
            self.assertAlmostEqual(growth[soft], 1, delta=0.03)
        self.assertGreater(end["a", "k_n=1e7"], 2 * end["a", "k_n=1e6"])
        self.assertGreater(end["b", "k_n=1e6"], 8 * end["b", "k_n=1e4"])
        self.assertLess(growth["b", "k_n=1e6"], 1.25)
        self.assertGreater(growth["b", "event-driven"], 1.3)
        self.assertGreater(end["b", "event-driven"], end["b", "k_n=1e6"])


unittest.main(argv=sys.argv[:1])
