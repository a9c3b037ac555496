"""What the thesis says that a reader must see in the figures of chapter 5, on their CSV: test_flow.py CHUTE (see
figure_csv.py). Seeds are fixed, so the numbers are the same on every machine; limits leave room for other seeds."""
import math
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]
made = None


def setUpModule():
    global made
    made = Figures(chute, "fig-5-02", "fig-5-03")


def between(curve, low, high):
    values = [y for x, y, _ in curve if low <= x <= high]
    return sum(values) / len(values)


class Impacts(unittest.TestCase):
    def test_5_02_peaks_of_the_impact_angle(self):
        """Highest at pi/2, then pi - gamma_max, then gamma_max."""
        gamma_max = math.pi / 6  # (4.21) for touching discs of equal size
        for panel in "ab":
            density = made.curves("fig-5-02")[panel, "gamma"]
            self.assertAlmostEqual(sum(y for _, y, _ in density) * math.pi / len(density), 1, places=6)
            peaks = [between(density, at - 0.1, at + 0.1) for at in (math.pi / 2, math.pi - gamma_max, gamma_max)]
            self.assertGreater(peaks[0], peaks[1], panel)
            self.assertGreater(peaks[1], peaks[2], panel)
            valley = max(between(density, 0.8, 1.2), between(density, 1.95, 2.35))
            self.assertGreater(peaks[2], 2 * valley, panel)

    def test_5_03_impacts_are_faster_where_the_plane_is_steeper(self):
        curves = made.curves("fig-5-03")
        mean = {panel: sum(x * y for x, y, _ in curves[panel, "v_n"]) for panel in "ab"}
        self.assertGreater(mean["b"], mean["a"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
