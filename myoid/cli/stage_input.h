#pragma once

#include <filesystem>
#include <string>

#include "myoid/cli/context.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid::cli {

/// A model from a file, or the built-in "arm4"; what it cannot do right is warned of.
[[nodiscard]] model::BodyModel load_model(const std::string& name, const Context& context);

/// A motion file (.mot, .sto) as coordinates and two derivatives, cut to --start/--end. `cutoff_hz`
/// > 0 smooths.
[[nodiscard]] kinematics::JointMotion load_motion(const model::BodyModel& model,
                                                  const std::filesystem::path& path,
                                                  double cutoff_hz,
                                                  const Context& context);

/// The series cut to --start/--end.
[[nodiscard]] TimeSeries cut(const TimeSeries& series, const Context& context);

}  // namespace myoid::cli
