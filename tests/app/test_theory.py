"""chute theory as a user meets it: test_theory.py CHUTE. The numbers against thesis 4.2.5 integrated here."""
import math
import subprocess
import sys
import unittest

chute = sys.argv[1]
DONE, WRONG = 0, 2


def theory(*options):
    return subprocess.run([chute, "theory", *options], capture_output=True, text=True)


def numbers(*options):
    """Quantity -> (printed, corrected)."""
    result = theory(*options)
    assert result.returncode == DONE, result.stderr
    rows = (line.split() for line in result.stdout.splitlines() if not line.startswith(("#", "gamma_max")))
    return {row[0]: tuple(math.nan if v == "none" else float(v) for v in row[1:3]) for row in rows}


def mean_velocity(size_ratio, gap, sine, r, g, inertia, corrected):
    """The ball rolls from -gamma_max to gamma_max by the energy, loses 1 - e_t of its velocity, and so on."""
    gamma_max, theta = math.asin((1 + gap) / (1 + size_ratio)), math.asin(sine)
    length, m_eff = r * (1 + size_ratio), 1 + inertia
    if corrected:  # angular momentum about the new contact
        e_t = (math.cos(2 * gamma_max) + inertia) / m_eff
    else:  # (4.44)
        e_t = math.sqrt(1 - math.sin(2 * gamma_max) ** 2 / m_eff)
    pull = 2 * g / (m_eff * length)
    end = pull * 2 * sine * math.sin(gamma_max) / (1 - e_t ** 2)
    n = 20000  # midpoints
    time = sum(1 / math.sqrt(end - pull * (math.cos(theta + gamma) - math.cos(theta + gamma_max)))
               for gamma in ((2 * (k + 0.5) / n - 1) * gamma_max for k in range(n))) * 2 * gamma_max / n
    return (2 * r * (1 + gap) if corrected else 2 * length * gamma_max) / time


class Theory(unittest.TestCase):
    def test_mean_velocity_is_the_integral(self):
        for ratio, gap, sine, r, g, inertia in [(2.25, 0, 0.094, 5e-3, 9.81, 0.4), (3, 0.1, 0.06, 5e-3, 9.81, 0.4),
                                                (5, 0, 0.05, 0.5e-3, 1.62, 0.5), (1.75, 0.2, 0.3, 0.5, 1, 0)]:
            got = numbers("--size-ratio", str(ratio), "--gap", str(gap), "--sin", str(sine), "--radius", str(r),
                          "--gravity", str(g), "--inertia", str(inertia))
            for corrected in (0, 1):
                expected = mean_velocity(ratio, gap, sine, r, g, inertia, bool(corrected))
                self.assertAlmostEqual(got["mean_velocity"][corrected] / expected, 1, delta=1e-5)

    def test_ball_keeps_rolling_above_theta_ab_only(self):
        boundary = numbers("--size-ratio", "2.25", "--sin", "0.1")["theta_AB"]
        for corrected in (0, 1):
            below, above = (numbers("--size-ratio", "2.25", "--angle", repr(math.degrees(boundary[corrected]) * f))
                            for f in (0.999, 1.001))
            self.assertTrue(math.isnan(below["mean_velocity"][corrected]))
            self.assertGreater(above["mean_velocity"][corrected], 0)

    def test_disorder(self):
        ordered, disordered = numbers("--size-ratio", "3", "--gap", "0.1", "--sin", "0.1"), \
            numbers("--size-ratio", "3", "--gap-max", "0.2", "--sin", "0.1")
        self.assertEqual(ordered["theta_AB"], ordered["theta_AB_disordered"])
        self.assertEqual(ordered["mean_velocity"], disordered["mean_velocity"])  # (4.52)
        self.assertGreater(disordered["theta_AB_disordered"][1], disordered["theta_AB"][1])

    def test_linear_velocity_approaches_the_exact_one_for_large_balls(self):
        # far above theta_AB the remainder is of the order of sin^2 gamma_max, 1/(1 + ratio)^2
        for ratio in (10, 20):
            got = numbers("--size-ratio", str(ratio), "--sin", "0.02")
            self.assertAlmostEqual(got["linear_velocity"][1] / got["mean_velocity"][1], 1, delta=20 / ratio ** 2)

    def test_says_the_units_and_the_misprints(self):
        text = theory("--size-ratio", "2.25", "--sin", "0.1").stdout
        for words in ("m/s", "rad", "(4.47)", "(4.55)", "(4.44)", "angular", "2r(1+eps)", "gamma_max"):
            self.assertIn(words, text)

    def test_wrong_options_get_one_line(self):
        for options, word in [(["--sin", "1.2"], "--sin"), (["--angle", "90"], "--angle"), ([], "once"),
                              (["--sin", "0.1", "--angle", "5"], "once"), (["--sin", "0.1", "--gap", "-1"], "--gap"),
                              (["--sin", "0.1", "--gap", "3"], "falls through"),
                              (["--sin", "0.1", "--gap-max", "3"], "--gap-max"),
                              (["--sin", "0.1", "--gap", "0.3", "--gap-max", "0.2"], "--gap-max"),
                              (["--sin", "0.1", "--gap-max", "-0.2"], "--gap-max"),
                              (["--sin", "0.1", "--radius", "0"], "--radius"),
                              (["--sin", "nan"], "--sin"), (["--sin", "much"], "--sin")]:
            result = theory("--size-ratio", "2.25", *options)
            self.assertEqual(result.returncode, WRONG, options)
            self.assertEqual(result.stdout, "")
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            self.assertIn(word, result.stderr)
        self.assertEqual(theory("--sin", "0.1").returncode, WRONG)
        self.assertEqual(theory("--size-ratio", "0", "--sin", "0.1").returncode, WRONG)


unittest.main(argv=sys.argv[:1])
