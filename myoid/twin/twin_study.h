#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/provenance.h"
#include "myoid/intervals/result.h"
#include "myoid/virtual_person/protocol.h"
#include "myoid/virtual_person/truth_settings.h"

namespace myoid::twin {

struct TwinStudyOptions {
  int subjects = 200;
  std::uint64_t first_seed = 1;  ///< Subject k has this plus k.
  std::vector<identification::Method> methods = {identification::Method::torque};
  identification::EstimatorKind estimator = identification::EstimatorKind::least_squares;
  Progress progress;
};

/// One estimate of one virtual person beside its truth.
struct TwinRow {
  std::uint64_t seed = 0;
  double truth = 0.0;
  identification::ParameterEstimate estimate;

  /// Relative to the truth; of the EMG delay in units of 100 ms, so that 0.1 is 10 ms.
  [[nodiscard]] double error() const;
  [[nodiscard]] bool covered() const;  ///< The 95 % interval holds the truth.
};

/// Prediction of one trial that was held back.
struct TwinPrediction {
  std::uint64_t seed = 0;
  std::string trial;
  identification::Score law;     ///< Of the muscles' law with the parameters that are reported.
  identification::Score smooth;  ///< The same, the prediction smoothed (smooth_prediction.h).
  identification::Score band;    ///< The same, both torques below the fit's own cut-off.
};

struct TwinFailure {
  std::uint64_t seed = 0;
  std::string message;
};

struct TwinStudyResult {
  std::string protocol;
  std::string level;
  std::vector<WorldSetting> world;  ///< Keys of [truth] beside the level's defaults.
  std::vector<TwinRow> rows;        ///< By seed, then as the estimators list them.
  std::vector<TwinPrediction> predictions;
  std::vector<TwinFailure> failures;
  int subjects = 0;  ///< Persons asked for ...
  int finished = 0;  ///< ... and finished.
  std::uint64_t first_seed = 1;
  bool interrupted = false;  ///< Stopped before all were finished.
};

/// Errors of one parameter over the persons: shares are of all rows, `truths` apart.
struct TwinSummary {
  std::string method, fit_case;
  std::string muscle;  ///< "all": over the muscles.
  std::string parameter;
  int count = 0;
  double bias = 0.0;          ///< Median signed error.
  double median_error = 0.0;  ///< Median of its size.
  double mad = 0.0;           ///< Median absolute deviation from it.
  double rmse = 0.0;
  double within_5 = 0.0, within_10 = 0.0, within_15 = 0.0, within_20 = 0.0;
  double prior_within_10 = 0.0;  ///< Of the values that the search began with.
  int with_interval = 0;
  double coverage = 0.0;    ///< Of the 95 % intervals there are.
  double half_width = 0.0;  ///< Median, in the unit of the error.
  double shrinkage = 0.0;   ///< Median.
  int verdicts[5] = {};     ///< As identification::Verdict.
  /// Confusion: the verdict `identified` against an error below 10 %.
  int identified_good = 0, identified_bad = 0, other_good = 0, other_bad = 0;
  int identified_within_15 = 0;  ///< Of the identified ones.
  int outside_physical = 0;      ///< Reported beyond the physical bounds and not `non_physical`.
};

/// Virtual persons, one per seed, recorded by the protocol at its level, put through the whole
/// chain (EMG, inverse kinematics and dynamics, identification) as `run` would, and compared with
/// their truth. Persons in parallel; the same numbers for every number of threads. A person whose
/// run fails is listed, not left out in silence. When stopped, those who are finished are
/// returned.
[[nodiscard]] TwinStudyResult twin_study(const twin::Protocol& protocol,
                                         const TwinStudyOptions& options = {});

/// Per method, case, parameter: each muscle and all together.
[[nodiscard]] std::vector<TwinSummary> summarize(const TwinStudyResult& result);

/// persons.csv (every estimate), summary.csv, predictions.csv, run.json.
void write_twin_study(const TwinStudyResult& result,
                      const Provenance& provenance,
                      const std::filesystem::path& folder);

}  // namespace myoid::twin
