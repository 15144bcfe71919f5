// Set-up files of OpenSim's tools, run on a pendulum with three frames: results, or an error that is the file's. The
// second part of the input is a task, marker or measurement set that it may name.
#include "myoid/opensim/run_tool.h"

#include "fuzz.h"

namespace {

constexpr const char* kModel =
    "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><gravity>0 -9.81 0</gravity><BodySet>"
    "<objects><Body name=\"b\"><mass>1</mass><mass_center>0 -1 0</mass_center><inertia>1 1 1 0 0 0"
    "</inertia></Body></objects></BodySet><JointSet><objects><PinJoint name=\"j\">"
    "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b"
    "</socket_child_frame><coordinates><Coordinate name=\"q\"/></coordinates></PinJoint>"
    "</objects></JointSet><MarkerSet><objects><Marker name=\"A\"><socket_parent_frame>/bodyset/b"
    "</socket_parent_frame><location>0 -0.5 0</location></Marker><Marker name=\"B\">"
    "<socket_parent_frame>/bodyset/b</socket_parent_frame><location>0.1 -1 0</location></Marker>"
    "</objects></MarkerSet></Model></OpenSimDocument>";
constexpr const char* kMarkers =
    "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
    "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t3\t2\tm\t100\t1\t3\n"
    "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n1\t0\t0\t-0.5\t0\t0.1\t-1\t0\n"
    "2\t0.01\t0\t-0.5\t0\t0.1\t-1\t0\n3\t0.02\t0.01\t-0.5\t0\t0.12\t-1\t0\n";
constexpr const char* kMotion =
    "Coordinates\nversion=1\nnRows=4\nnColumns=2\ninDegrees=no\nendheader\ntime\tq\n0\t0\n"
    "0.01\t0.01\n0.02\t0.03\n0.03\t0.05\n";

/// Results stay in the folder of this process, whatever the set-up says, and do not replace inputs.
void claim(const std::filesystem::path& path) {
  const auto inside = std::filesystem::weakly_canonical(path);
  const auto home = std::filesystem::weakly_canonical(myoid::fuzz::folder());
  if (inside.parent_path() != home || inside.filename() == "m.osim" || inside.filename() == "m.trc" ||
      inside.filename() == "m.mot" || inside == home)
    throw myoid::InvalidInput("outside");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  static const bool ready = [] {
    fuzz::write("m.osim", kModel);
    fuzz::write("m.trc", kMarkers);
    fuzz::write("m.mot", kMotion);
    return true;
  }();
  static_cast<void>(ready);
  fuzz::write_parts(fuzz::text(data, size), {"setup.xml", "set.xml"});
  try {
    static_cast<void>(myoid::opensim::run_tool(fuzz::folder() / "setup.xml", {.claim = claim}));
  } catch (const myoid::ReadError&) {
  } catch (const myoid::InvalidInput&) {
  } catch (const myoid::ModelError&) {
  }
  return 0;
}
