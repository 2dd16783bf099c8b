// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/user_error.h"
#include "report/atomic_file.h"
#include "report/gnuplot.h"
#include "report/xml_for_tests.h"

namespace bondlab {
namespace {

Plot small_plot(const std::string &words = "label") {
  Plot plot;
  plot.name = "small", plot.title = words, plot.sentence = words;
  PlotPanel panel;
  panel.x.label = panel.y.label = panel.right.label = words;
  PlotSeries series;
  series.label = words;
  series.x = {0, 1, 2, 3}, series.y = {1, NAN, 3, 2};
  panel.series.push_back(series);
  PlotSeries counts = series;
  counts.right_axis = true, counts.look = Look::points;
  panel.series.push_back(counts);
  PlotSeries band;
  band.look = Look::band, band.label = words + " band";
  band.x = {0, 3}, band.y = {1, 1}, band.high = {2, 2};
  panel.series.push_back(band);
  plot.panels.push_back(panel);
  return plot;
}

TEST(ThinOut, KeepsPeaksAndEnds) {
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) x.push_back(i), y.push_back(std::sin(i * 1e-3));
  y[54321] = 50, y[20000] = -50;
  thin_out(x, y, 1000);
  EXPECT_LE(x.size(), 1000u);
  EXPECT_GT(x.size(), 500u);
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 99999);
  EXPECT_EQ(*std::max_element(y.begin(), y.end()), 50);
  EXPECT_EQ(*std::min_element(y.begin(), y.end()), -50);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  std::vector<double> few{1, 2, 3}, same{4, 5, 6};
  thin_out(few, same, 10);
  EXPECT_EQ(few, (std::vector<double>{1, 2, 3}));
}

TEST(PlotData, HasOneBlockASeriesWithoutGaps) {
  const std::string data = plot_data(small_plot());
  EXPECT_NE(data.find("0\t1\n2\t3\n3\t2\n\n\n"),
            std::string::npos);  // the point that isn't a number is left out
  EXPECT_NE(data.find("0\t1\t2\n3\t1\t2\n\n\n"), std::string::npos);
  EXPECT_EQ(data.find("nan"), std::string::npos);
}

TEST(PlotScript, KeepsTheUsersWordsInsideQuotes) {
  const std::string script = plot_script(small_plot("it's\n`touch x`\nsystem('y')"));
  EXPECT_NE(script.find("'it''s `touch x` system(''y'')'"), std::string::npos);
  EXPECT_EQ(script.find("\n`"), std::string::npos);
  EXPECT_EQ(script.find("\nsystem"), std::string::npos);
}

TEST(PlotScript, PutsThreeTicksOnShortLogarithmicAxes) {
  for (const auto &[low, high] :
       {std::pair<double, double>{15, 45}, {40, 180}, {1.1, 1.9}, {0.1, 2000}, {1e-9, 1e9}}) {
    Plot plot = small_plot();
    PlotAxis &axis = plot.panels[0].x;
    axis.logarithmic = true, axis.low = low, axis.high = high;
    const std::string script = plot_script(plot);
    const std::size_t at = script.find("set xtics"), open = script.find('(', at),
                      close = script.find(')', at);
    ASSERT_NE(close, std::string::npos);
    const std::string places = script.substr(open, close - open);
    EXPECT_GE(std::count(places.begin(), places.end(), ','), 2)
        << low << " to " << high << ": " << places;
    EXPECT_LE(std::count(places.begin(), places.end(), ','), 20)
        << low << " to " << high << ": " << places;
  }
}

TEST(DrawPlot, GivesWellFormedSvgAndTheSameBytesAgain) {
  TestFolder first, second;
  const std::string svg = draw_plot(small_plot(), first.path());
  EXPECT_EQ(xml::parse(svg).error, "");
  EXPECT_EQ(svg, draw_plot(small_plot(), second.path()));
  EXPECT_EQ(svg, read_text_file(first / "small.svg"));
  EXPECT_TRUE(std::filesystem::exists(first / "small.tsv"));
  EXPECT_TRUE(std::filesystem::exists(first / "small.gp"));
  EXPECT_EQ(svg.find("GNUPLOT"), std::string::npos);
  EXPECT_EQ(svg.find("gpPt"), std::string::npos);
  EXPECT_EQ(svg.find("rgb("), std::string::npos);
  EXPECT_NE(svg.find("small-Pt"), std::string::npos);
}

TEST(DrawPlot, RunsNoCommandOfTheUser) {
  TestFolder folder;
  const std::string words =
      "`touch pwned1` '`touch pwned2`' \"`touch pwned3`\" @x $(touch pwned4) \\ #ffffff ]]> <b> & "
      "rgb(1,2,3) 'gp \x01 \xff {/Symbol a}_b^c";
  const std::string svg = draw_plot(small_plot(words), folder.path());
  const xml::Document document = xml::parse(svg);
  EXPECT_EQ(document.error, "");
  EXPECT_EQ(document.count("b"), 0u);
  for (const auto &entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename().string().find("pwned"), std::string::npos);
  bool as_written = false;
  for (const xml::Element &element : document.elements)
    as_written |= element.name == "text" &&
                  element.text.find("$(touch pwned4) \\ #ffffff") != std::string::npos &&
                  element.text.find("rgb(1,2,3) 'gp") != std::string::npos &&
                  element.text.find("{/Symbol a}_b^c") != std::string::npos;
  EXPECT_TRUE(as_written) << svg;
}

TEST(DrawPlot, SaysSoWhenThereIsNoData) {
  TestFolder folder;
  Plot plot = small_plot();
  for (PlotSeries &series : plot.panels[0].series) series.x.clear(), series.y.clear();
  EXPECT_NE(draw_plot(plot, folder.path()).find("no data"), std::string::npos);
}

TEST(DrawPlot, TakesConstantAndHugeData) {
  TestFolder folder;
  for (const double value : {0.0, -3.0, 1e300, 1e-300}) {
    Plot plot = small_plot();
    for (PlotSeries &series : plot.panels[0].series) {
      for (double &y : series.y) y = value;
      for (double &high : series.high) high = value;
      for (double &x : series.x) x = 1;
    }
    EXPECT_EQ(xml::parse(draw_plot(plot, folder.path())).error, "") << value;
    plot.panels[0].y.logarithmic = true;
    EXPECT_EQ(xml::parse(draw_plot(plot, folder.path())).error, "") << value;
  }
}

TEST(DrawPlot, NamesTheMissingProgramAndThePackage) {
  TestFolder folder;
  try {
    draw_plot(small_plot(), folder.path(), "no-such-gnuplot");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("no-such-gnuplot"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("apt-get install gnuplot-nox"), std::string::npos);
  }
}

TEST(DrawPlot, HandsOnTheWordsOfAFailingProgram) {
  TestFolder folder;
  const auto program = folder.write("broken", "#!/bin/sh\necho 'out of ink' >&2\nexit 3\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  try {
    draw_plot(small_plot(), folder.path(), program.string());
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("out of ink"), std::string::npos);
  }
}

TEST(DrawPlot, RefusesAPictureThatIsNone) {
  TestFolder folder;
  const auto program = folder.write("empty", "#!/bin/sh\n: >small.svg\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  EXPECT_THROW(draw_plot(small_plot(), folder.path(), program.string()), UserError);
}

}  // namespace
}  // namespace bondlab
