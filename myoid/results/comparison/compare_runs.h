#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/ground/core/remark.h"

namespace myoid::results {

/// The answer to whether a number differs between two sessions.
enum class Change {
  differs,      ///< By more than chance explains.
  no_change,    ///< Both recordings determine the number, and no difference shows.
  cannot_tell,  ///< A recording does not determine the number, so equality would mean nothing.
  treatment,    ///< Both runs rest on one recording: a difference is of its treatment, not of the person.
};
[[nodiscard]] std::string_view name(Change change);

inline constexpr double kLevel = 0.05;  ///< Below which a p-value means a difference.

/// A number of one session in the compared reading: given geometry and sensors where both sessions have it.
struct ComparedValue {
  double value = 0.0;
  std::optional<double> low, high;  ///< 95 % interval.
};

/// One number of both sessions.
struct ComparedParameter {
  std::string muscle;  ///< All owners of the number, separated by commas.
  fit::ParameterEstimate first, second;
  ComparedValue of_first, of_second;
  double difference = 0.0;                    ///< Second minus first, in the compared reading.
  std::optional<double> smallest_detectable;  ///< 1.96 standard errors of the difference.
  std::optional<double> p_alone;              ///< Two-sided, of this number by itself.
  std::optional<double> p_value;              ///< p_alone, adjusted (Holm) among `tested` numbers.
  int tested = 0;                             ///< Numbers of one method that are tested together, with this one.
  Change change = Change::cannot_tell;
  /// True for a number that would differ if it were tested alone, but not among the others.
  [[nodiscard]] bool differs_alone_only() const { return change == Change::no_change && *p_alone < kLevel; }
};

/// A trial of both sessions under one name, or of one session.
struct ComparedTrial {
  std::string trial, method;
  std::optional<double> rmse_first_nm, rmse_second_nm;
};

struct RunComparison {
  std::filesystem::path first, second;
  std::string first_date, second_date;  ///< Days on which the results were written, as "2026-03-01" (UTC).
  std::vector<ComparedParameter> parameters;
  std::vector<ComparedTrial> trials;
  std::vector<std::string> failed;  ///< Sessions with a failed gate, in sentences: their numbers are not compared.
  std::vector<std::string> unlike;  ///< Differences of model, person, muscles or estimator.
  /// "Both runs rest on the same recording ...", and the settings in which they differ; empty: on two recordings.
  std::string one_recording;
  std::vector<Remark> remarks;  ///< Numbers that only one session has; `about` names them.
};

/// Returns the methods of the compared numbers, in order of appearance.
[[nodiscard]] std::vector<fit::Method> methods_of(const RunComparison& comparison);

/// Compares two finished runs number by number, of one person on two days or of one recording treated differently: z =
/// (second - first) / sqrt(se1^2 + se2^2) against the normal distribution, with p-values adjusted for their number by
/// Holm's method, the greatest voluntary torques by themselves: they have 3 of the 5 % of false alarms. If both runs
/// have a second reading, numbers and standard errors are those of the reading given geometry and sensors, because
/// errors of moment arms, tendons and the torque's scale are the same in both sessions. A parameter with a verdict
/// prior_dominated, not_identifiable or non_physical is not compared: both may agree on the prior alone; nor is a
/// number of method `paper`, whose forces nobody measured, nor any number of a run with a failed gate, nor a strength
/// at full effort with one at the largest EMG, nor a number of all muscles of a joint where the muscles differ. The
/// sessions count as independent; a shared prior makes the test cautious. Numbers of one recording are not tested: they
/// share its errors, and no difference is a change of the person. Throws ReadError if a folder holds no parameters.json
/// of a run.
[[nodiscard]] RunComparison compare_runs(const std::filesystem::path& first, const std::filesystem::path& second);

}  // namespace myoid::results
