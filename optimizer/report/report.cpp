// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/report.h"

#include <algorithm>
#include <set>

#include "base/user_error.h"
#include "forward/curve.h"
#include "report/atomic_file.h"
#include "report/curve_plots.h"
#include "report/deviation_picture.h"
#include "report/envelope_plot.h"
#include "report/fit_plots.h"
#include "report/gnuplot.h"
#include "report/number_text.h"
#include "report/page.h"
#include "report/specimen_picture.h"

namespace bondlab {
namespace fs = std::filesystem;
namespace {

// File names of pictures: plain letters from the user's words, each name once.
class Names {
 public:
  std::string make(const std::string &kind, const std::string &words) {
    std::string slug;
    for (const char c : words.substr(0, 40)) {
      const bool plain =
          (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      if (plain)
        slug += c;
      else if (!slug.empty() && slug.back() != '-')
        slug += '-';
    }
    while (!slug.empty() && slug.back() == '-') slug.pop_back();
    const std::string stem = slug.empty() ? kind : kind + "-" + slug;
    std::string name = stem;
    for (int i = 2; !used_.insert(name).second; ++i) name = stem + "-" + std::to_string(i);
    return name;
  }

 private:
  std::set<std::string> used_;
};

class Drawer {
 public:
  Drawer(const ReportInput &input, fs::path result, fs::path pictures, std::string gnuplot)
      : input_(input),
        result_(std::move(result)),
        pictures_(std::move(pictures)),
        gnuplot_(std::move(gnuplot)) {}

  PageFigures draw() {
    PageFigures figures;
    figures.deviations = deviations();
    if (!input_.fits.empty()) {
      const ReportFit &fit = input_.fits.front();
      if (!fit.envelopes.empty()) add(figures.tests, envelope_plot(fit.envelopes), "envelopes", "");
      // Curves side by side, then specimens side by side: what is compared stands together.
      for (const ReportRunFiles &run : fit.best_runs) figures.tests.push_back(curve(fit, run));
      for (const ReportRunFiles &run : fit.best_runs) figures.tests.push_back(specimen(run));
      for (std::size_t i = 0; i < input_.fits.size(); ++i)
        add(figures.convergence, misfit_plot(input_.fits[i]), "misfit",
            i ? input_.fits[i].name : "");
      add(figures.convergence, parameter_plot(fit), "parameters", "");
      add(figures.convergence, response_plot(input_), "responses", "");
      if (const std::optional<Conflict> conflict = find_conflict(input_))
        add(figures.conflict, conflict_plot(*conflict), "conflict", "");
    }
    return figures;
  }

 private:
  Figure plotted(Plot plot, const std::string &kind, const std::string &words) {
    plot.name = names_.make(kind, words);
    Figure figure;
    figure.name = plot.name, figure.title = plot.title, figure.sentence = plot.sentence;
    figure.wide = plot.width > 600;
    figure.svg = draw_plot(plot, pictures_, gnuplot_);
    return figure;
  }

  void add(std::vector<Figure> &figures, std::optional<Plot> plot, const std::string &kind,
           const std::string &words) {
    if (plot) figures.push_back(plotted(std::move(*plot), kind, words));
  }

  Figure deviations() {
    DeviationPicture picture = deviation_picture(input_);
    Figure figure;
    figure.wide = true;
    figure.title = picture.title, figure.sentence = picture.sentence, figure.svg = picture.svg;
    if (!figure.svg.empty()) {
      figure.name = names_.make("deviations", "");
      write_whole_file(pictures_ / (figure.name + ".svg"), figure.svg);
      write_whole_file(pictures_ / (figure.name + ".tsv"), picture.data);
    }
    return figure;
  }

  fs::path file(const ReportRunFiles &run, const std::string &name) const {
    return (fs::path(run.directory).is_absolute() ? fs::path(run.directory)
                                                  : result_ / run.directory) /
           name;
  }

  // A reader's error without the place of the result's directory: the page must not depend on where
  // it was made.
  std::string words(const UserError &error) const {
    std::string text = error.what();
    for (const std::string &place :
         {(result_ / "").string(), fs::absolute(result_ / "").lexically_normal().string()})
      for (std::size_t at; (at = text.find(place)) != std::string::npos;)
        text.erase(at, place.size());
    return text;
  }

  static std::string test_title(const ReportRunFiles &run) {
    const std::string name = run.kind == "uniaxial_compression" ? "uniaxial compression"
                             : run.kind == "brazilian"          ? "Brazilian test"
                                                                : run.kind;
    return name.empty() || name == run.test ? run.test : run.test + " (" + name + ")";
  }

  Figure curve(const ReportFit &fit, const ReportRunFiles &run) {
    Figure figure;
    figure.title = "Curve of " + test_title(run);
    if (!run.ok) {
      figure.problem = "There is no curve: the run failed. " + run.failure;
      return figure;
    }
    Plot plot;
    try {
      plot = curve_plot(read_curve(file(run, run.curve)), run, fit.targets, input_.measured_curves);
    } catch (const UserError &error) {
      figure.problem = "The curve can't be drawn. " + words(error);
      return figure;
    }
    plot.title = figure.title;
    return plotted(std::move(plot), "curve", run.test);
  }

  Figure specimen(const ReportRunFiles &run) {
    Figure figure;
    figure.title = "Specimen of " + test_title(run) + " at the end";
    if (!run.ok) {
      figure.problem = "There is no picture: the run failed. " + run.failure;
      return figure;
    }
    SpecimenView view;
    try {
      Curve curve;
      if (fs::exists(file(run, run.curve))) curve = read_curve(file(run, run.curve));
      view = view_specimen(read_particles(file(run, run.particles)),
                           read_broken_bonds(file(run, run.events)), curve, run);
    } catch (const UserError &error) {
      figure.problem = "The specimen can't be drawn. " + words(error);
      return figure;
    }
    figure.sentence = counted(static_cast<long>(view.discs.size()), "particle", "particles") +
                      (view.slice ? " cut by the plane, " : ", ") +
                      counted(static_cast<long>(view.events), "broken bond", "broken bonds") +
                      (view.slice ? " in the whole body" : "") +
                      ". Each line is a broken bond, across the two particles it held together; "
                      "darker particles have lost bonds.";
    if (view.out_of_view > 0)
      figure.sentence +=
          " " + counted(static_cast<long>(view.out_of_view), "particle has", "particles have") +
          " flown out of the picture.";
    figure.svg = draw_specimen(view, figure.title, figure.sentence);
    if (figure.svg.empty()) {
      figure.problem = "The run left no particles.";
      return figure;
    }
    figure.name = names_.make("specimen", run.test);
    write_whole_file(pictures_ / (figure.name + ".svg"), figure.svg);
    write_whole_file(pictures_ / (figure.name + ".tsv"), specimen_data(view));
    return figure;
  }

  const ReportInput &input_;
  fs::path result_, pictures_;
  std::string gnuplot_;
  Names names_;
};

}  // namespace

fs::path write_report(const ReportInput &input, const fs::path &directory,
                      const std::string &gnuplot) {
  StagedDirectory pictures(directory / "pictures");
  const PageFigures figures = Drawer(input, directory, pictures.path(), gnuplot).draw();
  const std::string page = page_html(input, figures);
  pictures.publish();
  write_whole_file(directory / "report.html", page);
  return directory / "report.html";
}

}  // namespace bondlab
