#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/program/steps/call.h"
#include "myoid/recording/signals/emg_chain.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/recording/signals/emg_measures.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of the conversion of raw EMG to activation.
struct EmgOptions {
  Call call;
  std::vector<std::string> in;        ///< Each is normalized by the largest effort of all files.
  std::vector<std::string> mvc;       ///< Maximal contractions to normalize by.
  std::vector<std::string> channels;  ///< Only these channels; empty: all of a file's first clock.
  std::string unit;                   ///< V, mV or uV if a file does not state it.
  recording::EnvelopeOptions chain;
  double window_s = 0.5;                   ///< Length of the mean that counts as 1.
  bool keep_envelopes = false;             ///< Keeps the envelopes in the result, too.
  std::optional<double> measure_window_s;  ///< Length of the windows of the measures; empty: bursts alone.
  std::string out, envelope;               ///< For `write_emg`: a file; of several inputs a folder. Empty: not written.
  std::string measures;                    ///< For `write_emg`: table of the measures; empty: not written.
};
void visit(EmgOptions& options, study::SettingVisitor& v);

/// Onsets, root mean square and median frequency of one channel of one file.
struct EmgMeasures {
  std::string file, channel;
  std::vector<recording::EmgWindow> bursts;   ///< From each onset to its end.
  std::vector<recording::EmgWindow> windows;  ///< Successive windows of `measure_window_s`.
};

struct EmgResult {
  std::vector<TimeSeries> activations;  ///< 0..1, one per input.
  std::vector<TimeSeries> envelopes;    ///< [V], one per input if kept.
  recording::Whitening whitening;
  std::vector<recording::ChannelNormalisation> normalisation;
  std::vector<EmgMeasures> measures;                            ///< Of the filtered EMG, by file and channel.
  recording::EmgChain chain;                                    ///< From the raw EMG to the activation.
  std::vector<std::string> activation_header, envelope_header;  ///< The chain, for files.
  std::vector<Remark> remarks;
};

/// Converts raw EMG. Throws ReadError for a file without a raw EMG channel, and InvalidInput if the
/// files have no channel in common.
[[nodiscard]] EmgResult emg(const EmgOptions& options);

/// The files of the results.
struct EmgFiles {
  std::vector<std::string> activations, envelopes;  ///< One per input, or none.
  std::string measures;                             ///< Empty: none.
};

/// Returns the files that the options name; for several inputs a file of each input's name in the folder. Throws
/// InvalidInput if two results would share a file or the folder is none, and, as `check_output`, for a file that exists
/// or is an input.
[[nodiscard]] EmgFiles emg_files(const EmgOptions& options);

/// Writes activations and envelopes (.sto, .mot or .csv), and the measures as .csv:
/// `file,channel,kind,begin_s,end_s,rms_v,median_frequency_hz`; kind is burst or window.
void write_emg(const EmgResult& result, const EmgFiles& files);

}  // namespace myoid::program
