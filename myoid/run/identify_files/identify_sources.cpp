#include "myoid/run/identify_files/identify_sources.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"

namespace myoid::run {
namespace {

void require_count(std::size_t count, std::size_t trials, std::string_view option) {
  if (count != trials)
    throw InvalidInput(fmt::format("{}: {} for {} of --lengths; give one per trial, in the same order", option,
                                   counted(count, "file"), trials));
}

}  // namespace

void require_counts(const IdentifySources& s, bool torque) {
  const std::size_t trials = s.lengths.size();
  require_count(s.activations.size(), trials, "--activations");
  if (!s.velocities.empty()) require_count(s.velocities.size(), trials, "--velocities");
  if (!torque) {
    require_count(s.forces.size(), trials, "--forces");
    return;
  }
  const std::size_t joints = std::max<std::size_t>(1, s.coordinates.size());
  if (joints > 1 && s.moment_arms.size() != joints * trials) {
    throw InvalidInput(
        fmt::format("--moment-arms: {} files for {} trials with {} coordinates each; give the first trial's in the "
                    "order of --coordinate, then the next trial's",
                    s.moment_arms.size(), trials, joints));
  }
  if (joints == 1) require_count(s.moment_arms.size(), trials, "--moment-arms");
  require_count(s.torques.size(), trials, "--torques");
  if (!s.fascicles.empty()) require_count(s.fascicles.size(), trials, "--fascicles");
  if (!s.motions.empty()) require_count(s.motions.size(), trials, "--motion");
  if (!s.forces.empty()) require_count(s.forces.size(), trials, "--forces");
}

std::string trial_label(const std::vector<std::string>& lengths, std::size_t number) {
  namespace fs = std::filesystem;
  const auto tail = [](const std::string& file, int folders) {
    fs::path label = fs::path(file).stem();
    fs::path above = fs::path(file).parent_path();
    for (int k = 0; k < folders && above.has_filename(); ++k, above = above.parent_path())
      label = above.filename() / label;
    return label.generic_string();
  };
  const auto is_alone = [&](int folders) {
    const std::string own = tail(lengths[number], folders);
    return std::ranges::count_if(lengths, [&](const std::string& other) { return tail(other, folders) == own; }) == 1;
  };
  constexpr int kMostFolders = 8;
  int folders = 0;
  while (folders < kMostFolders && !is_alone(folders)) ++folders;
  const std::string label = tail(lengths[number], is_alone(folders) ? folders : 0);
  return lengths.size() > 1 ? fmt::format("{} ({})", number + 1, label) : label;
}

std::size_t trial_named(const std::string& name, const std::vector<std::string>& lengths) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (name == lengths[i] || name == std::filesystem::path(lengths[i]).stem() || name == std::to_string(i + 1))
      found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  throw InvalidInput(fmt::format("--validate {}: {}; give a number from 1 to {}, or one of the files of --lengths: {}",
                                 name, found.empty() ? "no trial has that name" : "several trials have that name",
                                 lengths.size(), fmt::join(lengths, ", ")));
}

}  // namespace myoid::run
