#include "myoid/run/design/design_study.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

using testing::HasSubstr;

study::Study planned_study() {
  study::Study study;
  study.model.builtin = "arm4";
  for (const char* name : {"BIC", "BRA", "BRD", "TRI"})
    study.muscles.push_back({.name = name, .osim = {name}, .emg = name});
  return study;
}

MovementPerson typical(const std::vector<fit::MuscleSetup>& setups) {
  MovementPerson person;
  for (const auto& s : setups) person.muscles.push_back(fit::muscle_values(s.start));
  return person;
}

TEST(Movement, TheMusclesOfAPerformanceExertTheTorqueThatTheMotionRequires) {
  const study::Study study = planned_study();
  const auto setups = study::muscle_setups(study, study::load_model(study));
  const MovementPerson person = typical(setups);
  for (const bool horizontal : {false, true}) {
    const MovementCourse course = movement_course(
        study, movement_models(study, study::load_model(study)),
        {.horizontal = horizontal, .held_mass_kg = 1.0, .lowest_rad = 0.5, .highest_rad = 2.0, .frequency_hz = 0.6});
    const auto trial = perform(course, setups, person);
    ASSERT_TRUE(trial);
    const Eigen::Index lead = course.time_s.size() - trial->time_s.size();
    // Sum of r a F over the muscles, by hand, with the EMG read a delay earlier.
    for (Eigen::Index i = 0; i < trial->time_s.size(); i += 17) {
      double torque = 0.0;
      for (Eigen::Index k = 0; k < 4; ++k) {
        const auto& p = setups[static_cast<std::size_t>(k)].start;
        const double a = trial->activation.values()(lead + i, k);
        EXPECT_GE(a, person.co_contraction);
        torque += trial->moment_arm_m(i, k) *
                  muscle::hill_force(a, trial->length_m(i, k) - p.tendon_slack_length_m, trial->velocity_mps(i, k), p);
      }
      EXPECT_NEAR(torque, course.required_torque_nm[lead + i], 1e-9);
      EXPECT_NEAR(trial->activation.time_s()[lead + i], trial->time_s[i] - person.emg_delay_s, 1e-12);
    }
  }
}

TEST(Movement, WhatIsTooHeavyCannotBePerformed) {
  const study::Study study = planned_study();
  const auto setups = study::muscle_setups(study, study::load_model(study));
  const MovementCourse course =
      movement_course(study, movement_models(study, study::load_model(study)),
                      {.held_mass_kg = 30.0, .lowest_rad = 0.5, .highest_rad = 2.0, .frequency_hz = 0.5});
  EXPECT_FALSE(perform(course, setups, typical(setups)));
}

TEST(Movement, AnIsokineticMovementKeepsItsSpeedOverMostOfTheRange) {
  const MovementCourse course =
      movement_course(planned_study(), movement_models(planned_study(), study::load_model(planned_study())),
                      {.kind = MovementKind::isokinetic,
                       .lowest_rad = 0.3,
                       .highest_rad = 2.1,
                       .speed_radps = 1.0,
                       .level = 0.5,
                       .duration_s = 8.0});
  // The speed shows in the brachialis: dl/dt = -r dq/dt.
  int steady = 0;
  for (Eigen::Index i = 0; i < course.time_s.size(); ++i) {
    const double speed = std::abs(course.muscles.velocity_mps(i, 1) / course.muscles.moment_arm_m(i, 1));
    steady += std::abs(speed - 1.0) < 0.15 ? 1 : 0;
  }
  EXPECT_GT(steady, static_cast<int>(0.75 * static_cast<double>(course.time_s.size())));
}

/// The plan as a person performs it, without noise.
std::vector<fit::TrialData> performed(const study::Study& study,
                                      const DesignStudyResult& design,
                                      const std::vector<fit::MuscleSetup>& muscles,
                                      const MovementPerson& person) {
  std::vector<fit::TrialData> trials;
  for (const PlannedMovement& planned : design.plan)
    trials.push_back(perform(movement_course(study, movement_models(study, study::load_model(study)), planned.movement),
                             muscles, person)
                         .value());
  return trials;
}

/// The trial with a torque error of this size that another takes the place of after 0.3 s, and the
/// noise of EMG of 150 Hz behind a low-pass of 6 Hz.
fit::TrialData recorded(fit::TrialData trial, double torque_sd_nm, math::Random& random) {
  constexpr double kRate_hz = 50.0;
  const double kept = std::exp(-1.0 / (0.3 * kRate_hz));
  const Eigen::VectorXd steps = random.normals(trial.torque_nm.size());
  double error = steps[0];
  for (Eigen::Index i = 0; i < steps.size(); ++i) {
    if (i > 0) error = kept * error + std::sqrt(1.0 - kept * kept) * steps[i];
    trial.torque_nm[i] += torque_sd_nm * error;
  }
  const auto filter = math::design_butterworth(
      math::FilterBand::low_pass, 2, math::two_pass_cutoff_hz(math::FilterBand::low_pass, 2, 6.0, kRate_hz), kRate_hz);
  Eigen::MatrixXd noisy = trial.activation.values();
  for (Eigen::Index c = 0; c < noisy.cols(); ++c) {
    const Eigen::VectorXd noise = math::zero_phase(filter, random.normals(noisy.rows()));
    const double size = std::sqrt(noise.squaredNorm() / static_cast<double>(noise.size()));
    noisy.col(c).array() *= (1.0 + 0.154 / size * noise.array()).max(0.0);
  }
  trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), noisy);
  return trial;
}

TEST(DesignStudy, ByThePosteriorItExpectsTheIntervalsThatPosteriorsOfRecordingsHave) {
  study::Study study = planned_study();
  study.beliefs.model_error = 0.03;  // the person is as the model
  DesignStudyOptions options;
  options.persons = 1;
  options.choice.movements = 5;
  options.catalogue.held_masses_kg = {0.0, 2.0};
  options.catalogue.frequencies_hz = {0.3, 0.6};
  const DesignStudyResult design = design_study(study, options);
  ASSERT_EQ(design.plan.size(), 5U);
  fit::StudyData data;
  data.muscles = study::muscle_setups(study, study::load_model(study));
  fit::free_speeds(data, fit::unstated_speeds(data));
  const MovementPerson person = typical(data.muscles);
  std::map<std::string, std::vector<double>> ratios;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    math::Random random(seed);
    data.trials.clear();
    for (fit::TrialData& trial : performed(study, design, data.muscles, person)) {
      data.trials.push_back(recorded(std::move(trial), options.torque_sd_nm, random));
    }
    fit::EstimatorOptions how{.max_rate_hz = 25.0, .predictions = false};
    for (const char* channel : {"BIC", "BRA", "BRD", "TRI"}) how.state(channel).gain_sd = 0.05;
    how.unseen = study.beliefs;
    const auto found = fit::identify_torque(data, how);
    for (const auto& e : found.estimates) {
      for (const auto& expected : design.plan.back().expected) {
        if (e.muscle == expected.muscle && e.parameter == expected.parameter)
          ratios[e.parameter].push_back((*e.std_error / e.estimate) / (*expected.std_error / expected.estimate));
      }
    }
  }
  for (const char* name :
       {"max_isometric_force", "optimal_fiber_length", "force_length_width", "concentric_curvature"}) {
    double sum = 0.0;
    for (const double ratio : ratios[name]) sum += std::log(ratio);
    ASSERT_EQ(ratios[name].size(), 12U);
    const double mean = std::exp(sum / 12.0);
    EXPECT_GT(mean, 0.75) << name;
    EXPECT_LT(mean, 1.25) << name;
  }
  // Moment arms of 15 % stay in F_max whatever is recorded; the priors take a third off.
  for (const auto& e : design.plan.back().expected) {
    if (e.parameter == "max_isometric_force") {
      EXPECT_GT(*e.std_error, 0.1 * e.estimate);
    }
  }
}

TEST(DesignStudy, AfterARunByThePosteriorTheGeometrysPartOfAnIntervalStays) {
  study::Study study = planned_study();
  DesignStudyOptions options;
  options.persons = 1;
  options.choice.movements = 2;
  options.catalogue.held_masses_kg = {2.0};
  options.catalogue.frequencies_hz = {0.3, 1.0};
  options.targets = {"BIC.max_isometric_force"};
  EarlierRun earlier;
  earlier.parameters = {"BIC.max_isometric_force"};
  earlier.estimate = Eigen::VectorXd::Constant(1, 600.0);
  earlier.covariance = Eigen::MatrixXd::Constant(1, 1, 0.04);
  earlier.torque_sd_nm = 0.3;
  earlier.emg_cv = 0.154;
  earlier.model_error = 0.02;
  fit::ParameterEstimate row;
  row.muscle = "BIC";
  row.parameter = "max_isometric_force";
  row.estimate = 600.0;
  row.ci_low = 600.0 * std::exp(-0.4);
  row.ci_high = 600.0 * std::exp(0.4);
  row.variance_shares = fit::SourceShares{};
  (*row.variance_shares)[static_cast<std::size_t>(fit::Source::noise)] = 0.36;
  (*row.variance_shares)[static_cast<std::size_t>(fit::Source::geometry)] = 0.64;
  earlier.estimates = {row};
  options.earlier = earlier;
  const DesignStudyResult design = design_study(study, options);
  ASSERT_EQ(design.plan.size(), 2U);
  const double upper = std::log(*design.plan.back().expected[0].ci_high / 600.0);
  EXPECT_LT(upper, 0.38);
  EXPECT_GT(upper, 0.8 * 0.4);
}

TEST(DesignStudy, MoreMovementsTellMoreAndFatigueStaysInItsBudget) {
  DesignStudyOptions options;
  options.persons = 3;
  options.choice.movements = 6;
  options.targets = {"max_isometric_force", "TRI.optimal_fiber_length"};
  const DesignStudyResult result = design_study(planned_study(), options);
  ASSERT_EQ(result.beforehand.size(), 5U);
  ASSERT_EQ(result.plan.size(), 6U);
  std::vector<double> sd;
  for (const auto& e : result.beforehand) sd.push_back(*e.std_error);
  for (const PlannedMovement& planned : result.plan) {
    EXPECT_LE(planned.fatigued_share, options.fatigued_share);
    for (std::size_t t = 0; t < sd.size(); ++t) {
      EXPECT_LE(*planned.expected[t].std_error, sd[t] * (1.0 + 1e-12));
      sd[t] = *planned.expected[t].std_error;
    }
  }
}

TEST(DesignStudy, WhatARunLeftUndeterminedIsAsUnknownAsBefore) {
  DesignStudyOptions options;
  options.persons = 2;
  options.choice.movements = 1;
  options.targets = {"max_isometric_force"};
  study::Study study = planned_study();
  const DesignStudyResult unknown = design_study(study, options);
  // A covariance over the determined directions alone: F_max of BIC and BRA only by their ratio.
  EarlierRun earlier;
  earlier.parameters = {"BIC.max_isometric_force", "BRA.max_isometric_force"};
  earlier.estimate = Eigen::Vector2d(600.0, 900.0);
  earlier.covariance = 0.01 * (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished();
  earlier.torque_sd_nm = 0.3;
  earlier.emg_cv = 0.087;
  options.earlier = earlier;
  const DesignStudyResult known = design_study(study, options);
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_GT(*known.beforehand[t].std_error / known.beforehand[t].estimate,
              0.6 * *unknown.beforehand[t].std_error / unknown.beforehand[t].estimate);
  }
}

TEST(DesignStudy, RefusesATargetThatIsNoneAndNamesThoseThereAre) {
  DesignStudyOptions options;
  options.targets = {"BIC.max_isometric_froce"};
  options.persons = 1;
  try {
    (void)design_study(planned_study(), options);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("BIC.max_isometric_froce"));
    EXPECT_THAT(error.what(), HasSubstr("TRI.force_length_width"));
  }
}

}  // namespace
}  // namespace myoid::run
