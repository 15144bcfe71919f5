#include "myoid/opensim/opensim_files.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::opensim {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::temp_directory_path() / ("myoid_opensim_files_" + name);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(OpensimFiles, AStorageIsWrittenAsOpenSimWritesIt) {
  const auto path = scratch("storage.sto");
  Eigen::MatrixXd values(1, 2);
  values << kPi, -0.25;
  write_opensim_storage(path,
                        {Eigen::VectorXd::Constant(1, 0.1), {{"angle", Unit::radian}, {"shift", Unit::meter}}, values},
                        {.title = "Coordinates", .in_degrees = true, .description = "\nUnits\n\n"});
  EXPECT_EQ(content(path),
            "Coordinates\nversion=1\nnRows=1\nnColumns=3\ninDegrees=yes\n\nUnits\n\nendheader\n"
            "time\tangle\tshift\n      0.10000000\t    180.00000000\t     -0.25000000\n");
  std::filesystem::remove(path);
}

TEST(OpensimFiles, CoordinatesAreFoundByNameAndByPath) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const auto path = scratch("states.sto");
  std::ofstream(path) << "states\nversion=1\nnRows=1\nnColumns=3\ninDegrees=no\nendheader\n"
                         "time\t/jointset/elbow/elbow_flexion/value\tother\n0\t0.5\t7\n";
  std::vector<Remark> remarks;
  const TimeSeries q = read_coordinates(m, path, MissingCoordinate::zero, remarks);
  EXPECT_DOUBLE_EQ(q.column("elbow_flexion")[0], 0.5);
  EXPECT_EQ(q.channel_count(), static_cast<Eigen::Index>(m.coordinates.size()));
  std::ofstream(path) << "x\nversion=1\nnRows=1\nnColumns=2\ninDegrees=no\nendheader\ntime\tother\n0\t1\n";
  EXPECT_THROW((void)read_coordinates(m, path, MissingCoordinate::zero, remarks), InvalidInput);
  std::filesystem::remove(path);
}

TEST(OpensimFiles, RowsAreThoseNotAfterATime) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(5, 0.0, 1.0);
  EXPECT_EQ(row_at(t, -1.0), 0);
  EXPECT_EQ(row_at(t, 0.3), 1);
  EXPECT_EQ(row_at(t, 0.5), 2);
  EXPECT_EQ(row_at(t, 9.0), 4);
  const TimeSeries rows = rows_of(TimeSeries(t, {{"x", Unit::meter}}, Eigen::MatrixXd(t)), Eigen::seq(1, 2));
  EXPECT_EQ(rows.sample_count(), 2);
  EXPECT_DOUBLE_EQ(rows.values()(0, 0), 0.25);
}

TEST(OpensimFiles, WhatOpenSimCallsCoupledIsNeverInDegrees) {
  body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  m.coordinates[0].motion = body::MotionType::coupled;
  const std::string name = m.coordinates[0].name;
  const TimeSeries q(Eigen::VectorXd::Zero(1), {{name, Unit::radian}}, Eigen::MatrixXd::Ones(1, 1));
  EXPECT_EQ(with_file_units(m, q).channels()[0].unit, Unit::dimensionless);
}

}  // namespace
}  // namespace myoid::opensim
