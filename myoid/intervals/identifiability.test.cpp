#include "myoid/intervals/identifiability.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

/// An estimate of 1 with the interval 1 -+ half.
ParameterEstimate estimate(double half, const std::string& parameter = "optimal_fiber_length") {
  ParameterEstimate e;
  e.muscle = "BIC";
  e.parameter = parameter;
  e.estimate = 1.0;
  e.std_error = half / 1.96;
  e.ci_low = 1.0 - half;
  e.ci_high = 1.0 + half;
  return e;
}

Verdict verdict_of(ParameterEstimate e, const VerdictContext& context = {}) {
  judge(e, context);
  EXPECT_FALSE(e.reason.empty());
  return e.verdict;
}

TEST(Judge, GoesByTheWidthOfTheInterval) {
  EXPECT_EQ(verdict_of(estimate(0.10)), Verdict::identified);
  EXPECT_EQ(verdict_of(estimate(0.16)), Verdict::weak);
  EXPECT_EQ(verdict_of(estimate(0.59)), Verdict::weak);
  EXPECT_EQ(verdict_of(estimate(0.61)), Verdict::not_identifiable);
}

TEST(Judge, CallsAValueThatThePriorMadeByItsName) {
  ParameterEstimate e = estimate(0.05);
  e.shrinkage = 0.2;
  EXPECT_EQ(verdict_of(e), Verdict::prior_dominated);
  e.shrinkage = 0.8;
  EXPECT_EQ(verdict_of(e), Verdict::identified);
}

TEST(Judge, AValueThatLeftTheLiteratureIsNotCalledTheLiteratures) {
  // Biceps F_max 397 N of 1060 +- 265 (3.9 spreads of the logarithm), less sure than beforehand.
  ParameterEstimate e = estimate(0.5, "max_isometric_force");
  e.shrinkage = -0.44;
  EXPECT_EQ(verdict_of(e, {.prior_distance = 3.9}), Verdict::not_identifiable);
  judge(e, {.prior_distance = 3.9});
  EXPECT_NE(e.reason.find("3.9 standard deviations"), std::string::npos) << e.reason;
  EXPECT_EQ(verdict_of(e, {.prior_distance = 2.2}), Verdict::prior_dominated);
  judge(e, {.prior_distance = 2.2});
  EXPECT_EQ(e.reason.find("mostly the literature"), std::string::npos) << e.reason;
  EXPECT_NE(e.reason.find("does not narrow it"), std::string::npos) << e.reason;
  judge(e, {.prior_distance = 0.3});
  EXPECT_NE(e.reason.find("mostly the literature"), std::string::npos) << e.reason;
  EXPECT_EQ(e.reason.find("0 %"), std::string::npos) << e.reason;
  // Whatever the verdict, its reason says so.
  for (const double half : {0.05, 0.4, 0.9}) {
    ParameterEstimate far = estimate(half);
    far.shrinkage = 0.9;
    judge(far, {.prior_distance = 4.5});
    EXPECT_NE(far.verdict, Verdict::identified);
    EXPECT_NE(far.reason.find("4.5 standard deviations"), std::string::npos) << far.reason;
  }
}

TEST(Judge, AMuscleWhoseNumbersTogetherLeftTheLiteratureIsNotIdentified) {
  ParameterEstimate e = estimate(0.05);
  e.shrinkage = 0.9;
  EXPECT_EQ(verdict_of(e, {.prior_distance = 2.0, .muscle_distance = 2.9}), Verdict::identified);
  EXPECT_EQ(verdict_of(e, {.prior_distance = 2.0, .muscle_distance = 3.1}), Verdict::weak);
}

TEST(Judge, ACurveThatNoMuscleHasIsNonPhysicalHoweverSharp) {
  ParameterEstimate e = estimate(0.01, "force_length_width");
  e.shrinkage = 0.9;
  for (const double none : {0.09, 0.19, 1.1})
    EXPECT_EQ(verdict_of(e, {.relative_width = none}), Verdict::non_physical) << none;
  for (const double some : {0.25, 0.45, 0.71})
    EXPECT_EQ(verdict_of(e, {.relative_width = some}), Verdict::identified) << some;
  judge(e, {.relative_width = 0.09});
  EXPECT_NE(e.reason.find("0.09 of the optimal length"), std::string::npos) << e.reason;
}

TEST(Judge, AWidthOnTheBoundOfWhatMusclesHaveIsNonPhysical) {
  ParameterEstimate e = estimate(0.01, "force_length_width");
  e.at_bound = true;
  // The bound is of the start's optimal length, the ratio of the fitted one's.
  for (const double ratio : {0.18, 0.22}) {
    judge(e, {.relative_width = ratio});
    EXPECT_EQ(e.verdict, Verdict::non_physical) << ratio;
  }
  EXPECT_NE(e.reason.find("beyond what muscles have, 0.2 to 1"), std::string::npos) << e.reason;
  // A bound of the study's own says nothing about muscles.
  EXPECT_EQ(verdict_of(e, {.given_bound = true, .relative_width = 0.3}), Verdict::not_identifiable);
  const auto beside = estimate(0.05, "optimal_fiber_length");
  EXPECT_EQ(verdict_of(beside, {.curve_width = 0.22}), Verdict::identified);
  EXPECT_EQ(verdict_of(beside, {.curve_width = 0.22, .width_leans = true}), Verdict::weak);
}

TEST(Judge, NumbersBesideACurveThatNoMuscleHasAreNotIdentified) {
  const auto narrow = estimate(0.05, "concentric_curvature");
  EXPECT_EQ(verdict_of(narrow, {.curve_width = 0.45}), Verdict::identified);
  EXPECT_EQ(verdict_of(narrow, {.curve_width = 0.1}), Verdict::weak);
  ParameterEstimate e = estimate(0.3, "concentric_curvature");
  judge(e, {.curve_width = 0.1});
  EXPECT_NE(e.reason.find("curve that no muscle has"), std::string::npos) << e.reason;
}

TEST(Judge, ThePlaceOfThePeakOfACurveThatNoMuscleHasSaysNothing) {
  ParameterEstimate e = estimate(0.03, "optimal_fiber_length");
  EXPECT_EQ(verdict_of(e, {.curve_width = 0.45}), Verdict::identified);
  judge(e, {.curve_width = 0.05});
  EXPECT_EQ(e.verdict, Verdict::not_identifiable);
  EXPECT_NE(e.reason.find("0.05 of the optimal length"), std::string::npos) << e.reason;
  // The data alone and exactly: whoever made them knows why.
  EXPECT_EQ(verdict_of(e, {.curve_width = 0.0}), Verdict::identified);
}

TEST(EquivalentDeviations, AreThoseOfTheChiSquareDistribution) {
  // Tables: P(chi2_k > x) = 0.0027 (three standard deviations) at x = 9.00, 11.83, 16.25, 20.06 for
  // k = 1, 2, 4, 6, and 0.05 at x = 12.592 for k = 6. Their digits
  // leave 0.001.
  for (const auto& [k, x] : {std::pair{1, 9.0}, {2, 11.83}, {4, 16.25}, {6, 20.06}})
    EXPECT_NEAR(equivalent_deviations(x, k), 3.0, 0.001) << k;
  EXPECT_NEAR(equivalent_deviations(12.592, 6), 1.95996, 0.001);
  EXPECT_EQ(equivalent_deviations(0.0, 4), 0.0);
  EXPECT_GT(equivalent_deviations(400.0, 6), 8.0);
  EXPECT_EQ(equivalent_deviations(1e5, 6), std::sqrt(1e5));  // a tail below the smallest number
}

TEST(Judge, ANarrowIntervalIsNotEnough) {
  ParameterEstimate e = estimate(0.05);
  e.shrinkage = 0.4;
  EXPECT_EQ(verdict_of(e), Verdict::weak);
  e.shrinkage = 0.8;
  EXPECT_EQ(verdict_of(e, {.model_error = 0.25}), Verdict::weak);
  EXPECT_EQ(verdict_of(e, {.model_error = 0.05}), Verdict::identified);
  EXPECT_EQ(verdict_of(e, {.shares_electrode_with = "BIC"}), Verdict::weak);
  ParameterEstimate cut = estimate(0.05);
  cut.ci_high = 1.2;  // 0.95 to 1.2: the half of it would be 12.5 %
  EXPECT_EQ(verdict_of(cut), Verdict::weak);
  judge(e, {.rests_on = "lowering_4kg"});
  EXPECT_EQ(e.verdict, Verdict::weak);
  EXPECT_NE(e.reason.find("lowering_4kg"), std::string::npos);
}

TEST(Judge, NeverTrustsWhatIsNotAnAnswer) {
  EXPECT_EQ(verdict_of(estimate(0.01), {.determined = false}), Verdict::not_identifiable);
  EXPECT_EQ(verdict_of(estimate(0.01), {.converged = false, .failure = "why"}), Verdict::not_identifiable);
  EXPECT_EQ(verdict_of(estimate(0.01), {.outside_physical = true}), Verdict::non_physical);
  ParameterEstimate bound = estimate(0.01);
  bound.at_bound = true;
  EXPECT_EQ(verdict_of(bound), Verdict::not_identifiable);
  ParameterEstimate nothing = estimate(0.01);
  nothing.estimate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict_of(nothing), Verdict::not_identifiable);
  ParameterEstimate open = estimate(0.01);
  open.ci_low.reset();
  EXPECT_EQ(verdict_of(open), Verdict::not_identifiable);
}

TEST(Judge, AFitThatErrsMoreThanTheMeanKnowsNothing) {
  for (const double half : {0.005, 0.4}) {
    ParameterEstimate e = estimate(half, "max_isometric_force");
    judge(e, {.r2 = -0.01});
    EXPECT_EQ(e.verdict, Verdict::not_identifiable) << half;
    EXPECT_NE(e.reason.find("R2 -0.01"), std::string::npos) << e.reason;
  }
  ParameterEstimate prior = estimate(0.4, "max_isometric_force");
  prior.shrinkage = 0.01;
  EXPECT_EQ(verdict_of(prior, {.r2 = -1.0}), Verdict::prior_dominated);
}

TEST(Judge, AFitThatExplainsLittleIdentifiesNothing) {
  for (const char* parameter : {"optimal_fiber_length", "joint_viscosity", "emg_delay"}) {
    ParameterEstimate e = estimate(0.005, parameter);
    e.prior_sd = 0.2;
    EXPECT_EQ(verdict_of(e, {.r2 = 0.51}), Verdict::identified) << parameter;
    EXPECT_EQ(verdict_of(e, {.r2 = 0.49}), Verdict::weak) << parameter;
    EXPECT_EQ(verdict_of(e, {.r2 = 0.01}), Verdict::weak) << parameter;
  }
  ParameterEstimate none = estimate(0.005, "emg_delay");
  none.estimate = 0.0;
  none.at_bound = true;
  none.ci_high = 0.005;
  EXPECT_EQ(verdict_of(none), Verdict::identified);
  EXPECT_EQ(verdict_of(none, {.r2 = 0.3}), Verdict::weak);
}

TEST(Judge, OfWhatIsZeroByNatureOnlyAValueIsIdentifiedAndABoundIsWeak) {
  // gamma 0 [0, 0.038] of 0 +- 0.1: that there is hardly any is something that the recording tells.
  ParameterEstimate e;
  e.parameter = "length_activation";
  e.at_bound = true;
  e.std_error = 0.02;
  e.ci_low = 0.0;
  e.ci_high = 0.038;
  e.prior_sd = 0.1;
  e.shrinkage = 0.96;
  EXPECT_EQ(verdict_of(e), Verdict::weak);
  judge(e, {});
  EXPECT_NE(e.reason.find("at most 0.038"), std::string::npos) << e.reason;
  e.ci_high = 0.13;
  EXPECT_EQ(verdict_of(e), Verdict::weak);
  e.shrinkage = 0.2;
  EXPECT_EQ(verdict_of(e), Verdict::prior_dominated);
  // Viscosity 0.593 [0.31, 1.00] N m s/rad of 0 +- 0.2 is clear of 0, however wide for its size.
  ParameterEstimate viscosity;
  viscosity.parameter = "joint_viscosity";
  viscosity.unit = Unit::newton_meter_second;
  viscosity.estimate = 0.593;
  viscosity.std_error = 0.17;
  viscosity.ci_low = 0.31;
  viscosity.ci_high = 1.00;
  viscosity.prior_sd = 0.2;
  viscosity.shrinkage = 0.4;
  EXPECT_EQ(verdict_of(viscosity), Verdict::weak);
  // Stiffness -0.9 [-1.63, -0.17] of 0 +- 1.1: within its prior, and not known to 12 %.
  ParameterEstimate stiffness = viscosity;
  stiffness.parameter = "joint_stiffness";
  stiffness.estimate = -0.9;
  stiffness.ci_low = -1.63;
  stiffness.ci_high = -0.17;
  stiffness.prior_sd = 1.1;
  stiffness.shrinkage = 0.9;
  EXPECT_EQ(verdict_of(stiffness), Verdict::weak);
  stiffness.ci_low = -1.0;
  stiffness.ci_high = -0.8;
  EXPECT_EQ(verdict_of(stiffness), Verdict::identified);
  // On its other bound it is pulled where there is none.
  e.estimate = 0.5;
  e.ci_low = 0.4;
  e.ci_high = 0.5;
  EXPECT_EQ(verdict_of(e), Verdict::not_identifiable);
}

TEST(Judge, AForceHeldWhereItWasPutVouchesForNothing) {
  ParameterEstimate e = estimate(0.05, "force_length_width");
  EXPECT_EQ(verdict_of(e, {.given_strength = true}), Verdict::weak);
  judge(e, {.given_strength = true});
  EXPECT_NE(e.reason.find("F_max"), std::string::npos);
}

TEST(Judge, SaysHowFarTheTruthMayBe) {
  // 0.227 [0.15, 0.37]: the farther end is 63 % away.
  ParameterEstimate e = estimate(0.1, "concentric_curvature");
  e.estimate = 0.227;
  e.ci_low = 0.15;
  e.ci_high = 0.37;
  EXPECT_NEAR(half_width(e), 0.143, 1e-12);
  judge(e, {});
  EXPECT_NE(e.reason.find("63 %"), std::string::npos) << e.reason;
}

TEST(Judge, AProductWithoutARiseInLengtheningHasNoMeaning) {
  EXPECT_EQ(verdict_of(estimate(0.01, "eccentric_curvature_product"), {.plateau_is_flat = true}),
            Verdict::not_identifiable);
  EXPECT_EQ(verdict_of(estimate(0.01, "eccentric_plateau"), {.plateau_is_flat = true}), Verdict::identified);
}

TEST(Judge, NamesTheErrorThatTheSourcePapersValuesAreTheSignatureOf) {
  // Table II: brachialis V_ml 0.147, brachioradialis P -1.29.
  ParameterEstimate plateau = estimate(0.01, "eccentric_plateau");
  plateau.estimate = 0.147;
  judge(plateau, {.outside_physical = true});
  EXPECT_EQ(plateau.verdict, Verdict::non_physical);
  EXPECT_NE(plateau.reason.find("co-contraction"), std::string::npos);
  ParameterEstimate product = estimate(0.01, "eccentric_curvature_product");
  product.estimate = -1.29;
  judge(product, {.outside_physical = true});
  EXPECT_NE(product.reason.find("delay"), std::string::npos);
}

TEST(Judge, AFitThatStoppedWhereNoMuscleIsNamesNoCause) {
  ParameterEstimate product = estimate(0.01, "eccentric_curvature_product");
  product.estimate = -0.005;
  judge(product, {.converged = false, .failure = "steps diverged", .outside_physical = true});
  EXPECT_EQ(product.verdict, Verdict::non_physical);
  EXPECT_EQ(product.reason.find("delay"), std::string::npos) << product.reason;
  EXPECT_NE(product.reason.find("steps diverged"), std::string::npos) << product.reason;
}

TEST(Judge, AWideCurveIsNotBlamedOnWhatNarrowsIt) {
  ParameterEstimate width = estimate(0.01, "force_length_width");
  width.initial = 0.5;
  judge(width, {.outside_physical = true});
  EXPECT_EQ(width.reason.find("co-contraction"), std::string::npos) << width.reason;
  width.initial = 2.0;
  judge(width, {.outside_physical = true});
  EXPECT_NE(width.reason.find("co-contraction"), std::string::npos) << width.reason;
}

TEST(Judge, SaysWhosePriorItIsAndInWhatItIsMeasured) {
  ParameterEstimate e = estimate(0.1);
  e.shrinkage = 0.2;
  judge(e, {.prior_distance = 0.2, .beforehand = "what the study gave beforehand"});
  EXPECT_EQ(e.reason.find("mostly what the study gave beforehand"), 0U) << e.reason;
  e.shrinkage = 0.9;
  judge(e, {.prior_distance = 4.0, .prior_of_logarithm = true});
  EXPECT_NE(e.reason.find("4.0 standard deviations of the prior (of the logarithm)"), std::string::npos) << e.reason;
}

TEST(Judge, APriorOfTheStudysOwnThatTheDataContradictIsToldSo) {
  // 0.08 -+ 0.0005 given, the data alone 0.047 -+ 0.002: the fit ends between, at a precision of
  // 1/0.0005^2 + 1/0.002^2, 0.0019 below the one. It has moved by 3.9 of the given spreads, and by
  // 16 of what a fit with that prior moves, sqrt(P - C).
  const double p = 0.0005 * 0.0005, c = 1.0 / (1.0 / p + 1.0 / (0.002 * 0.002));
  ParameterEstimate e = estimate(0.001);
  e.shrinkage = 1.0 - c / p;
  const double moved = (0.08 - 0.047) * c / (0.002 * 0.002) / 0.0005;
  EXPECT_NEAR(moved, 3.9, 0.05);
  // Moved by less it still is a contradiction, and the literature's alone is not called one.
  judge(e, {.prior_distance = 0.25 * moved, .prior_is_given = true});
  EXPECT_EQ(e.verdict, Verdict::not_identifiable);
  EXPECT_NE(e.reason.find("contradicts"), std::string::npos) << e.reason;
  judge(e, {.prior_distance = 0.25 * moved});
  EXPECT_EQ(e.verdict, Verdict::prior_dominated);
}

TEST(Judge, ABoundThatWasGivenIsNotCalledPhysical) {
  ParameterEstimate e = estimate(0.01);
  e.at_bound = true;
  judge(e, {.given_bound = true});
  EXPECT_EQ(e.verdict, Verdict::not_identifiable);
  EXPECT_EQ(e.reason.find("physically"), std::string::npos) << e.reason;
  judge(e, {});
  EXPECT_NE(e.reason.find("physically"), std::string::npos) << e.reason;
}

TEST(Judge, WhatAMuscleNeverDidIsSaid) {
  ParameterEstimate e = estimate(0.3, "eccentric_plateau");
  judge(e, {.never = "lengthened"});
  EXPECT_EQ(e.verdict, Verdict::not_identifiable);
  EXPECT_NE(e.reason.find("never lengthened while active"), std::string::npos) << e.reason;
  e.shrinkage = 0.0;
  EXPECT_EQ(verdict_of(e, {.never = "lengthened"}), Verdict::prior_dominated);
}

TEST(Judge, ACurvatureBesideAFreeSpeedSaysSo) {
  ParameterEstimate e = estimate(0.3, "concentric_curvature");
  judge(e, {.speed_is_free = true});
  EXPECT_NE(e.reason.find("v_max is not known"), std::string::npos) << e.reason;
  judge(e, {});
  EXPECT_EQ(e.reason.find("v_max"), std::string::npos) << e.reason;
}

TEST(Judge, ADelayOfZeroThatCouldBeAnyIsNoFinding) {
  ParameterEstimate e = estimate(0.1, "emg_delay");
  e.estimate = 0.0;
  e.at_bound = true;
  e.ci_low = 0.0;
  e.ci_high = 0.15;
  judge(e, {});
  EXPECT_EQ(e.verdict, Verdict::not_identifiable);
  EXPECT_NE(e.reason.find("any delay up to 150 ms"), std::string::npos) << e.reason;
  e.ci_high = 0.01;
  EXPECT_EQ(verdict_of(e), Verdict::identified);
}

TEST(Judge, TheDelayIsJudgedInMilliseconds) {
  const auto delay = [](double half) {
    ParameterEstimate e = estimate(half, "emg_delay");
    e.estimate = 0.05;
    e.ci_low = 0.05 - half;
    e.ci_high = 0.05 + half;
    return e;
  };
  EXPECT_EQ(verdict_of(delay(0.01)), Verdict::identified);
  EXPECT_EQ(verdict_of(delay(0.04)), Verdict::weak);
}

TEST(Judge, WithoutAMaximalContractionForceIsRelativeToTheLargestEmg) {
  ParameterEstimate e = estimate(0.05, "max_isometric_force");
  judge(e, {.from_mvc = false});
  EXPECT_NE(e.reason.find("maximal contraction"), std::string::npos);
}

}  // namespace
}  // namespace myoid::identification
