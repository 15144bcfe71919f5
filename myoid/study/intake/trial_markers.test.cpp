#include "myoid/study/intake/trial_markers.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/recording/recording.h"
#include "myoid/recording/trc_writer.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// Every marker of the arm, at 100 Hz, where the model has it in its own body: a pose that no arm
/// takes, but that its reader does not judge.
struct MarkerTrial {
  test::TemporaryFolder folder;
  TrialSpec spec;

  MarkerTrial(const std::string& first_name, int frames) {
    MarkerSeries markers;
    for (const body::Marker& marker : arm().markers) markers.names.push_back(marker.name);
    markers.names[0] = first_name;
    markers.time_s = Eigen::VectorXd::LinSpaced(frames, 0.0, 0.01 * (frames - 1));
    markers.positions_m.resize(frames, 3 * markers.marker_count());
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      markers.positions_m.middleCols(3 * m, 3) =
          Eigen::RowVector3d(0.1, 0.2, 0.3 + 0.05 * static_cast<double>(m)).replicate(frames, 1);
    }
    recording::write_trc(folder / "m.trc", markers);
    spec.name = "t";
    spec.markers = folder / "m.trc";
  }
};

std::string first_name() { return arm().markers[0].name; }

TEST(ReadTrialMarkers, ALabelThatDiffersInItsWritingBecomesTheModelsWithANote) {
  std::string upper = first_name();
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  ASSERT_NE(upper, first_name());
  const MarkerTrial trial(upper, 50);
  TrialInput input;
  EXPECT_EQ(read_trial_markers(arm_study(), trial.spec, arm(), input).names[0], first_name());
  EXPECT_TRUE(std::ranges::any_of(
      input.remarks, [&](const Remark& note) { return note.says.find("'" + upper + "'") != std::string::npos; }));
}

TEST(ReadTrialMarkers, ARenamedMarkerThatTheFileLacksIsNotedWithTheNearestName) {
  const MarkerTrial trial("RELB", 50);
  const auto notes = [&](const std::string& from) {
    Study study = arm_study();
    study.markers.rename[from] = first_name();
    TrialInput input;
    const MarkerSeries markers = read_trial_markers(study, trial.spec, arm(), input);
    EXPECT_EQ(markers.names[0] == first_name(), from == "RELB") << from;
    return std::ranges::count_if(input.remarks,
                                 [](const Remark& r) { return r.says.find("'RELB'?") != std::string::npos; });
  };
  EXPECT_EQ(notes("RELB"), 0);
  EXPECT_EQ(notes("RELBO"), 1);
}

TEST(ReadTrialMarkers, ALaboratoryWithZUpIsTurned) {
  const MarkerTrial trial(first_name(), 50);
  TrialInput input;
  const MarkerSeries markers = read_trial_markers(arm_study("[markers]\nup = \"z\"\n"), trial.spec, arm(), input);
  // Height 0.3 m was the third coordinate.
  EXPECT_NEAR(markers.positions_m(0, 1), 0.3, 1e-6);
  EXPECT_NEAR(
      markers.positions_m(0, 0) * markers.positions_m(0, 0) + markers.positions_m(0, 2) * markers.positions_m(0, 2),
      0.1 * 0.1 + 0.2 * 0.2, 1e-6);
}

TEST(ReadTrialMarkers, FewerThanTenFramesAreRefused) {
  MarkerTrial trial(first_name(), 50);
  trial.spec.start_s = 0.1;
  trial.spec.end_s = 0.155;
  TrialInput input;
  const std::string message = message_of([&] { (void)read_trial_markers(arm_study(), trial.spec, arm(), input); });
  EXPECT_NE(message.find("only 6 frames"), std::string::npos) << message;
}

TEST(ReadTrialMarkers, AnotherUnitIsRefusedWithTheFileAndTheUnit) {
  MarkerTrial trial(first_name(), 50);
  recording::MarkerFile file = recording::read_markers(*trial.spec.markers);
  for (std::size_t m = 0; m < arm().markers.size(); ++m)
    file.markers.positions_m.middleCols(3 * static_cast<Eigen::Index>(m), 3) =
        1000.0 * arm().markers[m].p_BM.transpose().replicate(50, 1);
  recording::write_trc(*trial.spec.markers, file.markers);
  TrialInput input;
  const std::string message = message_of([&] { (void)read_trial_markers(arm_study(), trial.spec, arm(), input); });
  EXPECT_NE(message.find("m.trc: the markers lie 1e+03 times"), std::string::npos) << message;
  EXPECT_NE(message.find("millimeters"), std::string::npos) << message;
}

/// Hides three frames of this marker.
void hide(MarkerSeries& markers, Eigen::Index marker) {
  markers.positions_m.block(20, 3 * marker, 3, 3).setConstant(std::numeric_limits<double>::quiet_NaN());
}

TEST(ReadTrialMarkers, GapsThatTheModelDoesNotUseAreOneNoteAndEachOtherGapIsToldOnce) {
  MarkerTrial trial("of_nobody", 50);
  MarkerSeries markers = recording::read_markers(*trial.spec.markers).markers;
  ASSERT_GE(markers.marker_count(), 3);
  for (const Eigen::Index marker : {0, 1, 2}) hide(markers, marker);
  recording::write_trc(*trial.spec.markers, markers);
  TrialInput input;
  Study study = arm_study();
  study.markers.weight[markers.names[1]] = 0.0;
  (void)read_trial_markers(study, trial.spec, arm(), input);
  std::vector<std::string> gaps;
  for (const Remark& fault : input.marker_faults)
    if (fault.code == RemarkCode::marker_gap) gaps.push_back(fault.about);
  EXPECT_EQ(gaps, (std::vector<std::string>{markers.names[2], "of_nobody, " + markers.names[1]}));
  EXPECT_TRUE(std::ranges::none_of(input.remarks, [](const Remark& r) { return r.says.find("fill") < r.says.size(); }));
}

}  // namespace
}  // namespace myoid::study
