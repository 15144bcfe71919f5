#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "myoid/core/geometry.h"
#include "myoid/recording/c3d_file.h"

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

/// One second at 100 frames and 1000 samples a second of one plate of type 1, 2, 3 or 4 under
/// `PlateLoad`, its middle at (0.4, 1.2, 0.05) m. Every type's channels are made from first
/// principles: what its sensors feel.
inline recording::C3dFile plate_recording(int type) {
  using recording::C3dType;
  const Vec3 middle_L(0.4, 1.2, 0.05);
  const Mat3 R_LP = (Mat3() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished();
  const double a_m = 0.15;  // type 3: sensors at (+-a, +-b)
  const double b_m = 0.25;
  // Type 3: the sensors lie at depth ORIGIN z; else from the transducer to the surface.
  const Vec3 origin_P = type == 3 ? Vec3(a_m, b_m, -0.045) : Vec3(0.001, -0.002, -0.04);
  recording::C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.analog_per_frame = 10;
  const Eigen::Index samples = 1010;
  file.points.resize(samples / 10, 4);
  file.point_labels = {"M"};
  for (Eigen::Index k = 0; k < file.points.rows(); ++k)
    file.points.row(k) << 1.0F, 2.0F, 3.0F, 0.0F;
  std::vector<std::pair<const char*, const char*>> names;
  if (type == 1)
    names = {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"px", "mm"}, {"py", "mm"}, {"Tz", "Nmm"}};
  if (type == 2)
    names = {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"Mx", "Nmm"}, {"My", "Nmm"}, {"Mz", "Nmm"}};
  if (type == 3)
    names = {{"Fx12", "N"}, {"Fx34", "N"}, {"Fy14", "N"}, {"Fy23", "N"},
             {"Fz1", "N"},  {"Fz2", "N"},  {"Fz3", "N"},  {"Fz4", "N"}};
  if (type == 4)
    names = {{"V1", "V"}, {"V2", "V"}, {"V3", "V"}, {"V4", "V"}, {"V5", "V"}, {"V6", "V"}};
  for (const auto& [name, unit] : names) file.channels.push_back({name, unit, 0.0, 1.0});
  Eigen::Matrix<double, 6, 6> calibration = Eigen::Matrix<double, 6, 6>::Identity() * 500.0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j)
      calibration(i, j) += 0.7 * static_cast<double>(i) - 0.3 * static_cast<double>(j * j);
  }
  file.analog.resize(samples, static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / 1000.0;
    const Vec3 f = R_LP.transpose() * PlateLoad::force_n(t);
    const Vec3 p = R_LP.transpose() * (PlateLoad::point_m(t) - middle_L);
    const Vec3 twist = R_LP.transpose() * Vec3(0, 0, PlateLoad::free_nm(t));
    Eigen::VectorXd v(static_cast<Eigen::Index>(names.size()));
    if (type == 1) {
      v << f, 1000.0 * p.x(), 1000.0 * p.y(), 1000.0 * twist.z();
    } else if (type == 3) {
      // Moments about the point between the sensors; F_z of (a,b), (-a,b), (-a,-b), (a,-b).
      const Vec3 m = (Vec3(0, 0, origin_P.z()) + p).cross(f) + twist;
      const double fz = f.z() / 4.0;
      const double mx = m.x() / (4.0 * b_m);
      const double my = m.y() / (4.0 * a_m);
      const double dx = 5.0;  // any split between the two pairs that bear M_z
      const double dy = (m.z() + 2.0 * b_m * dx) / (2.0 * a_m);
      v << f.x() / 2 + dx, f.x() / 2 - dx, f.y() / 2 + dy, f.y() / 2 - dy, fz + mx - my,
          fz + mx + my, fz - mx + my, fz - mx - my;
    } else {
      const Vec3 m = (origin_P + p).cross(f) + twist;
      v << f, 1000.0 * m;
      if (type == 4) v = calibration.partialPivLu().solve(v).eval();
    }
    file.analog.row(i) = v.cast<float>().transpose();
  }
  const auto numbers = [](const char* name, C3dType kind, std::vector<std::uint8_t> dimensions,
                          std::vector<double> values) {
    recording::C3dParameter p;
    p.name = name;
    p.type = kind;
    p.dimensions = std::move(dimensions);
    p.numbers = std::move(values);
    return p;
  };
  std::vector<double> corners;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec3 corner = middle_L + R_LP * Vec3(0.3 * x, 0.2 * y, 0.0);
    for (const double value : corner) corners.push_back(1000.0 * value);
  }
  std::vector<double> channels;
  for (std::size_t c = 1; c <= names.size(); ++c) channels.push_back(static_cast<double>(c));
  const auto count = static_cast<std::uint8_t>(names.size());
  recording::C3dGroup group{.id = 1, .name = "FORCE_PLATFORM"};
  group.parameters = {
      numbers("USED", C3dType::integer, {}, {1}),
      numbers("TYPE", C3dType::integer, {1}, {static_cast<double>(type)}),
      numbers("CORNERS", C3dType::real, {3, 4, 1}, corners),
      numbers("ORIGIN", C3dType::real, {3, 1},
              {1000.0 * origin_P.x(), 1000.0 * origin_P.y(), 1000.0 * origin_P.z()}),
      numbers("CHANNEL", C3dType::integer, {count, 1}, channels)};
  if (type == 4)
    group.parameters.push_back(
        numbers("CAL_MATRIX", C3dType::real, {6, 6, 1},
                {calibration.data(), calibration.data() + calibration.size()}));
  file.groups = {group};
  return file;
}

}  // namespace myoid::test
