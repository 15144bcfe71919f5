#include "myoid/body/osim/osim_writer.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A set with one muscle, written the way `muscle` says.
std::string document(const std::string& muscle, const std::string& end = "\n") {
  std::string text =
      "<?xml version='1.0'?>\n<OpenSimDocument Version=\"40000\">\n <Model name=\"m\">\n"
      "  <!-- a <remark> -->\n  <ForceSet><objects>\n" +
      muscle + "\n  </objects></ForceSet>\n </Model>\n</OpenSimDocument>\n";
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

std::string changed(const std::string& text, const std::vector<OsimChange>& changes) {
  return changed_osim(text, "m.osim", changes);
}

/// `before` with the one place replaced.
std::string replaced(std::string before, const std::string& what, const std::string& by) {
  const auto at = before.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return before.replace(at, what.size(), by);
}

TEST(ChangedOsim, ReplacesTheNumberAndNothingElse) {
  const std::string text = document(
      "  <Thelen2003Muscle   name='a'><max_isometric_force> 1e2\t</max_isometric_force >"
      "<isDisabled>false</isDisabled></Thelen2003Muscle>");
  EXPECT_EQ(changed(text, {{"ForceSet", "a", "max_isometric_force", {123.25}}}), replaced(text, " 1e2\t", " 123.25\t"));
}

TEST(ChangedOsim, LeavesANumberThatIsTheSameInItsOwnDigits) {
  const std::string text = document("<Thelen2003Muscle name=\"a\"><Af>0.2500</Af><Flen>1.40</Flen></Thelen2003Muscle>");
  EXPECT_EQ(changed(text, {{"ForceSet", "a", "Af", {0.25}}, {"ForceSet", "a", "Flen", {1.5}}}),
            replaced(text, "1.40", "1.5"));
}

TEST(ChangedOsim, KeepsLineEndsAndByteOrderMark) {
  const std::string muscle = "    <Thelen2003Muscle name=\"a\">\n      <Af>\n  0.2\n </Af>\n    </Thelen2003Muscle>";
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    for (const std::string end : {"\n", "\r\n"}) {
      const std::string text = mark + document(muscle, end);
      EXPECT_EQ(changed(text, {{"ForceSet", "a", "Af", {0.3}}}), replaced(text, "0.2", "0.3"));
    }
  }
}

TEST(ChangedOsim, AddsWhatTheFileLeavesToItsDefault) {
  const std::string muscle = "    <Thelen2003Muscle name=\"a>b\">\n      <Flen>1.4</Flen>\n    </Thelen2003Muscle>";
  for (const std::string end : {"\n", "\r\n"}) {
    const std::string text = document(muscle, end);
    EXPECT_EQ(changed(text, {{"ForceSet", "a>b", "Af", {0.3}}}),
              replaced(text, "\"a>b\">", "\"a>b\">" + end + "      <Af>0.3</Af>"));
  }
  // No blanks between the elements: none are added.
  const std::string dense = document("<Thelen2003Muscle name='a'><Flen>1</Flen></Thelen2003Muscle>");
  EXPECT_EQ(changed(dense, {{"ForceSet", "a", "Af", {0.3}}}), replaced(dense, "name='a'>", "name='a'><Af>0.3</Af>"));
  // Two at the same place.
  EXPECT_EQ(changed(dense, {{"ForceSet", "a", "Af", {0.3}}, {"ForceSet", "a", "KshapeActive", {1}}}),
            replaced(dense, "name='a'>", "name='a'><Af>0.3</Af><KshapeActive>1</KshapeActive>"));
}

TEST(ChangedOsim, FillsAnEmptyElement) {
  for (const char* empty : {"<Af/>", "<Af />", "<Af></Af>", "<Af ></Af >", "<Af> </Af>"}) {
    const std::string text =
        document("<Thelen2003Muscle name='a'>" + std::string(empty) + "<Flen>1.4</Flen></Thelen2003Muscle>");
    const std::string after = changed(text, {{"ForceSet", "a", "Af", {0.3}}});
    EXPECT_EQ(after.find("<Af"), text.find("<Af"));
    EXPECT_NE(after.find("0.3"), std::string::npos) << after;
    EXPECT_EQ(after.substr(after.find("<Flen>")), text.substr(text.find("<Flen>"))) << empty;
    EXPECT_EQ(changed(after, {{"ForceSet", "a", "Af", {0.3}}}), after) << empty;
  }
  const std::string whole = document("<Thelen2003Muscle name='a'/>");
  const std::string after = changed(whole, {{"ForceSet", "a", "Af", {0.3}}});
  EXPECT_EQ(after, replaced(whole, "name='a'/>", "name='a'><Af>0.3</Af></Thelen2003Muscle>"));
}

TEST(ChangedOsim, WritesOverNumbersAmongComments) {
  const std::string text = document("<Thelen2003Muscle name='a'><Af><!-- old: 0.1 -->0.2</Af></Thelen2003Muscle>");
  EXPECT_EQ(changed(text, {{"ForceSet", "a", "Af", {0.3}}}), replaced(text, "0.2<", "0.3<"));
}

TEST(ChangedOsim, SaysWhatItCannotChange) {
  const std::string text = document("<Thelen2003Muscle name='a'><Af>1</Af></Thelen2003Muscle>");
  EXPECT_THROW((void)changed(text, {{"ForceSet", "b", "Af", {0.3}}}), ModelError);
  EXPECT_THROW((void)changed(text, {{"ForceSet", "a", "Af", {std::nan("")}}}), ModelError);
  EXPECT_THROW((void)changed(text, {{"ForceSet", "a", "Af", {0.3}}, {"ForceSet", "a", "Af", {0.4}}}), ModelError);
  EXPECT_THROW((void)changed("<OpenSimDocument", {}), InvalidInput);
}

/// The numbers of every muscle but one stay, as do all bytes around the one that changes.
void expect_only_this_changes(const std::string& text, const std::filesystem::path& file) {
  EXPECT_EQ(changed_osim(text, file, {}), text) << file;
  const BodyModel before = parse_osim(text, file);
  for (const Muscle& muscle : before.muscles) {
    const double value = muscle.properties.max_isometric_force_n;
    EXPECT_EQ(changed_osim(text, file, {{"ForceSet", muscle.name, "max_isometric_force", {value}}}), text)
        << file << " " << muscle.name;
  }
  if (before.muscles.empty()) return;
  const Muscle& muscle = before.muscles[before.muscles.size() / 2];
  const double fiber_m = muscle.properties.optimal_fiber_length_m + 0.00123456789;
  const std::string after = changed_osim(text, file, {{"ForceSet", muscle.name, "optimal_fiber_length", {fiber_m}}});
  // The common beginning and end leave less than a number's digits between them.
  const auto [a, b] = std::mismatch(text.begin(), text.end(), after.begin(), after.end());
  const auto [ra, rb] = std::mismatch(text.rbegin(), text.rend(), after.rbegin(), after.rend());
  EXPECT_LE((text.end() - a) - (ra - text.rbegin()), 24) << file;
  EXPECT_NE(b, after.end());
  EXPECT_NE(rb, after.rend());
  const BodyModel changed_model = parse_osim(after, file);
  for (std::size_t m = 0; m < before.muscles.size(); ++m) {
    EXPECT_EQ(changed_model.muscles[m].properties.optimal_fiber_length_m,
              before.muscles[m].name == muscle.name ? fiber_m : before.muscles[m].properties.optimal_fiber_length_m);
    EXPECT_EQ(changed_model.muscles[m].properties.max_isometric_force_n,
              before.muscles[m].properties.max_isometric_force_n);
  }
}

TEST(ChangedOsim, ChangesOneNumberOfTheBuiltInArm) { expect_only_this_changes(arm4_osim({}), "arm4.osim"); }

TEST(ChangedOsim, ChangesOneNumberOfEveryPublicModelAndLeavesAllOtherBytes) {
  const auto folder = test::data_folder();
  MYOID_REQUIRE_DATA(folder / "opensim");
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".osim") continue;
    const std::string text = content(entry.path());
    expect_only_this_changes(text, entry.path());
    // The same file as another editor would have saved it.
    if (++count % 4 == 0) expect_only_this_changes("\xEF\xBB\xBF" + text, entry.path());
  }
  EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace myoid::body
