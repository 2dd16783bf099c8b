// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "report/number_text.h"
#include "report/palette.h"
#include "report/svg.h"

namespace bondlab {

namespace {

constexpr double edge = 24, title_height = 46, gutter = 28, side = 190;
constexpr double widest = 620, highest = 640, narrowest = 300;
constexpr double line_height = 17, character = 6.4;  // of 12 pixel text, generous

struct Window {
  double x0, x1, y0, y1;
  bool holds(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The body without the farthest 1 % at each side, and some room about it.
Window window_of(const std::vector<DrawnDisc> &discs) {
  std::vector<double> x, y;
  double r = 0;
  for (const DrawnDisc &disc : discs) {
    x.push_back(disc.x), y.push_back(disc.y);
    r = std::max(r, disc.r);
  }
  Window body{quantile(x, 0.01), quantile(x, 0.99), quantile(y, 0.01), quantile(y, 0.99)};
  const double room = 0.06 * std::max(body.x1 - body.x0, body.y1 - body.y0) + 2 * r;
  // No larger than what is there: room is for what has moved, not for emptiness.
  Window tight{INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (const DrawnDisc &disc : discs) {
    if (disc.x < body.x0 - room || disc.x > body.x1 + room || disc.y < body.y0 - room ||
        disc.y > body.y1 + room)
      continue;
    tight.x0 = std::min(tight.x0, disc.x - disc.r), tight.x1 = std::max(tight.x1, disc.x + disc.r);
    tight.y0 = std::min(tight.y0, disc.y - disc.r), tight.y1 = std::max(tight.y1, disc.y + disc.r);
  }
  return tight;
}

std::vector<std::string> wrapped(const std::string &sentence, double width) {
  const std::size_t most = static_cast<std::size_t>(width / character);
  std::istringstream in(sentence);
  std::vector<std::string> lines;
  std::string line;
  for (std::string word; in >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > most) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

int channel(const std::string &colour, int k) {
  return std::stoi(colour.substr(static_cast<std::size_t>(1 + 2 * k), 2), nullptr, 16);
}

std::string mixed(const std::string &a, const std::string &b, double share) {
  std::string text = "#";
  for (int k = 0; k < 3; ++k)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(channel(a, k) * (1 - share) +
                                                               channel(b, k) * share)));
  return text;
}

// One gradient a colour, so that a sphere is a circle and nothing more.
std::string gradients(const std::vector<DrawnDisc> &discs,
                      std::map<std::string, std::string> &names) {
  std::string text = "<defs>\n";
  for (const DrawnDisc &disc : discs) {
    const auto [at, is_new] = names.emplace(disc.colour, "g" + std::to_string(names.size()));
    if (!is_new) continue;
    text += fmt::format(
        "<radialGradient id=\"{}\" cx=\"0.36\" cy=\"0.32\" r=\"0.75\"><stop offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\"0.55\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        at->second, mixed(disc.colour, "#ffffff", 0.45), disc.colour,
        mixed(disc.colour, "#000000", 0.5));
  }
  return text + "</defs>\n";
}

// A round length, a fifth to a half of the body's width.
double round_length(double width) {
  const double wanted = 0.3 * width, power = std::pow(10, std::floor(std::log10(wanted)));
  double bar = power;
  for (const double step : {2.0, 5.0, 10.0})
    if (step * power <= 1.5 * wanted) bar = step * power;
  return bar;
}

}  // namespace

std::string scale_colour(double position) {
  static const std::vector<std::string> stops = {"#26326e", "#27708f", "#3fa382", "#a3c756",
                                                 "#f5b700"};
  const double at = std::clamp(position, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return mixed(stops[below], stops[below + 1], at - static_cast<double>(below));
}

std::string draw(const Drawing &drawing) {
  if (drawing.discs.empty()) return "";
  const Window window = window_of(drawing.discs);
  const double scale =
      std::min(widest / (window.x1 - window.x0), highest / (window.y1 - window.y0));
  const double body_width = scale * (window.x1 - window.x0),
               body_height = scale * (window.y1 - window.y0);
  const double field = std::max(body_width, narrowest);  // what the body stands in the middle of
  const double width = edge + field + gutter + side + edge;
  const double legend_height =
      (drawing.bar.ticks.empty() ? 0 : 250) + 22.0 * static_cast<double>(drawing.keys.size());
  const double bottom = title_height + std::max(body_height, legend_height);
  const double bar_y = bottom + 26;

  std::size_t outside = 0;
  for (const DrawnDisc &disc : drawing.discs) outside += !window.holds(disc.x, disc.y);
  std::vector<std::string> lines;
  std::vector<std::string> sentences = drawing.sentences;
  if (outside > 0)
    sentences.push_back(counted(static_cast<long>(outside), "particle", "particles") +
                        " farther away than shown.");
  for (const std::string &sentence : sentences)
    for (const std::string &line : wrapped(sentence, width - 2 * edge)) lines.push_back(line);
  const double height = bar_y + 22 + line_height * static_cast<double>(lines.size()) + 14;

  const double left = edge + (field - body_width) / 2;
  const auto px = [&](double x) { return left + scale * (x - window.x0); };
  const auto py = [&](double y) { return title_height + scale * (window.y1 - y); };
  const std::string ink = fmt::format("fill=\"{}\"", light("ink")),
                    quiet = fmt::format("fill=\"{}\"", light("quiet"));

  std::string all;
  for (const std::string &sentence : sentences) all += (all.empty() ? "" : " ") + sentence;
  SvgWriter svg(width, height, drawing.title, all);
  svg.text(edge, 27, drawing.title, ink + " font-size=\"16\" font-weight=\"bold\"");

  std::vector<std::size_t> order(drawing.discs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return drawing.discs[a].depth < drawing.discs[b].depth;
  });
  double r_mean = 0;
  for (const DrawnDisc &disc : drawing.discs)
    r_mean += scale * disc.r / static_cast<double>(drawing.discs.size());
  std::map<std::string, std::string> gradient_of;
  if (drawing.shaded) svg.raw(gradients(drawing.discs, gradient_of));
  const double hair = std::clamp(0.12 * r_mean, 0.15, 0.7) * drawing.outline;
  svg.open_group(drawing.shaded ? std::string("stroke=\"none\"")
                                : fmt::format("stroke=\"{}\" stroke-width=\"{}\"",
                                              light("disc-edge"), compact(hair)));
  for (const std::size_t i : order) {
    const DrawnDisc &disc = drawing.discs[i];
    if (!window.holds(disc.x, disc.y)) continue;
    svg.circle(px(disc.x), py(disc.y), scale * disc.r,
               drawing.shaded ? "fill=\"url(#" + gradient_of[disc.colour] + ")\""
                              : "fill=\"" + disc.colour + "\"");
  }
  svg.close_group();

  std::vector<std::size_t> later(drawing.lines.size());
  std::iota(later.begin(), later.end(), std::size_t{0});
  std::stable_sort(later.begin(), later.end(), [&](std::size_t a, std::size_t b) {
    return drawing.lines[a].depth < drawing.lines[b].depth;
  });
  svg.open_group("stroke-linecap=\"round\"");
  for (const std::size_t i : later) {
    const DrawnLine &line = drawing.lines[i];
    if (!window.holds(0.5 * (line.x1 + line.x2), 0.5 * (line.y1 + line.y2))) continue;
    svg.line(px(line.x1), py(line.y1), px(line.x2), py(line.y2),
             fmt::format("stroke=\"{}\" stroke-width=\"{}\"", line.colour, compact(line.width)));
  }
  svg.close_group();

  std::string shafts;
  for (const DrawnArrow &arrow : drawing.arrows) {
    const double length = std::hypot(arrow.dx, arrow.dy);
    if (length < 1 || !window.holds(arrow.x, arrow.y)) continue;
    const double ux = arrow.dx / length, uy = -arrow.dy / length,
                 head = std::min(4.0, 0.5 * length);
    const double x = px(arrow.x), y = py(arrow.y), tx = x + arrow.dx, ty = y - arrow.dy;
    shafts += fmt::format(
        "M{} {}L{} {}M{} {}L{} {}L{} {}", compact(x), compact(y), compact(tx), compact(ty),
        compact(tx - head * (ux - 0.6 * uy)), compact(ty - head * (uy + 0.6 * ux)), compact(tx),
        compact(ty), compact(tx - head * (ux + 0.6 * uy)), compact(ty - head * (uy - 0.6 * ux)));
  }
  if (!shafts.empty())  // a pale edge, so that they stand out from dark colours too
    svg.path(shafts,
             fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2.6\"", light("paper")));
  if (!shafts.empty())
    svg.path(shafts, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1\"", light("ink")));

  double legend_x = edge + field + gutter, legend_y = title_height + 8;
  if (!drawing.bar.ticks.empty()) {
    for (const std::string &line : wrapped(drawing.bar.words, side)) {
      svg.text(legend_x, legend_y + 4, line, ink);
      legend_y += line_height;
    }
    const double bar_top = legend_y + 8, bar_height = 180;
    constexpr int steps = 45;
    for (int k = 0; k < steps; ++k)
      svg.rectangle(legend_x, bar_top + bar_height * k / steps, 18, bar_height / steps + 0.5,
                    "fill=\"" + scale_colour(1 - (k + 0.5) / steps) + "\"");
    const std::size_t last = drawing.bar.ticks.size() - 1;
    for (std::size_t k = 0; k <= last; ++k)
      svg.text(legend_x + 26,
               bar_top + bar_height * (1 - static_cast<double>(k) / static_cast<double>(last)) + 4,
               drawing.bar.ticks[k], ink);
    legend_y = bar_top + bar_height + 32;
  }
  for (const ColourKey &key : drawing.keys) {
    if (key.line)
      svg.line(legend_x, legend_y, legend_x + 20, legend_y,
               fmt::format("stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\"", key.colour,
                           compact(key.width)));
    else
      svg.circle(legend_x + 10, legend_y, 6,
                 fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"0.7\"", key.colour,
                             light("disc-edge")));
    svg.text(legend_x + 28, legend_y + 4, key.words, ink);
    legend_y += 22;
  }

  const double length = round_length(window.x1 - window.x0), pixels = scale * length;
  svg.path(
      fmt::format("M{} {}v8m0 -4h{}m0 -4v8", compact(edge), compact(bar_y - 8), compact(pixels)),
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", light("ink")));
  svg.text(edge + pixels + 8, bar_y,
           (length >= 1e-3 ? significant(length * 1e3) + " mm"
                           : significant(length * 1e6) + " \u00b5m") +
               " \u00b7 " + drawing.plane,
           quiet);
  double y = bar_y + 24;
  for (const std::string &line : lines) {
    svg.text(edge, y, line, ink);
    y += line_height;
  }
  return svg.finish();
}

}  // namespace bondlab
