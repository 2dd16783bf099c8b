// SPDX-License-Identifier: GPL-2.0-or-later
#include "peak_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using bondlab::PeakWatch;

PeakWatch watch() {
  PeakWatch w;
  w.drop = 0.2;
  w.minimum = 10.0;
  w.limit = 0.01;
  return w;
}

TEST(PeakWatch, StopsWhenTheLoadHasDropped) {
  PeakWatch w = watch();
  for (double v : {0.0, 5.0, 50.0, 100.0, 90.0, 80.0}) EXPECT_EQ(w.look(v), PeakWatch::go_on) << v;
  EXPECT_EQ(w.peak, 100.0);
  EXPECT_EQ(w.look(79.9), PeakWatch::dropped);
}

TEST(PeakWatch, NoiseBelowTheMinimumIsNoPeak) {
  PeakWatch w = watch();
  for (double v : {0.0, 9.0, 1.0, -5.0, 10.0, 2.0}) EXPECT_EQ(w.look(v), PeakWatch::go_on) << v;
  EXPECT_EQ(w.look(10.5), PeakWatch::go_on);
  EXPECT_EQ(w.look(8.0), PeakWatch::dropped);
}

TEST(PeakWatch, SecondValueStopsAtItsLimit) {
  PeakWatch w = watch();
  EXPECT_EQ(w.look(50.0, 0.01), PeakWatch::go_on);
  EXPECT_EQ(w.look(50.0, 0.0101), PeakWatch::limit_reached);
  EXPECT_EQ(w.look(10.0, 0.02), PeakWatch::dropped);  // the drop is the better reason
}

TEST(PeakWatch, NaNDoesNotBecomeThePeak) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PeakWatch w = watch();
  EXPECT_EQ(w.look(nan, nan), PeakWatch::go_on);
  EXPECT_EQ(w.look(20.0), PeakWatch::go_on);
  EXPECT_EQ(w.look(nan), PeakWatch::go_on);
  EXPECT_EQ(w.peak, 20.0);
}

}  // namespace
