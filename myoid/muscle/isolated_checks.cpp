#include "myoid/muscle/isolated_checks.h"

#include <optional>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

/// Returns true if the lengths of `length` cover the times of the forces of `force`.
bool covers(const IsolatedRecording& length, const IsolatedRecording& force) {
  const Eigen::VectorXd& from = length.input.time_s;
  const Eigen::VectorXd& wanted = force.time_s;
  return from[0] <= wanted[0] && from[from.size() - 1] >= wanted[wanted.size() - 1];
}

}  // namespace

double mean_force_error(const IsolatedModel& model, const IsolatedRecording& recording, double relative_tolerance) {
  return (isolated_force(model, recording, relative_tolerance) - recording.force_n).cwiseAbs().mean();
}

std::vector<std::string> check_force_size(const std::vector<IsolatedRecording>& recordings,
                                          double max_isometric_force_n) {
  constexpr double kLarge = 5.0, kNone = 50.0;
  std::vector<std::string> suspicious;
  for (const IsolatedRecording& r : recordings) {
    const double largest_n = r.force_n.cwiseAbs().maxCoeff();
    const std::string found = fmt::format("{}: forces up to {:.4g} N, {:.3g} times the muscle's F_max of {:.4g} N",
                                          r.name, largest_n, largest_n / max_isometric_force_n, max_isometric_force_n);
    if (largest_n > kNone * max_isometric_force_n)
      throw InvalidInput(found +
                         "; expected at most some 2 times: write them in N (are they in mN?), and "
                         "give the files of --length and --measured in the same order");
    if (largest_n > kLarge * max_isometric_force_n || largest_n < max_isometric_force_n / kNone)
      suspicious.push_back(found + "; are they in another unit, or of another muscle?");
  }
  return suspicious;
}

std::vector<std::string> check_recording_order(const IsolatedModel& start,
                                               const std::vector<IsolatedRecording>& recordings,
                                               double relative_tolerance) {
  constexpr double kBetter = 0.5;
  // Every length is simulated with the times of every other recording.
  std::vector<IsolatedMuscleInput> inputs;
  for (const IsolatedRecording& recording : recordings)
    inputs.push_back(thinned(recording.input, 5e-5 * start.parameters.hill.optimal_fiber_length_m));
  const auto error_n = [&](std::size_t length, std::size_t force) {
    const IsolatedRecording mixed{.name = recordings[length].name,
                                  .input = inputs[length],
                                  .time_s = recordings[force].time_s,
                                  .force_n = recordings[force].force_n};
    return mean_force_error(start, mixed, relative_tolerance);
  };
  std::vector<std::optional<double>> known_n(recordings.size());
  const auto own_n = [&](std::size_t i) {
    if (!known_n[i]) known_n[i] = error_n(i, i);
    return *known_n[i];
  };
  std::vector<std::string> suspicious;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (std::size_t j = i + 1; j < recordings.size(); ++j) {
      if (!covers(recordings[i], recordings[j]) || !covers(recordings[j], recordings[i])) continue;
      if (error_n(i, j) + error_n(j, i) >= kBetter * (own_n(i) + own_n(j))) continue;
      suspicious.push_back(
          fmt::format("{} and {} fit each other's length much better than their own, with the muscle as it "
                      "starts: give --length, --scale and --measured in the same order",
                      recordings[i].name, recordings[j].name));
    }
  }
  return suspicious;
}

}  // namespace myoid::muscle
