#include "myoid/fit/methods/shifted_emg.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/methods/exchanged_electrodes.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr double kLeadStep_s = 0.1;
constexpr int kReach = 15;  ///< Steps to either side.

double lead_of(std::size_t k) { return kLeadStep_s * (static_cast<int>(k) - kReach); }

bool contains(const UsualLead& usual, std::size_t k) {
  constexpr double kRound_s = 1e-6;
  return lead_of(k) > usual.earliest_s - kRound_s && lead_of(k) < usual.latest_s + kRound_s;
}

/// The errors by lead: where they are least, and least among the usual leads.
struct LeadErrors {
  std::size_t best = 0;
  double least = kInfinity, usual = kInfinity;
  bool unique = true, inside = true;  ///< Of `best`: among the usual leads.

  LeadErrors(const std::vector<double>& rms, const UsualLead& leads) {
    constexpr double kAlike = 1.1;
    constexpr std::size_t kApart = 3;
    best = static_cast<std::size_t>(std::min_element(rms.begin(), rms.end()) - rms.begin());
    least = rms[best];
    inside = contains(leads, best);
    unique = best > 0 && best + 1 < rms.size();
    for (std::size_t k = 0; k < rms.size(); ++k) {
      if (contains(leads, k)) usual = std::min(usual, rms[k]);
      const bool valley = k > 0 && k + 1 < rms.size() && rms[k] <= rms[k - 1] && rms[k] <= rms[k + 1];
      if (valley && (k > best ? k - best : best - k) >= kApart && rms[k] < kAlike * least) unique = false;
    }
  }
  [[nodiscard]] bool shifted(double gain) const { return unique && !inside && least < gain * usual; }
};

}  // namespace

std::string ShiftedEmg::sentence() const {
  return fmt::format(
      "with the EMG{} {:.1f} s {} the literature's muscles make the torque to {:.2f} N m rms, with a lead of {:g} to "
      "{:g} s, as EMG has, only to {:.2f}: were the recordings started together?",
      trial.empty() ? "" : fmt::format(" of '{}'", trial), std::abs(lead_s), lead_s < 0.0 ? "earlier" : "later", rms_nm,
      usual.earliest_s, usual.latest_s, usual_rms_nm);
}

std::optional<ShiftedEmg> shifted_emg(const StudyData& data, const UsualLead& usual) {
  constexpr double kDescribes = 0.5, kBetter = 0.95, kMuchBetter = 0.75, kAlike = 1.5;
  std::vector<LabelFit> fits;
  for (std::size_t k = 0; k <= 2 * kReach; ++k) fits.push_back(fit_of_labels(data, lead_of(k)));
  std::vector<std::string> names;
  for (const TrialData& trial : data.trials) {
    if (trial.calibration) names.push_back(trial.name);
  }
  if (names.empty()) return std::nullopt;
  std::vector<double> of_all;
  for (const LabelFit& fit : fits) of_all.push_back(fit.rms_nm);
  const LeadErrors all(of_all, usual);
  std::vector<LeadErrors> trials;
  std::vector<double> usual_rms;
  for (std::size_t t = 0; t < names.size(); ++t) {
    std::vector<double> rms;
    for (const LabelFit& fit : fits) rms.push_back(fit.trial_rms_nm[t]);
    trials.emplace_back(rms, usual);
    usual_rms.push_back(trials.back().usual);
  }
  const auto late = [](const LeadErrors& e) { return lead_of(e.best) < 0.0; };
  const auto alike =
      std::ranges::count_if(trials, [&](const LeadErrors& e) { return !e.inside && late(e) == late(all); });
  if (all.shifted(kBetter) && fits[all.best].r2 > kDescribes && 4 * alike >= 3 * std::ssize(trials))
    return ShiftedEmg{"", lead_of(all.best), all.least, all.usual, usual};
  if (trials.size() < 3 || all.shifted(kBetter)) return std::nullopt;
  const double others = math::median(std::move(usual_rms));
  for (std::size_t t = 0; t < trials.size(); ++t) {
    if (trials[t].shifted(kMuchBetter) && trials[t].least < kAlike * others)
      return ShiftedEmg{names[t], lead_of(trials[t].best), trials[t].least, trials[t].usual, usual};
  }
  return std::nullopt;
}

}  // namespace myoid::fit
