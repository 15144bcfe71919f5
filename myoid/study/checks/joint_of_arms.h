#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/study/checks/given_check.h"

namespace myoid::study {

/// Returns the coordinate in the name of a file of moment arms, as OpenSim writes it
/// ("walk_MuscleAnalysis_MomentArm_knee_angle_r.sto": "knee_angle_r"); empty: none.
[[nodiscard]] std::string_view coordinate_in_name(std::string_view path);

/// Compares the coordinate in the name of a file of moment arms with the column of torques that it serves. Accepts a
/// name without a coordinate, and a name that is part of the other. Throws InvalidInput if another column of the torque
/// file has this coordinate, so that the file is certainly another joint's; else returns a remark, empty if both agree.
[[nodiscard]] std::string check_joint_by_name(const std::string& path,
                                              const std::string& torque_column,
                                              const std::vector<std::string>& torque_columns);

/// Compares one trial's moment arms with the lengths and the motion of the joint.
///
/// - A muscle whose moment arms are below 0.1 mm at all joints throughout makes no torque: a
/// remark. Throws InvalidInput if this holds for all muscles of a joint.
/// - With the angles of every joint, lengths change by dl = -sum_j r_j dq_j over windows of 0.1 s:
/// a remark if this explains less than half of the change of every muscle's length, or if dl =
/// +sum_j r_j dq_j explains more for all.
[[nodiscard]] std::vector<std::string> check_joint_of_arms(const fit::StudyData& data,
                                                           const fit::TrialData& trial,
                                                           const TrialFiles& files);

}  // namespace myoid::study
