#include "myoid/fit/methods/exchanged_electrodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/exploration.h"

namespace myoid::fit {
namespace {

constexpr double kFar = 2.0;           // standard deviations of a muscle's number
constexpr double kExplained = 0.9;     // R2 from which a fit leaves too little for other names to explain
constexpr std::size_t kMostPairs = 4;  // that are tried

/// Returns pairs of channels behind the sums of their muscles' distances from what is known of people, greatest first.
std::vector<std::tuple<double, std::string, std::string>> doubtful_pairs(const StudyData& data,
                                                                         const IdentificationResult& fit) {
  std::map<std::string, double> farthest;
  for (const MuscleSetup& setup : data.muscles) {
    if (setup.unseen) continue;
    double& distance = farthest[setup.emg_channel];
    const auto known = std::ranges::find(fit.prior_distances, setup.name, &PriorDistance::muscle);
    if (known != fit.prior_distances.end()) distance = std::max(distance, known->farthest_distance);
  }
  std::vector<std::tuple<double, std::string, std::string>> pairs;
  for (auto a = farthest.begin(); a != farthest.end(); ++a) {
    for (auto b = std::next(a); b != farthest.end(); ++b)
      if (std::max(a->second, b->second) >= kFar || fit.r2 < kExplained)
        pairs.emplace_back(a->second + b->second, a->first, b->first);
  }
  std::ranges::sort(pairs, std::ranges::greater());
  pairs.resize(std::min(pairs.size(), kMostPairs));
  return pairs;
}

}  // namespace

std::string ExchangedElectrodes::sentence() const {
  return fmt::format(
      "with '{}' and '{}' exchanged the recording is 10^{:.0f} times as probable: were the electrodes plugged in or "
      "labelled the wrong way round?",
      first, second, log_odds / std::numbers::ln10);
}

std::optional<ExchangedElectrodes> exchanged_electrodes(const StudyData& data,
                                                        const EstimatorOptions& options,
                                                        const IdentificationResult& fit) {
  EstimatorOptions plain = remembering_drives(of_a_fold(options));
  plain.law = fit.lag;
  plain.choose_lag = false;
  const auto log_evidence = [](const StudyData& of, const EstimatorOptions& how) {
    return explore(of, how).modes.front().mode.log_evidence;
  };
  std::optional<double> as_named;
  std::optional<ExchangedElectrodes> best;
  for (const auto& [distance, one, two] : doubtful_pairs(data, fit)) {
    if (!as_named) as_named = log_evidence(data, beginning_at(fit, plain));
    StudyData other = data;
    for (MuscleSetup& setup : other.muscles) {
      const bool first = setup.emg_channel == one;
      if (first || setup.emg_channel == two) setup.emg_channel = first ? two : one;
    }
    const double odds = log_evidence(other, plain) - *as_named;
    if (odds > (best ? best->log_odds : kExchangedOdds)) best = {one, two, odds, fit.r2};
  }
  return best;
}

}  // namespace myoid::fit
