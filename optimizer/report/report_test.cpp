// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "base/user_error.h"
#include "report/atomic_file.h"
#include "report/example_for_tests.h"
#include "report/number_text.h"
#include "report/result_json.h"
#include "report/xml_for_tests.h"

namespace bondlab {
namespace {

namespace fs = std::filesystem;

std::string page_of(const ReportInput &input, const TestFolder &folder) {
  return read_text_file(write_report(input, folder.path()));
}

std::map<std::string, std::string> files_in(const fs::path &folder) {
  std::map<std::string, std::string> files;
  for (const auto &entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] = read_text_file(entry.path());
  return files;
}

// The cells of the table row whose heading is `name`, in the section with this id; the first such
// row.
std::vector<xml::Element> row_of(const xml::Document &page, const std::string &section,
                                 const std::string &name) {
  std::vector<xml::Element> cells;
  bool inside = false;
  std::size_t depth = 0;
  for (const xml::Element &element : page.elements) {
    if (element.name == "section")
      inside = element.attributes.count("id") && element.attributes.at("id") == section;
    if (!inside) continue;
    if (!cells.empty() && element.depth < depth) break;
    if (cells.empty() && element.name == "th" && element.text == name &&
        element.attributes.count("scope") && element.attributes.at("scope") == "row") {
      depth = element.depth;
      cells.push_back(element);
    } else if (!cells.empty()) {
      cells.push_back(element);
    }
  }
  return cells;
}

std::vector<double> data_in(const std::vector<xml::Element> &cells) {
  std::vector<double> values;
  for (const xml::Element &cell : cells)
    if (cell.name == "data") values.push_back(std::stod(cell.attributes.at("value")));
  return values;
}

TEST(Report, IsOneWellFormedPageThatNeedsNothingElse) {
  TestFolder folder;
  const std::string html = page_of(example::make(folder.path()), folder);
  const xml::Document page = xml::parse(html);
  ASSERT_EQ(page.error, "");
  for (const char *element : {"script", "link", "img", "iframe", "object", "base"})
    EXPECT_EQ(page.count(element), 0u) << element;
  for (const xml::Element &element : page.elements)
    for (const auto &[name, value] : element.attributes) {
      if (name == "href") {
        EXPECT_EQ(value[0], '#') << value;
      }
      if (name != "xmlns") {
        EXPECT_EQ(value.find("://"), std::string::npos) << name << "=" << value;
      }
      EXPECT_NE(name.substr(0, 2), "on") << name;
    }
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find(folder.path().string()), std::string::npos);
  EXPECT_GE(page.count("svg"), 8u);
  EXPECT_LT(html.size(), 5000000u);
}

TEST(Report, EveryLinkInThePageLeadsSomewhere) {
  TestFolder folder;
  const xml::Document page = xml::parse(page_of(example::make(folder.path()), folder));
  std::set<std::string> ids;
  for (const xml::Element &element : page.elements)
    if (element.attributes.count("id")) ids.insert(element.attributes.at("id"));
  for (const xml::Element &element : page.elements) {
    const auto link = element.attributes.find("href");
    if (link != element.attributes.end()) {
      EXPECT_TRUE(ids.count(link->second.substr(1))) << link->second;
    }
  }
}

TEST(Report, EveryNumberOfTheTablesIsThatOfTheJson) {
  TestFolder folder;
  const ReportInput input = example::make(folder.path());
  write_result(input, folder.path());
  const auto json = nlohmann::json::parse(read_text_file(folder / "result.json"));
  const xml::Document page = xml::parse(page_of(input, folder));
  for (const auto &[section, fit] :
       {std::make_pair(std::string("result"), json), {"tradeoff", json.at("tradeoff")}}) {
    for (const auto &target : fit.at("targets")) {
      const auto cells = row_of(page, section, target.at("name"));
      const double measured = target.at("measured"), sd = target.at("sd"),
                   simulated = target.at("simulated");
      EXPECT_EQ(data_in(cells),
                (std::vector<double>{measured, sd, simulated, simulated / measured - 1,
                                     (simulated - measured) / sd}));
      const bool met = target.at("met");
      EXPECT_TRUE(std::any_of(cells.begin(), cells.end(), [&](const auto &c) {
        return c.name == "span" && c.text == (met ? "met" : "not met");
      }));
    }
    for (const auto &p : fit.at("parameters")) {
      const auto cells = row_of(page, section, p.at("name"));
      EXPECT_EQ(data_in(cells),
                (std::vector<double>{p.at("value"), p.at("sd"), p.at("interval_lower"),
                                     p.at("interval_upper"), p.at("lower"), p.at("upper")}));
    }
  }
  for (const auto &p : json.at("packings")) {
    const auto values = data_in(row_of(page, "packings", p.at("name")));
    const double mean = p.at("mean"), measured = p.at("measured");
    ASSERT_EQ(values.size(), 8u);
    EXPECT_EQ(values,
              (std::vector<double>{measured, p.at("used"), mean, p.at("sd"), mean / measured - 1,
                                   p.at("values")[0], p.at("values")[1], p.at("values")[2]}));
  }
}

TEST(Report, ShowsEachNumberAsItsRoundedSelf) {
  TestFolder folder;
  const xml::Document page = xml::parse(page_of(example::make(folder.path()), folder));
  std::size_t numbers = 0;
  for (const xml::Element &element : page.elements) {
    if (element.name != "data") continue;
    std::string shown = element.text;
    for (const std::string &word :
         {std::string("+"), std::string("\u00a0%"), std::string("\u202f")})
      if (const std::size_t at = shown.find(word); at != std::string::npos)
        shown.erase(at, word.size());
    if (const std::size_t at = shown.find("\u2212"); at != std::string::npos)
      shown.replace(at, 3, "-");
    if (element.text.find("s") != std::string::npos ||
        element.text.find("min") != std::string::npos)
      continue;  // durations
    double value = std::stod(element.attributes.at("value"));
    if (element.text.find('%') != std::string::npos) value *= 100;
    if (value != 0 && std::fabs(value) < 2e-3) value *= 1e3;  // radii are shown in mm
    EXPECT_NEAR(std::stod(shown), value, 0.06 * std::fabs(value) + 0.05)
        << element.text << " for " << element.attributes.at("value");
    ++numbers;
  }
  EXPECT_GT(numbers, 80u);
}

TEST(Report, GivesTheSameBytesAgainAndFromItsJson) {
  TestFolder first, second;
  const ReportInput input = example::make(first.path());
  example::make(second.path());
  const std::string page = page_of(input, first);
  write_result(input, second.path());
  EXPECT_EQ(page, page_of(read_result(second.path()), second));
  EXPECT_EQ(files_in(first / "pictures"), files_in(second / "pictures"));
  EXPECT_EQ(page, page_of(input, first));  // over the old one
}

TEST(Report, PutsThePicturesBesideThePage) {
  TestFolder folder;
  write_report(example::make(folder.path()), folder.path());
  const auto files = files_in(folder / "pictures");
  for (const char *name : {"curve-ucs", "curve-split", "specimen-ucs", "specimen-split", "misfit",
                           "parameters", "responses", "conflict", "deviations"}) {
    ASSERT_TRUE(files.count(std::string(name) + ".svg")) << name;
    EXPECT_EQ(xml::parse(files.at(std::string(name) + ".svg")).error, "") << name;
    EXPECT_EQ(files.at(std::string(name) + ".svg").find("var(--"), std::string::npos) << name;
    EXPECT_TRUE(files.count(std::string(name) + ".tsv")) << name;
  }
}

TEST(Report, KeepsHostileWordsAsWords) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  const std::string evil = "</td></svg><script>alert('x')</script>\"&\x01\xff`touch pwned` #1b2430";
  input.study_name = input.study_title = input.study_file = input.tolerance_text = input.replay =
      evil;
  input.resolution_note = input.confirm_command = evil;
  for (ReportFit &fit : input.fits) {
    fit.name = fit.verdict = fit.replay = evil, fit.notes = {evil};
    for (ReportTarget &t : fit.targets)
      t.name += evil, t.unit = t.name[0] == 'n' ? "1" : t.unit,
                      t.source = t.sd_source = t.why_missing = evil;
    for (ReportParameter &p : fit.parameters)
      p.name += evil, p.unit = evil, p.reason = evil, p.sets = {evil};
    for (ReportStep &s : fit.history) s.phase = evil;
    for (ReportPacking &p : fit.packings) p.name = p.unit = evil;
    for (ReportFinding &f : fit.findings) f.text = evil;
    for (ReportRunFiles &r : fit.best_runs) r.kind = r.replay = evil, r.quality = {{evil, 1}};
  }
  for (ReportPoint &p : input.points) p.phase = evil;
  for (ReportSpecimen &s : input.specimens) s.name = s.shape = s.size = s.seed = evil;
  for (ReportAssumption &a : input.assumptions) a.text = a.source = evil;
  for (ReportRun &r : input.ledger)
    r.id = r.test = r.cause = r.message = r.directory = evil, r.ok = false;
  const std::string html = page_of(input, folder);
  const xml::Document page = xml::parse(html);
  EXPECT_EQ(page.error, "");
  EXPECT_EQ(page.count("script"), 0u);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  bool title = false;
  for (const xml::Element &element : page.elements)
    title |= element.name == "h1" &&
             element.text ==
                 "</td></svg><script>alert('x')</script>\"&\uFFFD\uFFFD`touch pwned` #1b2430";
  EXPECT_TRUE(title);
  for (const auto &entry : fs::recursive_directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find("pwned"), std::string::npos);
}

TEST(Report, TwoTestsOfOneNameKeepTheirPictures) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  input.fits[0].best_runs[1].test = "u/c/s", input.fits[0].best_runs[0].test = "u c s";
  write_report(input, folder.path());
  const auto files = files_in(folder / "pictures");
  EXPECT_TRUE(files.count("curve-u-c-s.svg"));
  EXPECT_TRUE(files.count("curve-u-c-s-2.svg"));
}

// Results with pieces missing: the page is whole, and says what is missing.
struct Hole {
  const char *name;
  std::function<void(ReportInput &, const fs::path &)> make;
  std::vector<std::string> says;
};

void PrintTo(const Hole &hole, std::ostream *out) { *out << hole.name; }

class ReportWithHoles : public testing::TestWithParam<Hole> {};

TEST_P(ReportWithHoles, IsStillWholeAndSaysSo) {
  TestFolder folder;
  ReportInput input = example::make(folder.path());
  GetParam().make(input, folder.path());
  const std::string html = page_of(input, folder);
  const xml::Document page = xml::parse(html);
  EXPECT_EQ(page.error, "");
  for (const std::string &words : GetParam().says) {
    EXPECT_TRUE(std::any_of(page.elements.begin(), page.elements.end(), [&](const auto &e) {
      return e.text.find(words) != std::string::npos;
    })) << words;
  }
  for (const char *nonsense : {">nan<", ">inf<", "nan\u00a0", "\"nan\""})
    EXPECT_EQ(html.find(nonsense), std::string::npos) << nonsense;
  EXPECT_EQ(html.find("<p></p>"), std::string::npos);
  for (const xml::Element &element : page.elements)
    if (element.name == "section" || element.name == "figure") {
      EXPECT_GT(element.text.size(), 25u) << element.text;
    }
  EXPECT_EQ(to_json(from_json(to_json(input), "result.json")), to_json(input));
}

const Hole holes[] = {
    {"nothing",
     [](ReportInput &r, const fs::path &) { r = ReportInput(); },
     {"No fit has been finished yet.", "No run of a virtual test",
      "The study lists no assumptions."}},
    {"no_brazilian_run",
     [](ReportInput &r, const fs::path &) { r.fits[0].best_runs.pop_back(); },
     {"Curve of ucs"}},
    {"no_runs_at_all",
     [](ReportInput &r, const fs::path &) {
       r.fits[0].best_runs.clear(), r.ledger.clear(), r.points.clear();
       for (auto &f : r.fits) f.history.clear();
     },
     {"No run of a virtual test stands behind this result.", "The fit left no history."}},
    {"failed_brazilian_run",
     [](ReportInput &r, const fs::path &) {
       ReportRunFiles &run = r.fits[0].best_runs[1];
       run.ok = false, run.failure = "timeout: the run took more than 120 s";
       r.fits[0].targets[3].simulated = no_number, r.fits[0].targets[3].met = false,
       r.fits[0].targets[3].why_missing = "the run failed (timeout)";
     },
     {"There is no curve: the run failed. timeout: the run took more than 120 s", "not simulated",
      "sigma_t could not be simulated (the run failed (timeout))"}},
    {"run_directory_gone",
     [](ReportInput &r, const fs::path &folder) {
       fs::remove_all(folder / r.fits[0].best_runs[0].directory);
     },
     {"The curve can't be drawn.", "The specimen can't be drawn. runs/ucs-4f2a/"}},
    {"truncated_curve",
     [](ReportInput &r, const fs::path &folder) {
       const fs::path file = folder / r.fits[0].best_runs[0].directory / "curve.tsv";
       const std::string text = read_text_file(file);
       write_whole_file(file, text.substr(0, text.find("\n20000\t") + 1));
     },
     {"The curve is not complete: the run ended early.", "No tangent is drawn"}},
    {"curve_of_nonsense",
     [](ReportInput &r, const fs::path &folder) {
       write_whole_file(folder / r.fits[0].best_runs[1].directory / "curve.tsv", "nonsense\n");
     },
     {"The curve can't be drawn. runs/split-4f2a/curve.tsv"}},
    {"no_tradeoff",
     [](ReportInput &r, const fs::path &) { r.fits.resize(1), r.fits[0].findings.clear(); },
     {"No fit of all targets together has been made",
      "Which ratio UCS / sigma_t the model reaches"}},
    {"all_met",
     [](ReportInput &r, const fs::path &) {
       r.fits.resize(1), r.fits[0].findings.clear(), r.fits[0].targets.pop_back();
     },
     {"E, nu and UCS are met"}},
    {"no_packings",
     [](ReportInput &r, const fs::path &) { r.fits[0].packings.clear(); },
     {"The result was not repeated on other packings."}},
    {"failed_packings",
     [](ReportInput &r, const fs::path &) {
       for (ReportPacking &p : r.fits[0].packings)
         p.values.clear(), p.mean = p.sd = no_number, p.failed = 3;
     },
     {"3 failed"}},
    {"nothing_identifiable",
     [](ReportInput &r, const fs::path &) {
       for (ReportFit &f : r.fits) {
         f.correlation.clear();
         for (ReportParameter &p : f.parameters)
           p.sd = p.interval_lower = p.interval_upper = no_number, p.identifiable = false,
           p.at_bound = true, p.reason = "the data do not move with it";
       }
     },
     {"the data do not move with it", "0 of 3"}},
    {"one_step",
     [](ReportInput &r, const fs::path &) {
       for (ReportFit &f : r.fits) f.history.resize(1);
       r.points.resize(1);
     },
     {"Misfit: fit"}},
    {"every_point_failed",
     [](ReportInput &r, const fs::path &) {
       for (ReportFit &f : r.fits)
         for (ReportStep &s : f.history) s.misfit = s.best_misfit = no_number;
       for (ReportPoint &p : r.points) p.responses.clear();
     },
     {"Parameters: fit"}},
    {"no_parameters",
     [](ReportInput &r, const fs::path &) {
       for (ReportFit &f : r.fits) {
         f.parameters.clear(), f.correlation.clear();
         for (ReportStep &s : f.history) s.parameters.clear();
       }
       for (ReportPoint &p : r.points) p.parameters.clear();
     },
     {"The study identifies no parameters."}},
    {"measured_zero",
     [](ReportInput &r, const fs::path &) {
       for (ReportFit &f : r.fits)
         for (ReportTarget &t : f.targets) t.measured = 0, t.sd = 0;
     },
     {"Result"}},
    {"measured_curves",
     [](ReportInput &r, const fs::path &) {
       r.measured_curves = {
           {"ucs", "slab 1", "lab", {"strain_axial", "axial_stress"}, {{0, 3e-3}, {0, 130e6}}},
           {"split", "disc 1", "lab", {"displacement", "force"}, {{0, 1e-4}, {0, 7e5}}}};
     },
     {"measured: slab 1", "measured: disc 1"}},
};

INSTANTIATE_TEST_SUITE_P(All, ReportWithHoles, testing::ValuesIn(holes),
                         [](const auto &info) { return std::string(info.param.name); });

TEST(Report, LeavesTheOldOneWhenItFails) {
  TestFolder folder;
  const ReportInput input = example::make(folder.path());
  const std::string page = page_of(input, folder);
  const auto pictures = files_in(folder / "pictures");
  EXPECT_THROW(write_report(input, folder.path(), "no-such-gnuplot"), UserError);
  EXPECT_EQ(read_text_file(folder / "report.html"), page);
  EXPECT_EQ(files_in(folder / "pictures"), pictures);
  long entries = 0;
  for (const auto &entry : fs::directory_iterator(folder.path())) entries += entry.exists();
  EXPECT_EQ(entries, 3);  // runs, pictures, report.html: no temporary files
}

TEST(Report, StaysSmallAndQuickForFourThousandDiscsATest) {
  TestFolder folder;
  const ReportInput input = example::make(folder.path(), 1.15e-3);
  const std::string html = page_of(input, folder);
  EXPECT_GT(xml::parse(html).count("circle"), 5000u);
  EXPECT_LT(html.size(), 5000000u);
}

}  // namespace
}  // namespace bondlab
