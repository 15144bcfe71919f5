#include "myoid/run/study_emg.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/intake/trial_emg.h"

namespace myoid {
namespace {

/// Returns the lag of a method's muscles behind their EMG: "delay 43 ms".
std::string delays(const identification::IdentificationResult& method) {
  std::vector<std::string> found;
  for (const identification::ParameterEstimate& e : method.estimates) {
    if (e.parameter == "emg_delay") found.push_back(fmt::format("{} {:.1f} ms", e.muscle, 1e3 * e.estimate));
  }
  return found.empty() ? std::string("held by the study") : fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace

signals::EmgChain emg_chain(const StudyResult& result, const identification::IdentificationResult* method) {
  const EmgSpec& emg = result.source.study.emg;
  signals::EmgChain chain;
  std::vector<const signals::EmgStages*> trials;
  bool any = false;
  for (const TrialResult& trial : result.trials) {
    any = any || !trial.emg.activation.empty();
    if (trial.emg.stages) trials.push_back(&*trial.emg.stages);
  }
  if (!any) return chain;
  if (emg.kind == EmgKind::raw) {
    chain = signals::envelope_chain(trials, envelope_options(result.source.study), result.emg.whitening);
  } else {
    const char* const kind = emg.kind == EmgKind::envelope ? "EMG envelopes" : "activations";
    chain.steps.push_back(
        fmt::format("{} as the files hold them; how they were made is not known to this program", kind));
    chain.methods.push_back(fmt::format("The input was {} that were processed beforehand.", kind));
  }
  if (emg.kind != EmgKind::activation) {
    const auto held_back = std::ranges::count(result.trials, Use::validation, [](const auto& t) { return t.spec.use; });
    signals::add_normalisation(
        result.emg.normalisation,
        {.window_s = emg.normalise_window_s, .held_back = held_back > 0 && held_back < std::ssize(result.trials)},
        chain);
    chain.steps.push_back(fmt::format("resampled to {:g} Hz where it has twice that rate or more", kActivationRate_hz));
  }
  chain.steps.push_back(method == nullptr
                            ? std::string("activation dynamics: none in this file")
                            : fmt::format("activation dynamics: {}, {} (method {})", identification::name(method->lag),
                                          delays(*method), name(method->method)));
  return chain;
}

}  // namespace myoid
