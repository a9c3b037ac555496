#pragma once
#include <string>

namespace chute::test {

/// The example of the design page, line by line: the messages below count these lines.
inline const std::string example = R"toml(title = "Dense flow of 300 discs on a rough incline (thesis 5.2)"
units = "reduced"                       # or "SI"
seed = 1
[incline]
angle = "18 deg"                        # or sin = 0.094
[bed]
kind = "row"                            # row | disordered-row | plane | flat | file
diameter = 1.0
count = 30
[grains]
count = 300
diameter = { mean = 1.0, std = 0.05 }
start = { lattice = "square", spacing = 1.25, velocity = 2.0, spread = 2.0 }
[contact.normal]
law = "spring-dashpot"
stiffness = 5e6
restitution = 0.6                       # or damping = …
[contact.tangential]
law = "coulomb-viscous"
viscosity = 1000
friction = 0.5
[engine]
method = "soft"                         # soft | event | hybrid | contact | stochastic
integrator = "gear5"
steps_per_contact = 50
[run]
duration = 400
[output]
frames = { every = 0.5 }
profiles = { from = 200, bin = 1.0 }
)toml";

/// The example with `from` (which must be there, once) replaced.
inline std::string with(const std::string& from, const std::string& to, std::string text = example) {
  const auto at = text.find(from);
  if (at == text.npos || text.find(from, at + 1) != text.npos) throw std::runtime_error("not once: " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace chute::test
