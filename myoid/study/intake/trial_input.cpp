#include "myoid/study/intake/trial_input.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/recording/recording.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {

void warn(TrialInput& input, RemarkCode code, std::string text) {
  input.remarks.push_back({.code = code, .says = std::move(text)});
}

void add_notes(const std::vector<std::string>& texts, std::vector<Remark>& remarks) {
  for (const std::string& text : texts)
    remarks.push_back({.code = RemarkCode::reading, .severity = Severity::note, .says = text});
}

Remark remark_of(const Repair& repair, std::string says) {
  Remark remark = recording::remark_of(repair, std::move(says));
  if (repair.apart_s < kLimits.clocks.apart_s) return remark;
  remark.code = RemarkCode::clock_drift;
  remark.severity = Severity::warning;
  remark.value = repair.apart_s;
  remark.says += fmt::format("; at the end the two are {:.2g} s apart", repair.apart_s);
  remark.remedy = "correct the rate in the header or the times, whichever is wrong";
  return remark;
}

void add_repairs(const std::filesystem::path& path, const std::vector<Repair>& repairs, std::vector<Remark>& remarks) {
  for (const Repair& repair : repairs)
    remarks.push_back(remark_of(repair, recording::to_string(path.filename(), repair)));
}

std::string few_samples(const TrialSpec& trial, const TimeSeries& series, int needed) {
  const auto limit = [](const std::optional<double>& time_s, std::string_view otherwise) {
    return time_s ? fmt::format("{} s", *time_s) : std::string(otherwise);
  };
  return fmt::format("{} samples from {} to {}; at least {} are needed", series.sample_count(),
                     limit(trial.start_s, "its begin"), limit(trial.end_s, "its end"), needed);
}

}  // namespace myoid::study
