#include "myoid/lab/twin/voluntary_truth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/fit/intervals/voluntary_curve.h"
#include "myoid/lab/virtual_person/effective_truth.h"

namespace myoid::lab {
namespace {

using Curve = std::vector<double>;  // over the angles

constexpr double kStep_rad = 2.0 * kDegree;
constexpr int kSpeeds_degps[] = {60, 120, 180};

/// Returns the angles that the trials reach, without those that only normalize the EMG.
muscle::Range reached_rad(const VirtualRecording& recording) {
  muscle::Range range{1e9, -1e9};
  for (const VirtualTrial& trial : recording.trials) {
    if (trial.protocol.kind == TrialKind::mvc) continue;
    const Eigen::VectorXd angle_rad = trial.truth.motion.column("elbow_flexion");
    range.lower = std::min(range.lower, angle_rad.minCoeff());
    range.upper = std::max(range.upper, angle_rad.maxCoeff());
  }
  return range;
}

/// The muscles of a person with the effort of their maximal contractions.
struct Person {
  const VirtualRecording& recording;
  VirtualArm arm{recording.protocol.subject, recording.protocol.seven_heads};
  DepartedMuscles body{recording.truth.departures, arm, recording.truth.muscles};

  [[nodiscard]] double effort(std::size_t m) const {
    return recording.protocol.level == Level::noise_free ? 1.0 : recording.truth.effort[m];
  }

  /// Returns the torque of a muscle at each angle, positive in flexion [N m].
  [[nodiscard]] Curve torque_nm(std::size_t m, const std::vector<double>& angles_rad, double speed_radps) const {
    if (recording.truth.arm) return active_torque_nm(*recording.truth.arm, m, effort(m), angles_rad, speed_radps);
    Curve curve;
    for (const double angle_rad : angles_rad) curve.push_back(torque_nm(m, angle_rad, speed_radps));
    return curve;
  }

  /// L0 and L1. The tension and the stretch of the tendon agree.
  [[nodiscard]] double torque_nm(std::size_t m, double angle_rad, double speed_radps) const {
    constexpr int kMostTurns = 200;
    const MuscleGeometry geometry = body.geometry({angle_rad, speed_radps, 0.0});
    PerMuscle longer{}, tension_n{};
    longer.fill(1.0 + recording.truth.beside.length_activation * (1.0 - effort(m)));
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const double step_n = effort(m) * body.full_force_n(geometry, longer, tension_n)[m] - tension_n[m];
      if (!recording.truth.departures.elastic()) return geometry.moment_arm_m[m] * (tension_n[m] + step_n);
      tension_n[m] += 0.5 * step_n;
      if (std::abs(step_n) < 1e-9 * recording.truth.muscles[m].max_isometric_force_n) break;
    }
    return geometry.moment_arm_m[m] * tension_n[m];
  }
};

/// The greatest value of a curve and its angle, by the parabola through the greatest value and its neighbors.
struct Top {
  double value = 0.0, angle_rad = 0.0;
};

Top top_of(const Curve& curve, const std::vector<double>& angles_rad) {
  const auto i = static_cast<std::size_t>(std::max_element(curve.begin(), curve.end()) - curve.begin());
  Top top{curve[i], angles_rad[i]};
  if (i == 0 || i + 1 == curve.size()) return top;
  const double before = curve[i - 1] - curve[i], after = curve[i + 1] - curve[i];
  if (!(before + after < 0.0)) return top;
  const double shift = 0.5 * (before - after) / (before + after);
  top.angle_rad += shift * (angles_rad[i + 1] - angles_rad[i]);
  top.value += 0.25 * (after - before) * shift;
  return top;
}

Curve sum(const Curve& a, const Curve& b) {
  if (a.empty()) return b;
  Curve result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += b[i];
  return result;
}

}  // namespace

std::vector<VoluntaryTruth> voluntary_truth(const VirtualRecording& recording,
                                            const std::optional<muscle::Range>& range_rad) {
  const muscle::Range range = range_rad ? *range_rad : reached_rad(recording);
  if (!(range.lower < range.upper)) return {};
  const Person person{recording};
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil((range.upper - range.lower) / kStep_rad)));
  std::vector<double> angles_rad;
  for (std::size_t i = 0; i <= steps; ++i)
    angles_rad.push_back(range.lower +
                         (range.upper - range.lower) * static_cast<double>(i) / static_cast<double>(steps));
  std::vector<VoluntaryTruth> truth;
  const auto add = [&](const std::string& owner, const std::string& ending, int speed_degps, const Curve& curve) {
    const Top top = top_of(curve, angles_rad);
    if (speed_degps > 0) {
      truth.push_back({owner, fmt::format("{}_{}{}", fit::kVoluntaryPower, speed_degps, ending), Unit::watt,
                       speed_degps * kDegree * top.value});
      return;
    }
    truth.push_back({owner, fmt::format("{}{}", fit::kVoluntaryTorque, ending), Unit::newton_meter, top.value});
    truth.push_back({owner, fmt::format("{}{}", fit::kVoluntaryAngle, ending), Unit::radian, top.angle_rad});
  };
  for (const int speed : {0, kSpeeds_degps[0], kSpeeds_degps[1], kSpeeds_degps[2]}) {
    Curve flexion, extension;
    for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
      const int direction = m == kTriceps ? -1 : 1;
      Curve curve = person.torque_nm(m, angles_rad, direction * speed * kDegree);
      for (double& value : curve) value *= direction;
      add(std::string(kArmMuscles[m]), "", speed, curve);
      (direction > 0 ? flexion : extension) = sum(direction > 0 ? flexion : extension, curve);
    }
    add("elbow_flexion", "_positive", speed, flexion);
    add("elbow_flexion", "_negative", speed, extension);
  }
  return truth;
}

}  // namespace myoid::lab
