/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: how a rigid body of a test (platen or grip) moves by translation: at a speed, after a `fix
   drive`, by a servo that holds a force, as a free body, or on the spring of a loading frame. Not a
   fix itself: fix platen and fix grip read its keywords, ask it for each step's motion, and tell it
   the force.

   Methods.
   Speed and drive: closed forms of the time (platen_motion.h, drive_program.h).
   Free body of mass M: velocity Verlet with the force F of the particles, M a = F.
   Frame of stiffness K: the machine's drive goes the prescribed way u_d and the body of mass M hangs
   on a spring and a dashpot between the two (PHYSICS 4 row 7: a compliant rig in series),
       M a = K (u_d - u) + 2 Z sqrt(K M) (v_d - v) + F,
   with Z the share of critical damping. As long as the body is slow, u = u_d + F/K: the platen lags
   behind its drive by the frame's compression, and after the peak the energy in the spring drives
   it on. Integrating a mass, unlike setting u = u_d + F/K step by step, is stable for any K below
   the body's own limit, dt < 2 sqrt(M/K).
   Units: SI. Failure: errors that name the fix and the value. Limits: translation only. */

#ifndef BONDLAB_FIX_MOTION_H
#define BONDLAB_FIX_MOTION_H

#include <string>
#include <vector>

#include "pointers.h"
#include "step_clock.h"

namespace LAMMPS_NS {

class FixMotion : protected Pointers {
 public:
  FixMotion(LAMMPS *lmp, class Fix *owner);

  // Takes a keyword of motion with its values; false if the next word isn't one.
  bool read(class FixArguments &);
  static const char *keywords() { return "velocity, follow, servo, free, frame, at_rest"; }
  void check(const class FixArguments &) const;  // after the last keyword

  void init();  // before each run
  void start(bigint step, double dt);
  bool started() const { return clock_.started(); }
  // To `step`, with the force on the body at the end of the last one.
  void advance(bigint step, double dt, const double *force);
  // The force of this step: second half of a dynamic body's kick.
  void finish(double dt, const double *force);
  bool needs_force() const { return servo_ >= 0 || dynamic(); }

  const double *moved() const { return moved_; }  // since the start, m
  const double *step() const { return step_; }    // over the last step, m
  double speed(int component) const;              // m/s
  void renumber(bigint to, bigint from) { clock_.renumber(to, from); }

  std::vector<double> state() const;
  void set_state(const double *);
  static constexpr int state_size = 12;

 private:
  Fix *owner_;
  std::string drive_name_;
  const class FixDrive *drive_;
  double way_[3], ramp_;  // speed (m/s), or share of the drive's displacement
  bool prescribed_, at_rest_;
  int servo_;  // component, -1: none
  double servo_force_, servo_gain_, servo_limit_;
  double mass_;         // kg, 0: not dynamic
  bool frame_, free_[3];
  double frame_stiffness_, frame_damping_;

  bondlab::StepClock clock_;
  double moved_[3], velocity_[3];  // velocity_: of servo and dynamic components
  double step_[3];

  bool dynamic() const { return mass_ > 0.0; }
  bool dynamic(int c) const { return frame_ ? way_[c] != 0.0 : free_[c]; }
  double prescribed_place(int c) const;
  double prescribed_speed(int c) const;
  double acceleration(int c, double force) const;
};

}  // namespace LAMMPS_NS

#endif
