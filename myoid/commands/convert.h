#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/commands/call.h"

namespace myoid::commands {

/// A recording in another format.
struct ConvertOptions {
  Call call;
  std::string in;    ///< A recording or table, or the folder of a finished run.
  std::string out;   ///< .c3d, .trc, .sto, .mot, .csv, or a folder for everything.
  std::string what;  ///< markers, channels, emg or plates; empty: by the endings of the names.
  std::string up;    ///< Vertical of the laboratory: x, -y, ...; empty: as the file says.
  std::vector<std::string> turns;     ///< "AXIS:DEGREES", one after another.
  std::string unit;                   ///< Of EMG where the file does not say: V, mV, uV.
  std::vector<std::string> channels;  ///< Only these; none: all.
  std::string analog;                 ///< Channels to go with the markers of a .trc into a .c3d.
  std::vector<std::string> bodies;    ///< That stand on plate 1, 2, ...: ExternalLoads too.
  double least_force_n = 10.0;        ///< Below it a plate counts as unloaded.
  double rate_hz = 0.0;               ///< Everything on an even clock of this rate; 0: as recorded.
  std::string subject = "01";         ///< Label of the person in a BIDS derivative.
  bool overwrite = false;             ///< Files that exist are replaced.
};

struct ConvertResult {
  std::vector<std::string> files;  ///< That were written.
  std::vector<Remark> remarks;
};

/// Reads and writes, each file whole or not at all. (One function does both: channels of a long
/// recording pass from the reader to the writer without being held at once.) Throws InvalidInput
/// for a format that is not written and for a file that exists or is an input.
ConvertResult convert(const ConvertOptions& options);

/// True if the input is the folder of a run, whose results become a BIDS derivative in the folder
/// `out`. Throws InvalidInput where `out` names a recording.
[[nodiscard]] bool makes_derivative(const ConvertOptions& options);

}  // namespace myoid::commands
