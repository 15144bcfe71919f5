#include "myoid/results/comparison/compare_runs.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/results/comparison/change_sentences.h"
#include "myoid/results/comparison/comparison_report.h"
#include "myoid/results/parameter_files.h"

#include "tests/support/elbow_study.h"
#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

struct Row {
  const char* muscle;
  double estimate, std_error;
  const char* verdict;
  const char* tied_to = "";
  double geometry = 0.0, torque_scale = 0.0;  ///< Shares of the variance.
};

/// A run's folder with one method and these estimates of F_max.
std::filesystem::path run(const std::filesystem::path& folder, const std::vector<Row>& rows, double rmse_nm) {
  std::string estimates;
  for (const Row& r : rows) {
    estimates += fmt::format(
        R"({}{{"muscle": "{}", "parameter": "max_isometric_force", "unit": "N", "method": "torque", "case": "both",
            "estimate": {}, "std_error": {}, "ci_low": {}, "ci_high": {}, "verdict": "{}", "tied_to": "{}",
            "variance_shares": {{"noise": {}, "literature": 0, "geometry": {}, "electrodes": 0,
                                 "torque_scale": {}, "model": 0}}}})",
        estimates.empty() ? "" : ",", r.muscle, r.estimate, r.std_error, r.estimate - 2 * r.std_error,
        r.estimate + 2 * r.std_error, r.verdict, r.tied_to, 1.0 - r.geometry - r.torque_scale, r.geometry,
        r.torque_scale);
  }
  std::filesystem::create_directories(folder);
  write_file(folder / "parameters.json", fmt::format(R"({{"methods": [{{"method": "torque", "estimates": [{}],
                  "trials": [{{"trial": "a", "rmse_nm": {}}}]}}]}})",
                                                     estimates, rmse_nm));
  return folder;
}

TEST(CompareRuns, OneUnknownOfSeveralMusclesIsOneNumberAndCountsOnce) {
  const test::TemporaryFolder folder;
  const auto rows = [](double shared, double own) {
    return std::vector<Row>{{"BIC", shared, 5, "identified"},
                            {"BRA", shared, 5, "identified", "BIC"},
                            {"BRD", shared, 5, "identified", "BIC"},
                            {"TRI", own, 50, "identified"}};
  };
  const RunComparison c =
      compare_runs(run(folder.path() / "one", rows(100, 900), 1.0), run(folder.path() / "two", rows(117, 910), 1.0));
  ASSERT_EQ(c.parameters.size(), 2u);
  EXPECT_EQ(c.parameters[0].muscle, "BIC, BRA, BRD");
  // z = 17 / (5 sqrt 2) = 2.404, p = 0.0162, of two numbers, not of four.
  EXPECT_NEAR(*c.parameters[0].p_value, 2 * 0.01621, 2e-4);
  EXPECT_EQ(c.parameters[0].change, Change::differs);
}

TEST(CompareRuns, ASessionWithAFailedGateTellsNoChange) {
  const test::TemporaryFolder folder;
  const auto first = run(folder.path() / "one", {{"BIC", 600, 5, "identified"}}, 1.0);
  const auto second = run(folder.path() / "two", {{"BIC", 900, 5, "weak"}}, 1.0);
  EXPECT_EQ(compare_runs(first, second).parameters[0].change, Change::differs);
  for (const char* status : {"warn", "fail"}) {
    write_file(second / "report.json", fmt::format(R"({{"gates": [{{"name": "Markers fit", "status": "pass"}},
                                                     {{"name": "Predicts", "status": "{}"}}]}})",
                                                   status));
    const RunComparison c = compare_runs(first, second);
    const bool fails = std::string_view(status) == "fail";
    EXPECT_EQ(c.parameters[0].change, fails ? Change::cannot_tell : Change::differs);
    EXPECT_EQ(c.failed.size(), fails ? 1U : 0U);
    EXPECT_FALSE(fails && c.parameters[0].p_value);
  }
  EXPECT_THAT(changes_sentence(compare_runs(first, second)),
              ::testing::HasSubstr("the second session failed: Predicts"));
}

TEST(CompareRuns, OneRecordingTellsNoChangeOfThePerson) {
  const test::TemporaryFolder folder;
  const auto of_recording = [&](const char* name, double strength, const char* hash) {
    const auto run_folder = run(folder.path() / name, {{"BIC", strength, 5, "identified"}}, 1.0);
    std::string text = read_text_file(run_folder / "parameters.json");
    text.insert(1, fmt::format(R"("provenance": {{"options": {{"model": {{"builtin": "arm4"}}}},
                                 "inputs": [{{"path": "a.trc", "sha256": "{}"}}]}}, )",
                               hash));
    write_file(run_folder / "parameters.json", text);
    return run_folder;
  };
  const auto first = of_recording("one", 600, "1");
  const RunComparison other = compare_runs(first, of_recording("two", 900, "2"));
  EXPECT_EQ(other.parameters.at(0).change, Change::differs);
  EXPECT_TRUE(other.one_recording.empty());
  const RunComparison same = compare_runs(first, of_recording("same", 900, "1"));
  EXPECT_EQ(same.parameters.at(0).change, Change::treatment);
  EXPECT_FALSE(same.parameters[0].p_value);
  EXPECT_FALSE(same.one_recording.empty());
}

TEST(CompareRuns, WhatErrsAlikeInBothSessionsHidesNoChange) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double strength) {
    return run(folder.path() / name, {{"BIC", strength, 100, "weak", "", 0.64, 0.11}}, 1.0);
  };
  const RunComparison c = compare_runs(session("one", 600), session("two", 750));
  // A quarter of the variance is the session's own: 50 N each, z = 150 / 70.7.
  EXPECT_NEAR(*c.parameters[0].smallest_detectable, 1.96 * 50.0 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(c.parameters[0].change, Change::differs);
}

/// One session of a person whose moment arms the study has wrong by 10 to 15 %, and whose biceps is
/// `stronger` times as strong as in the first session.
std::filesystem::path session(const std::filesystem::path& folder, double stronger, std::uint64_t seed) {
  fit::StudyData data =
      test::elbow_study(
          {.trials = 4, .seconds = 12.0, .emg_cv = 0.08, .torque_sd_nm = 0.5, .with_priors = true, .seed = seed})
          .data;
  const Eigen::Vector4d wrong(0.87, 1.12, 0.9, 1.15);
  for (fit::TrialData& trial : data.trials) {
    trial.torque_nm += (stronger - 1.0) * trial.moment_arm_m.col(0).cwiseProduct(trial.force_n.col(0));
    trial.moment_arm_m *= wrong.asDiagonal();
    trial.velocity_mps *= wrong.asDiagonal();
    for (Eigen::Index k = 0; k < 4; ++k) {
      const auto& start = data.muscles[static_cast<std::size_t>(k)].start;
      const double middle = start.tendon_slack_length_m + start.optimal_fiber_length_m;
      trial.length_m.col(k).array() = middle + wrong[k] * (trial.length_m.col(k).array() - middle);
    }
  }
  fit::EstimatorOptions options;
  options.predictions = false;
  for (const fit::MuscleSetup& muscle : data.muscles) {
    options.state(muscle.emg_channel).gain_sd = 0.05;
    options.state(muscle.emg_channel).bandwidth_hz = 400.0;
  }
  std::filesystem::create_directories(folder);
  write_parameter_files({fit::identify_torque(data, options)}, {}, {}, {}, folder);
  return folder;
}

// The angle of a greatest torque that lies at the end of the recorded range in every draw.
TEST(CompareRuns, ANumberWithoutAWidthIsNotCompared) {
  const test::TemporaryFolder folder;
  const RunComparison c = compare_runs(run(folder.path() / "one", {{"TRI", 0.52194, 2e-15, "weak"}}, 1.0),
                                       run(folder.path() / "two", {{"TRI", 0.52223, 2e-15, "weak"}}, 1.0));
  EXPECT_EQ(c.parameters.at(0).change, Change::cannot_tell);
}

TEST(CompareRuns, AStrongerMuscleIsFoundWhereTheMomentArmsAreWrong) {
  const test::TemporaryFolder folder;
  const RunComparison c =
      compare_runs(session(folder.path() / "one", 1.0, 11), session(folder.path() / "two", 1.4, 12));
  int others = 0;
  for (const ComparedParameter& p : c.parameters) {
    if (p.first.parameter != "max_isometric_force") {
      others += p.change == Change::differs;
      continue;
    }
    // A muscle of which a session tells little beyond the priors is not compared.
    EXPECT_EQ(p.change == Change::differs, p.muscle == "BIC") << p.muscle;
    if (p.muscle != "BIC") continue;
    // 40 % of what these moment arms make of the strength, within two standard errors.
    EXPECT_NEAR(p.difference, 0.4 * p.first.estimate, *p.smallest_detectable);
    // Both sessions are shown in the reading that is compared, whose intervals exclude each other.
    EXPECT_EQ(p.of_first.low, p.first.given_ci_low);
    EXPECT_GT(*p.of_second.low, *p.of_first.high);
    EXPECT_NEAR(p.of_second.value - p.of_first.value, p.difference, 1e-9);
    // The intervals of the person overlap, although the change is certain.
    EXPECT_LT(*p.second.ci_low, *p.first.ci_high);
  }
  // Nothing else has changed; one of twenty may err by chance without the adjustment.
  EXPECT_EQ(others, 0);
}

TEST(CompareRuns, TellsChangeFromChanceAndFromIgnorance) {
  const test::TemporaryFolder folder;
  const auto first = run(folder.path() / "one",
                         {{"BIC", 600, 30, "identified"},
                          {"BRA", 900, 40, "identified"},
                          {"BRD", 250, 20, "prior_dominated"},
                          {"TRI", 1000, 50, "weak"},
                          {"ANC", 100, 5, "weak"}},
                         1.5);
  const auto second = run(folder.path() / "two",
                          {{"BIC", 780, 40, "identified"},
                           {"BRA", 930, 40, "weak"},
                           {"BRD", 400, 20, "identified"},
                           {"TRI", 1130, 40, "identified"}},
                          2.0);
  const RunComparison c = compare_runs(first, second);
  ASSERT_EQ(c.parameters.size(), 4u);
  // Standard error of the difference 50: z = 3.6, p = 3.2e-4, times the three that are compared.
  EXPECT_EQ(c.parameters[0].change, Change::differs);
  EXPECT_NEAR(*c.parameters[0].p_value, 3.0 * 3.182e-4, 1e-5);
  EXPECT_NEAR(*c.parameters[0].smallest_detectable, 1.96 * 50.0, 0.01);
  EXPECT_EQ(c.parameters[1].change, Change::no_change);
  EXPECT_EQ(c.parameters[2].change, Change::cannot_tell);
  EXPECT_FALSE(c.parameters[2].p_value);
  // z = 2.03 alone would be called a difference (p = 0.042); among three it is not.
  EXPECT_EQ(c.parameters[3].change, Change::no_change);
  EXPECT_NEAR(*c.parameters[3].p_value, 2.0 * 0.0423, 1e-3);
  EXPECT_NEAR(*c.parameters[3].p_alone, 0.0423, 1e-4);
  EXPECT_EQ(c.parameters[3].tested, 3);
  EXPECT_TRUE(c.parameters[3].differs_alone_only());
  EXPECT_FALSE(c.parameters[1].differs_alone_only());
  ASSERT_EQ(c.remarks.size(), 1u);
  EXPECT_NE(c.remarks[0].about.find("ANC"), std::string::npos);
  EXPECT_EQ(*c.trials[0].rmse_second_nm, 2.0);
  page::validate(comparison_report(c));
  // 180 N of 600 N, 1.96 standard errors 98 N; 11 % are 1.96 * sqrt(40^2 + 40^2) of 900 N.
  EXPECT_EQ(
      changes_sentence(c),
      "Biceps stronger: F_max larger by 180 N (30 %, 95 % 82 to 278 N); a change below 16 % would not have been seen. "
      "2 numbers "
      "show no change, and of 1 a recording does not tell enough. 1 of them differs by itself, but 3 numbers were "
      "tested, of which one in 20 does so by chance (Holm).");
  EXPECT_EQ(change_text(c.parameters[1]),
            "Brachialis: no change of F_max shows; a change below 12 % would not have been seen");
  ComparedParameter angle = c.parameters[0];
  angle.first.unit = Unit::radian;
  EXPECT_FALSE(has_scale(angle));
  EXPECT_TRUE(has_scale(c.parameters[0]));
  ComparedParameter doubled = c.parameters[0];
  doubled.difference = doubled.of_first.value;
  EXPECT_NE(change_text(doubled).find("(100 %, "), std::string::npos);
}

TEST(CompareRuns, APowerFollowsFromTheTorqueAndIsNoFurtherComparison) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double torque) {
    const auto path = run(folder.path() / name, {{"BIC", torque, 1, "identified"}, {"TRI", 50, 1, "identified"}}, 1.0);
    std::string json = read_text_file(path / "parameters.json");
    const std::string_view strength = "max_isometric_force";
    json.replace(json.find(strength), strength.size(), "voluntary_torque");
    json.replace(json.find(strength), strength.size(), "voluntary_power_60");
    write_file(path / "parameters.json", json);
    return path;
  };
  const RunComparison c = compare_runs(session("one", 40), session("two", 50));
  ASSERT_EQ(c.parameters.size(), 1U);
  EXPECT_EQ(c.parameters[0].first.parameter, "voluntary_torque");
  EXPECT_EQ(c.parameters[0].change, Change::differs);
  EXPECT_TRUE(c.remarks.empty());
}

TEST(CompareRuns, AStrengthAtTheLargestEmgIsNotThatOfFullEffort) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double force, bool maximal) {
    const auto path = run(folder.path() / name, {{"BIC", force, 1, "identified"}}, 1.0);
    std::string json = read_text_file(path / "parameters.json");
    const std::string_view before = "\"estimates\"";
    json.insert(json.find(before), fmt::format("\"maximal_contraction\": {}, ", maximal));
    write_file(path / "parameters.json", json);
    return path;
  };
  const auto first = session("one", 40, true);
  const RunComparison alike = compare_runs(first, session("two", 50, true));
  EXPECT_EQ(alike.parameters.at(0).change, Change::differs);
  EXPECT_TRUE(alike.unlike.empty());
  const RunComparison other = compare_runs(first, session("three", 50, false));
  EXPECT_EQ(other.parameters.at(0).change, Change::cannot_tell);
  ASSERT_EQ(other.unlike.size(), 1U);
  EXPECT_EQ(unlike_sentence(alike), "");
  EXPECT_NE(unlike_sentence(other).find(other.unlike[0]), std::string::npos);
}

TEST(CompareRuns, AJointsTorqueIsComparedWhereItsMusclesAreTheSame) {
  const test::TemporaryFolder folder;
  // The second number becomes the joint's; the muscles are BIC and, tied to it or not, BRA.
  const auto session = [&](const char* name, double torque, const char* other, const char* tied_to) {
    const auto path =
        run(folder.path() / name,
            {{"elbow", torque, 1, "identified"}, {"BIC", 100, 1, "weak"}, {other, 90, 1, "weak", tied_to}}, 1.0);
    std::string json = read_text_file(path / "parameters.json");
    const std::string_view strength = "max_isometric_force";
    json.replace(json.find(strength), strength.size(), "voluntary_torque_positive");
    write_file(path / "parameters.json", json);
    return path;
  };
  const auto change = [](const RunComparison& c) { return c.parameters.at(0).change; };
  const auto first = session("one", 40, "BRA", "");
  EXPECT_EQ(change(compare_runs(first, session("two", 50, "BRA", ""))), Change::differs);
  EXPECT_EQ(change(compare_runs(first, session("three", 50, "BRA", "BIC"))), Change::differs);
  EXPECT_EQ(change(compare_runs(first, session("four", 50, "BRD", ""))), Change::cannot_tell);
}

TEST(CompareRuns, AJointsTorqueThatOneMuscleMakesIsThatMusclesNumber) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double torque, double of_joint) {
    const auto path =
        run(folder.path() / name, {{"TRI", torque, 1, "identified"}, {"elbow", of_joint, 1, "identified"}}, 1.0);
    std::string json = read_text_file(path / "parameters.json");
    const std::string_view strength = "max_isometric_force";
    json.replace(json.find(strength), strength.size(), "voluntary_torque");
    json.replace(json.find(strength), strength.size(), "voluntary_torque_negative");
    write_file(path / "parameters.json", json);
    return path;
  };
  const RunComparison c = compare_runs(session("one", 40, 40), session("two", 50, 50));
  ASSERT_EQ(c.parameters.size(), 1U);
  EXPECT_EQ(c.parameters[0].muscle, "TRI");
  // Another muscle's share makes the joint's torque a number of its own.
  EXPECT_EQ(compare_runs(session("three", 40, 43), session("four", 50, 53)).parameters.size(), 2U);
}

TEST(CompareRuns, AnnouncesNothingFromMethodPaper) {
  // Shared forces of a person who did not change: the intervals of method paper exclude each other.
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double shared, double measured) {
    const auto path = run(folder.path() / name, {{"BIC", measured, 30, "identified"}}, 1.0);
    std::string json = read_text_file(path / "parameters.json");
    const std::string paper = fmt::format(
        R"({{"method": "paper", "trials": [], "estimates": [{{"muscle": "BIC", "parameter": "max_isometric_force",
            "unit": "N", "method": "paper", "case": "both", "estimate": {}, "std_error": 5, "ci_low": {}, "ci_high": {},
            "verdict": "identified"}}]}}, )",
        shared, shared - 10, shared + 10);
    json.insert(json.find("[{\"method\"") + 1, paper);
    write_file(path / "parameters.json", json);
    return path;
  };
  const RunComparison c = compare_runs(session("one", 500, 600), session("two", 700, 610));
  ASSERT_EQ(c.parameters.size(), 2U);
  EXPECT_EQ(c.parameters[0].first.method, fit::Method::paper);
  EXPECT_EQ(c.parameters[0].change, Change::cannot_tell);
  EXPECT_FALSE(c.parameters[0].p_value);
  ASSERT_EQ(counted_parameters(c).size(), 1U);
  EXPECT_EQ(counted_parameters(c)[0]->change, Change::no_change);
  const page::Report page = comparison_report(c);
  EXPECT_TRUE(page.headline.starts_with("No number changed")) << page.headline;
  // The answer comes first, method paper last.
  ASSERT_EQ(page.sections.front().changes.rows.size(), 1U);
  EXPECT_DOUBLE_EQ(page.sections.front().changes.rows[0].first.value, c.parameters[1].of_first.value);
  EXPECT_EQ(page.sections.back().id, "method_paper");
  EXPECT_EQ(c.first_date.size(), 10U);
}

// The reading given geometry and sensors knows nothing of the effort of another day.
TEST(CompareRuns, AGreatestTorqueIsTestedByItselfAndMayBeOfAnotherEffort) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double torque_nm) {
    std::filesystem::create_directories(folder / name);
    const auto row = [](const char* parameter, const char* unit, double value, double half) {
      return fmt::format(
          R"({{"muscle": "BIC", "parameter": "{0}", "unit": "{1}", "method": "torque", "case": "both",
              "estimate": {2}, "std_error": {3}, "ci_low": {4}, "ci_high": {5}, "given_estimate": {2},
              "given_ci_low": {6}, "given_ci_high": {7}, "verdict": "reproducible", "tied_to": ""}})",
          parameter, unit, value, half, value - 2.0 * half, value + 2.0 * half, value - half, value + half);
    };
    write_file(
        folder / name / "parameters.json",
        fmt::format(R"({{"methods": [{{"method": "torque", "estimates": [{}, {}], "trials": []}}]}})",
                    row("voluntary_torque", "N m", torque_nm, 3.92), row("optimal_fiber_length", "m", 0.1, 0.005)));
    return folder / name;
  };
  const RunComparison c = compare_runs(session("one", 100.0), session("two", 112.0));
  ASSERT_EQ(c.parameters.size(), 2U);
  // The middle of ln: sqrt(96.08 * 103.92) and sqrt(108.08 * 115.92).
  const double difference = 111.931 - 99.923, se = std::hypot(std::hypot(2.0, 2.99769), std::hypot(2.0, 3.35793));
  EXPECT_NEAR(*c.parameters[0].smallest_detectable, 1.96 * se, 2e-3);
  EXPECT_NEAR(*c.parameters[0].p_value, std::erfc(difference / se / std::sqrt(2.0)) / 0.9, 1e-4);
  EXPECT_EQ(c.parameters[0].change, Change::differs);
  EXPECT_NEAR(*c.parameters[1].smallest_detectable, 0.005 * std::sqrt(2.0), 1e-6) << "a length knows no effort";
}

TEST(CompareRuns, APercentHasNoExponent) {
  EXPECT_EQ(percent_text(105.2), "105");
  EXPECT_EQ(percent_text(-99.6), "-100");
  EXPECT_EQ(percent_text(7.26), "7.3");
  EXPECT_EQ(percent_text(-63.4), "-63");
}

TEST(CompareRuns, AFolderWithoutARunIsRefused) {
  const test::TemporaryFolder folder;
  const auto good = run(folder.path() / "one", {{"BIC", 600, 30, "identified"}}, 1.0);
  EXPECT_THROW(static_cast<void>(compare_runs(good, folder.path() / "none")), InvalidInput);
  std::filesystem::create_directories(folder.path() / "bad");
  write_file(folder.path() / "bad" / "parameters.json", "{\"methods\": [{}]}");
  EXPECT_THROW(static_cast<void>(compare_runs(good, folder.path() / "bad")), InvalidInput);
  // A file that a full disk cut off: the words are the program's, with the file and a remedy.
  const std::string whole = read_text_file(good / "parameters.json");
  write_file(folder.path() / "cut/parameters.json", whole.substr(0, whole.size() / 2));
  try {
    static_cast<void>(compare_runs(good, folder.path() / "cut"));
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("cut/parameters.json: is not the result of a run: the text breaks off or is damaged at byte"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("myoid run"), std::string::npos) << text;
    EXPECT_EQ(text.find("exception"), std::string::npos) << text;
  }
}

TEST(CompareRuns, SaysWhenTheTwoAreNotOfOneKind) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const char* model, double mass_kg) {
    std::filesystem::create_directories(folder / name);
    write_file(folder / name / "parameters.json",
               fmt::format(R"({{"provenance": {{"options": {{"subject": {{"mass_kg": {}}},
                        "model": {{"builtin": "{}", "coordinate": ["elbow_flexion"]}},
                        "muscle": [{{"name": "BIC"}}]}}}}, "methods": []}})",
                           mass_kg, model));
    return folder / name;
  };
  const auto first = write("a", "arm4", 60.0);
  EXPECT_TRUE(compare_runs(first, write("b", "arm4", 62.0)).unlike.empty());
  const RunComparison other = compare_runs(first, write("c", "arm7", 90.0));
  ASSERT_EQ(other.unlike.size(), 2U);
  EXPECT_NE(comparison_report(other).headline.find("arm7"), std::string::npos);
}

TEST(CompareRuns, SaysWhenTheEstimatorsDiffer) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const char* noise) {
    std::filesystem::create_directories(folder / name);
    write_file(folder / name / "parameters.json",
               fmt::format(R"({{"methods": [{{"noise": [{}], "estimates": [], "trials": []}}]}})", noise));
    return folder / name;
  };
  const auto earlier = write("a", "");
  EXPECT_TRUE(compare_runs(earlier, write("b", "")).unlike.empty());
  const RunComparison other = compare_runs(earlier, write("c", "0.5, -1.2"));
  ASSERT_EQ(other.unlike.size(), 1U);
  EXPECT_NE(other.unlike[0].find("one is by the posterior"), std::string::npos) << other.unlike[0];
}

}  // namespace
}  // namespace myoid::results
