#include "myoid/run/trial_stages.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/arm/arm4.h"
#include "myoid/core/error.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/osim/thelen_properties.h"
#include "myoid/run/resting_joints.h"
#include "myoid/signals/resample.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

/// Coordinates that are the same throughout a trial: found where the posture is known, then held.
void calibrate(const CalibrationSpec& spec,
               const recording::MarkerSeries& markers,
               model::BodyModel& model) {
  model::BodyModel posed = model;
  for (model::Coordinate& c : posed.coordinates) c.locked = true;
  for (const std::string& name : spec.free)
    posed.coordinates[static_cast<std::size_t>(posed.coordinate_index(name))].locked = false;
  recording::MarkerSeries window;
  window.names = markers.names;
  Eigen::Index first = 0;
  while (first < markers.frame_count() && markers.time_s[first] < spec.window_s[0]) ++first;
  Eigen::Index last = first;
  while (last < markers.frame_count() && markers.time_s[last] <= spec.window_s[1]) ++last;
  if (last - first < 2)
    throw InvalidInput(fmt::format("[ik] calibrate: no frames between {} and {} s",
                                   spec.window_s[0], spec.window_s[1]));
  window.time_s = markers.time_s.segment(first, last - first);
  window.positions_m = markers.positions_m.middleRows(first, last - first);
  const kinematics::IkResult pose = kinematics::inverse_kinematics(posed, window);
  for (const std::string& name : spec.hold) {
    Eigen::VectorXd values = pose.q.column(name);
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    model::Coordinate& c =
        model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))];
    c.default_value = values[values.size() / 2];
    c.locked = true;
  }
}

/// Inverse kinematics, or what an earlier run found from the same input.
void solve_ik(const Study& study,
              const recording::MarkerSeries& markers,
              std::string_view model_text,
              StageStore* store,
              TrialResult& trial) {
  const std::string key = store != nullptr ? ik_key(study, model_text, markers) : "";
  if (store != nullptr) trial.ik = store->find(key);
  trial.ik_reused = trial.ik.has_value();
  if (trial.ik_reused) return;
  kinematics::IkOptions options;
  options.marker_weights = study.markers.weight;
  trial.ik = kinematics::inverse_kinematics(trial.model, markers, options);
  if (store != nullptr) store->keep(key, *trial.ik);
}

void compute_motion(const Study& study,
                    const TrialInput& input,
                    std::string_view model_text,
                    StageStore* store,
                    TrialResult& trial) {
  TimeSeries q;
  if (input.markers) {
    trial.markers = input.markers;
    if (study.ik.calibrate) calibrate(*study.ik.calibrate, *input.markers, trial.model);
    solve_ik(study, *input.markers, model_text, store, trial);
    trial.notes.insert(trial.notes.end(), trial.ik->notes.begin(), trial.ik->notes.end());
    q = trial.ik->q;
  } else if (input.motion) {
    q = *input.motion;
  } else {
    return;
  }
  kinematics::MotionOptions options;
  options.cutoff_hz = motion_cutoff_hz(study);
  const double rate = q.mean_rate_hz();
  const double wanted = options.cutoff_hz ? study.motion.rate_hz : rate;
  if (options.cutoff_hz && *options.cutoff_hz >= 0.45 * rate) {
    trial.notes.push_back(
        fmt::format("motion at {:.0f} Hz is too slow to be smoothed at {:.3g} Hz: not smoothed",
                    rate, *options.cutoff_hz));
    options.cutoff_hz.reset();
  }
  const Eigen::VectorXd& clock = q.time_s();
  if (std::abs(wanted - rate) > 0.01 * rate || !q.is_uniform())
    options.time_s = signals::even_clock(clock[0], clock[clock.size() - 1], wanted);
  // What a slower clock cannot hold goes first, where the smoothing spline, whose gain is
  // 1 / (1 + (f/f_c)^6), leaves more than a thousandth of it at half the new rate.
  const bool smoothed_away =
      options.cutoff_hz && std::pow(0.5 * wanted / *options.cutoff_hz, 6) >= 999.0;
  if (options.time_s && !smoothed_away && q.is_uniform()) q = signals::anti_aliased(q, wanted);
  kinematics::MotionResult result = kinematics::joint_motion(trial.model, q, options);
  trial.motion = std::move(result.motion);
  trial.notes.insert(trial.notes.end(), result.notes.begin(), result.notes.end());
}

void compute_forces(const Study& study,
                    const TrialInput& input,
                    bool share,
                    const std::vector<identification::RestingJoint>& resting,
                    TrialResult& trial) {
  trial.generalized_forces = dynamics::inverse_dynamics(
      trial.model, trial.motion, {.loads = input.loads ? &*input.loads : nullptr});
  trial.muscles = kinematics::muscle_kinematics(trial.model, trial.motion);
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  std::vector<Channel> columns;
  std::vector<TimeSeries> moment_arms;
  Eigen::MatrixXd torque(trial.motion.sample_count(),
                         static_cast<Eigen::Index>(coordinates.size()));
  for (const std::string& name : coordinates) {
    const auto index = static_cast<std::size_t>(trial.model.coordinate_index(name));
    columns.push_back(
        {dynamics::generalized_force_name(trial.model.coordinates[index]), Unit::newton_meter});
    torque.col(static_cast<Eigen::Index>(moment_arms.size())) =
        trial.generalized_forces.column(columns.back().name);
    moment_arms.push_back(trial.muscles.moment_arm.at(name));
  }
  // What the surroundings exert on the coordinates, the muscles need not.
  if (input.external_torque)
    torque -= signals::resample(*input.external_torque, trial.motion.q.time_s()).values();
  trial.muscle_torque = TimeSeries(trial.motion.q.time_s(), columns, torque);

  if (!share) return;
  // What a joint does by itself its muscles do not share.
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    const Eigen::VectorXd by_itself =
        resting_torque_nm(resting, coordinates[j], trial.motion.q.column(coordinates[j]));
    if (by_itself.size() > 0) torque.col(static_cast<Eigen::Index>(j)) -= by_itself;
  }
  const TimeSeries active(trial.motion.q.time_s(), std::move(columns), torque);
  const auto count = static_cast<Eigen::Index>(trial.model.muscles.size());
  Eigen::MatrixXd optimal(trial.motion.sample_count(), count);
  Eigen::VectorXd greatest(count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const muscle::ThelenParameters p =
        model::thelen_parameters(trial.model.muscles[static_cast<std::size_t>(m)].properties);
    greatest[m] = p.max_isometric_force_n;
    for (Eigen::Index i = 0; i < optimal.rows(); ++i) {
      optimal(i, m) = muscle::thelen_optimal_force(p, trial.muscles.length.values()(i, m),
                                                   trial.muscles.velocity.values()(i, m));
    }
  }
  trial.shared = forces::share(moment_arms, active, optimal, greatest,
                               {.objective = study.sharing.objective,
                                .exponent = study.sharing.exponent,
                                .reserve_nm = study.sharing.reserve_nm});
}

}  // namespace

void compute_trial(const Study& study,
                   const TrialInput& input,
                   std::string_view model_text,
                   bool share_forces,
                   const std::vector<identification::RestingJoint>& resting,
                   StageStore* store,
                   TrialResult& trial) {
  trial.model = load_model(study, input.markers ? &*input.markers : nullptr);
  if (trial.spec.held_mass_kg > 0.0) {
    HeldMassSpec held;
    if (study.model.held_mass) {
      held = *study.model.held_mass;
    } else if (!study.model.file) {
      held = {"forearm_hand", model::arm4_held_at_m()};
    } else {
      throw InvalidInput("held_mass_kg is given, but [model] held_mass does not say where it acts");
    }
    trial.model = dynamics::with_held_mass(std::move(trial.model), held.body, held.p_BP_m,
                                           trial.spec.held_mass_kg);
  }
  compute_motion(study, input, model_text, store, trial);
  if (trial.motion.q.sample_count() > 0) compute_forces(study, input, share_forces, resting, trial);
}

}  // namespace myoid
