#pragma once

#include <filesystem>
#include <string>

#include "myoid/cli/context.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid::cli {

/// Adds --compat to a command that loads a model.
void add_compat_option(CLI::App& command, Context& context);

/// A model from a file, or the built-in "arm4"; what it cannot do right is warned of.
[[nodiscard]] model::BodyModel load_model(const std::string& name, const Context& context);

/// Warns of the muscles whose exact path differs visibly (1 mm) from OpenSim's at random postures.
void warn_of_path_differences(const model::BodyModel& model,
                              const std::string& name,
                              const Context& context);

/// A motion file (.mot, .sto) as coordinates and two derivatives. `cutoff_hz` > 0 smooths. The
/// whole file is smoothed and differentiated, then cut to --start/--end: inside that time the
/// numbers are those of the whole file. Gaps of the clock are warned of.
[[nodiscard]] kinematics::JointMotion load_motion(const model::BodyModel& model,
                                                  const std::filesystem::path& path,
                                                  double cutoff_hz,
                                                  const Context& context);

/// The motion with the speeds and accelerations of these files, where they have the coordinate,
/// instead of the spline's derivatives; an empty path changes nothing. Their times must be those of
/// the motion's file. Throws ReadError otherwise.
[[nodiscard]] kinematics::JointMotion with_derivatives(kinematics::JointMotion motion,
                                                       const model::BodyModel& model,
                                                       const std::filesystem::path& speeds,
                                                       const std::filesystem::path& accelerations,
                                                       const Context& context);

/// An <ExternalLoads> file; what was mended is warned of, and a motion that goes beyond the data.
[[nodiscard]] dynamics::ExternalLoads load_external_loads(const model::BodyModel& model,
                                                          const std::filesystem::path& path,
                                                          const kinematics::JointMotion& motion,
                                                          const Context& context);

/// The series cut to --start/--end.
[[nodiscard]] TimeSeries cut(const TimeSeries& series, const Context& context);

}  // namespace myoid::cli
