#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// A part of a recording.
enum class RecordingPart { markers, channels, emg, plates };
inline constexpr std::string_view kRecordingPartNames[] = {"markers", "channels", "emg", "plates"};
constexpr ChoiceNames choice_names(RecordingPart) { return kRecordingPartNames; }

/// A recording in another format, or an OpenSim file in the newest form.
struct ConvertOptions {
  Call call;
  std::string in;                     ///< A recording, a table, an OpenSim file, or the folder of a finished run.
  std::string out;                    ///< .c3d, .trc, .sto, .mot, .csv, .osim, .xml, or a folder for everything.
  std::optional<RecordingPart> what;  ///< Empty: by the endings of the names.
  std::string up;                     ///< Vertical of the laboratory: x, -y, ...; empty: as the file states.
  std::vector<std::string> turns;     ///< "AXIS:DEGREES", one after another.
  std::string unit;                   ///< Unit of EMG if the file does not state it: V, mV, uV.
  std::vector<std::string> channels;  ///< Only these channels; empty: all.
  std::string analog;                 ///< Channels that join the markers of a .trc in a .c3d.
  std::vector<std::string> bodies;    ///< Bodies on plate 1, 2, ...: writes ExternalLoads, too.
  double least_force_n = 10.0;        ///< Smaller forces count as an unloaded plate.
  std::optional<double> rate_hz;      ///< Rate of an even clock for all data; empty: as recorded.
  std::string subject = "01";         ///< Label of the person in a BIDS derivative.
  body::Compatibility compat =
      body::Compatibility::exact;  ///< opensim: rounds offsets of an OpenSim file to six digits, as OpenSim does.
};
void visit(ConvertOptions& options, study::SettingVisitor& v);

struct ConvertResult {
  std::vector<std::string> files;    ///< Written files.
  int old_version = 0, version = 0;  ///< Of an OpenSim file; 0: the file had none.
  std::vector<Remark> remarks;
};

/// The kind of result of a conversion.
enum class Conversion {
  recording,    ///< A recording or table in another format, or a folder with everything in it.
  derivative,   ///< A BIDS derivative, which is a folder, of the folder of a run.
  opensim_file  ///< A model, set-up or set of OpenSim in the newest form.
};

/// Returns what the input and the endings of both names ask for. Throws InvalidInput if `out` cannot hold it.
[[nodiscard]] Conversion conversion_of(const ConvertOptions& options);

/// Reads and writes, each file whole or not at all. (One function does both, so that channels of a
/// long recording pass from the reader to the writer without all being in memory.) Throws
/// InvalidInput for a format that cannot be written, and for a file that exists or is an input.
ConvertResult convert(const ConvertOptions& options);

}  // namespace myoid::program
