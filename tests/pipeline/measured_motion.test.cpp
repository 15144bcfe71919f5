// Inverse kinematics and inverse dynamics of measured recordings, where the answer must not depend on a detail.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/data_folder.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_law.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_table;
using myoid::test::read_text;
using myoid::test::Table;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
namespace fs = std::filesystem;

class MeasuredGait : public testing::Test {
 protected:
  void SetUp() override { MYOID_REQUIRE_DATA(data_); }

  /// Inverse kinematics from this time to 0.6 s.
  Table motion_from(const std::string& start_s) const {
    const fs::path out = folder_ / ("from_" + start_s + ".mot");
    const Finished done = myoid({"ik", "--model", data_ / "subject_walk_scaled.osim", "--markers",
                                 data_ / "markers_walk.trc", "--start", start_s, "--end", "0.6", "--out", out});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return read_table(out);
  }

  const fs::path data_ = myoid::test::data_folder() / "gait-emg";
  const TemporaryFolder folder_;
};

TEST_F(MeasuredGait, ThePostureDoesNotDependOnTheFirstFrame) {
  const Table whole = motion_from("0"), part = motion_from("0.3");
  for (const char* name : {"elbow_flex_l", "arm_rot_l", "elbow_flex_r", "knee_angle_r", "lumbar_rotation"}) {
    const auto& all = whole.of(name);
    const auto& late = part.of(name);
    ASSERT_GT(late.size(), 20U);
    for (std::size_t i = 0; i < late.size(); ++i)
      EXPECT_NEAR(all[all.size() - late.size() + i], late[i], 0.01) << name << " [deg]";
  }
}

TEST_F(MeasuredGait, LoadsUnderTheWrongFootAreTold) {
  ASSERT_GT(motion_from("0").columns.size(), 20U);
  std::string loads = read_text(data_ / "grf_walk.xml");
  const std::string left = "calcn_l", right = "calcn_r";
  for (std::size_t at = 0; (at = loads.find("calcn_", at)) != std::string::npos; at += left.size())
    loads.replace(at, left.size(), loads.compare(at, left.size(), left) == 0 ? right : left);
  fs::copy_file(data_ / "grf_walk.mot", folder_ / "grf_walk.mot");
  write_text(folder_ / "exchanged.xml", loads);
  const auto id = [&](const fs::path& file) {
    return myoid({"id", "--model", data_ / "subject_walk_scaled.osim", "--motion", folder_ / "from_0.mot", "--lowpass",
                  "6", "--loads", file, "--out", folder_ / "id.sto"});
  };
  const Finished wrong = id(folder_ / "exchanged.xml");
  EXPECT_EQ(wrong.exit_code, 0) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("'Right_GRF' is applied to calcn_l, but acts"));
  EXPECT_THAT(id(data_ / "grf_walk.xml").err, testing::Not(HasSubstr("applied_to_body")));
}

}  // namespace
