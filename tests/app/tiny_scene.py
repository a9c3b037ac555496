"""Small flows of discs, and how tables are read, for tests of the program."""
import csv

LAWS = """[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
restitution = 0.6
[contact.tangential]
law = "coulomb-viscous"
viscosity = 40
friction = 0.5
"""
# sixty discs above a bed of twenty, without their laws
SIXTY = """seed = 3
[incline]
angle = "20 deg"
[bed]
count = 20
[grains]
count = 60
diameter = { mean = 1, std = 0.05 }
start = { velocity = 2, spread = 1 }
"""

# a flow of eight discs that takes no time
TINY = """title = "tiny"
units = "reduced"
seed = 1
[incline]
angle = "18 deg"
[bed]
count = 6
[grains]
count = 8
diameter = { mean = 1.0, std = 0.05 }
""" + LAWS + """[run]
duration = 2
[output]
frames = { every = 0.5 }
"""


def table(path):
    """Columns of a table of chute's, as texts."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}
