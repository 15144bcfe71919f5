#include "myoid/fit/measurement/parameter_slots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::fit {

using enum Scope;

namespace {

bool holds(const muscle::Range& range, double value) { return value >= range.lower && value <= range.upper; }

/// Returns the bounds of l_sh in a fit with priors: the range of real muscles relative to the starting optimal fiber
/// length. With little information a fit narrows the curve to a peak at the recording's few lengths and moves l0 there,
/// where no interval is valid. A start outside the range keeps `otherwise`.
muscle::Range width_bounds(const muscle::HillParameters<double>& start, const muscle::Range& otherwise) {
  const double l0_m = start.optimal_fiber_length_m;
  const muscle::Range of_muscles{muscle::kRelativeWidths.lower * l0_m, muscle::kRelativeWidths.upper * l0_m};
  return holds(of_muscles, start.force_length_width_m) ? of_muscles : otherwise;
}

void bound(ParameterSlot& slot, const muscle::Range& given) {
  slot.bounds = given;
  slot.bounds_are_given = true;
}

/// Widens the usual bounds to the field's bounds if a value of the study lies outside.
void make_room(ParameterSlot& slot, double stated) {
  if (holds(slot.usual, stated)) return;
  slot.usual = slot.field->bounds;
  if (!slot.bounds_are_given) slot.bounds = slot.usual;
}

/// Returns the slope ratio at a muscle's start that determines its product; 0: the product is free.
double starting_slope_ratio(const MuscleSetup& setup, const EstimatorOptions& options) {
  if (options.eccentric == Eccentric::smooth) return 1.0;
  const bool by_ratio =
      options.eccentric == Eccentric::slope_ratio ||
      (options.eccentric == Eccentric::automatic && options.priors && setup.priors.contains("eccentric_slope_ratio"));
  const double start = setup.start.eccentric_plateau > 1.0 ? muscle::slope_ratio(setup.start.velocity_law()) : 0.0;
  return by_ratio && start > 0.0 ? start : 0.0;
}

bool product_is_held(const MuscleSetup& setup) { return contains(setup.fixed, "eccentric_curvature_product"); }

/// Returns true if a muscle's number is an unknown unless the study says otherwise.
bool usually_free(
    int field, const MuscleSetup& setup, const EstimatorOptions& options, double slope_ratio, bool fascicles) {
  if (field == kProduct) return slope_ratio == 0.0;
  if (field == kSlopeRatio)
    return slope_ratio > 0.0 && !product_is_held(setup) && options.eccentric != Eccentric::smooth;
  // A tendon that nobody measured is an unknown about the model's length. An error of 10 % moves l0 by half of itself,
  // too far for a column of the unseen quantities, which is linear.
  if (field == kSlack)
    return options.priors && setup.start.tendon_slack_length_m > 0.0 && setup.priors.contains("tendon_slack_length");
  // Measured fiber lengths tell the stretch of an elastic tendon.
  if (field == kTendonStrain)
    return options.priors && fascicles && setup.start.tendon_slack_length_m > 0.0 && setup.extras.tendon_strain > 0.0;
  return field <= kPlateau;
}

void decide_muscle(ParameterSlot& slot,
                   const MuscleSetup& setup,
                   const EstimatorOptions& options,
                   const MuscleValues& values,
                   double slope_ratio,
                   bool fascicles) {
  const int field = slot.field->field;
  const std::string name(slot.field->name);
  slot.value = field == kSlopeRatio ? slope_ratio : values[static_cast<std::size_t>(field)];
  const bool wanted = covers(options.muscles, setup.name);
  slot.free = wanted && !contains(setup.fixed, name) && usually_free(field, setup, options, slope_ratio, fascicles);
  if (slot.free && field == kTendonStrain)
    slot.prior = Prior{.mean = slot.value, .sd = beliefs::kTendonStrain.sd, .logarithmic = true};
  if (const auto b = setup.bounds.find(name); b != setup.bounds.end()) bound(slot, b->second);
  if (const auto p = setup.priors.find(name); p != setup.priors.end()) slot.prior = p->second;
  slot.prior_is_given = contains(setup.given_priors, name);
  if (field == kMaxForce) slot.common_sd = options.unseen.strength;
}

bool is_unseen(const StudyData& data, const std::string& channel) {
  return std::any_of(data.muscles.begin(), data.muscles.end(),
                     [&](const MuscleSetup& setup) { return setup.unseen && setup.emg_channel == channel; });
}

/// Decides the delay: one for all channels, with the first channel's as the unknown, unless each has its own. An
/// activation without EMG has none of its own.
void decide_delay(ParameterSlot& slot, const EstimatorOptions& options, std::size_t channels, bool is_unseen) {
  slot.free = !options.delay_s;
  slot.prior = Prior{.mean = options.delay_prior_mean_s, .sd = options.delay_prior_sd_s};
  if (options.delay_per_channel) {
    slot.free = slot.free && !is_unseen;
    return;
  }
  slot.follows = slot.owner > 0;
  for (std::size_t c = 1; c < channels && !slot.follows; ++c) slot.tied.push_back(static_cast<int>(c));
}

/// Makes a gain an unknown if it has a prior. That of an activation without EMG is its level, and its error's.
void decide_gain(ParameterSlot& slot, const EstimatorOptions& options, const std::string& channel, bool is_unseen) {
  if (is_unseen && options.priors) {
    slot.free = true;
    slot.prior = Prior{.mean = slot.value, .sd = beliefs::kUnseenLevel.sd, .logarithmic = true};
    return;
  }
  const ChannelSource source = options.of(channel);
  if (!options.priors || !(source.gain_sd.value_or(0.0) > 0.0)) return;
  slot.free = true;
  slot.value = source.gain_mean;
  slot.prior = Prior{.mean = slot.value, .sd = *source.gain_sd, .logarithmic = true};
  slot.common_sd = source.gain_common_sd;
}

/// Returns the positions of the owners that a rule names; of all if it names none.
std::vector<int> owners_of(const ParameterRule& rule, const std::vector<std::string>& names) {
  std::vector<int> owners;
  for (const std::string& wanted : rule.owners) {
    const auto it = std::find(names.begin(), names.end(), wanted);
    if (it == names.end()) {
      throw InvalidInput(
          fmt::format("parameter {}: there is no '{}'{}", rule.parameter, wanted, not_among(wanted, names)));
    }
    owners.push_back(static_cast<int>(it - names.begin()));
  }
  for (std::size_t k = 0; k < names.size() && rule.owners.empty(); ++k) owners.push_back(static_cast<int>(k));
  return owners;
}

/// Makes a muscle's slope ratio the number that determines its product.
void use_slope_ratio(ParameterSlot& ratio, ParameterSlots& of_study) {
  if (!(ratio.value > 0.0)) ratio.value = 1.0;
  of_study.slope_ratio[static_cast<std::size_t>(ratio.owner)] = ratio.value;
  for (ParameterSlot& other : of_study.slots) {
    if (other.owner == ratio.owner && other.field->scope == muscle && other.field->field == kProduct)
      other.free = false;
  }
}

/// Sets the rule's prior; a number that the rule frees without one gets the field's own spread.
void set_prior(const ParameterRule& rule, ParameterSlot& slot) {
  const ParameterField& field = *slot.field;
  if (rule.prior_sd || rule.prior_mean) {
    const double mean = rule.prior_mean.value_or(slot.prior ? slot.prior->mean : slot.value);
    const double usual = field.logarithmic ? field.prior_sd * std::abs(mean) : field.prior_sd;
    slot.prior = Prior{.mean = mean, .sd = rule.prior_sd.value_or(usual)};
    slot.prior_is_given = !rule.usual;
  } else if (!slot.prior && rule.free.value_or(false) && field.prior_sd > 0.0) {
    slot.prior = Prior{.mean = slot.value, .sd = field.prior_sd, .logarithmic = field.logarithmic};
  }
}

/// Sets value, bounds, freedom and prior of one number.
void apply_rule(const ParameterRule& rule, ParameterSlot& slot, ParameterSlots& of_study) {
  if (rule.value) slot.value = *rule.value;
  for (const std::optional<double>& believed : {rule.value, rule.prior_mean}) {
    if (believed) make_room(slot, *believed);
  }
  slot.start_is_given = slot.start_is_given || rule.value;
  const bool is_ratio = slot.field->scope == muscle && slot.field->field == kSlopeRatio;
  if (is_ratio && (rule.free || rule.value)) use_slope_ratio(slot, of_study);
  const bool is_slack = slot.field->scope == muscle && slot.field->field == kSlack;
  if (rule.free) slot.free = *rule.free;
  if (is_slack && rule.value && !rule.free && !rule.prior_sd) slot.free = false;  // measured
  if (rule.lower || rule.upper)
    bound(slot, {rule.lower.value_or(slot.bounds.lower), rule.upper.value_or(slot.bounds.upper)});
  set_prior(rule, slot);
}

}  // namespace

const std::vector<std::string>& OwnerNames::of(Scope scope) const {
  return scope == muscle ? muscles : scope == channel ? channels : joints;
}

ParameterSlots default_slots(const StudyData& data,
                             const EstimatorOptions& options,
                             const ModelValues& values,
                             const OwnerNames& names) {
  ParameterSlots result;
  for (const MuscleSetup& setup : data.muscles) result.slope_ratio.push_back(starting_slope_ratio(setup, options));
  for (const ParameterField& field : parameter_fields()) {
    for (std::size_t k = 0; k < names.of(field.scope).size(); ++k) {
      ParameterSlot slot;
      slot.field = &field;
      slot.owner = static_cast<int>(k);
      slot.usual = field.field == kWidth && field.scope == muscle && options.priors
                       ? width_bounds(data.muscles[k].start, field.bounds)
                       : field.bounds;
      slot.bounds = slot.usual;
      if (field.scope == muscle)
        decide_muscle(slot, data.muscles[k], options, values.muscles[k], result.slope_ratio[k],
                      measures_fascicles(data, k));
      if (field.scope == channel) {
        slot.value = values.channels[k][static_cast<std::size_t>(field.field)];
        const bool unseen = is_unseen(data, names.channels[k]);
        if (field.field == kDelay) decide_delay(slot, options, names.channels.size(), unseen);
        if (field.field == kGain) decide_gain(slot, options, names.channels[k], unseen);
      }
      result.slots.push_back(std::move(slot));
    }
  }
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    if (product_is_held(data.muscles[k]) && options.eccentric != Eccentric::smooth) result.slope_ratio[k] = 0.0;
  }
  return result;
}

void apply_rules(const std::vector<ParameterRule>& rules, const OwnerNames& names, ParameterSlots& of_study) {
  for (const ParameterRule& rule : rules) {
    const ParameterField& field = parameter_field(rule.parameter);
    const std::vector<int> owners = owners_of(rule, names.of(field.scope));
    ParameterSlot* first = nullptr;
    for (ParameterSlot& slot : of_study.slots) {
      if (slot.field != &field || std::find(owners.begin(), owners.end(), slot.owner) == owners.end()) continue;
      apply_rule(rule, slot, of_study);
      if (rule.tie) {
        slot.tied.clear();
        slot.follows = first != nullptr;
        if (first == nullptr) {
          first = &slot;
        } else {
          first->tied.push_back(slot.owner);
        }
      } else if (rule.free.value_or(false) && !rule.owners.empty()) {
        slot.follows = false;  // the rule names this owner, which gets an unknown of its own
        for (ParameterSlot& other : of_study.slots) {
          if (other.field == slot.field) std::erase(other.tied, slot.owner);
        }
      }
    }
  }
}

}  // namespace myoid::fit
