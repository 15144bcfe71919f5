// Models and set-up files that are broken in the ways files break: a clear error, and nothing written.
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;

const std::string kModel = R"(<?xml version="1.0" encoding="UTF-8" ?>
<OpenSimDocument Version="40000">
<Model name="two_links">
<BodySet><objects>
<Body name="upper"><mass>2</mass><mass_center>0 -0.15 0</mass_center><inertia>0.02 0.002 0.02 0 0 0</inertia></Body>
<Body name="lower"><mass>1</mass><mass_center>0 -0.1 0</mass_center><inertia>0.01 0.001 0.01 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet><objects>
<PinJoint name="shoulder">
<socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/upper</socket_child_frame>
<coordinates><Coordinate name="q1"><range>-3 3</range></Coordinate></coordinates>
</PinJoint>
<PinJoint name="elbow">
<socket_parent_frame>elbow_in_upper</socket_parent_frame>
<socket_child_frame>/bodyset/lower</socket_child_frame>
<coordinates><Coordinate name="q2"><range>-3 3</range></Coordinate></coordinates>
<frames><PhysicalOffsetFrame name="elbow_in_upper"><socket_parent>/bodyset/upper</socket_parent>
<translation>0 -0.3 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame></frames>
</PinJoint>
</objects></JointSet>
<MarkerSet><objects>
<Marker name="hand"><socket_parent_frame>/bodyset/lower</socket_parent_frame><location>0 -0.2 0</location></Marker>
</objects></MarkerSet>
</Model>
</OpenSimDocument>
)";

const std::string kMarkers =
    "PathFileType\t4\t(X/Y/Z)\tm.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\n100\t100\t2\t1\tmm\t100\t1\t2\nFrame#\tTime\thand\n\t\tX1\tY1\tZ1\n\n"
    "1\t0\t100\t-450\t0\n2\t0.01\t105\t-450\t0\n";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kModel;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the model holds no " + from);
  return text.replace(at, from.size(), to);
}

std::string nested(std::size_t bytes) {
  std::string text = "<OpenSimDocument Version=\"40000\"><Model name=\"deep\">";
  while (text.size() < bytes) text += "<a>";
  return text;
}

struct Broken {
  std::string how;
  std::string text;
  std::string said;
};

std::vector<Broken> broken_models() {
  return {{"empty", "", "is empty"},
          {"no XML", "Dear reader,\nthis is no model.\n", "not valid XML"},
          {"truncated", kModel.substr(0, kModel.size() / 2), "cut off"},
          {"cut after a tag", kModel.substr(0, kModel.find("<JointSet>")), "cut off"},
          {"another document", "<?xml version=\"1.0\"?>\n<html><body/></html>\n", "<OpenSimDocument>"},
          {"no model", "<OpenSimDocument Version=\"40000\"/>", "no <Model>"},
          {"no bodies", "<OpenSimDocument Version=\"40000\"><Model name=\"m\"/></OpenSimDocument>", "BodySet"},
          {"10 MB of nesting", nested(10'000'000), "nest more than"},
          {"cyclic", with("/ground<", "/bodyset/lower<"), "hangs on"},
          {"a frame on itself", with("<socket_parent>/bodyset/upper<", "<socket_parent>elbow_in_upper<"),
           "refers to itself"},
          {"a body jointed to itself", with("/ground<", "/bodyset/upper<"), "with itself"},
          {"missing socket", with("<socket_child_frame>/bodyset/lower</socket_child_frame>", ""),
           "'child_frame' is missing"},
          {"socket to nowhere", with("/bodyset/lower</socket_child", "/bodyset/none</socket_child"),
           "no frame '/bodyset/none'"},
          {"joint without parent", with("<socket_parent_frame>/ground</socket_parent_frame>", ""),
           "'parent_frame' is missing"},
          {"body without joint",
           with("</objects></BodySet>",
                "<Body name=\"alone\"><mass>1</mass><inertia>1 1 1 0 0 0</inertia>"
                "</Body></objects></BodySet>"),
           "'alone' is not connected"},
          {"two bodies of one name", with("name=\"lower\"", "name=\"upper\""), "two bodies"},
          {"negative mass", with("<mass>1<", "<mass>-1<"), "0 or more"},
          {"mass that is no number", with("<mass>1<", "<mass>heavy<"), "'heavy'"},
          {"vector of two numbers", with("0 -0.1 0<", "0 -0.1<"), "three numbers"},
          {"marker at infinity", with("0 -0.2 0<", "0 inf 0<"), "finite"}};
}

TEST(MalformedModels, TheModelThatIsBrokenBelowWorks) {
  const TemporaryFolder folder;
  write_text(folder / "m.osim", kModel);
  write_text(folder / "m.trc", kMarkers);
  EXPECT_EQ(myoid({"info", folder / "m.osim"}).exit_code, 0);
  const Finished ik =
      myoid({"ik", "--model", folder / "m.osim", "--markers", folder / "m.trc", "--out", folder / "ik.mot"});
  EXPECT_EQ(ik.exit_code, 0) << ik.err;
}

TEST(MalformedModels, AreAClearError) {
  for (const Broken& broken : broken_models()) {
    const TemporaryFolder folder;
    const std::string model = folder / "m.osim";
    write_text(model, broken.text);
    write_text(folder / "m.trc", kMarkers);
    for (const auto& command : std::vector<std::vector<std::string>>{
             {"info", model}, {"ik", "--model", model, "--markers", folder / "m.trc", "--out", folder / "ik.mot"}}) {
      const Finished done = myoid(command);
      EXPECT_EQ(done.exit_code, 3) << broken.how << ": " << done.err;
      EXPECT_THAT(done.err, HasSubstr(broken.said)) << broken.how;
      EXPECT_THAT(done.err, HasSubstr("m.osim")) << broken.how;
      EXPECT_EQ(done.out, "") << broken.how;
      EXPECT_FALSE(std::filesystem::exists(folder / "ik.mot")) << broken.how;
    }
  }
}

TEST(MalformedModels, SoAreSetUpFiles) {
  const std::string setup =
      "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n"
      "<InverseKinematicsTool name=\"ik\">\n<model_file>m.osim</model_file>\n"
      "<marker_file>m.trc</marker_file>\n<output_motion_file>ik.mot</output_motion_file>\n"
      "</InverseKinematicsTool>\n</OpenSimDocument>\n";
  const std::vector<Broken> setups{{"empty", "", "empty"},
                                   {"no XML", "name = ik\n", "not valid XML"},
                                   {"truncated", setup.substr(0, setup.size() / 2), "cut off"},
                                   {"nesting", nested(10'000'000), "nest more than"},
                                   {"a model", kModel, "Model"},
                                   {"no tool", "<OpenSimDocument Version=\"40000\"/>", "tool"}};
  for (const Broken& broken : setups) {
    const TemporaryFolder folder;
    write_text(folder / "m.osim", kModel);
    write_text(folder / "m.trc", kMarkers);
    write_text(folder / "setup.xml", broken.text);
    const Finished done = myoid({"run-tool", folder / "setup.xml"});
    EXPECT_EQ(done.exit_code, 3) << broken.how << ": " << done.err;
    EXPECT_THAT(done.err, HasSubstr(broken.said)) << broken.how;
    EXPECT_THAT(done.err, HasSubstr("setup.xml")) << broken.how;
    EXPECT_FALSE(std::filesystem::exists(folder / "ik.mot")) << broken.how;
  }
}

}  // namespace
