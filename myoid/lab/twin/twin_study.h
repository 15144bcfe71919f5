#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/truth_settings.h"

namespace myoid::lab {

struct TwinStudyOptions {
  int subjects = 200;
  std::uint64_t first_seed = 1;  ///< Subject k has the seed first_seed + k.
  std::vector<fit::Method> methods = {fit::Method::torque};
  Progress progress;
};

/// One estimate of one virtual person with its truth.
struct TwinRow {
  std::uint64_t seed = 0;
  double truth = 0.0;
  fit::ParameterEstimate estimate;

  /// Returns the error relative to the truth; for the EMG delay in units of 100 ms, so that 0.1 is 10 ms; for an
  /// angle in units of 100 degrees.
  [[nodiscard]] double error() const;
  [[nodiscard]] bool covered() const;  ///< The 95 % interval holds the truth.
};

/// The prediction of one held-back trial.
struct TwinPrediction {
  std::uint64_t seed = 0;
  std::string trial;
  fit::Score law;   ///< Score of the prediction with the reported parameters.
  fit::Score band;  ///< Score of both torques below the fit's own cut-off.
};

struct TwinFailure {
  std::uint64_t seed = 0;
  std::string message;
};

struct TwinStudyResult {
  std::string protocol;
  std::string level;
  std::vector<WorldSetting> world;  ///< Keys of [truth] beside the level's defaults.
  std::vector<TwinRow> rows;        ///< By seed, then in the order of the methods.
  std::vector<TwinPrediction> predictions;
  std::vector<TwinFailure> failures;
  int subjects = 0;  ///< Number of persons asked for.
  int finished = 0;  ///< Number of persons finished.
  std::uint64_t first_seed = 1;
  bool interrupted = false;  ///< Stopped before all were finished.
};

/// Shares of the errors within 5, 10, 15 and 20 %.
struct ErrorShares {
  double of_5 = 0.0, of_10 = 0.0, of_15 = 0.0, of_20 = 0.0;
};

/// The reading given geometry and sensors; NaN by method `paper`.
struct GivenErrors {
  double median_error = 0.0, coverage = 0.0, half_width = 0.0;
};

/// The verdict `identified` against an error below 10 %: good.
struct Confusion {
  int identified_good = 0, identified_bad = 0, other_good = 0, other_bad = 0;
};

/// Errors of one parameter over the persons. Shares refer to all rows, except `truths`.
struct TwinSummary {
  fit::Method method = fit::Method::torque;
  fit::FitCase fit_case = fit::FitCase::both;
  std::string muscle;  ///< "all": all muscles together.
  std::string parameter;
  int count = 0;
  double bias = 0.0;          ///< Median signed error.
  double median_error = 0.0;  ///< Median absolute error.
  double mad = 0.0;           ///< Median absolute deviation from the median.
  double rmse = 0.0;
  ErrorShares within;
  double prior_within_10 = 0.0;  ///< Share of the starting values within 10 %.
  int with_interval = 0;
  double coverage = 0.0;    ///< Share of the 95 % intervals that hold the truth.
  double half_width = 0.0;  ///< Median, in the unit of the error.
  GivenErrors given;
  double shrinkage = 0.0;                                     ///< Median.
  std::array<int, std::size(fit::kVerdictNames)> verdicts{};  ///< As fit::Verdict.
  Confusion confusion;
  int identified_within_15 = 0;  ///< Identified numbers within 15 %.
  int outside_physical = 0;      ///< Reported beyond the physical bounds and not `non_physical`.
};

/// Makes virtual persons, one per seed, recorded by the protocol at its level, and puts them through the whole chain
/// (EMG, inverse kinematics and dynamics, identification) as `run` does. Compares the results with the truth. Persons
/// run in parallel, with the same numbers for every number of threads. A person whose run fails is listed. When
/// stopped, returns the finished persons.
[[nodiscard]] TwinStudyResult twin_study(const lab::Protocol& protocol, const TwinStudyOptions& options = {});

/// Summarizes per method, case and parameter: each muscle and all together.
[[nodiscard]] std::vector<TwinSummary> summarize(const TwinStudyResult& result);

/// Writes persons.csv (every estimate), summary.csv, predictions.csv, run.json.
void write_twin_study(const TwinStudyResult& result, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace myoid::lab
