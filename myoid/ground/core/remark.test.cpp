#include "myoid/ground/core/remark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

Remark hum(const std::string& where, const std::string& about) {
  return {.code = RemarkCode::emg_hum, .where = where, .about = about, .says = about + " hums"};
}

TEST(Remark, IsASentenceWithItsRemedy) {
  Remark remark{.says = "marker 'A' jumps"};
  EXPECT_EQ(sentence(remark), "marker 'A' jumps");
  remark.remedy = "remove it";
  EXPECT_EQ(sentence(remark), "marker 'A' jumps; remove it");
  EXPECT_EQ(name(RemarkCode::marker_unit), "marker_unit");
  EXPECT_EQ(name(RemarkCode::resting_torque), "resting_torque");
  EXPECT_EQ(name(Severity::error), "error");
  EXPECT_EQ(name(Severity::detail), "detail");
}

TEST(Remark, OfOneThingInSeveralPlacesIsSaidOnce) {
  std::vector<Remark> remarks;
  for (const char* trial : {"a", "b", "b", "c", "d", "e", "f"}) remarks.push_back(hum(trial, "BIC"));
  remarks.push_back(hum("b", "TRI"));
  remarks.push_back(hum("c", "BIC"));
  remarks.back().severity = Severity::note;
  const std::vector<Remark> kept = grouped(remarks);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].where, "a");
  EXPECT_EQ(sentence(kept[0]), "BIC hums (likewise in b, c, d, e and 1 more)");
  EXPECT_EQ(sentence(kept[1]), "TRI hums");
  EXPECT_EQ(kept[2].severity, Severity::note);
}

TEST(Remark, WithATimeOrOtherWordsAboutNothingInParticularStandsAlone) {
  std::vector<Remark> remarks{hum("a", "BIC"), hum("b", "BIC")};
  for (Remark& remark : remarks) remark.when = Stretch{0.0, 1.0};
  EXPECT_EQ(grouped(remarks).size(), 2U);
  EXPECT_EQ(grouped(remarks, Times::merged).size(), 1U);
  const std::vector<Remark> same = grouped({hum("a", ""), hum("b", ""), hum("b", "")}, Times::merged);
  ASSERT_EQ(same.size(), 1U);
  EXPECT_EQ(same[0].likewise, std::vector<std::string>{"b"});
  Remark other = hum("b", "");
  other.says += " louder";
  EXPECT_EQ(grouped({hum("a", ""), other}, Times::merged).size(), 2U);
}

// Silent channels of an amplifier with sixteen: one line that names them all.
TEST(Remark, ThatDifferByANameAloneNameAllOfThem) {
  const auto silent = [](const std::string& channel, const std::string& words, const std::string& remedy = {}) {
    return Remark{.code = RemarkCode::emg_flat,
                  .where = "a.c3d",
                  .about = channel,
                  .when = Stretch{0.0, 1.0},
                  .says = "channel '" + channel + "' " + words,
                  .remedy = remedy};
  };
  std::vector<Remark> remarks{silent("A", "is silent", "plug it"), silent("B", "is silent", "plug it"),
                              silent("C", "is loud"), silent("D", "is silent", "plug it"), silent("E", "is silent")};
  remarks.push_back(remarks[1]);
  remarks.back().where = "b.c3d";
  remarks.push_back({.says = "EMG short"});
  remarks.push_back({.says = "EMG short"});
  EXPECT_THAT(
      sentences(named_together(remarks)),
      testing::ElementsAre("channel 'A' is silent (likewise 'B', 'D'); plug it", "channel 'C' is loud",
                           "channel 'E' is silent", "channel 'B' is silent; plug it", "EMG short", "EMG short"));
}

TEST(Remark, AreSortedWorstFirstAndElseStay) {
  std::vector<Remark> remarks{hum("a", ""), hum("b", ""), hum("c", "")};
  remarks[0].severity = Severity::note;
  remarks[2].severity = Severity::error;
  sort_by_severity(remarks);
  EXPECT_EQ(remarks[0].where, "c");
  EXPECT_EQ(remarks[1].where, "b");
  EXPECT_EQ(remarks[2].where, "a");
}

}  // namespace
}  // namespace myoid::inline ground
