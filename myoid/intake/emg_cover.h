#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/remark.h"
#include "myoid/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid {

/// Puts a warning into `input` where the motion that it holds goes on for more than 0.1 s without
/// EMG, with how long and what becomes of it. Throws ReadError where the trial is shorter than half
/// a second, or the EMG covers less than half of it.
void check_cover(const TrialSpec& trial, const Eigen::VectorXd& emg_s, TrialInput& input);

/// Rows of a motion's clock at which there is EMG, as [first, last]: none more than half a sample
/// of the motion beyond its ends. First above last if there are none.
struct Rows {
  Eigen::Index first = 0, last = -1;
  [[nodiscard]] Eigen::Index count() const { return last - first + 1; }
};
[[nodiscard]] Rows rows_with_emg(const Eigen::VectorXd& motion_s, const Eigen::VectorXd& emg_s);

/// How long EMG and motion of a trial last, each in a file of its own and without a window.
struct TrialLengths {
  std::string trial;
  double emg_s = 0.0, motion_s = 0.0;  ///< Both from the same begin.
  double motion_rate_hz = 0.0, emg_rate_hz = 0.0;
};
/// Empty where the two need not be alike: one file, a window, no motion, other begins, a maximal
/// contraction or a static pose.
[[nodiscard]] std::vector<TrialLengths> lengths_of(const TrialSpec& trial, const TrialInput& input);

/// EMG that lasts longer or shorter than the motion as a wrong rate makes it: 2, 3, 4, 5 or 10
/// times or as part of it, within 2 %: an error where it covers only that part, or ends together
/// with the motion within 0.5 % once the rate is corrected, as what one trigger stops does; else a
/// warning. Likewise a warning where both differ by one and the same factor in every trial.
[[nodiscard]] std::vector<Remark> unlike_lengths(const std::vector<TrialLengths>& trials);

}  // namespace myoid
