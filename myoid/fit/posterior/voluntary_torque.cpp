#include "myoid/fit/posterior/voluntary_torque.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/draws.h"

namespace myoid::fit {
namespace {

constexpr double kNormal95 = 1.959964;
constexpr double kEndShare = 0.025;     // of the draws: the interval reaches the end of the range
constexpr double kScatterShare = 0.05;  // of the optimal fiber length: other joints move the muscle

/// The torque of one owner in its states, by both readings and by the literature's parameters.
struct OwnTorque {
  NormalTorque of_person, given;
  Eigen::VectorXd literature_nm;  ///< As NormalTorque::mean_nm.
  std::vector<int> speeds_degps;

  OwnTorque& operator+=(const OwnTorque& other) {
    literature_nm =
        literature_nm.size() == 0 ? other.literature_nm : Eigen::VectorXd(literature_nm + other.literature_nm);
    of_person += other.of_person;
    given += other.given;
    speeds_degps = other.speeds_degps;
    return *this;
  }
};

/// Returns the torque's size by the literature's parameters, with the effort of the run.
Eigen::VectorXd literature_nm(const TrialRun& run, const ParameterMap& map, const VoluntaryStates& states) {
  const RunEvaluation at(run, map, EmgLag::delay, map.values(map.start()), nullptr);
  return states.direction *
         run.arm_m.col(static_cast<Eigen::Index>(states.muscle)).cwiseProduct(at.muscle(states.muscle).force_n);
}

/// Returns the reported speeds [deg/s] that the joint reaches in the direction of the muscle's torque.
std::vector<int> reached_speeds_degps(const Postures& postures, int direction) {
  const double fastest_radps = direction > 0 ? postures.fastest_radps : postures.fastest_back_radps;
  std::vector<int> speeds;
  for (const int speed : kVoluntarySpeeds_degps)
    if (speed * kDegree <= fastest_radps) speeds.push_back(speed);
  return speeds;
}

/// Returns the reading of draws of a number; its interval holds the value.
Reading of_draws(double value, const Eigen::VectorXd& draws) {
  const Eigen::VectorXd weight = Eigen::VectorXd::Constant(draws.size(), 1.0 / static_cast<double>(draws.size()));
  const double mean = draws.mean();
  return {.value = value,
          .low = std::min(value, math::weighted_quantile(draws, weight, 0.025)),
          .high = std::max(value, math::weighted_quantile(draws, weight, 0.975)),
          .sd = std::sqrt((draws.array() - mean).square().mean())};
}

/// Returns the reading of `factor` times the greatest of n samples from `first` on. To the first order it errs as the
/// sample at the mean's peak does, whose size is log-normal.
Reading of_peak(const NormalTorque& torque, Eigen::Index first, const Eigen::VectorXd& place, double factor) {
  Eigen::Index top = 0;
  torque.mean_nm.segment(first, place.size()).maxCoeff(&top);
  const double value = factor * peak_of(torque.mean_nm.segment(first, place.size()), place).value;
  const double sd = factor * torque.by_chance.row(first + top).norm();
  const double reach = value > 0.0 ? std::exp(kNormal95 * sd / value) : 1.0;
  return {.value = value, .low = value / reach, .high = value * reach, .sd = sd};
}

/// Makes the rows and the curve of one owner.
class Rows {
 public:
  Rows(const FitFacts& fit,
       VoluntaryCurve curve,
       const OwnTorque& torque,
       const Postures& postures,
       bool several_joints,
       const Eigen::MatrixXd& draws)
      : fit_(fit), curve_(std::move(curve)), torque_(torque), place_(postures.place), draws_(draws) {
    curve_.ending = curve_.of_joint  ? (curve_.direction > 0 ? "_positive" : "_negative")
                    : several_joints ? "_at_" + curve_.joint
                                     : std::string();
    if (postures.over_angle) curve_.angle_rad = place_;
    add_bands();
  }

  void add_to(VoluntaryTorques& all) {
    const Peaks person = peaks_of(torque_.of_person, place_, draws_);
    const Peaks given = peaks_of(torque_.given, place_, draws_);
    const bool one_place = place_.size() < 3;
    all.estimates.push_back(torque_row(person, given, one_place));
    if (curve_.angle_rad.size() > 0 && !one_place) all.estimates.push_back(angle_row(person, given));
    for (std::size_t s = 0; s < torque_.speeds_degps.size(); ++s) all.estimates.push_back(power_row(s));
    all.curves.push_back(std::move(curve_));
  }

 private:
  void add_bands() {
    const Eigen::Index n = place_.size();
    const auto sd = [&](const NormalTorque& of) -> Eigen::VectorXd { return of.by_chance.topRows(n).rowwise().norm(); };
    const auto mean = torque_.of_person.mean_nm.head(n), given = torque_.given.mean_nm.head(n);
    curve_.torque_nm = mean;
    curve_.low_nm = (mean - kNormal95 * sd(torque_.of_person)).cwiseMax(0.0);
    curve_.high_nm = (mean + kNormal95 * sd(torque_.of_person)).cwiseMax(0.0);
    curve_.given_low_nm = (given - kNormal95 * sd(torque_.given)).cwiseMax(0.0);
    curve_.given_high_nm = (given + kNormal95 * sd(torque_.given)).cwiseMax(0.0);
  }

  /// Returns a row with both readings and its verdict.
  [[nodiscard]] ParameterEstimate row(const std::string& name, Unit unit, const NumberFacts& facts) const {
    ParameterEstimate e{.muscle = curve_.owner, .tied_to = {}, .parameter = name + curve_.ending, .unit = unit};
    judge(e, facts);
    if (!curve_.from_mvc)
      e.reason +=
          "; no maximal contraction was recorded: this is at the largest recorded EMG, not the greatest possible";
    if (curve_.averaged) e.reason += "; at the mean posture of the other joints, which move the muscle, too";
    return e;
  }

  [[nodiscard]] ParameterEstimate torque_row(const Peaks& person, const Peaks& given, bool one_place) const {
    ParameterEstimate e = row(
        std::string(kVoluntaryTorque), Unit::newton_meter,
        {.fit = fit_, .person = of_draws(person.value, person.values), .given = of_draws(given.value, given.values)});
    e.initial = torque_.literature_nm.head(place_.size()).maxCoeff();
    if (one_place)
      e.reason += "; recorded at one angle only";
    else if (person.at_end)
      e.reason += fmt::format("; the greatest of the recorded range, at its end of {}", place_text(person.place));
    return e;
  }

  [[nodiscard]] ParameterEstimate angle_row(const Peaks& person, const Peaks& given) const {
    ParameterEstimate e = row(std::string(kVoluntaryAngle), Unit::radian,
                              {.fit = fit_,
                               .person = of_draws(person.place, person.places),
                               .given = of_draws(given.place, given.places),
                               .scale = Scale::angle,
                               .at_range_end = person.at_end || person.at_ends > kEndShare});
    Eigen::Index top = 0;
    torque_.literature_nm.head(place_.size()).maxCoeff(&top);
    e.initial = place_[top];
    if (person.at_end) e.reason = fmt::format("at {} or beyond; {}", place_text(person.place), e.reason);
    return e;
  }

  [[nodiscard]] ParameterEstimate power_row(std::size_t s) const {
    const Eigen::Index n = place_.size(), first = static_cast<Eigen::Index>(s + 1) * n;
    const int speed_degps = torque_.speeds_degps[s];
    const double speed_radps = speed_degps * kDegree;
    ParameterEstimate e = row(fmt::format("{}_{}", kVoluntaryPower, speed_degps), Unit::watt,
                              {.fit = fit_,
                               .person = of_peak(torque_.of_person, first, place_, speed_radps),
                               .given = of_peak(torque_.given, first, place_, speed_radps)});
    e.initial = speed_radps * torque_.literature_nm.segment(first, n).maxCoeff();
    return e;
  }

  [[nodiscard]] std::string place_text(double place) const {
    return curve_.angle_rad.size() > 0 ? fmt::format("{:.0f}°", place / kDegree)
                                       : fmt::format("{:.0f} mm of the muscle's length", 1000.0 * place);
  }

  const FitFacts& fit_;
  VoluntaryCurve curve_;
  const OwnTorque& torque_;
  const Eigen::VectorXd& place_;
  const Eigen::MatrixXd& draws_;
};

/// Collects the torques of all muscles at all joints.
struct OwnerTorques {
  const StudyData& data;
  const EstimatorOptions& options;
  const ParameterMap& map;
  const JointParts& parts;
  const FitFacts& fit;
  const LinearReading &of_person, &given;
  Eigen::VectorXd greatest_envelope;
  VoluntaryTorques all = {};

  void add_joint(int joint) {
    const std::string& name = map.joints()[static_cast<std::size_t>(joint)];
    const bool several = map.joints().size() > 1;
    OwnTorque sums[2];
    std::vector<std::string> pulling[2];
    bool averaged = false;
    Postures places = postures(data, name, 0);
    Eigen::MatrixXd draws = voluntary_draws(places.count());
    for (std::size_t k = 0; k < data.muscles.size(); ++k) {
      if (!parts.crosses(k, joint)) continue;
      if (!places.over_angle) places = postures(data, name, k);
      if (places.count() == 0) continue;
      if (places.count() > draws.rows()) draws = voluntary_draws(places.count());
      const auto column = static_cast<Eigen::Index>(k);
      const int direction = places.arm_m.col(column).mean() < 0.0 ? -1 : 1;
      const OwnTorque torque = torque_of(joint, k, direction, places);
      VoluntaryCurve curve{.owner = data.muscles[k].name,
                           .joint = name,
                           .direction = direction,
                           .muscles = {data.muscles[k].name},
                           .length_m = places.length_m.col(column),
                           .from_mvc = options.from_mvc};
      curve.averaged = places.scatter_m[column] > kScatterShare * data.muscles[k].start.optimal_fiber_length_m;
      averaged |= curve.averaged;
      pulling[direction > 0 ? 0 : 1].push_back(curve.owner);
      sums[direction > 0 ? 0 : 1] += torque;
      if (covers(options.muscles, curve.owner)) Rows(fit, std::move(curve), torque, places, several, draws).add_to(all);
    }
    for (int side = 0; side < 2 && places.over_angle; ++side) {
      if (pulling[side].empty()) continue;
      VoluntaryCurve curve{.owner = name, .joint = name, .of_joint = true, .direction = side == 0 ? 1 : -1};
      curve.muscles = pulling[side];
      curve.from_mvc = options.from_mvc;
      curve.averaged = averaged;
      Rows(fit, std::move(curve), sums[side], places, several, draws).add_to(all);
    }
  }

  [[nodiscard]] OwnTorque torque_of(int joint, std::size_t k, int direction, const Postures& places) const {
    VoluntaryStates states{.joint = joint, .muscle = k, .direction = direction, .speeds_radps = {}};
    OwnTorque torque{.speeds_degps = reached_speeds_degps(places, direction)};
    states.speeds_radps.resize(static_cast<Eigen::Index>(torque.speeds_degps.size()));
    for (std::size_t s = 0; s < torque.speeds_degps.size(); ++s)
      states.speeds_radps[static_cast<Eigen::Index>(s)] = torque.speeds_degps[s] * kDegree;
    const TrialRun run = run_of(states, places, map, greatest_envelope);
    torque.of_person = of_person.torque(run, direction);
    torque.given = given.torque(run, direction);
    torque.literature_nm = literature_nm(run, map, states);
    return torque;
  }
};

}  // namespace

VoluntaryTorques voluntary_torques(const StudyData& data,
                                   const EstimatorOptions& options,
                                   const LinearReading& of_person,
                                   const LinearReading& given,
                                   const FitFacts& fit) {
  const Likelihood& likelihood = of_person.likelihood();
  OwnerTorques torques{data,
                       options,
                       likelihood.parameters(),
                       likelihood.recorded().parts,
                       fit,
                       of_person,
                       given,
                       greatest_envelopes(likelihood, options.from_mvc)};
  for (int joint = 0; joint < static_cast<int>(likelihood.parameters().joints().size()); ++joint)
    torques.add_joint(joint);
  return std::move(torques.all);
}

}  // namespace myoid::fit
