#pragma once

#include "myoid/model/path_stations.h"

namespace myoid::model {

/// A path as OpenSim 4.5.2 computes it, with the defects that `model.compat` switches on.
void compute_opensim_path(const BodyModel& model,
                          const MusclePath& path,
                          const BodyState& state,
                          PathWorkspace& workspace,
                          PathResult& result);

}  // namespace myoid::model
