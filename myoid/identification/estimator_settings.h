#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/choice.h"
#include "myoid/core/progress.h"
#include "myoid/identification/options.h"

namespace myoid::identification {

/// A person's choice of how muscles follow their EMG.
enum class LagChoice {
  automatic,   ///< Method `torque`: both lags by their evidence; other methods: `delay`.
  delay,       ///< EmgLag::delay
  shared,      ///< EmgLag::shared
  equation_1,  ///< EmgLag::equation_1: the delay is the time beside the lags.
};
inline constexpr std::string_view kLagNames[] = {"automatic", "delay", "shared", "equation_1"};
constexpr ChoiceNames choice_names(LagChoice) { return kLagNames; }

/// A person's choices about a fit, in a study file or on a command line. The defaults are
/// those of `EstimatorOptions`.
struct EstimatorSettings {
  std::vector<std::string> muscles;  ///< Muscles to identify; empty: all.
  UnseenSpreads unseen;
  LagChoice lag = LagChoice::automatic;
  std::optional<double> delay_s;  ///< Fixed delay; empty: estimated.
  bool delay_per_channel = false;
  double angle_sd_rad = 0.0;         ///< Error of the joint angle.
  double angle_rate_sd_radps = 0.0;  ///< Error of the joint angle's rate.
  Eccentric eccentric = Eccentric::automatic;
  bool normalised = false;  ///< l_sh and v_max keep their ratio to l0.
  int posterior_draws = 0;  ///< EstimatorOptions::posterior_draws
};

/// The facts about one EMG channel that determine its noise and its gain.
struct ChannelSource {
  std::string channel;
  /// Relative error of the level that counts as 1; empty: the gain is no unknown.
  std::optional<double> gain_sd;
  double gain_mean = 1.0;     ///< Activation 1 as a share of the maximum.
  double bandwidth_hz = 0.0;  ///< EstimatorOptions::emg_bandwidth_hz
  double rest = 0.0;          ///< EstimatorOptions::emg_rest
};

/// The facts about the activations that a fit receives. The defaults describe activations of unknown origin.
struct ActivationSource {
  bool from_mvc = true;  ///< Activation 1 is a maximal effort.
  double envelope_cutoff_hz = EstimatorOptions{}.envelope_cutoff_hz;
  std::vector<ChannelSource> channels;
};

/// Returns the options of methods `force` and `torque`, for `run` and `identify`. With
/// LagChoice::equation_1 the prior of the delay is 10 +- 10 ms in place of 60 +- 20 ms: the latter
/// comes from cross-correlation of EMG and force and includes tau_ne + tau_ac of some 55 ms.
[[nodiscard]] EstimatorOptions estimator_options(const EstimatorSettings& settings,
                                                 const ActivationSource& source,
                                                 const Progress& progress);

}  // namespace myoid::identification
