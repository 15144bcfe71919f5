#include "myoid/body/kinematics/pose_comparison.h"

#include <algorithm>
#include <cmath>

namespace myoid::body {
namespace {

constexpr double kRoundOff_m2 = 1e-13;  // of 2 J
constexpr double kAlike = 0.01;         // relative difference of the costs of postures that fit alike
constexpr double kAlike_m2 = 2e-6;      // the same of 2 J
constexpr double kSame_rad = 1e-4;      // postures nearer to each other are one

}  // namespace

bool replaces(const PoseFit::Pose& a, const PoseFit::Pose& b, double share) {
  if (b.converged) return a.converged && a.cost < share * b.cost - kRoundOff_m2;
  return (a.converged && a.cost <= b.cost * (1.0 + 1e-9)) || a.cost < b.cost * (1.0 - 1e-9);
}

double gain_of(const PoseFit::Pose& then, const PoseFit::Pose& now) {
  const double difference = now.cost - then.cost;
  if (std::abs(difference) <= kRoundOff_m2) return 0.0;
  return difference / (std::min(now.cost, then.cost) + kRoundOff_m2);
}

bool clearly_better(const PoseFit::Pose& then, const PoseFit::Pose& now) {
  return gain_of(then, now) > kAlike || now.cost - then.cost > kAlike_m2;
}

bool same_posture(const PoseFit::Pose& a, const PoseFit::Pose& b) {
  return (a.q - b.q).cwiseAbs().maxCoeff() < kSame_rad && std::abs(gain_of(a, b)) < 1e-6;
}

}  // namespace myoid::body
