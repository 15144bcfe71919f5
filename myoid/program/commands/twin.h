#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/virtual_person/demo_protocol.h"
#include "myoid/program/commands/call.h"

namespace myoid::program {

/// Names of the results beside the folders of persons and of their truth.
inline const std::vector<std::string_view> kTwinFiles{"study.toml", "truth.csv", "model.osim", "persons.csv"};

/// Options of virtual recordings with known parameters. The call's seed determines the person.
struct TwinOptions {
  Call call;
  std::string model = "arm4";      ///< Model for the recording: arm4, or arm7 at level L2.
  std::string protocol;            ///< Protocol of the recording (.toml), or lab::kDemoProtocol.
  std::string level;               ///< L0, L1 or L2; empty: the protocol's.
  std::vector<std::string> truth;  ///< Keys of [truth] beyond the protocol's: "KEY=VALUE".
  std::string format = "trc";      ///< Format of markers and EMG: trc (.trc and .sto), or c3d.
};

struct TwinResult {
  lab::VirtualRecording recording;
  std::string format;
};

/// Makes one person's recording. Throws InvalidInput for an arm7 at another level than L2.
[[nodiscard]] TwinResult twin(const TwinOptions& options);

/// Writes the folder that `run` reads; the folder may hold files already.
void write_twin(const TwinResult& result, const std::filesystem::path& folder);

/// Options of many persons, whose seeds count up from the call's.
struct TwinPersonsOptions {
  TwinOptions twin;
  std::size_t persons = 1;
  bool truth_only = false;  ///< Makes only the table, no recordings.
};

struct TwinPersonsResult {
  std::filesystem::path table;                 ///< persons.csv: a person's truth in each row.
  std::vector<std::filesystem::path> studies;  ///< study.toml of each; empty with truth_only.
};

/// Makes the persons, writes each into a folder of its own and all into the table. At most one
/// recording per thread is in memory. The folder may hold files already.
TwinPersonsResult write_twin_persons(const TwinPersonsOptions& options, const std::filesystem::path& folder);

/// Returns the keys of a protocol's [truth], for a terminal.
[[nodiscard]] std::string truth_help(std::size_t width);

/// Returns the level L0, L1 or L2; empty for an empty name. Throws InvalidInput for other names.
[[nodiscard]] std::optional<lab::Level> level_named(const std::string& name);

}  // namespace myoid::program
