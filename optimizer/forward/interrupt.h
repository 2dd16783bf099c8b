// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: let SIGINT, SIGTERM and SIGHUP end a command cleanly: engines killed, runs marked, nothing
// left half-written. Method: handlers only note the signal; whoever loops asks interrupt_signal()
// and throws Interrupted. A second signal of
//   the same kind has its ordinary effect, so that a user can always get out.
// Units: none. Failure: none. Limits: process-wide, like signals.
#pragma once

namespace bondlab {

void catch_interrupts();
int interrupt_signal();  // 0: none so far
void clear_interrupt();

}  // namespace bondlab
