// Small files of our own to begin from: fuzz_seeds FOLDER writes one folder for each target.
#include <filesystem>
#include <string>

#include "myoid/recording/atomic_file.h"
#include "myoid/recording/c3d_writer.h"

namespace {

namespace fs = std::filesystem;
using namespace myoid::recording;

C3dFile small_c3d() {
  C3dFile file;
  file.point_rate_hz = 50.0;
  file.point_unit = "mm";
  file.point_scale = 0.25F;
  file.point_labels = {"A", "S:B"};
  file.points = C3dFile::Rows::Constant(3, 8, 0.25F);
  for (const Eigen::Index residual : {3, 7}) file.points.col(residual).setZero();
  file.points(1, 3) = -1.0F;
  file.analog_per_frame = 2;
  file.analog = C3dFile::Rows::Constant(6, 6, 10.0F);
  for (int c = 0; c < 6; ++c) file.channels.push_back({"F" + std::to_string(c), "N", 2.0, -0.5});
  file.events = {{0.02, "On", "Left", "S"}};
  C3dGroup group{1, "FORCE_PLATFORM", "", false, {}};
  const auto add = [&](const char* name, C3dType type, std::vector<std::uint8_t> dimensions,
                       std::vector<double> numbers) {
    C3dParameter p;
    p.name = name;
    p.type = type;
    p.dimensions = std::move(dimensions);
    p.numbers = std::move(numbers);
    group.parameters.push_back(std::move(p));
  };
  add("USED", C3dType::integer, {}, {1});
  add("TYPE", C3dType::integer, {1}, {2});
  add("CORNERS", C3dType::real, {3, 4, 1},
      {300, 200, 0, -300, 200, 0, -300, -200, 0, 300, -200, 0});
  add("ORIGIN", C3dType::real, {3, 1}, {0, 0, -40});
  add("CHANNEL", C3dType::integer, {6, 1}, {1, 2, 3, 4, 5, 6});
  file.groups = {group};
  return file;
}

std::string small_edf() {
  const auto pad = [](std::string text, std::size_t n) {
    return text.append(n - text.size(), ' ');
  };
  std::string out = pad("0", 8) + pad("X", 80) + pad("Startdate X", 80) + "01.01.2520.00.00";
  out += pad("768", 8) + pad("EDF+C", 44) + pad("2", 8) + pad("0.5", 8) + pad("2", 4);
  out += pad("EMG", 16) + pad("EDF Annotations", 16) + pad("", 160) + pad("uV", 8) + pad("", 8);
  out += pad("-100", 8) + pad("-1", 8) + pad("100", 8) + pad("1", 8) + pad("-32768", 8) +
         pad("-32768", 8);
  out += pad("32767", 8) + pad("32767", 8) + pad("", 160) + pad("4", 8) + pad("8", 8) + pad("", 64);
  for (int r = 0; r < 2; ++r) {
    std::string record(24, '\1');
    record.replace(8, 10, std::string("+0\x14\x14\0+0.1\x14", 10));
    out += record;
  }
  return out;
}

void write(const fs::path& folder, const std::string& name, const std::string& content) {
  write_file(folder / name, content);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const fs::path root = argv[1];
  int n = 0;
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    for (const bool integer : {false, true})
      write_c3d(root / "c3d" / std::to_string(++n), small_c3d(), {processor, integer});
  }
  write(root / "edf", "1", small_edf());
  write(root / "trc", "1",
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
        "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t2\t1\tmm\t100\t1\t2\n"
        "Frame#\tTime\tA\t\t\n\t\tX1\tY1\tZ1\n\n1\t0\t1.5\t2\t3\n2\t0.01\t\t\t\n");
  write(root / "sto", "1",
        "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n\nendheader\ntime\ta\tb\n"
        "0\t1\t-2e-3\n0.01\tnan\t4\n");
  write(root / "sto", "2", "DataType=Vec3\nversion=3\nendheader\ntime\ta\n0\t1,2,3\n1\t4,5,6\n");
  write(root / "csv", "1", "time,Biceps [mV]\n0,1\n0.5,2\n");
  write(root / "csv", "2", "Frequency;1500\n\ntime;LT BIC\ns;uV\n0,0;1,5\n0,1;2,5\n");
  write(root / "csv", "3",
        "X [s],\"EMG 1 [mV]\",X [s],\"ACC [g]\"\n0,1,0,2\n0.1,2,0.3,4\n0.2,3,,\n");
  write(root / "anc", "1",
        "File_Type:\tAnalog R/C ASCII\nTrial_Name:\tt\tDuration(Sec.):\t0.002\t#Channels:\t1\n"
        "BitDepth:\t12\tPreciseRate:\t1000\n\nName\ta\nRate\t1000\nRange\t1000\n0\t5\n0.001\t6\n");
  write(root / "toml", "1", "a = 1\n[b]\nc = [1.5, 'x']\n[[d]]\ne = { f = true }\n");
  write(
      root / "osim", "1",
      "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><gravity>0 -9.81 0</gravity><BodySet>"
      "<objects><Body name=\"b\"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 "
      "0</inertia></Body></objects></BodySet><JointSet><objects><PinJoint name=\"j\">"
      "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b"
      "</socket_child_frame><coordinates><Coordinate name=\"q\"/></coordinates></PinJoint>"
      "</objects></JointSet></Model></OpenSimDocument>");
  return 0;
}
