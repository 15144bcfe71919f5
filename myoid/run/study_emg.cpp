#include "myoid/run/study_emg.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid::run {
namespace {

/// Returns the lag of a method's muscles behind their EMG: "delay 43 ms".
std::string delays(const fit::IdentificationResult& method) {
  std::vector<std::string> found;
  for (const fit::ParameterEstimate& e : method.estimates) {
    if (e.parameter == "emg_delay") found.push_back(fmt::format("{} {:.1f} ms", e.muscle, 1e3 * e.estimate));
  }
  return found.empty() ? std::string("held by the study") : fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace

recording::EmgChain emg_chain(const StudyResult& result, const fit::IdentificationResult* method) {
  const study::EmgSpec& emg = result.source.study.emg;
  recording::EmgChain chain;
  std::vector<const recording::EmgStages*> trials;
  bool any = false;
  for (const TrialResult& trial : result.trials) {
    any = any || !trial.emg.activation.empty();
    if (trial.emg.stages) trials.push_back(&*trial.emg.stages);
  }
  if (!any) return chain;
  if (emg.kind == study::EmgKind::raw) {
    chain = recording::envelope_chain(trials, emg.chain, result.emg.whitening);
  } else {
    const char* const kind = emg.kind == study::EmgKind::envelope ? "EMG envelopes" : "activations";
    chain.steps.push_back(
        fmt::format("{} as the files hold them; how they were made is not known to this program", kind));
    chain.methods.push_back(fmt::format("The input was {} that were processed beforehand.", kind));
  }
  if (emg.kind != study::EmgKind::activation) {
    const auto held_back =
        std::ranges::count(result.trials, study::Use::validation, [](const auto& t) { return t.spec.use; });
    recording::add_normalisation(
        result.emg.normalisation,
        {.window_s = emg.normalise_window_s, .held_back = held_back > 0 && held_back < std::ssize(result.trials)},
        chain);
    chain.steps.push_back(
        fmt::format("resampled to {:g} Hz where it has twice that rate or more", study::kActivationRate_hz));
  }
  chain.steps.push_back(method == nullptr ? std::string("activation dynamics: none in this file")
                                          : fmt::format("activation dynamics: {}, {} (method {})",
                                                        fit::name(method->lag), delays(*method), name(method->method)));
  return chain;
}

}  // namespace myoid::run
