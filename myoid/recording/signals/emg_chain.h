#pragma once

#include <span>
#include <string>
#include <vector>

#include "myoid/recording/signals/emg_envelope.h"

namespace myoid::recording {

/// The processing of a study's EMG: the steps in their order, for a file's header, and the
/// sentences for a paper's methods section.
struct EmgChain {
  std::vector<std::string> steps;    ///< One line each, without line breaks, tabs or '='.
  std::vector<std::string> methods;  ///< Sentences in the terms of the CEDE consensus.
};

/// Describes the steps from raw EMG to envelope: the filters with cut-off frequencies, orders and
/// passes, the notches in these trials, whitening and its reason, rectification.
[[nodiscard]] EmgChain envelope_chain(std::span<const EmgStages* const> trials,
                                      const EnvelopeOptions& options,
                                      const Whitening& whitening);

/// Adds the amplitude normalization: the window and, for each channel, resting level, reference and
/// the trial of the reference.
void add_normalisation(const std::vector<ChannelNormalisation>& normalisation,
                       const NormalisationOptions& options,
                       EmgChain& chain);

/// Returns the lines of a header: a title, the numbered steps and the sentences.
[[nodiscard]] std::vector<std::string> header_lines(const EmgChain& chain);

}  // namespace myoid::recording
