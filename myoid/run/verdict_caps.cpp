#include "myoid/run/verdict_caps.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/page/typeset.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/recording_faults.h"

namespace myoid::run {
namespace {

using fit::VerdictCap;

VerdictCap of_all(std::string reason) { return {.reason = std::move(reason)}; }
VerdictCap of_first(std::string reason) { return {.reason = std::move(reason), .comes_first = true}; }

/// Faults of an EMG channel that no processing mends.
bool spoils_emg(RemarkCode code) {
  constexpr std::array kCodes = {RemarkCode::emg_clipped, RemarkCode::emg_saturated, RemarkCode::emg_flat,
                                 RemarkCode::emg_artifact};
  return std::ranges::find(kCodes, code) != kCodes.end();
}

/// Faults of the level of a channel's EMG.
bool spoils_level(RemarkCode code) { return code == RemarkCode::emg_over_reference || code == RemarkCode::emg_gain; }

/// Returns the channel and the muscles that take their EMG from it.
std::vector<std::string> owners_of(const study::Study& study, const std::string& channel) {
  std::vector<std::string> owners{channel};
  for (const study::MuscleSpec& muscle : study.muscles) {
    if (muscle.emg == channel) owners.push_back(muscle.name);
  }
  return owners;
}

/// Parameters that rest on activation 1: proportional to it, or the shape of the scale that ends there.
std::vector<std::string> strengths() { return {"max_isometric_force", "emg_gain", "emg_exponent", "activation_share"}; }

/// Returns true if the fault of the trial lies in windows that the study excludes.
bool is_excluded(const study::TrialSpec& trial, const Remark& fault) {
  return fault.when && std::ranges::any_of(trial.exclude.windows, [&](const Stretch& window) {
           return fault.when->begin_s >= window.begin_s && fault.when->end_s <= window.end_s;
         });
}

void add_emg(const StudyResult& result, std::vector<VerdictCap>& caps) {
  const study::Study& study = result.source.study;
  const auto reason = [](const Remark& fault, const std::string& where) {
    return fmt::format("{} of {} in {}: mend that first.", page::spelled(name(fault.code)), fault.about, where);
  };
  for (const TrialResult& trial : result.trials) {
    for (const Remark& fault : trial.faults) {
      if (fault.severity != Severity::warning || !spoils_emg(fault.code) || is_excluded(trial.spec, fault)) continue;
      const bool is_reference = std::ranges::any_of(result.emg.normalisation, [&](const auto& n) {
        return n.channel == fault.about && n.source_trial == trial.spec.name;
      });
      if (!is_reference && !study.fits(trial.spec)) continue;
      caps.push_back({.reason = reason(fault, trial.spec.name),
                      .owners = owners_of(study, fault.about),
                      .parameters = study.fits(trial.spec) ? std::vector<std::string>{} : strengths()});
    }
  }
  for (const Remark& fault : result.level_faults) {
    if (fault.severity != Severity::warning || !spoils_level(fault.code)) continue;
    // A gain is that of a trial, and so of all channels.
    const bool of_channel = fault.code == RemarkCode::emg_over_reference && !fault.about.empty();
    caps.push_back({.reason = reason(fault, fault.where.empty() ? "the trials" : fault.where),
                    .owners = of_channel ? owners_of(study, fault.about) : std::vector<std::string>{},
                    .parameters = strengths()});
  }
}

void add_contacts(const StudyResult& result, std::vector<VerdictCap>& caps) {
  for (const TrialResult& trial : result.trials) {
    const bool foreign = std::ranges::any_of(trial.remarks, [](const Remark& remark) {
      return remark.code == RemarkCode::foreign_contact && remark.severity == Severity::warning;
    });
    if (!foreign || !result.source.study.fits(trial.spec)) continue;
    caps.push_back(of_all(fmt::format(
        "Another foot stands on a plate in {}: leave these times out first (exclude = [\"foreign_contacts\"]).",
        trial.spec.name)));
  }
}

void add_gates(const std::vector<page::Gate>& gates, std::vector<VerdictCap>& caps) {
  for (const page::Gate& gate : gates) {
    if (gate.status != page::GateStatus::fail) continue;
    caps.push_back(of_all(fmt::format("The gate \"{}\" failed: mend that first.", gate.name)));
    if (gate.name == kSharingGate) caps.back().method = fit::Method::force;
  }
}

}  // namespace

std::vector<VerdictCap> verdict_caps(const StudyResult& result, const std::vector<page::Gate>& gates) {
  std::vector<VerdictCap> caps;
  if (motion_is_unreliable(result.source.study, result.trials))
    caps.push_back(of_first("The motion it rests on failed its quality gate: mend that first."));
  const MistakenEmg* const mistaken = named_mistake(result);
  if (mistaken != nullptr) caps.push_back(of_first(mistaken->remedy() + "."));
  if (mistaken == nullptr && !doubtful_units(result).empty())
    caps.push_back(of_first("A unit of an angle or a torque seems to be another: mend that first."));
  if (result.fit.shifted) caps.push_back(of_all("EMG and torque seem to be on different clocks: mend that first."));
  if (result.fit.scales && result.fit.scales->differ())
    caps.push_back({.reason = "Dynamometer and masses disagree about the torque's scale: mend that first.",
                    .parameters = strengths()});
  if (result.fit.other_choice) {
    for (const OtherChoice::Number& number : result.fit.other_choice->numbers)
      if (number.outside())
        caps.push_back(
            {.reason = fmt::format("It depends on the choice: see it with {}.", result.fit.other_choice->other),
             .owners = {number.muscle},
             .parameters = {number.parameter}});
  }
  add_contacts(result, caps);
  add_emg(result, caps);
  add_gates(gates, caps);
  return caps;
}

}  // namespace myoid::run
