#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/progress.h"

namespace myoid::fit {

/// The law by which a muscle's activation follows its EMG.
enum class EmgLag {
  /// A pure delay d: a(t) = env(t - d).
  delay,
  /// A delay d of which the two lags of equation (1) (excitation, activation) are the larger part, in the proportions
  /// of `LagShares`. The lags weaken fast changes: for d = 80 ms by a twentieth at 1 Hz, by a third at 3 Hz.
  shared,
  /// A pure delay d, and in addition the two lags with their own time constants.
  equation_1,
};

inline constexpr std::string_view kEmgLagNames[] = {"delay", "shared", "equation_1"};
constexpr ChoiceNames choice_names(EmgLag) { return kEmgLagNames; }
[[nodiscard]] constexpr std::string_view name(EmgLag lag) { return choice_name(lag); }

/// The parts of a shared delay d: a pure delay of 10 ms and the time constants of excitation, 40
/// ms, activation, 15 ms, and deactivation, 50 ms (Winters 1990; Thelen 2003), over their sum of
/// 82.5 ms. The last two count as their mean, because activity rises as often as it falls; so the mean lag is d.
struct LagShares {
  double pure = 10.0 / 82.5;
  double excitation = 40.0 / 82.5;
  double activation = 15.0 / 82.5;
  double deactivation = 50.0 / 82.5;
};

/// The unknown from which the search computes V_sh V_shl.
enum class Eccentric {
  automatic,    ///< The slope ratio where it has a prior, else the product.
  product,      ///< P = V_sh V_shl.
  slope_ratio,  ///< S = f_v'(0+) / f_v'(0-), P = (V_ml - 1) V_sh / (S (1 + V_sh)).
  smooth,       ///< S = 1 held: f_v without a kink.
};
inline constexpr std::string_view kEccentricNames[] = {"automatic", "product", "slope_ratio", "smooth"};
constexpr ChoiceNames choice_names(Eccentric) { return kEccentricNames; }

/// The part of the data that each fit of a cross-validation leaves out.
enum class FoldKind {
  trial,      ///< One trial.
  condition,  ///< All trials of one condition (TrialData::condition); a trial without one is its
              ///< own condition.
  block,      ///< A fifth of every trial, with half a second on either side that is neither fitted nor
              ///< tested.
};
inline constexpr std::string_view kFoldNames[] = {"trial", "condition", "block"};
constexpr ChoiceNames choice_names(FoldKind) { return kFoldNames; }

/// The methods of identification.
enum class Method {
  paper,   ///< Each branch alone, as published.
  force,   ///< Each muscle against its own force.
  torque,  ///< All muscles against the joint's torque.
};
inline constexpr std::string_view kMethodNames[] = {"paper", "force", "torque"};
constexpr ChoiceNames choice_names(Method) { return kMethodNames; }
[[nodiscard]] constexpr std::string_view name(Method method) { return choice_name(method); }

class DriveMemory;  // fit/posterior/drive.h

/// The answer of a fit: what a prediction rests on, and next to which another search may begin, as those of the folds
/// of a cross-validation do.
struct FittedUnknowns {
  std::vector<std::string> free_parameters;  ///< Names of the unknowns.
  Eigen::VectorXd solution;                  ///< In the solver's scale (logarithms where logarithmic).
  Eigen::MatrixXd covariance;                ///< In the solver's scale.
  /// Draws of the values of `free_parameters` (SI) from the posterior, one column each, and their
  /// weights, which add to 1; else empty.
  Eigen::MatrixXd draws;
  Eigen::VectorXd draw_weights;
  /// Hyperparameters of the errors (fit/posterior/noise_model.h) of the posterior; else empty.
  Eigen::VectorXd noise;
  EmgLag lag = EmgLag::delay;  ///< The law by which the muscles follow their EMG.
};

/// A person's choice of how muscles follow their EMG.
enum class LagChoice {
  automatic,   ///< Method `torque`: both lags by their evidence; other methods: `delay`.
  delay,       ///< EmgLag::delay
  shared,      ///< EmgLag::shared
  equation_1,  ///< EmgLag::equation_1: the delay is the time beside the lags.
};
inline constexpr std::string_view kLagNames[] = {"automatic", "delay", "shared", "equation_1"};
constexpr ChoiceNames choice_names(LagChoice) { return kLagNames; }

/// A person's choices about a fit, in a study file or on a command line.
struct EstimatorSettings {
  std::vector<std::string> muscles;  ///< Muscles to identify; the others keep their start. Empty: all.
  UnseenSpreads unseen;
  LagChoice lag = LagChoice::automatic;
  std::optional<double> delay_s;     ///< Fixed delay; empty: estimated, with a prior.
  bool delay_per_channel = false;    ///< One delay for each EMG channel; false: one for all.
  double angle_sd_rad = 0.0;         ///< Error of the joint angle, propagated into every sample.
  double angle_rate_sd_radps = 0.0;  ///< Error of the joint angle's rate.
  Eccentric eccentric = Eccentric::automatic;
  bool normalised = false;  ///< l_sh and v_max keep their ratio to l0.
  int posterior_draws = 0;  ///< Draws by Hamiltonian Monte Carlo; 0: draws from an approximation.
};

/// The facts about one EMG channel that determine its noise and its gain.
struct ChannelSource {
  std::string channel;
  /// Standard deviation of the gain's logarithm: the relative error of the level that counts as 1, which F_max
  /// inherits. Empty: the gain is no unknown.
  std::optional<double> gain_sd;
  double gain_common_sd = 0.0;  ///< Unknown::common_sd of the gain.
  double gain_mean = 1.0;       ///< Activation 1 as a share of the maximum.
  /// Statistical bandwidth of the raw EMG (recording::statistical_bandwidth_hz), which determines an envelope's noise
  /// (`envelope_spread`). 0: not known, because another program made the envelope.
  double bandwidth_hz = 0.0;
  /// Resting level over the level that counts as 1: the electrode's noise, whose power is subtracted from the
  /// envelope's. Its spread remains and enlarges the relative spread of a small envelope u by the factor 1 + (rest /
  /// u)^2. It counts where the bandwidth is known.
  double rest = 0.0;
  double full_v = 0.0;  ///< The level that counts as 1; 0: not known.
};

/// The facts about the activations that a fit receives. The defaults describe activations of unknown origin.
struct ActivationSource {
  bool from_mvc = true;             ///< Activation 1 is a maximal effort; verdicts use this.
  double envelope_cutoff_hz = 6.0;  ///< Cut-off of the rectified EMG's smoothing.
  std::vector<ChannelSource> channels;

  /// Returns the facts about a channel; the defaults where none were stated.
  [[nodiscard]] ChannelSource of(std::string_view channel) const;
  /// Returns the facts about a channel, stated anew where none were.
  [[nodiscard]] ChannelSource& state(const std::string& channel);
  /// Returns ChannelSource::rest; 0 where what was subtracted from the envelope is not known.
  [[nodiscard]] double rest_level(const std::string& channel) const;
};

/// Options of methods `torque` and `force`: a person's choices, the facts about the activations, and what the program
/// adds.
struct EstimatorOptions : EstimatorSettings, ActivationSource {
  bool priors = true;  ///< False: bounds alone (plain_fit.h). The posterior needs priors.
  double delay_prior_mean_s = beliefs::kEmgDelay.value;
  double delay_prior_sd_s = beliefs::kEmgDelay.sd;
  /// Highest rate after thinning. EMG and motion reach 6 Hz, but a power of the envelope reaches
  /// further, and at 12 Hz folds to frequencies that tell lags and delay apart.
  double max_rate_hz = 20.0;
  /// Low-pass L of both sides of the residual (two passes, -3 dB). The noise of an envelope reaches higher frequencies
  /// than the differences between muscles do. Empty: no low-pass.
  std::optional<double> residual_cutoff_hz = 1.5;
  EmgLag law = EmgLag::delay;  ///< The law by which a muscle follows its EMG.
  /// Method `torque`: `delay` and `shared`, each by its evidence.
  bool choose_lag = false;
  bool measured_is_force = false;  ///< The fit is to the force of one muscle, not to a torque.
  bool predictions = true;         ///< Fills IdentificationResult::trials.
  bool marginals = true;           ///< The approximation includes the skewness of each unknown.
  Progress progress;
  std::shared_ptr<DriveMemory> drives;             ///< Drives that fits of one recording share.
  std::shared_ptr<const FittedUnknowns> begin_at;  ///< Null: the posterior's own starts and both laws of lag.

  /// Returns the held delay, else the expected one.
  [[nodiscard]] double usual_delay_s() const { return delay_s.value_or(delay_prior_mean_s); }
};

/// Returns the options of methods `force` and `torque`, for `run` and `identify`. With
/// LagChoice::equation_1 the prior of the delay is 10 +- 10 ms in place of 60 +- 20 ms: the latter
/// comes from cross-correlation of EMG and force and includes tau_ne + tau_ac of some 55 ms.
[[nodiscard]] EstimatorOptions estimator_options(const EstimatorSettings& settings,
                                                 const ActivationSource& source,
                                                 const Progress& progress);

/// Returns an envelope's relative spread without electrode noise: that of rectified Gaussian noise
/// with the EMG's bandwidth, averaged over the filters' time (0.4815 / cut-off of two passes of
/// second order). An unknown bandwidth counts as 150 Hz.
[[nodiscard]] double envelope_spread(const EstimatorOptions& options, const std::string& channel);

}  // namespace myoid::fit
