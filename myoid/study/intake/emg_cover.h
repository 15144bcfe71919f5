#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/remark.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The part of a motion that another recording covers, and the sentence about the part that lacks.
struct Cover {
  double begin_s = 0.0, end_s = 0.0;
  std::string lacks;
  bool as_long = false;  ///< The file lasts as long as the motion: it begins apart.
};
/// Returns the covered part if more than 0.1 s of the trial's part of the motion in `input` lies outside the clock of a
/// file with `recorded` ("EMG", "torque"). Throws ReadError if the trial is shorter than half a second, or the file
/// covers less than half of it.
[[nodiscard]] std::optional<Cover> check_cover(const std::filesystem::path& file,
                                               std::string_view recorded,
                                               const Eigen::VectorXd& time_s,
                                               const TrialSpec& trial,
                                               const TrialInput& input);

/// Rows [first, last] of a motion's clock with EMG, or up to half a sample of the motion beyond the
/// EMG's ends. first > last if there are none.
struct Rows {
  Eigen::Index first = 0, last = -1;
  [[nodiscard]] Eigen::Index count() const { return last - first + 1; }
};
[[nodiscard]] Rows rows_with_emg(const Eigen::VectorXd& motion_s, const Eigen::VectorXd& emg_s);

/// Returns the factor 2, 3, 4, 5, 10, 100, 1000 or its reciprocal from which the ratio is no farther than this share.
[[nodiscard]] std::optional<double> whole_factor(double ratio, double tolerance);

/// Returns the durations of EMG, `external_torque` and `external_loads` beside the motion's; empty where they need not
/// agree: one file, a window or a clock of their own, no motion, different beginnings, a maximal contraction or a
/// static pose. Of a trial that was cut to its loads, the durations before the cut.
[[nodiscard]] std::vector<TrialLengths> lengths_of(const TrialSpec& trial, const TrialInput& input);

/// Finds EMG whose duration differs from the motion's by a whole_factor, within 2 %: a wrong rate. It is an error if
/// the EMG is the shorter one, or if both ends agree within 0.5 % at the corrected rate, as after a common trigger;
/// otherwise a warning. It is also a warning if the ratio is the same in every trial, and differences grow with the
/// trial's length. Loads of such a duration are a warning, unless the trial's EMG says the same.
[[nodiscard]] std::vector<Remark> unlike_lengths(const std::vector<TrialLengths>& trials);

/// Returns true if a duration of one trial says that a rate is wrong: an error of its EMG, a warning of its loads.
[[nodiscard]] bool is_rate_wrong(const std::vector<TrialLengths>& of_one_trial);

}  // namespace myoid::study
