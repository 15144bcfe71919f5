#include "myoid/opensim/projects/trial_files.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/tables/series_file.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim {
namespace {

/// A trial that begins a year after 0 has the time of day in its clock.
constexpr double kYear_s = 365.0 * 86400.0;

void set_clock(TrialFile& file, const TimeSeries& data) {
  if (data.empty()) return;
  const Eigen::Index last = data.sample_count() - 1;
  file.time = Stretch{data.time_s()(0), data.time_s()(last)};
  if (last > 0) file.rate_hz = static_cast<double>(last) / (file.time->end_s - file.time->begin_s);
}

void read_table(TrialFile& file) {
  if (format_of(file.path) != FileFormat::storage) return set_clock(file, recording::read_series(file.path).data);
  const recording::Storage storage = recording::read_storage(file.path);
  if (file.role == TrialRole::motion) file.is_in_degrees = storage.in_degrees;
  set_clock(file, storage.data);
}

}  // namespace

void read_trial_tables(Project& project) {
  for (ProjectTrial& trial : project.trials) {
    bool counts_from_1970 = false;
    for (TrialFile& file : trial.files) {
      const auto remark = [&](RemarkCode code, Severity severity, std::string says) {
        project.remarks.push_back({.code = code,
                                   .severity = severity,
                                   .where = trial.name,
                                   .about = std::string(choice_name(file.role)),
                                   .says = std::move(says)});
      };
      if (!file.exists) {
        remark(RemarkCode::refused, Severity::warning, fmt::format("there is no file {}", file.path.string()));
        continue;
      }
      if (file.role == TrialRole::loads) continue;
      try {
        read_table(file);
      } catch (const InvalidInput& error) {
        remark(RemarkCode::refused, Severity::warning, error.what());
      }
      if (!counts_from_1970 && file.time && file.time->begin_s > kYear_s) {
        counts_from_1970 = true;
        remark(RemarkCode::reading, Severity::note, "the time counts from 1970");
      }
    }
  }
}

}  // namespace myoid::opensim
