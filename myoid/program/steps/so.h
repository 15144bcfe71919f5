#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/forces/force_sharing.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of static optimization: the muscle forces that produce the torques of a motion.
struct SoOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths.
  std::string motion;                                       ///< Joint angles (.mot, .sto).
  std::optional<double> cutoff_hz;                          ///< Cut-off of the angles' smoothing, -3 dB.
  body::SharingObjective objective = body::SharingObjective::activation;
  double exponent = 2.0;                 ///< Exponent of the sum, above 1.
  std::string emg;                       ///< Activations by muscle that the solution approaches (.sto).
  double emg_weight = 1.0;               ///< Weight of the distance from `emg`.
  double reserve_nm = 1.0;               ///< Optimal torque of each coordinate's reserve.
  std::vector<std::string> coordinates;  ///< Balanced by the muscles; empty: all free ones.
  std::string loads;                     ///< <ExternalLoads> (.xml); empty: none.
  bool elastic_tendon = false;           ///< Fiber and tendon in balance, in every frame for itself.
  bool passive = false;                  ///< Includes the fibers' springs and dampers.
  std::string out;                       ///< Folder of `write_so`.
};
void visit(SoOptions& options, study::SettingVisitor& v);

struct SoResult {
  body::MuscleForces shared;
  std::vector<Remark> remarks;
};

[[nodiscard]] SoResult so(const SoOptions& options);

/// Initial parts of the names of the files that `write_so` writes.
inline const std::vector<std::string_view> kSoFiles{"StaticOptimization_"};

/// Writes StaticOptimization_force.sto, _activation.sto and _status.csv.
void write_so(const SoResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
