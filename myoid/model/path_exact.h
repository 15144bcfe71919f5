#pragma once

#include "myoid/model/path_stations.h"

namespace myoid::model {

/// Computes a path by the geometry of the model: continuous length, r = -dl/dq.
void compute_exact_path(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        PathWorkspace& workspace,
                        PathResult& result);

}  // namespace myoid::model
