#include "myoid/lab/virtual_person/effective_delay.h"

#include <algorithm>
#include <array>

#include "myoid/ground/core/units.h"
#include "myoid/lab/virtual_person/effective_truth.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::lab {
namespace {

constexpr double kLongest_s = 0.25;
constexpr double kDelayStep_s = 0.005;
constexpr auto kCount = static_cast<std::size_t>(kLongest_s / kDelayStep_s + 0.5) + 1;
constexpr double kRate_hz = 25.0;
/// Noise that lowers the weight of a sample: of the torque, and of the EMG relative to its value.
constexpr double kTorqueSd_nm = 0.3, kEmgSd = 0.14;

/// Torque and viscosity of every unexcited muscle over the joint's range, in steps of 2.5 degrees.
class RestingCurves {
 public:
  explicit RestingCurves(const TrueArm& person) {
    for (std::size_t k = 0; k < kAngles; ++k) {
      const double angle_rad = static_cast<double>(k) * kStep_rad;
      PerMuscle& still = still_nm_.emplace_back();
      PerMuscle& viscosity = viscosity_nms_.emplace_back();
      for (std::size_t m = 0; m < still.size(); ++m) {
        still[m] = resting_torque_nm(person, m, angle_rad, 0.0);
        viscosity[m] = (resting_torque_nm(person, m, angle_rad, -kSlow_radps) -
                        resting_torque_nm(person, m, angle_rad, kSlow_radps)) /
                       (2.0 * kSlow_radps);
      }
    }
  }
  [[nodiscard]] PerMuscle at(const Moment& q) const {
    PerMuscle torque_nm = interpolated(still_nm_, kStep_rad, q.value);
    const PerMuscle viscosity_nms = interpolated(viscosity_nms_, kStep_rad, q.value);
    for (std::size_t m = 0; m < torque_nm.size(); ++m) torque_nm[m] -= viscosity_nms[m] * q.first;
    return torque_nm;
  }

 private:
  static constexpr double kStep_rad = 2.5 * kDegree;
  static constexpr double kSlow_radps = 1.0;
  static constexpr std::size_t kAngles = 65;  // 0 to 160 degrees
  std::vector<PerMuscle> still_nm_, viscosity_nms_;
};

/// Sums over the samples of a muscle's true torque y and the model's x.
struct Sums {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  /// Returns the sum of squares of y that the best gain leaves.
  [[nodiscard]] double left() const { return xx > 0.0 ? yy - xy * xy / xx : yy; }
};

/// Returns true if a trial counts. If there are contractions of a `held` joint, these alone count:
/// in a movement every error of the force-length and force-velocity curves shifts the torque, too.
bool counts(TrialKind kind, bool held) {
  if (held) return kind == TrialKind::isometric_ramp;
  return kind != TrialKind::passive && kind != TrialKind::mvc;
}

}  // namespace

double effective_delay_s(const TrueArm& person,
                         const VirtualArm& modelled,
                         const HillSet& muscles,
                         const std::vector<std::unique_ptr<Performance>>& performances) {
  const RestingCurves resting(person);
  const bool held = std::any_of(performances.begin(), performances.end(), [](const auto& performance) {
    return performance->script().protocol.kind == TrialKind::isometric_ramp;
  });
  std::array<double, kCount> left{};
  for (const auto& performance : performances) {
    if (!counts(performance->script().protocol.kind, held)) continue;
    std::vector<std::array<Sums, 4>> sums(kCount);
    const double end_s = performance->script().duration_s;
    for (double t = 0.0; t <= end_s; t += 1.0 / kRate_hz) {
      const ArmState now = *performance->heads(t);
      const MuscleGeometry geometry = modelled.geometry(now.q);
      const PerMuscle at_rest = resting.at(now.q);
      PerMuscle made = {};
      for (std::size_t i = 0; i < kHeadCount; ++i) {
        const TrueHead& head = person.heads[i];
        made[head.muscle] += body::travel(head.path, now.q.value).moment_arm_m * now.tendon_force_n[i];
      }
      PerMuscle per_activation = {}, beyond_rest = {}, weight = {};
      for (std::size_t m = 0; m < 4; ++m) {
        per_activation[m] =
            geometry.moment_arm_m[m] * muscle::hill_force(1.0, geometry.length_m[m] - muscles[m].tendon_slack_length_m,
                                                          geometry.velocity_mps[m], muscles[m]);
        beyond_rest[m] = made[m] - at_rest[m];
        weight[m] = 1.0 / (kTorqueSd_nm * kTorqueSd_nm + kEmgSd * kEmgSd * beyond_rest[m] * beyond_rest[m]);
      }
      for (std::size_t k = 0; k < kCount; ++k) {
        const PerMuscle u = performance->drive(t - static_cast<double>(k) * kDelayStep_s);
        for (std::size_t m = 0; m < 4; ++m) {
          const double x = u[m] * per_activation[m];
          const double y = beyond_rest[m];
          sums[k][m].xx += weight[m] * x * x;
          sums[k][m].xy += weight[m] * x * y;
          sums[k][m].yy += weight[m] * y * y;
        }
      }
    }
    for (std::size_t k = 0; k < kCount; ++k) {
      for (const Sums& s : sums[k]) left[k] += s.left();
    }
  }
  const auto best = static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  if (best == 0 || best + 1 == kCount) return static_cast<double>(best) * kDelayStep_s;
  // The bottom of the parabola through the three lowest.
  const double fall = left[best - 1] - left[best];
  const double rise = left[best + 1] - left[best];
  return (static_cast<double>(best) + 0.5 * (fall - rise) / (fall + rise)) * kDelayStep_s;
}

}  // namespace myoid::lab
