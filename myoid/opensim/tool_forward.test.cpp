#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/opensim/model_controls.h"
#include "myoid/opensim/tool_stages.h"

#include "tests/support/message_of.h"
#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

class ToolForward : public test::ToolFolder {
 protected:
  [[nodiscard]] static std::string controller(const std::string& file) {
    return "<ControllerSet><objects><ControlSetController name=\"c\"><controls_file>" + file +
           "</controls_file></ControlSetController></objects></ControllerSet>";
  }
  [[nodiscard]] static std::string tool(const std::string& model, const std::string& more) {
    return "<ForwardTool name=\"f\"><model_file>" + model + "</model_file><results_directory>r</results_directory>" +
           more + "</ForwardTool>";
  }
  /// A cart of 2 kg on a rail along x, and a wheel on it about z; a motor on each.
  void write_cart() const {
    const auto body = [](const char* name) {
      return fmt::format(
          "<Body name=\"{}\"><mass>1</mass><mass_center>0 0 0</mass_center>"
          "<inertia>0.1 0.1 0.5 0 0 0</inertia></Body>",
          name);
    };
    const auto joint = [](const char* kind, const char* name, const char* parent, const char* child,
                          const char* coordinate) {
      return fmt::format(
          "<{0} name=\"{1}\"><socket_parent_frame>{2}</socket_parent_frame>"
          "<socket_child_frame>/bodyset/{3}</socket_child_frame><coordinates>"
          "<Coordinate name=\"{4}\"/></coordinates></{0}>",
          kind, name, parent, child, coordinate);
    };
    const auto motor = [](const char* name, const char* coordinate, double strength) {
      return fmt::format(
          "<CoordinateActuator name=\"{}\"><coordinate>{}</coordinate>"
          "<optimal_force>{}</optimal_force></CoordinateActuator>",
          name, coordinate, strength);
    };
    write("cart.osim",
          "<OpenSimDocument Version=\"40000\"><Model name=\"cart\"><BodySet><objects>" + body("cart") + body("wheel") +
              "</objects></BodySet><JointSet><objects>" + joint("SliderJoint", "rail", "/ground", "cart", "x") +
              joint("PinJoint", "axle", "/bodyset/cart", "wheel", "turn") + "</objects></JointSet><ForceSet><objects>" +
              motor("push", "x", 4.0) + motor("spin", "turn", 0.5) +
              "<TorqueActuator name=\"twist\"><bodyA>wheel</bodyA><bodyB>ground</bodyB>"
              "</TorqueActuator></objects></ForceSet></Model></OpenSimDocument>");
    write("start.sto",
          "states\nversion=1\nnRows=2\nnColumns=5\ninDegrees=no\nendheader\n"
          "time\t/jointset/rail/x/value\t/jointset/rail/x/speed\t/jointset/axle/turn/value\t"
          "/jointset/axle/turn/speed\n0\t9\t9\t9\t9\n0.2\t0.5\t-1\t0.1\t2\n");
  }
};

// A force of 4 N s^-1 t on 2 kg, a constant moment of 0.25 N m on 0.5 kg m^2, from the state at 0.2
// s: x = 0.5 - s + (2/3)(t^3 - 0.2^3) / 2 - ..., in closed form.
TEST_F(ToolForward, MovesACartAsNewtonSays) {
  write_cart();
  write("controls.xml",
        "<OpenSimDocument Version=\"40000\"><ControlSet><objects><ControlLinear name=\"push\">"
        "<x_nodes><ControlLinearNode><t>0</t><value>0</value></ControlLinearNode>"
        "<ControlLinearNode><t>2</t><value>2</value></ControlLinearNode></x_nodes></ControlLinear>"
        "<ControlConstant name=\"spin.excitation\"><value>0.5</value></ControlConstant></objects>"
        "</ControlSet></OpenSimDocument>");
  const ToolResult result = run(tool("cart.osim",
                                     "<states_file>start.sto</states_file><initial_time>0.25</initial_time>"
                                     "<final_time>1.2</final_time><output_precision>12</output_precision>" +
                                         controller("controls.xml")));
  EXPECT_EQ(result.frames_failed, 0) << result.summary;
  const TimeSeries states = read("r/f_states.sto"), degrees = read("r/f_states_degrees.mot"),
                   controls = read("r/f_controls.sto");
  ASSERT_GT(states.sample_count(), 100);
  EXPECT_EQ(states.time_s()[0], 0.2);
  EXPECT_NEAR(states.time_s()[states.sample_count() - 1], 1.2, 1e-9);
  for (Eigen::Index i = 0; i < states.sample_count(); i += 50) {
    const double t = states.time_s()[i], s = t - 0.2;
    // x'' = 2 t: x' = -1 + t^2 - 0.04, x by another integral.
    const double x = 0.5 - s + (t * t * t - 0.008) / 3.0 - 0.04 * s;
    const double turn = 0.1 + 2.0 * s + 0.25 * s * s;
    EXPECT_NEAR(states.column("/jointset/rail/x/value")[i], x, 1e-8);
    EXPECT_NEAR(states.column("/jointset/rail/x/speed")[i], -1.04 + t * t, 1e-8);
    EXPECT_NEAR(states.column("/jointset/axle/turn/value")[i], turn, 1e-8);
    EXPECT_NEAR(kDegree * degrees.column("/jointset/axle/turn/value")[i], turn, 1e-8);
    EXPECT_NEAR(degrees.column("/jointset/rail/x/value")[i], x, 1e-8);
    EXPECT_NEAR(controls.column("push")[i], t, 1e-9);
    EXPECT_NEAR(controls.column("spin")[i], 0.5, 1e-12);
  }
}

// Two ways to the same accelerations: rates of the speeds that the integration of muscles and
// bodies leaves, and the forward dynamics of an AnalyzeTool at those states.
TEST_F(ToolForward, AgreesWithTheAccelerationsOfItsStates) {
  std::string controls = "controls\nversion=1\nnRows=2\nnColumns=" + std::to_string(arm_.muscles.size() + 1) +
                         "\ninDegrees=no\nendheader\ntime";
  std::string first = "\n0", second = "\n1";
  for (std::size_t m = 0; m < arm_.muscles.size(); ++m) {
    controls += "\t/forceset/" + arm_.muscles[m].name;
    first += fmt::format("\t{}", 0.05 + 0.05 * static_cast<double>(m));
    second += fmt::format("\t{}", 0.3 - 0.05 * static_cast<double>(m));
  }
  write("controls.sto", controls + first + second + "\n");
  const ToolResult result = run(tool("arm.osim",
                                     "<final_time>0.3</final_time><output_precision>14</output_precision>"
                                     "<solve_for_equilibrium_for_auxiliary_states>true"
                                     "</solve_for_equilibrium_for_auxiliary_states>" +
                                         controller("controls.sto")));
  EXPECT_EQ(result.frames_failed, 0) << result.summary;
  std::ignore =
      run("<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><states_file>r/f_states.sto"
          "</states_file><initial_time>0</initial_time><final_time>0.3</final_time><output_precision>12"
          "</output_precision><AnalysisSet><objects><Kinematics name=\"k\"><in_degrees>false"
          "</in_degrees></Kinematics></objects></AnalysisSet></AnalyzeTool>");
  const TimeSeries states = read("r/f_states.sto"), rates = read("a_k_dudt.sto");
  const std::string joint =
      arm_.joints[static_cast<std::size_t>(
                      arm_.coordinates[static_cast<std::size_t>(arm_.coordinate_index("elbow_flexion"))].joint)]
          .name;
  const Eigen::VectorXd speed = states.column("/jointset/" + joint + "/elbow_flexion/speed");
  const Eigen::VectorXd rate = rates.column("elbow_flexion");
  ASSERT_EQ(rate.size(), speed.size());
  double greatest = 0.0;
  const double step_s = states.time_s()[1] - states.time_s()[0];
  for (Eigen::Index i = 20; i + 2 < speed.size(); ++i) {
    const double difference = (8.0 * (speed[i + 1] - speed[i - 1]) - speed[i + 2] + speed[i - 2]) / (12.0 * step_s);
    greatest = std::max(greatest, std::abs(rate[i]));
    // Truncation h^4 / 30 of the fifth derivative of a speed that changes within 10 ms.
    EXPECT_NEAR(rate[i], difference, 1e-5 * greatest + 1e-4) << i;
  }
  EXPECT_GT(greatest, 1.0);
}

TEST_F(ToolForward, RefusesWithWordsWhatItCannot) {
  write_cart();
  const auto message = [&](const std::string& more) {
    return test::message_of<ReadError>([&] { std::ignore = run(tool("cart.osim", more)); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message("<external_loads_file>loads.xml</external_loads_file>"), HasSubstr("loads on bodies"));
  EXPECT_THAT(message("<ControllerSet><objects><CorrectionController name=\"k\"/></objects>"
                      "</ControllerSet>"),
              HasSubstr("CorrectionController"));
  EXPECT_THAT(message("<final_time>0</final_time>"), HasSubstr("<final_time>"));
  write("controls.sto", "c\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\ttwist\n0\t0\n1\t1\n");
  EXPECT_THAT(message(controller("controls.sto")), HasSubstr("'twist' acts on bodies"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r/f_states.sto"));
}

}  // namespace
}  // namespace myoid::opensim
