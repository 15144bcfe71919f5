// Each command names each option once, documents it, allows its default and refuses numbers beyond its limits.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/commands/check.h"
#include "myoid/program/commands/cohort.h"
#include "myoid/program/commands/compare.h"
#include "myoid/program/commands/design.h"
#include "myoid/program/commands/identify_options.h"
#include "myoid/program/commands/info.h"
#include "myoid/program/commands/init.h"
#include "myoid/program/commands/model_page.h"
#include "myoid/program/commands/predict.h"
#include "myoid/program/commands/report.h"
#include "myoid/program/commands/review.h"
#include "myoid/program/commands/run.h"
#include "myoid/program/commands/run_tools.h"
#include "myoid/program/commands/twin.h"
#include "myoid/program/commands/twin_study.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/convert.h"
#include "myoid/program/steps/emg.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"
#include "myoid/program/steps/muscle.h"
#include "myoid/program/steps/paths.h"
#include "myoid/program/steps/simulate.h"
#include "myoid/program/steps/so.h"
#include "myoid/program/steps/sweep.h"

#include "tests/support/message_of.h"
#include "tests/support/places.h"

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

/// Collects the names of all options, those with dashes, and the numbers with their limits.
class Collector : public study::FlatSettingVisitor {
 public:
  std::multiset<std::string> names, named;
  std::vector<study::Setting> numbers;

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& /*set*/) override {
    names.insert(std::string(setting.key));
    if (!setting.about.option.by_place) named.insert(std::string(setting.key));
    if (is_number(setting)) numbers.push_back(setting);
    return false;
  }
};

template <typename Options>
class EveryCommand : public testing::Test {};

constexpr const char* kPages[] = {"check",    "cohort",   "compare", "convert", "design", "emg",
                                  "id",       "identify", "ik",      "info",    "init",   "info",
                                  "muscle",   "paths",    "predict", "report",  "review", "run",
                                  "run-tool", "simulate", "so",      "paths",   "twin",   "twin-study"};

/// The options of all commands, in the order of kPages.
template <typename... All>
struct Commands {
  using Types = testing::Types<All...>;

  template <typename Options>
  static std::string page() {
    const bool is[] = {std::is_same_v<Options, All>...};
    return kPages[std::find(std::begin(is), std::end(is), true) - std::begin(is)];
  }
};
using AllOptions = Commands<CheckOptions,
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
TYPED_TEST_SUITE(EveryCommand, AllOptions::Types);

TYPED_TEST(EveryCommand, NamesEachOptionOnceAndAllowsItsDefaults) {
  TypeParam options;
  Collector all;
  visit(options, all);
  EXPECT_EQ(all.names.size(), std::set<std::string>(all.names.begin(), all.names.end()).size());
  EXPECT_NO_THROW(check_options(options));
}

TYPED_TEST(EveryCommand, ExplainsItsOptionsOnItsPage) {
  TypeParam options;
  Collector all;
  visit(options, all);
  const std::string page = read_text_file(test::source_dir() / "docs/guide" / (AllOptions::page<TypeParam>() + ".md"));
  for (const std::string& name : all.named) EXPECT_THAT(page, HasSubstr("--" + name));
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
      EXPECT_THAT(test::message_of([&] { check_options(options); }),
                  HasSubstr("--" + std::string(number.key) + ": found"))
          << end;
    }
  }
}

}  // namespace
}  // namespace myoid::program
