#include "myoid/results/review/project_study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/results/review/second_opinion.h"
#include "myoid/run/run_study.h"
#include "myoid/study/study_text.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using opensim::MuscleQuantity;
using opensim::Project;
using opensim::ProjectMuscle;
using opensim::TrialFile;
using opensim::TrialRole;
using ::testing::ElementsAre;

constexpr double kArm_m = -0.04, kLength_m = 0.3;
constexpr int kSamples = 400;

void write(const std::filesystem::path& path, const std::vector<Channel>& channels, const Eigen::MatrixXd& values) {
  recording::write_storage(
      path,
      TimeSeries(Eigen::VectorXd::LinSpaced(values.rows(), 0.0, 0.01 * static_cast<double>(values.rows() - 1)),
                 channels, values),
      {});
}

/// Three muscles at one ankle, isometric: two of the electrode "sol", one of "sol" and "gas" together, and a muscle
/// without EMG. The torque is that of the muscles by the closed form of CEINMS at a constant length, without damping.
class AnkleProject {
 public:
  AnkleProject() {
    project.tendon = "stiff";
    project.curves = {{"activeForceLength", {0.0, 2.0}, {0.0, 1.0}},
                      {"passiveForceLength", {0.0, 2.0}, {0.0, 0.0}},
                      {"forceVelocity", {-1.0, 1.0}, {0.0, 2.0}}};
    add("soleus", 2000.0, {{"sol", 1.0}});
    add("plantaris", 500.0, {{"sol", 1.0}});
    add("gastroc", 1000.0, {{"sol", 0.5}, {"gas", 0.5}});
    add("tib_post", 1500.0, {});
    project.dofs = {{"ankle", {"soleus", "plantaris", "gastroc", "tib_post"}, true}, {"knee", {"gastroc"}, false}};
    project.has_mapping = true;
    Eigen::MatrixXd emg(kSamples, 2), torque(kSamples, 1);
    for (int k = 0; k < kSamples; ++k) {
      emg(k, 0) = 0.3 + 0.2 * std::sin(0.05 * k);
      emg(k, 1) = 0.4 + 0.3 * std::cos(0.03 * k);
      const double fiber = (kLength_m - 0.2) / 0.08;
      const double force = 2500.0 * emg(k, 0) + 1000.0 * 0.5 * (emg(k, 0) + emg(k, 1));
      torque(k, 0) = kArm_m * 0.5 * fiber * force;
    }
    std::vector<Channel> muscles;
    for (const ProjectMuscle& muscle : project.muscles) muscles.push_back({muscle.name, Unit::meter});
    write(folder / "emg.sto", {{"sol", Unit::dimensionless}, {"gas", Unit::dimensionless}}, emg);
    write(folder / "lengths.sto", muscles, Eigen::MatrixXd::Constant(kSamples, 4, kLength_m));
    write(folder / "arms.sto", muscles, Eigen::MatrixXd::Constant(kSamples, 4, kArm_m));
    write(folder / "id.sto", {{"ankle_moment", Unit::newton_meter}}, torque);
    project.trials = {
        {.name = "hold 1",
         .is_calibrating = true,
         .used = Stretch{0.5, 3.5},
         .files = {file(TrialRole::emg, "emg.sto"), file(TrialRole::lengths, "lengths.sto"),
                   file(TrialRole::moment_arms, "arms.sto", "ankle"), file(TrialRole::torques, "id.sto")}},
        {.name = "no torque", .files = {file(TrialRole::emg, "emg.sto")}}};
  }

  test::TemporaryFolder folder;
  Project project;

 private:
  [[nodiscard]] TrialFile file(TrialRole role, const char* name, const std::string& dof = "") const {
    return {.role = role, .path = folder / name, .exists = true, .dof = dof, .time = Stretch{0.0, 3.99}};
  }

  void add(const char* name, double force_n, std::vector<opensim::ProjectInput> inputs) {
    ProjectMuscle muscle{.name = name, .inputs = std::move(inputs)};
    muscle.numbers[MuscleQuantity::max_isometric_force] = {.value = 2.0 * force_n, .start = force_n};
    muscle.numbers[MuscleQuantity::strength_coefficient] = {
        .value = 0.5, .start = 1.0, .unknown = project.muscles.size(), .bounds = opensim::CalibrationBounds{0.5, 2.0}};
    muscle.numbers[MuscleQuantity::optimal_fiber_length] = {.value = 0.08};
    muscle.numbers[MuscleQuantity::tendon_slack_length] = {.value = 0.2};
    project.muscles.push_back(std::move(muscle));
  }
};

TEST(ProjectStudy, HasTheJointsMusclesTrialsAndStartsOfTheCalibration) {
  const AnkleProject ankle;
  EXPECT_THAT(reviewed_joints(ankle.project), ElementsAre("ankle"));
  const ProjectStudy made = study_of_project(ankle.project, {"ankle"}, ankle.folder / "out");
  const study::Study& study = made.study;
  ASSERT_EQ(study.muscles.size(), 3U);  // without the muscle that has no EMG
  EXPECT_EQ(study.muscles[0].emg, "sol");
  EXPECT_EQ(study.muscles[2].emg, "0.5 sol + 0.5 gas");
  EXPECT_EQ(study.muscles[0].start.at("max_isometric_force"), 2000.0);  // before the calibration
  ASSERT_EQ(study.trials.size(), 1U);
  EXPECT_EQ(study.trials[0].name, "hold 1");
  EXPECT_EQ(study.trials[0].start_s, 0.5);
  EXPECT_EQ(study.identify.folds, fit::FoldKind::block);  // of one trial
  // Two muscles of one electrode share their scales, because no model lumps them.
  int ties = 0, passive = 0;
  for (const fit::ParameterRule& rule : study.parameters) {
    passive += rule.parameter.starts_with("passive_") && rule.value.value_or(0.0) > 0.0 ? 1 : 0;
    if (!rule.tie) continue;
    ++ties;
    EXPECT_THAT(rule.owners, ElementsAre("soleus", "plantaris"));
  }
  EXPECT_GT(ties, 0);
  EXPECT_EQ(passive, 3);
  ASSERT_EQ(made.mixed.size(), 1U);
  const TimeSeries& emg = made.mixed[0].emg;
  EXPECT_EQ(study.trials[0].emg, made.mixed[0].file);
  EXPECT_NEAR(emg.column("0.5 sol + 0.5 gas")(0), 0.5 * 0.3 + 0.5 * 0.7, 1e-12);
  EXPECT_EQ(made.remarks.size(), 2U);  // the trial without torques, the mixture
}

TEST(ProjectStudy, LeavesOutAFittedJointWithoutEmg) {
  AnkleProject ankle;
  ankle.project.dofs.push_back({"toes", {"tib_post"}, true});
  EXPECT_THAT(reviewed_joints(ankle.project), ElementsAre("ankle"));
  const ProjectStudy made = study_of_project(ankle.project, {"ankle"}, ankle.folder / "out");
  EXPECT_EQ(std::ranges::count(made.remarks, "toes", &Remark::where), 1);
}

TEST(ProjectStudy, TakesTheStretchOfTheRedundancySolverAsFarAsItIsRecorded) {
  AnkleProject ankle;
  ankle.project.dialect = opensim::Dialect::mrs;
  ankle.project.trials[0].used = Stretch{0.5, 9999.0};
  const study::TrialSpec trial = study_of_project(ankle.project, {"ankle"}, ankle.folder / "out").study.trials.front();
  EXPECT_EQ(trial.start_s, 0.5);
  EXPECT_FALSE(trial.end_s.has_value());
}

TEST(ProjectStudy, HasAWindowOfNormalizationThatFitsTwiceIntoTheShortestStretch) {
  AnkleProject ankle;
  ankle.project.trials[0].used = Stretch{1.0, 1.5};
  EXPECT_EQ(study_of_project(ankle.project, {"ankle"}, ankle.folder / "out").study.emg.normalise_window_s, 0.25);
  ankle.project.trials[0].used = Stretch{1.0, 3.0};
  EXPECT_EQ(study_of_project(ankle.project, {"ankle"}, ankle.folder / "out").study.emg.normalise_window_s, 0.5);
}

TEST(ProjectStudy, LumpsMusclesOfOneElectrodeWhereTheModelIsThere) {
  AnkleProject ankle;
  ankle.project.model = "model.osim";
  const study::Study study = study_of_project(ankle.project, {"ankle"}, ankle.folder / "out").study;
  ASSERT_EQ(study.muscles.size(), 2U);
  EXPECT_THAT(study.muscles[0].osim, ElementsAre("soleus", "plantaris"));
  EXPECT_THAT(muscles_of(study.muscles[0]), ElementsAre("soleus", "plantaris"));
  // A muscle that acts on another joint of the study, too, stays by itself.
  ankle.project.muscles[1].inputs = ankle.project.muscles[2].inputs;
  ankle.project.trials[0].files.push_back(ankle.project.trials[0].files[2]);
  ankle.project.trials[0].files.back().dof = "knee";
  EXPECT_EQ(study_of_project(ankle.project, {"ankle", "knee"}, ankle.folder / "out").study.muscles.size(), 3U);
}

TEST(ProjectStudy, SaysWhyThereIsNothingToIdentify) {
  AnkleProject ankle;
  const auto make = [&](const std::vector<std::string>& joints) {
    return study_of_project(ankle.project, joints, ankle.folder / "out");
  };
  EXPECT_THROW((void)make({"hip"}), InvalidInput);
  EXPECT_THROW((void)make({}), InvalidInput);
  for (ProjectMuscle& muscle : ankle.project.muscles) muscle.inputs.clear();
  EXPECT_THROW((void)make({"ankle"}), InvalidInput);
}

TEST(ProjectStudy, GivesTheirTorqueAndTheStrengthWithoutEmg) {
  AnkleProject ankle;
  ProjectStudy made = study_of_project(ankle.project, {"ankle"}, ankle.folder / "out");
  std::filesystem::create_directories(made.mixed[0].file.parent_path());
  recording::write_storage(made.mixed[0].file, made.mixed[0].emg, {});
  write_file(made.study.file, study::study_toml(made.study));
  const SecondOpinion opinion = second_opinion(ankle.project, {"ankle"}, run::study_data(made.study));
  ASSERT_EQ(opinion.torques.size(), 1U);
  const ReviewedTorque& torque = opinion.torques[0];
  ASSERT_TRUE(torque.theirs);
  EXPECT_TRUE(torque.is_calibrating);
  EXPECT_LT(torque.theirs->rmse_nm(), 1e-6 * torque.measured_nm.cwiseAbs().maxCoeff());
  EXPECT_EQ(opinion.unknowns, 4U);
  EXPECT_EQ(opinion.on_bound, 4U);
  EXPECT_NEAR(opinion.independent_rows, 3.0 / 0.22, 1e-9);
  ASSERT_EQ(opinion.strengths.size(), 1U);  // all arms have one sign
  EXPECT_FALSE(opinion.strengths[0].is_positive);
  EXPECT_NEAR(opinion.strengths[0].without_emg_nm / opinion.strengths[0].all_nm, 1500.0 / 5000.0, 1e-9);
  EXPECT_THAT(opinion.strengths[0].without_emg, ElementsAre("tib_post"));
}

}  // namespace
}  // namespace myoid::results
