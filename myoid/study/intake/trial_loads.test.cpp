#include "myoid/study/intake/trial_loads.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/study/read_study.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using ::testing::HasSubstr;

/// A study whose trial has a load cell: 2 s at 500 Hz, after 1 s a volt on v2, which is -10 N on z.
class LoadCellTrial : public ::testing::Test {
 protected:
  LoadCellTrial() {
    std::string rows = "time";
    for (int c = 1; c <= 6; ++c) rows += ",v" + std::to_string(c) + " [V]";
    rows += '\n';
    for (int i = 0; i <= 1000; ++i) {
      rows += std::to_string(0.002 * i);
      for (int c = 1; c <= 6; ++c) rows += c == 2 && i > 500 ? ",1.25" : ",0.25";
      rows += '\n';
    }
    write_file(folder / "cell.csv", rows);
    put_matrix("0,0,0,0,0,0\n0,0,0,0,0,0\n0,10,0,0,0,0\n0 0 0 0 0 0\n0;0;0;0;0;0\n0,0,0,0,0,0\n");
  }

  void put_matrix(const std::string& text) const { write_file(folder / "matrix.csv", text); }

  [[nodiscard]] Study study(const std::string& trial, const std::string& body = "forearm_hand") const {
    return parse_study(
        "[load_cell]\nchannels = [\"v1\",\"v2\",\"v3\",\"v4\",\"v5\",\"v6\"]\n"
        "calibration = \"matrix.csv\"\nsign = -1\nzero_s = [0, 0.9]\n"
        "lowpass_hz = 20\nframe = \"forearm_hand\"\nbody = \"" +
            body +
            "\"\n[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n[[trial]]\nname = \"t\"\n"
            "motion = \"m.mot\"\nemg = \"e.sto\"\n" +
            trial,
        folder / "study.toml");
  }

  [[nodiscard]] std::optional<body::ExternalLoads> loads(const Study& study) {
    return read_trial_loads(
        study, study.trials[0], arm, std::nullopt, [&](const auto&) { ++files; }, remarks);
  }

  std::string refusal(const Study& study) {
    return test::message_of([&] { (void)loads(study); });
  }

  test::TemporaryFolder folder;
  body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  std::vector<Remark> remarks;
  int files = 0;
};

TEST_F(LoadCellTrial, GivesTheForceThatTheBodyFeels) {
  const auto result = loads(study("load_cell = \"cell.csv\"\n"));
  ASSERT_TRUE(result);
  ASSERT_EQ(result->forces.size(), 1U);
  const body::ExternalForce& force = result->forces[0];
  EXPECT_EQ(force.force_frame, *arm.find_body("forearm_hand"));
  // Half a second from the step, 20 Hz of low-pass have settled to exp(-2 pi 20 0.5 / sqrt 2).
  EXPECT_LT((force.force->at(1.5) - Vec3(0.0, 0.0, -10.0)).norm(), 1e-6);
  EXPECT_LT(force.force->at(0.5).norm(), 1e-6);
  EXPECT_EQ(files, 2);
  EXPECT_FALSE(loads(study("")));
}

TEST_F(LoadCellTrial, WhatDoesNotFitIsNamed) {
  const std::string trial = "load_cell = \"cell.csv\"\n";
  put_matrix("1,2,3\n");
  EXPECT_THAT(refusal(study(trial)), HasSubstr("matrix.csv:1: row 1 "));
  put_matrix("1,2,3,4,5,6\n1,2,3,4,5,6\n");
  EXPECT_THAT(refusal(study(trial)), HasSubstr("has 2 rows, expected 6"));
  put_matrix("0,0,0,0,0,0\n0,0,x,0,0,0\n");
  EXPECT_THAT(refusal(study(trial)), HasSubstr("matrix.csv:2: "));
  put_matrix("0,0,0,0,0,0\n0,0,0,0,0,0\n0,0,0,0,0,0\n0,0,0,0,0,0\n0,0,0,0,0,0\n0,0,0,0,0,0\n");
  EXPECT_THAT(refusal(study(trial, "foot")), HasSubstr("[load_cell] body: "));
  EXPECT_THROW(static_cast<void>(study(trial + "external_loads = \"x.xml\"\n")), ReadError);
  EXPECT_THROW(static_cast<void>(parse_study("[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n[[trial]]\n"
                                             "name = \"t\"\nmotion = \"m.mot\"\nemg = \"e.sto\"\n" +
                                                 trial,
                                             "s.toml")),
               ReadError);
}

}  // namespace
}  // namespace myoid::study
