#include "myoid/body/forces/sharing_plausibility.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"

namespace myoid::body {
namespace {

constexpr double kLeastArm_m = 1e-5;

/// The reserve of a coordinate.
struct ReserveUse {
  std::string coordinate;
  double share = 0.0;  ///< Share of the frames in which it carries 5 % of the coordinate's greatest torque.
  bool of_muscles = true;
};

double share_of_frames(const Eigen::Ref<const Eigen::VectorXd>& reserve, double greatest) {
  return reserve.size() == 0 ? 0.0 : (reserve.array().abs() > 0.05 * std::max(greatest, 1e-9)).cast<double>().mean();
}

std::optional<Remark> remark_of(std::vector<ReserveUse> uses, bool of_muscles) {
  std::erase_if(uses, [&](const ReserveUse& use) { return use.of_muscles != of_muscles || use.share < kReserveShare; });
  if (uses.empty()) return std::nullopt;
  std::ranges::stable_sort(uses, std::ranges::greater{}, &ReserveUse::share);
  std::vector<std::string> named;
  for (const ReserveUse& use : uses) named.push_back(fmt::format("{} {:.0f} %", use.coordinate, 100.0 * use.share));
  constexpr std::size_t kMost = 5;
  const std::string more = named.size() > kMost ? fmt::format(" and {} more", named.size() - kMost) : "";
  named.resize(std::min(named.size(), kMost));
  return Remark{.code = RemarkCode::reserves_act,
                .severity = of_muscles ? Severity::warning : Severity::note,
                .about = uses.front().coordinate,
                .value = uses.front().share,
                .says = fmt::format(
                    "{} ({}{}): {}", reserve_words(uses.front().share), fmt::join(named, ", "), more,
                    of_muscles ? "the muscles cannot make the torque there" : "no muscle moves these coordinates"),
                .remedy = of_muscles ? "correct the masses, the loads or the strength of the muscles; else the forces "
                                       "belong to another torque"
                                     : ""};
}

std::vector<Remark> remarks_of(const std::vector<ReserveUse>& uses) {
  std::vector<Remark> found;
  for (const bool of_muscles : {true, false}) {
    if (auto remark = remark_of(uses, of_muscles)) found.push_back(std::move(*remark));
  }
  return found;
}

/// Returns the coordinates about which any muscle has an arm in this posture.
std::vector<bool> moved_by_muscles(const body::BodyModel& model, const Eigen::VectorXd& q) {
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, q, state);
  std::vector<bool> moved(model.coordinates.size(), false);
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const body::PathResult path = body::compute_path(model, static_cast<int>(m), state);
    for (std::size_t c = 0; c < moved.size(); ++c) {
      const double arm_m = path.moment_arm_m[static_cast<Eigen::Index>(c)];
      if (std::isfinite(arm_m) && std::abs(arm_m) > kLeastArm_m) moved[c] = true;
    }
  }
  return moved;
}

}  // namespace

std::string reserve_words(double share) {
  return fmt::format("a reserve acts in {:.1f} % of the frames", 100.0 * share);
}

std::vector<Remark> reserves_act(const SharingInput& input, const MuscleForces& shared) {
  std::vector<ReserveUse> uses;
  for (Eigen::Index k = 0; k < shared.reserve.channel_count(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Eigen::MatrixXd& arms = input.moment_arms[i].values();
    std::string name = input.torques.channels()[i].name;
    name.resize(std::min(name.size(), name.rfind('_')));  // "_moment", "_force"
    uses.push_back(
        {std::move(name),
         share_of_frames(shared.reserve.values().col(k), input.torques.values().col(k).cwiseAbs().maxCoeff()),
         arms.size() > 0 && (arms.array().abs() > kLeastArm_m).any()});
  }
  return remarks_of(uses);
}

std::vector<Remark> reserves_act(const body::BodyModel& model,
                                 const body::JointMotion& motion,
                                 const TimeSeries& forces,
                                 const body::ExternalLoads* loads) {
  if (model.actuators.empty() || model.muscles.empty() || motion.sample_count() == 0) return {};
  const TimeSeries tau = body::inverse_dynamics(model, motion, {.loads = loads, .passive_forces = true});
  const std::vector<bool> moved = moved_by_muscles(model, motion.q.values().row(motion.sample_count() / 2).transpose());
  std::vector<ReserveUse> uses;
  for (const body::CoordinateActuator& actuator : model.actuators) {
    const auto column = forces.find(actuator.name);
    if (!column || actuator.coordinate < 0) continue;
    const auto c = static_cast<std::size_t>(actuator.coordinate);
    const double greatest = tau.column(body::generalized_force_name(model.coordinates[c])).cwiseAbs().maxCoeff();
    uses.push_back({model.coordinates[c].name, share_of_frames(forces.values().col(*column), greatest), moved[c]});
  }
  return remarks_of(uses);
}

}  // namespace myoid::body
