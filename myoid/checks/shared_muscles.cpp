#include "myoid/checks/shared_muscles.h"

#include <algorithm>

#include <fmt/format.h>

namespace myoid {

std::vector<Remark> shared_muscles(const Study& study) {
  std::vector<Remark> findings;
  for (std::size_t j = 0; j < study.muscles.size(); ++j) {
    const MuscleSpec& b = study.muscles[j];
    for (std::size_t i = 0; i < j; ++i) {
      const MuscleSpec& a = study.muscles[i];
      for (const std::string& name : b.osim) {
        if (std::find(a.osim.begin(), a.osim.end(), name) == a.osim.end()) continue;
        findings.push_back({.code = RemarkCode::shared_muscle,
                            .severity = Severity::error,
                            .where = "study",
                            .says = fmt::format("muscle '{}' of the model is in the osim lists of {} and "
                                                "of {}: its force would count twice; name it in one",
                                                name, a.name, b.name)});
      }
      if (a.emg != b.emg || a.same_as || b.same_as) continue;
      findings.push_back(
          {.code = RemarkCode::shared_channel,
           .severity = Severity::warning,
           .where = "study",
           .says = fmt::format("{} and {} both have EMG channel '{}': a slip? Where one electrode stands "
                               "for two muscles, write emg = {{ same_as = \"{}\" }}",
                               a.name, b.name, a.emg, a.name)});
    }
  }
  return findings;
}

}  // namespace myoid
