#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/forces/force_sharing.h"
#include "myoid/program/commands/call.h"

namespace myoid::program {

/// Options of static optimization: the muscle forces that produce the torques of a motion.
struct SoOptions {
  Call call;
  std::string model;                     ///< A file (.osim), or "arm4".
  std::string compat = "exact";          ///< Paths: exact, or opensim.
  bool compare_with_opensim = true;      ///< Warns of muscles whose exact path differs by 1 mm.
  std::string motion;                    ///< Joint angles (.mot, .sto).
  double cutoff_hz = 0.0;                ///< Cut-off of the angles' smoothing, -3 dB; 0: none.
  std::string objective = "activation";  ///< activation, force or stress.
  double exponent = 2.0;                 ///< Exponent of the sum, above 1.
  std::string emg;                       ///< Activations by muscle that the solution approaches (.sto).
  double emg_weight = 1.0;               ///< Weight of the distance from `emg`.
  double reserve_nm = 1.0;               ///< Optimal torque of each coordinate's reserve.
  std::vector<std::string> coordinates;  ///< Balanced by the muscles; empty: all free ones.
  std::string loads;                     ///< <ExternalLoads> (.xml); empty: none.
  std::string tendon = "rigid";          ///< rigid or elastic.
  bool passive = false;                  ///< Includes the fibers' springs and dampers.
};

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
