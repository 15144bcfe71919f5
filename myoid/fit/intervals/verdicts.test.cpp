#include "myoid/fit/intervals/verdicts.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::fit {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A strength of 1000 N, half width 10 %, from a prior four times as wide.
NumberFacts good() {
  NumberFacts facts;
  facts.person.value = 1000.0;
  facts.person.low = 905.0;
  facts.person.high = 1100.0;
  facts.given.value = 1000.0;
  facts.given.low = 955.0;
  facts.given.high = 1040.0;
  facts.contraction = 0.94;
  facts.contraction_given = 0.99;
  facts.shares = {0.2, 0.05, 0.6, 0.0, 0.15, 0.0};
  return facts;
}

TEST(Verdicts, ANarrowIntervalIsIdentifiedAndSaysWhatItRestsOn) {
  const NumberFacts facts = good();
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_EQ(verdict_of(Finding::narrow), Verdict::identified);
  const std::string reason = reason_of(Finding::narrow, facts);
  EXPECT_THAT(reason, HasSubstr("± 10 % of the person, ± 4.5 % given geometry and sensors"));
  EXPECT_THAT(reason, HasSubstr("takes 94 % off"));
  EXPECT_THAT(reason, HasSubstr("geometry 60 %, noise of the torque 20 %, scale of the torque 15 %"));
  EXPECT_THAT(reason, Not(HasSubstr("prior belief")));
}

TEST(Verdicts, AWidthBeyondTheValueHasNoPowerOfTen) {
  NumberFacts facts = good();
  facts.person.high = 2.234 * facts.person.value;
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("± 123 %"));
}

TEST(Verdicts, AnAnglesWidthIsInDegrees) {
  NumberFacts facts = good();
  facts.contraction.reset();
  facts.scale = Scale::angle;
  facts.person.value = facts.given.value = 0.1;
  facts.person.low = 0.1 - 8.0 * kDegree;
  facts.person.high = 0.1 + 9.0 * kDegree;
  facts.given.low = 0.1 - 2.0 * kDegree;
  facts.given.high = 0.1 + 3.0 * kDegree;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("± 9° of the person, ± 3° given"));
  facts.at_range_end = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::weak);
  EXPECT_EQ(finding(facts), Finding::range_ends);
  facts.at_range_end = false;
  facts.person.high = 0.1 + 12.0 * kDegree;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::reproducible);
  facts.given.low = facts.person.low;
  facts.given.high = facts.person.high;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.person.high = 0.1 + 31.0 * kDegree;
  EXPECT_EQ(finding(facts), Finding::too_wide);
}

TEST(Verdicts, WhereTheModelIsWrongNothingIsIdentified) {
  NumberFacts facts = good();
  facts.fit.model_error = 0.19;
  EXPECT_EQ(finding(facts), Finding::narrow);
  facts.fit.model_error = 0.33;
  EXPECT_EQ(finding(facts), Finding::wrong_model);
  EXPECT_EQ(verdict_of(Finding::wrong_model), Verdict::weak);
  EXPECT_THAT(reason_of(Finding::wrong_model, facts), HasSubstr("33 %"));
}

TEST(Verdicts, AnIntervalThatABoundCutsOffIdentifiesNothing) {
  NumberFacts facts = good();
  facts.at_bound = true;
  EXPECT_EQ(finding(facts), Finding::cut_off);
  EXPECT_EQ(verdict_of(Finding::cut_off), Verdict::not_identifiable);
}

/// The same number, as wide with geometry and sensors exact as of the person.
NumberFacts with_equal_readings() {
  NumberFacts facts = good();
  facts.given.low = 500.0;
  facts.given.high = 1700.0;
  return facts;
}

TEST(Verdicts, TheFartherEndCounts) {
  NumberFacts facts = with_equal_readings();
  facts.person.high = 1130.0;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.person.high = 1700.0;
  EXPECT_EQ(finding(facts), Finding::too_wide);
  EXPECT_EQ(verdict_of(Finding::too_wide), Verdict::not_identifiable);
}

TEST(Verdicts, WhatIsNarrowOnlyGivenGeometryAndSensorsIsReproducible) {
  NumberFacts facts = good();
  facts.person.high = 1400.0;
  EXPECT_EQ(finding(facts), Finding::narrow_if_given);
  EXPECT_EQ(verdict_of(Finding::narrow_if_given), Verdict::reproducible);
  // Narrow, but by the prior.
  facts.contraction_given = 0.4;
  EXPECT_EQ(finding(facts), Finding::wide);
  // The model does not hold: neither reading means a muscle.
  facts.contraction_given = 0.99;
  facts.fit.model_error = 0.3;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.fit.model_error = 0.0;
  facts.given.high = 1130.0;
  EXPECT_EQ(finding(facts), Finding::wide);
}

TEST(Verdicts, ReadingsThatExcludeEachOtherIdentifyNothing) {
  NumberFacts facts = good();
  facts.given.value = 1250.0;
  facts.given.low = 1105.0;
  facts.given.high = 1450.0;
  EXPECT_EQ(finding(facts), Finding::readings_apart);
  EXPECT_EQ(verdict_of(Finding::readings_apart), Verdict::weak);
  // An optimal fiber length of a person of 104 to 139 mm that is narrow as 81 to 86 mm with exact geometry.
  NumberFacts fiber = good();
  fiber.person = {.value = 0.120, .low = 0.104, .high = 0.139};
  fiber.given = {.value = 0.0835, .low = 0.081, .high = 0.086};
  EXPECT_EQ(verdict_of(finding(fiber)), Verdict::weak);
  fiber.given = {.value = 0.1065, .low = 0.103, .high = 0.110};
  EXPECT_EQ(finding(fiber), Finding::narrow_if_given);
  // Not told by the recording, whatever the other reading says.
  fiber.given = {.value = 0.0835, .low = 0.081, .high = 0.086};
  fiber.contraction = 0.1;
  EXPECT_EQ(finding(fiber), Finding::as_the_prior);
}

TEST(Verdicts, WhatThePriorSaysIsNotIdentified) {
  NumberFacts facts = with_equal_readings();
  facts.contraction = 0.45;
  EXPECT_EQ(finding(facts), Finding::half_the_prior);
  facts.contraction = 0.1;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
  facts.contraction.reset();
  EXPECT_EQ(finding(facts), Finding::narrow);
  facts.nuisance_gain = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
}

TEST(Verdicts, AValueThatIsFarFromItsPriorIsNotIdentified) {
  NumberFacts facts = good();
  facts.prior_distance = 4.9;
  EXPECT_EQ(finding(facts), Finding::narrow_and_far);
  EXPECT_EQ(verdict_of(Finding::narrow_and_far), Verdict::weak);
  EXPECT_THAT(reason_of(Finding::narrow_and_far, facts), HasSubstr("4.9 standard"));
  facts.contraction = 0.1;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::not_identifiable);
  facts.contraction_given = 0.1;
  facts.prior_distance = 2.9;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
}

TEST(Verdicts, ASearchWithoutAnEndAndAnImpossibleMuscleComeFirst) {
  NumberFacts facts = good();
  facts.impossible = "no muscle has this";
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::non_physical);
  EXPECT_EQ(finding(facts), Finding::impossible);
  facts.fit.converged = false;
  facts.fit.failure = "it ran away";
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::non_physical);
  EXPECT_EQ(finding(facts), Finding::impossible);
  EXPECT_THAT(reason_of(Finding::impossible, facts), HasSubstr(facts.fit.failure));
  facts.impossible.clear();
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::not_identifiable);
}

TEST(Verdicts, AFitThatExplainsLittleIdentifiesNothing) {
  NumberFacts facts = good();
  facts.fit.r2 = 0.3;
  EXPECT_EQ(finding(facts), Finding::unexplained);
  EXPECT_EQ(verdict_of(Finding::unexplained), Verdict::not_identifiable);
  EXPECT_THAT(reason_of(Finding::unexplained, facts), HasSubstr("0.30"));
  facts.impossible = "no muscle has this";
  EXPECT_EQ(finding(facts), Finding::impossible);
}

TEST(Verdicts, OneLengthTellsNothingOfTheForceLengthCurveHoweverNarrow) {
  NumberFacts facts = good();
  facts.length_span = 0.04;
  facts.impossible = "no muscle has this";
  EXPECT_EQ(finding(facts), Finding::one_length);
  EXPECT_EQ(verdict_of(Finding::one_length), Verdict::prior_dominated);
  EXPECT_THAT(reason_of(Finding::one_length, facts), HasSubstr("4.0 %"));
  facts.impossible.clear();
  facts.length_span = 0.06;
  EXPECT_EQ(finding(facts), Finding::narrow);
}

TEST(Verdicts, DelaysAreJudgedInSeconds) {
  NumberFacts facts = good();
  facts.scale = Scale::delay;
  facts.person.value = 0.05;
  facts.person.low = 0.04;
  facts.person.high = 0.058;
  facts.given.value = 0.05;
  facts.given.low = 0.045;
  facts.given.high = 0.056;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("± 10 ms"));
}

TEST(Verdicts, ANumberThatIsZeroByNatureIsJudgedByItsUsualSize) {
  NumberFacts facts = good();
  facts.person.value = 0.02;
  facts.person.low = -0.38;
  facts.person.high = 0.42;
  facts.given.low = -0.37;
  facts.given.high = 0.41;
  facts.given.value = 0.02;
  EXPECT_EQ(finding(facts), Finding::too_wide);
  facts.usual_size = 1.0;
  EXPECT_EQ(finding(facts), Finding::wide);
  EXPECT_THAT(reason_of(Finding::wide, facts), HasSubstr("± 40 %"));
  facts.usual_size = 0.5;  // wider than 60 %, and still half of what was known
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.usual_size = 4.0;
  EXPECT_EQ(finding(facts), Finding::narrow);
}

TEST(Verdicts, SaysWhereTheApproximationWasNotChecked) {
  NumberFacts facts = good();
  facts.fit.approximate = true;
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("approximate"));
}

TEST(Verdicts, OneReadingNamesNoOther) {
  NumberFacts facts = good();
  facts.fit.one_reading = true;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(finding(facts), facts), Not(HasSubstr("given geometry")));
  facts.fit.given_strength = true;
  EXPECT_EQ(finding(facts), Finding::given_strength);
  EXPECT_EQ(verdict_of(Finding::given_strength), Verdict::weak);
}

TEST(Verdicts, ANumberWithoutEffectOrBesideAnImpossibleOneIsNotIdentifiable) {
  for (const auto& [set, first] : std::vector<std::pair<std::function<void(NumberFacts&)>, Finding>>{
           {[](NumberFacts& f) { f.determined = false; }, Finding::undetermined},
           {[](NumberFacts& f) { f.no_effect = "V_ml is 1"; }, Finding::no_effect},
           {[](NumberFacts& f) { f.bad_company = "l_sh"; }, Finding::bad_company}}) {
    NumberFacts facts = good();
    set(facts);
    EXPECT_EQ(finding(facts), first);
    EXPECT_EQ(verdict_of(first), Verdict::not_identifiable);
    EXPECT_THAT(reason_of(first, facts), HasSubstr(facts.no_effect + facts.bad_company));
  }
}

TEST(Verdicts, AForceThatAnOptimizerSharedIsNoMeasurement) {
  NumberFacts facts = good();
  facts.fit.shared_force = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
}

IdentificationResult three_numbers() {
  IdentificationResult result;
  result.method = Method::torque;
  result.estimates = {
      {.muscle = "BIC", .parameter = "max_isometric_force", .verdict = Verdict::identified, .reason = "a"},
      {.muscle = "BIC", .parameter = "optimal_fiber_length", .verdict = Verdict::identified},
      {.muscle = "TRI", .parameter = "max_isometric_force", .verdict = Verdict::not_identifiable}};
  return result;
}

std::vector<Verdict> after(const std::vector<VerdictCap>& caps) {
  IdentificationResult result = three_numbers();
  apply(caps, result);
  std::vector<Verdict> verdicts;
  for (const ParameterEstimate& e : result.estimates) verdicts.push_back(e.verdict);
  return verdicts;
}

constexpr Verdict kYes = Verdict::identified, kWeak = Verdict::weak, kNo = Verdict::not_identifiable;

TEST(VerdictCap, LowersWhatItNamesAndNeverRaises) {
  EXPECT_EQ(after({}), (std::vector{kYes, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r"}}), (std::vector{kWeak, kWeak, kNo}));
  EXPECT_EQ(after({{.reason = "r", .owners = {"TRI"}}}), (std::vector{kYes, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r", .owners = {"BIC"}, .parameters = {"max_isometric_force"}}}),
            (std::vector{kWeak, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r", .method = Method::paper}}), (std::vector{kYes, kYes, kNo}));
}

TEST(VerdictCap, TheFirstReasonStands) {
  IdentificationResult result = three_numbers();
  apply({{.reason = "first", .owners = {"BIC"}}, {.reason = "second"}}, result);
  EXPECT_EQ(result.estimates[0].reason, "first");
  EXPECT_EQ(result.estimates[2].reason, "");
}

TEST(VerdictCap, AMistakeStandsInEveryReasonThatItTouches) {
  IdentificationResult result = three_numbers();
  result.estimates[2].reason = "wide";
  const std::vector<VerdictCap> caps{{.reason = "mend", .comes_first = true}};
  apply(caps, result);
  apply(caps, result);  // once
  EXPECT_EQ(result.estimates[0].reason, "mend");
  EXPECT_EQ(result.estimates[2].reason, "mend wide");
  EXPECT_EQ(result.estimates[2].verdict, kNo);
}

TEST(VerdictCap, OfAStrengthIsOfTheTorquesThatItMakes) {
  IdentificationResult result;
  result.method = Method::torque;
  VoluntaryCurve joint{.owner = "elbow", .joint = "elbow", .of_joint = true, .direction = 1, .muscles = {"BIC", "BRA"}};
  joint.ending = "_positive";
  result.voluntary = {joint};
  const auto add = [&](const char* owner, const char* parameter) {
    ParameterEstimate& e = result.estimates.emplace_back();
    e.muscle = owner;
    e.parameter = parameter;
    e.verdict = Verdict::identified;
  };
  add("BIC", "voluntary_torque");
  add("BIC", "voluntary_torque_angle");
  add("BRA", "voluntary_power_60");
  add("elbow", "voluntary_torque_positive");
  add("elbow", "voluntary_torque_negative");
  apply({{.reason = "level", .owners = {"BIC"}, .parameters = {"max_isometric_force"}}}, result);
  const auto verdict = [&](std::size_t i) { return result.estimates[i].verdict; };
  EXPECT_EQ(verdict(0), Verdict::weak);
  EXPECT_EQ(verdict(1), Verdict::identified);
  EXPECT_EQ(verdict(2), Verdict::identified);
  EXPECT_EQ(verdict(3), Verdict::weak);
  EXPECT_EQ(verdict(4), Verdict::identified);
}

TEST(AgreeOnTied, TheWorstVerdictIsThatOfAll) {
  const auto owner = [](const char* muscle, const char* tied_to, Verdict verdict) {
    ParameterEstimate e;
    e.muscle = muscle;
    e.tied_to = tied_to;
    e.verdict = verdict;
    e.reason = muscle;
    return e;
  };
  std::vector<ParameterEstimate> estimates{owner("X", "", Verdict::identified), owner("BIC", "", Verdict::identified),
                                           owner("BRA", "BIC", Verdict::weak),
                                           owner("TRI", "BIC", Verdict::identified)};
  agree_on_tied(estimates, 3);
  EXPECT_EQ(estimates[0].verdict, Verdict::identified);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(estimates[i].verdict, Verdict::weak) << i;
    EXPECT_EQ(estimates[i].reason, "BRA") << i;
  }
}

}  // namespace
}  // namespace myoid::fit
