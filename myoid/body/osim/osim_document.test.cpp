#include "myoid/body/osim/osim_document.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/body/osim/osim_writer.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::body {
namespace {

using ::testing::HasSubstr;

class OsimDocument : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] std::string whole(const std::string& text) const {
    return whole_document(text, folder_ / "a.osim").text;
  }
  test::TemporaryFolder folder_;
};

TEST_F(OsimDocument, ADocumentWithoutOtherFilesKeepsEveryByte) {
  const std::string text =
      "<OpenSimDocument><!-- file='x' -->\r\n<Model file=\"\"><model_file>f</model_file></Model>"
      "<S file = 'Unassigned'/></OpenSimDocument>\n";
  EXPECT_EQ(whole(text), text);
  EXPECT_TRUE(whole_document(text, folder_ / "a.osim").files.empty());
}

TEST_F(OsimDocument, AnElementOfAnotherFileStandsInItsPlaceByteForByte) {
  write("sets/m.xml",
        "<?xml version='1.0'?>\n<OpenSimDocument Version=\"20302\">\n<TaskSet name='t' >\n <!-- <TaskSet> -->"
        "<objects><A/><TaskSet/></objects>\n</TaskSet></OpenSimDocument>");
  EXPECT_EQ(
      whole("<OpenSimDocument><X><IKTaskSet file = 'sets\\m.xml' ><objects/></IKTaskSet>\n</X></OpenSimDocument>"),
      "<OpenSimDocument><X><IKTaskSet name='t' >\n <!-- <TaskSet> --><objects><A/><TaskSet/></objects>\n"
      "</IKTaskSet>\n</X></OpenSimDocument>");
  // A root without <OpenSimDocument>, and one that is empty.
  write("bare.xml", "<ScaleSet/>");
  EXPECT_EQ(whole("<T><ScaleSet name=\"s\" file=\"bare.xml\"/></T>"), "<T><ScaleSet/></T>");
}

TEST_F(OsimDocument, FilesNameFilesRelativeToThemselves) {
  write("sets/outer.xml", "<S><objects><B file='inner.xml'/><B file='../other.xml'/></objects></S>");
  write("sets/inner.xml", "<B name='one'/>");
  write("other.xml", "<B name='two'/>");
  EXPECT_EQ(whole("<D><S file='sets/outer.xml'/></D>"),
            "<D><S><objects><B name='one'/><B name='two'/></objects></S></D>");
}

TEST_F(OsimDocument, FilesThatHoldThemselvesAreRefused) {
  write("a.xml", "<S><S file='b.xml'/></S>");
  write("b.xml", "<S>\n<S file='a.xml'/></S>");
  EXPECT_THAT(test::message_of([&] { (void)whole("<D><S file='a.xml'/></D>"); }),
              ::testing::AllOf(HasSubstr("b.xml:2"), HasSubstr("a.xml -> b.xml -> a.xml")));
  // Each file names the next twice: 2^40 copies.
  for (int k = 0; k < 40; ++k) {
    const std::string next = "<S file='f" + std::to_string(k + 1) + ".xml'/>";
    write("f" + std::to_string(k) + ".xml", "<S>" + next + next + "</S>");
  }
  EXPECT_THAT(test::message_of([&] { (void)whole("<D><S file='f0.xml'/></D>"); }), HasSubstr("more than 1000 files"));
}

TEST_F(OsimDocument, AMissingFileIsNamedWithTheFilesThatAreThere) {
  write("MeasurementSet.xml", "<M/>");
  const std::string message = test::message_of([&] { (void)whole("<D>\n<M file='MeasurmentSet.xml'/></D>"); });
  EXPECT_THAT(message, HasSubstr("a.osim:2"));
  EXPECT_THAT(message, HasSubstr("did you mean 'MeasurementSet.xml'?"));
}

TEST_F(OsimDocument, AFaultIsToldWithTheFileAndLineOfTheElement) {
  write("forces.xml",
        "<OpenSimDocument Version=\"30000\"><ForceSet>\n<objects>\n<F><x>1</x>\n<y>two</y></F></objects></ForceSet>"
        "</OpenSimDocument>");
  const OsimXml xml(
      "<OpenSimDocument Version=\"40000\">\n\n<ForceSet file=\"forces.xml\"/>\n<z>three</z></OpenSimDocument>",
      folder_ / "a.osim");
  const auto force = OsimXml::objects(xml.root().child("ForceSet")).at(0);
  EXPECT_EQ(xml.number(force, "x", 0.0), 1.0);
  EXPECT_THAT(test::message_of([&] { (void)xml.number(force, "y", 0.0); }), HasSubstr("forces.xml:4"));
  EXPECT_THAT(test::message_of([&] { (void)xml.number(xml.root(), "z", 0.0); }), HasSubstr("a.osim:4"));
  EXPECT_EQ(xml.version(force), 30000);
  EXPECT_EQ(xml.version(xml.root()), 40000);
  EXPECT_EQ(xml.files(), std::vector<std::filesystem::path>{folder_ / "forces.xml"});
}

TEST_F(OsimDocument, AttributesWithoutMeaningAndReplacedContentAreTold) {
  write("s.xml", "<S/>");
  const OsimXml xml(
      "<OpenSimDocument Version='1' xmlns:a='b'>\n<S name='s' File='s.xml'/><S file='s.xml'><objects/></S>"
      "<S File='t'/></OpenSimDocument>",
      folder_ / "a.osim");
  ASSERT_EQ(xml.ignored().size(), 2U);
  EXPECT_THAT(xml.ignored()[0], ::testing::AllOf(HasSubstr("line 2"), HasSubstr("not read")));
  EXPECT_THAT(xml.ignored()[1], ::testing::AllOf(HasSubstr("'File'"), HasSubstr("did you mean 'file'")));
}

TEST_F(OsimDocument, ListsHaveAnyOfTheFormsOfSimTK) {
  for (const char* text : {"1 -2.5 3e1", "1, -2.5,3e1", "(1 -2.5 3e1)", "[1,-2.5, 3e1]", " ~[1,-2.5,3e1]"}) {
    const OsimXml xml(std::string("<OpenSimDocument><v>") + text + "</v></OpenSimDocument>", "a.osim");
    EXPECT_EQ(xml.numbers(xml.root().child("v")), (std::vector<double>{1.0, -2.5, 30.0})) << text;
  }
  // Decimal commas are no list.
  const OsimXml xml("<OpenSimDocument><v>0,5 0,7</v></OpenSimDocument>", "a.osim");
  EXPECT_THROW((void)xml.numbers(xml.root().child("v")), ReadError);
}

/// The models of the shared data whose sets stand in files, as .osim beside them.
class SetsInFiles : public OsimDocument {
 protected:
  [[nodiscard]] static std::filesystem::path data() {
    return test::data_folder() / "round3" / "opensim" / "file_attribute";
  }
  void SetUp() override {
    MYOID_REQUIRE_DATA(data());
    for (const auto& entry : std::filesystem::directory_iterator(data() / "refused")) {
      const std::string name = entry.path().filename().string();
      std::filesystem::copy_file(entry.path(), folder_ / name.substr(0, name.find(".txt")));
    }
  }
  [[nodiscard]] static std::string content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(SetsInFiles, AModelInSeveralFilesIsTheModelInOne) {
  const BodyModel one = read_osim(data() / "model.osim");
  for (const char* set : {"BodySet", "JointSet", "ForceSet", "MarkerSet"}) {
    const auto file = folder_ / (std::string("m_") + set + ".osim");
    const BodyModel m = read_osim(file);
    EXPECT_TRUE(m.unsupported.empty()) << set;
    EXPECT_EQ(m.bodies.size(), one.bodies.size()) << set;
    EXPECT_EQ(m.coordinates.size(), one.coordinates.size()) << set;
    EXPECT_EQ(m.markers.size(), one.markers.size()) << set;
    ASSERT_EQ(m.muscles.size(), one.muscles.size()) << set;
    for (std::size_t i = 0; i < m.muscles.size(); ++i) {
      EXPECT_EQ(m.muscles[i].properties.max_isometric_force_n, one.muscles[i].properties.max_isometric_force_n);
      EXPECT_EQ(m.muscles[i].path.points.size(), one.muscles[i].path.points.size());
    }
    EXPECT_EQ(m.default_q(), one.default_q()) << set;
    // Updated, it is one document.
    const UpdatedOsim updated = updated_osim(content(file), file);
    EXPECT_EQ(parse_osim(updated.text, "elsewhere/m.osim").muscles.size(), one.muscles.size()) << set;
  }
}

TEST_F(SetsInFiles, AChangedNumberChangesOneNumber) {
  for (const char* set : {"BodySet", "JointSet", "ForceSet", "MarkerSet"}) {
    const auto file = folder_ / (std::string("m_") + set + ".osim");
    const std::string before = read_whole_text(file);
    const std::string after = changed_osim(content(file), file, {{"ForceSet", "BRA", "max_isometric_force", {987.25}}});
    const std::string element = "<max_isometric_force>";
    const std::size_t at = before.find(element, before.find("name=\"BRA\"")) + element.size();
    EXPECT_EQ(after, before.substr(0, at) + "987.25" + before.substr(before.find('<', at))) << set;
  }
}

}  // namespace
}  // namespace myoid::body
