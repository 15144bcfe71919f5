#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/units.h"
#include "myoid/identification/emg_lag.h"
#include "myoid/identification/parameters.h"
#include "myoid/intervals/score.h"
#include "myoid/intervals/variance_sources.h"
#include "myoid/math/least_squares.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::identification {

/// The degree to which a number may be believed.
enum class Verdict {
  identified,        ///< The recording determines it.
  weak,              ///< It says something, but the interval is wide.
  prior_dominated,   ///< The value is mostly the prior's.
  not_identifiable,  ///< The recording cannot tell.
  non_physical,      ///< No muscle can have the value: the fit describes something else.
};
[[nodiscard]] std::string_view name(Verdict verdict);

/// The 95 % interval that one way of reckoning gives.
struct RouteInterval {
  std::string route;                ///< sandwich | cluster | jackknife | bootstrap | profile
  std::optional<double> low, high;  ///< Empty: open on that side.
  double spread = 0.0;  ///< Of the logarithm of the width, from the route's own sample; 0: none.
};

/// One row of parameters.csv.
struct ParameterEstimate {
  std::string muscle;   ///< Or the EMG channel, or "subject".
  std::string tied_to;  ///< The first owner of the same unknown; empty: its own.
  std::string parameter;
  Unit unit = Unit::dimensionless;
  std::string method;    ///< paper | force | torque
  std::string fit_case;  ///< shortening | lengthening | both
  double initial = 0.0;
  double estimate = 0.0;
  std::optional<double> std_error;
  std::optional<double> ci_low, ci_high;  ///< 95 %, by the first of `routes`.
  std::vector<RouteInterval> routes;      ///< At least two, where they were asked for.
  bool routes_disagree = false;           ///< One is more than half as wide again as another.
  std::optional<double> prior_mean, prior_sd;
  std::optional<double> prior_distance;  ///< Of the estimate from the prior's mean, in its spreads
                                         ///< (of the logarithm where the prior is on that).
  std::optional<double> shrinkage;  ///< 1 - posterior variance / prior variance; negative where
                                    ///< the model's own error makes it less sure than that.
  std::optional<SourceShares> variance_shares;  ///< Of the posterior; else empty.
  bool at_bound = false;
  Verdict verdict = Verdict::not_identifiable;
  std::string reason;  ///< One sentence.
};

/// The prediction of one trial beside the measurement.
struct TrialFit {
  std::string trial;
  std::string joint;  ///< Of the torque; the forces belong to the trial.
  bool calibration = true;
  Eigen::VectorXd time_s;
  Eigen::VectorXd torque_nm;             ///< From inverse dynamics.
  Eigen::VectorXd literature_torque_nm;  ///< Starting parameters.
  /// The law with the identified parameters, as it is; of the posterior, its expectation.
  Eigen::VectorXd torque_fit_nm;
  /// Standard deviation of a measured torque about the prediction: of the parameters and of the
  /// noise. Empty: not known.
  Eigen::VectorXd torque_sd_nm;
  double smooth_hz = 0.0;              ///< Where its noise does least harm (smooth_prediction.h).
  Eigen::MatrixXd literature_force_n;  ///< n x m
  Eigen::MatrixXd force_fit_n;         ///< n x m
  Eigen::MatrixXd force_sd_n;          ///< n x m: of the parameters. Empty: not known.
  Score score;                         ///< Of `torque_fit_nm`.
  /// Both torques below the fit's own cut-off (EstimatorOptions::residual_cutoff_hz): without most
  /// of the noise of the EMG envelope, which the prediction carries and a muscle does not.
  Score band;
};

/// A minimum at which searches from several starts end.
struct BasinRow {
  Eigen::VectorXd x;      ///< Of its lowest end, in the solver's scale.
  double cost = 0.0;      ///< Of that end.
  int starts = 0;         ///< That ended here ...
  int converged = 0;      ///< ... and converged.
  double distance = 0.0;  ///< From the best: root mean square over the unknowns, in spreads of the
                          ///< priors (start_box.h).
  bool rival = false;     ///< As good as the best: a chi-square of at most 4 worse.
  bool given = false;     ///< The given start ended here.
};

/// The ends of searches from the given start and from points spread about it.
struct BasinTable {
  std::string fit;  ///< "all muscles", a muscle's name, or with its branch: "BIC shortening".
  int starts = 0;
  /// Starts from which the search did not converge, nor end where another one did, or ended at no
  /// finite cost. The best end is a basin in any case.
  int failed = 0;
  std::vector<BasinRow> basins;  ///< By rising cost.
};

/// The comparison of the numbers that both branches of method `paper` share.
struct BranchTest {
  std::string muscle;
  double length_difference_m = 0.0;  ///< l0 in lengthening minus in shortening.
  double width_difference_m = 0.0;
  double wald = 0.0;  ///< Chi-square with two degrees of freedom if both are the same.
  double p_value = 1.0;
};

/// The distance of a muscle's numbers from their priors.
///
///   D^2 = sum_j ((z_j - prior_j) / sd_j)^2 over its own free parameters
///
/// A fit with priors moves an estimate by N(0, P - C), P the prior's and C its own covariance: by
/// less than P, which therefore stands for it here.
struct PriorDistance {
  std::string muscle;
  double distance = 0.0;           ///< D, as as many standard deviations of one normal number.
  std::string farthest;            ///< The parameter that is farthest ...
  double farthest_distance = 0.0;  ///< ... and how far.
};

/// True if a parameter is no muscle's and no person's, but freed so that its uncertainty enters the
/// others: gain and exponent of an EMG channel, torque of the joint itself. Nuisances do not count
/// among the results of a recording.
[[nodiscard]] inline bool is_nuisance(const ParameterEstimate& estimate) {
  return estimate.parameter == "emg_gain" || estimate.parameter == "emg_exponent" ||
         estimate.parameter.starts_with("joint_");
}

struct IdentificationResult {
  std::string method;
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  std::vector<ParameterEstimate> estimates;
  std::vector<muscle::HillParameters<double>> muscles;  ///< With the estimates (force, torque).
  ModelValues values;          ///< All numbers of the model with the estimates (force, torque).
  EmgLag lag = EmgLag::delay;  ///< How the muscles follow their EMG.
  /// Chi-square of the lag `delay` minus that of `shared`, if the fit chose the lag by it: the data
  /// prefer `shared` where it is positive.
  std::optional<double> shared_lag_gain;
  double delay_s = 0.0;      ///< Of the first channel.
  Eigen::VectorXd solution;  ///< In the solver's scale (torque).
  /// Covariance of the free parameters in the solver's scale (logarithms where logarithmic), for
  /// given slack lengths of the tendons. Standard errors and intervals add the uncertainty of these
  /// (`held_tendon_shift`).
  Eigen::MatrixXd covariance;
  std::vector<std::string> free_parameters;  ///< Its rows.
  /// Draws from the posterior, one column each, of the values of `free_parameters` (SI), and their
  /// weights, which add to 1; else empty.
  Eigen::MatrixXd draws;
  Eigen::VectorXd draw_weights;
  /// Hyperparameters of the errors (posterior/noise_model.h) of the posterior; else empty.
  Eigen::VectorXd noise;
  std::vector<std::string> collinear;     ///< Sets that the data hardly tell apart, as sentences.
  std::vector<std::string> undetermined;  ///< Combinations that the data leave open, as sentences.
  std::vector<PriorDistance> prior_distances;  ///< Of each muscle with priors.
  std::vector<std::string> diagnoses;          ///< Errors whose signature the values show.
  std::vector<std::string> warnings;
  std::vector<BranchTest> branch_tests;  ///< Method paper.
  std::vector<BasinTable> basins;        ///< Of each fit, where several starts were asked for.
  int bootstrap_replicates = 0;          ///< Converged ones.
  int bootstrap_failed = 0;
  bool exact = false;  ///< The data are free of noise: fitted as they are, without priors.
  int samples_used = 0;
  int samples_dropped = 0;
  double effective_samples = 0.0;
  double torque_sd_nm = 0.0;  ///< s_T
  double emg_cv = 0.0;        ///< c_a
  /// Square of the relative spread of each EMG channel's envelope, as it is (force, torque).
  Eigen::VectorXd envelope_variance;
  double model_error = 0.0;  ///< Systematic error, relative to the muscles' torques.
  /// 1 - SSE/SST of the fitted samples (both sides below the residual's cut-off), about
  /// the mean over all trials; of several joints or muscles the least.
  double r2 = 1.0;
  double condition = 0.0;
  int iterations = 0;
  double seconds = 0.0;
  std::vector<TrialFit> trials;
};

}  // namespace myoid::identification
