#include "myoid/study/trial_videos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using testing::HasSubstr;

Study study_with(const std::vector<std::string>& movements) {
  Study study;
  for (const std::string& name : movements) study.trials.push_back({.name = name});
  study.trials.push_back({.name = "max", .use = Use::mvc});
  return study;
}

TEST(TrialVideos, ATrialIsNamedBeforeItsFile) {
  Study study = study_with({"slow", "fast"});
  set_videos(study, {.files = {"fast=a=b.mp4", "slow=c.webm"}, .offset_s = -1.5});
  EXPECT_EQ(study.trials[0].video, "c.webm");
  EXPECT_EQ(study.trials[1].video, "a=b.mp4");
  EXPECT_EQ(study.trials[1].video_offset_s, -1.5);
  EXPECT_FALSE(study.trials[2].video);
}

TEST(TrialVideos, TheOnlyMovementNeedsNoName) {
  Study study = study_with({"slow"});
  study.trials[0].video_offset_s = 7.0;
  set_videos(study, {.files = {"film.mp4"}, .offset_s = {}});
  EXPECT_EQ(study.trials[0].video, "film.mp4");
  EXPECT_EQ(study.trials[0].video_offset_s, 0.0);  // the offset of another film
}

TEST(TrialVideos, WhatNamesNoTrialIsRefusedWithTheTrials) {
  const auto message = [](const VideoChoice& choice) {
    Study study = study_with({"slow", "fast"});
    return test::message_of([&] { set_videos(study, choice); });
  };
  EXPECT_THAT(message({{"film.mp4"}, {}}), HasSubstr("TRIAL=FILE"));
  EXPECT_THAT(message({{"slwo=film.mp4"}, {}}), HasSubstr("'slwo'"));
  EXPECT_THAT(message({{"slow="}, {}}), HasSubstr("slow="));
  EXPECT_THAT(message({{"slow=a.mp4", "slow=b.mp4"}, {}}), HasSubstr("already"));
  EXPECT_THAT(message({{}, 1.0}), HasSubstr("--video"));
}

TEST(TrialVideos, AMissingFilmIsNamedWithItsTrial) {
  const test::TemporaryFolder folder;
  Study study = study_with({"slow"});
  EXPECT_NO_THROW(require_videos(study));
  study.trials[0].video = std::string(folder / "film.mp4");
  EXPECT_THAT(test::message_of([&] { require_videos(study); }),
              testing::AllOf(HasSubstr("film.mp4"), HasSubstr("trial 'slow'")));
  write_file(*study.trials[0].video, "x");
  EXPECT_NO_THROW(require_videos(study));
}

}  // namespace
}  // namespace myoid::study
