#include "myoid/page/read_gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/page/write_report.h"

#include "tests/support/temporary_folder.h"

namespace myoid::page {
namespace {

using page::GateStatus;
using ::testing::ElementsAre;

TEST(ReadGates, NamesThoseThatAReportDidNotPass) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(read_gates(folder.path()).failed.empty()) << "no report";
  page::Report page;
  page.gates = {{"Markers", GateStatus::pass},
                {"Range", GateStatus::warn},
                {"Predicts", GateStatus::fail},
                {"Power", GateStatus::info}};
  write_file(folder / "report.json", page::report_json(page));
  const UnpassedGates gates = read_gates(folder.path());
  EXPECT_THAT(gates.failed, ElementsAre("Predicts"));
  EXPECT_THAT(gates.warned, ElementsAre("Range"));
}

TEST(ReadGates, RefuseADamagedReport) {
  const test::TemporaryFolder folder;
  for (const char* text : {"{\"gates\": [", "{}", "{\"gates\": [{\"status\": \"fail\"}]}"}) {
    write_file(folder / "report.json", text);
    EXPECT_THROW((void)read_gates(folder.path()), ReadError) << text;
  }
}

}  // namespace
}  // namespace myoid::page
