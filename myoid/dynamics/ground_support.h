#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/stretch.h"
#include "myoid/core/time_series.h"
#include "myoid/model/body_model.h"

namespace myoid::dynamics {

/// What an inverse dynamics lets carry the model in place of the ground.
struct UnsupportedWeight {
  std::string coordinate;  ///< The translation along gravity of the joint to the ground.
  double force_n = 0.0;    ///< Its mean generalized force.
  double weight_n = 0.0;   ///< Of all bodies.
  /// `given_by` names where the ground reaction would be given: a study's keys, a command's option.
  [[nodiscard]] std::string sentence(
      const std::string& given_by = "external_loads or force_plates") const;
};

/// The model's free translation along gravity with the force that it would have to bear, if that is
/// half of the weight or more on average: no measured force carries the body. Empty where the model
/// is fixed to the ground or the loads carry it.
[[nodiscard]] std::optional<UnsupportedWeight> unsupported_weight(
    const model::BodyModel& model, const TimeSeries& generalized_forces);

/// The same for a motion without any load: the translation has the whole weight.
[[nodiscard]] std::optional<UnsupportedWeight> unsupported_weight(const model::BodyModel& model);

/// Parts of a trial in which something that was not measured carries the body, while elsewhere the
/// measured forces do: a foot beside the plates.
struct UncarriedTime {
  std::vector<Stretch> stretches;
  double share = 0.0;      ///< Of the trial's time.
  std::string coordinate;  ///< The translation along gravity of the joint to the ground.
  double force_n = 0.0;    ///< The largest that it has to bear in them.
  double weight_n = 0.0;   ///< Of all bodies.
  [[nodiscard]] std::string sentence() const;
};

/// Where the model's free translation along gravity has to bear half of the weight for 50 ms or
/// more, each stretch as far as it bears a quarter; a body in flight needs nothing. Empty where
/// that is nowhere or, as of people who sit, lie or hang, in nine tenths of the time.
[[nodiscard]] std::optional<UncarriedTime> uncarried_time(const model::BodyModel& model,
                                                          const TimeSeries& generalized_forces);

/// True if the coordinate stands between the ground and the rest of the body, so that a ground
/// reaction would act on it: the model is most of a person (three quarters of `body_mass_kg`, or of
/// a generic 75 kg), and what the coordinate moves reaches lower than everything else in this
/// posture.
[[nodiscard]] bool bears_the_body(const model::BodyModel& model,
                                  const std::string& coordinate,
                                  const Eigen::VectorXd& q,
                                  double body_mass_kg);

/// The same of any joint beyond the one to the ground: the model stands on something.
[[nodiscard]] bool stands(const model::BodyModel& model, const Eigen::VectorXd& q);

}  // namespace myoid::dynamics
