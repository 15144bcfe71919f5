#include "myoid/study/checks/muscle_pulls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Returns F_max r of each muscle of the study [N m], r the mean over the coordinate's range.
Eigen::VectorXd strengths_nm(const Study& study, const body::BodyModel& model, const std::string& coordinate) {
  constexpr int kSteps = 8;
  const int index = model.coordinate_index(coordinate);
  const std::vector<body::MuscleGroup> groups = muscle_groups(study, model);
  Eigen::VectorXd strength = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(groups.size()));
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const int m : groups[k].members) {
      const double f_max_n = model.muscles[static_cast<std::size_t>(m)].properties.max_isometric_force_n;
      for (const double r : body::arms_over_range_m(model, m, index, kSteps)) {
        if (std::isfinite(r)) strength[static_cast<Eigen::Index>(k)] += r * f_max_n / (kSteps + 1);
      }
    }
  }
  return strength;
}

/// Sums where the torque is large and a muscle is active; empty: nowhere.
std::optional<Sums> sums_of(const EffortTrial& trial,
                            const Pulls& pulls,
                            const std::map<std::string, double>& largest,
                            const Eigen::VectorXd& torque_nm) {
  const Eigen::VectorXd& t = trial.external_torque->time_s();
  const TimeSeries a = recording::resample(trial.envelopes, t);
  const double from_s = trial.envelopes.time_s()[0];
  const double to_s = trial.envelopes.time_s()[trial.envelopes.sample_count() - 1];
  const double enough = kLimits.joints.dynamometer_torque * body::usual_peak(torque_nm);
  const auto n = static_cast<Eigen::Index>(pulls.channels.size());
  Sums sums{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  Eigen::VectorXd relative(n);
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (t[i] < from_s || t[i] > to_s || std::abs(torque_nm[i]) < enough) continue;
    for (Eigen::Index c = 0; c < n; ++c) {
      const std::string& channel = pulls.channels[static_cast<std::size_t>(c)];
      relative[c] = a.values()(i, a.index(channel)) / std::max(largest.at(channel), 1e-300);
    }
    if (relative.maxCoeff() < kLimits.joints.active) continue;
    sums.emg += relative * relative.transpose();
    sums.need -= relative * torque_nm[i];
    sums.square += torque_nm[i] * torque_nm[i];
  }
  return sums.square > 0.0 ? std::optional(std::move(sums)) : std::nullopt;
}

/// Returns the largest value of each channel over all trials.
std::map<std::string, double> largest_of(const std::vector<EffortTrial>& trials) {
  std::map<std::string, double> largest;
  for (const EffortTrial& trial : trials) {
    for (Eigen::Index c = 0; c < trial.envelopes.channel_count(); ++c) {
      double& value = largest[trial.envelopes.channels()[static_cast<std::size_t>(c)].name];
      value = std::max(value, trial.envelopes.values().col(c).maxCoeff());
    }
  }
  return largest;
}

}  // namespace

double Sums::cosine(const Eigen::VectorXd& strength_nm) const {
  const double size = std::sqrt(strength_nm.dot(emg * strength_nm) * square);
  return size > 0.0 ? strength_nm.dot(need) / size : 0.0;
}

double Sums::torque_over_pull(const Eigen::VectorXd& strength_nm) const {
  const double pull = strength_nm.dot(emg * strength_nm);
  return pull > 0.0 ? std::sqrt(square / pull) : 0.0;
}

double Sums::unopposed(const Eigen::VectorXd& strength_nm) const {
  const Eigen::VectorXd size = strength_nm.cwiseAbs();
  const double together = size.dot(emg * size);
  return together > 0.0 ? std::sqrt(std::max(0.0, strength_nm.dot(emg * strength_nm)) / together) : 0.0;
}

Pulls pulls_on(const Study& study, const body::BodyModel& model, const std::string& coordinate) {
  const Eigen::VectorXd of_muscles = strengths_nm(study, model, coordinate);
  Pulls pulls;
  std::vector<double> strengths;
  for (std::size_t k = 0; k < study.muscles.size(); ++k) {
    if (study.muscles[k].without_emg) continue;
    const auto known = std::ranges::find(pulls.channels, study.muscles[k].emg);
    const auto at = static_cast<std::size_t>(known - pulls.channels.begin());
    if (known == pulls.channels.end()) {
      pulls.channels.push_back(study.muscles[k].emg);
      strengths.push_back(0.0);
    }
    strengths[at] += of_muscles[static_cast<Eigen::Index>(k)];
  }
  pulls.strength_nm = Eigen::Map<Eigen::VectorXd>(strengths.data(), std::ssize(strengths));
  return pulls;
}

std::vector<ToldTrial> told_trials(const std::vector<EffortTrial>& trials,
                                   const std::string& coordinate,
                                   const Pulls& pulls,
                                   double weight_nm) {
  const body::JointCapacity muscles = pulls.together();
  const double weaker_nm = muscles.positive_nm > 0.0 && muscles.negative_nm > 0.0
                               ? std::min(muscles.positive_nm, muscles.negative_nm)
                               : muscles.isometric_nm();
  const double least_nm =
      std::max(kLimits.joints.dynamometer_share * weaker_nm, kLimits.joints.dynamometer_weights * weight_nm);
  const std::map<std::string, double> largest = largest_of(trials);
  std::vector<ToldTrial> told;
  for (const EffortTrial& trial : trials) {
    if (trial.external_torque == nullptr || trial.envelopes.empty() || trial.spec->use == Use::passive) continue;
    const auto column = trial.external_torque->find(coordinate + "_moment");
    if (!column) continue;
    const Eigen::VectorXd torque = trial.external_torque->values().col(*column);
    const double peak_nm = body::usual_peak(torque);
    if (auto sums = sums_of(trial, pulls, largest, torque))
      told.push_back({&trial, std::move(*sums), peak_nm, peak_nm >= least_nm});
  }
  return told;
}

}  // namespace myoid::study
