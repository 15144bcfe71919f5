#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// A subject file of CEINMS (muscles in <mtuSet>, pennation in radians unless its unit is "deg") or of CEINMS-RT
/// (muscles in <muscles>, pennation in degrees).
struct CeinmsSubject {
  std::filesystem::path path = {};
  Dialect dialect = Dialect::ceinms;
  bool says_calibrated = false;                  ///< <calibrationInfo> says so; CEINMS-RT has none.
  std::string start_file = {}, model_file = {};  ///< As the file names them; empty: not named.
  CommonNumbers common = {};
  std::vector<ProjectCurve> curves = {};
  std::vector<ProjectMuscle> muscles = {};  ///< With values alone; in CEINMS-RT with inputs.
  std::vector<ProjectDof> dofs = {};
  bool has_channels = false;  ///< The file has <Channels>: those muscles that no channel names have no EMG.
  std::vector<Remark> remarks = {};
};

/// Reads a subject file. A muscle that several channels of CEINMS-RT name takes their mean. Throws ReadError with the
/// line for a file without muscles, a muscle without name, length or force or of a name that another has, a length or
/// force that is not positive, a number that is none or not finite, and a curve whose points do not fit.
[[nodiscard]] CeinmsSubject read_ceinms_subject(const std::filesystem::path& path);

/// Returns the quantity that an element of a muscle of CEINMS holds, as parameters of its calibration name it.
[[nodiscard]] std::optional<MuscleQuantity> ceinms_quantity(std::string_view element);

/// Returns a project of this subject alone.
[[nodiscard]] Project project_of(CeinmsSubject subject);

}  // namespace myoid::opensim
