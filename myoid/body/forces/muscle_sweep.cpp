#include "myoid/body/forces/muscle_sweep.h"

#include <algorithm>

#include "myoid/body/forces/opensim_muscle.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::body {
namespace {

/// Throws if a closed loop moves other coordinates along, which a sweep of one coordinate does not do.
void require_no_loop(const body::BodyModel& model, int coordinate) {
  if (model.constraints.empty()) return;
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  const Eigen::VectorXd moved = body::coupling_matrix(model, state).col(coordinate);
  for (Eigen::Index c = 0; c < moved.size(); ++c) {
    const bool coupled = std::ranges::find(model.couplers, static_cast<int>(c), &body::CoordinateCoupler::dependent) !=
                         model.couplers.end();
    if (c != coordinate && !coupled && moved[c] != 0.0)
      throw InvalidInput(
          "a closed loop of the model moves {} along with {}; give a motion (--motion) instead of a sweep",
          model.coordinates[at(c)].name, model.coordinates[at(coordinate)].name);
  }
}

Eigen::VectorXd forces_at_rest(const OpensimMuscle& muscle, double activation, const Eigen::VectorXd& lengths_m) {
  return lengths_m.unaryExpr([&](double length_m) {
    const OpensimMuscle::State state = muscle.equilibrium(activation, length_m, 0.0);
    return state.converged ? state.tendon_force_n : kNan;
  });
}

}  // namespace

std::vector<SweptMuscle> sweep_muscles(const body::BodyModel& model,
                                       const std::vector<int>& muscles,
                                       int coordinate,
                                       const body::CoordinateRange& range,
                                       int steps,
                                       const Progress& progress) {
  require_no_loop(model, coordinate);
  std::vector<SweptMuscle> all;
  for (const int m : muscles) {
    progress.check();
    const OpensimMuscle law(model.muscles[at(m)], model.compat);
    SweptMuscle swept{.name = model.muscles[at(m)].name,
                      .path = body::path_over_range(model, m, coordinate, range, steps),
                      .has_own_curves = law.has_own_curves()};
    swept.full_force_n = forces_at_rest(law, 1.0, swept.path.lengths_m);
    swept.passive_force_n = forces_at_rest(law, 0.0, swept.path.lengths_m);
    all.push_back(std::move(swept));
  }
  return all;
}

}  // namespace myoid::body
