#include "myoid/core/finding.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(Finding, OfAFaultIsItsSentenceAndAWarningIfTheFaultIsGrave) {
  Fault fault;
  fault.kind = FaultKind::emg_hum;
  fault.text = "hum";
  fault.remedy = "mend it";
  for (const bool grave : {true, false}) {
    fault.grave = grave;
    const Finding f = finding("slow", fault);
    EXPECT_EQ(name(f.level), grave ? "warning" : "note");
    EXPECT_EQ(f.where, "slow");
    EXPECT_EQ(f.message, "hum; mend it");
    ASSERT_TRUE(f.fault);
    EXPECT_EQ(f.fault->kind, FaultKind::emg_hum);
  }
  EXPECT_EQ(name(Finding::Level::error), "error");
}

}  // namespace
}  // namespace myoid
