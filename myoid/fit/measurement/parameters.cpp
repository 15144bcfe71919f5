#include "myoid/fit/measurement/parameters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::fit {
namespace {

using enum Scope;

double scaled(const ParameterField& field, double value) { return field.logarithmic ? std::log(value) : value; }

/// Throws InvalidInput where a number cannot start at this value.
void check_start(const ParameterSlot& slot, const std::string& owner) {
  const ParameterField& field = *slot.field;
  if (field.logarithmic && !(slot.value > 0.0)) {
    throw InvalidInput(
        fmt::format("{} of {} starts at {}; give it a positive start to identify it", field.name, owner, slot.value));
  }
  // Given bounds may be wider than the field's, for example for a rat's muscle.
  const double least = std::min(field.bounds.lower, slot.bounds.lower);
  const double most = std::max(field.bounds.upper, slot.bounds.upper);
  if (slot.value < least || slot.value > most) {
    throw InvalidInput(fmt::format("{}.{} starts at {} {}, where no muscle can be: {} to {}", owner, field.name,
                                   slot.value, symbol(field.unit), least, most));
  }
}

/// Returns the prior in the solver's scale.
Prior scaled_prior(const ParameterField& field, const Prior& prior) {
  const double sd = prior.logarithmic == field.logarithmic ? prior.sd
                    : field.logarithmic                    ? prior.sd / prior.mean
                                                           : prior.sd * prior.mean;
  return {.mean = scaled(field, prior.mean), .sd = sd, .logarithmic = field.logarithmic};
}

Unknown unknown_of(const ParameterSlot& slot, const std::string& owner, bool priors) {
  check_start(slot, owner);
  const ParameterField& field = *slot.field;
  Unknown p;
  p.field = &field;
  p.owner = owner;
  p.label = fmt::format("{}.{}", owner, field.name);
  p.bounds.lower = field.logarithmic && slot.bounds.lower <= 0.0 ? std::log(1e-9) : scaled(field, slot.bounds.lower);
  p.bounds.upper = scaled(field, slot.bounds.upper);
  if (!(p.bounds.lower <= p.bounds.upper)) {
    throw InvalidInput(
        fmt::format("{}: lower bound {} above upper bound {}", p.label, slot.bounds.lower, slot.bounds.upper));
  }
  p.prior_is_given = slot.prior_is_given;
  const bool with_prior = priors && slot.prior;
  if (with_prior) p.prior = scaled_prior(field, *slot.prior);
  if (with_prior && !p.prior_is_given) p.common_sd = slot.common_sd;
  const double start = with_prior && !slot.start_is_given ? p.prior.mean : scaled(field, slot.value);
  p.start = std::clamp(start, p.bounds.lower, p.bounds.upper);
  return p;
}

/// Returns the muscles' slots, muscle by muscle, and then the others.
std::vector<const ParameterSlot*> in_order(const std::vector<ParameterSlot>& slots, std::size_t muscles) {
  std::vector<const ParameterSlot*> order;
  for (const ParameterSlot& slot : slots) order.push_back(&slot);
  const auto place = [&](const ParameterSlot* slot) {
    return slot->field->scope == muscle ? slot->owner : static_cast<int>(muscles);
  };
  std::stable_sort(order.begin(), order.end(), [&](auto* a, auto* b) { return place(a) < place(b); });
  return order;
}

double value_of(const std::vector<ParameterSlot>& slots, const ParameterField& field, int owner) {
  for (const ParameterSlot& slot : slots) {
    if (slot.field == &field && slot.owner == owner) return slot.value;
  }
  return 0.0;
}

/// Returns the unknowns of the free slots in the solver's order.
std::vector<Unknown> unknowns_of(const std::vector<ParameterSlot>& slots, const OwnerNames& owners, bool priors) {
  std::vector<Unknown> free;
  for (const ParameterSlot* slot : in_order(slots, owners.muscles.size())) {
    if (!slot->free || slot->follows) continue;
    const std::vector<std::string>& names = owners.of(slot->field->scope);
    std::string owner = names[static_cast<std::size_t>(slot->owner)];
    for (const int other : slot->tied) owner += "+" + names[static_cast<std::size_t>(other)];
    if (slot->field->scope == channel && slot->tied.size() + 1 == names.size() && slot->field->field == kDelay)
      owner = "subject";
    Unknown p = unknown_of(*slot, owner, priors);
    p.targets.push_back({slot->owner, 1.0});
    for (const int other : slot->tied) {
      const double value = value_of(slots, *slot->field, other);
      p.targets.push_back({other, slot->value != 0.0 ? value / slot->value : 1.0});
    }
    free.push_back(std::move(p));
  }
  return free;
}

using Chains = std::vector<ParameterMap::Chain>;

/// Returns the variables that move a muscle's number, each with its slope.
std::vector<std::pair<Eigen::Index, double>> slopes_of(const Chains& chains, int muscle, int field) {
  std::vector<std::pair<Eigen::Index, double>> found;
  for (const ParameterMap::Chain& chain : chains) {
    if (chain.scope == Scope::muscle && chain.owner == muscle && chain.field == field)
      found.emplace_back(chain.variable, chain.slope);
  }
  return found;
}

/// Scales width and v_max of a muscle with its fiber length, which starts at `held_length_m`. `chains` may be null.
void scale_with_length(MuscleValues& m, int owner, double held_length_m, Chains* chains) {
  const double grown = m[kFiberLength] / held_length_m;
  for (const MuscleField field : {kWidth, kSpeed}) {
    const double unscaled = m[static_cast<std::size_t>(field)];
    if (chains != nullptr) {
      for (ParameterMap::Chain& chain : *chains) {
        if (chain.scope == Scope::muscle && chain.owner == owner && chain.field == field) chain.slope *= grown;
      }
      for (const auto& [variable, slope] : slopes_of(*chains, owner, kFiberLength))
        chains->push_back({Scope::muscle, owner, field, variable, unscaled / held_length_m * slope});
    }
    m[static_cast<std::size_t>(field)] = unscaled * grown;
  }
}

/// A slope ratio S and the index of its variable; -1: held.
struct SlopeRatio {
  double value = 0.0;
  Eigen::Index variable = -1;
};

/// Sets the product V_sh V_shl of a muscle from its slope ratio. `chains` may be null.
void set_product(MuscleValues& m, int owner, const SlopeRatio& ratio, Chains* chains) {
  const double vsh = m[kCurvature];
  const double rise = m[kPlateau] - 1.0;
  m[kProduct] = muscle::curvature_product_from_slope_ratio(ratio.value, vsh, m[kPlateau]);
  // A plateau at 1 would make the product 0, and the law 0/0 at v = 0.
  m[kProduct] = std::max(m[kProduct], 1e-12);
  if (chains == nullptr) return;
  for (const auto& [variable, slope] : slopes_of(*chains, owner, kCurvature)) {
    chains->push_back({Scope::muscle, owner, kProduct, variable, slope * m[kProduct] / (vsh * (1.0 + vsh))});
  }
  for (const auto& [variable, slope] : slopes_of(*chains, owner, kPlateau)) {
    chains->push_back({Scope::muscle, owner, kProduct, variable,
                       slope * (rise > 0.0 ? m[kProduct] / rise : vsh / (ratio.value * (1.0 + vsh)))});
  }
  if (ratio.variable >= 0) chains->push_back({Scope::muscle, owner, kProduct, ratio.variable, -m[kProduct]});
}

}  // namespace

double Unknown::to_value(double z) const { return field->logarithmic ? std::exp(z) : z; }

bool Unknown::acts_on(int target_owner) const {
  return std::any_of(targets.begin(), targets.end(),
                     [&](const Target& target) { return target.owner == target_owner; });
}

double Unknown::prior_precision() const { return prior.sd > 0.0 ? 1.0 / (prior.sd * prior.sd) : 0.0; }

ParameterMap::ParameterMap(const StudyData& data, const EstimatorOptions& options) : normalised_(options.normalised) {
  for (const MuscleSetup& setup : data.muscles) {
    held_.muscles.push_back(muscle_values(setup.start, setup.extras));
    owners_.muscles.push_back(setup.name);
    const auto it = std::find(owners_.channels.begin(), owners_.channels.end(), setup.emg_channel);
    channel_of_muscle_.push_back(static_cast<int>(it - owners_.channels.begin()));
    if (it != owners_.channels.end()) continue;
    owners_.channels.push_back(setup.emg_channel);
    unseen_.push_back(setup.unseen);
  }
  owners_.joints = joint_names(data);
  held_.channels.assign(owners_.channels.size(), {options.usual_delay_s(), 1.0, 0.0, 0.040, 0.015, 0.050, 1.0});
  held_.joints.assign(owners_.joints.size(), {0.0, 0.0, 0.0, 0.0});
  ParameterSlots decided = default_slots(data, options, held_, owners_);
  apply_rules(data.rules, owners_, decided);
  slope_ratio_ = std::move(decided.slope_ratio);
  for (const ParameterSlot& slot : decided.slots) {
    if (slot.field->scope != muscle || slot.field->field != kSlopeRatio) {
      held_.number(slot.field->scope, slot.owner, slot.field->field) = slot.value;
    } else if (double& ratio = slope_ratio_[static_cast<std::size_t>(slot.owner)]; ratio > 0.0) {
      ratio = slot.value;
    }
  }
  free_ = unknowns_of(decided.slots, owners_, options.priors);

  for (const ChannelValues& channel : held_.channels) longest_delay_s_ = std::max(longest_delay_s_, channel[kDelay]);
  for (const Unknown& p : free_) {
    if (p.is(channel, kDelay)) longest_delay_s_ = std::max(longest_delay_s_, p.bounds.upper);
  }
  held_ = values(start());
}

std::string ParameterMap::owner_name(const Unknown& of, int owner) const {
  return of.owner == "subject" ? of.owner : owners_.of(of.field->scope)[static_cast<std::size_t>(owner)];
}

Eigen::Index ParameterMap::find(Scope scope, int field, int owner) const {
  const auto it = std::find_if(free_.begin(), free_.end(),
                               [&](const Unknown& p) { return p.is(scope, field) && p.acts_on(owner); });
  return it == free_.end() ? -1 : static_cast<Eigen::Index>(it - free_.begin());
}

Eigen::VectorXd ParameterMap::start() const {
  Eigen::VectorXd z(size());
  for (std::size_t j = 0; j < free_.size(); ++j) z[static_cast<Eigen::Index>(j)] = free_[j].start;
  return z;
}

ModelValues ParameterMap::values(const Eigen::VectorXd& z, std::vector<Chain>* chains) const {
  ModelValues result = held_;
  std::vector<SlopeRatio> ratio;
  for (const double value : slope_ratio_) ratio.push_back({.value = value});
  if (chains != nullptr) chains->clear();
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const Unknown& p = free_[j];
    const auto variable = static_cast<Eigen::Index>(j);
    const double value = p.to_value(z[variable]);
    const double slope = p.field->logarithmic ? value : 1.0;
    for (const Unknown::Target& target : p.targets) {
      if (p.is(muscle, kSlopeRatio)) {
        ratio[static_cast<std::size_t>(target.owner)] = {.value = target.ratio * value, .variable = variable};
        continue;
      }
      result.number(p.field->scope, target.owner, p.field->field) = target.ratio * value;
      if (chains != nullptr)
        chains->push_back({p.field->scope, target.owner, p.field->field, variable, target.ratio * slope});
    }
  }
  for (std::size_t k = 0; k < ratio.size(); ++k) {
    MuscleValues& m = result.muscles[k];
    const int owner = static_cast<int>(k);
    if (normalised_) scale_with_length(m, owner, held_.muscles[k][kFiberLength], chains);
    if (ratio[k].value > 0.0) set_product(m, owner, ratio[k], chains);
  }
  return result;
}

ChainsByOwner::ChainsByOwner(const ParameterMap& map, const std::vector<ParameterMap::Chain>& chains)
    : of_muscle(map.held().muscles.size()), of_channel(map.channels().size()), of_joint(map.joints().size()) {
  for (const ParameterMap::Chain& chain : chains) {
    const auto owner = static_cast<std::size_t>(chain.owner);
    if (chain.scope == Scope::muscle) of_muscle[owner].push_back(chain);
    if (chain.scope == Scope::channel) of_channel[owner].push_back(chain);
    if (chain.scope == Scope::joint) of_joint[owner].push_back(chain);
  }
}

Eigen::VectorXd by_joint_field(int field, Eigen::Index n, const Eigen::Ref<const Eigen::MatrixXd>& motion) {
  if (field == kOffset) return Eigen::VectorXd::Ones(n);
  if (motion.size() == 0) return Eigen::VectorXd::Zero(n);
  return -motion.col(field == kViscosity ? 1 : field == kInertia ? 2 : 0);
}

}  // namespace myoid::fit
