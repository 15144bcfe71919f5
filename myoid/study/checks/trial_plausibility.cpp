#include "myoid/study/checks/trial_plausibility.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/units.h"
#include "myoid/study/checks/needed_coordinates.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

void check_angles(const Study& study,
                  const body::BodyModel& model,
                  const TimeSeries& motion,
                  const std::string& where,
                  std::vector<Remark>& findings) {
  for (const std::string& name : study_coordinates(study.model)) {
    const auto column = motion.find(name);
    const auto index = model.find_coordinate(name);
    if (!column || !index) continue;
    auto found =
        body::angle_outside_range(model.coordinates[static_cast<std::size_t>(*index)], motion.values().col(*column));
    if (!found) continue;
    found->where = where;
    findings.push_back(*std::move(found));
  }
}

void check_held_mass(const Study& study,
                     const body::BodyModel& model,
                     const Capacities& capacities,
                     const TrialSpec& trial,
                     std::vector<Remark>& findings) {
  const double held_kg = trial.held_mass_kg.value_or(0.0);
  if (!(held_kg > 0.0)) return;
  if (study.subject.mass_kg && held_kg > *study.subject.mass_kg) {
    findings.push_back({.code = RemarkCode::held_mass_impossible,
                        .severity = Severity::error,
                        .where = trial.name,
                        .about = "held mass",
                        .says = fmt::format("held_mass_kg = {} is more than the person weighs ({} kg); is it in grams "
                                            "or pounds, or is a decimal point missing?",
                                            held_kg, *study.subject.mass_kg)});
    return;
  }
  if (!study.model.held_mass && study.model.file) return;  // reported as an error elsewhere
  const auto body = study.model.held_mass ? model.find_body(study.model.held_mass->body) : std::nullopt;
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  for (const auto& [name, capacity] : capacities) {
    double lever_m = capacity.lever_m;
    if (body) {
      const auto b = static_cast<std::size_t>(*body);
      const auto joint =
          static_cast<std::size_t>(model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))].joint);
      if (!body::moved_bodies(model, static_cast<int>(joint))[b]) continue;
      const Vec3 center = state.X_GB[static_cast<std::size_t>(model.joints[joint].child)] * model.joints[joint].X_BM.p;
      lever_m = (state.X_GB[b] * study.model.held_mass->p_BP_m - center).norm();
    }
    const double moment_nm = held_kg * kStandardGravity * lever_m;
    const bool still = trial.use == Use::isometric || trial.use == Use::static_pose || trial.use == Use::mvc;
    const double most_nm = (still ? 1.0 : kLimits.joints.lift_share) * capacity.isometric_nm();
    if (!(most_nm > 0.0) || moment_nm <= most_nm) continue;
    findings.push_back(
        {.code = RemarkCode::held_mass_impossible,
         .severity = Severity::warning,
         .where = trial.name,
         .about = name,
         .says = fmt::format(
             "held_mass_kg = {} at {:.2f} m weighs up to {:.0f} N m on {}, and with literature's strength all muscles "
             "of the model can {} {:.0f} N m there: is it in other units, or is a decimal point missing?",
             held_kg, lever_m, moment_nm, name, still ? "hold" : "lift again and again", most_nm)});
  }
}

/// Checks the vertical by the markers of the body on the ground joint, unless the study's joints
/// turn it: a trunk is upright in most movements, a limb is not.
void check_vertical(const Study& study,
                    const body::BodyModel& model,
                    const TrialInput& input,
                    const std::string& where,
                    std::vector<Remark>& findings) {
  if (!input.markers) return;
  std::vector<bool> limb(model.bodies.size(), false);
  for (const std::string& name : study_coordinates(study.model)) {
    const auto index = model.find_coordinate(name);
    if (!index) continue;
    const auto& joint =
        model.joints[static_cast<std::size_t>(model.coordinates[static_cast<std::size_t>(*index)].joint)];
    limb[static_cast<std::size_t>(joint.parent)] = true;
    limb[static_cast<std::size_t>(joint.child)] = true;
  }
  MarkerSeries trunk;
  trunk.time_s = input.markers->time_s;
  trunk.positions_m.resize(trunk.time_s.size(), 0);
  for (const body::Joint& joint : model.joints) {
    if (joint.parent != 0 || limb[static_cast<std::size_t>(joint.child)]) continue;
    for (Eigen::Index m = 0; m < input.markers->marker_count(); ++m) {
      const std::string& name = input.markers->names[static_cast<std::size_t>(m)];
      const auto known = model.find_marker(name);
      if (!known || model.markers[static_cast<std::size_t>(*known)].body != joint.child) continue;
      trunk.names.push_back(name);
      trunk.positions_m.conservativeResize(Eigen::NoChange, trunk.positions_m.cols() + 3);
      trunk.positions_m.rightCols(3) = input.markers->positions_m.middleCols(3 * m, 3);
    }
  }
  const Mat3 back = rotation_onto(model, input.up_L).transpose();  // the markers were turned on reading
  const std::string told = recording::axis_name(input.up_L);
  const MarkerSeries laboratory = rotated(trunk, back);
  const std::optional<double> now = upright(model, laboratory, input.up_L);
  if (!now || *now > kLimits.markers.trunk_across) return;
  // The trunk of a model may lie at the default pose. The axis by which all markers stand upright, which `init` writes,
  // decides.
  const std::vector<std::string> axes{"x", "y", "z", "-x", "-y", "-z"};
  const std::optional<UprightAxis> by_all = upright_axis(model, rotated(*input.markers, back), axes);
  for (const std::string& up : axes) {
    const std::optional<double> other = upright(model, laboratory, *recording::axis_vector(up));
    if (up == told || !other || *other < kLimits.markers.trunk_upright) continue;
    if (!by_all || by_all->name != up) continue;
    const bool settable = up.size() == 1;
    findings.push_back(
        {.code = RemarkCode::vertical_across_trunk,
         .severity = Severity::warning,
         .where = where,
         .about = "trunk",
         .says = fmt::format(
             "{} is up ({}), but the trunk's markers lie {:.0f} degrees from upright by it, and {:.0f} with {} up: "
             "unless the person {}, gravity pulls {} the body; {}",
             told, study.markers.up == kUpOfTheFile ? "as the file says" : "[markers] up",
             std::acos(std::clamp(*now, -1.0, 1.0)) / kDegree, std::acos(std::clamp(*other, -1.0, 1.0)) / kDegree, up,
             *now < -kLimits.markers.trunk_upright ? "stands on the head" : "lies",
             *now < -kLimits.markers.trunk_upright ? "up through" : "across",
             settable ? fmt::format("correct it: [markers] up = \"{}\"", up)
                      : fmt::format("turn the markers of the file, whose {} points down{}", up.substr(1),
                                    *now < -kLimits.markers.trunk_upright ? ", or exchange left and right" : ""))});
    return;
  }
}

}  // namespace

Capacities joint_capacities(const Study& study, const body::BodyModel& model) {
  Capacities capacities;
  for (const std::string& name : study_coordinates(study.model)) {
    const auto index = model.find_coordinate(name);
    if (!index || model.coordinates[static_cast<std::size_t>(*index)].motion == body::MotionType::translational)
      continue;
    capacities[name] = body::joint_capacity(model, name, study.subject.mass_kg.value_or(0.0));
  }
  return capacities;
}

std::vector<Remark> implausible(const Study& study,
                                const body::BodyModel& model,
                                const Capacities& capacities,
                                const TrialSpec& trial,
                                const TrialInput& input) {
  std::vector<Remark> findings;
  if (input.external_torque) {
    for (const auto& [name, capacity] : capacities) {
      const auto column = input.external_torque->find(name + "_moment");
      if (!column) continue;
      const std::string text =
          body::too_much_torque(name, body::usual_peak(input.external_torque->values().col(*column)),
                                capacity.greatest_nm(), trial.external_torque->filename().string());
      if (!text.empty())
        findings.push_back({.code = RemarkCode::torque_impossible,
                            .severity = Severity::error,
                            .where = trial.name,
                            .about = name,
                            .says = text});
    }
  }
  if (input.motion && !study.model.is_none()) check_angles(study, model, *input.motion, trial.name, findings);
  if (input.motion && input.motion->channel_count() > 0) {
    const std::vector<std::string> needed = needed_coordinates(study, model, trial);
    for (Remark& remark : body::implausible_motion(model, *input.motion, {-1e300, 1e300}, needed)) {
      remark.where = trial.name;
      if (remark.code == RemarkCode::angle_outside_range) {  // those of the study's joints are told
        if (std::ranges::count(study_coordinates(study.model), remark.about) > 0) continue;
        remark.severity = Severity::warning;
      }
      // Beside given lengths only the joint's own torque depends on the angles.
      if (trial.given.lengths) remark.severity = std::max(remark.severity, Severity::warning);
      findings.push_back(std::move(remark));
    }
  }
  if (trial.use == Use::passive && !trial.external_torque && !trial.load_cell && !trial.given.torques)
    findings.push_back({.code = RemarkCode::resting_torque,
                        .severity = Severity::warning,
                        .where = trial.name,
                        .about = "passive",
                        .says = "use = \"passive\" tells the joint's resting torque, and this trial has no measured "
                                "torque to tell it from: it gives nothing",
                        .remedy = "give external_torque (or load_cell), or another use"});
  check_held_mass(study, model, capacities, trial, findings);
  check_vertical(study, model, input, trial.name, findings);
  return findings;
}

}  // namespace myoid::study
