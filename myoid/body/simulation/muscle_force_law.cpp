#include "myoid/body/simulation/muscle_force_law.h"

#include <memory>
#include <optional>
#include <vector>

#include <ceres/jet.h>

#include "myoid/body/simulation/simulation_model.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::body {
namespace {

using ByActivation = ceres::Jet<double, 1>;  ///< With the derivative by the activation.

}  // namespace

body::MuscleForceLaw muscle_force_law(const body::BodyModel& model,
                                      const body::MuscleKinematics& muscles,
                                      const MuscleForceOptions& options) {
  const body::SimulationModel known = body::make_simulation_model(
      model, {.mode = options.elastic_tendon ? muscle::TendonMode::equilibrium : muscle::TendonMode::rigid});
  using Units = std::vector<std::optional<muscle::Musculotendon<ByActivation>>>;
  const auto units = std::make_shared<Units>(model.muscles.size());
  for (std::size_t k = 0; k < known.muscles.size(); ++k) {
    const body::ModelMuscle& m = known.muscles[k];
    muscle::MusculotendonLaws laws = m.laws;
    muscle::MusculotendonParameters<double> parameters = m.parameters;
    if (!options.passive_force) {
      laws.passive = muscle::PassiveLaw::none;
      parameters.damping = 0.0;
    }
    (*units)[static_cast<std::size_t>(m.index)].emplace(muscle::lifted<ByActivation>(parameters), laws,
                                                        known.millard[k]);
  }
  return [units, length = muscles.length.values(), velocity = muscles.velocity.values()](
             Eigen::Index frame, Eigen::Index muscle, double activation) {
    const auto& unit = (*units)[static_cast<std::size_t>(muscle)];
    if (!unit) return body::ForceAtActivation{};
    const muscle::MusculotendonInput<ByActivation> input{
        ByActivation(activation, 0), ByActivation(length(frame, muscle)), ByActivation(velocity(frame, muscle))};
    const bool rigid = unit->laws().mode == muscle::TendonMode::rigid;
    const muscle::MusculotendonState<ByActivation> state =
        rigid ? muscle::MusculotendonState<ByActivation>{} : muscle::equilibrium_state(*unit, input);
    const ByActivation force = muscle::musculotendon_rate(*unit, input, state).tendon_force_n;
    return body::ForceAtActivation{force.a, force.v[0]};
  };
}

}  // namespace myoid::body
