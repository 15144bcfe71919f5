#include "myoid/intake/trial_input.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/recording/recording.h"

namespace myoid {

void add_repairs(const std::filesystem::path& path,
                 const std::vector<recording::Repair>& repairs,
                 std::vector<std::string>& notes) {
  for (const recording::Repair& repair : repairs)
    notes.push_back(recording::to_string(path.filename(), repair));
}

void warn(TrialInput& input, std::string text) {
  input.notes.push_back(text);
  input.warnings.push_back(std::move(text));
}

std::string few_samples(const TrialSpec& trial, const TimeSeries& series) {
  const auto limit = [](const std::optional<double>& time_s, std::string_view otherwise) {
    return time_s ? fmt::format("{} s", *time_s) : std::string(otherwise);
  };
  return fmt::format("{} samples from {} to {}; at least 10 are needed", series.sample_count(),
                     limit(trial.start_s, "its begin"), limit(trial.end_s, "its end"));
}

}  // namespace myoid
