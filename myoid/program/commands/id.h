#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/program/commands/call.h"

namespace myoid::program {

/// Options of inverse dynamics of a motion.
struct IdOptions {
  Call call;
  std::string model;                  ///< A file (.osim), or "arm4".
  std::string compat = "exact";       ///< Paths and joints: exact, or opensim.
  std::string motion;                 ///< Joint angles (.mot, .sto).
  double cutoff_hz = 0.0;             ///< Cut-off of the angles' smoothing, -3 dB; 0: none.
  std::string speeds, accelerations;  ///< In place of the motion's derivatives; empty: none.
  std::string loads;                  ///< <ExternalLoads> (.xml); empty: none.
  double held_mass_kg = 0.0;
  std::string held_body;                         ///< Empty: the hand of arm4, else no body.
  std::vector<double> held_at_m{0.0, 0.0, 0.0};  ///< Point on that body; for arm4's hand its grip.
};

struct IdResult {
  TimeSeries forces;  ///< A generalized force for each coordinate [N m, N].
  std::vector<Remark> remarks;
};

/// Throws InvalidInput for a held mass without a body, or for smoothing with given derivatives.
[[nodiscard]] IdResult id(const IdOptions& options);

/// Writes the forces as a storage file (.sto, .mot) or table (.csv).
void write_id(const IdResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
