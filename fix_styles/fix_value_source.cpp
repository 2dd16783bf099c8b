// SPDX-License-Identifier: GPL-2.0-or-later
// Job: numbers named in a deck. See fix_value_source.h.
#include "fix_value_source.h"

#include <cstdlib>

#include "compute.h"
#include "fix.h"
#include "fix_arguments.h"
#include "input.h"
#include "modify.h"
#include "variable.h"

namespace LAMMPS_NS {

FixValueSource::FixValueSource(LAMMPS *lmp, Fix *asker, const std::string &text)
    : Pointers(lmp), asker_(asker), text_(text), kind_(VARIABLE), component_(0), place_(-1) {
  const std::string start = text.substr(0, 2);
  if (start == "v_")
    kind_ = VARIABLE;
  else if (start == "f_")
    kind_ = FIX;
  else if (start == "c_")
    kind_ = COMPUTE;
  else
    bad("must be v_NAME, f_ID, f_ID[i], c_ID or c_ID[i]");
  name_ = text.substr(2);
  const std::size_t bracket = name_.find('[');
  if (bracket != std::string::npos) {
    char *end = nullptr;
    component_ = static_cast<int>(std::strtol(name_.c_str() + bracket + 1, &end, 10));
    if (kind_ == VARIABLE || component_ < 1 || std::string(end) != "]")
      bad("must be v_NAME, f_ID, f_ID[i], c_ID or c_ID[i] with i >= 1");
    name_.erase(bracket);
  }
  if (name_.empty()) bad("has no name");
}

void FixValueSource::bad(const std::string &why) const {
  stop_with_error(lmp, asker_, "value '" + text_ + "' " + why);
}

void FixValueSource::init(int every) {
  char *name = const_cast<char *>(name_.c_str());
  const auto check_shape = [this](bool scalar, bool vector, int size) {
    if (component_ == 0 && !scalar) bad("is not a single number; name a component, like [1]");
    if (component_ > 0 && !vector) bad("has no components");
    if (component_ > size && component_ > 0)
      bad("is out of range, there are " + std::to_string(size) + " components");
  };
  if (kind_ == VARIABLE) {
    place_ = input->variable->find(name);
    if (place_ < 0) bad("does not exist: there is no such variable");
    if (!input->variable->equalstyle(place_)) bad("is not an equal-style variable");
  } else if (kind_ == FIX) {
    place_ = modify->find_fix(name);
    if (place_ < 0) bad("does not exist: there is no such fix");
    const Fix *fix = modify->fix[place_];
    check_shape(fix->scalar_flag, fix->vector_flag, fix->size_vector);
    if (fix->global_freq > 0 && every % fix->global_freq)
      bad("is there only every " + std::to_string(fix->global_freq) + " steps");
  } else {
    place_ = modify->find_compute(name);
    if (place_ < 0) bad("does not exist: there is no such compute");
    const Compute *compute = modify->compute[place_];
    check_shape(compute->scalar_flag, compute->vector_flag, compute->size_vector);
  }
}

double FixValueSource::evaluate() {
  if (kind_ == VARIABLE) return input->variable->compute_equal(place_);
  if (kind_ == FIX) {
    Fix *fix = modify->fix[place_];
    return component_ ? fix->compute_vector(component_ - 1) : fix->compute_scalar();
  }
  Compute *compute = modify->compute[place_];
  if (component_ == 0) {
    if (!(compute->invoked_flag & INVOKED_SCALAR)) {
      compute->compute_scalar();
      compute->invoked_flag |= INVOKED_SCALAR;
    }
    return compute->scalar;
  }
  if (!(compute->invoked_flag & INVOKED_VECTOR)) {
    compute->compute_vector();
    compute->invoked_flag |= INVOKED_VECTOR;
  }
  return compute->vector[component_ - 1];
}

}  // namespace LAMMPS_NS
