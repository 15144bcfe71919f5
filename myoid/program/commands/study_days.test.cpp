#include "myoid/program/commands/study_days.h"

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

TEST(StudyDays, AreThoseThatTheFilesStateEachOnceInOrder) {
  const test::TemporaryFolder folder;
  const auto edf = [&](const char* name, const std::string& date) {
    write_file(folder / name, std::string(168, ' ') + date + std::string(80, ' '));
    return std::filesystem::path(folder / name);
  };
  run::StudyResult result;
  result.trials.resize(4);
  result.trials[0].spec.emg = edf("a.edf", "02.03.26");
  result.trials[1].spec.emg = edf("b.edf", "01.03.26");
  result.trials[2].spec.emg = edf("c.edf", "02.03.26");
  result.trials[3].spec.emg = edf("d.edf", "01.01.85");
  add_days(result);
  EXPECT_EQ(result.recorded, (std::vector<std::string>{"2026-03-01", "2026-03-02"}));
  EXPECT_EQ(result.analysed.size(), 10U);
}

}  // namespace
}  // namespace myoid::program
