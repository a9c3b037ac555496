"""A flow of eight discs that takes no time."""

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
[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
restitution = 0.6
[contact.tangential]
law = "coulomb-viscous"
viscosity = 40
friction = 0.5
[run]
duration = 2
[output]
frames = { every = 0.5 }
"""
