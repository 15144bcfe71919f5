#include "myoid/lab/twin/write_recording.h"

#include <system_error>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/c3d/make_c3d.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/recording/trc_writer.h"

namespace myoid::lab {
namespace {

namespace fs = std::filesystem;

/// Makes the folder, or accepts an empty one, or with `overwrite` a used one.
void prepare_directory(const fs::path& directory, bool overwrite) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory)) {
    throw InvalidInput(fmt::format("{}: cannot be made a folder ({}); choose another one", directory.string(),
                                   error ? error.message() : "a file of that name exists"));
  }
  if (!overwrite && !fs::is_empty(directory)) {
    throw InvalidInput(
        fmt::format("{}: the folder is not empty; choose another one, or --overwrite", directory.string()));
  }
}

void write_trial(const VirtualRecording& recording,
                 const VirtualTrial& trial,
                 const std::string& stem,
                 const fs::path& directory,
                 RecordingFormat format) {
  const std::string origin =
      fmt::format("virtual recording: protocol {}, seed {}", recording.protocol.name, recording.seed);
  const auto write = [&](const fs::path& file, const TimeSeries& series, const std::string& what) {
    recording::write_storage(directory / file, series,
                             {.title = what + " " + trial.protocol.name, .comments = {origin}});
  };
  if (format == RecordingFormat::c3d) {
    recording::write_c3d(directory / (stem + ".c3d"), recording::make_c3d(trial.markers, trial.emg));
  } else {
    recording::write_trc(directory / (stem + ".trc"), trial.markers);
    write(stem + "_emg.sto", trial.emg, recording.protocol.level == Level::noise_free ? "activation" : "raw EMG [V]");
  }
  if (trial.external_torque) write(stem + "_torque.sto", *trial.external_torque, "torque");
  if (trial.fascicles) write(stem + "_fascicles.sto", *trial.fascicles, "fascicle lengths [m]");

  const fs::path truth = "truth";
  write(truth / (stem + "_motion.sto"), trial.truth.motion, "true motion");
  write(truth / (stem + "_torque.sto"), trial.truth.torque, "true torque");
  write(truth / (stem + "_activation.sto"), trial.truth.activation, "true activation");
  write(truth / (stem + "_force.sto"), trial.truth.force, "true force");
  write(truth / (stem + "_state.sto"), trial.truth.state, "cold and fatigue");
  if (trial.truth.heads) write(truth / (stem + "_heads.sto"), *trial.truth.heads, "true heads");
}

}  // namespace

NameIds file_stems(const VirtualRecording& recording) {
  std::vector<std::string> names;
  for (const VirtualTrial& trial : recording.trials) names.push_back(trial.protocol.name);
  return NameIds(names);
}

void write_virtual_recording(const VirtualRecording& recording,
                             const fs::path& directory,
                             const WriteOptions& options) {
  prepare_directory(directory, options.overwrite);
  write_file(directory / "model.osim", recording.model_osim);
  const NameIds stems = file_stems(recording);
  for (const VirtualTrial& trial : recording.trials)
    write_trial(recording, trial, stems.of(trial.protocol.name), directory, options.format);
  write_file(directory / "truth" / "person.csv", person_csv(recording));
  write_file(directory / "truth.csv", truth_csv(recording));
  write_file(directory / "study.toml", study_toml(recording, options.format));
}

}  // namespace myoid::lab
