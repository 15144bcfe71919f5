#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of inverse dynamics of a motion.
struct IdOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths and joints.
  std::string motion;                                       ///< Joint angles (.mot, .sto).
  std::optional<double> cutoff_hz;                          ///< Cut-off of the angles' smoothing, -3 dB.
  std::string speeds, accelerations;                        ///< In place of the motion's derivatives; empty: none.
  std::string loads;                                        ///< <ExternalLoads> (.xml); empty: none.
  HeldMass held;
  std::string out;  ///< File of `write_id`.
};
void visit(IdOptions& options, study::SettingVisitor& v);

struct IdResult {
  TimeSeries forces;  ///< A generalized force for each coordinate [N m, N].
  std::vector<Remark> remarks;
};

/// Throws InvalidInput for a held mass without a body, or for smoothing with given derivatives.
[[nodiscard]] IdResult id(const IdOptions& options);

/// Writes the forces as a storage file (.sto, .mot) or table (.csv).
void write_id(const IdResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
