#include "myoid/body/model/muscle_path.h"

#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

void compute_function_path(const FunctionPath& path, const BodyState& state, PathResult& result) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(path.coordinates.size()));
  for (std::size_t k = 0; k < path.coordinates.size(); ++k)
    x[static_cast<Eigen::Index>(k)] = state.q[path.coordinates[k]];
  const MultiPolynomialValue length = evaluate(path.length, x);
  result.length_m = length.value;
  for (std::size_t k = 0; k < path.coordinates.size(); ++k) {
    result.moment_arm_m[path.coordinates[k]] += path.moment_arms.empty()
                                                    ? -length.gradient[static_cast<Eigen::Index>(k)]
                                                    : evaluate(path.moment_arms[k], x).value;
  }
  result.speed_mps = -result.moment_arm_m.dot(state.qdot);
  result.wrapped = false;
  result.settled = true;
}

}  // namespace

void compute_path(const BodyModel& model,
                  const MusclePath& path,
                  const BodyState& state,
                  PathWorkspace& workspace,
                  PathResult& result) {
  result.moment_arm_m.setZero(static_cast<Eigen::Index>(model.coordinates.size()));
  if (path.function) {
    workspace.stations.clear();
    compute_function_path(*path.function, state, result);
  } else if (model.compat.opensim_paths) {
    compute_opensim_path({model, path, state}, workspace, result);
  } else {
    compute_exact_path({model, path, state}, workspace, result);
  }
}

PathResult compute_path(const BodyModel& model, int muscle, const BodyState& state) {
  PathWorkspace workspace;
  PathResult result;
  compute_path(model, model.muscles[at(muscle)].path, state, workspace, result);
  return result;
}

}  // namespace myoid::body
