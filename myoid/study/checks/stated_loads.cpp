#include "myoid/study/checks/stated_loads.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid::study {

bool states_loads(const TrialSpec& trial) {
  return trial.held_mass_kg || trial.external_loads || trial.plates || trial.load_cell || trial.external_torque ||
         trial.given.torques || trial.given.forces;
}

std::optional<Remark> unstated_loads(const std::vector<TrialSpec>& trials) {
  std::vector<std::string> silent;
  for (const TrialSpec& trial : trials) {
    const bool needed = trial.use == Use::calibration || trial.use == Use::validation || trial.use == Use::isometric;
    if (needed && !states_loads(trial) && std::ranges::find(silent, trial.name) == silent.end())
      silent.push_back(trial.name);
  }
  if (silent.empty()) return std::nullopt;
  constexpr std::size_t kMost = 5;
  const std::string more = silent.size() > kMost ? fmt::format(" and {} more", silent.size() - kMost) : "";
  const std::size_t count = silent.size();
  silent.resize(std::min(count, kMost));
  return Remark{.code = RemarkCode::loads_unstated,
                .where = "study",
                .about = "loads",
                .value = static_cast<double>(count),
                .says = fmt::format("the study does not say what was held, carried or pushed in {}{}: every torque and "
                                    "strength is computed as if it was nothing",
                                    fmt::join(silent, ", "), more),
                .remedy =
                    "give each [[trial]] held_mass_kg (0: nothing was held), external_loads, force_plates, "
                    "load_cell or external_torque"};
}

}  // namespace myoid::study
