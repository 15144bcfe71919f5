#include "myoid/muscle/held_stretch.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace myoid::muscle {
namespace {

constexpr double kDriven = 0.5;      ///< Of the drive.
constexpr double kLeastRise = 0.03;  ///< Of l0.
constexpr double kHeld = 0.01;       ///< Of l0.
constexpr double kLeastHold_s = 0.5;
constexpr double kBegun = 0.05;  ///< Share of the rise at which the stretch has begun.

double drive_at(const IsolatedMuscleInput& input, double t) {
  const Eigen::VectorXd& times = input.drive_time_s;
  if (times.size() < 2) return input.drive[0];
  const double* first = times.data();
  const Eigen::Index k = std::upper_bound(first, first + times.size(), t) - first - 1;
  return input.drive[std::max<Eigen::Index>(k, 0)];
}

/// Returns the time until which the muscle is driven and holds its length after sample `at`.
double held_until(const IsolatedMuscleInput& input, Eigen::Index at, double within_m) {
  double until_s = input.time_s[at];
  for (Eigen::Index k = at; k < input.time_s.size(); ++k) {
    if (std::abs(input.length_m[k] - input.length_m[at]) > within_m || drive_at(input, input.time_s[k]) < kDriven)
      break;
    until_s = input.time_s[k];
  }
  return until_s;
}

std::optional<HeldStretch> held_stretch(const IsolatedMuscleInput& input, double l0) {
  const Eigen::Index n = input.time_s.size();
  // A rise goes on until the length falls by more than a hold may move.
  Eigen::Index low = 0, high = 0;
  double next_s = input.time_s[0];  // of the next look for a hold
  for (Eigen::Index k = 0; k < n; ++k) {
    const bool driven = drive_at(input, input.time_s[k]) >= kDriven;
    const bool falls = input.length_m[k] < input.length_m[high] - kHeld * l0;
    if (!driven || falls || input.length_m[k] < input.length_m[low]) {
      low = high = k;
      continue;
    }
    if (input.length_m[k] > input.length_m[high]) high = k;
    const double rise_m = input.length_m[high] - input.length_m[low];
    if (rise_m < kLeastRise * l0 || input.time_s[k] < next_s) continue;
    next_s = input.time_s[k] + 0.1 * kLeastHold_s;
    // The stretch ends where the length first comes within a hold of its greatest.
    Eigen::Index begin = low, end = low;
    while (input.length_m[end] < input.length_m[high] - 0.5 * kHeld * l0) ++end;
    for (Eigen::Index i = low; i < end; ++i) {
      if (input.length_m[i] <= input.length_m[low] + kBegun * rise_m) begin = i;
    }
    const double until_s = held_until(input, end, kHeld * l0);
    if (until_s - input.time_s[end] < kLeastHold_s) continue;
    return HeldStretch{
        .begin_s = input.time_s[begin], .end_s = input.time_s[end], .rise_m = rise_m, .held_until_s = until_s};
  }
  return {};
}

}  // namespace

std::vector<HeldStretch> held_stretches(const std::vector<IsolatedRecording>& recordings,
                                        double optimal_fiber_length_m) {
  std::vector<HeldStretch> found;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    std::optional<HeldStretch> stretch = held_stretch(recordings[i].input, optimal_fiber_length_m);
    if (!stretch) continue;
    stretch->recording = i;
    found.push_back(*stretch);
  }
  return found;
}

IsolatedRecording before(const HeldStretch& stretch, const IsolatedRecording& recording) {
  IsolatedRecording part = recording;
  const Eigen::Index n = (recording.time_s.array() < stretch.begin_s).count();
  part.time_s = recording.time_s.head(n);
  part.force_n = recording.force_n.head(n);
  return part;
}

double force_enhancement_n(const HeldStretch& stretch, const IsolatedModel& model, const IsolatedRecording& recording) {
  const double from_s = 0.25 * stretch.end_s + 0.75 * stretch.held_until_s;
  const Eigen::VectorXd miss_n = recording.force_n - isolated_force(model, recording, 1e-6);
  double sum_n = 0.0;
  int count = 0;
  for (Eigen::Index k = 0; k < miss_n.size(); ++k) {
    if (recording.time_s[k] < from_s || recording.time_s[k] > stretch.held_until_s) continue;
    sum_n += miss_n[k];
    ++count;
  }
  return count == 0 ? 0.0 : sum_n / count;
}

}  // namespace myoid::muscle
