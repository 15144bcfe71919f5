#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/twin/write_recording.h"
#include "myoid/lab/virtual_person/demo_protocol.h"
#include "myoid/program/steps/call.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Names of the results beside the folders of persons and of their truth.
inline const std::vector<std::string_view> kTwinFiles{"study.toml", "truth.csv", "model.osim", "persons.csv"};

/// Options of virtual recordings with known parameters. The call's seed determines the person.
struct TwinOptions {
  Call call;
  bool seven_heads = false;            ///< The model that goes with the recording is arm7, at level L2 only; else arm4.
  std::string protocol;                ///< Protocol of the recording (.toml), or lab::kDemoProtocol.
  std::optional<lab::Level> level;     ///< Empty: the protocol's.
  std::vector<std::string> truth;      ///< Keys of [truth] beyond the protocol's: "KEY=VALUE".
  std::optional<std::size_t> persons;  ///< For `write_twin_persons`: their seeds count up from the call's.
  lab::RecordingFormat format = lab::RecordingFormat::text;
  bool truth_only = false;  ///< `write_twin_persons` makes only the table, no recordings.
  std::string out;          ///< Folder of `write_twin`.
};
void visit(TwinOptions& options, study::SettingVisitor& v);
void visit_protocol(std::string& protocol, study::SettingVisitor& v);
void visit_truth(std::vector<std::string>& truth, study::SettingVisitor& v);

struct TwinResult {
  lab::VirtualRecording recording;
  lab::RecordingFormat format;
};

/// Makes one person's recording. Throws InvalidInput for an arm7 at another level than L2, and for `truth_only`.
[[nodiscard]] TwinResult twin(const TwinOptions& options);

/// Writes the folder that `run` reads; the folder may hold files already.
void write_twin(const TwinResult& result, const std::filesystem::path& folder);

struct TwinPersonsResult {
  std::filesystem::path table;                 ///< persons.csv: a person's truth in each row.
  std::vector<std::filesystem::path> studies;  ///< study.toml of each; empty with truth_only.
};

/// Makes the persons, writes each into a folder of its own and all into the table. At most one
/// recording per thread is in memory. The folder may hold files already.
TwinPersonsResult write_twin_persons(const TwinOptions& options, const std::filesystem::path& folder);

/// Returns the keys of a protocol's [truth], for a terminal.
[[nodiscard]] std::string truth_help(std::size_t width);

}  // namespace myoid::program
