#!/usr/bin/env python3
"""Reference for the many-disc chute, made with LAMMPS. See README.md.

    reference.py check                 restitution of two-grain collisions
    reference.py run --case mu05 --seeds 1 2 3
    reference.py reduce                all stored runs -> chute-2d.csv, chute-2d-runs.csv
    reference.py speed                 grain steps per second, no output

Reduced units: m = g = d = 1. Standard library only. Raw output goes to --work.
"""

import argparse
import csv
import glob
import json
import math
import os
import random
import re
import statistics
import subprocess
import time

HERE = os.path.dirname(os.path.abspath(__file__))
INPUT = os.path.join(HERE, "chute-2d.in")

LENGTH = 30.0        # of the periodic chute; bed of as many touching grains
GRAINS = 300
SPACING = 1.25       # of the starting lattice
FIRST_ROW = 2.0      # height of the lowest row above the centres of the bed
DIAMETER_STD = 0.05  # of the moving grains, cut at 3 standard deviations
START_V_X = 2.0
START_STD = 2.0
TOP = 80.0           # of the box; LAMMPS stops if a grain leaves it
DENSITY = 6.0 / math.pi  # sphere of diameter 1 has mass 1

K_N = 5.0e6
E_N = 0.6            # of two grains of mass 1
GAMMA_T = 2000.0     # times m_eff = 1/2 gives 1000

SAMPLE = 0.02        # time between samples
WINDOW = 50          # samples per row of the time series (1 time unit)
BLOCK = 1000         # samples per block of profiles (20 time units)
T_FROM, T_TO = 200.0, 400.0
FIT = (2.0, 8.0)     # heights between which the bulk shear rate is fitted

LOCKED, SLIPPING = 0.02, 0.1  # v_x of the lowest bin: below, the bed layer is locked; above, it slips

CASES = {"mu05": (0.5, 18.0), "mu00": (0.0, 14.4)}


def damping(e_n, m_eff):
    """gamma_n (1/time) and contact time: e_n = exp(-gamma_n t_n/2), t_n = pi/sqrt(k/m_eff - gamma_n^2/4)."""
    log_e = -math.log(e_n)
    gamma_n = 2.0 * math.sqrt(K_N / m_eff) * log_e / math.hypot(math.pi, log_e)
    return gamma_n, math.pi / math.sqrt(K_N / m_eff - gamma_n**2 / 4.0)


def restitution(gamma_n, m_eff):
    return math.exp(-gamma_n / 2.0 * math.pi / math.sqrt(K_N / m_eff - gamma_n**2 / 4.0))


GAMMA_N, T_N = damping(E_N, 0.5)
SAMPLE_STEPS = math.ceil(SAMPLE / (T_N / 50.0))
DT = SAMPLE / SAMPLE_STEPS  # just below t_n/50, and a sample is a whole number of steps


def write_data(path, grains):
    """grains: (type, diameter, x, y, vx, vy, spin)"""
    with open(path, "w") as out:
        out.write("chute\n\n%d atoms\n2 atom types\n\n" % len(grains))
        out.write("0 %g xlo xhi\n-5 %g ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms # sphere\n\n" % (LENGTH, TOP))
        for i, (kind, d, x, y, *_) in enumerate(grains, 1):
            out.write("%d %d %.15g %.15g %.15g %.15g 0\n" % (i, kind, d, DENSITY, x, y))
        out.write("\nVelocities\n\n")
        for i, (*_, vx, vy, spin) in enumerate(grains, 1):
            out.write("%d %.15g %.15g 0 0 0 %.15g\n" % (i, vx, vy, spin))


def bed():
    return [(1, 1.0, i + 0.5, 0.0, 0.0, 0.0, 0.0) for i in range(int(LENGTH))]


def start(seed):
    rng = random.Random(seed)
    grains = bed()
    per_row = int(LENGTH / SPACING)
    for i in range(GRAINS):
        z = rng.gauss(0.0, 1.0)
        while abs(z) > 3.0:
            z = rng.gauss(0.0, 1.0)
        grains.append((2, 1.0 + DIAMETER_STD * z,
                       (i % per_row + 0.5) * SPACING, FIRST_ROW + i // per_row * SPACING,
                       START_V_X + rng.gauss(0.0, START_STD), rng.gauss(0.0, START_STD), 0.0))
    return grains


def lammps(prefix, grains, steps, mu, theta, g=1.0, dt=DT, sample=SAMPLE_STEPS):
    """Run and return the seconds LAMMPS spent in its loop."""
    write_data(prefix + ".data", grains)
    theta = math.radians(theta)
    values = {"data": prefix + ".data", "prefix": prefix, "k_n": K_N, "gamma_n": repr(GAMMA_N),
              "gamma_t": GAMMA_T, "mu": mu, "g": g, "g_x": repr(math.sin(theta)),
              "g_y": repr(-math.cos(theta)), "dt": repr(dt), "sample": sample,
              "window": WINDOW, "block": BLOCK, "steps": steps}
    command = ["lmp", "-in", INPUT, "-log", prefix + ".log", "-screen", "none"]
    for name, value in values.items():
        command += ["-var", name, str(value)]
    subprocess.run(command, check=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    with open(prefix + ".log") as log:
        return float(re.search(r"Loop time of (\S+)", log.read()).group(1))


def final(prefix):
    with open(prefix + ".final") as dump:
        lines = dump.read().splitlines()[9:]
    return [[float(word) for word in line.split()] for line in lines]


def collide(work, mu, v_t, gap, dt, fixed):
    """Grain meeting another at relative normal velocity 1 and tangential velocity v_t, no gravity. At contact the
    normal is along x. Returns the final velocities (normal, tangential, of the surfaces) and, per angular momentum
    exchanged, its relative error (of the second grain, about the point of contact, with I = 2/5 m R^2)."""
    prefix = os.path.join(work, "check")
    kind, share = (1, 0.0) if fixed else (2, 0.5)
    grains = [(kind, 1.0, 10.0, 10.0 + share * v_t * gap, share, -share * v_t, 0),
              (2, 1.0, 11.0 + gap, 10.0 - (1 - share) * v_t * gap, share - 1.0, (1 - share) * v_t, 0)]
    if not fixed:  # far away: LAMMPS needs some grain in the group of the bed
        grains.insert(0, (1, 1.0, 0.5, -4.0, 0, 0, 0))
    lammps(prefix, grains, round(4e-3 / dt + gap / dt), mu, 0.0, g=0.0, dt=dt)
    *_, a, b = final(prefix)
    v_s = b[7] - a[7] - 0.5 * (a[8] + b[8])
    spin = 0.4 * b[3] * 0.25 * b[8]
    error = 1.0 + 0.5 * b[3] * (b[7] - (1 - share) * v_t) / spin if spin else 0.0
    return b[6] - a[6], v_s, error


def check(work):
    """Two-grain collisions, begun at several gaps so that the contact starts at several phases of a step."""
    print("gamma_n %.6f  t_n %.6e" % (GAMMA_N, T_N))
    for dt in (DT, DT / 4, DT / 16):
        print("dt %.5e = t_n/%.2f" % (dt, T_N / dt))
        gaps = [1e-3 + j * dt / 16 for j in range(16)]
        for name, fixed, m_eff in (("two grains", False, 0.5), ("grain on fixed grain", True, 1.0)):
            values = [collide(work, 0.5, 0.0, gap, dt, fixed)[0] for gap in gaps]
            print("  %-22s e_n %.5f (min %.5f, max %.5f), exact %.5f" % (
                name, statistics.mean(values), min(values), max(values), restitution(GAMMA_N, m_eff)))
            for v_t in (1.0, 4.0):
                found = [collide(work, 0.5, v_t, gap, dt, fixed) for gap in gaps]
                print("    v_t %.1f: surface velocity after %.5f, error of angular momentum %.1e" % (
                    v_t, statistics.mean(v for _, v, _ in found), statistics.mean(e for *_, e in found)))


def run(work, case, seed, t_end=T_TO):
    mu, theta = CASES[case]
    prefix = os.path.join(work, "%s-%d" % (case, seed))
    seconds = lammps(prefix, start(seed), round(t_end / SAMPLE) * SAMPLE_STEPS, mu, theta)
    with open(prefix + ".json", "w") as out:
        json.dump({"case": case, "seed": seed, "mu": mu, "theta_deg": theta, "loop_s": seconds}, out)
    print(prefix, "%.0f s" % seconds, flush=True)


def read_series(prefix):
    """Rows (time, mean v_x, grains with h < 1.3, mean h), each averaged over the time unit before it."""
    rows = []
    with open(prefix + ".series") as lines:
        for line in lines:
            if not line.startswith("#"):  # the row of step 0 averages nothing
                step, *values = map(float, line.split())
                if step > 0:
                    rows.append((step * DT, *values))
    return rows


def read_profiles(prefix, t_from, t_to):
    """{h: [count per sample, sums over grains per sample of area, vx, vy, vx^2, vy^2, spin]} over the blocks."""
    bins, blocks, inside = {}, 0, False
    with open(prefix + ".profiles") as lines:
        for line in lines:
            if line.startswith("#"):
                continue
            words = line.split()
            if len(words) == 3:
                t = float(words[0]) * DT
                inside = t_from + 1e-6 < t < t_to + 1e-6
                blocks += inside
            elif inside and float(words[2]) > 0:
                h, count = float(words[1]), float(words[2])
                sums = bins.setdefault(h, [0.0] * 7)
                sums[0] += count
                for k, mean in enumerate(map(float, words[3:]), 1):
                    sums[k] += count * mean
    return {h: [s / blocks for s in sums] for h, sums in sorted(bins.items())}


def profile(prefix, t_from=T_FROM, t_to=T_TO):
    """{h: eta, v_x, sigma_x, sigma_y, omega, grains}"""
    out = {}
    for h, (n, area, vx, vy, vx2, vy2, spin) in read_profiles(prefix, t_from, t_to).items():
        u, v = vx / n, vy / n
        out[h] = (area / LENGTH, u, math.sqrt(max(0.0, vx2 / n - u * u)),
                  math.sqrt(max(0.0, vy2 / n - v * v)), spin / n, n)
    return out


def slope(points):
    x_mean = statistics.mean(x for x, _ in points)
    return (sum((x - x_mean) * y for x, y in points) / sum((x - x_mean) ** 2 for x, _ in points))


def lowest_row(prefix):
    """Number of grains with h < 1.3 at the end, and the sum of their diameters."""
    diameters = [row[2] for row in final(prefix) if row[1] == 2 and row[5] < 1.3]
    return len(diameters), sum(diameters)


def shear_rate(prof):
    return slope([(h, row[1]) for h, row in prof.items() if FIT[0] < h < FIT[1]])


def mean_and_error(values):
    error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else None
    return statistics.mean(values), error


def text(value):
    return "" if value is None else "%.5g" % value


QUANTITIES = ("eta", "v_x", "sigma_x", "sigma_y", "omega", "grains")


def reduce(work):
    runs = []
    for path in glob.glob(os.path.join(work, "*.json")):
        with open(path) as file:
            runs.append(dict(json.load(file), prefix=path[:-5]))
    runs.sort(key=lambda r: (-r["mu"], r["seed"]))
    for r in runs:
        series = read_series(r["prefix"])
        r["profile"] = profile(r["prefix"])
        steady = [row for row in series if row[0] > T_FROM + 0.5]
        halves = [statistics.mean(row[1] for row in steady[:len(steady) // 2]),
                  statistics.mean(row[1] for row in steady[len(steady) // 2:])]
        r["row"] = ["%g" % r["mu"], "%g" % r["theta_deg"], r["seed"], statistics.mean(row[1] for row in steady),
                    statistics.stdev(row[1] for row in steady), *halves,
                    statistics.mean(row[2] for row in steady),
                    statistics.mean(row[2] >= LENGTH - 0.5 for row in steady),
                    statistics.mean(row[3] for row in steady), shear_rate(r["profile"]), r["profile"][0.5][1],
                    lowest_row(r["prefix"])[1], r["loop_s"]]
    with open(os.path.join(HERE, "chute-2d-runs.csv"), "w", newline="") as out:
        out.write("# one row per run, LAMMPS; averages over t = %g to %g; see README.md\n" % (T_FROM, T_TO))
        table = csv.writer(out, lineterminator="\n")
        table.writerow("mu theta_deg seed v_x_mean v_x_std_in_time v_x_mean_first_half v_x_mean_second_half "
                       "grains_below_1.3 share_of_time_full h_mean shear_rate_2_8 v_x_lowest_bin "
                       "lowest_row_sum_of_diameters_at_end loop_s".split())
        for r in runs:
            table.writerow([text(v) if isinstance(v, float) else v for v in r["row"]])
    with open(os.path.join(HERE, "chute-2d.csv"), "w", newline="") as out:
        out.write("# LAMMPS gran/hooke; h = centre of a bin one diameter high, from the centres of the bed; means "
                  "and standard\n# errors over runs; omega counter-clockwise; see README.md\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["mu", "theta_deg", "h"] + [c for q in QUANTITIES for c in (q, q + "_err")] + ["runs"])
        for case in CASES.values():
            profiles = [r["profile"] for r in runs if (r["mu"], r["theta_deg"]) == case]
            for h in sorted({h for p in profiles for h in p}):
                # a run without a grain in a bin counts as density 0 there, and not at all in the velocities
                have = [p[h] for p in profiles if h in p]
                row = ["%g" % case[0], "%g" % case[1], h]
                for k, q in enumerate(QUANTITIES):
                    values = [v[k] for v in have]
                    if q in ("eta", "grains"):
                        values += [0.0] * (len(profiles) - len(have))
                    row += [text(v) for v in mean_and_error(values)]
                table.writerow(row + [len(have)])
    with open(os.path.join(HERE, "chute-2d-series.csv"), "w", newline="") as out:
        out.write("# per run, averaged over the 5 time units before t: mean v_x of all moving grains, "
                  "number with h < 1.3\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["mu", "seed", "t", "v_x_mean", "grains_below_1.3"])
        for r in runs:
            series = read_series(r["prefix"])
            for i in range(0, len(series) - 4, 5):
                part = series[i:i + 5]
                table.writerow(["%g" % r["mu"], r["seed"], round(part[-1][0]),
                                "%.3f" % statistics.mean(p[1] for p in part),
                                "%.2f" % statistics.mean(p[2] for p in part)])
    with open(os.path.join(HERE, "chute-2d-blocks.csv"), "w", newline="") as out:
        out.write("# per run, averaged over the %g time units before t\n" % (BLOCK * SAMPLE))
        table = csv.writer(out, lineterminator="\n")
        table.writerow("mu seed t v_x_mean grains_below_1.3 v_x_lowest_bin shear_rate_2_8 v_x_9.5".split())
        for r in runs:
            series = read_series(r["prefix"])
            r["blocks"] = []
            for i in range(round(T_TO / (BLOCK * SAMPLE))):
                t_from, t_to = i * BLOCK * SAMPLE, (i + 1) * BLOCK * SAMPLE
                part = [row for row in series if t_from + 0.5 < row[0] < t_to + 0.5]
                prof = profile(r["prefix"], t_from, t_to)
                block = (t_to, statistics.mean(row[1] for row in part), statistics.mean(row[2] for row in part),
                         prof[0.5][1], shear_rate(prof), prof[9.5][1])
                r["blocks"].append(block)
                table.writerow(["%g" % r["mu"], r["seed"], round(t_to)] + ["%.4f" % v for v in block[1:]])
    report(runs)


def report(runs):
    for case in CASES.values():
        here = [r for r in runs if (r["mu"], r["theta_deg"]) == case]
        rows = [r["row"] for r in here]
        if rows:
            print("mu %g theta %g, %d runs" % (*case, len(rows)))
            for name, k in (("mean v_x", 3), ("grains below 1.3", 7), ("share full", 8), ("mean h", 9),
                            ("shear rate", 10), ("v_x lowest bin", 11)):
                mean, error = mean_and_error([row[k] for row in rows])
                print("  %-18s %s +- %s" % (name, text(mean), text(error)))
        for name, low, high in (("locked", -1.0, LOCKED), ("between", LOCKED, SLIPPING), ("slipping", SLIPPING, 9.0)):
            of_runs, blocks = [], 0  # per run, its mean over those blocks whose lowest bin is in that state
            for r in here:
                mine = [b[1:] for b in r["blocks"] if b[0] > T_FROM and low <= b[3] < high]
                blocks += len(mine)
                if mine:
                    of_runs.append([statistics.mean(column) for column in zip(*mine)])
            if of_runs:
                cells = [mean_and_error(column) for column in zip(*of_runs)]
                print("  %-9s %d blocks of %d runs: mean v_x, grains below 1.3, v_x lowest bin, shear rate, v_x(9.5):"
                      % (name, blocks, len(of_runs)), ", ".join("%s +- %s" % (text(m), text(e)) for m, e in cells))


def speed(work, steps):
    prefix = os.path.join(work, "speed")
    t = time.time()
    # one sample in all; LAMMPS wants sample * BLOCK below 2^31
    seconds = lammps(prefix, start(1), steps, 0.5, 18.0, sample=steps)
    print("%d steps in %.1f s (wall %.1f s): %.3g grain steps per second" % (
        steps, seconds, time.time() - t, GRAINS * steps / seconds))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["check", "run", "reduce", "speed"])
    parser.add_argument("--case", choices=list(CASES), default="mu05")
    parser.add_argument("--seeds", type=int, nargs="+", default=list(range(1, 9)))
    parser.add_argument("--work", default="runs", help="folder for raw output, not stored (%(default)s)")
    parser.add_argument("--steps", type=int, default=2000000, help="for speed, at most 2e6 (%(default)s)")
    args = parser.parse_args()
    os.makedirs(args.work, exist_ok=True)
    if args.command == "check":
        check(args.work)
    elif args.command == "run":
        for seed in args.seeds:
            run(args.work, args.case, seed)
    elif args.command == "reduce":
        reduce(args.work)
    else:
        speed(args.work, args.steps)


if __name__ == "__main__":
    main()
