#include "myoid/study/checks/dynamometer_sign.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/study/checks/muscle_pulls.h"
#include "myoid/study/checks/relaxed_joint.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::study {
namespace {

/// Returns the largest possible torque by the weight of all bodies that the coordinate moves, each stretched out [N m].
double weight_nm(const body::BodyModel& model, const std::string& coordinate) {
  const int index = model.coordinate_index(coordinate);
  const auto joint = static_cast<std::size_t>(model.coordinates[static_cast<std::size_t>(index)].joint);
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  const Vec3 center = state.X_GB[static_cast<std::size_t>(model.joints[joint].child)] * model.joints[joint].X_BM.p;
  const std::vector<bool> moved = body::moved_bodies(model, static_cast<int>(joint));
  double sum = 0.0;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    if (moved[b])
      sum +=
          model.bodies[b].mass_kg * model.gravity_G.norm() * (state.X_GB[b] * model.bodies[b].p_BBcm_B - center).norm();
  }
  return sum;
}

/// A trial with cosine c has odds of exp(6 c) for a right sign: the cosines of right signs are spread as exp(3 c), with
/// a mean of 0.67.
constexpr double kOddsOfCosine = 6.0;

/// Returns the log-odds, over the trials that are strong, of a right sign to a reversed one.
double log_odds(const std::vector<ToldTrial>& told, const Eigen::VectorXd& strength_nm) {
  double sum = 0.0;
  for (const ToldTrial& one : told)
    if (one.strong) sum += kOddsOfCosine * one.sums.cosine(strength_nm);
  return sum;
}

/// Two channels of opposite muscles whose exchange makes the torques agree best.
struct Exchange {
  std::string first, second;
  double log_odds = 0.0;
};

std::optional<Exchange> best_exchange(const std::vector<ToldTrial>& told, const Pulls& pulls) {
  std::optional<Exchange> best;
  for (std::size_t a = 0; a < pulls.channels.size(); ++a) {
    for (std::size_t b = a + 1; b < pulls.channels.size(); ++b) {
      Eigen::VectorXd exchanged = pulls.strength_nm;
      std::swap(exchanged[static_cast<Eigen::Index>(a)], exchanged[static_cast<Eigen::Index>(b)]);
      if (!(exchanged[static_cast<Eigen::Index>(a)] * exchanged[static_cast<Eigen::Index>(b)] < 0.0)) continue;
      const double odds = log_odds(told, exchanged);
      if (!best || odds > best->log_odds) best = Exchange{pulls.channels[a], pulls.channels[b], odds};
    }
  }
  return best;
}

/// Returns what to do about torques of the wrong sign, with both explanations where the trials do not tell them apart.
/// One file alone is to be negated where the trials together have the right sign.
std::string remedy_for(const std::string& coordinate,
                       double right_log_odds,
                       const std::optional<Exchange>& exchange,
                       const RelaxedJoint& rest) {
  if (right_log_odds > 0.0)
    return fmt::format(
        "{}_moment has its right sign in other trials; if it is reversed in this file alone, negate it "
        "there",
        coordinate);
  const std::string reversed = fmt::format(
      "if {0}_moment is the person's torque on the dynamometer, negate it{1}: external_torque is the torque of the "
      "surroundings on the body, positive in the coordinate's direction",
      coordinate, rest.resists() ? fmt::format(" and {}, since the relaxed joint resists only so", coordinate) : "");
  constexpr double kCertain = kLimits.joints.certain_log_odds;
  // The sign that is reversed has the opposite odds. A joint that yields at rest has a wrong sign, whatever the EMG.
  const double for_exchange = !exchange || rest.yields() ? -2.0 * kCertain : exchange->log_odds + right_log_odds;
  if (for_exchange < -kCertain) return reversed;
  const std::string exchanged =
      fmt::format("if the electrodes of {} and {} are exchanged, exchange these two names in [[muscle]] emg",
                  exchange->first, exchange->second);
  if (for_exchange > kCertain) return exchanged;
  return fmt::format("{}; {}. The recording does not tell which", reversed, exchanged);
}

/// Names the trials whose torque acts with the active muscles: those that say so alone or, where the strong trials
/// together are certain, all of that sign.
std::vector<Remark> reversed_torques(const std::vector<ToldTrial>& told,
                                     const Pulls& pulls,
                                     const std::string& coordinate,
                                     const RelaxedJoint& rest) {
  const auto cosine = [&](const ToldTrial& one) { return one.sums.cosine(pulls.strength_nm); };
  const double odds = log_odds(told, pulls.strength_nm);
  const bool one_sign = std::ranges::all_of(told, [&](const auto& one) { return !one.strong || cosine(one) < 0.0; });
  const auto strong = static_cast<double>(std::ranges::count_if(told, &ToldTrial::strong));
  const bool certain = one_sign && (odds < -kLimits.joints.certain_log_odds ||
                                    odds < kOddsOfCosine * kLimits.joints.certainly_reversed * strong);
  const std::string remedy = remedy_for(coordinate, odds, best_exchange(told, pulls), rest);
  std::vector<Remark> found;
  for (const ToldTrial& one : told) {
    const bool named = certain ? cosine(one) < 0.0 : one.strong && cosine(one) < kLimits.joints.reversed;
    if (!named) continue;
    found.push_back(
        {.code = RemarkCode::dynamometer_sign,
         .severity = certain ? Severity::error : Severity::warning,
         .where = one.trial->spec->name,
         .about = coordinate,
         .says = fmt::format("{}: the torque on {} acts in the direction of the active muscles (cosine with "
                             "their necessary torque {:.2f}, expected above 0)",
                             one.trial->spec->external_torque->filename().string(), coordinate, cosine(one)),
         .remedy = remedy});
  }
  return found;
}

}  // namespace

std::vector<Remark> dynamometer_signs(const Study& study,
                                      const body::BodyModel& model,
                                      const std::vector<EffortTrial>& trials) {
  std::vector<Remark> found;
  const bool any = std::ranges::any_of(trials, [](const EffortTrial& t) { return t.external_torque != nullptr; });
  if (!any) return found;
  for (const std::string& name : study_coordinates(study.model)) {
    const auto index = model.find_coordinate(name);
    if (!index || model.coordinates[static_cast<std::size_t>(*index)].motion == body::MotionType::translational)
      continue;
    const Pulls pulls = pulls_on(study, model, name);
    const double limb_nm = weight_nm(model, name);
    std::vector<ToldTrial> told = told_trials(trials, name, pulls, limb_nm);
    // Torques that the study's muscles cannot make are those of others.
    std::erase_if(told, [&](const ToldTrial& one) { return one.peak_nm > pulls.together().greatest_nm(); });
    const RelaxedJoint rest = relaxed_joint(trials, name, limb_nm);
    std::vector<Remark> of_joint = reversed_torques(told, pulls, name, rest);
    if (of_joint.empty()) of_joint = yielding_joint(rest, name, log_odds(told, pulls.strength_nm));
    std::ranges::move(of_joint, std::back_inserter(found));
  }
  return found;
}

}  // namespace myoid::study
