#include "myoid/study/intake/trial_model.h"

#include <algorithm>
#include <string>
#include <utility>

#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/study/intake/trial_markers.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Finds coordinates that are constant in a trial while the posture is known, and then holds them.
void calibrate(const CalibrationSpec& spec, const MarkerSeries& markers, body::BodyModel& model) {
  body::BodyModel posed = model;
  for (body::Coordinate& c : posed.coordinates) c.locked = true;
  for (const std::string& name : spec.free)
    posed.coordinates[static_cast<std::size_t>(posed.coordinate_index(name))].locked = false;
  const body::IkResult pose = body::inverse_kinematics(posed, calibration_window(spec, markers));
  for (const std::string& name : spec.hold) {
    Eigen::VectorXd values = pose.q.column(name);
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    body::Coordinate& c = model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))];
    c.default_value = values[values.size() / 2];
    c.locked = true;
  }
}

}  // namespace

std::optional<body::BodyModel> trial_model(const Study& study,
                                           const body::BodyModel& model,
                                           const TrialSpec& trial,
                                           const TrialInput& input) {
  std::optional<body::BodyModel> own;
  const auto changed = [&]() -> body::BodyModel& { return own ? *own : own.emplace(model); };
  if (input.markers) own = arm_of_markers(study, *input.markers);
  if (trial.held_mass_kg.value_or(0.0) > 0.0) {
    const HeldMassSpec held = held_mass_place(study);
    own = body::with_held_mass(std::move(changed()), held.body, held.p_BP_m, *trial.held_mass_kg);
  }
  if (input.markers && study.ik.calibrate) calibrate(*study.ik.calibrate, *input.markers, changed());
  return own;
}

}  // namespace myoid::study
