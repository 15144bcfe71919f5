#pragma once

#include "myoid/model/path_stations.h"

namespace myoid::model {

/// A path as its geometry means it: length continuous where the geometry is, r = -dl/dq.
void compute_exact_path(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        PathWorkspace& workspace,
                        PathResult& result);

}  // namespace myoid::model
