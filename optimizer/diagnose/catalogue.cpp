// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/catalogue.h"

namespace bondlab::diagnose {

std::string to_string(EffectKind kind) {
  switch (kind) {
    case EffectKind::bond:
      return "bond";
    case EffectKind::specimen:
      return "specimen";
    case EffectKind::machine:
      return "machine";
    case EffectKind::conversion:
      return "conversion";
  }
  return "";
}

}  // namespace bondlab::diagnose
