// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: look up the closed forms and eigenvalues of tests/data/analytic_reference.tsv by name.
//
// Columns: test, case, quantity, value, unit, formula; tab separated; '#' comments. Values have nine
// digits, so a comparison finer than 1e-8 says nothing. For tests only.
// Failure: throws if the file, or exactly one such row, isn't there.
#ifndef BONDLAB_LAWS_REFERENCE_TABLE_H
#define BONDLAB_LAWS_REFERENCE_TABLE_H

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace bondlab::laws::testbench {

class ReferenceTable {
 public:
  ReferenceTable() {
    const std::string path = std::string(BONDLAB_SOURCE_DIR) + "/tests/data/analytic_reference.tsv";
    std::ifstream in(path);
    if (!in) throw std::runtime_error("can't open " + path);
    std::string line, test, name, quantity, value;
    while (std::getline(in, line)) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream fields(line);
      std::getline(fields, test, '\t');
      std::getline(fields, name, '\t');
      std::getline(fields, quantity, '\t');
      std::getline(fields, value, '\t');
      rows_[test + "|" + name + "|" + quantity] = std::strtod(value.c_str(), nullptr);
    }
  }

  double operator()(const std::string &test, const std::string &name,
                    const std::string &quantity) const {
    const auto found = rows_.find(test + "|" + name + "|" + quantity);
    if (found == rows_.end())
      throw std::runtime_error("no reference row '" + test + "|" + name + "|" + quantity + "'");
    return found->second;
  }

 private:
  std::map<std::string, double> rows_;
};

// The table's base case: equal touching spheres, bond radius = sphere radius, grain 0 clamped.
struct Rod {
  double E = 1e9, nu = 0.3, radius = 1e-3, density = 2500.0;
  double spacing() const { return 2.0 * radius; }
  double G() const { return E / (2.0 * (1.0 + nu)); }
  double area() const { return 3.14159265358979323846 * radius * radius; }
  double I() const { return 0.25 * area() * radius * radius; }
  double J() const { return 2.0 * I(); }

  // Shear stiffness of a bond, N/m, under the three conventions of the table.
  double shear_stiffness(const std::string &convention) const {
    const double l = spacing(), kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
    if (convention == "GA/l") return G() * area() / l;
    if (convention == "12EI/l3") return 12.0 * E * I() / (l * l * l);
    if (convention == "Timoshenko")
      return 1.0 / (l * l * l / (12.0 * E * I()) + l / (kappa * G() * area()));
    throw std::runtime_error("convention " + convention);
  }
  // k_n/k_s of the parallel bond that has it.
  double ratio(const std::string &convention) const {
    return E * area() / (spacing() * shear_stiffness(convention));
  }

  std::string name() const { return "E=1e9 nu=.3 R_b=R=1mm l=2mm rho=2500"; }
  std::string name(const std::string &convention) const { return name() + "; ks=" + convention; }
  std::string name(const std::string &convention, int bonds) const {
    return name(convention) + "; n=" + std::to_string(bonds);
  }
};

}  // namespace bondlab::laws::testbench

#endif
