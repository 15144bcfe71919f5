#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/choice.h"
#include "myoid/core/progress.h"
#include "myoid/identification/options.h"

namespace myoid::identification {

/// The ways in which muscles may follow their EMG, as a person chooses them.
enum class LagChoice {
  automatic,   ///< Method `torque`: the lag that the data prefer; other methods: `delay`.
  delay,       ///< EmgLag::delay
  shared,      ///< EmgLag::shared
  equation_1,  ///< EmgLag::equation_1: the delay is the time that is left beside the lags.
};
inline constexpr std::string_view kLagNames[] = {"automatic", "delay", "shared", "equation_1"};
constexpr ChoiceNames choice_names(LagChoice) { return kLagNames; }

/// The choices about an estimator that a person makes, in a study file or on a command line. The
/// defaults are those of `EstimatorOptions`.
struct EstimatorSettings {
  std::vector<std::string> muscles;  ///< To identify; empty: all.
  bool priors = true;                ///< False: the data alone, by plain least squares.
  EstimatorKind estimator = EstimatorKind::least_squares;
  UnseenSpreads unseen;
  LagChoice lag = LagChoice::automatic;
  std::optional<double> delay_s;  ///< Held at this; empty: estimated.
  bool delay_per_channel = false;
  double max_rate_hz = EstimatorOptions{}.max_rate_hz;
  std::optional<double> residual_cutoff_hz = EstimatorOptions{}.residual_cutoff_hz;
  double angle_sd_rad = 0.0;         ///< Error of the joint angle ...
  double angle_rate_sd_radps = 0.0;  ///< ... and of its rate.
  Loss loss = Loss::square;
  Eccentric eccentric = Eccentric::automatic;
  bool normalised = false;  ///< l_sh and v_max keep their ratio to l0.
  int starts = 1;           ///< Of the search (EstimatorOptions::multistart).
  int posterior_draws = 0;  ///< EstimatorOptions::posterior_draws
  IntervalOptions intervals;
};

/// The facts about one EMG channel that its noise and its gain follow from.
struct ChannelSource {
  std::string channel;
  std::optional<double> gain_sd;  ///< Relative error of the level that counts as 1; empty: the gain
                                  ///< is no unknown.
  double gain_mean = 1.0;         ///< Share of the maximum that activation 1 is.
  double bandwidth_hz = 0.0;      ///< EstimatorOptions::emg_bandwidth_hz
  double rest = 0.0;              ///< EstimatorOptions::emg_rest
};

/// The facts about the activations that an estimator is given. The defaults are those of
/// activations of which nothing else is known.
struct ActivationSource {
  bool from_mvc = true;  ///< Activation 1 is a maximal effort.
  double envelope_cutoff_hz = EstimatorOptions{}.envelope_cutoff_hz;
  std::vector<ChannelSource> channels;
};

/// The options of methods `force` and `torque`: `run` and `identify` have theirs from here. With
/// LagChoice::equation_1 the prior of the delay is 10 +- 10 ms in place of 60 +- 20 ms: the latter
/// is a delay by cross-correlation of EMG and force, of which tau_ne + tau_ac are some 55 ms.
[[nodiscard]] EstimatorOptions estimator_options(const EstimatorSettings& settings,
                                                 const ActivationSource& source,
                                                 const Progress& progress);

}  // namespace myoid::identification
