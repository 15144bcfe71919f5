#pragma once

#include "myoid/model/path_stations.h"

namespace myoid::model {

/// Computes a path by the algorithm of OpenSim 4.5.2, with the defects that `model.compat` switches on.
void compute_opensim_path(const BodyModel& model,
                          const MusclePath& path,
                          const BodyState& state,
                          PathWorkspace& workspace,
                          PathResult& result);

}  // namespace myoid::model
