#include "myoid/study/checks/stated_body.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

struct Statement {
  std::string file;
  double value = 0.0;
};

bool differ(double a, double b, double share) { return std::abs(a - b) > share * std::min(a, b); }

Remark finding(Severity severity, std::string says, std::string remedy) {
  return {.code = RemarkCode::general,
          .severity = severity,
          .where = "study",
          .about = "mass",
          .says = std::move(says),
          .remedy = std::move(remedy)};
}

/// Returns a warning for the first statement that differs from the first of all.
std::optional<Remark> two_persons(const std::vector<Statement>& all,
                                  double share,
                                  std::string_view quantity,
                                  std::string_view unit) {
  for (const Statement& other : all) {
    if (!differ(other.value, all[0].value, share)) continue;
    return finding(Severity::warning,
                   fmt::format("{} states a {} of {:.4g} {}, {} of {:.4g} {}", all[0].file, quantity, all[0].value,
                               unit, other.file, other.value, unit),
                   "are these two persons? A study is of one");
  }
  return std::nullopt;
}

}  // namespace

std::vector<Remark> unlike_stated_bodies(const Study& study) {
  std::set<std::filesystem::path> seen;
  std::vector<Statement> masses, heights;
  const auto read = [&](const std::filesystem::path& file) {
    if (!seen.insert(file).second) return;
    try {
      const recording::StatedBody body = recording::read_stated_body(file);
      const std::string name = file.filename().string();
      if (body.mass_kg) masses.push_back({name, *body.mass_kg});
      if (body.height_m) heights.push_back({name, *body.height_m});
    } catch (const InvalidInput&) {
      // its own reader reports this
    }
  };
  for (const TrialSpec& trial : study.trials) {
    if (trial.markers) read(*trial.markers);
    if (trial.emg) read(*trial.emg);
    if (trial.plates) read(trial.plates->file);
  }
  std::vector<Remark> found;
  if (auto two = two_persons(heights, kLimits.model.other_height, "body height", "m")) found.push_back(std::move(*two));
  if (masses.empty()) return found;
  if (auto two = two_persons(masses, kLimits.model.other_mass, "body mass", "kg")) {
    found.push_back(std::move(*two));
  } else if (!study.subject.mass_kg) {
    found.push_back(finding(Severity::note,
                            fmt::format("{} states a body mass of {:.4g} kg (PROCESSING:BODYMASS), and the study gives "
                                        "none",
                                        masses[0].file, masses[0].value),
                            fmt::format("if it is right, write [subject] mass_kg = {:.4g}", masses[0].value)));
  } else if (differ(masses[0].value, *study.subject.mass_kg, kLimits.model.other_mass)) {
    found.push_back(finding(Severity::warning,
                            fmt::format("{} states a body mass of {:.4g} kg (PROCESSING:BODYMASS), [subject] mass_kg "
                                        "{:g} kg",
                                        masses[0].file, masses[0].value, *study.subject.mass_kg),
                            "correct mass_kg, or the trial is another person's"));
  }
  return found;
}

}  // namespace myoid::study
