#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/muscle_law.h"

#include "tests/support/elbow_study.h"

namespace myoid::test {

/// An elbow whose tendons are elastic and drawn about the model's, with fascicles that were measured with error.
struct FascicleStudy {
  fit::StudyData data;
  std::vector<fit::MuscleValues> truth;
};

/// The length of the fibers that pull with this force at a musculotendon length: the model's tendon, stretched by the
/// force, is the rest. Without pennation.
inline double written_fiber_m(double force_n, double length_m, const fit::MuscleValues& p) {
  const double stretch = p[fit::kTendonStrain] * std::log(1.0 + 5.0 * force_n / p[fit::kMaxForce]) / std::log(6.0);
  return length_m - p[fit::kSlack] * (1.0 + stretch);
}

/// Makes elastic tendons of the rigid ones of `of`: the same efforts, the force and torque that they give there, and
/// the lengths of all fibers as ultrasound sees them.
inline FascicleStudy fascicle_study(ElbowStudy of, std::uint64_t seed) {
  using namespace fit;
  constexpr double kStrain = 0.049, kRate_hz = 100.0;
  StudyNoise noise(seed);
  FascicleStudy study{std::move(of.data), {}};
  std::vector<double> scale, offset_m;
  for (std::size_t k = 0; k < of.truth.size(); ++k) {
    MuscleSetup& setup = study.data.muscles[k];
    setup.extras.tendon_strain = kStrain;
    setup.priors["tendon_slack_length"] =
        *literature_prior("tendon_slack_length", setup.start.tendon_slack_length_m, setup.start.optimal_fiber_length_m);
    MuscleValues& p = study.truth.emplace_back(muscle_values(of.truth[k], setup.extras));
    p[kSlack] *= std::exp(beliefs::kTendonSlack.sd * noise.normal());
    p[kTendonStrain] *= std::exp(beliefs::kTendonStrain.sd * noise.normal());
    scale.push_back(1.0 + beliefs::kFascicleScale.sd * noise.normal());
    offset_m.push_back(beliefs::kFascicleOffset.sd * noise.normal());
  }
  for (TrialData& trial : study.data.trials) {
    trial.fascicle_m.resizeLike(trial.force_n);
    const double kept = std::exp(-1.0 / kRate_hz / beliefs::kFascicleErrorTime.value);
    for (std::size_t k = 0; k < study.truth.size(); ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      double error = noise.normal();
      for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
        const double length = trial.length_m(i, c), rate = trial.velocity_mps(i, c);
        const double full = muscle::hill_force(1.0, length - of.truth[k].tendon_slack_length_m, rate, of.truth[k]);
        const double effort = full > 0.0 ? trial.force_n(i, c) / full : 0.0;
        const double force = tension(effort, length, rate, study.truth[k]).force_n;
        trial.torque_nm[i] += trial.moment_arm_m(i, c) * (force - trial.force_n(i, c));
        trial.force_n(i, c) = force;
        error = kept * error + std::sqrt(1.0 - kept * kept) * noise.normal();
        trial.fascicle_m(i, c) = scale[k] * written_fiber_m(force, length, study.truth[k]) + offset_m[k] +
                                 beliefs::kFascicleError.value * error;
      }
    }
  }
  return study;
}

/// The same without what was measured of the fascicles.
inline fit::StudyData without_fascicles(fit::StudyData data) {
  for (fit::TrialData& trial : data.trials) trial.fascicle_m.resize(0, 0);
  return data;
}

}  // namespace myoid::test
