#include "myoid/lab/virtual_person/effective_delay.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/lab/virtual_person/effective_truth.h"

namespace myoid::lab {
namespace {

constexpr double kAngle_rad = 1.3;

PerMuscle excitation(double time_s) {
  PerMuscle u = {};
  for (std::size_t m = 0; m < u.size(); ++m)
    u[m] = 0.4 + 0.3 * std::sin(2.0 * M_PI * (0.5 + 0.2 * static_cast<double>(m)) * time_s);
  return u;
}

/// A held arm whose muscles pull in proportion to an excitation of `delay_s` before, each by its
/// own gain, and by what they do at rest.
class Held : public Performance {
 public:
  Held(const TrueArm& person, TrialKind kind, double delay_s)
      : Performance(make_script({.name = "held", .kind = kind}, {}, 1)), person_(&person), delay_s_(delay_s) {}

  [[nodiscard]] Instant at(double) const override { return {}; }
  [[nodiscard]] Moment motion(double) const override { return {kAngle_rad, 0.0, 0.0}; }
  [[nodiscard]] PerMuscle drive(double time_s) const override { return excitation(time_s); }
  [[nodiscard]] PerMuscle fatigued(double) const override { return {}; }
  [[nodiscard]] std::optional<ArmState> heads(double time_s) const override {
    ArmState state;
    state.q = motion(time_s);
    const PerMuscle u = excitation(time_s - delay_s_);
    std::array<bool, 4> done{};
    for (std::size_t i = 0; i < kHeadCount; ++i) {
      const TrueHead& head = person_->heads[i];
      const double arm_m = body::travel(head.path, kAngle_rad).moment_arm_m;
      state.tendon_force_n[i] = 0.0;
      if (done[head.muscle]) continue;  // the first head of a muscle pulls for all
      done[head.muscle] = true;
      const double sign = arm_m > 0.0 ? 1.0 : -1.0;
      const double torque_nm = resting_torque_nm(*person_, head.muscle, kAngle_rad, 0.0) +
                               sign * (5.0 + 3.0 * static_cast<double>(i)) * u[head.muscle];
      state.tendon_force_n[i] = torque_nm / arm_m;
    }
    return state;
  }

 private:
  const TrueArm* person_;
  double delay_s_;
};

TrueArm person() {
  math::Random random(3);
  return draw_true_arm({}, VirtualSubject{}, random);
}

TEST(EffectiveDelay, IsTheLagOfTheForceWhateverTheMusclesGains) {
  const TrueArm arm = person();
  const VirtualArm modelled{VirtualSubject{}};
  std::vector<std::unique_ptr<Performance>> performances;
  for (const double delay_s : {0.030, 0.0873, 0.140}) {
    performances.clear();
    performances.push_back(std::make_unique<Held>(arm, TrialKind::isometric_ramp, delay_s));
    EXPECT_NEAR(effective_delay_s(arm, modelled, modelled.literature, performances), delay_s, 5e-4);
  }
}

TEST(EffectiveDelay, AHeldJointTellsItBeforeMovementsAndOtherTrialsNever) {
  const TrueArm arm = person();
  const VirtualArm modelled{VirtualSubject{}};
  std::vector<std::unique_ptr<Performance>> performances;
  performances.push_back(std::make_unique<Held>(arm, TrialKind::mvc, 0.150));
  performances.push_back(std::make_unique<Held>(arm, TrialKind::passive, 0.150));
  performances.push_back(std::make_unique<Held>(arm, TrialKind::flexion, 0.080));
  EXPECT_NEAR(effective_delay_s(arm, modelled, modelled.literature, performances), 0.080, 5e-4);
  performances.push_back(std::make_unique<Held>(arm, TrialKind::isometric_ramp, 0.050));
  EXPECT_NEAR(effective_delay_s(arm, modelled, modelled.literature, performances), 0.050, 5e-4);
}

}  // namespace
}  // namespace myoid::lab
