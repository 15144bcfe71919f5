#include "myoid/identification/parameter_slots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::identification {

using enum Scope;

namespace {

bool holds(const muscle::Range& range, double value) {
  return value >= range.lower && value <= range.upper;
}

/// Bounds of l_sh: with priors those of a muscle, of its optimal fiber length at the start. A
/// recording that hardly tells draws curves together to a narrow peak at the few lengths it has,
/// and l0 with them, where intervals no longer hold. A start that is no muscle's has its reasons.
muscle::Range width_bounds(const muscle::HillParameters<double>& start,
                           const muscle::Range& otherwise) {
  const double l0_m = start.optimal_fiber_length_m;
  const muscle::Range of_muscles{muscle::kRelativeWidths.lower * l0_m,
                                 muscle::kRelativeWidths.upper * l0_m};
  return holds(of_muscles, start.force_length_width_m) ? of_muscles : otherwise;
}

void bound(ParameterSlot& slot, const muscle::Range& given) {
  slot.bounds = given;
  slot.bounds_are_given = true;
}

/// A value that the study states may lie where the usual bounds do not reach.
void make_room(ParameterSlot& slot, double stated) {
  if (holds(slot.usual, stated)) return;
  slot.usual = slot.field->bounds;
  if (!slot.bounds_are_given) slot.bounds = slot.usual;
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
  std::vector<ParameterSlot>& slots = result.slots;
  std::vector<double>& slope_ratio = result.slope_ratio;
  slope_ratio.assign(data.muscles.size(), 0.0);
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const MuscleSetup& setup = data.muscles[k];
    const double start =
        setup.start.eccentric_plateau > 1.0 ? muscle::slope_ratio(setup.start.velocity_law()) : 0.0;
    const bool by_ratio = options.eccentric == Eccentric::slope_ratio ||
                          (options.eccentric == Eccentric::automatic && options.priors &&
                           setup.priors.contains("eccentric_slope_ratio"));
    if (by_ratio && start > 0.0) slope_ratio[k] = start;
    if (options.eccentric == Eccentric::smooth) slope_ratio[k] = 1.0;
  }
  for (const ParameterField& field : parameter_fields()) {
    for (std::size_t k = 0; k < names.of(field.scope).size(); ++k) {
      ParameterSlot slot;
      slot.field = &field;
      slot.owner = static_cast<int>(k);
      slot.usual = field.field == kWidth && field.scope == muscle && options.priors
                       ? width_bounds(data.muscles[k].start, field.bounds)
                       : field.bounds;
      slot.bounds = slot.usual;
      const auto f = static_cast<std::size_t>(field.field);
      if (field.scope == muscle) {
        const MuscleSetup& setup = data.muscles[k];
        const std::string name(field.name);
        const bool wanted = options.muscles.empty() ||
                            std::find(options.muscles.begin(), options.muscles.end(), setup.name) !=
                                options.muscles.end();
        const bool held =
            std::find(setup.fixed.begin(), setup.fixed.end(), name) != setup.fixed.end();
        slot.value = field.field == kSlopeRatio ? slope_ratio[k] : values.muscles[k][f];
        const bool usual = field.field <= kPlateau && field.field != kProduct;
        const bool product_is_held = std::find(setup.fixed.begin(), setup.fixed.end(),
                                               "eccentric_curvature_product") != setup.fixed.end();
        const bool by_ratio = slope_ratio[k] > 0.0 && !product_is_held;
        slot.free =
            wanted && !held &&
            (usual || (field.field == kProduct && slope_ratio[k] == 0.0) ||
             (field.field == kSlopeRatio && by_ratio && options.eccentric != Eccentric::smooth));
        if (field.field == kSlopeRatio && product_is_held && options.eccentric != Eccentric::smooth)
          slope_ratio[k] = 0.0;
        if (const auto b = setup.bounds.find(name); b != setup.bounds.end()) bound(slot, b->second);
        if (const auto p = setup.priors.find(name); p != setup.priors.end()) slot.prior = p->second;
        slot.prior_is_given = std::find(setup.given_priors.begin(), setup.given_priors.end(),
                                        name) != setup.given_priors.end();
      } else if (field.scope == channel) {
        slot.value = values.channels[k][f];
        if (field.field == kDelay) {
          slot.free = !options.delay_s;
          slot.bounds.upper = options.delay_limit_s;
          slot.prior = Prior{.mean = options.delay_prior_mean_s, .sd = options.delay_prior_sd_s};
          if (!options.delay_per_channel) {
            if (k == 0) {
              for (std::size_t c = 1; c < names.channels.size(); ++c)
                slot.tied.push_back(static_cast<int>(c));
            } else {
              slot.follows = true;
            }
          }
        }
        if (field.field == kGain && options.priors) {
          const auto it = options.gain_prior_sd.find(names.channels[k]);
          if (it != options.gain_prior_sd.end() && it->second > 0.0) {
            slot.free = true;
            const auto mean = options.gain_prior_mean.find(names.channels[k]);
            slot.prior = Prior{.mean = mean != options.gain_prior_mean.end() ? mean->second : 1.0,
                               .sd = it->second,
                               .logarithmic = true};
            slot.value = slot.prior->mean;
          }
        }
      }
      slots.push_back(std::move(slot));
    }
  }
  return result;
}

void apply_rules(const std::vector<ParameterRule>& rules,
                 const OwnerNames& owners_of,
                 ParameterSlots& of_study) {
  std::vector<ParameterSlot>& slots = of_study.slots;
  std::vector<double>& slope_ratio = of_study.slope_ratio;
  for (const ParameterRule& rule : rules) {
    const ParameterField& field = parameter_field(rule.parameter);
    const std::vector<std::string>& names = owners_of.of(field.scope);
    std::vector<int> owners;
    for (const std::string& wanted : rule.owners) {
      const auto it = std::find(names.begin(), names.end(), wanted);
      if (it == names.end()) {
        throw InvalidInput(fmt::format("parameter {}: there is no '{}'; there are {}",
                                       rule.parameter, wanted, fmt::join(names, ", ")));
      }
      owners.push_back(static_cast<int>(it - names.begin()));
    }
    if (owners.empty()) {
      for (std::size_t k = 0; k < names.size(); ++k) owners.push_back(static_cast<int>(k));
    }
    ParameterSlot* first = nullptr;
    for (ParameterSlot& slot : slots) {
      if (slot.field != &field ||
          std::find(owners.begin(), owners.end(), slot.owner) == owners.end())
        continue;
      if (rule.value) slot.value = *rule.value;
      for (const std::optional<double>& believed : {rule.value, rule.prior_mean}) {
        if (believed) make_room(slot, *believed);
      }
      slot.start_is_given = slot.start_is_given || rule.value;
      if (field.field == kSlopeRatio && field.scope == muscle && (rule.free || rule.value)) {
        if (!(slot.value > 0.0)) slot.value = 1.0;
        slope_ratio[static_cast<std::size_t>(slot.owner)] = slot.value;
        for (ParameterSlot& other : slots) {
          if (other.owner == slot.owner && other.field->scope == muscle &&
              other.field->field == kProduct)
            other.free = false;
        }
      }
      if (rule.free) slot.free = *rule.free;
      if (rule.lower || rule.upper)
        bound(slot,
              {rule.lower.value_or(slot.bounds.lower), rule.upper.value_or(slot.bounds.upper)});
      if (rule.prior_sd || rule.prior_mean) {
        const double mean = rule.prior_mean.value_or(slot.prior ? slot.prior->mean : slot.value);
        const double usual = field.logarithmic ? field.prior_sd * std::abs(mean) : field.prior_sd;
        slot.prior = Prior{.mean = mean, .sd = rule.prior_sd.value_or(usual)};
        slot.prior_is_given = !rule.usual;
      } else if (!slot.prior && rule.free.value_or(false) && field.prior_sd > 0.0) {
        slot.prior =
            Prior{.mean = slot.value, .sd = field.prior_sd, .logarithmic = field.logarithmic};
      }
      if (rule.tie) {
        slot.tied.clear();
        slot.follows = first != nullptr;
        if (first == nullptr) {
          first = &slot;
        } else {
          first->tied.push_back(slot.owner);
        }
      } else if (rule.free.value_or(false) && !rule.owners.empty()) {
        slot.follows = false;  // freed by name: an unknown of its own
        for (ParameterSlot& other : slots) {
          if (other.field == slot.field) std::erase(other.tied, slot.owner);
        }
      }
    }
  }
}

}  // namespace myoid::identification
