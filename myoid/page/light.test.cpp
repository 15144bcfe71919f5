#include "myoid/page/light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

using testing::HasSubstr;

TEST(Light, HasTheColorAndTheShapeOfTheWorstAnswer) {
  const Gate good{.name = "Markers fit", .status = GateStatus::pass};
  const Gate doubtful{.name = "EMG is clean", .status = GateStatus::warn, .value = "3 found"};
  const Gate bad{.name = "Fit converged", .status = GateStatus::fail, .value = "no"};
  EXPECT_THAT(light_html({good}), HasSubstr("light pass"));
  EXPECT_THAT(light_html({good, doubtful}), HasSubstr("these ask for caution:</p>"));
  EXPECT_THAT(light_html({good, doubtful}), HasSubstr("<li>EMG is clean: 3 found</li>"));
  EXPECT_THAT(light_html({good, doubtful, bad}), HasSubstr("<ul><li>Fit converged: no</li></ul>"));
  EXPECT_THAT(light_html({good, doubtful, bad}), HasSubstr("1 of 3 questions"));
  EXPECT_THAT(light_html({good, doubtful, bad}), HasSubstr(doubtful.name));
  EXPECT_EQ(light_of({good, doubtful}).besides, "");
}

TEST(Light, CountsNoQuestionThatWasNotAsked) {
  const Gate good{.name = "Markers fit", .status = GateStatus::pass};
  const Gate unasked{.name = "Predicts", .status = GateStatus::info, .asked = false};
  EXPECT_NE(light_of({good}).head, light_of({good, unasked}).head);
  EXPECT_TRUE(light_of({good, unasked}).answered.starts_with(light_of({good}).answered));
}

TEST(Light, NamesWhatExplainsTheOthersFirst) {
  const Gate bad{.name = "Fit converged", .status = GateStatus::fail};
  const Gate cause{.name = "Electrodes", .status = GateStatus::warn, .explains = true};
  const Light light = light_of({bad, cause});
  EXPECT_EQ(light.status, GateStatus::fail);
  ASSERT_EQ(light.reasons.size(), 2U);
  EXPECT_EQ(light.reasons[0].name, cause.name);
  EXPECT_EQ(light.besides, "");
}

}  // namespace
}  // namespace myoid::page
