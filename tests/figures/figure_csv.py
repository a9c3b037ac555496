"""Reading a figure's CSV."""
import bisect
import csv


def read_curves(path):
    """(panel, series) -> [(x, y, y_err)], in the order of the file."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            error = float(row["y_err"]) if row["y_err"] else None
            found.setdefault((row["panel"], row["series"]), []).append((float(row["x"]), float(row["y"]), error))
    return found


def interpolate(curve, x):
    """y at x, linearly between the points; None outside."""
    after = bisect.bisect([p[0] for p in curve], x)
    if after in (0, len(curve)):
        return None
    (x0, y0, _), (x1, y1, _) = curve[after - 1], curve[after]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
