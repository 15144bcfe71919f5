#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/beliefs/beliefs.h"
#include "myoid/core/choice.h"
#include "myoid/core/progress.h"

namespace myoid::identification {

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

class DriveMemory;  // posterior/drive.h

/// Another fit's answer, next to which a search begins: the folds of a cross-validation begin at the whole fit's.
struct FitStart {
  std::vector<std::string> unknowns;  ///< IdentificationResult::free_parameters
  Eigen::VectorXd z;                  ///< IdentificationResult::solution
  Eigen::VectorXd noise;              ///< IdentificationResult::noise
  EmgLag lag = EmgLag::delay;
};

/// Options of methods `torque` and `force`.
struct EstimatorOptions {
  /// Muscles to identify; the others keep their start. Empty: all.
  std::vector<std::string> muscles;
  bool priors = true;             ///< False: bounds alone (plain_fit.h). The posterior needs priors.
  std::optional<double> delay_s;  ///< Fixed delay; empty: estimated, with a prior.
  double delay_prior_mean_s = beliefs::kEmgDelay.value;
  double delay_prior_sd_s = beliefs::kEmgDelay.sd;
  bool delay_per_channel = false;  ///< One delay for each EMG channel; false: one for all.
  /// EMG channels whose gain is a nuisance about 1, with the standard deviation of its logarithm:
  /// the uncertainty of the normalisation, which F_max inherits. Empty: no gains.
  std::map<std::string, double> gain_prior_sd;
  std::map<std::string, double> gain_prior_mean;  ///< In place of 1.
  /// Statistical bandwidth [Hz] of the raw EMG by channel (signals::statistical_bandwidth_hz). It determines an
  /// envelope's noise (`envelope_spread`).
  std::map<std::string, double> emg_bandwidth_hz;
  /// Resting level of each channel over the level that counts as 1: the electrode's noise, whose
  /// power is subtracted from the envelope's. Its spread remains and enlarges the relative spread
  /// of a small envelope u by the factor 1 + (rest / u)^2.
  std::map<std::string, double> emg_rest;
  double envelope_cutoff_hz = 6.0;  ///< Cut-off of the rectified EMG's smoothing.
  /// Highest rate after thinning. EMG and motion reach 6 Hz, but a power of the envelope reaches
  /// further, and at 12 Hz folds to frequencies that tell lags and delay apart.
  double max_rate_hz = 20.0;
  /// Low-pass L of both sides of the residual (two passes, -3 dB). The noise of an envelope reaches higher frequencies
  /// than the differences between muscles do. Empty: no low-pass.
  std::optional<double> residual_cutoff_hz = 1.5;
  double angle_sd_rad = 0.0;         ///< Error of the joint angle, propagated into every sample.
  double angle_rate_sd_radps = 0.0;  ///< Error of the joint angle's rate.
  Eccentric eccentric = Eccentric::automatic;
  bool normalised = false;     ///< l_sh and v_max keep their ratio to l0.
  EmgLag lag = EmgLag::delay;  ///< The law by which a muscle follows its EMG.
  /// Method `torque`: `delay` and `shared`, each by its evidence.
  bool choose_lag = false;
  bool measured_is_force = false;  ///< The fit is to the force of one muscle, not to a torque.
  bool from_mvc = true;            ///< Activation 1 is a maximal effort; verdicts use this.
  bool predictions = true;         ///< Fills IdentificationResult::trials.
  Progress progress;
  UnseenSpreads unseen;
  int posterior_draws = 0;                   ///< Draws by Hamiltonian Monte Carlo; 0: draws from an approximation.
  bool marginals = true;                     ///< The approximation includes the skewness of each unknown.
  std::shared_ptr<DriveMemory> drives;       ///< Drives that fits of one recording share.
  std::shared_ptr<const FitStart> begin_at;  ///< Null: the posterior's own starts and both laws of lag.

  /// Returns the held delay, else the expected one.
  [[nodiscard]] double usual_delay_s() const { return delay_s.value_or(delay_prior_mean_s); }
  /// Returns `emg_bandwidth_hz` of the channel; 0: not known, because another program made the envelope.
  [[nodiscard]] double bandwidth_hz(const std::string& channel) const;
  /// Returns `emg_rest` of the channel; 0 where not known, or where what was subtracted from the envelope is not known.
  [[nodiscard]] double rest_level(const std::string& channel) const;
};

/// Returns an envelope's relative spread without electrode noise: that of rectified Gaussian noise
/// with the EMG's bandwidth, averaged over the filters' time (0.4815 / cut-off of two passes of
/// second order). An unknown bandwidth counts as 150 Hz.
[[nodiscard]] double envelope_spread(const EstimatorOptions& options, const std::string& channel);

}  // namespace myoid::identification
