#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/core/geometry.h"
#include "myoid/recording/c3d_file.h"

namespace myoid::recording {

/// One force plate over time, in the laboratory's frame, at the rate of the analog channels. Force
/// and moment have the sign of the recording: nearly always the plate's action on the person, which
/// points up while somebody stands on it (`force_sign` finds out).
///
/// The plate's own frame P has its origin in the middle of the surface (mean of the corners), x
/// from corner 2 to 1, z = x × (corner 1 − corner 4), which points down in most laboratories.
struct ForcePlate {
  int number = 0;  ///< Counts from 1, as in the file.
  int type = 0;
  Eigen::Matrix<double, 3, 4> corners_m;
  Mat3 R_GP = Mat3::Identity();
  Vec3 p_GP_m = Vec3::Zero();  ///< Middle of the surface.
  std::vector<Eigen::Index> channels;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd force_n;    ///< Samples x 3.
  Eigen::MatrixXd moment_nm;  ///< About the middle of the surface.
  /// Where the force cuts the surface: x = −M_y/F_z, y = M_x/F_z in P. NaN where |F_z| is below the
  /// threshold.
  Eigen::MatrixXd pressure_center_m;
  Eigen::MatrixXd free_moment_nm;  ///< About the normal through that point; 0 where there is none.
};

/// What FORCE_PLATFORM says about one plate: how its channels become a force.
struct PlateSetup {
  int number = 0;
  int type = 0;
  Eigen::Matrix<double, 3, 4> corners_m;
  Mat3 R_GP = Mat3::Identity();
  Vec3 p_GP_m = Vec3::Zero();
  Vec3 origin_m = Vec3::Zero();
  std::vector<Eigen::Index> channels;
  std::vector<double> factors;  ///< Of each channel, from the unit as written to SI.
  Eigen::Matrix<double, 6, 6> calibration = Eigen::Matrix<double, 6, 6>::Identity();
  double to_m = 1.0;  ///< POINT:UNITS.
};

inline constexpr double kLeastForce_n = 10.0;  ///< Below it there is no center of pressure.

/// The plates of types 1 to 4 that FORCE_PLATFORM describes:
///
/// - 1: F_x F_y F_z, p_x p_y, T_z: center of pressure and free moment as measured.
/// - 2: F_x F_y F_z M_x M_y M_z about the transducer; M_surface = M − o × F with ORIGIN o.
/// - 3: F_x12 F_x34 F_y14 F_y23 F_z1..F_z4: eight sensors; ORIGIN = a, b, a_z0.
/// - 4: as 2 after F = CAL_MATRIX V.
///
/// Other types and plates whose corners or channels make no sense are left out with a note; an
/// ORIGIN below the surface (z > 0) is turned round with a note, and so is a and b below 0. Forces
/// in volts or without a unit are taken as N and moments as N times POINT:UNITS, with a note.
/// Source: the C3D user guide, force plate types.
[[nodiscard]] std::vector<PlateSetup> plate_setups(const C3dFile& file,
                                                   std::vector<Repair>& repairs);

/// The plate over time, from its channels in the unit as written (samples x channels).
/// `least_force_n` is the threshold of the center of pressure.
[[nodiscard]] ForcePlate force_plate(const PlateSetup& setup,
                                     Eigen::VectorXd time_s,
                                     Eigen::MatrixXd channel_values,
                                     double least_force_n = kLeastForce_n);
/// From the samples [first, first + count) of the file that describes it.
[[nodiscard]] ForcePlate force_plate(const PlateSetup& setup,
                                     const C3dFile& file,
                                     Eigen::Index first,
                                     Eigen::Index count,
                                     double least_force_n = kLeastForce_n);

/// Only the size of the force [N] of each row of channels in the unit as written.
[[nodiscard]] Eigen::VectorXd force_sizes(const PlateSetup& setup, Eigen::MatrixXd channel_values);

/// All plates of a file over all of its time.
[[nodiscard]] std::vector<ForcePlate> force_plates(const C3dFile& file,
                                                   std::vector<Repair>& repairs,
                                                   double least_force_n = kLeastForce_n);

/// +1 if the plate's largest force points along `up_G`, as a person on it is pushed; −1 if the file
/// holds the force on the plate; 0 if no force reaches `least_force_n`.
[[nodiscard]] int force_sign(const ForcePlate& plate,
                             const Vec3& up_G,
                             double least_force_n = 10.0);

}  // namespace myoid::recording
