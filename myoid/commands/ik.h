#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/marker_misfit.h"

namespace myoid::commands {

/// Inverse kinematics of markers.
struct IkOptions {
  Call call;
  std::string model;                 ///< A file (.osim), or "arm4".
  std::string compat = "exact";      ///< Paths and joints: exact, or opensim.
  std::string markers;               ///< .trc, .c3d
  std::string up;                    ///< Of the laboratory: x, -y, ...; empty: as the file says.
  std::vector<std::string> weights;  ///< "MARKER=WEIGHT"; 1 where not given.
  std::vector<std::string> lock, unlock;  ///< Coordinates.
};

struct IkResult {
  model::BodyModel model;
  kinematics::IkResult solved;
  kinematics::MarkerMisfit misfit;
  std::vector<std::string> not_converged;  ///< Runs of frames, from 1: "12 to 15 (0.11 to 0.14 s)".
  std::vector<Remark> remarks;
};

[[nodiscard]] IkResult ik(const IkOptions& options);

/// The file of the marker errors that belongs to this motion file: NAME_marker_errors.sto.
[[nodiscard]] std::filesystem::path marker_errors_path(const std::filesystem::path& motion);

/// Writes the joint angles (.mot) and beside them the marker errors.
void write_ik(const IkResult& result, const std::filesystem::path& path);

}  // namespace myoid::commands
