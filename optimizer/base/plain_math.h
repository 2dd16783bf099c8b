// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: exp, log, cube root and the normal quantile with the same bits on every machine.
// Method: only + - * / and sqrt, which IEEE 754 rounds in one way; libraries differ in the last bit
//   of the functions of <cmath>, and a packing would make that another packing. Series on a reduced
//   argument; the quantile by Newton's rule on the distribution's series.
// Units: none. Failure: none. Limits: relative error some 1e-14, of exp (1 + |x|) times that,
// because its squarings double it; arguments of ordinary size (|x| < 100 for
//   exp, the quantile for 0.001 < p < 0.999).
#pragma once

namespace bondlab {

double plain_exp(double x);
double plain_log(double x);
double plain_cube_root(double x);  // x > 0
double plain_normal_quantile(double p);

}  // namespace bondlab
