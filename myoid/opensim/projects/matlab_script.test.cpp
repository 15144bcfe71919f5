#include "myoid/opensim/projects/matlab_script.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::opensim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MatlabScript, HasTextsNumbersAndListsOfThem) {
  const auto found = matlab_assignments(
      "a = 'it''s'; b = -1.5e-3\nc = {'x', 'y'}; d = [0.5 1; 2 3];\ne = {'p';\n  'q'};  f = []\ng = \"two words\";\n");
  EXPECT_THAT(found.at("a").all_texts(), ElementsAre("it's"));
  EXPECT_THAT(found.at("b").numbers, ElementsAre(ElementsAre(-1.5e-3)));
  EXPECT_THAT(found.at("c").texts, ElementsAre(ElementsAre("x", "y")));
  EXPECT_THAT(found.at("d").numbers, ElementsAre(ElementsAre(0.5, 1.0), ElementsAre(2.0, 3.0)));
  EXPECT_THAT(found.at("e").texts, ElementsAre(ElementsAre("p"), ElementsAre("q")));
  EXPECT_FALSE(found.at("f").is_computed);
  EXPECT_THAT(found.at("f").all_texts(), IsEmpty());
  EXPECT_THAT(found.at("g").all_texts(), ElementsAre("two words"));
  EXPECT_EQ(found.at("a").line, 1U);
  EXPECT_EQ(found.at("g").line, 5U);
}

TEST(MatlabScript, PassesOverCommentsBlocksAndContinuations) {
  const auto found = matlab_assignments(
      "% a = 1\na = 2; % = 3\n%{\nb = 1\n%{\nb = 2\n%}\nb = 3\n%}\nc = {'50 %', ... the rest\n 'y'}; d = {'x'}; % "
      "'z'}\n");
  EXPECT_THAT(found.at("a").numbers, ElementsAre(ElementsAre(2.0)));
  EXPECT_FALSE(found.contains("b"));
  EXPECT_THAT(found.at("c").texts, ElementsAre(ElementsAre("50 %", "y")));
  EXPECT_THAT(found.at("d").all_texts(), ElementsAre("x"));
}

TEST(MatlabScript, JoinsPathsOfKnownParts) {
  const auto found = matlab_assignments(
      "here = pwd;\ndata = [pwd '\\Data'];\nMisc.IKfile = {fullfile(data,'a.mot'); fullfile(here, 'sub', 'b.mot')};\n"
      "Misc.Same = Misc.IKfile;\n");
  EXPECT_THAT(found.at("Misc.IKfile").texts, ElementsAre(ElementsAre(".\\Data/a.mot"), ElementsAre("./sub/b.mot")));
  EXPECT_EQ(found.at("Misc.Same").texts, found.at("Misc.IKfile").texts);
}

TEST(MatlabScript, SaysWhatItCannotKnow) {
  const auto found = matlab_assignments(
      "n = size(x, 1);\ntime = zeros(n, 2);\nfor i = 1:n\n  time(i,:) = [0 1];\nend\nnames = strcat(a, 'b');\n"
      "m = {'soleus_r',20};\nb = a';\nif n == 3, k = 1, end\np = fullfile(n, 'x');\ny = {'open', 'never closed';\n");
  for (const char* name : {"n", "time", "names", "m", "b", "p", "y"}) EXPECT_TRUE(found.at(name).is_computed) << name;
  EXPECT_EQ(found.at("time").line, 4U);
  EXPECT_THAT(found.at("k").numbers, ElementsAre(ElementsAre(1.0)));
}

TEST(MatlabScript, TurnsAListAndKeepsAQuoteInIt) {
  const auto found = matlab_assignments("a = {'x','y'}'; b = [1 2]'; c = a';\n");
  EXPECT_THAT(found.at("a").all_texts(), ElementsAre("x", "y"));
  EXPECT_THAT(found.at("b").numbers, ElementsAre(ElementsAre(1.0, 2.0)));
  EXPECT_THAT(found.at("c").all_texts(), ElementsAre("x", "y"));
}

TEST(MatlabScript, HasNoEndThatAnyTextCannotReach) {
  for (const std::string text :
       {"a = [", "a = '", "a = {'x", "%{\n", "a = [[[[[[[", "...", "= 3", "a = (", "'", "a.b.=1"})
    (void)matlab_assignments(text);
  EXPECT_TRUE(matlab_assignments("a = " + std::string(1000, '[')).at("a").is_computed);
  std::string deep = "a = ", doubled = "a = {'x'};\n";
  for (int k = 0; k < 1000; ++k) deep += "fullfile(";
  for (int k = 0; k < 100; ++k) doubled += "a = {a a};\n";
  EXPECT_TRUE(matlab_assignments(deep).at("a").is_computed);
  EXPECT_TRUE(matlab_assignments(doubled).at("a").is_computed);
}

}  // namespace
}  // namespace myoid::opensim
