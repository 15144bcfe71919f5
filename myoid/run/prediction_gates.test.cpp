#include "myoid/run/prediction_gates.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/fit/intervals/estimate_rows.h"

namespace myoid::run {
namespace {

using fit::Fold;
using fit::IdentificationResult;
using page::Gate;
using page::GateStatus;

/// A trial of 1000 samples about `mean_nm`, a sine of the amplitude, predicted with this error.
fit::TrialFit trial(double mean_nm, double amplitude_nm, double error_nm, bool own = true) {
  fit::TrialFit fit;
  fit.calibration = own;
  fit.torque_nm = mean_nm + amplitude_nm * (Eigen::VectorXd::LinSpaced(1000, 0.0, 62.8).array().sin());
  fit.torque_fit_nm = fit.torque_nm;
  fit.band = fit::score(fit.torque_nm, fit.torque_nm.array() + error_nm);
  return fit;
}

GateStatus status_of(const std::vector<Gate>& gates, std::string_view name) {
  const auto it = std::find_if(gates.begin(), gates.end(), [&](const Gate& g) { return g.name == name; });
  return it == gates.end() ? GateStatus::info : it->status;
}

TEST(Explained, R2AndRmsAreOneStatement) {
  IdentificationResult fit;
  fit.trials = {trial(2.0, 1.0, 0.5), trial(12.0, 3.0, -1.0)};
  const Explained all = explained(fit, true);
  // Both trials as one series.
  Eigen::VectorXd measured(2000), error(2000);
  measured << fit.trials[0].torque_nm, fit.trials[1].torque_nm;
  error << Eigen::VectorXd::Constant(1000, 0.5), Eigen::VectorXd::Constant(1000, -1.0);
  const fit::Score whole = fit::score(measured, measured + error);
  EXPECT_NEAR(all.rms_nm, whole.rmse_nm(), 1e-12);
  EXPECT_NEAR(all.r2(), whole.r2(), 1e-12);
  EXPECT_NEAR(all.r2(), 1.0 - std::pow(all.rms_nm / all.spread_nm, 2), 1e-12);
  EXPECT_NEAR(all.torque_rms_nm, std::sqrt(measured.squaredNorm() / 2000.0), 1e-12);
}

TEST(Explained, JointsHaveMeansOfTheirOwn) {
  IdentificationResult fit;
  fit.trials = {trial(2.0, 1.0, 0.5), trial(-20.0, 1.0, 0.5)};
  fit.trials[0].joint = "elbow";
  fit.trials[1].joint = "shoulder";
  EXPECT_NEAR(explained(fit, true).spread_nm, std::sqrt(0.5), 1e-3);
  fit.trials[1].joint = "elbow";
  EXPECT_NEAR(explained(fit, true).spread_nm, std::hypot(11.0, std::sqrt(0.5)), 1e-2);
}

TEST(FitGates, WhatIsWorseThanAnUnrelatedTorqueFails) {
  const auto gate = [](double mean, double amplitude, double error, bool own) {
    IdentificationResult fit;
    fit.trials = {trial(mean, amplitude, error, own)};
    return status_of(fit_gates(fit), own ? "Describes the torque it was fitted to" : "Predicts the trials held back");
  };
  for (const bool own : {true, false}) {
    EXPECT_EQ(gate(2.0, 1.0, 0.3, own), GateStatus::pass);
    EXPECT_EQ(gate(2.0, 1.0, 0.9, own), GateStatus::warn);  // R2 -0.6, 42 % of the torque
    EXPECT_EQ(gate(1.0, 1.0, 0.8, own), GateStatus::fail);  // R2 -0.3, 65 % of the torque
    // R2 -11, 1.93 of 2.05 N m rms: that no torque at all is even farther off is no merit.
    EXPECT_EQ(gate(2.0, 0.75, 1.93, own), GateStatus::fail);
    EXPECT_EQ(gate(0.0, 1.0, 0.8, own), GateStatus::fail);
    // A torque that hardly changes, predicted to 3 %.
    EXPECT_EQ(gate(10.0, 0.1, 0.3, own), GateStatus::warn);
  }
}

TEST(FitGates, AFitThatExplainsLittleOfItsSamplesDoesNotDescribeThem) {
  IdentificationResult fit;
  fit.trials = {trial(2.0, 1.0, 0.3, true)};
  fit.r2 = -0.1;  // worse than the mean
  EXPECT_EQ(status_of(fit_gates(fit), "Describes the torque it was fitted to"), GateStatus::fail);
  fit.r2 = 0.4;
  const Gate gate = fit_gates(fit)[0];
  EXPECT_EQ(gate.status, GateStatus::warn);
  EXPECT_NE(gate.value.find("R2 0.40 of the fitted samples"), std::string::npos) << gate.value;
  fit.r2 = 0.6;
  EXPECT_EQ(fit_gates(fit)[0].status, GateStatus::pass);
}

TEST(FitGates, AMuscleThatLeftTheLiteratureIsNamed) {
  IdentificationResult fit;
  fit.prior_distances = {{"BIC", 1.2, "max_isometric_force", 2.1}, {"TRI", 2.0, "force_length_width", 2.9}};
  const char* name = "Muscles within what is known of them";
  EXPECT_EQ(status_of(fit_gates(fit), name), GateStatus::pass);
  fit.prior_distances[0].farthest_distance = 3.8;
  EXPECT_EQ(status_of(fit_gates(fit), name), GateStatus::warn);
  EXPECT_NE(fit_gates(fit)[0].value.find("isometric force 3.8)"), std::string::npos);
  fit.prior_distances[0].farthest_distance = 2.1;
  fit.prior_distances[1].distance = 3.2;
  EXPECT_EQ(status_of(fit_gates(fit), name), GateStatus::warn);
}

TEST(FitGates, AReservationOfTheFitIsAWarningButForDistancesThatHaveAGate) {
  IdentificationResult fit;
  fit.prior_distances = {{"BIC", 1.2, "max_isometric_force", 3.8}};
  fit::add_distances_to(fit.warnings, fit.prior_distances);
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_EQ(fit_gates(fit).size(), 1U);
  fit.warnings.push_back({.code = RemarkCode::several_modes, .says = "two modes"});
  const std::vector<Gate> gates = fit_gates(fit);
  ASSERT_EQ(gates.size(), 2U);
  EXPECT_EQ(gates[1].value, "two modes");
  EXPECT_EQ(status_of(gates, "Fit without reservations"), GateStatus::warn);
}

Fold fold(const std::string& name, double amplitude_nm, double error_nm) {
  Fold f;
  f.trial = name;
  f.measured_nm = 2.0 + amplitude_nm * Eigen::VectorXd::LinSpaced(1000, 0.0, 62.8).array().sin();
  f.predicted_nm = f.measured_nm.array() + error_nm;
  f.identified = f.band = fit::score(f.measured_nm, f.predicted_nm);
  f.literature = fit::score(f.measured_nm, f.measured_nm.array() + 2.0);
  return f;
}

fit::Score with_rms(double rms_nm) { return {.n = 1000.0, .sse = 1000.0 * rms_nm * rms_nm}; }

TEST(OutlyingFolds, OneThatIsPredictedWorseThanTheOthersIsNamed) {
  std::vector<Fold> folds;
  for (const double error : {0.84, 1.17, 1.20, 1.25, 1.32}) folds.push_back(fold("t", 3.0, error));
  EXPECT_TRUE(outlying_folds(folds).empty());
  folds.push_back(fold("wrong", 3.0, 2.4));
  const std::vector<OutlyingFold> found = outlying_folds(folds);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].trial, "wrong");
  EXPECT_NEAR(found[0].usual_rms_nm, std::sqrt(1.20 * 1.25), 1e-9);
  EXPECT_EQ(status_of(fold_gates(folds), "Trials alike"), GateStatus::warn);
}

TEST(OutlyingFolds, OneAmongEffortsOfSeveralSizesIsNamedByTheShareOfItsTorque) {
  // Errors of 10 to 20 % of efforts of several sizes scatter fivefold in N m. One trial has exchanged electrodes.
  std::vector<Fold> folds;
  const double amplitudes[] = {10.0, 30.0, 20.0, 15.0, 20.0, 4.0, 5.0, 6.0};
  const double shares[] = {0.12, 0.13, 0.11, 0.2, 0.15, 0.2, 0.18, 0.1};
  for (std::size_t i = 0; i < 8; ++i) folds.push_back(fold("t", amplitudes[i], amplitudes[i] * shares[i]));
  EXPECT_TRUE(outlying_folds(folds).empty());
  folds.push_back(fold("exchanged", 4.0, 8.0));
  const std::vector<OutlyingFold> found = outlying_folds(folds);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].trial, "exchanged");
}

TEST(OutlyingFolds, ASmallErrorOfATorqueThatHardlyChangesIsNone) {
  std::vector<Fold> folds;
  for (const double error : {0.84, 1.17, 1.20, 1.25, 1.32}) folds.push_back(fold("t", 3.0, error));
  folds.push_back(fold("held still", 0.1, 1.3));
  EXPECT_TRUE(outlying_folds(folds).empty());
}

TEST(OutlyingFolds, AHeavierTrialThatIsPredictedAsWellIsNone) {
  std::vector<Fold> folds;
  for (const double error : {0.84, 1.17, 1.20, 1.25, 1.32}) folds.push_back(fold("t", 3.0, error));
  folds.push_back(fold("heavy", 12.0, 2.4));
  EXPECT_TRUE(outlying_folds(folds).empty());
}

TEST(GeneralisesBadly, FitsThatDoNotReachBeyondWhatTheySawAreNamed) {
  const auto fold = [](const char* name, double seen_nm, double unseen_nm) {
    Fold f;
    f.trial = name;
    f.measured_nm = 4.0 * Eigen::VectorXd::LinSpaced(500, 0.0, 40.0).array().sin();
    f.fitted = {.n = 1.0, .sse = seen_nm * seen_nm};
    f.identified = {.n = 1.0, .sse = unseen_nm * unseen_nm};
    return f;
  };
  EXPECT_EQ(generalises_badly({fold("a", 1.0, 1.1), fold("b", 1.0, 1.2)}), "");
  // Twice as bad, but still most of the torque.
  EXPECT_EQ(generalises_badly({fold("a", 0.2, 0.6), fold("b", 0.2, 0.6)}), "");
  const std::string text = generalises_badly({fold("a", 1.0, 2.5), fold("fast", 1.0, 4.0)});
  EXPECT_NE(text.find("most in 'fast'"), std::string::npos) << text;
  EXPECT_EQ(generalises_badly({}), "");
}

TEST(FoldGates, FailWhereTrialsLeftOutArePredictedWorseThanByTheirMean) {
  const char* name = "Predicts torque it has not seen";
  EXPECT_EQ(status_of(fold_gates({fold("a", 3.0, 0.5), fold("b", 3.0, 0.6)}), name), GateStatus::pass);
  EXPECT_EQ(status_of(fold_gates({fold("a", 3.0, 2.5), fold("b", 3.0, 2.6)}), name), GateStatus::fail);
  // Better than the literature, and yet a third of the torque only.
  EXPECT_EQ(status_of(fold_gates({fold("a", 3.0, 1.75), fold("b", 3.0, 1.75)}), name), GateStatus::warn);
  EXPECT_EQ(status_of(fold_gates({fold("a", 1.0, 1.8), fold("b", 1.0, 1.8)}), name), GateStatus::fail);
}

TEST(FoldGates, NameTheLimitThatFailedThem) {
  // R2 -0.95 of a torque about zero: the errors are larger than the torque.
  std::vector<Fold> folds{fold("a", 1.0, 0.0), fold("b", 1.0, 0.0)};
  for (Fold& f : folds) {
    const Eigen::VectorXd measured = f.measured_nm.array() - f.measured_nm.mean();
    f.band = fit::score(measured, measured.array() + 0.9874);
  }
  const Gate gate = fold_gates(folds)[0];
  EXPECT_EQ(gate.status, GateStatus::fail);
  EXPECT_NE(gate.threshold.find("fails if the errors are larger than the torque, or than 50 % of it "
                                "at an R2 below 0"),
            std::string::npos)
      << gate.threshold;
  EXPECT_NE(gate.value.find("R2 -0.95: 0.99 N m rms below 1.5 Hz, where the torque is 0.71 rms and "
                            "varies by 0.71"),
            std::string::npos)
      << gate.value;
}

TEST(FoldGates, DoNotPassWhereTheLiteraturePredictsBetterOverAll) {
  const char* name = "Predicts torque it has not seen";
  // A little better in two trials, much worse in the third.
  std::vector<Fold> folds{fold("a", 3.0, 0.5), fold("b", 3.0, 0.5), fold("c", 3.0, 1.5)};
  for (std::size_t i = 0; i < 3; ++i) folds[i].literature = with_rms(i < 2 ? 0.6 : 0.9);
  EXPECT_EQ(status_of(fold_gates(folds), name), GateStatus::warn);
  folds[2].literature = with_rms(1.6);
  EXPECT_EQ(status_of(fold_gates(folds), name), GateStatus::pass);
}

TEST(FoldGates, WithoutFoldsTheQuestionWasNotAsked) {
  for (const bool wanted : {true, false}) {
    const std::vector<Gate> gates = fold_gates({}, wanted);
    ASSERT_EQ(gates.size(), 1U);
    EXPECT_FALSE(gates[0].asked);
    EXPECT_EQ(gates[0].status, GateStatus::info);
  }
}

TEST(FoldGates, SayWhichPredictionGoesBeyondTheEffortsThatWereFitted) {
  std::vector<Fold> folds{fold("light", 1.0, 1.8), fold("heavy", 1.0, 1.8), fold("well", 1.0, 0.1)};
  folds[1].unseen = {"biceps", 2.84};
  folds[2].unseen = {"triceps", 3.0};  // predicted well: nothing to explain
  const std::string hint = fold_gates(folds)[0].why;
  EXPECT_NE(hint.find("beyond all that was fitted ('heavy': biceps 2.8 times)"), std::string::npos) << hint;
  EXPECT_NE(hint.find("Record a maximal contraction"), std::string::npos) << hint;
  const std::string gain = fold_gates(folds, true, "Correct the gain.")[0].why;
  EXPECT_EQ(gain.find("Record a maximal contraction"), std::string::npos) << gain;
  EXPECT_NE(gain.find("Correct the gain"), std::string::npos) << gain;
  folds[1].unseen.ratio = 1.4;
  EXPECT_EQ(fold_gates(folds)[0].why.find("beyond"), std::string::npos);
}

}  // namespace
}  // namespace myoid::run
