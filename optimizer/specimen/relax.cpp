// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/relax.h"

#include <algorithm>

namespace bondlab {

namespace {

// Surfaces nearer than this are in the list; it stays valid until two particles could have closed
// it.
constexpr double skin = 0.35;

constexpr double shortest_step = 0.01, first_step = 0.1,
                 longest_step =
                     0.35;  // in 1 / sqrt(stiffness / mass); stable below 2 / omega_max = 0.5
constexpr double mixing_at_start = 0.1, mixing_factor = 0.99, step_up = 1.1, step_down = 0.5;
constexpr int steps_before_speed_up = 5;
constexpr double longest_move = 0.1;  // a step, in mean radii: contacts are not jumped over

}  // namespace

Relaxation::Relaxation(const Container &container, std::vector<Particle> &particles)
    : container_(container), particles_(particles) {}

void Relaxation::build_list() {
  pairs_ = find_pairs(particles_, skin);
  built_ = particles_;
}

// How far one particle may still move before the list must be made again; negative when it must be
// made now.
double Relaxation::list_reach() const {
  if (built_.size() != particles_.size()) return -1;
  double growth = 0, moved2 = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle &a = particles_[i], &b = built_[i];
    const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    moved2 = std::max(moved2, dx * dx + dy * dy + dz * dz);
    growth = std::max(growth, a.r - b.r);
  }
  const double reach = 0.5 * skin - growth;
  return std::sqrt(moved2) < reach ? reach : -1;
}

void Relaxation::forces() {
  const std::size_t n = particles_.size();
  const Particle *p = particles_.data();
  Vec4 *f = force_.data();
  std::fill(force_.begin(), force_.end(), Vec4{});
  overlap_sum_ = force_sum_ = 0;
  contacts_ = 0;
  const double k0 = stiffness_constant_, k1 = stiffness_slope_;
  const int *other = pairs_.other.data();
  for (std::size_t i = 0; i < n; ++i) {
    const Particle a = p[i];
    Vec4 sum;
    for (std::size_t k = pairs_.start[i]; k < pairs_.start[i + 1]; ++k) {
      const int j = other[k];
      const Particle b = p[j];
      const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, touch = a.r + b.r;
      const double d2 = dx * dx + dy * dy + dz * dz;
      if (d2 >= touch * touch || d2 == 0) continue;
      const double d = std::sqrt(d2), overlap = touch - d, push = (k0 + k1 * touch) * overlap,
                   scale = push / d;
      sum.x -= scale * dx;
      sum.y -= scale * dy;
      sum.z -= scale * dz;
      f[j].x += scale * dx;
      f[j].y += scale * dy;
      f[j].z += scale * dz;
      overlap_sum_ += overlap;
      force_sum_ += push;
      ++contacts_;
    }
    container_.walls_within(
        a.x, a.y, a.z, a.r, [&](double distance, double nx, double ny, double nz, int) {
          const double push = wall_contact_stiffness * (k0 + 2 * k1 * a.r) * (a.r - distance);
          sum.x += push * nx;
          sum.y += push * ny;
          sum.z += push * nz;
        });
    f[i].x += sum.x;
    f[i].y += sum.y;
    f[i].z += sum.z;
  }
}

Equilibrium Relaxation::relax(double tolerance, double loose, int max_steps) {
  const std::size_t n = particles_.size();
  const double per_particle = static_cast<double>(container_.dimension()) * static_cast<double>(n);
  force_.assign(n, Vec4{});
  velocity_.assign(n, Vec4{});
  double reach = list_reach();
  if (reach < 0) {
    build_list();
    reach = 0.5 * skin;
  }
  if (container_.dimension() == 3) {
    double r_max = 0;
    for (const Particle &p : particles_) r_max = std::max(r_max, p.r);
    stiffness_constant_ = 0;
    stiffness_slope_ = 0.5 / r_max;
  }
  double step = first_step, mixing = mixing_at_start;
  int downhill = 0;
  Equilibrium state;
  for (state.steps = 0;; ++state.steps) {
    forces();
    double power = 0, force2 = 0, speed2 = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec4 &f = force_[i], &v = velocity_[i];
      power += f.x * v.x + f.y * v.y + f.z * v.z;
      force2 += f.x * f.x + f.y * f.y + f.z * f.z;
      speed2 += v.x * v.x + v.y * v.y + v.z * v.z;
    }
    state.contacts = contacts_;
    state.overlap = overlap_sum_ / per_particle;
    const double mean_force = contacts_ > 0 ? force_sum_ / static_cast<double>(contacts_) : 0;
    state.residual = mean_force > 0 ? std::sqrt(force2 / static_cast<double>(n)) / mean_force : 0;
    if (state.residual <= tolerance || state.overlap < loose || state.steps >= max_steps)
      return state;

    if (power > 0) {
      const double turn = mixing * std::sqrt(speed2 / force2);
      for (std::size_t i = 0; i < n; ++i) {
        velocity_[i].x = (1 - mixing) * velocity_[i].x + turn * force_[i].x;
        velocity_[i].y = (1 - mixing) * velocity_[i].y + turn * force_[i].y;
        velocity_[i].z = (1 - mixing) * velocity_[i].z + turn * force_[i].z;
      }
      if (++downhill > steps_before_speed_up) {
        step = std::min(step * step_up, longest_step);
        mixing *= mixing_factor;
      }
    } else if (state.steps > 0) {
      for (std::size_t i = 0; i < n; ++i) {
        particles_[i].x -= 0.5 * step * velocity_[i].x;
        particles_[i].y -= 0.5 * step * velocity_[i].y;
        particles_[i].z -= 0.5 * step * velocity_[i].z;
        velocity_[i] = Vec4{};
      }
      step = std::max(step * step_down, shortest_step);
      mixing = mixing_at_start;
      downhill = 0;
    }
    double moved2 = 0;
    for (std::size_t i = 0; i < n; ++i) {
      Vec4 &v = velocity_[i];
      v.x += step * force_[i].x;
      v.y += step * force_[i].y;
      v.z += step * force_[i].z;
      double move = step;
      const double v2 = v.x * v.x + v.y * v.y + v.z * v.z;
      if (v2 * step * step > longest_move * longest_move) move = longest_move / std::sqrt(v2);
      Particle &p = particles_[i];
      p.x += move * v.x;
      p.y += move * v.y;
      p.z += move * v.z;
      const Particle &b = built_[i];
      const double dx = p.x - b.x, dy = p.y - b.y, dz = p.z - b.z;
      moved2 = std::max(moved2, dx * dx + dy * dy + dz * dz);
    }
    if (std::sqrt(moved2) >= reach) {
      build_list();
      reach = 0.5 * skin;
    }
  }
}

}  // namespace bondlab
