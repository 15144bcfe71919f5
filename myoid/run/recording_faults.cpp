#include "myoid/run/recording_faults.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/page/typeset.h"

namespace myoid::run {
namespace {

bool is_doubtful_unit(const Remark& remark) {
  return remark.code == RemarkCode::unit_doubtful && remark.severity == Severity::warning && !remark.about.empty();
}

}  // namespace

page::Gate recordings_gate(const StudyResult& result) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> places;  // by kind of fault and channel
  std::size_t grave = 0;
  for (const Remark& fault : all_faults(result)) {
    if (fault.severity != Severity::warning) continue;
    ++grave;
    std::set<std::string>& trials = places[page::spelled(name(fault.code))][fault.about];
    if (!fault.where.empty()) trials.insert(fault.where);
  }
  std::vector<std::string> kinds;
  for (const auto& [kind, channels] : places) {
    // Every channel is named: its numbers are capped. Of many trials the count will do.
    constexpr std::size_t kMostTrials = 3;
    std::vector<std::string> of;
    for (const auto& [channel, trials] : channels)
      of.push_back(trials.empty()                 ? channel
                   : trials.size() <= kMostTrials ? fmt::format("{} in {}", channel, fmt::join(trials, " and "))
                                                  : fmt::format("{} in {}", channel, counted(trials.size(), "trial")));
    kinds.push_back(fmt::format("{}: {}", kind, fmt::join(of, ", ")));
  }
  std::size_t warnings = 0;
  std::vector<std::string> trials;
  for (const TrialResult& t : result.trials) {
    const std::size_t count = sentences(t.remarks, Severity::warning).size();
    warnings += count;
    if (count > 0) trials.push_back(t.spec.name);
  }
  std::vector<std::string> found;
  if (grave > 0) found.push_back(fmt::format("{} found, {}", grave, fmt::join(kinds, "; ")));
  if (warnings > 0)
    found.push_back(fmt::format("{} about the files of {}", counted(warnings, "warning"), fmt::join(trials, ", ")));
  return {"Recordings without faults", found.empty() ? page::GateStatus::pass : page::GateStatus::warn,
          found.empty() ? std::string("none found") : fmt::format("{}", fmt::join(found, "; ")),
          "no gap, jump, hum, clipping, missing EMG, ... beyond the limits",
          "Each is listed below with its channel, its time and what to do."};
}

const MistakenEmg* named_mistake(const StudyResult& result) {
  if (!result.fit.mistaken) return nullptr;
  const MistakenEmg& mistaken = *result.fit.mistaken;
  if (mistaken.is_exchange() && !mistaken.trial.empty()) return &mistaken;
  const std::vector<Remark> doubts = doubtful_units(result);
  const bool explained = std::ranges::any_of(
      doubts, [&](const Remark& doubt) { return mistaken.trial.empty() || doubt.where == mistaken.trial; });
  return explained ? nullptr : &mistaken;
}

void yield_to_mistake(StudyResult& result) {
  const MistakenEmg* mistaken = named_mistake(result);
  if (mistaken == nullptr || !mistaken->is_gain()) return;
  const auto wrong = std::ranges::find(result.trials, mistaken->trial,
                                       [](const TrialResult& trial) -> const std::string& { return trial.spec.name; });
  const bool of_reference = wrong != result.trials.end() && wrong->spec.use == study::Use::mvc;
  for (Remark& fault : result.level_faults)
    if (fault.code == RemarkCode::emg_over_reference && (of_reference || fault.where == mistaken->trial))
      fault.remedy = mistaken->remedy();
  for (TrialResult& trial : result.trials)
    for (Remark& remark : trial.remarks)
      if (of_reference && is_doubtful_unit(remark)) remark.remedy = mistaken->remedy();
}

std::vector<Remark> doubtful_units(const StudyResult& result) {
  std::vector<Remark> found;
  for (const TrialResult& trial : result.trials) {
    for (const Remark& remark : trial.remarks) {
      if (!is_doubtful_unit(remark)) continue;
      found.push_back(remark);
      found.back().where = trial.spec.name;
    }
  }
  return found;
}

std::vector<Remark> trial_warnings(const StudyResult& result) {
  std::vector<Remark> found;
  for (const TrialResult& trial : result.trials) {
    for (const Remark& remark : trial.remarks) {
      if (remark.severity != Severity::warning) continue;
      found.push_back(remark);
      found.back().where = trial.spec.name;
    }
  }
  return grouped(found, Times::merged);
}

std::vector<Remark> all_faults(const StudyResult& result) {
  std::vector<Remark> faults;
  for (const TrialResult& t : result.trials) faults.insert(faults.end(), t.faults.begin(), t.faults.end());
  faults.insert(faults.end(), result.level_faults.begin(), result.level_faults.end());
  return faults;
}

page::Section recordings_section(const StudyResult& result) {
  page::Section section{"recordings", "Quality of the recordings", {}, {}, {}, {}};
  std::vector<Remark> faults = all_faults(result);
  std::vector<std::vector<page::Cell>> warnings;
  for (const Remark& warning : trial_warnings(result))
    warnings.push_back({{"warning", page::Badge::weak}, {warning.where}, {""}, {sentence(warning)}, {""}});
  if (faults.empty() && warnings.empty()) {
    section.paragraphs.emplace_back("No fault was found in any channel.");
    return section;
  }
  sort_by_severity(faults);
  // Warnings color the page: none is left out.
  const auto grave = static_cast<std::size_t>(std::ranges::count(faults, Severity::warning, &Remark::severity));
  const std::size_t most = std::max<std::size_t>(40, grave);
  page::Table table{"recordings",
                    "Faults of the recordings",
                    "As recorded, before repairs. The limits stand in the guide to `myoid check`.",
                    {"level", "trial", "time", "what was found", "what to do"},
                    std::move(warnings)};
  for (std::size_t i = 0; i < std::min(faults.size(), most); ++i) {
    const Remark& f = faults[i];
    const Stretch when = f.when.value_or(Stretch{});
    table.rows.push_back(
        {f.severity == Severity::warning ? page::Cell{"warning", page::Badge::weak} : page::Cell{"note"},
         {f.where.empty() ? std::string("all") : f.where},
         {fmt::format("{:.5g} to {:.5g} s", when.begin_s, when.end_s)},
         {f.says},
         {f.remedy}});
  }
  section.tables.push_back(std::move(table));
  if (faults.size() > most) {
    section.paragraphs.push_back(fmt::format("{} more notes stand in run.json.", faults.size() - most));
  }
  return section;
}

}  // namespace myoid::run
