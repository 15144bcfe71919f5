#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/opensim/run_tool.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// A folder with the built-in arm, markers of an elbow swing, and set-up files.
class ToolFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    arm_ = body::parse_osim(body::arm4_osim(), "arm4.osim");
    write("arm.osim", body::arm4_osim());
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] opensim::ToolResult run(const std::string& setup) const {
    write("setup.xml", "<OpenSimDocument Version=\"40000\">" + setup + "</OpenSimDocument>");
    return opensim::run_tool(folder_ / "setup.xml");
  }
  static double elbow(int frame) { return 1.2 + 0.5 * std::sin(0.1 * frame); }

  void write_markers(int frames) const {
    std::string text = fmt::format(
        "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
        "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t{0}\t{1}\tm\t100\t1\t{0}\n"
        "Frame#\tTime",
        frames, arm_.markers.size());
    std::string axes = "\t";
    for (std::size_t i = 0; i < arm_.markers.size(); ++i) {
      text += "\t" + arm_.markers[i].name + "\t\t";
      axes += fmt::format("\tX{0}\tY{0}\tZ{0}", i + 1);
    }
    text += "\n" + axes + "\n\n";
    body::BodyState state = body::make_state(arm_);
    Eigen::VectorXd q = arm_.default_q();
    for (int frame = 0; frame < frames; ++frame) {
      q[arm_.coordinate_index("elbow_flexion")] = elbow(frame);
      body::compute_poses(arm_, q, state);
      text += fmt::format("{}\t{}", frame + 1, 0.01 * frame);
      for (const body::Marker& marker : arm_.markers) {
        const Vec3 p = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
        text += fmt::format("\t{}\t{}\t{}", p[0], p[1], p[2]);
      }
      text += "\n";
    }
    write("m.trc", text);
  }
  /// An actuator of 1 N m on every coordinate.
  [[nodiscard]] std::string reserves() const {
    std::string text;
    for (const body::Coordinate& c : arm_.coordinates) {
      text += "<CoordinateActuator name=\"" + c.name + "_reserve\"><coordinate>" + c.name +
              "</coordinate><optimal_force>1</optimal_force></CoordinateActuator>";
    }
    return text;
  }
  void write_motion(int frames) const {
    std::string text = fmt::format(
        "Coordinates\nversion=1\nnRows={}\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_"
        "flexion\n",
        frames);
    for (int i = 0; i < frames; ++i) text += fmt::format("{}\t{}\n", 0.01 * i, elbow(i));
    write("motion.mot", text);
  }
  [[nodiscard]] TimeSeries read(const std::string& name) const { return recording::read_storage(folder_ / name).data; }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  body::BodyModel arm_;
};

}  // namespace myoid::test
