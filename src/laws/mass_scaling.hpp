#pragma once

namespace chute::laws {

/// Where the reduced mass enters a contact force: thesis 3.1.1, last paragraph. `damping` is also LAMMPS's
/// gran/hooke.
enum class MassScaling {
  none,     ///< neither term carries m_eff: e_n grows with m_eff
  damping,  ///< the damping coefficient is multiplied by m_eff: e_n falls with m_eff
  both      ///< spring and damping are: e_n and t_n do not depend on m_eff
};

}  // namespace chute::laws
