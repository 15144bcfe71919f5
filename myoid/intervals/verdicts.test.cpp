#include "myoid/intervals/verdicts.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/units.h"

namespace myoid::identification {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A strength of 1000 N, half width 10 %, from a prior four times as wide.
NumberFacts good() {
  NumberFacts facts;
  facts.value = 1000.0;
  facts.low = 905.0;
  facts.high = 1100.0;
  facts.given = 1000.0;
  facts.low_given = 955.0;
  facts.high_given = 1040.0;
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
  facts.high = 2.234 * facts.value;
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("± 123 % of the person"));
}

TEST(Verdicts, AnAnglesWidthIsInDegrees) {
  NumberFacts facts = good();
  facts.contraction.reset();
  facts.is_angle = true;
  facts.value = facts.given = 0.1;
  facts.low = 0.1 - 8.0 * kDegree;
  facts.high = 0.1 + 9.0 * kDegree;
  facts.low_given = 0.1 - 2.0 * kDegree;
  facts.high_given = 0.1 + 3.0 * kDegree;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("± 9° of the person, ± 3° given"));
  facts.at_range_end = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::weak);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("may lie beyond"));
  facts.at_range_end = false;
  facts.high = 0.1 + 12.0 * kDegree;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::reproducible);
  facts.low_given = facts.low;
  facts.high_given = facts.high;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.high = 0.1 + 31.0 * kDegree;
  EXPECT_EQ(finding(facts), Finding::too_wide);
}

TEST(Verdicts, WhereTheModelIsWrongNothingIsIdentified) {
  NumberFacts facts = good();
  facts.model_error = 0.19;
  EXPECT_EQ(finding(facts), Finding::narrow);
  facts.model_error = 0.33;
  EXPECT_EQ(finding(facts), Finding::wrong_model);
  EXPECT_EQ(verdict_of(Finding::wrong_model), Verdict::weak);
  EXPECT_THAT(reason_of(Finding::wrong_model, facts), HasSubstr("the model errs by 33 %"));
}

TEST(Verdicts, AnIntervalThatABoundCutsOffIdentifiesNothing) {
  NumberFacts facts = good();
  facts.at_bound = true;
  EXPECT_EQ(finding(facts), Finding::cut_off);
  EXPECT_EQ(verdict_of(Finding::cut_off), Verdict::not_identifiable);
  EXPECT_THAT(reason_of(Finding::cut_off, facts), HasSubstr("ends at a bound"));
}

/// The same number, as wide with geometry and sensors exact as of the person.
NumberFacts with_equal_readings() {
  NumberFacts facts = good();
  facts.low_given = 500.0;
  facts.high_given = 1700.0;
  return facts;
}

TEST(Verdicts, TheFartherEndCounts) {
  NumberFacts facts = with_equal_readings();
  facts.high = 1130.0;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.high = 1700.0;
  EXPECT_EQ(finding(facts), Finding::too_wide);
  EXPECT_EQ(verdict_of(Finding::too_wide), Verdict::not_identifiable);
}

TEST(Verdicts, WhatIsNarrowOnlyGivenGeometryAndSensorsIsReproducible) {
  NumberFacts facts = good();
  facts.high = 1400.0;
  EXPECT_EQ(finding(facts), Finding::narrow_if_given);
  EXPECT_EQ(verdict_of(Finding::narrow_if_given), Verdict::reproducible);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("compare sessions of this person"));
  // Narrow, but by the prior.
  facts.contraction_given = 0.4;
  EXPECT_EQ(finding(facts), Finding::wide);
  // The model does not hold: neither reading means a muscle.
  facts.contraction_given = 0.99;
  facts.model_error = 0.3;
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.model_error = 0.0;
  facts.high_given = 1130.0;
  EXPECT_EQ(finding(facts), Finding::wide);
}

TEST(Verdicts, ReadingsThatExcludeEachOtherIdentifyNothing) {
  NumberFacts facts = good();
  facts.given = 1250.0;
  facts.low_given = 1105.0;
  facts.high_given = 1450.0;
  EXPECT_EQ(finding(facts), Finding::readings_apart);
  EXPECT_EQ(verdict_of(Finding::readings_apart), Verdict::weak);
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
  EXPECT_THAT(reason_of(Finding::narrow_and_far, facts),
              AllOf(HasSubstr("a simplification of the model"), HasSubstr("4.9 standard deviations away")));
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
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("no muscle has this; "));
  facts.converged = false;
  facts.failure = "it ran away";
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::non_physical);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("it ran away; it stopped where no muscle can be"));
  facts.impossible.clear();
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::not_identifiable);
}

TEST(Verdicts, AFitThatExplainsLittleIdentifiesNothing) {
  NumberFacts facts = good();
  facts.r2 = 0.3;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::not_identifiable);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("explains little of the torque (R2 0.30)"));
  facts.impossible = "no muscle has this";
  EXPECT_EQ(finding(facts), Finding::impossible);
}

TEST(Verdicts, OneLengthTellsNothingOfTheForceLengthCurveHoweverNarrow) {
  NumberFacts facts = good();
  facts.length_span = 0.04;
  facts.impossible = "no muscle has this";
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("changed by 4.0 % of the optimal one"));
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("record other joint angles"));
  facts.impossible.clear();
  facts.length_span = 0.06;
  EXPECT_EQ(finding(facts), Finding::narrow);
}

TEST(Verdicts, DelaysAreJudgedInSeconds) {
  NumberFacts facts = good();
  facts.is_delay = true;
  facts.value = 0.05;
  facts.low = 0.04;
  facts.high = 0.058;
  facts.given = 0.05;
  facts.low_given = 0.045;
  facts.high_given = 0.056;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("± 10 ms"));
}

TEST(Verdicts, ANumberThatIsZeroByNatureIsJudgedByItsUsualSize) {
  NumberFacts facts = good();
  facts.value = 0.02;
  facts.low = -0.38;
  facts.high = 0.42;
  facts.low_given = -0.37;
  facts.high_given = 0.41;
  facts.given = 0.02;
  EXPECT_EQ(finding(facts), Finding::too_wide);
  facts.usual_size = 1.0;
  EXPECT_EQ(finding(facts), Finding::wide);
  EXPECT_THAT(reason_of(Finding::wide, facts), HasSubstr("± 40 % of the person"));
  facts.usual_size = 0.5;  // wider than 60 %, and still half of what was known
  EXPECT_EQ(finding(facts), Finding::wide);
  facts.usual_size = 4.0;
  EXPECT_EQ(finding(facts), Finding::narrow);
}

TEST(Verdicts, SaysWhereTheApproximationWasNotChecked) {
  NumberFacts facts = good();
  facts.approximate = true;
  EXPECT_THAT(reason_of(Finding::narrow, facts), HasSubstr("approximate"));
}

TEST(Verdicts, OneReadingNamesNoOther) {
  NumberFacts facts = good();
  facts.one_reading = true;
  EXPECT_EQ(finding(facts), Finding::narrow);
  EXPECT_THAT(reason_of(finding(facts), facts), Not(HasSubstr("given geometry")));
  facts.given_strength = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::weak);
  EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr("if F_max is the value at which it was held"));
}

TEST(Verdicts, ANumberWithoutEffectOrBesideAnImpossibleOneIsNotIdentifiable) {
  for (const auto& [set, words] : std::vector<std::pair<std::function<void(NumberFacts&)>, std::string>>{
           {[](NumberFacts& f) { f.determined = false; }, "cannot tell them apart"},
           {[](NumberFacts& f) { f.no_effect = "V_ml is 1"; }, "V_ml is 1"},
           {[](NumberFacts& f) { f.bad_company = "l_sh"; }, "the same fit puts l_sh where no muscle can be"}}) {
    NumberFacts facts = good();
    set(facts);
    EXPECT_EQ(verdict_of(finding(facts)), Verdict::not_identifiable);
    EXPECT_THAT(reason_of(finding(facts), facts), HasSubstr(words));
  }
}

TEST(Verdicts, AForceThatAnOptimizerSharedIsNoMeasurement) {
  NumberFacts facts = good();
  facts.shared_force = true;
  EXPECT_EQ(verdict_of(finding(facts)), Verdict::prior_dominated);
}

}  // namespace
}  // namespace myoid::identification
