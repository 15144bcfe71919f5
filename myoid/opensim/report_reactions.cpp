#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/forces/driven_frame.h"
#include "myoid/body/osim/osim_frames.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim {
namespace {

/// One joint that is asked for.
struct Asked {
  std::size_t joint = 0;
  bool on_child = true;
  body::FixedFrame expressed_in;
  std::string label;
};

/// Returns the frame that <express_in_frame> names: ground, the joint's child or parent body, any
/// body, or an offset frame by its path.
std::pair<body::FixedFrame, std::string> frame_named(const AnalysisRun& run,
                                                     pugi::xml_node node,
                                                     const body::Joint& joint,
                                                     const std::string& name) {
  const body::BodyModel& model = run.model;
  const auto body = [&](body::BodyIndex index) {
    return std::pair(body::FixedFrame{index, {}}, model.bodies[at(index)].name);
  };
  if (const auto index = model.find_body(name)) return body(*index);
  if (equal_ignoring_case(name, "ground")) return body(0);
  if (equal_ignoring_case(name, "child")) return body(joint.child);
  if (equal_ignoring_case(name, "parent")) return body(joint.parent);
  const std::string last = name.substr(name.find_last_of('/') + 1);
  const auto file = run.setup.required_file(run.setup.tool(), "model_file");
  if (const auto frame = body::find_frame(model, file, name)) return {*frame, last};
  run.setup.xml().fail(node,
                       "<express_in_frame>: the model has no frame '{}'; expected ground, child, parent, a body or the "
                       "path of a frame, as /jointset/knee_r/tibia_r_offset",
                       name);
}

/// Returns the entry for the k-th joint of a list with one entry for all or one each.
std::string entry(const std::vector<std::string>& list, std::size_t k, const char* otherwise) {
  if (list.empty()) return otherwise;
  return k < list.size() ? list[k] : list[0];
}

std::vector<Asked> asked_joints(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const body::BodyModel& model = run.model;
  std::vector<std::string> names = xml.words(node, "joint_names");
  if (names.empty() || equal_ignoring_case(names[0], "all")) {
    std::vector<const body::Joint*> joints;
    for (const body::Joint& joint : model.joints) joints.push_back(&joint);
    std::ranges::stable_sort(joints, {}, &body::Joint::place_in_file);
    names.clear();
    for (const body::Joint* joint : joints) names.push_back(joint->name);
  }
  const auto list = [&](const char* property) {
    std::vector<std::string> words = xml.words(node, property);
    if (words.size() > 1 && words.size() != names.size()) {
      run.note("<{}>: {} entries for {} joints; the default is taken", property, words.size(), names.size());
      words.clear();
    }
    return words;
  };
  const auto on = list("apply_on_bodies"), in = list("express_in_frame");
  std::vector<Asked> asked;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto joint = std::ranges::find(model.joints, names[k], &body::Joint::name);
    if (joint == model.joints.end()) {
      run.note("<joint_names>: the model has no '{}'; it is left out", names[k]);
      continue;
    }
    Asked a;
    a.joint = static_cast<std::size_t>(joint - model.joints.begin());
    a.on_child = body::lower_case(entry(on, k, "child")) == "child";
    auto [frame, frame_name] = frame_named(run, node, *joint, entry(in, k, "ground"));
    a.expressed_in = std::move(frame);
    a.label = fmt::format("{}_on_{}_in_{}", joint->name,
                          model.bodies[at(a.on_child ? joint->child : joint->parent)].name, frame_name);
    asked.push_back(std::move(a));
  }
  if (asked.empty()) xml.fail(node, "JointReaction: no joint of the list is in the model");
  return asked;
}

/// Returns the rows at other times, along the line between two rows; beyond the ends the outer row.
TimeSeries linear_at(const TimeSeries& file, const Eigen::VectorXd& times) {
  const Eigen::VectorXd& t = file.time_s();
  return frame_table(times, file.channels(), [&](Eigen::Index i, auto&& row) {
    const Eigen::Index before = row_at(t, times[i]);
    const Eigen::Index after = std::min(before + 1, t.size() - 1);
    const double share = after > before ? std::clamp((times[i] - t[before]) / (t[after] - t[before]), 0.0, 1.0) : 0.0;
    row = (1.0 - share) * file.values().row(before) + share * file.values().row(after);
  });
}

/// Returns the actuators' forces at the motion's times: from the file or, where the file lacks an
/// actuator, from the states of the muscles, with the other actuators at rest.
TimeSeries actuator_forces(AnalysisRun& run, pugi::xml_node node) {
  std::vector<Remark>& remarks = run.result.remarks;
  const Eigen::VectorXd& times = run.motion.q.time_s();
  if (const auto path = run.setup.file(node, "forces_file")) {
    const TimeSeries file = recording::read_storage(*path).data;
    std::string missing;
    for (const body::Actuator& a : body::actuators_of(run.model))
      if (!file.find(a.name)) missing += (missing.empty() ? "" : ", ") + a.name;
    if (missing.empty()) {
      run.setup.check_range({times[0], times[times.size() - 1]}, file.time_s(), *path, remarks);
      return linear_at(file, times);
    }
    remarks.push_back({.says = fmt::format(
                           "{}: no column for {}; as in OpenSim all forces follow from the muscles' states, and other "
                           "actuators exert nothing",
                           path->string(), missing)});
  } else {
    remarks.push_back(
        {.says = "JointReaction without <forces_file>: muscles pull by their states, other actuators do nothing"});
  }
  return forces_of_states(run);
}

std::vector<Channel> reaction_channels(const std::vector<Asked>& asked) {
  std::vector<Channel> channels;
  for (const Asked& a : asked) {
    for (const char* part : {"_fx", "_fy", "_fz"}) channels.push_back({a.label + part, Unit::newton});
    for (const char* part : {"_mx", "_my", "_mz"}) channels.push_back({a.label + part, Unit::newton_meter});
    for (const char* part : {"_px", "_py", "_pz"}) channels.push_back({a.label + part, Unit::meter});
  }
  return channels;
}

/// Returns the force, moment and point of a joint's load on the child or the parent, in the frame asked for.
Eigen::Matrix<double, 1, 9> reaction(const body::BodyModel& model, const body::JointLoads& frame, const Asked& asked) {
  const body::Joint& joint = model.joints[asked.joint];
  const Vec3 child_G = frame.X_GB[at(joint.child)] * joint.X_BM.p;
  const Vec3 parent_G = frame.X_GB[at(joint.parent)] * joint.X_PF.p;
  Vec3 force = frame.on_child[asked.joint].f_G;
  Vec3 moment = frame.on_child[asked.joint].m_G;
  Vec3 point = child_G;
  if (!asked.on_child) {
    point = parent_G;
    moment = -(moment + (child_G - parent_G).cross(force));
    force = -force;
  }
  const Pose X_GE = frame.X_GB[at(asked.expressed_in.body)] * asked.expressed_in.X_BF;
  Eigen::Matrix<double, 1, 9> row;
  row.segment<3>(0) = (X_GE.R.transpose() * force).transpose();
  row.segment<3>(3) = (X_GE.R.transpose() * moment).transpose();
  row.segment<3>(6) = (X_GE.inverse() * point).transpose();
  return row;
}

}  // namespace

void report_reactions(AnalysisRun& run, pugi::xml_node node) {
  const std::vector<Asked> asked = asked_joints(run, node);
  const std::string name = analysis_name(node);
  const auto path = claim_result(run, name + "_ReactionLoads.sto");
  const auto loads = body::joint_reactions(run.model, run.moved, actuator_forces(run, node),
                                           {.loads = run.loads_if_any(), .progress = run.options.progress});
  for (const body::PassiveForce& force : run.model.passive_forces) {
    if (std::holds_alternative<body::PathSpring>(force.law) || std::holds_alternative<body::Ligament>(force.law)) {
      run.note("{}: the pull of '{}' ({}) moves the model, but does not load the joints", name, force.name,
               force.class_name);
    }
  }
  const TimeSeries table =
      frame_table(run.motion.q.time_s(), reaction_channels(asked), [&](Eigen::Index i, auto&& row) {
        for (std::size_t k = 0; k < asked.size(); ++k)
          row.template segment<9>(static_cast<Eigen::Index>(9 * k)) = reaction(run.model, loads[at(i)], asked[k]);
      });
  write_opensim_storage(path, table,
                        {.title = "Joint Reaction Loads",
                         .description = "\nThis file contains the reaction forces and moments\napplied to the "
                                        "specified body of a joint pair and expressed  in the specified "
                                        "reference frame.\n\nUnits are S.I. units (seconds, meters, Newtons, "
                                        "...)\n\n",
                         .decimals = run.decimals});
}

}  // namespace myoid::opensim
