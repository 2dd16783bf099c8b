// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_parallel.h.
#include "bond_parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "read_number.h"
#include "update.h"

using namespace LAMMPS_NS;
using bondlab::PairTable;
using namespace bondlab::laws;

BondParallel::BondParallel(LAMMPS *lmp) : BondBPM(lmp) {}

BondParallel::~BondParallel() {
  if (allocated) memory->destroy(setflag);
}

void BondParallel::allocate() {
  allocated = 1;
  const int n = atom->nbondtypes + 1;
  memory->create(setflag, n, "bond:setflag");
  for (int i = 0; i < n; i++) setflag[i] = 0;
  types_.assign(n, Type());
}

void BondParallel::coeff(int narg, char **arg) {
  if (narg < 5)
    bad("bond_coeff for bond_style parallel: expected `bond_coeff N E_b kn_ks sigma_c tau_c [keyword values ...]` (Pa, 1, Pa, Pa)");
  if (!allocated) allocate();
  int lo, hi;
  force->bounds(arg[0], atom->nbondtypes, lo, hi);

  const auto value = [&](int k, const char *name, bool positive) {
    if (k >= narg) bad(std::string("bond_coeff for bond_style parallel: '") + name + "' has no value");
    const double v = bondlab::read_number(arg[k]);
    if (!std::isfinite(v) || (positive ? !(v > 0.0) : v < 0.0))
      bad(std::string("bond_coeff for bond_style parallel: ") + name + " is " + arg[k] +
          ", it must be " + (positive ? "positive" : "0 or positive"));
    return v;
  };

  Type t;
  t.law.modulus = value(1, "E_b (Pa)", true);
  t.law.ratio = value(2, "kn_ks", true);
  t.sigma.mean = value(3, "sigma_c (Pa)", true);
  t.tau.mean = value(4, "tau_c (Pa)", true);
  t.sigma.stream = 0;
  t.tau.stream = 1;
  for (int k = 5; k < narg;) {
    if (!strcmp(arg[k], "lambda")) {
      t.law.lambda = value(k + 1, "lambda", true);
      k += 2;
    } else if (!strcmp(arg[k], "beta")) {
      t.law.beta = value(k + 1, "beta", false);
      k += 2;
    } else if (!strcmp(arg[k], "friction_angle")) {
      const double degrees = value(k + 1, "friction_angle (degrees)", false);
      if (degrees >= 90.0) bad("bond_coeff for bond_style parallel: friction_angle must be below 90 degrees");
      t.law.tan_phi = std::tan(degrees * kPi / 180.0);
      k += 2;
    } else if (!strcmp(arg[k], "scatter")) {
      const std::string kind = k + 1 < narg ? arg[k + 1] : "";
      if (kind != "none" && kind != "normal" && kind != "weibull")
        bad("bond_coeff for bond_style parallel: scatter is '" + kind +
            "', allowed are none, normal (standard deviations over means) and weibull (moduli)");
      const bool weibull = kind == "weibull";
      t.sigma.spread = value(k + 2, "scatter of sigma_c", weibull);
      t.tau.spread = value(k + 3, "scatter of tau_c", weibull);
      t.sigma.scatter = t.tau.scatter =
          weibull ? Scatter::weibull : (kind == "normal" ? Scatter::normal : Scatter::none);
      if (kind == "normal") {
        t.sigma.spread *= t.sigma.mean;
        t.tau.spread *= t.tau.mean;
      }
      k += 4;
    } else if (!strcmp(arg[k], "seed")) {
      const double seed = value(k + 1, "seed", false);
      if (seed != std::floor(seed)) bad(std::string("bond_coeff for bond_style parallel: seed is ") + arg[k + 1] + ", it must be a whole number");
      t.sigma.seed = t.tau.seed = static_cast<std::uint64_t>(seed);
      k += 2;
    } else {
      bad(std::string("bond_coeff for bond_style parallel: unknown keyword '") + arg[k] +
          "', allowed are lambda, beta, friction_angle, scatter, seed");
    }
  }

  int count = 0;
  for (int i = lo; i <= hi; i++) {
    types_[i] = t;
    setflag[i] = 1;
    count++;
  }
  if (count == 0) bad("bond_coeff for bond_style parallel: no bond type was named");
}

void BondParallel::init_style() {
  BondBPM::init_style();
  for (auto &t : types_) t.law.thickness = style_->thickness;
}

void BondParallel::resize_constants(int padded) {
  for (auto *v : {&radius_, &stiffness_, &ratio_, &beta_, &tan_phi_}) v->assign(padded, 0.0);
}

void BondParallel::derive(int row) {
  const PairTable &t = table();
  const int source = std::min(row, t.size() - 1);
  const Type &type = types_[t.info[source] & TYPE_MASK];
  radius_[row] = type.law.lambda * std::min(ri_[row], rj_[row]);
  stiffness_[row] = type.law.modulus / (ri_[row] + rj_[row]);
  ratio_[row] = type.law.ratio;
  beta_[row] = type.law.beta;
  tan_phi_[row] = type.law.tan_phi;
  sigma_c_[row] = bond_strength(type.sigma, t.lo[source], t.hi[source]);
  tau_c_[row] = bond_strength(type.tau, t.lo[source], t.hi[source]);
}

void BondParallel::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = 0;
  refresh();
  if (update->setupflag)
    compute_blocks<false>();
  else
    compute_blocks<true>();
}

template <bool advance>
void BondParallel::compute_blocks() {
  const int n = table().size();
  const double dt = advance ? update->dt : 0.0;
  const bool flat = domain->dimension == 2;
  for (int b = 0; b < n; b += kBlock) {
    const ContactParameters contact = contact_block(b);
    Report report;
    if (flat) {
      Kinematics2 k;
      PairLoads2 loads;
      gather(b, dt, k);
      const ParallelArrays2 a{column(REST) + b, radius_.data() + b, stiffness_.data() + b,
                              ratio_.data() + b, beta_.data() + b, tan_phi_.data() + b,
                              sigma_c_.data() + b, tau_c_.data() + b, style_->thickness,
                              alive_.data() + b, column(FSX) + b, column(MBX) + b,
                              report.sigma, report.tau, report.fate};
      parallel_block_2d<advance>(k, a, contact, column(CSX) + b, loads);
      scatter(b, loads);
    } else {
      Kinematics3 k;
      PairLoads3 loads;
      gather(b, dt, k);
      const ParallelArrays3 a{column(REST) + b, radius_.data() + b, stiffness_.data() + b,
                              ratio_.data() + b, beta_.data() + b, tan_phi_.data() + b,
                              sigma_c_.data() + b, tau_c_.data() + b, alive_.data() + b,
                              column(FSX) + b, column(FSY) + b, column(FSZ) + b,
                              column(MBX) + b, column(MBY) + b, column(MBZ) + b, column(MT) + b,
                              report.sigma, report.tau, report.fate};
      parallel_block_3d<advance>(k, a, contact, column(CSX) + b, column(CSY) + b,
                                 column(CSZ) + b, loads);
      scatter(b, loads);
    }
    if (advance) finish_step(b, report);
  }
}

double BondParallel::row_energy(int row) {
  const PairTable &t = table();
  if (!intact(row)) return 0.0;
  const double *a = atom->x[t.at_lo[row]], *b = atom->x[t.at_hi[row]];
  double d2 = 0.0;
  for (int d = 0; d < 3; d++) d2 += (b[d] - a[d]) * (b[d] - a[d]);
  const bool flat = domain->dimension == 2;
  const BondSection s = flat ? strip_section(radius_[row], style_->thickness)
                             : round_section(radius_[row]);
  const double kn = stiffness_[row], ks = kn / ratio_[row];
  const double fn = kn * s.area * (std::sqrt(d2) - t.state[REST][row]);
  double fs2 = 0.0, mb2 = 0.0;
  for (int c = 0; c < (flat ? 1 : 3); c++) {
    fs2 += t.state[FSX + c][row] * t.state[FSX + c][row];
    mb2 += t.state[MBX + c][row] * t.state[MBX + c][row];
  }
  return parallel_energy(fn, std::sqrt(fs2), std::sqrt(mb2), flat ? 0.0 : t.state[MT][row], kn,
                         ks, s);
}

void BondParallel::stiffness(int row, double &translational, double &coupling,
                             double &rotational) {
  const bool flat = domain->dimension == 2;
  const BondSection s = flat ? strip_section(radius_[row], style_->thickness)
                             : round_section(radius_[row]);
  const double hold = intact(row) ? 1.0 : 0.0;
  const double kn = hold * stiffness_[row] * s.area, ks = kn / ratio_[row];
  const double bend = hold * stiffness_[row] * s.bend;
  const double twist = hold * stiffness_[row] * s.twist / ratio_[row];
  translational = std::max(kn + kn_c_[row], ks + ks_c_[row]);
  coupling = ks + ks_c_[row];
  rotational = std::max(bend, twist);
}

void BondParallel::write_restart(FILE *fp) {
  for (int i = 1; i <= atom->nbondtypes; i++) {
    const Type &t = types_[i];
    const double row[] = {t.law.modulus, t.law.ratio, t.law.lambda, t.law.beta, t.law.tan_phi,
                          t.sigma.mean, double(int(t.sigma.scatter)), t.sigma.spread,
                          double(t.sigma.seed), t.tau.mean, double(int(t.tau.scatter)),
                          t.tau.spread, double(t.tau.seed)};
    fwrite(row, sizeof row, 1, fp);
  }
}

void BondParallel::read_restart(FILE *fp) {
  allocate();
  for (int i = 1; i <= atom->nbondtypes; i++) {
    double row[13] = {0};
    if (comm->me == 0 && fread(row, sizeof row, 1, fp) != 1)
      error->one(FLERR, "restart file ends within the coefficients of bond_style parallel");
    MPI_Bcast(row, 13, MPI_DOUBLE, 0, world);
    Type &t = types_[i];
    t.law.modulus = row[0];
    t.law.ratio = row[1];
    t.law.lambda = row[2];
    t.law.beta = row[3];
    t.law.tan_phi = row[4];
    t.sigma = {row[5], static_cast<Scatter>(int(row[6])), row[7], std::uint64_t(row[8]), 0};
    t.tau = {row[9], static_cast<Scatter>(int(row[10])), row[11], std::uint64_t(row[12]), 1};
    setflag[i] = 1;
  }
}
