#include "myoid/recording/series_file.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(SeriesFile, TheNameTellsTheFormatAndNumbersComeBackTheSame) {
  const test::TemporaryFolder folder;
  const TimeSeries series(Eigen::Vector3d(0.0, 0.01, 0.02), {{"BIC", Unit::newton}},
                          Eigen::Vector3d(0.1 + 0.2, -1e-17, 1e300));
  for (const char* name : {"a.sto", "a.mot", "a.csv", "a.CSV"}) {
    write_series(folder / name, series, "Forces");
    EXPECT_EQ(read_series(folder / name).data.column("BIC"), series.column("BIC")) << name;
  }
  EXPECT_NE(read_text_file(folder / "a.csv").find("BIC [N]"), std::string::npos);
  EXPECT_NE(read_text_file(folder / "a.sto").find("Forces"), std::string::npos);
  EXPECT_THROW(write_series(folder / "a.txt", series, "Forces"), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST(SeriesFile, WhatAReaderLeftOutIsKept) {
  const test::TemporaryFolder folder;
  write_file(folder / "cut.sto", "f\nendheader\ntime\tBIC\n0\t1.25\n0.1\t1.25\n0.2\t1.2");
  write_file(folder / "cut.csv", "time,BIC\n0,1.25\n0.1,1.25\n0.2,1.2");
  for (const char* name : {"cut.sto", "cut.csv"}) {
    const SeriesFile file = read_series(folder / name);
    EXPECT_EQ(file.data.sample_count(), 2) << name;
    ASSERT_EQ(file.repairs.size(), 1U) << name;
    EXPECT_EQ(file.repairs[0].message, kLastRowLeftOut);
    EXPECT_TRUE(file.repairs[0].lost);
  }
}

}  // namespace
}  // namespace myoid::recording
