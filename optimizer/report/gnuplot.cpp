// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "base/table_file.h"
#include "base/user_error.h"
#include "report/atomic_file.h"
#include "report/palette.h"
#include "report/svg.h"

namespace bondlab {
namespace {

struct Ended {
  int status = 0;
  std::string words;  // what it wrote to stdout and stderr
};

// Start `program` with `arguments` in `directory`, wait for it.
Ended run(const std::string &program, const std::vector<std::string> &arguments,
          const std::filesystem::path &directory) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw UserError("gnuplot can't be started: " + std::string(std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  std::vector<char *> words{const_cast<char *>(program.c_str())};
  for (const std::string &argument : arguments)
    words.push_back(const_cast<char *>(argument.c_str()));
  words.push_back(nullptr);
  std::vector<char *> environment;
  static char c_locale[] = "LC_ALL=C.UTF-8";  // decimal points
  for (char **entry = environ; *entry; ++entry)
    if (std::strncmp(*entry, "LC_ALL=", 7) != 0) environment.push_back(*entry);
  environment.push_back(c_locale);
  environment.push_back(nullptr);
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, nullptr, words.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    const std::string advice = error == ENOENT ? "; on Debian: apt-get install gnuplot-nox" : "";
    throw UserError("the plots need gnuplot, but '" + program +
                    "' can't be started: " + std::strerror(error) + advice);
  }
  Ended ended;
  char buffer[4096];
  for (ssize_t count; (count = ::read(ends[0], buffer, sizeof buffer)) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    if (ended.words.size() < 100000) ended.words.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  while (::waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {
  }
  return ended;
}

void replace_all(std::string &text, const std::string &old, const std::string &fresh) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += fresh.size())
    text.replace(at, old.size(), fresh);
}

// From `open` to the end of `close`, everywhere.
void remove_between(std::string &text, const std::string &open, const std::string &close) {
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) return;
    text.erase(at, end + close.size() - at);
  }
}

// "rgb( 23,  79, 143)" -> "#174f8f"
void rgb_to_hex(std::string &text) {
  std::string result;
  result.reserve(text.size());
  std::size_t from = 0;
  for (std::size_t at; (at = text.find("rgb(", from)) != std::string::npos;) {
    int red = 0, green = 0, blue = 0, used = 0;
    result.append(text, from, at - from);
    if (std::sscanf(text.c_str() + at, "rgb( %d , %d , %d )%n", &red, &green, &blue, &used) == 3 &&
        used > 0) {
      result += fmt::format("#{:02x}{:02x}{:02x}", red & 255, green & 255, blue & 255);
      from = at + static_cast<std::size_t>(used);
    } else {
      result += "rgb(";
      from = at + 4;
    }
  }
  text = result.append(text, from, std::string::npos);
}

// Change the markup only: words between tags may be the user's and stay as they are.
template <class F>
std::string with_tags_changed(const std::string &text, F &&change) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find('<', at), text.size());
    result.append(text, at, open - at);
    const std::size_t close = open < text.size() ? text.find('>', open) : std::string::npos;
    at = close == std::string::npos ? text.size() : close + 1;
    std::string tag = text.substr(open, at - open);
    change(tag);
    result += tag;
  }
  return result;
}

// Groups that hold nothing; gnuplot opens one at every change of pen.
void remove_empty_groups(std::string &text) {
  std::string result;
  result.reserve(text.size());
  std::size_t from = 0;
  for (std::size_t at; (at = text.find("<g ", from)) != std::string::npos;) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) break;
    const std::size_t next = text.find_first_not_of(" \t\n", end + 1);
    result.append(text, from, at - from);
    if (next != std::string::npos && text.compare(next, 4, "</g>") == 0) {
      from = next + 4;
    } else {
      result.append(text, at, end + 1 - at);
      from = end + 1;
    }
  }
  text = result.append(text, from, std::string::npos);
}

}  // namespace

std::string tidy_gnuplot_svg(const std::string &svg, const Plot &plot) {
  const std::size_t head = svg.find("</desc>");
  const std::size_t foot = svg.rfind("</svg>");
  if (head == std::string::npos || foot == std::string::npos || foot < head)
    throw UserError("gnuplot drew no picture for '" + plot.name + "'");
  std::string body = svg.substr(head + 7, foot - head - 7);
  remove_between(body, "<filter ", "</filter>");
  remove_between(body, "<title>", "</title>");
  replace_all(body, "<tspan font-family=\"sans-serif\" >", "");
  replace_all(body, "</tspan>", "");
  for (std::size_t before = 0; before != body.size();) {
    before = body.size();
    remove_empty_groups(body);
  }
  body = with_tags_changed(body, [&](std::string &tag) {
    rgb_to_hex(tag);
    replace_all(tag, "'gp", "'" + plot.name + "-");
    replace_all(tag, "'#gp", "'#" + plot.name + "-");
    replace_all(tag, "id=\"gnuplot_", "id=\"" + plot.name + "-");
    replace_all(tag, "xlink:href=", "href=");
    replace_all(tag, "color=\"black\"", fmt::format("color=\"{}\"", light("ink")));
    replace_all(tag, "fill=\"black\"", fmt::format("fill=\"{}\"", light("ink")));
    replace_all(tag, "color=\"gray\"", fmt::format("color=\"{}\"", light("grid")));
    replace_all(tag, " font-family=\"sans-serif\"", "");
    replace_all(tag, "  '", "'");
  });
  for (std::size_t before = 0; before != body.size();) {
    before = body.size();
    replace_all(body, "\n\n", "\n");
    replace_all(body, "\n\t\n", "\n");
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" "
      "font-family=\"sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>{4}</svg>\n",
      compact(plot.width), compact(plot.height), xml_escape(plot.title), xml_escape(plot.sentence),
      body);
}

std::string draw_plot(const Plot &plot, const std::filesystem::path &directory,
                      const std::string &program) {
  write_whole_file(directory / (plot.name + ".tsv"), plot_data(plot));
  write_whole_file(directory / (plot.name + ".gp"), plot_script(plot));
  const Ended ended = run(program, {"-d", plot.name + ".gp"}, directory);
  if (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0)
    throw UserError("gnuplot failed on the plot '" + plot.name +
                    "': " + ended.words.substr(0, 500));
  const std::string svg = tidy_gnuplot_svg(read_text_file(directory / (plot.name + ".svg")), plot);
  write_whole_file(directory / (plot.name + ".svg"), svg);
  return svg;
}

}  // namespace bondlab
