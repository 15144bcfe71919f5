// Joint torques as a node of ROS 2. The topic `envelope` has the envelope of each channel; `joint_states` has angles
// [rad] and speeds [rad/s] in the order of the joints. `torque` [N m] leaves with each envelope.
//   ros2 run PACKAGE with_ros2 --ros-args -p results:=RESULTS
// The package's CMakeLists.txt has find_package(rclcpp), find_package(sensor_msgs), find_package(std_msgs),
// find_package(Myoid) and target_link_libraries(with_ros2 Myoid::c).
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <std_msgs/msg/float64_multi_array.hpp>

#include "myoid.h"

class Torque : public rclcpp::Node {
 public:
  Torque() : Node("myoid") {
    std::string error(1000, '\0');
    const std::string results = declare_parameter<std::string>("results", "results");
    model_.reset(myoid_open(results.c_str(), nullptr, error.data(), error.size()));
    if (!model_) throw std::runtime_error(error.c_str());
    workspace_.reset(myoid_workspace_new(model_.get()));
    acting_.resize(static_cast<std::size_t>(myoid_channel_count(model_.get())));
    message_.data.resize(static_cast<std::size_t>(myoid_joint_count(model_.get())));
    torque_ = create_publisher<std_msgs::msg::Float64MultiArray>("torque", 1);
    joints_ = create_subscription<sensor_msgs::msg::JointState>(
        "joint_states", 1, [this](const sensor_msgs::msg::JointState& state) { state_ = state; });
    envelopes_ = create_subscription<std_msgs::msg::Float64MultiArray>(
        "envelope", 1, [this](const std_msgs::msg::Float64MultiArray& envelope) { follow(envelope.data); });
  }

 private:
  void follow(const std::vector<double>& envelope) {
    const std::size_t joints = message_.data.size();
    if (envelope.size() != acting_.size()) return;
    if (state_.position.size() != joints || state_.velocity.size() != joints) return;
    const rclcpp::Time time = now();
    const double step_s = last_.nanoseconds() > 0 ? (time - last_).seconds() : 0.001;
    last_ = time;
    const myoid_output output{sizeof output, message_.data.data(), nullptr, nullptr, nullptr, nullptr, nullptr};
    const int followed = myoid_follow(model_.get(), workspace_.get(), envelope.data(), step_s, acting_.data());
    if (followed != MYOID_DONE && followed != MYOID_IMPLAUSIBLE) return;
    const int done = myoid_evaluate(model_.get(), workspace_.get(), acting_.data(), state_.position.data(),
                                    state_.velocity.data(), &output);
    if (done == MYOID_DONE || done == MYOID_IMPLAUSIBLE) torque_->publish(message_);
  }

  std::unique_ptr<myoid_model, void (*)(myoid_model*)> model_{nullptr, myoid_close};
  std::unique_ptr<myoid_workspace, void (*)(myoid_workspace*)> workspace_{nullptr, myoid_workspace_free};
  std::vector<double> acting_;
  rclcpp::Time last_{0, 0, RCL_ROS_TIME};
  sensor_msgs::msg::JointState state_;
  std_msgs::msg::Float64MultiArray message_;
  rclcpp::Publisher<std_msgs::msg::Float64MultiArray>::SharedPtr torque_;
  rclcpp::Subscription<sensor_msgs::msg::JointState>::SharedPtr joints_;
  rclcpp::Subscription<std_msgs::msg::Float64MultiArray>::SharedPtr envelopes_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Torque>());
  rclcpp::shutdown();
  return 0;
}
