#include "myoid/run/stage_store.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

body::IkResult some_result() {
  body::IkResult result;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  Eigen::MatrixXd q(3, 1);
  q << 0.1, 1.0 / 3.0, std::nextafter(0.5, 1.0);
  Eigen::MatrixXd errors = Eigen::MatrixXd::Constant(3, 2, 1e-3);
  errors(1, 1) = std::numeric_limits<double>::quiet_NaN();
  result.q = TimeSeries(time, {{"elbow_flexion", Unit::radian}}, q);
  result.errors = TimeSeries(time, {{"total", Unit::dimensionless}, {"wrist", Unit::meter}}, errors);
  result.status = {body::FrameStatus::converged, body::FrameStatus::not_converged, body::FrameStatus::no_markers};
  result.objective = {1e-300, 2.0, 3.0};
  result.frames_not_converged = 1;
  result.frames_without_markers = 1;
  result.open_coordinates = {"shoulder_rotation"};
  result.notes = {{.code = RemarkCode::reading, .severity = Severity::note, .says = "marker 'x' is not there"}};
  return result;
}

MarkerSeries some_markers() {
  MarkerSeries markers;
  markers.names = {"wrist"};
  markers.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  markers.positions_m = Eigen::MatrixXd::Constant(3, 3, 0.25);
  return markers;
}

TEST(StageStore, WhatWasKeptComesBackToTheLastBit) {
  const test::TemporaryFolder folder;
  const body::IkResult kept = some_result();
  StageStore(folder / "stages").keep("k", kept);
  const auto found = StageStore(folder / "stages").find("k");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->q.values(), kept.q.values());
  EXPECT_EQ(found->q.time_s(), kept.q.time_s());
  EXPECT_EQ(found->q.channels(), kept.q.channels());
  EXPECT_EQ(found->errors.channels(), kept.errors.channels());
  EXPECT_TRUE(std::isnan(found->errors.values()(1, 1)));
  EXPECT_EQ(found->errors.values()(2, 1), 1e-3);
  EXPECT_EQ(found->status, kept.status);
  EXPECT_EQ(found->objective, kept.objective);
  EXPECT_EQ(found->frames_not_converged, 1);
  EXPECT_EQ(found->frames_without_markers, 1);
  EXPECT_EQ(found->open_coordinates, kept.open_coordinates);
  EXPECT_EQ(sentences(found->notes), sentences(kept.notes));
  EXPECT_EQ(found->notes.front().code, RemarkCode::reading);
  EXPECT_EQ(found->notes.front().severity, Severity::note);
}

TEST(StageStore, ADamagedOrAbsentEntryIsAsGoodAsNone) {
  const test::TemporaryFolder folder;
  StageStore store(folder.path());
  EXPECT_FALSE(store.find("k"));
  store.keep("k", some_result());
  const auto file = folder / "ik-k.cbor";
  const auto size = std::filesystem::file_size(file);
  for (std::uintmax_t cut = 0; cut < size; cut += 7) {
    std::filesystem::resize_file(file, cut);
    EXPECT_FALSE(store.find("k")) << cut;
    store.keep("k", some_result());
  }
  std::ofstream(file, std::ios::binary) << "not what was written";
  EXPECT_FALSE(store.find("k"));
}

TEST(StageStore, OnlyEntriesOfThisRunSurviveIt) {
  const test::TemporaryFolder folder;
  StageStore(folder.path()).keep("old", some_result());
  StageStore(folder.path()).keep("found", some_result());
  StageStore store(folder.path());
  EXPECT_TRUE(store.find("found"));
  store.keep("new", some_result());
  store.remove_unused();
  EXPECT_FALSE(store.find("old"));
  EXPECT_TRUE(store.find("found"));
  EXPECT_TRUE(store.find("new"));
}

TEST(StageStore, TheKeyChangesWithEveryInputOfInverseKinematicsAndNoOther) {
  const study::Study study;
  const MarkerSeries markers = some_markers();
  const std::string key = ik_key(study, "<model/>", markers);
  EXPECT_EQ(key, ik_key(study, "<model/>", markers));
  EXPECT_NE(key, ik_key(study, "<model />", markers));
  MarkerSeries moved = markers;
  moved.positions_m(2, 2) = std::nextafter(0.25, 1.0);
  EXPECT_NE(key, ik_key(study, "<model/>", moved));
  moved = markers;
  moved.names = {"elbow"};
  EXPECT_NE(key, ik_key(study, "<model/>", moved));
  study::Study other = study;
  other.markers.weight["wrist"] = 2.0;
  EXPECT_NE(key, ik_key(other, "<model/>", markers));
  other = study;
  other.ik.lock = {"shoulder_flexion"};
  EXPECT_NE(key, ik_key(other, "<model/>", markers));
  other = study;
  other.model.forearm_length_m = 0.25;
  EXPECT_NE(key, ik_key(other, "<model/>", markers));
  other = study;
  other.emg.chain.lowpass_hz = 4.0;
  EXPECT_EQ(key, ik_key(other, "<model/>", markers));
}

}  // namespace
}  // namespace myoid::run
