#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/forces/muscle_sweep.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of muscles over one coordinate, the others at their defaults (`paths --sweep`).
struct SweepOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths.
  /// "elbow_flexion" for its range, or "elbow_flexion=0:130", in degrees; meters for a translation.
  std::string coordinate;
  std::vector<std::string> muscles;  ///< Names; empty: all whose moment arm is 0.1 mm somewhere.
  std::string out;                   ///< Folder of `write_sweep`.
};
/// Visits the options that `paths --sweep` has beside or in place of those of a motion.
void visit(SweepOptions& options, study::SettingVisitor& v);

struct SweepResult {
  std::string model, coordinate;
  bool is_angle = true;
  std::vector<body::SweptMuscle> muscles;  ///< In the model's order.
  std::vector<Remark> remarks;
};

/// Number of steps from end to end of the range.
inline constexpr int kSweepSteps = 100;

/// Throws InvalidInput for an unknown or held coordinate, an empty range, an unknown muscle, and for a coordinate that
/// a closed loop of the model binds to others.
[[nodiscard]] SweepResult sweep(const SweepOptions& options);

/// Initial parts of the names of the files that `write_sweep` writes.
inline const std::vector<std::string_view> kSweepFiles{"sweep_"};

/// Writes sweep_<coordinate>.csv, a row for each muscle and value in SI units and degrees, and the same as a picture,
/// sweep_<coordinate>.svg. Returns both.
std::vector<std::filesystem::path> write_sweep(const SweepResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
