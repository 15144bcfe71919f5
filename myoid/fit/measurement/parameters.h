#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/fit/measurement/parameter_slots.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/math/bounded.h"

namespace myoid::fit {

/// One unknown of a fit: a number of one owner, or of several tied owners. Start, bounds and prior
/// are in the solver's scale: natural logarithms for logarithmic fields, SI units otherwise.
struct Unknown {
  const ParameterField* field = nullptr;
  std::string owner;  ///< Muscle, channel or joint; tied owners joined by '+'; "subject" for all.
  std::string label;  ///< "BIC.max_isometric_force"
  struct Target {
    int owner = 0;
    double ratio = 1.0;  ///< Value of this owner over the unknown's value.
  };
  std::vector<Target> targets;
  double start = 0.0;
  muscle::Range bounds;
  Prior prior;                  ///< Standard deviation 0: no prior.
  bool prior_is_given = false;  ///< The study gives the prior, in place of the literature's.
  /// Spread of the part of the deviation from the prior's mean that a person's numbers of this field have in common,
  /// beside `prior.sd`, the number's own.
  double common_sd = 0.0;

  [[nodiscard]] double to_value(double z) const;
  [[nodiscard]] bool is(Scope scope, int number) const { return field->scope == scope && field->field == number; }
  [[nodiscard]] bool acts_on(int target_owner) const;
  /// Gains that share an uncertainty have sharp ends at their bounds, which are near: 5 and 100 % of the maximum.
  [[nodiscard]] math::BoundShape bound_shape() const {
    return common_sd > 0.0 && is(Scope::channel, kGain) ? math::BoundShape::sharp : math::BoundShape::gradual;
  }
  /// Returns 1 / sd² of the number's own prior; 0 without a prior.
  [[nodiscard]] double prior_precision() const;
};

/// Maps the solver's vector to the numbers of the model.
class ParameterMap {
 public:
  /// Throws InvalidInput for unknown names and impossible starts.
  ParameterMap(const StudyData& data, const EstimatorOptions& options);

  [[nodiscard]] const std::vector<Unknown>& free() const { return free_; }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(free_.size()); }
  [[nodiscard]] Eigen::VectorXd start() const;
  [[nodiscard]] const std::vector<std::string>& channels() const { return owners_.channels; }
  [[nodiscard]] const std::vector<std::string>& joints() const { return owners_.joints; }
  /// Returns the name of one owner of an unknown, or "subject" for a number of all.
  [[nodiscard]] std::string owner_name(const Unknown& of, int owner) const;
  /// Returns the index of the unknown that moves this number of this owner; -1: the number is held.
  [[nodiscard]] Eigen::Index find(Scope scope, int field, int owner) const;
  [[nodiscard]] int channel_of_muscle(std::size_t muscle) const { return channel_of_muscle_[muscle]; }
  /// Returns the prior of a channel that stands for a muscle without EMG; empty: an electrode's channel.
  [[nodiscard]] const std::optional<UnseenActivation>& unseen_activation(std::size_t channel) const {
    return unseen_[channel];
  }
  [[nodiscard]] double longest_delay_s() const { return longest_delay_s_; }

  /// The derivative d value / d z of a number of the model.
  struct Chain {
    Scope scope = Scope::muscle;
    int owner = 0;
    int field = 0;
    Eigen::Index variable = 0;
    double slope = 1.0;
  };
  [[nodiscard]] ModelValues values(const Eigen::VectorXd& z, std::vector<Chain>* chains = nullptr) const;
  /// Returns the values at the start, before identification.
  [[nodiscard]] const ModelValues& held() const { return held_; }

 private:
  std::vector<Unknown> free_;
  ModelValues held_;
  OwnerNames owners_;
  std::vector<int> channel_of_muscle_;
  std::vector<std::optional<UnseenActivation>> unseen_;  ///< Per channel.
  std::vector<double> slope_ratio_;                      ///< Per muscle; 0: the product is the parameter.
  bool normalised_ = false;
  double longest_delay_s_ = 0.0;
};

/// Derivatives of the model's numbers by the unknowns, grouped by the numbers' owners.
struct ChainsByOwner {
  ChainsByOwner(const ParameterMap& map, const std::vector<ParameterMap::Chain>& chains);
  std::vector<std::vector<ParameterMap::Chain>> of_muscle, of_channel, of_joint;
};

/// Returns the derivative of a joint's own torque by one of its numbers, n. `motion`: angle, rate and acceleration,
/// n x 3; empty: not known.
[[nodiscard]] Eigen::VectorXd by_joint_field(int field,
                                             Eigen::Index n,
                                             const Eigen::Ref<const Eigen::MatrixXd>& motion);

}  // namespace myoid::fit
