// The C interface, through its example, beside the forces that the run itself wrote.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/recording/tables/storage_reader.h"

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::TimeSeries;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;

/// Linear between the samples, the end value beyond them.
double value_at(const TimeSeries& series, const std::string& channel, double time_s) {
  const Eigen::VectorXd& t = series.time_s();
  const auto c = series.index(channel);
  Eigen::Index i = std::upper_bound(t.begin(), t.end(), time_s) - t.begin();
  i = std::clamp<Eigen::Index>(i, 1, t.size() - 1);
  const double share = std::clamp((time_s - t[i - 1]) / (t[i] - t[i - 1]), 0.0, 1.0);
  return series.values()(i - 1, c) * (1.0 - share) + series.values()(i, c) * share;
}

/// The forces at `time_s` by the example, beside `written`; the greatest difference over the largest.
struct Compared {
  std::string muscle;
  double worst = 0.0, largest = 0.0;
};

class Realtime : public testing::TestWithParam<std::string> {
 protected:
  /// Runs a study with this lag; returns the delay of the envelope that acts.
  [[nodiscard]] double run_study() const {
    write_text(folder / "p.toml",
               "level = \"L1\"\n[[trial]]\nname = \"mvc\"\nkind = \"mvc\"\ndirection = \"both\"\n"
               "[[trial]]\nname = \"lift\"\nkind = \"eccentric\"\nheld_mass_kg = 1.0\n");
    EXPECT_EQ(myoid({"twin", "--protocol", folder / "p.toml", "--out", folder / "rec"}).exit_code, 0);
    myoid::test::replace_in(folder / "rec/study.toml", "[identify]",
                            "[identify]\ncross_validate = false\nnext_movements = 0\nlag = \"" + GetParam() + "\"");
    EXPECT_NE(myoid({"run", folder / "rec/study.toml", "--out", folder / "out"}).exit_code, 3);
    const auto json = nlohmann::json::parse(read_text(folder / "out/parameters.json"));
    for (const auto& method : json.at("methods")) {
      if (method.at("method") != "torque") continue;
      EXPECT_EQ(method.at("emg_lag"), GetParam());
      const double delay_s = method.at("emg_delay_s");
      return GetParam() == "shared" ? 10.0 / 82.5 * delay_s : delay_s;
    }
    return 0.0;
  }

  [[nodiscard]] TimeSeries series(const std::string& name) const {
    return myoid::recording::read_storage(folder / ("out/lift/" + name)).data;
  }

  [[nodiscard]] int example(const std::string& results, double step_s, const char* option = "") const {
    const std::string command = std::string(MYOID_REALTIME) + option + " " + (folder / results).string() + " " +
                                std::to_string(step_s) + " <" + (folder / "samples").string() + " >" +
                                (folder / "answers").string() + " 2>" + (folder / "errors").string();
    return std::system(command.c_str());
  }

  /// Writes a second reading into the results: each F_max is 1.1 times the person's, and each interval half as wide.
  /// Forces are proportional to F_max, so they and their derivatives grow by a tenth, and bands are 0.55 times as wide.
  void expect_the_given_reading(double step_s) const {
    ASSERT_EQ(example("out", step_s), 0);
    const std::vector<double> person = numbers();
    auto json = nlohmann::json::parse(read_text(folder / "out/parameters.json"));
    for (auto& method : json.at("methods")) {
      for (auto& row : method.at("estimates")) {
        if (!row.at("ci_low").is_number() || row.at("parameter").get<std::string>().starts_with("voluntary_")) continue;
        const auto& field = myoid::fit::parameter_field(row.at("parameter").get<std::string>());
        const double factor = field.name == "max_isometric_force" ? 1.1 : 1.0, value = row.at("estimate");
        const double low = row.at("ci_low"), high = row.at("ci_high");
        const double quarter = 0.25 * (field.logarithmic ? std::log(high / low) : high - low);
        row["given_estimate"] = factor * value;
        row["given_ci_low"] = field.logarithmic ? factor * value * std::exp(-quarter) : value - quarter;
        row["given_ci_high"] = field.logarithmic ? factor * value * std::exp(quarter) : value + quarter;
      }
    }
    std::filesystem::create_directory(folder / "given");
    write_text(folder / "given/parameters.json", json.dump());
    write_text(folder / "given/run.json", read_text(folder / "out/run.json"));
    ASSERT_EQ(example("given", step_s), 0);
    EXPECT_EQ(numbers(), person) << "the person's reading does not look at the other";
    ASSERT_EQ(example("given", step_s, " --given"), 0) << read_text(folder / "errors");
    const std::vector<double> given = numbers();
    ASSERT_EQ(given.size(), person.size());
    for (std::size_t i = 3; i + 2 < given.size(); i += 3) {
      if (i % 15 == 0) continue;  // the torque, whose band holds what the fit left unexplained
      EXPECT_NEAR(given[i], 1.1 * person[i], 1e-5 * (1.0 + person[i]));
      EXPECT_NEAR(given[i + 2] - given[i], 0.55 * (person[i + 2] - person[i]), 1e-4 * (1.0 + person[i]));
    }
  }

  /// All numbers of the answers, in order: value, lower and upper end of the torque and of four forces.
  [[nodiscard]] std::vector<double> numbers() const {
    std::istringstream answers(read_text(folder / "answers"));
    return {std::istream_iterator<double>(answers), {}};
  }

  TemporaryFolder folder;
};

/// Forces hold frequencies up to 6 Hz. The line between their samples at 100 Hz is off by at most
/// (2 pi 6 / 100)^2 / 8 = 1.8 % of the amplitude, which is at most half of the largest force.
TEST_P(Realtime, TheCInterfaceGivesTheForcesThatTheRunWrote) {
  const double pure_s = run_study();
  const TimeSeries envelope = series("drive.sto"), motion = series("ik.mot"), forces = series("identified_forces.sto");
  const Eigen::VectorXd& t = envelope.time_s();
  const double step_s = t[1] - t[0];
  std::ostringstream samples;
  samples.precision(17);
  const auto angle = [&](double time_s) {
    return value_at(motion, "elbow_flexion", time_s) * std::numbers::pi / 180.0;
  };
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double then = t[i] + pure_s;
    for (const char* channel : {"BIC", "BRD", "TRI"}) samples << value_at(envelope, channel, t[i]) << ' ';
    samples << angle(then) << ' ' << (angle(then + 0.01) - angle(then - 0.01)) / 0.02 << '\n';
  }
  write_text(folder / "samples", samples.str());
  ASSERT_EQ(example("out", step_s), 0) << read_text(folder / "errors");

  std::istringstream answers(read_text(folder / "answers"));
  std::vector<Compared> compared{{"BIC"}, {"BRA"}, {"BRD"}, {"TRI"}};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    double low = 0.0, middle = 0.0, high = 0.0;
    answers >> middle >> low >> high;
    ASSERT_LT(low, middle);
    ASSERT_LT(middle, high);
    const double then = t[i] + pure_s;
    const bool inside = then > forces.time_s()[3] && then < forces.time_s()[forces.sample_count() - 3];
    for (Compared& c : compared) {
      answers >> middle >> low >> high;
      ASSERT_LE(low, middle);
      if (!inside) continue;
      const double written = value_at(forces, c.muscle + "_identified", then);
      c.worst = std::max(c.worst, std::abs(middle - written));
      c.largest = std::max(c.largest, written);
    }
  }
  ASSERT_TRUE(answers.good());
  for (const Compared& c : compared) EXPECT_LT(c.worst, 0.01 * c.largest) << c.muscle;

  expect_the_given_reading(step_s);
  EXPECT_NE(example("rec", step_s), 0);
  EXPECT_THAT(read_text(folder / "errors"), HasSubstr("parameters.json"));
}

INSTANTIATE_TEST_SUITE_P(Lags, Realtime, testing::Values("delay", "shared"));

}  // namespace
