#include "myoid/study/checks/joint_of_arms.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/study/checks/length_changes.h"

namespace myoid::study {
namespace {

using fit::StudyData;
using fit::TrialData;

constexpr double kNoArm_m = 1e-4;
constexpr double kExplains = 0.5;
// A muscle whose length follows the angles this closely crosses no other joint.
constexpr double kFollows = 0.97, kOtherFactor = 1.5;

bool one_holds_the_other(std::string_view a, std::string_view b) {
  const std::string x = small_letters(std::string(a)), y = small_letters(std::string(b));
  return x.find(y) != std::string::npos || y.find(x) != std::string::npos;
}

/// Moment arms of one joint and its angle, which may be empty.
struct JointArms {
  const Eigen::MatrixXd& arm_m;
  const Eigen::VectorXd& angle_rad;
};

std::vector<JointArms> joints_of(const TrialData& trial) {
  std::vector<JointArms> joints{{trial.moment_arm_m, trial.angle_rad}};
  for (const fit::JointData& more : trial.more_joints) joints.push_back({more.moment_arm_m, more.angle_rad});
  return joints;
}

void add_muscles_without_arm(const StudyData& data,
                             const std::vector<JointArms>& joints,
                             const TrialFiles& files,
                             std::vector<std::string>& remarks) {
  Eigen::VectorXd most = Eigen::VectorXd::Zero(joints.front().arm_m.cols());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Eigen::VectorXd here = joints[j].arm_m.cwiseAbs().colwise().maxCoeff().transpose();
    if (here.maxCoeff() < kNoArm_m)
      throw InvalidInput(
          fmt::format("{}: every muscle's moment arm stays below 0.1 mm, expected some centimeters: none of these "
                      "muscles moves this joint; give the file of the joint whose torque is fitted",
                      files.moment_arms[j]));
    most = most.cwiseMax(here);
  }
  std::vector<std::string> still;
  for (Eigen::Index k = 0; k < most.size(); ++k) {
    if (most[k] < kNoArm_m) still.push_back(data.muscles[static_cast<std::size_t>(k)].name);
  }
  if (!still.empty())
    remarks.push_back(
        fmt::format("{}: the moment arm of {} stays below 0.1 mm: such a muscle makes no torque here, and nothing of "
                    "it can be identified; is this the file of another joint? Else leave the muscle out",
                    files.moment_arms.front(), fmt::join(still, ", ")));
}

/// Returns 1 - (sum of squared errors) / (sum of squared changes of a length); below 0 if the
/// prediction is worse than no change.
double share_explained(const Eigen::VectorXd& change, const Eigen::VectorXd& by) {
  return 1.0 - (change - by).squaredNorm() / change.squaredNorm();
}

void compare_with_angles(const StudyData& data,
                         const TrialData& trial,
                         const std::vector<JointArms>& joints,
                         const TrialFiles& files,
                         std::vector<std::string>& remarks) {
  const bool known = std::ranges::all_of(
      joints, [&](const JointArms& joint) { return joint.angle_rad.size() == trial.time_s.size(); });
  if (!known || trial.time_s.size() < 3) return;
  const ChangeWindows windows = change_windows(trial.time_s);
  const Eigen::MatrixXd of_length = changes(windows, trial.length_m);
  Eigen::MatrixXd by_angles = Eigen::MatrixXd::Zero(windows.count, of_length.cols());
  for (const JointArms& joint : joints) by_angles -= integrals(windows, joint.arm_m, joint.angle_rad);
  double best = -1e300, best_reversed = -1e300;
  bool any = false;
  std::vector<std::string> suspects;
  for (Eigen::Index k = 0; k < of_length.cols(); ++k) {
    const Eigen::VectorXd change = of_length.col(k), by = by_angles.col(k);
    if (!is_moved(change)) continue;
    any = true;
    best = std::max(best, share_explained(change, by));
    best_reversed = std::max(best_reversed, share_explained(change, -by));
    const double r = change.dot(by) / std::max(change.norm() * by.norm(), 1e-300);
    const double factor = by.norm() / change.norm();
    if (r < -kFollows || (r > kFollows && std::max(factor, 1.0 / factor) > kOtherFactor))
      suspects.push_back(
          fmt::format("{} (times {:.2g})", data.muscles[static_cast<std::size_t>(k)].name, r > 0.0 ? factor : -factor));
  }
  if (any && best >= kExplains && !suspects.empty())
    remarks.push_back(
        fmt::format("{}: with the angles of the motion the moment arms make another change of length than {} has: {}; "
                    "expected times 1 (dl = -r dq): mend the sign or the unit of these muscles",
                    files.moment_arms.front(), files.lengths, fmt::join(suspects, ", ")));
  if (!any || best >= kExplains) return;
  remarks.push_back(
      fmt::format("{}: {}", files.moment_arms.front(),
                  best_reversed >= kExplains
                      ? std::string("lengths change by +r dq with the angles of the motion, expected dl = -r "
                                    "dq: the sign of the moment arms or of the angles is reversed")
                      : fmt::format("with the angles of the motion dl = -r dq explains at most {:.0f} % of "
                                    "the change of any muscle's length, expected most of it for a muscle "
                                    "that crosses no other joint; is it the file of another joint or trial?",
                                    100.0 * std::max(0.0, best))));
}

}  // namespace

std::string_view coordinate_in_name(std::string_view path) {
  constexpr std::string_view kMark = "momentarm_";
  const std::size_t folder = path.find_last_of("/\\");
  if (folder != std::string_view::npos) path.remove_prefix(folder + 1);
  path = path.substr(0, path.find_last_of('.'));
  const std::size_t at = small_letters(std::string(path)).find(kMark);
  return at == std::string::npos ? std::string_view() : path.substr(at + kMark.size());
}

std::string check_joint_by_name(const std::string& path,
                                const std::string& torque_column,
                                const std::vector<std::string>& torque_columns) {
  const std::string_view stated = coordinate_in_name(path);
  if (stated.empty() || one_holds_the_other(stated, torque_column)) return {};
  const std::string found =
      fmt::format("by its name the moment arms about '{}', but the torque fitted is '{}'", stated, torque_column);
  const auto has = [&](std::string_view name) {
    return std::ranges::find(torque_columns, name) != torque_columns.end();
  };
  if (has(stated) || has(fmt::format("{}_moment", stated)))
    throw InvalidInput(
        fmt::format("{}: {}; the torque file has both: name the coordinate {}, or the file of the other moment arms",
                    path, found, stated));
  return fmt::format("{}: {}; is it the file of another joint?", path, found);
}

std::vector<std::string> check_joint_of_arms(const StudyData& data, const TrialData& trial, const TrialFiles& files) {
  std::vector<std::string> remarks;
  if (files.moment_arms.empty()) return remarks;
  const std::vector<JointArms> joints = joints_of(trial);
  add_muscles_without_arm(data, joints, files, remarks);
  compare_with_angles(data, trial, joints, files, remarks);
  return remarks;
}

}  // namespace myoid::study
