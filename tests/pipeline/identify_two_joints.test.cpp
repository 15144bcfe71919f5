// `identify` straight from files, with a muscle that crosses two joints. The data follow equations
// (2)-(4) of the source paper, written here anew.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/tables/csv_reader.h"

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;

struct Truth {
  double force_n, length_m, width_m;
};
constexpr Truth kTwoJoints{800.0, 0.11, 0.045};
constexpr Truth kOneJoint{1500.0, 0.09, 0.040};

double law(double a, double l, double v, const Truth& p) {
  const double f_l = std::exp(-std::pow((l - p.length_m) / p.width_m, 2));
  const double v_max = 1.0, v_sh = 0.3, product = 0.12, v_ml = 1.35;
  const double f_v =
      v <= 0.0 ? v_sh * (v_max + v) / (v_sh * v_max - v) : (product * v_max + v_ml * v) / (product * v_max + v);
  return a * f_l * f_v * p.force_n;
}

/// Every file's first lines; then the rows.
std::string header(const std::string& columns, int count) {
  return fmt::format("x\nversion=1\nnRows=801\nnColumns={}\ninDegrees=no\nendheader\ntime\t{}\n", count + 1, columns);
}

void write_files(const TemporaryFolder& folder) {
  std::string a = header("A\tB", 2), l = a, v = a, hip = a, knee = a;
  std::string torque = header("hip_moment\tknee_moment", 2);
  for (int i = 0; i <= 800; ++i) {
    const double t = 0.01 * i;
    const double a1 = 0.4 + 0.3 * std::sin(1.7 * t), a2 = 0.45 + 0.35 * std::sin(1.1 * t + 1.0);
    const double l1 = 0.11 + 0.03 * std::sin(2.0 * t), v1 = 0.06 * std::cos(2.0 * t);
    const double l2 = 0.09 - 0.025 * std::sin(1.4 * t + 0.5), v2 = -0.035 * std::cos(1.4 * t + 0.5);
    const double f1 = law(a1, l1, v1, kTwoJoints), f2 = law(a2, l2, v2, kOneJoint);
    a += fmt::format("{}\t{}\t{}\n", t, a1, a2);
    l += fmt::format("{}\t{}\t{}\n", t, l1, l2);
    v += fmt::format("{}\t{}\t{}\n", t, v1, v2);
    hip += fmt::format("{}\t0.05\t0\n", t);
    knee += fmt::format("{}\t-0.03\t0.04\n", t);
    torque += fmt::format("{}\t{}\t{}\n", t, 0.05 * f1, -0.03 * f1 + 0.04 * f2);
  }
  write_text(folder / "a.sto", a);
  write_text(folder / "l.sto", l);
  write_text(folder / "v.sto", v);
  write_text(folder / "hip.sto", hip);
  write_text(folder / "knee.sto", knee);
  write_text(folder / "id.sto", torque);
  write_text(folder / "muscles.csv",
             "muscle,max_isometric_force,optimal_fiber_length,force_length_width,"
             "concentric_curvature,eccentric_curvature_product,eccentric_plateau,"
             "max_shortening_speed,max_shortening_speed_fixed\n"
             "A,1000,0.12,0.05,0.25,0.1,1.4,1.0,true\nB,1300,0.085,0.045,0.25,0.1,1.4,1.0,true\n");
}

TEST(IdentifyTwoJoints, TorquesOfBothGiveBackTheMuscles) {
  const TemporaryFolder folder;
  write_files(folder);
  const Finished run = myoid({"identify",
                              "--muscles",
                              folder / "muscles.csv",
                              "--activations",
                              folder / "a.sto",
                              "--lengths",
                              folder / "l.sto",
                              "--velocities",
                              folder / "v.sto",
                              "--moment-arms",
                              folder / "hip.sto",
                              folder / "knee.sto",
                              "--torques",
                              folder / "id.sto",
                              "--coordinate",
                              "hip",
                              "knee",
                              "--delay",
                              "0",
                              "--out",
                              folder / "out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto table = myoid::recording::read_csv_table(folder / "out/parameters.csv");
  int compared = 0;
  for (const auto& row : table.rows) {
    const Truth& truth = row[0] == "A" ? kTwoJoints : kOneJoint;
    const double expected = row[1] == "max_isometric_force"    ? truth.force_n
                            : row[1] == "optimal_fiber_length" ? truth.length_m
                            : row[1] == "force_length_width"   ? truth.width_m
                                                               : 0.0;
    if (expected == 0.0) continue;
    EXPECT_NEAR(std::stod(row[6]), expected, 1e-6 * expected) << row[0] << " " << row[1];
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

TEST(IdentifyTwoJoints, AMomentArmFileTooFewIsNamedWithTheOrderExpected) {
  const TemporaryFolder folder;
  write_files(folder);
  const Finished run =
      myoid({"identify", "--muscles", folder / "muscles.csv", "--activations", folder / "a.sto", "--lengths",
             folder / "l.sto", "--velocities", folder / "v.sto", "--moment-arms", folder / "hip.sto", "--torques",
             folder / "id.sto", "--coordinate", "hip", "knee", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("in the order of --coordinate"));
}

}  // namespace
