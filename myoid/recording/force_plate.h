#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// The side of a plate on which the person is. The defaults are the C3D guide's: z of the plate points away from the
/// person, and the channels hold the force on the person. `stand_plates` sets the true values.
struct PlateSide {
  Vec3 out_L = Vec3::UnitZ();  ///< Normal of the surface towards the person.
  bool is_floor = true;        ///< Within 60 degrees of horizontal; else wall or handle.
  double turn = 1.0;           ///< 1: the channels hold the force on the person; -1: the force on the plate;
                               ///< 0: they never change, and the plate is not used.
};

/// A plate as its file places it.
///
/// The plate's own frame P has its origin in the middle of the surface (mean of the corners), x
/// from corner 2 to 1, z = x × (corner 1 − corner 4), which points down in most laboratories.
struct PlateFrame {
  int number = 0;  ///< Counted from 1, as in the file.
  int type = 0;
  PlateSide side;
  Eigen::Matrix<double, 3, 4> corners_m;
  Mat3 R_GP = Mat3::Identity();
  Vec3 p_GP_m = Vec3::Zero();  ///< Middle of the surface.
  std::vector<Eigen::Index> channels;
};

/// One force plate over time, in the laboratory's frame, at the rate of the analog channels. Force
/// and moment are the plate's action on the person: the channels times `side.turn`.
struct ForcePlate : PlateFrame {
  Eigen::VectorXd time_s;
  Eigen::MatrixXd force_n;    ///< Samples x 3.
  Eigen::MatrixXd moment_nm;  ///< Moment about the middle of the surface.
  /// Point where the line of force cuts the surface: x = −M_y/F_z, y = M_x/F_z in P. NaN where
  /// |F_z| is below `kLeastForce_n`.
  Eigen::MatrixXd pressure_center_m;
  Eigen::MatrixXd free_moment_nm;  ///< Moment about the normal through that point; 0 without a center of pressure.
};

/// The parameters in FORCE_PLATFORM that turn a plate's channels into a force.
struct PlateSetup : PlateFrame {
  Vec3 origin_m = Vec3::Zero();
  std::vector<double> factors;  ///< For each channel: the factor from the unit as written to SI.
  Eigen::Matrix<double, 6, 6> calibration = Eigen::Matrix<double, 6, 6>::Identity();
  double to_m = 1.0;            ///< Factor of POINT:UNITS to meters.
  double calibrated_to_nm = 1;  ///< Type 4: factor of the calibrated moments to N m.
  /// For each channel its mean [as written] while the plate is empty, which is subtracted; no numbers: nothing is.
  Eigen::VectorXd baseline;
};

inline constexpr double kLeastForce_n = 10.0;  ///< A smaller force has no center.

/// Reads the plates of types 1 to 4 that FORCE_PLATFORM describes:
///
/// - 1: F_x F_y F_z, p_x p_y, T_z: center of pressure and free moment as measured.
/// - 2: F_x F_y F_z M_x M_y M_z about the transducer; M_surface = M − o × F with ORIGIN o.
/// - 3: F_x12 F_x34 F_y14 F_y23 F_z1..F_z4: eight sensors; ORIGIN = a, b, a_z0.
/// - 4: as 2 after F = CAL_MATRIX V.
///
/// Other types and plates with impossible corners or channels are left out with a note; a and b
/// below 0 are taken as positive with a note. Forces in volts or without a unit are taken as N, and
/// moments as N times POINT:UNITS, with a note. Corners and ORIGIN that are 1,000 times too large or too small for a
/// plate in POINT:UNITS are taken as mm or m, with a note. Source: the C3D user guide, force plate types.
[[nodiscard]] std::vector<PlateSetup> plate_setups(const C3dFile& file, std::vector<Repair>& repairs);

/// Returns the channels in SI after the baseline; those of type 4 are the calibrated forces and moments.
[[nodiscard]] Eigen::MatrixXd plate_channels_si(const PlateSetup& setup, Eigen::MatrixXd channel_values);

/// Inverts an ORIGIN that does not point from the transducer to the person's side of the surface, with a note.
void turn_origin(PlateSetup& setup, std::vector<Repair>& repairs);

/// Returns the force [N] in the laboratory for each row of channels in the unit as written, with
/// the sign of the channels.
[[nodiscard]] Eigen::MatrixX3d channel_forces(const PlateSetup& setup, Eigen::MatrixXd channel_values);

/// Returns the plate over time from its channels (samples x channels) in the unit as written.
[[nodiscard]] ForcePlate force_plate(const PlateSetup& setup, Eigen::VectorXd time_s, Eigen::MatrixXd channel_values);

/// A plate's action on the person in one sample: force, a point on its line, and the moment about the point.
struct PlateAction {
  Vec3 force_n, point_m, moment_nm;
};

/// Returns the action of a plate that bears the person; empty if the plate bears nothing or a channel is no number. A
/// floor bears where the force along the normal reaches the threshold; its force acts at the center of pressure. A wall
/// or a handle bears where the whole force reaches the threshold; if its center of pressure is outside the corners, its
/// force acts at the middle of the surface.
[[nodiscard]] std::optional<PlateAction> action_on_person(const ForcePlate& plate,
                                                          Eigen::Index sample,
                                                          double least_force_n);

}  // namespace myoid::recording
