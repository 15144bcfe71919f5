#include "myoid/run/trial_motion.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"

#include "tests/support/resting_markers.h"
#include "tests/support/written_trial.h"

namespace myoid::run {
namespace {

using namespace test_trials;

/// A study of two trials, of which the second holds a mass, with a model on disk.
struct OnDisk {
  test::TemporaryFolder folder;
  study::Study study = arm_study();

  OnDisk() {
    write_file(folder / "arm.osim", body::arm4_osim());
    study.model.file = folder / "arm.osim";
    study.model.held_mass = {"forearm_hand", body::arm4_held_at_m()};
    study.trials.resize(2, study.trials[0]);
    study.trials[1].held_mass_kg = 2.0;
  }
  [[nodiscard]] StudyInputs inputs() const {
    study::TrialInput input;
    const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
    input.motion =
        TimeSeries(time_s, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd(0.5 + 0.3 * time_s.array().sin()));
    return in_memory(study, {input, input});
  }
};

// With the file gone no stage can read the model a second time.
TEST(StudyMotion, TheModelIsReadOnceAndTrialsShareIt) {
  const OnDisk disk;
  const StudyInputs inputs = disk.inputs();
  std::filesystem::remove(*disk.study.model.file);
  const std::vector<TrialMotion> motion = study_motion(inputs, nullptr, {});
  ASSERT_TRUE(motion[0].failure.empty()) << motion[0].failure;
  ASSERT_TRUE(motion[1].failure.empty()) << motion[1].failure;
  EXPECT_EQ(motion[0].model, inputs.source.model);
  // The held mass is the trial's own.
  EXPECT_NE(motion[1].model, inputs.source.model);
  const auto hand = static_cast<std::size_t>(inputs.source.model->find_body("forearm_hand").value());
  EXPECT_NEAR(motion[1].model->bodies[hand].mass_kg, inputs.source.model->bodies[hand].mass_kg + 2.0, 1e-12);
}

TEST(StudyMotion, AHeldMassWithoutAPlaceIsTheFailureOfItsTrial) {
  OnDisk disk;
  disk.study.model.held_mass.reset();
  const std::vector<TrialMotion> motion = study_motion(disk.inputs(), nullptr, {});
  EXPECT_TRUE(motion[0].failure.empty());
  EXPECT_NE(motion[1].failure.find("does not say where it acts"), std::string::npos);
}

TEST(StudyMotion, MarkersOfAnArmThatTheModelCannotReachNameTheSettingThatLetsItMove) {
  study::Study study = arm_study();
  study.trials[0].motion.reset();
  study.trials[0].markers = "m.trc";
  const auto remarks = [&](double shift_m) {
    study::TrialInput input;
    input.markers = test::resting_markers(arm(), shift_m);
    const std::vector<TrialMotion> motion = study_motion(in_memory(study, {input}), nullptr, {});
    EXPECT_EQ(motion[0].failure, "");
    std::vector<Remark> found;
    std::ranges::copy_if(motion[0].remarks, std::back_inserter(found),
                         [](const Remark& remark) { return remark.code == RemarkCode::model_unfit; });
    return found;
  };
  EXPECT_TRUE(remarks(0.0).empty());
  const std::vector<Remark> far = remarks(1.0);
  ASSERT_EQ(far.size(), 1U);
  EXPECT_EQ(far[0].where, "t");
  EXPECT_EQ(far[0].severity, Severity::warning);
  EXPECT_NE(far[0].remedy.find("forearm_rotations"), std::string::npos);
  study.model.forearm_rotations = true;
  study.ik.unlock = {"base_heading", "base_tx", "base_ty", "base_tz"};
  EXPECT_TRUE(remarks(1.0).empty());
}

}  // namespace
}  // namespace myoid::run
