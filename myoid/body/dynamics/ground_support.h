#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// A generalized force that carries the model in place of the ground in inverse dynamics.
struct UnsupportedWeight {
  std::string coordinate;  ///< The translation along gravity of the joint to the ground.
  double force_n = 0.0;    ///< Its mean generalized force.
  double weight_n = 0.0;   ///< Weight of all bodies.
  /// Describes the finding. `given_by` names the input for a ground reaction: a study's keys, a command's option;
  /// empty: measured forces are given.
  [[nodiscard]] std::string sentence(const std::string& given_by) const;
};

/// Returns the model's free translation along gravity with its mean generalized force, if this
/// force is half of the weight or more: no measured force carries the body. Empty for a model that
/// is fixed to the ground or carried by the loads.
[[nodiscard]] std::optional<UnsupportedWeight> unsupported_weight(const body::BodyModel& model,
                                                                  const TimeSeries& generalized_forces);

/// Returns the translation for a motion without any load; it then carries the whole weight.
[[nodiscard]] std::optional<UnsupportedWeight> unsupported_weight(const body::BodyModel& model);

/// Measured forces on the ground that do not carry the body which stands on them.
struct WrongSupport {
  Vec3 force_n = Vec3::Zero();  ///< Mean of their sum while they act, in ground.
  Vec3 up = Vec3::UnitY();      ///< Direction against gravity.
  double weight_n = 0.0;        ///< Weight of all bodies.
  [[nodiscard]] double upward() const { return up.dot(force_n) / weight_n; }
  /// Returns true for forces that point down or sideways with half of the weight or more.
  [[nodiscard]] bool is_misdirected() const;
  /// Says the mean, and the sign, axis or unit (kgf, lbf, kN) that explains it.
  [[nodiscard]] std::string sentence() const;
};

/// Share of the weight that measured forces on the ground carry at least, mean while they act.
inline constexpr double kCarriedWeight = 0.5;

/// Returns the forces with a point in ground if their sum pushes up with less than half of the weight, mean over the
/// times in which it is a fifth of its largest size or more. Empty without such forces, and for a model that is fixed
/// to the ground.
[[nodiscard]] std::optional<WrongSupport> wrong_support(const body::BodyModel& model,
                                                        const ExternalLoads& loads,
                                                        const Eigen::VectorXd& time_s);

/// Parts of a trial in which no measured force carries the body while measured forces carry it in
/// the rest of the trial: a foot beside the plates.
struct UncarriedTime {
  std::vector<Stretch> stretches{};
  double share = 0.0;      ///< Share of the trial's time.
  std::string coordinate;  ///< The translation along gravity of the joint to the ground.
  double force_n = 0.0;    ///< Greatest generalized force of the translation in these parts.
  double weight_n = 0.0;   ///< Weight of all bodies.
  [[nodiscard]] std::string sentence() const;
};

/// Share of the weight that no measured force carries at the ends of an uncarried stretch.
inline constexpr double kAffectedWeight = 0.25;

/// Returns the stretches in which the model's free translation along gravity bears half of the weight for 50 ms or
/// more; each extends while the translation bears a quarter. In flight the translation bears no weight. Empty without
/// such a stretch, and with more than nine tenths of the time in stretches, as for people who sit, lie or hang.
[[nodiscard]] std::optional<UncarriedTime> uncarried_time(const body::BodyModel& model,
                                                          const TimeSeries& generalized_forces);

/// Returns true if a ground reaction would act on the coordinate, which then lies between the ground and the rest of
/// the body: the model is most of a person (three quarters of `body_mass_kg`, or of 75 kg if that is less or not
/// stated), and the part that the coordinate moves reaches lower than all other parts in this posture.
[[nodiscard]] bool bears_the_body(const body::BodyModel& model,
                                  const std::string& coordinate,
                                  const Eigen::VectorXd& q,
                                  double body_mass_kg);

/// Returns true if bears_the_body holds for a joint beyond the joint to the ground: the model stands.
[[nodiscard]] bool stands(const body::BodyModel& model, const Eigen::VectorXd& q);

}  // namespace myoid::body
