#include "myoid/opensim/projects/trial_files.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/series_file.h"
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

/// A table of a trial with the notes of its reader.
recording::SeriesFile read_table(TrialFile& file) {
  recording::SeriesFile table;
  if (format_of(file.path) == FileFormat::storage) {
    recording::Storage storage = recording::read_storage(file.path);
    if (file.role == TrialRole::motion) file.is_in_degrees = storage.in_degrees;
    table = {std::move(storage.data), std::move(storage.repairs)};
  } else {
    table = recording::read_series(file.path);
  }
  set_clock(file, table.data);
  if (file.role == TrialRole::emg)
    for (const Channel& channel : table.data.channels()) file.channels.push_back(channel.name);
  return table;
}

/// Adds the muscles with a moment arm to a joint.
void add_muscles(const Project& project, const TimeSeries& arms, ProjectDof& dof) {
  constexpr double kLeastArm_m = 1e-6;
  for (Eigen::Index k = 0; k < arms.channel_count(); ++k) {
    const std::string& name = arms.channels()[static_cast<std::size_t>(k)].name;
    if (project.find(name) == nullptr || !((arms.values().col(k).array().abs() > kLeastArm_m).any())) continue;
    if (std::find(dof.muscles.begin(), dof.muscles.end(), name) == dof.muscles.end()) dof.muscles.push_back(name);
  }
}

/// Remarks on EMG below 0, which no envelope is.
template <typename Remark>
void note_negative_emg(const TimeSeries& emg, const std::filesystem::path& path, const Remark& remark) {
  double least = 0.0;
  std::string channel;
  for (Eigen::Index k = 0; k < emg.channel_count(); ++k) {
    for (const double value : emg.values().col(k)) {
      if (!(value < least)) continue;
      least = value;
      channel = emg.channels()[static_cast<std::size_t>(k)].name;
    }
  }
  if (least < 0.0)
    remark(RemarkCode::emg_envelope, Severity::warning,
           fmt::format("{}: the EMG is below 0 (least {:.3g} in '{}'), which no envelope is", path.string(), least,
                       channel));
}

}  // namespace

void read_trial_tables(Project& project) {
  std::set<std::string> open;  // joints whose muscles no other file tells
  for (const ProjectDof& dof : project.dofs)
    if (dof.muscles.empty()) open.insert(dof.name);
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
        const recording::SeriesFile table = read_table(file);
        if (!table.repairs.empty())
          remark(RemarkCode::reading, Severity::warning,
                 fmt::format("{}: {}{}", file.path.string(), table.repairs.front().message,
                             table.repairs.size() > 1 ? fmt::format(", and {} more", table.repairs.size() - 1) : ""));
        if (file.role == TrialRole::emg) note_negative_emg(table.data, file.path, remark);
        if (file.role == TrialRole::moment_arms && open.contains(file.dof))
          for (ProjectDof& dof : project.dofs)
            if (dof.name == file.dof) add_muscles(project, table.data, dof);
      } catch (const InvalidInput& error) {
        remark(RemarkCode::refused, Severity::warning, error.what());
      }
      if (!counts_from_1970 && file.time && file.time->begin_s > kYear_s) {
        counts_from_1970 = true;
        remark(RemarkCode::reading, Severity::note, fmt::format("{}: the time counts from 1970", file.path.string()));
      }
    }
  }
}

}  // namespace myoid::opensim
