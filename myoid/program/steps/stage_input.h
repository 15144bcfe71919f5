#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/call.h"

namespace myoid::program {

/// Warns of the repairs and omissions of a file's reader.
void warn_of_repairs(const std::filesystem::path& path, const std::vector<Repair>& repairs, Remarks& remarks);

/// Loads a model from a file, or the built-in "arm4", with the paths that `compat` names.
/// Remarks name elements that are not supported.
[[nodiscard]] body::BodyModel load_model(const std::string& name, body::Compatibility compat, Remarks& remarks);

/// Warns of the muscles whose exact path differs visibly (1 mm) from OpenSim's at random postures.
void warn_of_path_differences(const body::BodyModel& model, const std::string& name, Remarks& remarks);

/// Returns the rotation of a marker file's laboratory onto the model's: by `up` ("z", "-y"); if
/// `up` is empty by the vertical of the file (`trial_up`), with a note; else none.
[[nodiscard]] Mat3 onto_model(const body::BodyModel& model,
                              const std::string& markers,
                              const std::string& up,
                              Remarks& remarks);

/// Reads a motion file (.mot, .sto) as coordinates with two derivatives. `cutoff_hz` smooths.
/// The whole file is smoothed and differentiated, then cut to the call's time, so that the numbers
/// do not depend on the cut. Warns of gaps of the clock, and of locked and prescribed coordinates that move otherwise.
[[nodiscard]] body::JointMotion load_motion(const body::BodyModel& model,
                                            const std::filesystem::path& path,
                                            std::optional<double> cutoff_hz,
                                            const Call& call,
                                            Remarks& remarks,
                                            body::HeldValues held = body::HeldValues::of_motion);

/// A model and its motion.
struct MovedModel {
  body::BodyModel model;
  body::JointMotion motion;
};
/// Loads a model, warns of its paths that differ from OpenSim's, and reads its motion, with held coordinates as the
/// model has them.
[[nodiscard]] MovedModel load_moved_model(const std::string& model,
                                          body::Compatibility compat,
                                          const std::filesystem::path& motion,
                                          std::optional<double> cutoff_hz,
                                          const Call& call,
                                          Remarks& remarks);

/// Replaces the spline's derivatives of a motion by the speeds and accelerations in these files, for the coordinates
/// that they have; an empty path changes nothing. Throws ReadError unless their times equal those of the motion's file.
[[nodiscard]] body::JointMotion with_derivatives(body::JointMotion motion,
                                                 const body::BodyModel& model,
                                                 const std::filesystem::path& speeds,
                                                 const std::filesystem::path& accelerations,
                                                 const Call& call,
                                                 Remarks& remarks);

/// Reads an <ExternalLoads> file. Warns of repairs, and of a motion that goes beyond the data.
[[nodiscard]] body::ExternalLoads load_external_loads(const body::BodyModel& model,
                                                      const std::filesystem::path& path,
                                                      const body::JointMotion& motion,
                                                      Remarks& remarks);

/// Cuts the series to the call's time. Throws InvalidInput if no sample lies in that time.
[[nodiscard]] TimeSeries cut(const TimeSeries& series, const Call& call);
[[nodiscard]] MarkerSeries cut(MarkerSeries markers, const Call& call);

}  // namespace myoid::program
