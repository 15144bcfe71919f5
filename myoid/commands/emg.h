#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/core/time_series.h"
#include "myoid/signals/emg_chain.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/emg_levels.h"

namespace myoid::commands {

/// Raw EMG to activation.
struct EmgOptions {
  Call call;
  std::vector<std::string> in;        ///< Each is normalized by the largest effort of all files.
  std::vector<std::string> mvc;       ///< Maximal contractions to normalize by.
  std::vector<std::string> channels;  ///< Only these; none: all of a file's first clock.
  std::string unit;                   ///< V, mV or uV where a file does not say.
  signals::EnvelopeOptions chain;
  double window_s = 0.5;        ///< Of the mean that counts as 1.
  bool keep_envelopes = false;  ///< The result holds the envelopes too.
};

struct EmgResult {
  std::vector<TimeSeries> activations;  ///< 0..1, of each input.
  std::vector<TimeSeries> envelopes;    ///< [V]; where they are kept.
  signals::Whitening whitening;
  std::vector<signals::ChannelNormalisation> normalisation;
  signals::EmgChain chain;  ///< From the raw EMG to the activation.
  std::vector<std::string> activation_header, envelope_header;  ///< The chain, for the files.
  std::vector<Remark> remarks;
};

/// Throws ReadError for files without a channel that is raw EMG, InvalidInput where the files have
/// no channel in common.
[[nodiscard]] EmgResult emg(const EmgOptions& options);

/// The files for results of these inputs: of one input `to` itself, of several a file of each
/// input's name in the folder `to`; none where `to` is empty. Throws InvalidInput, naming the
/// option, where two would be one file or `to` is no folder.
[[nodiscard]] std::vector<std::string> emg_files(const std::vector<std::string>& inputs,
                                                 const std::string& to,
                                                 const char* option);

/// Throws InvalidInput, as `check_output`, for files that exist or are inputs, and for an
/// activation and an envelope of one name.
void check_emg_files(const EmgOptions& options,
                     const std::vector<std::string>& activations,
                     const std::vector<std::string>& envelopes,
                     bool overwrite);

/// Writes an activation of each input and, where files are given for them, the envelopes (.sto,
/// .mot or .csv).
void write_emg(const EmgResult& result,
               const std::vector<std::string>& activations,
               const std::vector<std::string>& envelopes);

}  // namespace myoid::commands
