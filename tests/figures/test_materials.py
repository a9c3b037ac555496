"""What a bed of another material does, on the CSV of the quick figure: test_materials.py CHUTE. Seeds are fixed; limits leave room
for other seeds."""
import sys
import unittest

from figure_csv import Figures

chute = sys.argv[1]


def setUpModule():
    global curves
    made = Figures(chute, "fig-b-06").curves("fig-b-06")
    curves = {key: {x: y for x, y, _ in points} for key, points in made.items()}


class Beds(unittest.TestCase):
    def test_a_bed_with_friction_is_colder_than_the_bulk(self):
        for series in ("e_n=0.6 e_w=0.6", "e_n=0.6 e_w=0.99", "e_n=0.3 e_w=0.99", "mu_w=1"):
            T = curves["b", series]
            self.assertLess(T[0.5], 0.8 * T[1.5], series)
            self.assertLess(T[1.5], T[4.5], series)

    def test_a_bed_without_is_slipped_on_and_hotter_than_what_lies_above(self):
        for series in ("mu_w=0", "e_n=0.3 e_w=0.99 mu_w=0"):
            self.assertGreater(curves["b", series][0.5], 1.15 * curves["b", series][1.5], series)
            self.assertGreater(curves["a", series][0.5], 0.3, series)

    def test_an_elastic_bed_takes_less(self):
        self.assertGreater(curves["b", "e_n=0.6 e_w=0.99"][0.5], 1.2 * curves["b", "e_n=0.6 e_w=0.6"][0.5])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
