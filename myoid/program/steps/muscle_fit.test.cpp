#include "myoid/program/steps/muscle_fit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_muscle.h"

namespace myoid::program {
namespace {

using muscle::IsolatedModel;
using muscle::IsolatedRecording;

std::vector<IsolatedRecording> swings(const IsolatedModel& truth) {
  return test::swings(truth, {0.0008, 0.0012, 0.0016, 0.0022, 0.003});
}

MuscleFitSettings settings_of(const std::vector<std::string>& names) {
  return {.fit = {.parameters = names}, .relative_to_n = 2.0};
}

TEST(MuscleFit, ANumberThatExactForcesTellIsIdentifiedAndOneThatTheyDoNotIsNot) {
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.4;
  Remarks remarks{Call{}};
  const MuscleFit fit =
      fit_muscle(test::small_muscle(), swings(truth), settings_of({"max_isometric_force", "passive_shape"}), remarks);
  ASSERT_EQ(fit.judgments.size(), 2U);
  EXPECT_EQ(fit.judgments[0].verdict, fit::Verdict::identified) << fit.judgments[0].reason;
  EXPECT_LT(fit.judgments[0].low, 2.4);
  EXPECT_GT(fit.judgments[0].high, 2.4);
  // Millard's curves do not use the exponent: the interval is the belief, a third to three times the start.
  EXPECT_EQ(fit.judgments[1].verdict, fit::Verdict::not_identifiable) << fit.judgments[1].reason;
  EXPECT_NEAR(fit.judgments[1].low, 4.0 / 3.0, 1e-9);
  EXPECT_NEAR(fit.judgments[1].high, 12.0, 1e-9);
}

TEST(MuscleFit, TheLawsThatMadeTheForcesPredictThemBest) {
  IsolatedModel truth = test::small_muscle();
  truth.laws = muscle::thelen_laws();
  truth.parameters.hill.eccentric_plateau = 1.6;
  truth.parameters.hill.max_isometric_force_n = 2.2;
  IsolatedModel start = test::small_muscle();
  start.parameters.hill.eccentric_plateau = 1.6;
  MuscleFitSettings settings = settings_of({"max_isometric_force"});
  settings.laws = {muscle::LawSet::paper, muscle::LawSet::millard, muscle::LawSet::thelen};
  Remarks remarks{Call{}};
  const MuscleFit fit = fit_muscle(start, swings(truth), settings, remarks);
  ASSERT_EQ(fit.laws.size(), 3U);
  EXPECT_EQ(fit.laws[0].laws, muscle::LawSet::thelen);
  EXPECT_EQ(fit.laws[0].worse_by, 0.0);
  EXPECT_FALSE(fit.laws[1].ties);
  EXPECT_TRUE(fit.all.model.laws == muscle::thelen_laws());
  EXPECT_NEAR(fit.all.estimates[0].value, 2.2, 1e-3);
}

TEST(MuscleFit, LawsThatTieStayThoseOfTheMuscle) {
  // Held at the optimal length of both, passive force and velocity do not act: only the rounding of the fits differs.
  IsolatedModel start = test::small_muscle();
  start.laws = muscle::thelen_laws();
  start.laws.mode = muscle::TendonMode::rigid;
  std::vector<IsolatedRecording> recordings;
  for (const double noise_n : {-0.02, 0.0, 0.03}) {
    IsolatedRecording r = test::swing(0.0, "held");
    r.input.length_m.setConstant(0.04);
    r.force_n = Eigen::VectorXd::Constant(r.time_s.size(), 2.1 + noise_n);
    recordings.push_back(r);
  }
  MuscleFitSettings settings = settings_of({"max_isometric_force"});
  settings.laws = {muscle::LawSet::paper, muscle::LawSet::thelen};
  Remarks remarks{Call{}};
  const MuscleFit fit = fit_muscle(start, recordings, settings, remarks);
  EXPECT_TRUE(fit.laws[0].ties && fit.laws[1].ties);
  EXPECT_TRUE(fit.all.model.laws == start.laws);
  recordings.pop_back();
  EXPECT_THROW((void)fit_muscle(start, recordings, settings, remarks), InvalidInput);
}

/// Two isometric seconds, then a stretch by 2 mm that is held; driven from 0.2 s.
IsolatedRecording stretched(const IsolatedModel& truth, double length_m, double rise_m, double enhancement_n) {
  IsolatedRecording r{.name = "stretch"};
  r.input.time_s = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  r.input.length_m = (length_m + rise_m * ((r.input.time_s.array() - 2.0) / 0.5).min(1.0).max(0.0)).matrix();
  r.input.drive_time_s = Eigen::Vector2d(0.0, 0.2);
  r.input.drive = Eigen::Vector2d(0.0, 1.0);
  r.input.drive_is_excitation = true;
  r.input.initial_activation = 0.01;
  r.time_s = r.input.time_s;
  r.force_n = isolated_force(truth, r, 1e-6);
  for (Eigen::Index k = 210; k < 401; ++k) r.force_n[k] += enhancement_n;
  return r;
}

TEST(MuscleFit, ResidualForceEnhancementIsToldAndNotFittedAway) {
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.2;
  const auto fit_with = [&](double enhancement_n, Remarks& remarks) {
    return fit_muscle(test::small_muscle(),
                      {stretched(truth, 0.0405, 0.0, 0.0), stretched(truth, 0.041, 0.0, 0.0),
                       stretched(truth, 0.0395, 0.002, enhancement_n)},
                      settings_of({"max_isometric_force"}), remarks);
  };
  const auto told = [](const Remarks& remarks) {
    std::vector<Remark> list = remarks.list();
    std::erase_if(list, [](const Remark& r) { return r.code != RemarkCode::force_enhancement; });
    return list;
  };
  Remarks of_enhanced{Call{}}, of_plain{Call{}};
  const MuscleFit fit = fit_with(0.4, of_enhanced);
  EXPECT_NEAR(fit.all.estimates[0].value, 2.2, 1e-3);
  ASSERT_EQ(told(of_enhanced).size(), 1U);
  // The tolerance of the fit's F_max.
  EXPECT_NEAR(*told(of_enhanced)[0].value, 0.4, 2e-3);
  EXPECT_NEAR(told(of_enhanced)[0].when->begin_s, 2.0, 0.05);
  (void)fit_with(0.0, of_plain);
  EXPECT_TRUE(told(of_plain).empty());
}

}  // namespace
}  // namespace myoid::program
