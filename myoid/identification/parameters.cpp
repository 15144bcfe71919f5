#include "myoid/identification/parameters.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::identification {
namespace {

constexpr muscle::Range hill_bounds(int field) {
  return muscle::kHillFields[static_cast<std::size_t>(field)].bounds;
}

using enum Scope;
constexpr std::array kFields = {
    ParameterField{"max_isometric_force", muscle, kMaxForce, Unit::newton, true,
                   hill_bounds(kMaxForce), 0.25, "F_max"},
    ParameterField{"optimal_fiber_length", muscle, kFiberLength, Unit::meter, false,
                   hill_bounds(kFiberLength), 0.0, "l_m0"},
    ParameterField{"force_length_width", muscle, kWidth, Unit::meter, false, hill_bounds(kWidth),
                   0.0, "l_msh"},
    ParameterField{"concentric_curvature", muscle, kCurvature, Unit::dimensionless, true,
                   hill_bounds(kCurvature), 0.3, "V_sh"},
    ParameterField{"eccentric_curvature_product", muscle, kProduct, Unit::dimensionless, true,
                   hill_bounds(kProduct), 0.65, "V_sh V_shl"},
    ParameterField{"eccentric_slope_ratio",
                   muscle,
                   kSlopeRatio,
                   Unit::dimensionless,
                   true,
                   {0.02, 100.0},
                   0.5,
                   "S, slope of f_v in lengthening over that in shortening"},
    ParameterField{"eccentric_plateau", muscle, kPlateau, Unit::dimensionless, false,
                   hill_bounds(kPlateau), 0.15, "V_ml"},
    ParameterField{"max_shortening_speed", muscle, kSpeed, Unit::meter_per_second, true,
                   hill_bounds(kSpeed), 0.20, "v_max"},
    ParameterField{"tendon_slack_length", muscle, kSlack, Unit::meter, false, hill_bounds(kSlack),
                   0.0, "l_t0"},
    ParameterField{"pennation_angle",
                   muscle,
                   kPennation,
                   Unit::radian,
                   false,
                   {0.0, 1.0},
                   0.05,
                   "at the optimal fiber length",
                   true},
    ParameterField{"passive_force",
                   muscle,
                   kPassiveForce,
                   Unit::dimensionless,
                   false,
                   {0.0, 3.0},
                   0.5,
                   "of the stretched fiber at passive_strain, over F_max; 0: none",
                   true},
    ParameterField{"passive_strain",
                   muscle,
                   kPassiveStrain,
                   Unit::dimensionless,
                   true,
                   {0.1, 2.0},
                   0.2,
                   "strain of the fiber at which passive_force is reached"},
    ParameterField{"passive_shape",
                   muscle,
                   kPassiveShape,
                   Unit::dimensionless,
                   true,
                   {0.5, 10.0},
                   0.3,
                   "exponent of the passive force"},
    ParameterField{"length_activation",
                   muscle,
                   kLengthActivation,
                   Unit::dimensionless,
                   false,
                   {0.0, 0.5},
                   0.1,
                   "gamma: optimal length l_m0 (1 + gamma (1 - a))",
                   true},
    ParameterField{"tendon_strain",
                   muscle,
                   kTendonStrain,
                   Unit::dimensionless,
                   true,
                   {0.005, 0.2},
                   0.4,
                   "of the tendon at F_max; 0: rigid"},
    ParameterField{"activation_share",
                   muscle,
                   kShare,
                   Unit::dimensionless,
                   true,
                   {0.1, 10.0},
                   0.3,
                   "activation of a muscle over that of the electrode that serves it"},
    ParameterField{"emg_delay", channel, kDelay, Unit::second, false, {0.0, 0.15}, 0.02, "d"},
    ParameterField{"emg_gain", channel, kGain, Unit::dimensionless, true, {0.2, 5.0}, 0.1, "g"},
    ParameterField{"emg_shape",
                   channel,
                   kShape,
                   Unit::dimensionless,
                   false,
                   {-3.0, 3.0},
                   0.8,
                   "A of (exp(A u) - 1) / (exp(A) - 1); 0: linear",
                   true},
    ParameterField{"emg_exponent",
                   channel,
                   kExponent,
                   Unit::dimensionless,
                   true,
                   {0.5, 2.5},
                   0.2,
                   "p of activation = gain envelope^p; 1: proportional"},
    ParameterField{"excitation_time",
                   channel,
                   kExcitationTime,
                   Unit::second,
                   true,
                   {0.001, 0.2},
                   0.25,
                   "tau_ne of equation (1)"},
    ParameterField{"activation_time",
                   channel,
                   kActivationTime,
                   Unit::second,
                   true,
                   {0.001, 0.2},
                   0.25,
                   "tau_ac of equation (1)"},
    ParameterField{"deactivation_time",
                   channel,
                   kDeactivationTime,
                   Unit::second,
                   true,
                   {0.001, 0.4},
                   0.25,
                   "tau_deac of equation (1)"},
    ParameterField{"joint_viscosity",
                   joint,
                   kViscosity,
                   Unit::newton_meter_second,
                   false,
                   {0.0, 5.0},
                   0.2,
                   "B_l",
                   true},
    ParameterField{"joint_inertia",
                   joint,
                   kInertia,
                   Unit::kilogram_meter2,
                   false,
                   {-0.5, 0.5},
                   0.01,
                   "what inverse dynamics left out",
                   true},
    ParameterField{"joint_stiffness",
                   joint,
                   kStiffness,
                   Unit::newton_meter,
                   false,
                   {-5.0, 50.0},
                   1.0,
                   "per radian",
                   true},
    ParameterField{"joint_torque_offset",
                   joint,
                   kOffset,
                   Unit::newton_meter,
                   false,
                   {-20.0, 20.0},
                   1.0,
                   "constant torque beside the muscles'",
                   true},
};

/// What is decided of one number before the unknowns are made.
struct Slot {
  const ParameterField* field = nullptr;
  int owner = 0;
  bool free = false;
  double value = 0.0;
  bool start_is_given = false;  ///< By a rule; else an unknown begins at its prior's mean.
  muscle::Range bounds;
  std::optional<Prior> prior;
  std::vector<int> tied;  ///< Owners that go with it; empty: none.
  bool follows = false;   ///< Another owner's unknown moves it.
};

double scaled(const ParameterField& field, double value) {
  return field.logarithmic ? std::log(value) : value;
}

FreeParameter make_free(const Slot& slot, const std::string& owner, bool priors) {
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

std::span<const ParameterField> parameter_fields() { return kFields; }

bool zero_by_nature(std::string_view parameter) {
  return std::any_of(kFields.begin(), kFields.end(), [&](const ParameterField& field) {
    return field.zero_by_nature && field.name == parameter;
  });
}

const ParameterField& parameter_field(std::string_view name) {
  std::string names;
  for (const ParameterField& field : kFields) {
    if (field.name == name) return field;
    names += (names.empty() ? "" : ", ") + std::string(field.name);
  }
  throw InvalidInput(fmt::format("no parameter is named '{}'; there are {}", name, names));
}

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

  // Defaults of every number.
  std::vector<Slot> slots;
  const auto owner_count = [&](Scope scope) {
    return scope == muscle    ? data.muscles.size()
           : scope == channel ? channels_.size()
                              : joints_.size();
  };
  slope_ratio_.assign(data.muscles.size(), 0.0);
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const MuscleSetup& setup = data.muscles[k];
    const double start = setup.start.eccentric_plateau > 1.0
                             ? muscle::slope_ratio(setup.start.velocity_shape())
                             : 0.0;
    const bool by_ratio = options.eccentric == Eccentric::slope_ratio ||
                          (options.eccentric == Eccentric::automatic && options.priors &&
                           setup.priors.contains("eccentric_slope_ratio"));
    if (by_ratio && start > 0.0) slope_ratio_[k] = start;
    if (options.eccentric == Eccentric::smooth) slope_ratio_[k] = 1.0;
  }
  for (const ParameterField& field : kFields) {
    for (std::size_t k = 0; k < owner_count(field.scope); ++k) {
      Slot slot;
      slot.field = &field;
      slot.owner = static_cast<int>(k);
      slot.bounds = field.bounds;
      const auto f = static_cast<std::size_t>(field.field);
      if (field.scope == muscle) {
        const MuscleSetup& setup = data.muscles[k];
        const std::string name(field.name);
        const bool wanted = options.muscles.empty() ||
                            std::find(options.muscles.begin(), options.muscles.end(), setup.name) !=
                                options.muscles.end();
        const bool held =
            std::find(setup.fixed.begin(), setup.fixed.end(), name) != setup.fixed.end();
        slot.value = field.field == kSlopeRatio ? slope_ratio_[k] : held_.muscles[k][f];
        const bool usual = field.field <= kPlateau && field.field != kProduct;
        const bool product_is_held = std::find(setup.fixed.begin(), setup.fixed.end(),
                                               "eccentric_curvature_product") != setup.fixed.end();
        const bool by_ratio = slope_ratio_[k] > 0.0 && !product_is_held;
        slot.free =
            wanted && !held &&
            (usual || (field.field == kProduct && slope_ratio_[k] == 0.0) ||
             (field.field == kSlopeRatio && by_ratio && options.eccentric != Eccentric::smooth));
        if (field.field == kSlopeRatio && product_is_held && options.eccentric != Eccentric::smooth)
          slope_ratio_[k] = 0.0;
        if (const auto b = setup.bounds.find(name); b != setup.bounds.end())
          slot.bounds = b->second;
        if (const auto p = setup.priors.find(name); p != setup.priors.end()) slot.prior = p->second;
      } else if (field.scope == channel) {
        slot.value = held_.channels[k][f];
        if (field.field == kDelay) {
          slot.free = !options.delay_s;
          slot.bounds.upper = options.delay_limit_s;
          slot.prior = Prior{.mean = options.delay_prior_mean_s, .sd = options.delay_prior_sd_s};
          if (!options.delay_per_channel) {
            if (k == 0) {
              for (std::size_t c = 1; c < channels_.size(); ++c)
                slot.tied.push_back(static_cast<int>(c));
            } else {
              slot.follows = true;
            }
          }
        }
        if (field.field == kGain && options.priors) {
          const auto it = options.gain_prior_sd.find(channels_[k]);
          if (it != options.gain_prior_sd.end() && it->second > 0.0) {
            slot.free = true;
            const auto mean = options.gain_prior_mean.find(channels_[k]);
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

  // Rules.
  const auto owner_names = [&](Scope scope) {
    std::vector<std::string> names;
    if (scope == channel) return channels_;
    if (scope == joint) return joints_;
    for (const MuscleSetup& setup : data.muscles) names.push_back(setup.name);
    return names;
  };
  for (const ParameterRule& rule : data.rules) {
    const ParameterField& field = parameter_field(rule.parameter);
    const std::vector<std::string> names = owner_names(field.scope);
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
    Slot* first = nullptr;
    for (Slot& slot : slots) {
      if (slot.field != &field ||
          std::find(owners.begin(), owners.end(), slot.owner) == owners.end())
        continue;
      if (rule.value) slot.value = *rule.value;
      slot.start_is_given = slot.start_is_given || rule.value;
      if (field.field == kSlopeRatio && field.scope == muscle && (rule.free || rule.value)) {
        if (!(slot.value > 0.0)) slot.value = 1.0;
        slope_ratio_[static_cast<std::size_t>(slot.owner)] = slot.value;
        for (Slot& other : slots) {
          if (other.owner == slot.owner && other.field->scope == muscle &&
              other.field->field == kProduct)
            other.free = false;
        }
      }
      if (rule.free) slot.free = *rule.free;
      if (rule.lower) slot.bounds.lower = *rule.lower;
      if (rule.upper) slot.bounds.upper = *rule.upper;
      if (rule.prior_sd || rule.prior_mean) {
        const double mean = rule.prior_mean.value_or(slot.prior ? slot.prior->mean : slot.value);
        const double usual = field.logarithmic ? field.prior_sd * std::abs(mean) : field.prior_sd;
        slot.prior = Prior{.mean = mean, .sd = rule.prior_sd.value_or(usual)};
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
        for (Slot& other : slots) {
          if (other.field == slot.field) std::erase(other.tied, slot.owner);
        }
      }
    }
  }

  // Held values and unknowns.
  for (const Slot& slot : slots) {
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
    for (const Slot& slot : slots) {
      if (slot.field == &field && slot.owner == owner) return slot.value;
    }
    return 0.0;
  };
  std::vector<const Slot*> order;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    for (const Slot& slot : slots) {
      if (slot.field->scope == muscle && slot.owner == static_cast<int>(k)) order.push_back(&slot);
    }
  }
  for (const Slot& slot : slots) {
    if (slot.field->scope != muscle) order.push_back(&slot);
  }
  for (const Slot* slot : order) {
    if (!slot->free || slot->follows) continue;
    const std::vector<std::string> names = owner_names(slot->field->scope);
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
