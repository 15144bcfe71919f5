// How long one prediction takes: an arm of 4 muscles and a leg of 80 muscles at 3 joints. Quantiles
// by the clock, because a device that runs in real time cares for the slowest, not for the mean.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "myoid/results/realtime/predictor.h"

namespace {

using namespace myoid;

/// Muscles with 8 unknowns each, whose lengths are polynomials of degree `degree` of all joints.
results::Predictor person(int muscles, int joints, int degree) {
  results::Predictor p;
  const auto terms = static_cast<Eigen::Index>(body::term_count(joints, degree));
  const muscle::HillParameters<double> hill{.max_isometric_force_n = 800.0,
                                            .optimal_fiber_length_m = 0.12,
                                            .force_length_width_m = 0.05,
                                            .concentric_curvature = 0.3,
                                            .eccentric_curvature_product = 0.06,
                                            .eccentric_plateau = 1.4,
                                            .max_shortening_speed_mps = 1.2,
                                            .tendon_slack_length_m = 0.18};
  for (int j = 0; j < joints; ++j) p.joints.push_back({"q" + std::to_string(j), j, {}, {}});
  for (int m = 0; m < muscles; ++m) {
    body::PathSurrogate path;
    for (int j = 0; j < joints; ++j) path.coordinates.push_back(j);
    path.lower = Eigen::VectorXd::Constant(joints, -2.0);
    path.upper = Eigen::VectorXd::Constant(joints, 2.0);
    path.degree = degree;
    path.coefficient_m = Eigen::VectorXd::Constant(terms, 0.001);
    path.coefficient_m[0] = 0.3;
    p.paths.push_back(path);
    const auto k = static_cast<std::size_t>(m);
    p.channels.push_back({"e", {0.0, 0.9, 0.0, 0.04, 0.015, 0.05, 1.0}, {{fit::kGain, 8 * m, 1.0}}});
    p.muscles.push_back({"m", k, fit::muscle_values(hill), {{k, 1.0}}, {}});
    for (int f = 0; f < 7; ++f) p.muscles[k].chains.push_back({f, 8 * m + 1 + f, 1.0});
  }
  p.covariance = 1e-4 * Eigen::MatrixXd::Identity(8 * muscles, 8 * muscles);
  p.default_q = Eigen::VectorXd::Zero(joints);
  return p;
}

/// Quantiles of the time of one call of `evaluate`, whose argument counts the calls.
void measure(const char* what, const std::function<void(int)>& evaluate) {
  constexpr int kCount = 20000;
  std::vector<double> took_us;
  took_us.reserve(kCount);
  // Linux stops a process under a real-time policy that ran for 0.95 s of a second; each measurement takes less.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  for (int i = 0; i < kCount; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    evaluate(i);
    took_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(took_us.begin(), took_us.end());
  std::printf("%-38s median %7.2f us, 99 %% %7.2f us, 99.9 %% %7.2f us, largest %7.1f us\n", what, took_us[kCount / 2],
              took_us[kCount / 100 * 99], took_us[kCount / 1000 * 999], took_us.back());
}

void measure(const char* what, const results::Predictor& p, bool with_bands) {
  results::PredictorWorkspace w = results::workspace_for(p);
  std::vector<double> envelope(p.channels.size(), 0.3), angle(p.joints.size()), speed(p.joints.size(), 1.0);
  measure(what, [&](int i) {
    std::fill(angle.begin(), angle.end(), 1e-5 * i);
    (void)results::predict(p, envelope, angle, speed, w, with_bands);
  });
}

/// Additions in one register, without memory: the machine alone makes some of them slow.
void add_in_a_register(int count) {
  volatile double result = 0.0;
  double sum = 1.0;
  for (int i = 0; i < count; ++i) {
    sum += 1e-9;
    __asm__ volatile("" : "+x"(sum));
  }
  result = sum;
  (void)result;
}

}  // namespace

int main() {
  const results::Predictor arm = person(4, 1, 8), leg = person(80, 3, 5);
  measure("arm, 4 muscles", arm, false);
  measure("arm, 4 muscles, with bands", arm, true);
  measure("leg, 80 muscles, 3 joints", leg, false);
  measure("leg, 80 muscles, 3 joints, with bands", leg, true);
  measure("additions in a register, no memory", [](int) { add_in_a_register(35000); });
}
