#include "myoid/identification/parameters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/identification/parameter_slots.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::identification {
namespace {

using enum Scope;

double scaled(const ParameterField& field, double value) {
  return field.logarithmic ? std::log(value) : value;
}

FreeParameter make_free(const ParameterSlot& slot, const std::string& owner, bool priors) {
  const ParameterField& field = *slot.field;
  if (field.logarithmic && !(slot.value > 0.0)) {
    throw InvalidInput(fmt::format("{} of {} starts at {}; give it a positive start to identify it",
                                   field.name, owner, slot.value));
  }
  FreeParameter p;
  p.field = &field;
  p.owner = owner;
  p.label = fmt::format("{}.{}", owner, field.name);
  p.lower = field.logarithmic && slot.bounds.lower <= 0.0 ? std::log(1e-9)
                                                          : scaled(field, slot.bounds.lower);
  p.upper = scaled(field, slot.bounds.upper);
  // Bounds that were given may be wider: a rat's muscle, say.
  const double least = std::min(field.bounds.lower, slot.bounds.lower);
  const double most = std::max(field.bounds.upper, slot.bounds.upper);
  if (slot.value < least || slot.value > most) {
    throw InvalidInput(fmt::format("{} starts at {} {}, where no muscle can be: {} to {}", p.label,
                                   slot.value, symbol(field.unit), least, most));
  }
  if (!(p.lower <= p.upper)) {
    throw InvalidInput(fmt::format("{}: lower bound {} above upper bound {}", p.label,
                                   slot.bounds.lower, slot.bounds.upper));
  }
  p.lower_is_given = slot.bounds.lower > slot.usual.lower;
  p.upper_is_given = slot.bounds.upper < slot.usual.upper;
  p.prior_is_given = slot.prior_is_given;
  p.start = std::clamp(scaled(field, slot.value), p.lower, p.upper);
  if (priors && slot.prior) {
    const Prior& prior = *slot.prior;
    if (!slot.start_is_given) p.start = std::clamp(scaled(field, prior.mean), p.lower, p.upper);
    p.prior_mean = scaled(field, prior.mean);
    p.prior_sd = prior.logarithmic == field.logarithmic ? prior.sd
                 : field.logarithmic                    ? prior.sd / prior.mean
                                                        : prior.sd * prior.mean;
  }
  return p;
}

}  // namespace

double FreeParameter::to_value(double z) const { return field->logarithmic ? std::exp(z) : z; }

ParameterMap::ParameterMap(const StudyData& data, const EstimatorOptions& options)
    : normalised_(options.normalised) {
  for (const MuscleSetup& setup : data.muscles) {
    held_.muscles.push_back(muscle_values(setup.start, setup.extras));
    const auto it = std::find(channels_.begin(), channels_.end(), setup.emg_channel);
    channel_of_muscle_.push_back(static_cast<int>(it - channels_.begin()));
    if (it == channels_.end()) channels_.push_back(setup.emg_channel);
  }
  joints_ = joint_names(data);
  const double delay_s = options.delay_s.value_or(options.delay_prior_mean_s);
  held_.channels.assign(channels_.size(), {delay_s, 1.0, 0.0, 0.040, 0.015, 0.050, 1.0});
  held_.joints.assign(joints_.size(), {0.0, 0.0, 0.0, 0.0});

  OwnerNames owners{.muscles = {}, .channels = channels_, .joints = joints_};
  for (const MuscleSetup& setup : data.muscles) owners.muscles.push_back(setup.name);
  ParameterSlots decided = default_slots(data, options, held_, owners);
  apply_rules(data.rules, owners, decided);
  const std::vector<ParameterSlot>& slots = decided.slots;
  slope_ratio_ = std::move(decided.slope_ratio);

  // Held values and unknowns.
  for (const ParameterSlot& slot : slots) {
    const auto k = static_cast<std::size_t>(slot.owner);
    const auto f = static_cast<std::size_t>(slot.field->field);
    if (slot.field->scope == muscle && slot.field->field != kSlopeRatio)
      held_.muscles[k][f] = slot.value;
    if (slot.field->scope == muscle && slot.field->field == kSlopeRatio && slope_ratio_[k] > 0.0)
      slope_ratio_[k] = slot.value;
    if (slot.field->scope == channel) held_.channels[k][f] = slot.value;
    if (slot.field->scope == joint) held_.joints[k][f] = slot.value;
  }
  const auto value_of = [&](const ParameterField& field, int owner) {
    for (const ParameterSlot& slot : slots) {
      if (slot.field == &field && slot.owner == owner) return slot.value;
    }
    return 0.0;
  };
  std::vector<const ParameterSlot*> order;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    for (const ParameterSlot& slot : slots) {
      if (slot.field->scope == muscle && slot.owner == static_cast<int>(k)) order.push_back(&slot);
    }
  }
  for (const ParameterSlot& slot : slots) {
    if (slot.field->scope != muscle) order.push_back(&slot);
  }
  for (const ParameterSlot* slot : order) {
    if (!slot->free || slot->follows) continue;
    const std::vector<std::string>& names = owners.of(slot->field->scope);
    std::string owner = names[static_cast<std::size_t>(slot->owner)];
    for (const int other : slot->tied) owner += "+" + names[static_cast<std::size_t>(other)];
    if (slot->field->scope == channel && slot->tied.size() + 1 == names.size() &&
        slot->field->field == kDelay)
      owner = "subject";
    FreeParameter p = make_free(*slot, owner, options.priors);
    p.targets.push_back({slot->owner, 1.0});
    for (const int other : slot->tied) {
      const double value = value_of(*slot->field, other);
      p.targets.push_back({other, slot->value != 0.0 ? value / slot->value : 1.0});
    }
    free_.push_back(std::move(p));
  }
  for (std::size_t c = 0; c < channels_.size(); ++c)
    longest_delay_s_ = std::max(longest_delay_s_, held_.channels[c][kDelay]);
  for (const FreeParameter& p : free_) {
    if (p.field->scope == channel && p.field->field == kDelay)
      longest_delay_s_ = std::max(longest_delay_s_, p.upper);
  }
  held_ = values(start());
}

Eigen::VectorXd ParameterMap::start() const {
  Eigen::VectorXd z(size());
  for (std::size_t j = 0; j < free_.size(); ++j) z[static_cast<Eigen::Index>(j)] = free_[j].start;
  return z;
}

ModelValues ParameterMap::values(const Eigen::VectorXd& z, std::vector<Chain>* chains) const {
  ModelValues result = held_;
  std::vector<double> ratio = slope_ratio_;
  std::vector<Eigen::Index> ratio_variable(ratio.size(), -1);
  if (chains != nullptr) chains->clear();
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const FreeParameter& p = free_[j];
    const auto variable = static_cast<Eigen::Index>(j);
    const double value = p.to_value(z[variable]);
    const double slope = p.field->logarithmic ? value : 1.0;
    const auto f = static_cast<std::size_t>(p.field->field);
    for (const FreeParameter::Target& target : p.targets) {
      const auto k = static_cast<std::size_t>(target.owner);
      if (p.field->scope == channel) result.channels[k][f] = target.ratio * value;
      if (p.field->scope == joint) result.joints[k][f] = target.ratio * value;
      if (p.field->scope == muscle && p.field->field == kSlopeRatio) {
        ratio[k] = target.ratio * value;
        ratio_variable[k] = variable;
        continue;
      }
      if (p.field->scope == muscle) result.muscles[k][f] = target.ratio * value;
      if (chains != nullptr)
        chains->push_back(
            {p.field->scope, target.owner, p.field->field, variable, target.ratio * slope});
    }
  }
  const auto slopes_of = [&](std::size_t muscle, int field) {
    std::vector<std::pair<Eigen::Index, double>> found;
    for (const Chain& chain : *chains) {
      if (chain.scope == Scope::muscle && chain.owner == static_cast<int>(muscle) &&
          chain.field == field)
        found.emplace_back(chain.variable, chain.slope);
    }
    return found;
  };
  for (std::size_t k = 0; k < ratio.size(); ++k) {
    MuscleValues& m = result.muscles[k];
    if (normalised_) {
      const double grown = m[kFiberLength] / held_.muscles[k][kFiberLength];
      for (const MuscleField field : {kWidth, kSpeed}) {
        const double before = m[static_cast<std::size_t>(field)];
        if (chains != nullptr) {
          for (Chain& chain : *chains) {
            if (chain.scope == Scope::muscle && chain.owner == static_cast<int>(k) &&
                chain.field == field)
              chain.slope *= grown;
          }
          for (const auto& [variable, slope] : slopes_of(k, kFiberLength)) {
            chains->push_back({Scope::muscle, static_cast<int>(k), field, variable,
                               before / held_.muscles[k][kFiberLength] * slope});
          }
        }
        m[static_cast<std::size_t>(field)] = before * grown;
      }
    }
    if (!(ratio[k] > 0.0)) continue;
    const double vsh = m[kCurvature];
    const double rise = m[kPlateau] - 1.0;
    m[kProduct] = muscle::curvature_product_from_slope_ratio(ratio[k], vsh, m[kPlateau]);
    // A plateau at 1 would make the product 0, and 0/0 of the law at v = 0.
    m[kProduct] = std::max(m[kProduct], 1e-12);
    if (chains == nullptr) continue;
    const int owner = static_cast<int>(k);
    for (const auto& [variable, slope] : slopes_of(k, kCurvature)) {
      chains->push_back(
          {Scope::muscle, owner, kProduct, variable, slope * m[kProduct] / (vsh * (1.0 + vsh))});
    }
    for (const auto& [variable, slope] : slopes_of(k, kPlateau)) {
      chains->push_back(
          {Scope::muscle, owner, kProduct, variable,
           slope * (rise > 0.0 ? m[kProduct] / rise : vsh / (ratio[k] * (1.0 + vsh)))});
    }
    if (ratio_variable[k] >= 0)
      chains->push_back({Scope::muscle, owner, kProduct, ratio_variable[k], -m[kProduct]});
  }
  return result;
}

}  // namespace myoid::identification
