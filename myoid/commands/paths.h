#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/kinematics/muscle_kinematics.h"

namespace myoid::commands {

/// Musculotendon lengths, velocities and moment arms along a motion.
struct PathsOptions {
  Call call;
  std::string model;                 ///< A file (.osim), or "arm4".
  std::string compat = "exact";      ///< Paths: exact, or opensim.
  bool compare_with_opensim = true;  ///< Warn of muscles whose exact path differs by 1 mm.
  std::string motion;                ///< Joint angles (.mot, .sto).
  double cutoff_hz = 0.0;            ///< Angles are smoothed, -3 dB here; 0: not at all.
  /// File of fitted polynomials (.json) in the place of paths; made where it is not there or
  /// belongs to another model. Empty: paths are computed.
  std::string surrogates;
  double tolerance_mm = 0.2;  ///< Of their lengths; of moment arms five times that a radian.
  bool check_jumps = false;   ///< Warn where a length or moment arm jumps.
};

struct PathsResult {
  Eigen::Index samples = 0;
  kinematics::MuscleKinematics muscles;
  std::vector<Remark> remarks;
};

/// Writes the file of polynomials where it makes them, and nothing else.
[[nodiscard]] PathsResult paths(const PathsOptions& options);

/// Beginnings of the names of the files that `write_paths` writes.
inline const std::vector<std::string_view> kPathsFiles{"MuscleAnalysis_"};

/// Writes MuscleAnalysis_*.sto.
void write_paths(const PathsResult& result, const std::filesystem::path& folder);

}  // namespace myoid::commands
