// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/paraview.h"

#include <map>

namespace bondlab {

VtpData particle_data(const RunView &run) {
  VtpData data;
  VtpArray id{"id", 1, true, {}}, type{"type", 1, true, {}}, radius{"radius_m", 1, false, {}},
      diameter{"diameter_m", 1, false, {}}, moved{"displacement_m", 3, false, {}},
      broken{"bonds_lost", 1, true, {}}, fragment{"fragment", 1, true, {}},
      stress{"stress_Pa", 9, false, {}};
  for (const ViewParticle &p : run.particles) {
    data.points.insert(data.points.end(), p.end.begin(), p.end.end());
    id.values.push_back(p.id);
    type.values.push_back(p.type);
    radius.values.push_back(p.r);
    diameter.values.push_back(2 * p.r);
    for (std::size_t k = 0; k < 3; ++k) moved.values.push_back(p.end[k] - p.start[k]);
    broken.values.push_back(p.broken);
    fragment.values.push_back(p.fragment);
    for (const std::size_t k : {0, 3, 4, 3, 1, 5, 4, 5, 2}) stress.values.push_back(p.stress[k]);
  }
  data.point_data = {id, type, radius, diameter, broken, fragment};
  if (run.has_start) data.point_data.push_back(moved);
  if (run.has_stress) data.point_data.push_back(stress);
  return data;
}

VtpData bond_data(const RunView &run) {
  VtpData data;
  for (const ViewParticle &p : run.particles)
    data.points.insert(data.points.end(), p.end.begin(), p.end.end());
  VtpArray broken{"broken", 1, true, {}}, mode{"mode_0_none_1_tension_2_shear", 1, true, {}},
      time{"break_time_s", 1, false, {}}, id1{"id1", 1, true, {}}, id2{"id2", 1, true, {}},
      normal{"normal_force_N", 1, false, {}}, shear{"shear_force_N", 1, false, {}};
  std::map<std::pair<int, int>, const BondForce *> forces;
  for (const BondForce &force : run.forces) forces[{force.a, force.b}] = &force;
  for (const ViewBond &bond : run.bonds) {
    data.lines.push_back({bond.a, bond.b});
    broken.values.push_back(bond.state != BondState::intact);
    mode.values.push_back(static_cast<int>(bond.state));
    time.values.push_back(bond.time);
    id1.values.push_back(run.particles[static_cast<std::size_t>(bond.a)].id);
    id2.values.push_back(run.particles[static_cast<std::size_t>(bond.b)].id);
    const auto force = forces.find({bond.a, bond.b});
    normal.values.push_back(force == forces.end() ? 0 : force->second->normal);
    shear.values.push_back(force == forces.end() ? 0 : force->second->shear);
  }
  data.cell_data = {id1, id2, broken, mode, time};
  if (run.has_forces) data.cell_data.insert(data.cell_data.end(), {normal, shear});
  return data;
}

}  // namespace bondlab
