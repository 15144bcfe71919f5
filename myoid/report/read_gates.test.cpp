#include "myoid/report/read_gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/files/atomic_file.h"
#include "myoid/report/write_report.h"

#include "tests/support/temporary_folder.h"

namespace myoid::report {
namespace {

using report::GateStatus;
using ::testing::ElementsAre;

TEST(ReadGates, NamesThoseThatAReportDidNotPass) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(read_gates(folder.path()).failed.empty()) << "no report";
  report::Report page;
  page.gates = {{"Markers", GateStatus::pass},
                {"Range", GateStatus::warn},
                {"Predicts", GateStatus::fail},
                {"Power", GateStatus::info}};
  recording::write_file(folder / "report.json", report::report_json(page));
  const UnpassedGates gates = read_gates(folder.path());
  EXPECT_THAT(gates.failed, ElementsAre("Predicts"));
  EXPECT_THAT(gates.warned, ElementsAre("Range"));
}

TEST(ReadGates, RefuseADamagedReport) {
  const test::TemporaryFolder folder;
  for (const char* text : {"{\"gates\": [", "{}", "{\"gates\": [{\"status\": \"fail\"}]}"}) {
    recording::write_file(folder / "report.json", text);
    EXPECT_THROW((void)read_gates(folder.path()), ReadError) << text;
  }
}

}  // namespace
}  // namespace myoid::report
