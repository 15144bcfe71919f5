#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/score.h"
#include "myoid/fit/intervals/voluntary_curve.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/least_squares.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {

/// The origins of an uncertainty.
enum class Source { noise, literature, geometry, electrodes, torque_scale, model };
inline constexpr int kSourceCount = 6;

/// Their names in the columns of files, in the order of `Source`.
inline constexpr std::array<std::string_view, kSourceCount> kSourceColumns = {"noise",      "literature",   "geometry",
                                                                              "electrodes", "torque_scale", "model"};

/// Shares of a variance by source, which add to 1.
using SourceShares = std::array<double, kSourceCount>;

/// The degree to which a number can be trusted.
enum class Verdict {
  identified,        ///< The recording determines the person's number.
  reproducible,      ///< It determines the number given geometry and sensors only: sessions may be compared by it.
  weak,              ///< The recording determines it in part; the interval is wide.
  prior_dominated,   ///< The value is mostly the prior's.
  not_identifiable,  ///< The recording does not determine it.
  non_physical,      ///< No muscle can have the value: the fit describes something other than a muscle.
};
inline constexpr std::string_view kVerdictNames[] = {"identified",      "reproducible",     "weak",
                                                     "prior_dominated", "not_identifiable", "non_physical"};
constexpr ChoiceNames choice_names(Verdict) { return kVerdictNames; }
[[nodiscard]] constexpr std::string_view name(Verdict verdict) { return choice_name(verdict); }

/// The samples that a number is fitted to.
enum class FitCase { both, shortening, lengthening };
inline constexpr std::string_view kFitCaseNames[] = {"both", "shortening", "lengthening"};
constexpr ChoiceNames choice_names(FitCase) { return kFitCaseNames; }
[[nodiscard]] constexpr std::string_view name(FitCase fit_case) { return choice_name(fit_case); }

/// Returns the rank of a verdict; a greater rank is worse.
[[nodiscard]] constexpr int severity(Verdict verdict) { return static_cast<int>(verdict); }

/// A number's prior, and the estimate's distance from it.
struct PriorOfEstimate {
  std::optional<double> prior_mean, prior_sd;
  std::optional<double> prior_distance;  ///< Of the estimate from the prior's mean, in prior spreads (in its scale).
  /// 1 - posterior variance / prior variance; negative if the model's error exceeds the prior.
  std::optional<double> shrinkage;
};

/// One row of parameters.csv.
struct ParameterEstimate : PriorOfEstimate {
  std::string muscle;   ///< Muscle, EMG channel, or "subject".
  std::string tied_to;  ///< The first owner of the same unknown; empty: no tie.
  std::string parameter;
  Unit unit = Unit::dimensionless;
  Method method = Method::torque;
  FitCase fit_case = FitCase::both;
  double initial = 0.0;
  double estimate = 0.0;
  std::optional<double> std_error;
  std::optional<double> ci_low, ci_high;  ///< 95 %.
  /// The second reading: value and 95 % interval if moment arms, tendons and the sensors' scales were exact. Sessions
  /// of one person are compared by it. Empty for method `paper`.
  std::optional<double> given_estimate, given_ci_low, given_ci_high;
  std::optional<SourceShares> variance_shares;  ///< By the posterior; else empty.
  bool at_bound = false;
  Verdict verdict = Verdict::not_identifiable;
  std::string reason;  ///< One sentence.
};

/// The prediction of one trial beside the measurement.
struct TrialFit : FiberScores {
  std::string trial;
  std::string joint;  ///< Joint of the torque; the forces belong to the trial.
  bool calibration = true;
  Eigen::VectorXd time_s;
  Eigen::VectorXd torque_nm;             ///< From inverse dynamics.
  Eigen::VectorXd literature_torque_nm;  ///< By the starting parameters.
  /// The law with the identified parameters, not smoothed; by the posterior, its expectation.
  Eigen::VectorXd torque_fit_nm;
  /// Standard deviation of a measured torque about the prediction, from parameters and noise. Empty: unknown.
  Eigen::VectorXd torque_sd_nm;
  Eigen::MatrixXd literature_force_n;  ///< n x m
  Eigen::MatrixXd force_fit_n;         ///< n x m
  Eigen::MatrixXd force_sd_n;          ///< n x m: from the parameters. Empty: unknown.
  /// By the posterior: the drive behind the envelope of each EMG channel, from which `force_fit_n` follows by the law
  /// of the muscles (fit/posterior/drive.h). Else empty: the forces follow from the envelopes.
  TimeSeries drive;
  Score score;  ///< Score of `torque_fit_nm`.
  /// Score of both torques below the fit's cut-off (EstimatorOptions::residual_cutoff_hz). It leaves out most of the
  /// EMG envelope's noise, which the prediction carries and a muscle does not.
  Score band;
};

/// A minimum at which searches from several starts end.
struct BasinRow {
  Eigen::VectorXd x;      ///< The lowest end in this basin, in the solver's scale.
  double cost = 0.0;      ///< Cost at `x`.
  int starts = 0;         ///< Number of starts that ended here.
  int converged = 0;      ///< Number of these starts that converged.
  double distance = 0.0;  ///< Root mean square distance from the best over the unknowns, in prior
                          ///< spreads (basins.h).
  bool rival = false;     ///< Almost as good as the best: at most a chi-square of 4 worse.
  bool given = false;     ///< The given start ended here.
};

/// The ends of searches from the given start and from points spread about it.
struct BasinTable {
  std::string fit;  ///< "all muscles", a muscle's name, or with its branch: "BIC shortening".
  int starts = 0;
  /// Number of starts whose search found no finite cost, or neither converged nor ended where
  /// another did. The best end is a basin in any case.
  int failed = 0;
  std::vector<BasinRow> basins;  ///< By rising cost.
};

/// The searches of method `paper` for one muscle in one branch.
struct PublishedSearch {
  std::string muscle;
  FitCase fit_case = FitCase::shortening;  ///< Never both.
  /// End of the steps that are halved until the criterion falls, or of damped ones; `converged`: a minimum of the
  /// published criterion.
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  int iterations = 0;
  bool damped = false;                  ///< By damped steps, because the halved ones found no minimum.
  double start_cost = 0.0, cost = 0.0;  ///< The criterion at the start and at the end [N^2].
  /// End of the plain steps, as published.
  math::Termination plain = math::Termination::no_descent;
  int plain_iterations = 0;
  bool plain_elsewhere = false;  ///< The plain steps converged to another point.
};

/// Compares the numbers that both branches of method `paper` share.
struct BranchTest {
  std::string muscle;
  double length_difference_m = 0.0;  ///< l0 in lengthening minus in shortening.
  double width_difference_m = 0.0;
  /// Chi-square with two degrees of freedom if both branches have equal numbers.
  double wald = 0.0;
  double p_value = 1.0;
};

/// The distance of a muscle's numbers from their priors.
///
///   D^2 = sum_j ((z_j - prior_j) / sd_j)^2 over its own free parameters
///
/// P, the prior's covariance, stands for P - C, by which a fit moves an estimate; C is its own.
struct PriorDistance {
  std::string muscle;
  double distance = 0.0;           ///< D, converted to standard deviations of one normal number.
  std::string farthest;            ///< The parameter with the greatest distance.
  double farthest_distance = 0.0;  ///< The distance of `farthest`.
};

/// Returns true if a parameter belongs to no muscle and no person but is free so that its
/// uncertainty enters the others: gain and exponent of an EMG channel, torque of the joint itself.
/// Nuisances do not count among the results of a recording.
[[nodiscard]] inline bool is_nuisance(const ParameterEstimate& estimate) {
  return estimate.parameter == "emg_gain" || estimate.parameter == "emg_exponent" ||
         estimate.parameter.starts_with("joint_");
}

/// The searches of method `paper`.
struct PaperSearches {
  std::vector<BranchTest> branch_tests;
  std::vector<PublishedSearch> published;
  std::vector<BasinTable> basins;  ///< One for each fit, if several starts were asked for.
};

/// The amount of data and work in a fit.
struct FitSize {
  int samples_used = 0;
  int samples_dropped = 0;
  double effective_samples = 0.0;
  int iterations = 0;
  double seconds = 0.0;
};

/// The errors that a fit leaves.
struct FitErrors {
  double torque_sd_nm = 0.0;  ///< s_T [N m]
  double emg_cv = 0.0;        ///< c_a
  /// Squared relative spread of each EMG channel's envelope, not low-passed (force, torque).
  Eigen::VectorXd envelope_variance;
  double model_error = 0.0;  ///< Systematic error, relative to the muscles' torques.
  /// 1 - SSE/SST of the fitted samples (both sides below the residual's cut-off), about the mean
  /// over all trials; the least of several joints or muscles.
  double r2 = 1.0;
};

struct IdentificationResult : FittedUnknowns, FitErrors, FitSize, PaperSearches {
  Method method = Method::torque;
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  std::vector<ParameterEstimate> estimates;
  /// With the estimates (methods force, torque).
  std::vector<muscle::HillParameters<double>> muscles;
  ModelValues values;    ///< All numbers of the model with the estimates (methods force, torque).
  double delay_s = 0.0;  ///< Delay of the first channel.
  /// Greatest voluntary torques over the joints' angles, whose numbers are the first of `estimates`; by the posterior.
  std::vector<VoluntaryCurve> voluntary;
  std::vector<std::string> open_sums;          ///< Of exact data: combinations that they leave open, as sums.
  std::vector<PriorDistance> prior_distances;  ///< One for each muscle with priors.
  std::vector<Remark> diagnoses;               ///< Errors whose signature the values carry.
  std::vector<Remark> warnings;                ///< About the fit as a whole.
  bool exact = false;  ///< The data are free of noise, and the numbers are those of plain_fit.h.
  std::vector<TrialFit> trials;
};

}  // namespace myoid::fit
