#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/least_squares.h"
#include "myoid/muscle/isolated_muscle.h"

namespace myoid::muscle {

/// One experiment on a muscle alone.
struct IsolatedRecording {
  std::string name;
  IsolatedMuscleInput input;        ///< Its response is that of the model.
  Eigen::VectorXd time_s, force_n;  ///< Measured force of the tendon; within the input's times.
};

/// Parameters, laws and curves of a unit, and its way from excitation to active state.
struct IsolatedModel {
  MusculotendonParameters<double> parameters;
  MusculotendonLaws laws;
  MillardShape millard;
  ExcitationResponse response;
};

/// Calls f(name, unit, field) for every number of the model that can be identified.
template <typename Model, typename F>
void visit_model(Model& model, F&& f) {
  visit_parameters(model.parameters, f);
  visit_response(model.response, f);
}

struct IsolatedFitOptions {
  std::vector<std::string> parameters;  ///< Names of visit_model; positive at the start.
  /// A value stays within its start over and times this; the belief that it lies there has 95 %.
  double reach = 3.0;
  /// Each recording has its own value of these `parameters`; the logarithm scatters about the common one.
  std::vector<std::string> own;
  double relative_tolerance = 1e-7;  ///< Tolerance of the integration.
  int other_starts = 24;             ///< Points that are tried beside the start; 0: the start alone.
  Progress progress;
};

struct IsolatedEstimate {
  std::string parameter;
  Unit unit = Unit::dimensionless;
  double start = 0.0, value = 0.0;
  /// From the residuals, by their effective number, without the belief; infinite unless `told`.
  double std_error = 0.0;
  bool at_bound = false;
  bool told = true;      ///< False: the forces do not depend on the parameter, or on it apart from the others.
  double scatter = 0.0;  ///< Standard deviation of the logarithms of the recordings' own values.
};

struct IsolatedFit {
  IsolatedModel model;
  std::vector<IsolatedModel> of_recordings;  ///< With each recording's own values, in the order of the recordings.
  std::vector<IsolatedEstimate> estimates;
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  int evaluations = 0;  ///< Number for all recordings.
  bool moved = true;    ///< False: no parameter left the starting values.
  /// True: the search from the starting values ended in a worse minimum than a search from elsewhere.
  bool from_elsewhere = false;
  double noise_n = 0.0;  ///< Error of one force whose n are as good as the residuals' effective number.
};

/// Returns the model's force [N] at the times of the recording's; NaN at times that the integration did not reach.
[[nodiscard]] Eigen::VectorXd isolated_force(const IsolatedModel& model,
                                             const IsolatedRecording& recording,
                                             double relative_tolerance = 1e-9);

/// Fits the parameters so that the simulated experiments (elastic tendon, mass and all) come nearest to the measured
/// forces: least squares over all samples and a belief in the start, whose logarithm has the standard deviation
/// ln(reach) / 1.96. Against the belief the forces count by the effective number of their residuals, which a first fit
/// without it tells. Logarithms are the unknowns, derivatives come from central differences. Lengths are thinned to
/// 5e-5 l0, forces to every 2 ms. The search begins at the starting values and at the best of `other_starts` points
/// spread evenly over the reach; the lower minimum counts. A parameter is not `told` if no change within its reach
/// moves the forces by a thousandth of their spread, or if the change can be undone by the others. Under the law
/// `millard` eccentric_plateau is the curve's greatest multiplier and passive_strain the curve's strain at F_max.
/// force_length_width keeps its share of optimal_fiber_length unless it is identified. Throws InvalidInput for names
/// that are no parameters of the unit, values that are not positive, and sizes that differ.
[[nodiscard]] IsolatedFit fit_isolated_muscle(const IsolatedModel& start,
                                              const std::vector<IsolatedRecording>& recordings,
                                              const IsolatedFitOptions& options);

/// Fits the same to all recordings but the first, but the second, ...: each search begins at `all`, the fit to all of
/// them, and takes its noise. Empty for one recording.
[[nodiscard]] std::vector<IsolatedFit> fit_without_each(const IsolatedModel& start,
                                                        const std::vector<IsolatedRecording>& recordings,
                                                        const IsolatedFitOptions& options,
                                                        const IsolatedFit& all);

/// An estimate that one recording decides.
struct DecidedByOne {
  std::size_t parameter = 0;  ///< Number of the estimate.
  std::size_t recording = 0;  ///< Number of the recording whose absence moves it farthest.
  double without = 0.0;       ///< The estimate without that recording, in its own unit.
  double std_errors = 0.0;    ///< Its distance, in standard errors of the fit to all recordings.
};

/// Widens each standard error of the fit to all n recordings to the jackknife's,
/// sqrt((n - 1) / n sum_i (x_i - mean)^2), with x_i the estimate without recording i; a standard
/// error that is larger stays. Returns the estimates that some x_i lies more than two standard
/// errors of the residuals away from. `without` holds the fits without recording 0, 1, ...; fewer
/// than two of them change nothing. (Quenouille 1956; Efron & Tibshirani 1993, ch. 11.)
[[nodiscard]] std::vector<DecidedByOne> widen_to_jackknife(IsolatedFit& all, const std::vector<IsolatedFit>& without);

}  // namespace myoid::muscle
