// Names of trials, muscles, channels and persons are any text: every command that meets them runs, and the files have
// ids.
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/ground/files/utf8.h"

#include "program.h"

namespace {

using myoid::csv_quoted;
using myoid::toml_text;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using nlohmann::json;
namespace fs = std::filesystem;

/// Four names for each person: of muscles, their electrodes and trials. Each four holds what one list may not confuse.
const std::vector<std::array<std::string, 4>> kOddNames{
    {"slow 2 kg", "slow_2_kg", "slow  2 kg", "slow-2-kg"},
    {"BIC (long)", "BIC [short]", "O'Neil", "say \"x\""},
    {"Müller", "Möller", "李 小龙", "王"},
    {"😀", "👩‍🔬", "é", "e\u0301"},
    {"A", "a", "B", "run.json"},
    {"report.html", "Figures", "tables", ".stages"},
    {"..", ".", "-x", "--help"},
    {"a/b", "a\\b", "/etc/passwd", "~"},
    {"CON", "nul.txt", "COM1", "ends."},
    {"a,b;c", "#1", "=1+1", "a|b"},
    {"$(touch x)", "`touch x`", "{a name}", "%s{}%41"},
    {"<script>alert(1)</script>", "a&b", "</title>", "'; --"},
    {"__proto__", "constructor", "1", "true"},
    {" leading", "trailing ", "time", "endheader"},
    {"parameters.csv", "*?:", "]", "[a,b]"},
    {std::string(100000, 'n'), std::string(100000, 'n') + "m", std::string(300, 'x'), "x y z"},
};

/// A virtual person's recording of a greatest effort and a movement, in which the names are put.
class OddNames : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "p.toml",
               "level = \"L1\"\n[[trial]]\nname = \"mvc\"\nkind = \"mvc\"\ndirection = \"both\"\n"
               "[[trial]]\nname = \"lift\"\nkind = \"eccentric\"\nheld_mass_kg = 1.0\n"
               "[[trial]]\nname = \"more\"\nkind = \"eccentric\"\nheld_mass_kg = 2.0\n");
    const Finished twin = myoid({"twin", "--protocol", folder_ / "p.toml", "--out", folder_ / "rec"});
    ASSERT_EQ(twin.exit_code, 0) << twin.err;
  }

  /// Writes a study whose muscles, electrodes and trials have these names.
  [[nodiscard]] fs::path study(const std::array<std::string, 4>& names, const std::string& place) const {
    constexpr std::array kMuscles{"BIC", "BRA", "BRD", "TRI"};
    constexpr std::size_t kWithoutElectrode = 1;
    std::filesystem::create_directories(folder_ / place);
    for (const char* file : {"mvc_emg.sto", "lift_emg.sto", "more_emg.sto"}) {
      std::string text = read_text(folder_ / "rec" / file);
      const std::size_t begin = text.find("\ntime") + 1;
      std::string labels = text.substr(begin, text.find('\n', begin) - begin) + "\t";
      const std::size_t length = labels.size() - 1;
      for (std::size_t m = 0; m < 4; ++m) {
        const std::size_t at = labels.find(std::string("\t") + kMuscles[m] + "\t");
        if (m != kWithoutElectrode) labels.replace(at + 1, 3, names[m]);
      }
      labels.pop_back();
      write_text(folder_ / place / file, text.replace(begin, length, labels));
    }
    std::string text =
        "[model]\nfile = \"../rec/model.osim\"\ncoordinate = \"elbow_flexion\"\n"
        "held_mass = { body = \"forearm_hand\", at_m = [0.0, -0.33, 0.0] }\n"
        "[subject]\nname = " +
        toml_text(names[0]) + "\n[emg]\nkind = \"raw\"\nunit = \"V\"\nnormalise = \"max\"\n";
    for (std::size_t m = 0; m < 4; ++m)
      text += "[[muscle]]\nname = " + toml_text(names[m]) + "\nosim = [\"" + kMuscles[m] + "\"]\nemg = " +
              (m == kWithoutElectrode ? "{ same_as = " + toml_text(names[0]) + " }" : toml_text(names[m])) + "\n";
    const auto trial = [&](const std::string& name, const std::string& rest) {
      text += "[[trial]]\nname = " + toml_text(name) + "\n" + rest;
    };
    trial(names[0], "markers = \"../rec/mvc.trc\"\nemg = \"mvc_emg.sto\"\nuse = \"mvc\"\n");
    trial(names[1], "markers = \"../rec/lift.trc\"\nemg = \"lift_emg.sto\"\nheld_mass_kg = 1.0\n");
    trial(names[2], "motion = \"../rec/truth/lift_motion.sto\"\nuse = \"static\"\nheld_mass_kg = 1.0\n");
    trial(names[3],
          "markers = \"../rec/more.trc\"\nemg = \"more_emg.sto\"\nheld_mass_kg = 2.0\nuse = \"validation\"\n");
    text += "[identify]\nmethod = [\"paper\", \"torque\"]\n";
    write_text(folder_ / place / "study.toml", text);
    return folder_ / place / "study.toml";
  }

  TemporaryFolder folder_;
};

bool ran(int code) { return code == 0 || code == 4 || code == 5; }

void expect_steady_terminal(const Finished& finished) {
  for (const std::string& text : {finished.out, finished.err}) {
    for (std::size_t i = 0; i < text.size();) {
      const auto point = ::myoid::code_point_at(text, i);
      ASSERT_TRUE(point.valid && (!::myoid::is_control(point.value) || text[i] == '\n' || text[i] == '\t'));
      i += point.bytes;
    }
  }
}

/// Expects what a run with these names leaves: a folder for each trial, no stranger beside the result files.
void expect_results(const fs::path& results, const std::array<std::string, 4>& names) {
  const json run = json::parse(read_text(results / "run.json"));
  std::set<std::string> known{"model_identified.osim"};
  for (const std::string_view name : ::myoid::result_names()) known.emplace(name);
  std::vector<std::string> found;
  for (const json& trial : run.at("trials")) {
    found.push_back(trial.at("name"));
    const std::string folder = trial.at("folder");
    EXPECT_TRUE(known.insert(folder).second) << folder << " twice";
    EXPECT_LE(folder.size(), 60U);
    EXPECT_TRUE(found.size() == 1 || fs::exists(results / folder / "id.sto")) << trial.at("failure");
  }
  EXPECT_EQ(found, std::vector<std::string>(names.begin(), names.end()));
  for (const auto& entry : fs::directory_iterator(results))
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
  std::set<std::string> muscles;
  for (const auto& row : read_rows(results / "parameters.csv")) muscles.insert(row.at("muscle"));
  for (const std::string& name : names) EXPECT_TRUE(muscles.contains(name)) << name.substr(0, 80);
  const std::string page = read_text(results / "report.html");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("</title></h1>"), std::string::npos);
}

TEST_F(OddNames, OfPersonsTrialsMusclesAndElectrodesGoThroughACohort) {
  std::string table = "name,study\n";
  for (std::size_t i = 0; i < kOddNames.size(); ++i) {
    (void)study(kOddNames[i], "study" + std::to_string(i));
    // Three persons of the four are refused at once: their studies are not there.
    for (std::size_t k = 0; k < 4; ++k)
      table += csv_quoted(kOddNames[i][k]) + ",study" + std::to_string(i) + (k == 0 ? "/study.toml\n" : "/none.toml\n");
  }
  write_text(folder_ / "persons.csv", table);
  const std::string out = folder_ / "it's a {cohort} $(touch x)";
  const Finished cohort = myoid({"cohort", folder_ / "persons.csv", "--out", out, "--keep", "all"});
  EXPECT_EQ(cohort.exit_code, 5) << cohort.err;
  expect_steady_terminal(cohort);
  const auto persons = read_rows(fs::path(out) / "persons.csv");
  ASSERT_EQ(persons.size(), 4 * kOddNames.size());
  std::set<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(fs::path(out) / "persons")) folders.insert(entry.path());
  EXPECT_EQ(folders.size(), persons.size());
  std::size_t computed = 0;
  for (const fs::path& place : folders) {
    if (!fs::exists(place / "run.json")) continue;
    ++computed;
    const json run = json::parse(read_text(place / "run.json"));
    const std::string first = run.at("trials").at(0).at("name");
    for (const auto& names : kOddNames) {
      if (names[0] == first) expect_results(place, names);
    }
  }
  EXPECT_EQ(computed, kOddNames.size());
  EXPECT_FALSE(fs::exists("x"));
}

TEST_F(OddNames, GoThroughEveryCommandOfAStudy) {
  for (const std::size_t which : {std::size_t{1}, std::size_t{7}, std::size_t{14}}) {
    const std::array<std::string, 4>& names = kOddNames[which];
    const fs::path file = study(names, "study");
    const fs::path results = folder_ / ("results" + std::to_string(which)), again = folder_ / "again";
    const Finished check = myoid({"check", file});
    EXPECT_EQ(check.exit_code, 0) << check.err << check.out;
    expect_steady_terminal(check);
    const Finished run = myoid({"run", file, "--out", results});
    ASSERT_TRUE(ran(run.exit_code)) << run.err;
    expect_steady_terminal(run);
    expect_results(results, names);
    const Finished report = myoid({"report", results, "--overwrite"});
    EXPECT_TRUE(ran(report.exit_code)) << report.err;
    const Finished predict =
        myoid({"predict", results, "--trials", names[3], "--out", folder_ / "predicted", "--overwrite"});
    EXPECT_EQ(predict.exit_code, 0) << predict.err;
    const json made = json::parse(read_text(folder_ / "predicted/predictions.json"));
    EXPECT_EQ(made.at("trials").at(0).at("trial"), names[3]);
    EXPECT_TRUE(fs::exists(folder_ / "predicted" / made.at("trials").at(0).at("folder").get<std::string>() /
                           "predicted_forces.sto"));
    fs::remove_all(again);
    fs::copy(results, again, fs::copy_options::recursive);
    const Finished compare = myoid({"compare", results, again, "--out", folder_ / "compared", "--overwrite"});
    EXPECT_EQ(compare.exit_code, 0) << compare.err;
    const Finished group = myoid({"report", "--group", results, again, "--out", folder_ / "group", "--overwrite"});
    EXPECT_EQ(group.exit_code, 0) << group.err;
    const Finished derivative = myoid({"convert", results, folder_ / "bids", "--subject", names[0], "--overwrite"});
    EXPECT_EQ(derivative.exit_code, 0) << derivative.err;
  }
}

TEST_F(OddNames, ThatCannotBeSeenAreRefusedByTheReaderWithTheirLine) {
  for (const char* name : {"a\x1b[31mb", "a\u009bb", "a\u202eb", "tab\tin", ""}) {
    const fs::path file = study({"m", "l", name, "v"}, "study");
    for (const char* command : {"check", "run"}) {
      std::vector<std::string> words{command, file};
      if (std::string(command) == "run") words.insert(words.end(), {"--out", folder_ / "none"});
      const Finished refused = myoid(words);
      EXPECT_EQ(refused.exit_code, 3) << command << " " << toml_text(name);
      EXPECT_THAT(refused.err, testing::HasSubstr("study.toml:"));
      expect_steady_terminal(refused);
    }
    EXPECT_FALSE(fs::exists(folder_ / "none"));
  }
}

}  // namespace
