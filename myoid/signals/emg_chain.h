#pragma once

#include <span>
#include <string>
#include <vector>

#include "myoid/signals/emg_envelope.h"

namespace myoid::signals {

/// How the EMG of a study became what a file holds: the steps in their order, for its header, and
/// the sentence for a paper's methods section.
struct EmgChain {
  std::vector<std::string> steps;    ///< A line each, without line breaks, tabs or '='.
  std::vector<std::string> methods;  ///< Sentences in the terms of the CEDE consensus.
};

/// Raw EMG to envelope: the filters with cut-off frequencies, orders and passes, the notches that
/// were used in these trials, whether it was whitened and why, rectification.
[[nodiscard]] EmgChain envelope_chain(std::span<const EmgStages* const> trials,
                                      const EnvelopeOptions& options,
                                      const Whitening& whitening);

/// Adds the amplitude normalization: window, and for each channel resting level, reference and the
/// trial that it was found in.
void add_normalisation(const std::vector<ChannelNormalisation>& normalisation,
                       const NormalisationOptions& options,
                       EmgChain& chain);

/// The lines of a header: a title, the numbered steps and the sentences.
[[nodiscard]] std::vector<std::string> header_lines(const EmgChain& chain);

}  // namespace myoid::signals
