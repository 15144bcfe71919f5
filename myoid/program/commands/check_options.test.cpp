#include "myoid/program/commands/check_options.h"

#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/program/commands/check.h"
#include "myoid/program/commands/cohort.h"
#include "myoid/program/commands/compare.h"
#include "myoid/program/commands/convert.h"
#include "myoid/program/commands/design.h"
#include "myoid/program/commands/emg.h"
#include "myoid/program/commands/id.h"
#include "myoid/program/commands/identify_options.h"
#include "myoid/program/commands/ik.h"
#include "myoid/program/commands/info.h"
#include "myoid/program/commands/init.h"
#include "myoid/program/commands/model_page.h"
#include "myoid/program/commands/muscle.h"
#include "myoid/program/commands/paths.h"
#include "myoid/program/commands/predict.h"
#include "myoid/program/commands/report.h"
#include "myoid/program/commands/review.h"
#include "myoid/program/commands/run.h"
#include "myoid/program/commands/run_tools.h"
#include "myoid/program/commands/simulate.h"
#include "myoid/program/commands/so.h"
#include "myoid/program/commands/sweep.h"
#include "myoid/program/commands/twin.h"
#include "myoid/program/commands/twin_study.h"

namespace myoid::program {
namespace {

using testing::HasSubstr;

/// Sets the number of one option.
class Setter : public study::FlatSettingVisitor {
 public:
  Setter(std::string key, double value) : key_(std::move(key)), value_(value) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& set) override {
    if (setting.key != key_) return false;
    set(setting.kind == study::SettingKind::numbers ? study::SettingValue(std::vector{value_, value_, value_})
                                                    : study::SettingValue(value_));
    return true;
  }

 private:
  std::string key_;
  double value_;
};

/// Collects the names of all options, and of the numbers with their limits.
class Collector : public study::FlatSettingVisitor {
 public:
  std::multiset<std::string> names;
  std::vector<study::Setting> numbers;

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& /*set*/) override {
    names.insert(std::string(setting.key));
    if (is_number(setting)) numbers.push_back(setting);
    return false;
  }
};

/// Returns the sentence that refuses the options; empty: they are allowed.
template <typename Options>
std::string refusal_of(const Options& options) {
  try {
    check_options(options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

template <typename Options>
class EveryCommand : public testing::Test {};

using AllOptions = testing::Types<CheckOptions,
                                  CohortOptions,
                                  CompareOptions,
                                  ConvertOptions,
                                  DesignOptions,
                                  EmgOptions,
                                  IdOptions,
                                  IdentifyOptions,
                                  IkOptions,
                                  InfoOptions,
                                  InitOptions,
                                  ModelPageOptions,
                                  MuscleOptions,
                                  PathsOptions,
                                  PredictOptions,
                                  ReportOptions,
                                  ReviewOptions,
                                  RunOptions,
                                  RunToolsOptions,
                                  SimulateOptions,
                                  SoOptions,
                                  SweepOptions,
                                  TwinOptions,
                                  TwinStudyOptions>;
TYPED_TEST_SUITE(EveryCommand, AllOptions);

TYPED_TEST(EveryCommand, NamesEachOptionOnceAndAllowsItsDefaults) {
  TypeParam options;
  Collector all;
  visit(options, all);
  EXPECT_EQ(all.names.size(), std::set<std::string>(all.names.begin(), all.names.end()).size());
  EXPECT_EQ(refusal_of(options), "");
}

TYPED_TEST(EveryCommand, RefusesANumberBeyondItsLimits) {
  TypeParam usual;
  Collector all;
  visit(usual, all);
  for (const study::Setting& number : all.numbers) {
    const study::SettingLimits& limits = number.about.limits;
    for (const double end : {limits.lower, limits.upper}) {
      if (!std::isfinite(end)) continue;
      if (end == 0.0 && number.kind == study::SettingKind::count) continue;  // -1 is no value of an unsigned field
      TypeParam options;
      Setter beyond(std::string(number.key), end == limits.lower ? end - 1.0 : end + 1.0);
      visit(options, beyond);
      EXPECT_THAT(refusal_of(options), HasSubstr("--" + std::string(number.key) + ": found")) << end;
    }
  }
}

TEST(CheckOptions, RefusesAWordAndATooShortList) {
  CheckOptions check;
  check.up = "upwards";
  EXPECT_THAT(refusal_of(check), HasSubstr("--up: found \"upwards\", expected one of x, y, z, -x, -y, -z"));
  IdOptions id;
  id.held.at_m = {0.0, 0.1};
  EXPECT_EQ(refusal_of(id), "--held-at: found 2 numbers, expected 3");
  id = {};
  id.cutoff_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of(id), "--lowpass: expected a finite number");
}

}  // namespace
}  // namespace myoid::program
