#include "myoid/simulation/effective_delay.h"

#include <algorithm>
#include <array>

#include "myoid/core/units.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/simulation/effective_truth.h"

namespace myoid::simulation {
namespace {

constexpr double kLongest_s = 0.25;
constexpr double kStep_s = 0.005;
constexpr auto kCount = static_cast<std::size_t>(kLongest_s / kStep_s + 0.5) + 1;
constexpr double kRate_hz = 25.0;

/// Torque at rest of every muscle over the joint's range, in steps of 2.5 degrees.
class RestingCurves {
 public:
  explicit RestingCurves(const TrueArm& person) {
    for (std::size_t k = 0; k < kAngles; ++k) {
      PerMuscle& here = values_.emplace_back();
      for (std::size_t m = 0; m < here.size(); ++m)
        here[m] = resting_torque_nm(person, m, static_cast<double>(k) * kStep_rad);
    }
  }
  [[nodiscard]] PerMuscle at(double angle_rad) const {
    return interpolated(values_, kStep_rad, angle_rad);
  }

 private:
  static constexpr double kStep_rad = 2.5 * kDegree;
  static constexpr std::size_t kAngles = 65;  // 0 to 160 degrees
  std::vector<PerMuscle> values_;
};

/// Sums over the samples of a muscle's true torque y and the model's x.
struct Sums {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  /// Squares that are left of y at the best gain.
  [[nodiscard]] double left() const { return xx > 0.0 ? yy - xy * xy / xx : yy; }
};

}  // namespace

double effective_delay_s(const TrueArm& person,
                         const VirtualArm& modelled,
                         const HillSet& muscles,
                         const std::vector<std::unique_ptr<Performance>>& performances) {
  const RestingCurves resting(person);
  std::array<double, kCount> left{};
  for (const auto& performance : performances) {
    const TrialKind kind = performance->script().protocol.kind;
    if (kind == TrialKind::passive || kind == TrialKind::mvc) continue;
    std::vector<std::array<Sums, 4>> sums(kCount);
    const double end_s = performance->script().duration_s;
    for (double t = 0.0; t <= end_s; t += 1.0 / kRate_hz) {
      const ArmState now = *performance->heads(t);
      const MuscleGeometry geometry = modelled.geometry(now.q);
      const PerMuscle at_rest = resting.at(now.q.value);
      PerMuscle made = {};
      for (std::size_t i = 0; i < kHeadCount; ++i) {
        const TrueHead& head = person.heads[i];
        made[head.muscle] +=
            model::travel(head.path, now.q.value).moment_arm_m * now.tendon_force_n[i];
      }
      PerMuscle per_activation = {};
      for (std::size_t m = 0; m < 4; ++m) {
        per_activation[m] =
            geometry.moment_arm_m[m] *
            muscle::hill_force(1.0, geometry.length_m[m] - muscles[m].tendon_slack_length_m,
                               geometry.velocity_mps[m], muscles[m]);
      }
      for (std::size_t k = 0; k < kCount; ++k) {
        const PerMuscle u = performance->drive(t - static_cast<double>(k) * kStep_s);
        for (std::size_t m = 0; m < 4; ++m) {
          const double x = u[m] * per_activation[m];
          const double y = made[m] - at_rest[m];
          sums[k][m].xx += x * x;
          sums[k][m].xy += x * y;
          sums[k][m].yy += y * y;
        }
      }
    }
    double size = 0.0;
    for (const Sums& s : sums.front()) size += s.yy;
    for (std::size_t k = 0; k < kCount && size > 0.0; ++k) {
      for (const Sums& s : sums[k]) left[k] += s.left() / size;
    }
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  if (best == 0 || best + 1 == kCount) return static_cast<double>(best) * kStep_s;
  // The bottom of the parabola through the three lowest.
  const double fall = left[best - 1] - left[best];
  const double rise = left[best + 1] - left[best];
  return (static_cast<double>(best) + 0.5 * (fall - rise) / (fall + rise)) * kStep_s;
}

}  // namespace myoid::simulation
