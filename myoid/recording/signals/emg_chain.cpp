#include "myoid/recording/signals/emg_chain.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid::recording {
namespace {

constexpr const char* kTwoPasses =
    "Butterworth, 2nd order in each of two passes, forwards and backwards (4th order, zero lag)";

/// Returns "BIC at 50, 150 Hz; TRI at 50 Hz" for all trials together.
std::string lines_of(std::span<const EmgStages* const> trials) {
  std::map<std::string, std::set<double>> lines;
  for (const EmgStages* trial : trials) {
    for (const Notch& notch : trial->notches) lines[notch.channel].insert(notch.lines_hz.begin(), notch.lines_hz.end());
  }
  std::string text;
  for (const auto& [channel, hz] : lines)
    text += fmt::format("{}{} at {:g} Hz", text.empty() ? "" : "; ", channel, fmt::join(hz, ", "));
  return text;
}

/// Adds the replacement of spikes, of all trials together, if there were any.
void add_spikes(std::span<const EmgStages* const> trials, EmgChain& chain) {
  std::map<std::string, std::size_t> counts;
  for (const EmgStages* trial : trials) {
    for (const MendedSpikes& spikes : trial->spikes) counts[spikes.channel] += spikes.count;
  }
  if (counts.empty()) return;
  std::string text;
  for (const auto& [channel, count] : counts)
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", count, channel);
  chain.steps.push_back(fmt::format("spikes narrower than EMG replaced by straight lines: {}", text));
  chain.methods.push_back(fmt::format("Isolated spikes were replaced by linear interpolation ({}).", text));
}

/// Adds the removal of the heart, of all trials together, if it was asked for and found.
void add_ecg(std::span<const EmgStages* const> trials, EmgChain& chain) {
  std::map<std::string, std::size_t> beats;
  for (const EmgStages* trial : trials) {
    for (const RemovedEcg& ecg : trial->ecg) beats[ecg.channel] += ecg.beats;
  }
  if (beats.empty()) return;
  std::string text;
  for (const auto& [channel, count] : beats)
    text += fmt::format("{}{} beats in {}", text.empty() ? "" : ", ", count, channel);
  chain.steps.push_back(fmt::format("the heart subtracted, each beat by the mean of up to 30 around it: {}", text));
  chain.methods.push_back(fmt::format("Cardiac artifacts were removed by template subtraction ({}).", text));
}

void add_highpass(std::span<const EmgStages* const> trials, const EnvelopeOptions& options, EmgChain& chain) {
  chain.steps.emplace_back("mean of the trial removed");
  if (options.as_published) {
    chain.steps.emplace_back("no high-pass filter, no notch filter, as in the source paper");
    chain.methods.emplace_back("The mean was removed from the raw EMG.");
    return;
  }
  chain.steps.push_back(
      fmt::format("high-pass filter {:g} Hz, -3 dB of both passes together; {}", options.highpass_hz, kTwoPasses));
  const std::string lines = lines_of(trials);
  chain.steps.push_back(
      !options.notch ? "no notch filter: switched off"
      : lines.empty()
          ? "no notch filter: mains hum below a tenth of every channel's power"
          : fmt::format("notch filters against mains hum, 2nd order, 4 Hz wide, forwards and backwards: {}", lines));
  chain.methods.push_back(fmt::format(
      "Raw EMG was high-pass filtered (zero-lag fourth-order Butterworth filter, cut-off frequency {:g} Hz){}.",
      options.highpass_hz,
      options.notch && !lines.empty()
          ? fmt::format(" and notch filtered at the mains frequency and its harmonics ({})", lines)
          : ""));
}

void add_rectification(const EnvelopeOptions& options, const Whitening& whitening, EmgChain& chain) {
  chain.steps.push_back(whitening.applied
                            ? fmt::format("whitening of all channels and trials: {}; a symmetric filter of each "
                                          "channel, +-16 ms, by the spectra of muscle and noise in the recording",
                                          whitening.reason)
                            : fmt::format("no whitening of any channel: {}", whitening.reason));
  if (options.rectify) chain.steps.emplace_back("full-wave rectification");
  chain.steps.push_back(fmt::format("low-pass filter {:g} Hz, {}; {}; negative values set to 0", options.lowpass_hz,
                                    options.as_published ? "-3 dB of one pass" : "-3 dB of both passes together",
                                    kTwoPasses));
  chain.methods.push_back(
      fmt::format("The EMG {}{}low-pass filtered (zero-lag fourth-order Butterworth filter, cut-off frequency {:g} "
                  "Hz{}) to obtain the EMG envelope.",
                  whitening.applied ? "of all muscles was whitened (zero-lag filter of each channel, designed from the "
                                      "spectra of EMG and baseline noise), "
                                    : "was ",
                  options.rectify ? "full-wave rectified and " : "", options.lowpass_hz,
                  options.as_published ? " of a single pass" : ""));
}

}  // namespace

EmgChain envelope_chain(std::span<const EmgStages* const> trials,
                        const EnvelopeOptions& options,
                        const Whitening& whitening) {
  EmgChain chain;
  add_spikes(trials, chain);
  add_ecg(trials, chain);
  add_highpass(trials, options, chain);
  add_rectification(options, whitening, chain);
  return chain;
}

void add_normalisation(const std::vector<ChannelNormalisation>& normalisation,
                       const NormalisationOptions& options,
                       EmgChain& chain) {
  chain.steps.push_back(
      fmt::format("amplitude normalization over all trials{} and maximal contractions together: root of (envelope "
                  "squared less rest squared) over the reference; rest is the mean of the quiet seconds, the reference "
                  "that of the greatest moving means of {:g} s that differ by chance only, less rest likewise",
                  options.held_back ? " but those for validation" : "", options.window_s));
  const auto level = [](const ChannelNormalisation& n, double value) {
    const bool volts = n.unit != Unit::dimensionless;
    return fmt::format("{:.6g}{}", value, volts ? fmt::format(" {}", symbol(n.unit)) : "");
  };
  for (const ChannelNormalisation& n : normalisation) {
    chain.steps.push_back(
        fmt::format("channel {}: reference {}, from {} at {:.6g} s ({}); rest {}{}", n.channel, level(n, n.reference_v),
                    n.source_trial, n.source_time_s,
                    n.from_mvc ? "maximal contraction" : "no maximal contraction: largest effort recorded",
                    level(n, n.resting_level_v), n.rests ? "" : ": the muscle does not rest in any trial"));
  }
  const bool mvc =
      std::all_of(normalisation.begin(), normalisation.end(), [](const ChannelNormalisation& n) { return n.from_mvc; });
  const bool task = std::none_of(normalisation.begin(), normalisation.end(),
                                 [](const ChannelNormalisation& n) { return n.from_mvc; });
  chain.methods.push_back(fmt::format(
      "The baseline noise was subtracted in quadrature, and the EMG amplitude of each muscle was normalized to the "
      "average of its greatest {:g} s moving means{} (those that differ by no more than the noise of such a mean) "
      "recorded in {}{}.",
      options.window_s,
      mvc    ? " during maximal voluntary contractions (MVC)"
      : task ? ""
             : " during maximal voluntary contractions (MVC) and tasks",
      task ? "the tasks, because no maximal voluntary contraction (MVC) exceeded it" : "all trials of the session",
      options.held_back ? " (trials for validation took no part)" : ""));
}

std::vector<std::string> header_lines(const EmgChain& chain) {
  std::vector<std::string> lines;
  if (chain.steps.empty()) return lines;
  lines.emplace_back("How this EMG was processed, in this order:");
  for (std::size_t i = 0; i < chain.steps.size(); ++i) lines.push_back(fmt::format("  {}. {}", i + 1, chain.steps[i]));
  lines.emplace_back("For a methods section:");
  for (const std::string& sentence : chain.methods) lines.push_back("  " + sentence);
  // No line may look like "key=value" to a reader of the header, or like a column to a reader of tables.
  for (std::string& line : lines) {
    std::replace(line.begin(), line.end(), '=', ':');
    std::replace(line.begin(), line.end(), '\t', ' ');
    std::replace(line.begin(), line.end(), '\n', ' ');
  }
  return lines;
}

}  // namespace myoid::recording
