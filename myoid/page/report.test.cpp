#include "myoid/page/report.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/page/html.h"
#include "myoid/page/tables.h"
#include "myoid/page/write_report.h"

#include "tests/support/temporary_folder.h"

namespace myoid::page {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Report small_report() {
  Panel panel;
  panel.title = "BIC, slow";
  panel.x = {"time", "s"};
  panel.y = {"force", "N"};
  panel.series.push_back({.name = "reference", .x = {0, 1}, .y = {2, 3}});
  Report report;
  report.title = "Muscles of <S01>";
  report.headline = "All is well.";
  report.links = {{"The model, moving", "motion.html"}};
  report.gates = {{"Markers fit", GateStatus::pass, "3 mm", "below 10 mm", "Go on."},
                  {"EMG reaches its maximum", GateStatus::fail, "40 %", "above 80 %", "Beware."}};
  report.sections.push_back({.id = "parameters",
                             .heading = "Parameters",
                             .paragraphs = {"Text."},
                             .tables = {{.id = "t1",
                                         .title = "Table I",
                                         .columns = {"muscle", "l0, m"},
                                         .rows = {{{"BIC"}, {"0.12", Badge::good, "well determined"}}}}},
                             .figures = {{.id = "f1", .title = "Forces", .caption = "C", .panels = {panel}}}});
  report.assumptions = {"A rigid tendon."};
  report.provenance = {{"version", "0.1"}};
  return report;
}

TEST(TableText, HasColumnsSideBySideWithoutReasons) {
  const Table table{.title = "Parameters",
                    .columns = {"muscle", "l_m⁰ [m]", "why"},
                    .rows = {text_row({"BIC", "0.12 ± 0.01", "seen"}), text_row({"Brachialis", "–", ""})}};
  EXPECT_EQ(table_text(table),
            "Parameters\n"
            "muscle      l_m⁰ [m]\n"
            "BIC         0.12 ± 0.01\n"
            "Brachialis  –\n");
  const std::string shown = table_text({.columns = {"name"}, .rows = {text_row({std::string(300, 'x') + "\x1b[2J"})}});
  EXPECT_EQ(shown, "name\n" + std::string(99, 'x') + "…\n");
}

TEST(Report, ThePageNeedsNothingElse) {
  const std::string page = html(small_report());
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("Muscles of &lt;S01&gt;"));
}

TEST(Report, QualityComesFirstAndTheWorstOfItBefore) {
  const std::string page = html(small_report());
  EXPECT_LT(page.find("EMG reaches its maximum"), page.find("Markers fit"));
  EXPECT_LT(page.find("Markers fit"), page.find("Table I"));
}

TEST(Report, ASectionMayStandBeforeAllNumbers) {
  Report report = small_report();
  report.forest = {{.owner = "BIC", .name = "optimal fiber length", .estimate = 0.12, .verdict = "weak"}};
  const auto is_first = [&] {
    const std::string page = html(report);
    return page.find("Table I<") < page.find("id=\"numbers\"");
  };
  EXPECT_FALSE(is_first());
  report.sections[0].before_numbers = true;
  EXPECT_TRUE(is_first());
  const std::string page = html(report);
  EXPECT_EQ(page.find("Table I<"), page.rfind("Table I<"));
  EXPECT_LT(page.find("href=\"#parameters\""), page.find("href=\"#numbers\""));
}

TEST(Report, AFoldedSectionShowsItsHeadingOnly) {
  Report report = small_report();
  EXPECT_THAT(html(report), Not(HasSubstr("<details class=\"part\">")));
  report.sections[0].folded = true;
  EXPECT_THAT(html(report),
              HasSubstr("<details class=\"part\"><summary><h2 id=\"parameters\">Parameters</h2></summary>"));
}

TEST(Report, LeadsToWhatLiesBesideIt) {
  EXPECT_THAT(html(small_report()), HasSubstr("<a href=\"motion.html\">The model, moving</a>"));
  EXPECT_EQ(nlohmann::json::parse(report_json(small_report()))["links"][0]["file"], "motion.html");
}

TEST(Report, HintsAreReadableOnPaperToo) {
  EXPECT_THAT(html(small_report()), HasSubstr("<li>BIC: well determined</li>"));
}

TEST(Report, JsonHasTheSameContent) {
  const auto json = nlohmann::json::parse(report_json(small_report()));
  EXPECT_EQ(json["gates"][1]["status"], "fail");
  EXPECT_EQ(json["sections"][0]["tables"][0]["rows"][0][1]["text"], "0.12");
  EXPECT_EQ(json["sections"][0]["tables"][0]["rows"][0][1]["badge"], "good");
  Report odd = small_report();
  odd.subtitle = "caf\xe9";  // not UTF-8
  EXPECT_NO_THROW(static_cast<void>(report_json(odd)));
}

TEST(Report, TablesAreQuotedWhereNeeded) {
  EXPECT_EQ(table_csv(small_report().sections[0].tables[0]), "muscle,\"l0, m\"\nBIC,0.12\n");
}

TEST(Report, FigureNumbersAreAllThere) {
  Figure figure = small_report().sections[0].figures[0];
  figure.panels[0].series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(figure_csv(figure),
            "panel,series,role,x,y\n\"BIC, slow\",reference,reference,0,2\n"
            "\"BIC, slow\",reference,reference,1,\n");
  figure.comments = {"How it was made:", "  1. twice"};
  EXPECT_EQ(figure_csv(figure).substr(0, 54), "# How it was made:\n#   1. twice\npanel,series,role,x,y\n");
}

TEST(Report, WritesEveryFileOfTheFolder) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  const fs::path directory = folder / "report_test";
  write_report(small_report(), directory);
  for (const char* file : {"report.html", "report.json", "figures/f1.svg", "figures/f1.csv", "tables/t1.csv"}) {
    EXPECT_TRUE(fs::exists(directory / file)) << file;
  }
}

TEST(Report, RefusesWhatCannotBeDrawn) {
  Report report = small_report();
  report.sections[0].figures[0].panels[0].series[0].y.push_back(1.0);
  EXPECT_THROW(validate(report), InvalidInput);
  report = small_report();
  report.sections[0].tables[0].rows[0].pop_back();
  EXPECT_THROW(validate(report), InvalidInput);
}

TEST(Report, AnyTextIsAnIdAndIsMadeTheNameOfAFile) {
  const test::TemporaryFolder folder;
  Report report = small_report();
  report.sections[0].figures[0].id = "../x y";
  report.sections.push_back(report.sections[0]);  // all ids twice
  make_ids(report);
  std::set<std::string> ids;
  for (const Section& section : report.sections) ids.insert(section.figures[0].id);
  EXPECT_EQ(ids.size(), 2U);
  write_report(report, folder / "out");
  for (const std::string& id : ids) EXPECT_TRUE(std::filesystem::exists(folder / "out/figures" / (id + ".svg"))) << id;
}

TEST(FormatValue, ShowsSignificantDigitsOnly) {
  EXPECT_EQ(format_value(0.0), "0");
  EXPECT_EQ(format_value(1234.56), "1235");
  EXPECT_EQ(format_value(0.0123456), "0.0123");
  EXPECT_EQ(format_value(-2.5), "-2.5");
  EXPECT_EQ(format_value(1.23e-7), "1.23e-07");
  EXPECT_EQ(format_value(std::numeric_limits<double>::quiet_NaN()), "\u2013");
}

TEST(FormatRounded, KeepsTheDecimalsOfTheWidthAndTheZerosAtTheEnd) {
  EXPECT_EQ(format_rounded(0.14, 0.017), "0.140");
  EXPECT_EQ(format_rounded(1073.4, 164.0), "1073");
  EXPECT_EQ(format_rounded(1.0, 0.075), "1.000");
  EXPECT_EQ(format_rounded(-0.0004, 0.3), "0.00");
  EXPECT_EQ(format_rounded(0.25, 0.0), "0.25");
  EXPECT_EQ(format_rounded(0.25, std::numeric_limits<double>::infinity()), "0.25");
}

TEST(FormatInterval, ShowsTwoDigitsOfTheWidthWithTheSameDecimalsAtBothEnds) {
  EXPECT_EQ(format_interval(0.13631, 0.13714), "0.13631 to 0.13714");
  EXPECT_EQ(format_interval(1.0, 1.5), "1.00 to 1.50");
  EXPECT_EQ(format_interval(507.3, 845.1, ", "), "507, 845");
  EXPECT_EQ(format_interval(0.0, 0.02), "0.000 to 0.020");
  EXPECT_EQ(format_interval(-0.001, 1.9), "0.0 to 1.9");
}

}  // namespace
}  // namespace myoid::page
