#include "myoid/results/answer.h"

#include <algorithm>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/core/wrapped_text.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::Verdict;
using fit::VoluntaryCurve;
using testing::ElementsAre;
using testing::HasSubstr;

ParameterEstimate number(const std::string& muscle,
                         const std::string& parameter,
                         Unit unit,
                         double low,
                         double value,
                         double high,
                         Verdict verdict) {
  ParameterEstimate e{.muscle = muscle, .tied_to = {}, .parameter = parameter, .unit = unit};
  e.initial = value;
  e.estimate = value;
  e.ci_low = low;
  e.ci_high = high;
  e.verdict = verdict;
  return e;
}

/// A triceps that alone extends the elbow, and an optimal fiber length that is known better than a force.
IdentificationResult triceps() {
  IdentificationResult method;
  method.method = fit::Method::torque;
  VoluntaryCurve curve{.owner = "TRI", .joint = "elbow_flexion", .direction = -1, .muscles = {"TRI"}};
  curve.angle_rad = Eigen::Vector3d(40.0, 54.0, 90.0) * kDegree;
  curve.torque_nm = Eigen::Vector3d(50.0, 54.5, 45.0);
  VoluntaryCurve joint = curve;
  joint.owner = "elbow_flexion";
  joint.ending = "_negative";
  joint.of_joint = true;
  method.voluntary = {curve, joint};
  const double angle = 54.0 * kDegree;
  method.estimates = {
      number("TRI", "max_isometric_force", Unit::newton, 1809.0, 2223.0, 2736.0, Verdict::reproducible),
      number("TRI", "optimal_fiber_length", Unit::meter, 0.106, 0.115, 0.124, Verdict::identified),
      number("TRI", "eccentric_plateau", Unit::dimensionless, 1.1, 1.4, 1.7, Verdict::prior_dominated),
      number("TRI", "voluntary_torque", Unit::newton_meter, 51.4, 54.5, 58.0, Verdict::identified),
      number("TRI", "voluntary_torque_angle", Unit::radian, angle, angle, angle, Verdict::identified),
      number("elbow_flexion", "voluntary_torque_negative", Unit::newton_meter, 51.4, 54.5, 58.0, Verdict::identified)};
  return method;
}

std::vector<std::string> texts(const std::vector<AnswerRow>& rows) {
  std::vector<std::string> lines;
  for (const AnswerRow& row : rows) lines.push_back(row.number + ": " + row.value + ", " + row.of_person);
  return lines;
}

TEST(AnswerRows, AreToldNumbersTheStrengthFirstAndEachOnce) {
  EXPECT_THAT(texts(answer_rows(triceps(), 1, 10)),
              ElementsAre("Triceps, greatest torque: 54.5 N m at 54°, 51.4 to 58.0",
                          "Triceps, optimal fiber length: 11.5 cm, 10.6 to 12.4",
                          "Triceps, max isometric force: 2223 N, 1809 to 2736"));
  EXPECT_EQ(answer_rows(triceps(), 1, 2).size(), 2U);
}

TEST(AnswerRows, SayThatAnEffortWasNotMaximal) {
  IdentificationResult method = triceps();
  method.voluntary[0].from_mvc = false;
  EXPECT_THAT(texts(answer_rows(method, 1, 1)), ElementsAre(HasSubstr("Triceps, at the largest EMG: ")));
}

TEST(TrialsSentence, NamesTheWorstTrialsFirst) {
  run::StudyResult result;
  EXPECT_EQ(trials_sentence(result), "");
  result.trials.resize(4);
  for (std::size_t i = 0; i < 4; ++i) result.trials[i].spec.name = "t" + std::to_string(i);
  result.trials[0].faults = {{.code = RemarkCode::emg_hum, .severity = Severity::note}};
  EXPECT_EQ(trials_sentence(result), "No trial has a warning.");
  result.trials[1].faults = {{.code = RemarkCode::emg_clipped, .about = "BIC"}};
  result.trials[2].remarks = {{.code = RemarkCode::general, .says = "cut"}};
  const std::string alone = trials_sentence(result);
  result.trials[1].faults[0].likewise = {"t2", "t3"};
  EXPECT_GT(trials_sentence(result).size(), alone.size());  // what all trials have speaks against none alone
  result.trials[1].faults[0].likewise.clear();
  result.trials[3].motion.failure = "no markers";
  EXPECT_EQ(trials_sentence(result),
            "Trials with warnings: t3 (could not be computed), t1 (EMG clipped: BIC), t2 (cut).");
  EXPECT_EQ(trials_sentence(result, 1), "Trials with warnings: t3 (could not be computed) and 2 more.");
}

TEST(AnswerText, HasAtMost24LinesOfTheWidth) {
  run::StudyResult result;
  IdentificationResult method = triceps();
  for (int m = 0; m < 40; ++m) {
    const std::string muscle = "a_muscle_with_a_long_name_" + std::to_string(m);
    method.estimates.push_back(
        number(muscle, "optimal_fiber_length", Unit::meter, 0.106, 0.115, 0.124, Verdict::identified));
  }
  result.fit.methods = {method};
  std::vector<page::Gate> gates;
  for (int g = 0; g < 12; ++g)
    gates.push_back({.name = "Question " + std::to_string(g),
                     .status = g < 8 ? page::GateStatus::fail : page::GateStatus::warn,
                     .value = std::string(150, 'v'),
                     .threshold = "less"});
  for (const std::size_t width : {40, 80, 110}) {
    const std::string text = answer_text(result, gates, width);
    EXPECT_LE(std::ranges::count(text, '\n'), 24) << text;
    EXPECT_THAT(text, HasSubstr("Do not use the numbers."));
    // A name may be broken between its words.
    for (const page::Gate& gate : gates)
      EXPECT_THAT(std::regex_replace(text, std::regex(R"(\s+)"), " "), HasSubstr(gate.name)) << text;
    EXPECT_THAT(text, HasSubstr("First mend"));
    if (width < 80) continue;
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
      EXPECT_LE(columns_of(text.substr(at, text.find('\n', at) - at)), width) << text;
  }
}

TEST(AnswerText, AsksForAMovementOnlyIfItTellsMore) {
  const auto expected = [](double half_width, Verdict verdict) {
    return std::vector{
        number("BIC", "optimal_fiber_length", Unit::meter, 0.1 - half_width, 0.1, 0.1 + half_width, verdict)};
  };
  run::StudyResult result;
  result.fit.methods = {triceps()};
  const auto text_after = [&](double half_width, Verdict verdict) {
    run::DesignStudyResult next;
    next.beforehand = expected(0.02, Verdict::weak);
    next.plan.resize(1);
    next.plan[0].expected = expected(half_width, verdict);
    result.next = next;
    return answer_text(result, {}, 100);
  };
  EXPECT_THAT(text_after(0.0198, Verdict::weak), HasSubstr("Further movements tell little more"));
  EXPECT_THAT(text_after(0.012, Verdict::weak), HasSubstr("Record next: "));
  EXPECT_THAT(text_after(0.0198, Verdict::identified), HasSubstr("and 1 more would be identified"));
  // Movements make up for no maximal contraction: the advice begins with one where none was recorded.
  result.source.study.emg = {.kind = study::EmgKind::raw, .has_mvc = false};
  const std::string without = next_sentence(result, {});
  result.source.study.emg.has_mvc = true;
  const std::string with = next_sentence(result, {});
  EXPECT_TRUE(without.ends_with(with) && without.size() > with.size()) << without;
}

TEST(FitSentences, TakeTheR2OfTrialsWhoseTorqueVaries) {
  run::StudyResult result;
  result.fit.methods = {triceps()};
  const auto fold = [](double spread_nm, double error_nm) {
    fit::Fold f;
    f.identified = f.literature = {
        .n = 100.0, .sse = 100.0 * error_nm * error_nm, .sst = 100.0 * spread_nm * spread_nm, .mean_nm = 2.0};
    return f;
  };
  result.folds = {fold(1.0, 0.5), fold(0.0, 0.7), fold(0.01, 0.7)};
  EXPECT_THAT(fit_sentences(result, false), HasSubstr("75 % (R2, median of 1 that vary"));
  result.folds.resize(1);
  EXPECT_THAT(fit_sentences(result, false), HasSubstr("75 % (R2, median)"));
  result.folds = {fold(0.01, 0.7)};
  EXPECT_THAT(fit_sentences(result, false), ::testing::Not(HasSubstr("R2")));
}

}  // namespace
}  // namespace myoid::results
