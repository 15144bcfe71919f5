#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/intervals/result.h"

namespace myoid::identification {

/// A fact beside the fit that caps verdicts: a number that rests on it is at most this good, however narrow its
/// interval is.
struct VerdictCap {
  std::string reason;                        ///< A sentence.
  std::vector<std::string> owners = {};      ///< Muscles and EMG channels whose numbers rest on it; empty: all.
  std::vector<std::string> parameters = {};  ///< Their parameters that rest on it; empty: all.
  std::vector<std::string> methods = {};     ///< Empty: all.
  Verdict at_most = Verdict::weak;
};

/// Reason of the cap of all numbers by exchanged electrodes (methods/exchanged_electrodes.h).
inline constexpr std::string_view kExchangedCap = "Two electrodes seem to be exchanged: mend that first.";

/// Gives the estimates that the caps name the verdict of their first cap and its reason, if their own is better. The
/// same for every method.
void apply(const std::vector<VerdictCap>& caps, IdentificationResult& result);

}  // namespace myoid::identification
