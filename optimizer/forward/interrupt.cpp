// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace bondlab {

static volatile std::sig_atomic_t caught = 0;

static void note(int signal) { caught = signal; }

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

int interrupt_signal() { return caught; }

void clear_interrupt() { caught = 0; }

}  // namespace bondlab
