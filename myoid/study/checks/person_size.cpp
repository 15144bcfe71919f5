#include "myoid/study/checks/person_size.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Returns the median of a length, if the length is long and stays within the limit.
std::optional<double> steady_length(std::vector<double> lengths_m) {
  std::erase_if(lengths_m, [](double length) { return !std::isfinite(length); });
  if (lengths_m.empty()) return std::nullopt;
  std::ranges::sort(lengths_m);
  const auto at = [&](double share) {
    return lengths_m[static_cast<std::size_t>(share * static_cast<double>(lengths_m.size() - 1))];
  };
  if (at(0.5) < kLimits.markers.shortest_segment_m || at(0.95) - at(0.05) > kLimits.markers.other_size * at(0.5))
    return std::nullopt;
  return at(0.5);
}

/// A length in the trials that have it, the shortest first.
using InTrials = std::vector<std::pair<double, std::string>>;

std::map<std::string, InTrials> by_length(const std::vector<TrialSize>& trials) {
  std::map<std::string, InTrials> all;
  for (const TrialSize& trial : trials) {
    for (const auto& [name, length_m] : trial.lengths_m) all[name].emplace_back(length_m, trial.trial);
  }
  for (auto& [name, in_trials] : all)
    std::ranges::stable_sort(in_trials, {}, [](const auto& of_trial) { return of_trial.first; });
  return all;
}

/// Returns the median ratio of a trial's lengths to the middle ones of all trials.
double relative_size(const TrialSize& trial, const std::map<std::string, InTrials>& lengths) {
  std::vector<double> ratios;
  for (const auto& [name, length_m] : trial.lengths_m) {
    const InTrials& all = lengths.at(name);
    ratios.push_back(length_m / all[all.size() / 2].first);
  }
  return ratios.empty() ? 1.0 : math::median(std::move(ratios));
}

/// Returns "240 mm in 'a', 'b'; 288 mm in 'c'": trials of one size stand together.
std::string by_size(const InTrials& sorted) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> groups;
  for (std::size_t i = 0; i < sorted.size();) {
    const double first_m = sorted[i].first;
    std::vector<std::string> names;
    std::size_t more = 0;
    for (; i < sorted.size() && sorted[i].first <= (1.0 + 0.5 * kLimits.markers.other_size) * first_m; ++i) {
      if (names.size() < kNamed)
        names.push_back("'" + sorted[i].second + "'");
      else
        ++more;
    }
    groups.push_back(fmt::format("{:.0f} mm in {}{}", 1000.0 * first_m, name_list(names),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return fmt::format("{}", fmt::join(groups, "; "));
}

}  // namespace

TrialSize size_of(const body::BodyModel& model, const std::string& trial, const MarkerSeries& markers) {
  TrialSize size{.trial = trial, .lengths_m = {}};
  if (const auto forearm = steady_length(forearm_lengths_m(markers)))
    size.lengths_m["the forearm from the epicondyles to the styloids"] = *forearm;
  for (const recording::ExpectedSegment& expected : body::segments_of(model, markers)) {
    std::vector<Eigen::Index> of = expected.segment.markers;
    std::ranges::sort(of, {}, [&](Eigen::Index m) { return markers.names[static_cast<std::size_t>(m)]; });
    for (std::size_t i = 0; i < of.size(); ++i) {
      for (std::size_t k = i + 1; k < of.size(); ++k) {
        std::vector<double> lengths_m;
        for (Eigen::Index f = 0; f < markers.frame_count(); ++f)
          lengths_m.push_back((markers.position(f, of[i]) - markers.position(f, of[k])).norm());
        if (const auto length = steady_length(std::move(lengths_m)))
          size.lengths_m[fmt::format("{} from marker '{}' to '{}'", expected.segment.name,
                                     markers.names[static_cast<std::size_t>(of[i])],
                                     markers.names[static_cast<std::size_t>(of[k])])] = *length;
      }
    }
  }
  return size;
}

std::optional<Remark> unlike_sizes(const std::vector<TrialSize>& trials) {
  const std::map<std::string, InTrials> lengths = by_length(trials);
  const TrialSize *smallest = nullptr, *largest = nullptr;
  double least = 1.0, most = 1.0;
  for (const TrialSize& trial : trials) {
    const double size = relative_size(trial, lengths);
    if (smallest == nullptr || size < least) smallest = &trial, least = size;
    if (largest == nullptr || size > most) largest = &trial, most = size;
  }
  if (smallest == nullptr || !(most > (1.0 + kLimits.markers.other_size) * least)) return std::nullopt;
  const std::pair<const std::string, InTrials>* longest = nullptr;
  for (const auto& entry : lengths) {
    if (!smallest->lengths_m.contains(entry.first) || !largest->lengths_m.contains(entry.first)) continue;
    if (longest == nullptr || entry.second.back().first > longest->second.back().first) longest = &entry;
  }
  return Remark{
      .code = RemarkCode::segment_not_rigid,
      .severity = Severity::warning,
      .where = "study",
      .value = most / least - 1.0,
      .says = fmt::format("segments are {:.0f} % longer in '{}' than in '{}'{}: the trials are of two persons, or "
                          "markers were moved between them",
                          100.0 * (most / least - 1.0), largest->trial, smallest->trial,
                          longest == nullptr ? "" : fmt::format(" ({}: {})", longest->first, by_size(longest->second))),
      .remedy =
          "a study is of one person: write one for each (`myoid cohort` runs them together). Of one person, look "
          "at the markers' errors in each trial"};
}

}  // namespace myoid::study
