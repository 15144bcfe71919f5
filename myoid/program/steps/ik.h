#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of inverse kinematics of markers.
struct IkOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths and joints.
  std::string markers;                                      ///< .trc, .c3d
  std::string up;                         ///< Vertical of the laboratory: x, -y, ...; empty: as the file states.
  std::vector<std::string> weights;       ///< "MARKER=WEIGHT"; 1 for other markers.
  std::vector<std::string> lock, unlock;  ///< Coordinates.
  std::string out;                        ///< File of `write_ik`.
};
void visit(IkOptions& options, study::SettingVisitor& v);

struct IkResult {
  body::BodyModel model;
  body::IkResult solved;
  body::MarkerMisfit misfit;
  std::vector<std::string> not_converged;  ///< Runs of frames, from 1: "12 to 15 (0.11 to 0.14 s)".
  std::vector<Remark> remarks;
};

[[nodiscard]] IkResult ik(const IkOptions& options);

/// The begin of the file of the marker errors.
inline constexpr std::string_view kMarkerErrorsBegin = "Model Marker Errors from IK\n";
/// Returns the file of the marker errors for this motion file: NAME_marker_errors.sto.
[[nodiscard]] std::filesystem::path marker_errors_path(const std::filesystem::path& motion);

/// Writes the joint angles (.mot) and the marker errors in a second file.
void write_ik(const IkResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
