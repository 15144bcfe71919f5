#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of musculotendon lengths, velocities and moment arms along a motion.
struct PathsOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths.
  std::string motion;                                       ///< Joint angles (.mot, .sto).
  std::optional<double> cutoff_hz;                          ///< Cut-off of the angles' smoothing, -3 dB.
  /// File of fitted polynomials (.json) that replace paths; made if it is missing or belongs to
  /// another model. Empty: paths are computed.
  std::string surrogates;
  double tolerance_mm = 0.2;  ///< Error of lengths; of moment arms 5 times this per radian.
  bool check_jumps = false;   ///< Warns of jumps of a length or moment arm.
  std::string out;            ///< Folder of `write_paths`.
};
void visit(PathsOptions& options, study::SettingVisitor& v);

struct PathsResult {
  Eigen::Index samples = 0;
  body::MuscleKinematics muscles;
  std::vector<Remark> remarks;
};

/// Computes the paths. Writes the file of polynomials if it makes them, and no other file.
[[nodiscard]] PathsResult paths(const PathsOptions& options);

/// Initial parts of the names of the files that `write_paths` writes.
inline const std::vector<std::string_view> kPathsFiles{"MuscleAnalysis_"};

/// Writes MuscleAnalysis_*.sto.
void write_paths(const PathsResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
