#include "myoid/recording/force_plate.h"

#include <cmath>
#include <filesystem>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_reader.h"

#include "tests/support/c3d_plates.h"
#include "tests/support/data_folder.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

using Eigen::VectorXd;

// A plate of 0.6 m x 0.4 m in the laboratory, z of the plate down, and a load on it.
const Vec3 kCenter(1.0, 2.0, 0.1);
const Mat3 kR = (Mat3() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished();
const Vec3 kForce(30.0, -20.0, -700.0);  // in the plate's frame: pushes up
const Vec3 kPoint(0.12, -0.07, 0.0);
constexpr double kTwist = 4.0;
const Vec3 kOrigin(0.002, -0.003, -0.045);  // from the transducer to the surface

C3dParameter numbers(std::string name, C3dType type, std::vector<double> values, std::vector<std::uint8_t> dimensions) {
  return {.name = std::move(name), .type = type, .dimensions = std::move(dimensions), .numbers = std::move(values)};
}

/// One sample of the plate whose channels hold `values`, lengths in mm.
C3dFile plate_file(int type,
                   const VectorXd& values,
                   const Vec3& origin_m,
                   const std::vector<std::string>& units,
                   std::vector<double> calibration = {}) {
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.points.resize(1, 0);
  file.analog = values.transpose().cast<float>();
  std::vector<double> channel;
  for (Eigen::Index c = 0; c < values.size(); ++c) {
    file.channels.push_back({"ch" + std::to_string(c + 1), units[static_cast<std::size_t>(c)]});
    channel.push_back(static_cast<double>(c + 1));
  }
  std::vector<double> corners;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec3 corner = kCenter + kR * Vec3(0.3 * x, 0.2 * y, 0.0);
    for (const double v : corner) corners.push_back(1000.0 * v);
  }
  C3dGroup group{.id = 1, .name = "FORCE_PLATFORM"};
  const auto wide = static_cast<std::uint8_t>(values.size());
  group.parameters = {
      numbers("USED", C3dType::integer, {1}, {}),
      numbers("TYPE", C3dType::integer, {static_cast<double>(type)}, {1}),
      numbers("CORNERS", C3dType::real, corners, {3, 4, 1}),
      numbers("ORIGIN", C3dType::real, {1e3 * origin_m.x(), 1e3 * origin_m.y(), 1e3 * origin_m.z()}, {3, 1}),
      numbers("CHANNEL", C3dType::integer, channel, {wide, 1}),
  };
  if (!calibration.empty()) group.parameters.push_back(numbers("CAL_MATRIX", C3dType::real, calibration, {6, 6, 1}));
  file.groups = {group};
  return file;
}

/// Force and moment about the transducer, in N and N m, from first principles.
VectorXd wrench_at_transducer() {
  const Vec3 moment = (kOrigin + kPoint).cross(kForce) + Vec3(0, 0, kTwist);
  VectorXd w(6);
  w << kForce, moment;
  return w;
}

void expect_the_load(const C3dFile& file) {
  std::vector<Repair> repairs;
  const auto plates = force_plates(file, repairs);
  for (const Repair& r : repairs) ADD_FAILURE() << r.message;
  ASSERT_EQ(plates.size(), 1U);
  const ForcePlate& plate = plates[0];
  // Channels are 32-bit: 6e-8 of 700 N, of 85 N m, and their quotient.
  EXPECT_LT((plate.force_n.row(0).transpose() - kR * kForce).norm(), 1e-4);
  EXPECT_LT((plate.pressure_center_m.row(0).transpose() - kCenter - kR * kPoint).norm(), 1e-6);
  EXPECT_LT((plate.free_moment_nm.row(0).transpose() - kR * Vec3(0, 0, kTwist)).norm(), 1e-4);
  const Vec3 about_center = kR * (kPoint.cross(kForce) + Vec3(0, 0, kTwist));
  EXPECT_LT((plate.moment_nm.row(0).transpose() - about_center).norm(), 1e-4);
  EXPECT_LT((plate.R_GP - kR).norm(), 1e-12);
  EXPECT_LT((plate.side.out_L - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(ForcePlate, Type1GivesTheLoad) {
  VectorXd v(6);
  v << kForce, 1000.0 * kPoint.x(), 1000.0 * kPoint.y(), kTwist;
  expect_the_load(plate_file(1, v, Vec3::Zero(), {"N", "N", "N", "mm", "mm", "Nm"}));
}

TEST(ForcePlate, Type2GivesTheLoadInNewtonMetersAndMillimeters) {
  VectorXd v = wrench_at_transducer();
  expect_the_load(plate_file(2, v, kOrigin, {"N", "N", "N", "Nm", "Nm", "N-M"}));
  v.tail<3>() *= 1000.0;
  expect_the_load(plate_file(2, v, kOrigin, {"nt", "nt", "nt", "ntmm", "Nmm", "N mm"}));
}

TEST(ForcePlate, Type3GivesTheLoadOfEightSensors) {
  // Sensors at (±a, ±b), at depth 45 mm; any split of the forces with the right sums will do.
  const double a = 0.12;
  const double b = 0.2;
  const Vec3 o(0, 0, -0.045);
  const Vec3 m = (o + kPoint).cross(kForce) + Vec3(0, 0, kTwist);
  // F_z at (a,b), (-a,b), (-a,-b), (a,-b): sum, M_x = sum y F_z, M_y = -sum x F_z; no torsion.
  const double f = kForce.z() / 4.0;
  const double mx = m.x() / (4.0 * b);
  const double my = m.y() / (4.0 * a);
  // M_z = a (F_y14 - F_y23) + b (F_x34 - F_x12): all of it by the y sensors.
  const double dx = 7.0;
  const double dy = (m.z() + 2.0 * b * dx) / (2.0 * a);
  VectorXd v(8);
  v << kForce.x() / 2 + dx, kForce.x() / 2 - dx, kForce.y() / 2 + dy, kForce.y() / 2 - dy, f + mx - my, f + mx + my,
      f - mx + my, f - mx - my;
  expect_the_load(plate_file(3, v, Vec3(a, b, -0.045), std::vector<std::string>(8, "N")));
}

TEST(ForcePlate, Type4GivesTheLoadThroughItsCalibrationMatrix) {
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Identity() * 50.0;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) C(i, j) += 0.07 * static_cast<double>(i) - 0.03 * static_cast<double>(j * j);
  VectorXd w = wrench_at_transducer();
  w.tail<3>() *= 1000.0;
  const VectorXd volts = C.inverse() * w;
  std::vector<double> stored(C.data(), C.data() + 36);  // column by column
  expect_the_load(plate_file(4, volts, kOrigin, std::vector<std::string>(6, "V"), stored));
}

TEST(ForcePlate, WithoutLoadThereIsNoCenterOfPressure) {
  VectorXd v = VectorXd::Zero(6);
  v[2] = -9.0;
  std::vector<Repair> repairs;
  const auto plates = force_plates(plate_file(2, v, kOrigin, {"N", "N", "N", "Nm", "Nm", "Nm"}), repairs);
  ASSERT_EQ(plates.size(), 1U);
  EXPECT_TRUE(std::isnan(plates[0].pressure_center_m(0, 0)));
  EXPECT_EQ(plates[0].free_moment_nm(0, 2), 0.0);
  EXPECT_FALSE(action_on_person(plates[0], 0, kLeastForce_n));
}

TEST(ForcePlate, WhatMakesNoSenseIsLeftOutOrTurnedWithANote) {
  const std::vector<std::string> units{"N", "N", "N", "Nm", "Nm", "Nm"};
  const VectorXd v = wrench_at_transducer();
  std::vector<Repair> repairs;
  EXPECT_TRUE(force_plates(plate_file(9, v, kOrigin, units), repairs).empty());
  C3dFile flat = plate_file(2, v, kOrigin, units);
  for (C3dParameter& p : flat.groups[0].parameters)
    if (p.name == "CORNERS") p.numbers.assign(12, 5.0);
  EXPECT_TRUE(force_plates(flat, repairs).empty());
  C3dFile missing = plate_file(2, v, kOrigin, units);
  for (C3dParameter& p : missing.groups[0].parameters)
    if (p.name == "CHANNEL") p.numbers[3] = 77;
  EXPECT_TRUE(force_plates(missing, repairs).empty());
  EXPECT_EQ(repairs.size(), 3U);
  // The transducer cannot be above the surface: the vector has the opposite sign.
  repairs.clear();
  const auto turned = force_plates(plate_file(2, v, -kOrigin, units), repairs);
  ASSERT_EQ(turned.size(), 1U);
  EXPECT_LT((turned[0].pressure_center_m.row(0).transpose() - kCenter - kR * kPoint).norm(), 1e-6);
  EXPECT_EQ(repairs.size(), 1U);
}

TEST(ForcePlate, AgreesWithTheForcesOfAnotherProgramInARealFile) {
  const auto path = test::data_folder() / "c3d/others/FunctionalWalk.c3d";
  MYOID_REQUIRE_DATA(path);
  const C3dFile file = read_c3d(path);
  std::vector<Repair> repairs;
  const auto plates = force_plates(file, repairs);
  ASSERT_EQ(plates.size(), 3U);
  // Point "LGroundReactionForce" is N per kg of body mass, on frames where one plate carries it.
  Eigen::Index label = 0;
  while (file.point_labels[static_cast<std::size_t>(label)] != "LGroundReactionForce") ++label;
  double sum = 0.0;
  double square = 0.0;
  std::vector<std::pair<Vec3, Vec3>> pairs;
  for (Eigen::Index k = 0; k < file.frame_count(); ++k) {
    const Vec3 theirs = file.points.block<1, 3>(k, 4 * label).transpose().cast<double>();
    if (theirs.z() < 5.0) continue;
    Vec3 ours = Vec3::Zero();  // the mean over the frame, of the plate nearest in direction
    for (const ForcePlate& plate : plates) {
      const Vec3 mean = plate.force_n.middleRows(k * file.analog_per_frame, file.analog_per_frame).colwise().mean();
      if ((mean.normalized() - theirs.normalized()).norm() < (ours.normalized() - theirs.normalized()).norm() &&
          mean.norm() > 100.0)
        ours = mean;
    }
    pairs.emplace_back(ours, theirs);
    sum += ours.dot(theirs);
    square += theirs.squaredNorm();
  }
  ASSERT_GT(pairs.size(), 30U);
  const double mass = sum / square;
  EXPECT_NEAR(mass, 60.0, 2.0);
  // Their data are low-pass filtered, ours are not: they differ at impacts, by 2 % of the weight rms.
  double residual = 0.0;
  for (const auto& [ours, theirs] : pairs) residual += (ours - mass * theirs).squaredNorm();
  EXPECT_LT(std::sqrt(residual / static_cast<double>(pairs.size())), 12.0);
}

}  // namespace
}  // namespace myoid::recording
