#include "myoid/run/other_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/fit/intervals/estimate_rows.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/exploration.h"
#include "myoid/fit/posterior/voluntary_torque.h"
#include "myoid/ground/core/progress_part.h"

namespace myoid::run {
namespace {

using fit::ParameterEstimate;
using fit::WithoutEmg;

WithoutEmg other_than(WithoutEmg choice) {
  return choice == WithoutEmg::unseen ? WithoutEmg::synergies : WithoutEmg::unseen;
}

/// Returns the data whose activations without EMG follow the other choice.
fit::StudyData with_other_choice(fit::StudyData data) {
  const std::vector<std::string> measured = fit::measured_channels(data);
  for (fit::TrialData& trial : data.trials) trial.activation = trial.activation.select(measured);
  for (fit::MuscleSetup& muscle : data.muscles)
    if (muscle.unseen) muscle.unseen->by = other_than(muscle.unseen->by);
  fit::expect_activations(data);
  return data;
}

/// Returns the numbers at the mode next to the fit's answer: names and values.
std::vector<ParameterEstimate> numbers_at_mode(const fit::StudyData& data,
                                               const fit::EstimatorOptions& options,
                                               const fit::IdentificationResult& torque) {
  const fit::Exploration found = fit::explore(data, options);
  const fit::Candidate& mode = found.modes.front();
  const fit::ParameterMap& map = mode.density->parameters();
  const Eigen::VectorXd z = mode.density->z_of(mode.mode.x);
  const fit::NoiseValues noise = mode.density->noise_of(mode.mode.x);
  const fit::LinearReading reading(mode.density->likelihood(), z, noise, noise, torque.covariance);
  std::vector<ParameterEstimate> rows = fit::voluntary_torques(data, options, reading, reading, {}).estimates;
  for (std::size_t j = 0; j < map.free().size(); ++j)
    for (const fit::Unknown::Target& target : map.free()[j].targets)
      rows.push_back(fit::row_of(map.free()[j], target, map, z[static_cast<Eigen::Index>(j)]));
  return rows;
}

template <typename Row>
const Row* same_number(const std::vector<Row>& rows, const ParameterEstimate& e) {
  const auto found = std::ranges::find_if(
      rows, [&](const Row& row) { return row.muscle == e.muscle && row.parameter == e.parameter; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

const OtherChoice::Number* OtherChoice::of(const ParameterEstimate& estimate) const {
  return same_number(numbers, estimate);
}

std::ptrdiff_t OtherChoice::outside() const { return std::ranges::count_if(numbers, &Number::outside); }

std::string OtherChoice::sentence() const {
  return fmt::format("with {}, {} of {} numbers would lie outside of their intervals", other, outside(),
                     numbers.size());
}

std::optional<OtherChoice> other_choice(const fit::StudyData& data,
                                        const fit::EstimatorOptions& options,
                                        const fit::IdentificationResult& torque) {
  const auto hidden =
      std::ranges::find_if(data.muscles, [](const fit::MuscleSetup& m) { return m.unseen.has_value(); });
  if (hidden == data.muscles.end() || torque.exact) return std::nullopt;
  fit::EstimatorOptions plain = fit::beginning_at(torque, fit::of_a_fold(options));
  plain.progress = part_of(options.progress, 0.0, 0.5);
  const std::vector<ParameterEstimate> here = numbers_at_mode(data, plain, torque);
  plain.progress = part_of(options.progress, 0.5, 1.0);
  const std::vector<ParameterEstimate> there = numbers_at_mode(with_other_choice(data), plain, torque);
  OtherChoice found{.other = hidden->unseen->by == WithoutEmg::unseen
                                 ? "activations without EMG that follow synergies of the EMG"
                                 : "activations without EMG about a constant"};
  for (const ParameterEstimate& e : torque.estimates) {
    const ParameterEstimate *own = same_number(here, e), *other = same_number(there, e);
    if (own == nullptr || other == nullptr || !e.ci_low || !e.ci_high || e.estimate == 0.0) continue;
    const double shift = other->estimate - own->estimate;
    const double width = shift < 0.0 ? e.estimate - *e.ci_low : *e.ci_high - e.estimate;
    found.numbers.push_back({.muscle = e.muscle,
                             .parameter = e.parameter,
                             .other = e.estimate + shift,
                             .moved = std::abs(shift) / std::max(width, 1e-12 * std::abs(e.estimate))});
  }
  return found;
}

}  // namespace myoid::run
