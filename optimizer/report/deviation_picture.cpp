// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/deviation_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/number_text.h"
#include "report/palette.h"
#include "report/svg.h"
#include "report/verdict.h"

namespace bondlab {
namespace {

struct Row {
  const ReportTarget *target;
  double sd = no_number, fit = no_number, tradeoff = no_number, mean = no_number,
         spread = no_number;  // per cent
};

std::vector<Row> rows_of(const ReportInput &input) {
  std::vector<Row> rows;
  for (const ReportTarget &target : input.fits.front().targets) {
    if (!(std::fabs(target.measured) > 0)) continue;
    Row row;
    row.target = &target;
    row.sd = 100 * std::fabs(target.sd / target.measured);
    row.fit = 100 * deviation(target);
    if (input.fits.size() > 1)
      for (const ReportTarget &other : input.fits[1].targets)
        if (other.name == target.name) row.tradeoff = 100 * deviation(other);
    for (const ReportPacking &packing : input.fits.front().packings)
      if (packing.name == target.name) {
        row.mean = 100 * (packing.mean / target.measured - 1);
        row.spread = 100 * std::fabs(packing.sd / target.measured);
      }
    rows.push_back(row);
  }
  return rows;
}

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "nan";
}

}  // namespace

DeviationPicture deviation_picture(const ReportInput &input) {
  DeviationPicture picture;
  picture.title = "Simulated against measured";
  if (input.fits.empty()) return picture;
  const std::vector<Row> rows = rows_of(input);
  if (rows.empty()) return picture;
  const bool tradeoff = input.fits.size() > 1;
  const bool packings =
      std::any_of(rows.begin(), rows.end(), [](const Row &r) { return std::isfinite(r.mean); });
  picture.sentence =
      "How far each simulated value is from the measured one (0 %); the band is the measured "
      "standard deviation.";

  double low = -10, high = 10;
  for (const Row &row : rows)
    for (const double value : {row.fit, row.tradeoff, row.sd, -row.sd, row.mean - row.spread,
                               row.mean + row.spread, row.mean})
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  // Even near zero, logarithmic far from it: a prediction that is 200 % off must not hide which
  // target is 1 % off and which 4 %.
  const auto stretched = [](double percent) { return std::asinh(percent / 4); };
  const double from = stretched(low), to = stretched(high), pad = 0.06 * (to - from);

  const double width = 1100, left = 170, right = 130, top = 44, pitch = 40;
  const double bottom = top + pitch * static_cast<double>(rows.size()), height = bottom + 48;
  const auto px = [&](double percent) {
    return left +
           (stretched(percent) - from + pad) / (to - from + 2 * pad) * (width - left - right);
  };
  SvgWriter svg(width, height, picture.title, picture.sentence);
  const std::string ink = fmt::format("fill=\"{}\"", light("ink")),
                    quiet = fmt::format("fill=\"{}\"", light("quiet"));

  std::vector<double> ticks = {0};
  for (double decade = 1; decade < 1e7; decade *= 10)
    for (const double digit : {1.0, 2.0, 5.0})
      for (const double tick : {-digit * decade, digit * decade})
        if (std::fabs(tick) >= 2 && tick >= low && tick <= high) ticks.push_back(tick);
  for (const double tick : ticks) {
    svg.line(px(tick), top - 6, px(tick), bottom,
             fmt::format("stroke=\"{}\" stroke-width=\"{}\"", light(tick == 0 ? "quiet" : "grid"),
                         tick == 0 ? "1.4" : "1"));
    svg.text(px(tick), bottom + 17, (tick > 0 ? "+" : "") + significant(tick),
             quiet + " text-anchor=\"middle\"");
  }
  svg.text((left + width - right) / 2, bottom + 37,
           "deviation from the measured value (%), scale stretched about zero",
           ink + " text-anchor=\"middle\"");

  picture.data =
      "# bondlab-deviation 1\n# names: "
      "target\tmeasured_sd\tfit\ttradeoff\tpackings_mean\tpackings_sd\n# units: -\t%\t%\t%\t%\t%\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row &row = rows[i];
    const double y = top + pitch * (static_cast<double>(i) + 0.5);
    if (std::isfinite(row.sd))
      svg.rectangle(px(-row.sd), y - 13, px(row.sd) - px(-row.sd), 26,
                    fmt::format("fill=\"{}\" rx=\"2\"", light("band")));
    svg.line(px(0), y - 13, px(0), y + 13,
             fmt::format("stroke=\"{}\" stroke-width=\"1.4\"", light("quiet")));
    svg.text(left - 16, y - 2, row.target->name, ink + " text-anchor=\"end\" font-size=\"13\"");
    svg.text(left - 16, y + 13, row.target->in_fit ? "fitted" : "predicted",
             quiet + " text-anchor=\"end\" font-size=\"11\"");
    if (std::isfinite(row.mean)) {
      const double spread = std::isfinite(row.spread) ? row.spread : 0;
      svg.path(fmt::format("M{} {}h{}m0 -4v8M{} {}v8", compact(px(row.mean - spread)),
                           compact(y + 8), compact(px(row.mean + spread) - px(row.mean - spread)),
                           compact(px(row.mean - spread)), compact(y + 4)),
               fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", light("series-3")));
      svg.rectangle(px(row.mean) - 3, y + 5, 6, 6, fmt::format("fill=\"{}\"", light("series-3")));
    }
    if (std::isfinite(row.tradeoff))
      svg.circle(px(row.tradeoff), y - 2, 5.5,
                 fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", light("series-2")));
    if (std::isfinite(row.fit))
      svg.circle(px(row.fit), y - 2, 5, fmt::format("fill=\"{}\"", light("series-1")));
    svg.text(width - right + 16, y + 3,
             std::isfinite(row.fit)
                 ? signed_percent(row.fit / 100) + (row.target->met ? "  met" : "  not met")
                 : "not simulated",
             fmt::format("fill=\"{}\" font-size=\"13\"", light(row.target->met ? "good" : "bad")));
    std::string name = row.target->name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    picture.data += name + "\t" + cell(row.sd) + "\t" + cell(row.fit) + "\t" + cell(row.tradeoff) +
                    "\t" + cell(row.mean) + "\t" + cell(row.spread) + "\n";
  }

  double x = left;
  const auto entry = [&](const std::string &words) {
    svg.text(x + 20, 22, words, ink);
    x += 20 + 6.7 * static_cast<double>(words.size()) + 22;
  };
  svg.rectangle(x, 11, 14, 14, fmt::format("fill=\"{}\"", light("band")));
  entry("measured sd");
  svg.circle(x + 8, 18, 5, fmt::format("fill=\"{}\"", light("series-1")));
  entry("fit");
  if (tradeoff) {
    svg.circle(x + 8, 18, 5.5,
               fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", light("series-2")));
    entry("trade-off fit");
  }
  if (packings) {
    svg.path(fmt::format("M{} 18h16m0 -4v8m-16 0v-8", compact(x)),
             fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", light("series-3")));
    svg.rectangle(x + 5, 15, 6, 6, fmt::format("fill=\"{}\"", light("series-3")));
    entry("other packings, mean and sd");
  }
  picture.svg = svg.finish();
  return picture;
}

}  // namespace bondlab
