#include "myoid/program/commands/identify_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/study/setting_rows.h"

#include "tests/support/printed_page.h"

namespace myoid::program {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(IdentifyOptions, AreTheOnesThatTheGuidePrints) {
  test::expect_printed("docs/guide/identify.md", "options",
                       study::markdown(study::option_rows(IdentifyOptions{}), "option"));
}

TEST(IdentifyOptions, WhatTheMethodDoesNotUseIsSaid) {
  IdentifyOptions o;
  EXPECT_THAT(without_effect(o), IsEmpty());
  o.files.forces = {"f.sto"};
  EXPECT_THAT(without_effect(o), ElementsAre(HasSubstr("--forces has no effect")));
  o.method = fit::Method::force;
  o.files.torques = {"t.sto"};
  EXPECT_THAT(without_effect(o), ElementsAre(HasSubstr("--torques has no effect")));
  o.compare_solvers = true;
  o.starts = 4;
  EXPECT_THAT(without_effect(o),
              ElementsAre(HasSubstr("--compare-solvers"), HasSubstr("--starts"), HasSubstr("--torques")));
  o.method = fit::Method::paper;
  o.posterior_draws = 400;
  EXPECT_THAT(without_effect(o), ElementsAre(HasSubstr("--posterior-draws"), HasSubstr("--torques")));
  o.posterior_draws = 0;
  o.beliefs = "study.toml";
  EXPECT_THAT(without_effect(o), ElementsAre(HasSubstr("--beliefs"), HasSubstr("--torques")));
  o.beliefs.reset();
  EXPECT_THAT(without_effect(o), ElementsAre(HasSubstr("--torques")));
}

TEST(IdentifyOptions, WhatTheMethodOrTheFilesCannotGiveIsRefused) {
  const run::MuscleTable table;
  IdentifyOptions o;
  EXPECT_NO_THROW(refuse_impossible(o, table));
  o.free_more = {"joint_viscosity"};
  EXPECT_THROW(refuse_impossible(o, table), InvalidInput);  // no motion
  o.files.motions = {"m.mot"};
  EXPECT_NO_THROW(refuse_impossible(o, table));
  o.method = fit::Method::force;
  EXPECT_THROW(refuse_impossible(o, table), InvalidInput);  // the joint's
  o = {};
  o.method = fit::Method::paper;
  o.delay_s = 0.05;
  EXPECT_THROW(refuse_impossible(o, table), InvalidInput);
  o = {};
  EXPECT_NO_THROW(check_options(o));
  o.delay_s = 60.0;  // ms
  EXPECT_THROW(check_options(o), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
