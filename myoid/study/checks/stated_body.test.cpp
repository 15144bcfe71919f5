#include "myoid/study/checks/stated_body.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

class StatedBody : public ::testing::Test {
 protected:
  /// Adds a trial whose file states a person, as Vicon does: kg and mm.
  void add(const std::string& name, double mass_kg, double height_mm) {
    using recording::C3dType;
    recording::C3dFile file = test::plate_recording(2);
    recording::C3dGroup group{.id = 9, .name = "PROCESSING"};
    group.parameters = {test::c3d_numbers("Bodymass", C3dType::real, {}, {mass_kg}),
                        test::c3d_numbers("Height", C3dType::real, {}, {height_mm})};
    file.groups.push_back(group);
    recording::write_c3d(folder_ / name, file);
    TrialSpec trial;
    trial.name = name;
    trial.markers = folder_ / name;
    study_.trials.push_back(trial);
  }
  [[nodiscard]] std::vector<Severity> found() const {
    std::vector<Severity> list;
    for (const Remark& remark : unlike_stated_bodies(study_)) list.push_back(remark.severity);
    return list;
  }

  test::TemporaryFolder folder_;
  Study study_;
};

TEST_F(StatedBody, IsComparedWithTheStudysMass) {
  add("a.c3d", 60.0, 1680.0);
  EXPECT_EQ(found(), std::vector{Severity::note});
  study_.subject.mass_kg = 62.0;
  EXPECT_TRUE(found().empty());
  study_.subject.mass_kg = 73.0;
  EXPECT_EQ(found(), std::vector{Severity::warning});
}

TEST_F(StatedBody, OfTwoFilesIsComparedToo) {
  study_.subject.mass_kg = 60.0;
  add("a.c3d", 60.0, 1680.0);
  add("b.c3d", 61.0, 1690.0);
  EXPECT_TRUE(found().empty());
  add("child.c3d", 32.7, 1340.0);
  EXPECT_EQ(found(), (std::vector{Severity::warning, Severity::warning}));
}

TEST_F(StatedBody, AFieldThatNobodyFilledInStatesNothing) {
  add("a.c3d", 0.0, 0.0);
  EXPECT_TRUE(found().empty());
}

}  // namespace
}  // namespace myoid::study
