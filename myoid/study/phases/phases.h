#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::study {

/// The activity and the state of the muscles in a stretch of a trial.
enum class PhaseKind {
  rest,       ///< Neither movement nor activation.
  isometric,  ///< Activation without movement.
  fatigued,   ///< Less torque for equal EMG, and a lower frequency of the EMG, than at the beginning.
  regular,    ///< The parameters are identified from it.
};
inline constexpr std::string_view kPhaseNames[] = {"rest", "isometric", "fatigued", "regular"};
constexpr ChoiceNames choice_names(PhaseKind) { return kPhaseNames; }

struct Phase {
  PhaseKind kind = PhaseKind::regular;
  double begin_s = 0.0, end_s = 0.0;
  /// Torque measured per torque predicted from the EMG, as a fraction of the fresh muscles'.
  std::optional<double> gain;
  /// Median frequency of the EMG, as a fraction of the fresh muscles'.
  std::optional<double> frequency;
  bool excluded = false;  ///< Excluded by the study's rule; set by the caller.
  std::string reason;     ///< A sentence.
};

/// One trial, n samples on the clock of the motion.
struct PhaseSignals {
  Eigen::VectorXd time_s;
  Eigen::VectorXd velocity_radps;
  Eigen::VectorXd torque_nm;       ///< Measured.
  Eigen::VectorXd predicted_nm;    ///< From the EMG, with one set of parameters for the whole trial.
  Eigen::MatrixXd activation;      ///< n x channels, 0..1.
  TimeSeries median_frequency_hz;  ///< recording/signals/spectrum.h; may be empty, values may be NaN.
};

/// Phases of one trial of a study.
struct TrialPhases {
  std::string trial;
  std::vector<Phase> phases;
};

/// Mean activation, rate, length and change from which a stretch counts as rest, movement or fatigue.
namespace phase_limits {
inline constexpr double kStill_radps = 0.1;      ///< Root mean square of the rate over 1 s below which nothing moves.
inline constexpr double kRestActivation = 0.03;  ///< Mean activation below which a still muscle rests.
inline constexpr double kShortest_s = 1.5;       ///< Shortest rest and isometric phase.
inline constexpr double kBlock_s = 2.0;          ///< Torque per EMG is measured per block: a cycle or more.
inline constexpr double kGainChange = 0.10;      ///< Smaller falls of torque per EMG are none.
inline constexpr double kFrequencyFall = 0.08;   ///< Smaller falls of the median frequency are none (8-10 %).
inline constexpr double kSignificance = 4.0;     ///< Standard errors of a fall.
/// Blocks whose speed or torque differ by a larger factor are not compared: the law, not the muscle, may explain them.
inline constexpr double kAlike = 1.6;
}  // namespace phase_limits

}  // namespace myoid::study
