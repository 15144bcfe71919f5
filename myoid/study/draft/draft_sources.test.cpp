#include "myoid/study/draft/draft_sources.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

DraftSources sources_of(const std::filesystem::path& folder) { return draft_sources(folder, {.from = {folder}}); }

void write_angles(const std::filesystem::path& file) {
  std::string text = "Coordinates\nversion=1\nnRows=40\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i < 40; ++i) text += fmt::format("{:.2f}\t{:.6f}\n", 0.01 * i, 0.02 * i);
  write_file(file, text);
}

TEST(DraftSources, AreReadByTheirContent) {
  const test::TemporaryFolder folder;
  write_angles(folder / "lift_ik.mot");
  write_file(folder / "effort.csv", "time,elbow torque [Nm]\n0,1\n0.01,2\n0.02,3\n0.03,4\n");
  write_file(folder / "broken.trc", "no TRC");
  const DraftSources sources = sources_of(folder.path());
  EXPECT_FALSE(sources.model_file);
  EXPECT_EQ(sources.model.name, "arm4");
  ASSERT_EQ(sources.found.size(), 1U);
  EXPECT_EQ(sources.found[0].angles, std::vector<std::string>{"elbow_flexion"});
  EXPECT_EQ(sources.torques.of_no_joint, std::vector<std::string>{"effort.csv"});
  EXPECT_FALSE(sources.upright);
  EXPECT_EQ(sources.most_known, 0);
  EXPECT_EQ(std::ranges::count(sources.remarks, RemarkCode::refused, &Remark::code), 1);
}

TEST(DraftSources, NeedARecordingAndTheNamedCoordinate) {
  const test::TemporaryFolder folder;
  write_file(folder / "broken.trc", "no TRC");
  EXPECT_THROW((void)sources_of(folder.path()), InvalidInput);
  write_angles(folder / "lift_ik.mot");
  EXPECT_THROW((void)draft_sources(folder.path(), {.from = {folder.path()}, .coordinate = "no_such_joint"}),
               InvalidInput);
  EXPECT_NO_THROW((void)draft_sources(folder.path(), {.from = {folder.path()}, .coordinate = "elbow_flexion"}));
}

TEST(DraftSources, HavePathsAsSeenFromTheStudy) {
  EXPECT_EQ(path_from("/data/study", "/data/study/raw/a.c3d"), "raw/a.c3d");
  EXPECT_EQ(path_from("/data/study", "/data/a.c3d"), "../a.c3d");
}

}  // namespace
}  // namespace myoid::study
