#include "myoid/run/identify_files/electrode_ties.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/counted.h"

namespace myoid::run {

using fit::MuscleSetup;

ElectrodeTies electrode_ties(const std::vector<MuscleSetup>& muscles) {
  ElectrodeTies ties;
  std::vector<std::string> channels;
  std::map<std::string, std::vector<const MuscleSetup*>> of_channel;
  for (const MuscleSetup& muscle : muscles) {
    if (muscle.unseen) continue;
    std::vector<const MuscleSetup*>& group = of_channel[muscle.emg_channel];
    if (group.empty()) channels.push_back(muscle.emg_channel);
    group.push_back(&muscle);
  }
  std::vector<std::string> shared;
  for (const std::string& channel : channels) {
    const std::vector<const MuscleSetup*>& group = of_channel[channel];
    if (group.size() < 2) continue;
    shared.push_back(fmt::format("'{}' {}", channel, counted(group.size(), "muscle")));
    for (const fit::ParameterField& field : fit::parameter_fields()) {
      const bool of_the_law =
          field.field <= fit::kPlateau || field.field == fit::kSlopeRatio || field.field == fit::kSpeed;
      if (field.scope != fit::Scope::muscle || !of_the_law) continue;
      const std::string name(field.name);
      fit::ParameterRule rule;
      rule.parameter = name;
      rule.usual = true;
      rule.tie = true;
      for (const MuscleSetup* muscle : group) {
        const bool own = fit::contains(muscle->fixed, name) || muscle->bounds.contains(name) ||
                         fit::contains(muscle->given_priors, name);
        if (!own) rule.owners.push_back(muscle->name);
      }
      if (rule.owners.size() > 1) ties.rules.push_back(std::move(rule));
    }
  }
  if (!shared.empty())
    ties.says = fmt::format(
        "muscles of one electrode share one scale of every parameter ({}): one EMG cannot tell them apart; --scales "
        "muscle gives each its own",
        fmt::join(shared, ", "));
  return ties;
}

}  // namespace myoid::run
