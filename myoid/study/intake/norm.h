#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/study/study.h"

namespace myoid::study {

/// Mean and standard deviation of one quantity in a group of people.
struct NormCurve {
  std::string coordinate;
  bool torque = false;       ///< True: torque of the muscles [N m]; false: angle [deg].
  Eigen::VectorXd mean, sd;  ///< As many as Norm::percent.
};

/// Curves of a group of people over a movement, from its begin (0 %) to its end (100 %).
struct Norm {
  std::string name;                 ///< Name of the group, for legends.
  std::vector<std::string> trials;  ///< Empty: every movement.
  Eigen::VectorXd percent;          ///< Rising, 0 to 100.
  std::vector<NormCurve> curves;
};

/// Reads the table of a norm: a column `percent`, and for each quantity the columns `NAME_mean` and `NAME_sd`. NAME is
/// a coordinate of the study [deg, rad] or COORDINATE_moment [N m, N m/kg]; a unit may follow in brackets. Columns of
/// other coordinates are left out. Throws ReadError with the line for a missing column, a percent that does not rise
/// from 0 to 100, a cell that is not a number, a negative sd, an unknown unit, N m/kg without the person's mass, and a
/// table without any coordinate of the study.
[[nodiscard]] Norm read_norm(const NormSpec& spec, const Study& study);

}  // namespace myoid::study
