#!/usr/bin/env python3
"""Prints what chute's steps, collisions and frames cost beside its peers, as a table for README.md.

    python3 tests/bench/table.py [--build build] [--turns 5] [--only spheres,events,...]

Rates are of processor time, medians of turns that alternate between all rows of a group, so that whatever else the
machine does meets all of them alike. Every vector path that the processor has is measured, by asking the benchmarks for
it. LAMMPS (Debian's `lmp`) runs the same flows where it is installed.
"""
import argparse
import importlib.util
import json
import os
import re
import statistics
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
REFERENCE = os.path.join(HERE, "..", "reference", "lammps", "reference.py")


def benchmark(program, name, seconds):
    """One turn: the numbers of one benchmark by their names."""
    said = subprocess.run([program, f"--benchmark_filter=^{name}$", f"--benchmark_min_time={seconds}",
                           "--benchmark_format=json"], check=True, capture_output=True, text=True).stdout
    return json.loads(said)["benchmarks"][0]


def names(program):
    return subprocess.run([program, "--benchmark_list_tests"], check=True, capture_output=True,
                          text=True).stdout.split()


def lammps_seconds(log):
    """Processor time of the last loop in a log."""
    with open(log) as lines:
        text = lines.read()
    wall = [float(s) for s in re.findall(r"Loop time of (\S+)", text)]
    share = [float(s) for s in re.findall(r"([\d.]+)% CPU use", text)]
    return wall[-1] * share[-1] / 100


def lammps_discs(folder):
    spec = importlib.util.spec_from_file_location("reference", REFERENCE)
    reference = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reference)
    steps, prefix = 400_000, os.path.join(folder, "discs")
    reference.lammps(prefix, reference.start(1), steps, 0.5, 18.0, sample=steps)
    return 300 * steps / lammps_seconds(prefix + ".log")


def lammps_spheres(folder, build, count):
    data, log = os.path.join(folder, f"spheres-{count}.data"), os.path.join(folder, "log")
    if not os.path.exists(data):
        subprocess.run([os.path.join(build, "bin", "spheres_bench"), "--lammps", folder], check=True)
    steps = 8_000_000 // count
    subprocess.run(["lmp", "-in", os.path.join(HERE, "spheres.in"), "-var", "data", data, "-var", "steps", str(steps),
                    "-log", log, "-screen", "none"], check=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    return count * steps / lammps_seconds(log)


def groups(build, folder):
    """Each group: its name, and rows of (what, unit, whether more is better, one turn)."""
    program = lambda name: os.path.join(build, "bin", name)
    has_lammps = subprocess.run(["which", "lmp"], capture_output=True).returncode == 0

    def rates(bench, prefix):
        # the default captures this turn's name, not the last one's
        return [(name, "M grain steps/s", lambda name=name: benchmark(program(bench), name, 0.5)["grain_steps/s"] / 1e6)
                for name in names(program(bench)) if name.startswith(prefix) and "threads:1" in name]

    for count in (300, 3000, 30_000):
        rows = rates("chute_bench", f"flow/{count}/")
        if has_lammps and count == 300:
            rows.append(("LAMMPS gran/hooke", "M grain steps/s", lambda: lammps_discs(folder) / 1e6))
        yield "discs", f"2D chute, {count} discs", rows
    for count in (8000, 64_000):
        rows = rates("spheres_bench", f"spheres/{count}/")
        if has_lammps:
            rows.append(("LAMMPS gran/hooke/history", "M grain steps/s",
                         lambda count=count: lammps_spheres(folder, build, count) / 1e6))
        yield "spheres", f"3D rough chute, Cundall-Strack, {count} spheres", rows
    for shape in ("gas_2d", "gas_3d", "rain"):
        yield "events", f"event-driven, {shape}", [
            (name, "µs a collision", lambda name=name: benchmark(program("event_bench"), name, 0.1)["collision"] * 1e6)
            for name in names(program("event_bench")) if name.startswith(shape)]
    yield "frames", "frames, 1920 × 1080", [
        (name, "s", lambda name=name: benchmark(program("render_bench"), name, 0.1)["cpu_time"] / 1e3)
        for name in names(program("render_bench"))]


def processor():
    with open("/proc/cpuinfo") as lines:
        text = lines.read()
    name = re.search(r"model name\s*: (.*)", text).group(1)
    flags = re.search(r"flags\s*: (.*)", text).group(1).split()
    path = "AVX-512" if {"avx512f", "avx512vl", "avx512dq", "avx512bw"} <= set(flags) else \
        "AVX2" if {"avx2", "fma"} <= set(flags) else "SSE2"
    return f"{name}, widest vector path {path}"


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--build", default="build")
    options.add_argument("--turns", type=int, default=5)
    options.add_argument("--only", default="discs,spheres,events,frames")
    given = options.parse_args()
    print(f"{processor()}; medians of {given.turns} alternating turns (least to most), processor time\n", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for group, title, rows in groups(given.build, folder):
            if group not in given.only.split(","):
                continue
            print(f"| {title} | | |\n|---|---|---|")
            turns = [[turn() for _, _, turn in rows] for _ in range(given.turns)]
            for (what, unit, _), numbers in zip(rows, zip(*turns)):
                middle, least, most = statistics.median(numbers), min(numbers), max(numbers)
                print(f"| {what} | {middle:.3g} ({least:.3g} to {most:.3g}) | {unit} |")
            print(flush=True)


if __name__ == "__main__":
    main()
