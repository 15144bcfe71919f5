#include "myoid/study/checks/dynamometer_sign.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/checks/trial_plausibility.h"
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

/// Returns the largest possible torque by the weight of all bodies that the coordinate moves, each stretched out [N m].
double weight_nm(const body::BodyModel& model, const std::string& coordinate) {
  const int index = model.coordinate_index(coordinate);
  const auto joint = static_cast<std::size_t>(model.coordinates[static_cast<std::size_t>(index)].joint);
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  const Vec3 center = state.X_GB[static_cast<std::size_t>(model.joints[joint].child)] * model.joints[joint].X_BM.p;
  const std::vector<bool> moved = body::moved_bodies(model, static_cast<int>(joint));
  double sum = 0.0;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    if (moved[b])
      sum +=
          model.bodies[b].mass_kg * model.gravity_G.norm() * (state.X_GB[b] * model.bodies[b].p_BBcm_B - center).norm();
  }
  return sum;
}

/// Sums for the cosine between the muscles' torque and the torque they must provide.
struct Products {
  double both = 0.0, pull = 0.0, need = 0.0;
  void add(const Products& other) {
    both += other.both;
    pull += other.pull;
    need += other.need;
  }
  [[nodiscard]] double cosine() const {
    const double size = std::sqrt(pull * need);
    return size > 0.0 ? both / size : 0.0;
  }
};

std::optional<Products> compare(const Study& study,
                                const EffortTrial& trial,
                                const std::map<std::string, double>& largest,
                                const Eigen::VectorXd& strength_nm,
                                const Eigen::VectorXd& torque_nm) {
  const Eigen::VectorXd& t = trial.external_torque->time_s();
  const TimeSeries a = recording::resample(trial.envelopes, t);
  const double from_s = trial.envelopes.time_s()[0];
  const double to_s = trial.envelopes.time_s()[trial.envelopes.sample_count() - 1];
  const double enough = kLimits.joints.dynamometer_torque * body::usual_peak(torque_nm);
  Products sums;
  double most = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (t[i] < from_s || t[i] > to_s || std::abs(torque_nm[i]) < enough) continue;
    double pull = 0.0;
    for (std::size_t k = 0; k < study.muscles.size(); ++k) {
      const std::string& channel = study.muscles[k].emg;
      const double relative = a.values()(i, a.index(channel)) / std::max(largest.at(channel), 1e-300);
      most = std::max(most, relative);
      pull += relative * strength_nm[static_cast<Eigen::Index>(k)];
    }
    sums.add({-pull * torque_nm[i], pull * pull, torque_nm[i] * torque_nm[i]});
  }
  if (most < kLimits.joints.active) return std::nullopt;
  return sums;
}

}  // namespace

std::vector<Remark> dynamometer_signs(const Study& study,
                                      const body::BodyModel& model,
                                      const std::vector<EffortTrial>& trials) {
  std::vector<Remark> found;
  const bool any = std::ranges::any_of(trials, [](const EffortTrial& t) { return t.external_torque != nullptr; });
  if (!any) return found;
  std::map<std::string, double> largest;
  for (const EffortTrial& trial : trials) {
    for (Eigen::Index c = 0; c < trial.envelopes.channel_count(); ++c) {
      double& value = largest[trial.envelopes.channels()[static_cast<std::size_t>(c)].name];
      value = std::max(value, trial.envelopes.values().col(c).maxCoeff());
    }
  }
  for (const auto& [name, capacity] : joint_capacities(study, model)) {
    const Eigen::VectorXd strength = strengths_nm(study, model, name);
    const double least_nm = std::max(kLimits.joints.dynamometer_share * capacity.isometric_nm(),
                                     kLimits.joints.dynamometer_weights * weight_nm(model, name));
    Products all;
    std::size_t told = 0;
    std::vector<std::pair<const EffortTrial*, double>> against;
    for (const EffortTrial& trial : trials) {
      if (trial.external_torque == nullptr || trial.envelopes.empty() || trial.spec->use == Use::passive) continue;
      const auto column = trial.external_torque->find(name + "_moment");
      if (!column) continue;
      const Eigen::VectorXd torque = trial.external_torque->values().col(*column);
      if (body::usual_peak(torque) < least_nm) continue;
      const auto sums = compare(study, trial, largest, strength, torque);
      if (!sums) continue;
      ++told;
      all.add(*sums);
      if (sums->cosine() < kLimits.joints.reversed) against.emplace_back(&trial, sums->cosine());
    }
    const bool certain = !against.empty() && against.size() == told && all.cosine() < kLimits.joints.certainly_reversed;
    for (const auto& [trial, cosine] : against) {
      found.push_back(
          {.code = RemarkCode::dynamometer_sign,
           .severity = certain ? Severity::error : Severity::warning,
           .where = trial->spec->name,
           .about = name,
           .says = fmt::format(
               "{}: the torque on {} acts in the direction of the active muscles (cosine with their necessary torque "
               "{:.2f}, expected above 0): is its sign reversed? external_torque is the torque of the surroundings on "
               "the body, positive in the coordinate's direction: is it the person's torque on the dynamometer?",
               trial->spec->external_torque->filename().string(), name, cosine)});
    }
  }
  return found;
}

}  // namespace myoid::study
