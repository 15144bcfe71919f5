#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "myoid/ground/core/geometry.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::test {

/// A load on a force plate, known in closed form, in a laboratory whose z points up: force on the
/// person, where it acts on the surface, and the free moment about the plate's normal.
struct PlateLoad {
  static Vec3 force_n(double t) {
    return {40.0 * std::sin(3.0 * t), -25.0 + 10.0 * t, 620.0 + 80.0 * std::cos(4.0 * t)};
  }
  static Vec3 point_m(double t) { return {0.43 + 0.02 * t, 1.18 - 0.01 * std::sin(5.0 * t), 0.05}; }
  static double free_nm(double t) { return 7.5 - 3.0 * t; }
};

/// How a plate and its laboratory are written down. The physics is that of `PlateLoad`, turned.
struct PlateCase {
  int type = 2;
  Mat3 R_LZ = Mat3::Identity();          ///< From the laboratory of `PlateLoad` to that of the file.
  int first_corner = 0;                  ///< The corner that the file names first, 0 to 3.
  bool reversed = false;                 ///< The corners go the other way round.
  bool on_plate = false;                 ///< The file holds the force on the plate.
  std::string screen;                    ///< POINT:Y_SCREEN, if not empty.
  int markers = 1;                       ///< "M", "M2", ... 10 mm apart.
  Vec3 marker_Z_m{0.001, 0.002, 0.003};  ///< Of the first one, in `PlateLoad`'s laboratory.
  bool loaded = true;
  std::vector<double> channel_order;  ///< Of FORCE_PLATFORM:CHANNEL, the first ones.
};

/// A laboratory whose axis 'x', 'y' or 'z' points up in place of z.
inline Mat3 laboratory_with_up(char up) {
  if (up == 'x') return (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  if (up == 'y') return (Mat3() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();
  return Mat3::Identity();
}

inline recording::C3dParameter c3d_numbers(const char* name,
                                           recording::C3dType kind,
                                           std::vector<std::uint8_t> dimensions,
                                           std::vector<double> values) {
  recording::C3dParameter p;
  p.name = name;
  p.type = kind;
  p.dimensions = std::move(dimensions);
  p.numbers = std::move(values);
  return p;
}

inline recording::C3dParameter c3d_text(const char* name, const std::string& text) {
  recording::C3dParameter p;
  p.name = name;
  p.type = recording::C3dType::text;
  p.dimensions = {static_cast<std::uint8_t>(text.size())};
  p.text = text;
  return p;
}

inline std::vector<std::pair<const char*, const char*>> plate_channels(int type) {
  if (type == 1) return {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"px", "mm"}, {"py", "mm"}, {"Tz", "Nmm"}};
  if (type == 2) return {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"Mx", "Nmm"}, {"My", "Nmm"}, {"Mz", "Nmm"}};
  if (type == 3)
    return {{"Fx12", "N"}, {"Fx34", "N"}, {"Fy14", "N"}, {"Fy23", "N"},
            {"Fz1", "N"},  {"Fz2", "N"},  {"Fz3", "N"},  {"Fz4", "N"}};
  return {{"V1", "V"}, {"V2", "V"}, {"V3", "V"}, {"V4", "V"}, {"V5", "V"}, {"V6", "V"}};
}

/// CAL_MATRIX of type 4 [N/V, N mm/V], with some crosstalk.
inline Eigen::Matrix<double, 6, 6> plate_calibration() {
  Eigen::Matrix<double, 6, 6> calibration = Eigen::Matrix<double, 6, 6>::Zero();
  calibration.diagonal() << 500, 500, 500, 50000, 50000, 50000;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j)
      calibration(i, j) += 0.7 * static_cast<double>(i) - 0.3 * static_cast<double>(j * j);
  }
  return calibration;
}

/// One second at 100 frames and 1000 samples a second of one plate of type 1, 2, 3 or 4 under `PlateLoad`, its middle
/// at (0.4, 1.2, 0.05) m. Every type's channels are made from first principles: what its sensors feel, in the frame
/// that the corners give by the C3D guide (x from corner 2 to 1, y from 4 to 1), with the transducer below the surface.
inline recording::C3dFile plate_recording(const PlateCase& c) {
  using recording::C3dType;
  const Vec3 middle_Z(0.4, 1.2, 0.05);
  const std::array<Vec3, 4> rectangle{middle_Z + Vec3(0.2, 0.3, 0), middle_Z + Vec3(0.2, -0.3, 0),
                                      middle_Z + Vec3(-0.2, -0.3, 0), middle_Z + Vec3(-0.2, 0.3, 0)};
  Eigen::Matrix<double, 3, 4> corners_L;
  for (int k = 0; k < 4; ++k)
    corners_L.col(k) = c.R_LZ * rectangle[static_cast<std::size_t>((c.first_corner + (c.reversed ? 4 - k : k)) % 4)];
  Mat3 R_LP;
  R_LP.col(0) = (corners_L.col(0) - corners_L.col(1)).normalized();
  R_LP.col(1) = (corners_L.col(0) - corners_L.col(3)).normalized();
  R_LP.col(2) = R_LP.col(0).cross(R_LP.col(1));
  const Mat3 R_PZ = R_LP.transpose() * c.R_LZ;
  const double a_m = 0.15;  // type 3: sensors at (+-a, +-b)
  const double b_m = 0.25;
  const Vec3 transducer_to_surface_P = R_PZ * Vec3(0.001, -0.002, 0.04);
  const double down = R_PZ(2, 2);  // 1 where z of the plate points up
  const Vec3 origin_P = c.type == 3 ? Vec3(a_m, b_m, 0.045 * down) : transducer_to_surface_P;
  recording::C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.analog_per_frame = 10;
  const Eigen::Index samples = 1010;
  file.points.resize(samples / 10, 4 * c.markers);
  for (int m = 0; m < c.markers; ++m) {
    file.point_labels.push_back(m == 0 ? "M" : "M" + std::to_string(m + 1));
    const Vec3 at_mm = 1000.0 * (c.R_LZ * (c.marker_Z_m + 0.01 * m * Vec3::UnitX()));
    for (Eigen::Index k = 0; k < file.points.rows(); ++k)
      file.points.row(k).segment(4 * m, 4) << at_mm.cast<float>().transpose(), 0.0F;
  }
  const auto names = plate_channels(c.type);
  for (const auto& [name, unit] : names) file.channels.push_back({name, unit, 0.0, 1.0});
  const Eigen::Matrix<double, 6, 6> calibration = plate_calibration();
  file.analog.resize(samples, static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / 1000.0;
    const double sign = c.loaded ? (c.on_plate ? -1.0 : 1.0) : 0.0;
    const Vec3 f = sign * (R_PZ * PlateLoad::force_n(t));
    const Vec3 p = R_PZ * (PlateLoad::point_m(t) - middle_Z);
    const Vec3 twist = sign * (R_PZ * Vec3(0, 0, PlateLoad::free_nm(t)));
    Eigen::VectorXd v(static_cast<Eigen::Index>(names.size()));
    if (c.type == 1) {
      v << f, 1000.0 * p.x(), 1000.0 * p.y(), 1000.0 * twist.z();
    } else if (c.type == 3) {
      // Moments about the point between the sensors; F_z of (a,b), (-a,b), (-a,-b), (a,-b).
      const Vec3 m = (Vec3(0, 0, origin_P.z()) + p).cross(f) + twist;
      const double fz = f.z() / 4.0;
      const double mx = m.x() / (4.0 * b_m);
      const double my = m.y() / (4.0 * a_m);
      const double dx = 5.0;  // any split between the two pairs that bear M_z
      const double dy = (m.z() + 2.0 * b_m * dx) / (2.0 * a_m);
      v << f.x() / 2 + dx, f.x() / 2 - dx, f.y() / 2 + dy, f.y() / 2 - dy, fz + mx - my, fz + mx + my, fz - mx + my,
          fz - mx - my;
    } else {
      const Vec3 m = (origin_P + p).cross(f) + twist;
      v << f, 1000.0 * m;
      if (c.type == 4) v = calibration.partialPivLu().solve(v).eval();
    }
    file.analog.row(i) = v.cast<float>().transpose();
  }
  std::vector<double> corners;
  for (const double value : corners_L.reshaped()) corners.push_back(1000.0 * value);
  std::vector<double> channels = c.channel_order;
  for (std::size_t k = channels.size() + 1; k <= names.size(); ++k) channels.push_back(static_cast<double>(k));
  const auto count = static_cast<std::uint8_t>(names.size());
  recording::C3dGroup group{.id = 1, .name = "FORCE_PLATFORM"};
  group.parameters = {c3d_numbers("USED", C3dType::integer, {}, {1}),
                      c3d_numbers("TYPE", C3dType::integer, {1}, {static_cast<double>(c.type)}),
                      c3d_numbers("CORNERS", C3dType::real, {3, 4, 1}, corners),
                      c3d_numbers("ORIGIN", C3dType::real, {3, 1},
                                  {1000.0 * origin_P.x(), 1000.0 * origin_P.y(), 1000.0 * origin_P.z()}),
                      c3d_numbers("CHANNEL", C3dType::integer, {count, 1}, channels)};
  if (c.type == 4)
    group.parameters.push_back(c3d_numbers("CAL_MATRIX", C3dType::real, {6, 6, 1},
                                           {calibration.data(), calibration.data() + calibration.size()}));
  file.groups = {group};
  if (!c.screen.empty()) {
    recording::C3dGroup point{.id = 2, .name = "POINT"};
    point.parameters = {c3d_text("Y_SCREEN", c.screen)};
    file.groups.push_back(point);
  }
  return file;
}
inline recording::C3dFile plate_recording(int type) {
  PlateCase plate;
  plate.type = type;
  return plate_recording(plate);
}

}  // namespace myoid::test
