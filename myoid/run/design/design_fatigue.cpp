#include "myoid/run/design/design_fatigue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace myoid::run {
namespace {

constexpr double kFatigueStep_s = 0.5;

using Tiredness = std::vector<muscle::FatigueState<double>>;

double worst(const Tiredness& state) {
  double most = 0.0;
  for (const auto& s : state) most = std::max(most, s.fatigued);
  return most;
}

void work(const Effort& effort, const muscle::FatigueRates<double>& rates, Tiredness& state) {
  for (std::size_t k = 0; k < state.size(); ++k) {
    for (const double a : effort.activation[k]) state[k] = muscle::step_fatigue(rates, a, state[k], kFatigueStep_s);
  }
}

void rest(double duration_s, const muscle::FatigueRates<double>& rates, Tiredness& state) {
  for (auto& s : state) s = muscle::step_fatigue(rates, 0.0, s, duration_s);
}

}  // namespace

Effort effort_of(const std::vector<std::optional<fit::TrialData>>& performances,
                 const std::vector<fit::MuscleSetup>& muscles,
                 double duration_s) {
  Effort effort;
  const auto steps = static_cast<std::size_t>(std::ceil(duration_s / kFatigueStep_s));
  for (const fit::MuscleSetup& setup : muscles) {
    std::vector<double> sum(steps, 0.0);
    double count = 0.0;
    for (const std::optional<fit::TrialData>& trial : performances) {
      if (!trial) continue;
      ++count;
      const Eigen::VectorXd a = trial->activation.column(setup.emg_channel);
      const Eigen::VectorXd& clock = trial->activation.time_s();
      for (std::size_t s = 0; s < steps; ++s) {
        const double from = static_cast<double>(s) * kFatigueStep_s;
        const auto begin = std::lower_bound(clock.data(), clock.data() + clock.size(), from) - clock.data();
        const auto end =
            std::lower_bound(clock.data(), clock.data() + clock.size(), from + kFatigueStep_s) - clock.data();
        if (end > begin) sum[s] += a.segment(begin, end - begin).mean();
      }
    }
    for (double& x : sum) x /= std::max(count, 1.0);
    effort.activation.push_back(std::move(sum));
  }
  return effort;
}

double fatigued_share(const Effort& effort, const muscle::FatigueRates<double>& rates) {
  Tiredness fresh(effort.activation.size());
  work(effort, rates, fresh);
  return worst(fresh);
}

std::vector<PlannedRest> plan_rests(const std::vector<const Effort*>& efforts,
                                    double budget,
                                    const muscle::FatigueRates<double>& rates) {
  constexpr double kRestStep_s = 15.0;
  constexpr double kLongestRest_s = 1800.0;
  std::vector<PlannedRest> plan(efforts.size());
  if (efforts.empty()) return plan;
  Tiredness state(efforts.front()->activation.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    Tiredness before = state;
    for (;;) {
      state = before;
      work(*efforts[i], rates, state);
      if (worst(state) <= budget || plan[i].before_s >= kLongestRest_s) break;
      plan[i].before_s += kRestStep_s;
      rest(kRestStep_s, rates, before);
    }
    plan[i].fatigued_share = worst(state);
  }
  return plan;
}

}  // namespace myoid::run
