#include "myoid/opensim/projects/ceinms_law.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/spline.h"

namespace myoid::opensim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Quantity = MuscleQuantity;

constexpr double kUsualSpeed = 10.0;     ///< [optimal fiber lengths / s], where a subject states none.
constexpr double kShortestFiber = 0.05;  ///< Of an elastic tendon's search [optimal fiber lengths].
constexpr int kBisections = 50;

const ProjectCurve* curve_of(const Project& project, std::string_view name) {
  const auto at = std::find_if(project.curves.begin(), project.curves.end(),
                               [&](const ProjectCurve& curve) { return curve.name == name; });
  return at == project.curves.end() || at->x.size() < 2 ? nullptr : &*at;
}

bool is_elastic(const Project& project) { return project.tendon.find("lastic") != std::string::npos; }

/// A curve of a subject.
class TableCurve {
 public:
  explicit TableCurve(const ProjectCurve& curve)
      : lowest_(curve.x.front()),
        highest_(curve.x.back()),
        first_(curve.y.front()),
        last_(curve.y.back()),
        spline_(
            math::Spline::interpolate(Eigen::Map<const VectorXd>(curve.x.data(), static_cast<Index>(curve.x.size())),
                                      Eigen::Map<const VectorXd>(curve.y.data(), static_cast<Index>(curve.y.size())),
                                      curve.x.size() == 2 ? 1 : 3)) {}

  [[nodiscard]] double at(double x) const { return x < lowest_ ? first_ : x > highest_ ? last_ : spline_.at(x).value; }

 private:
  double lowest_, highest_, first_, last_;
  math::Spline spline_;
};

/// The numbers of a muscle, of which absent ones have no effect.
struct MuscleNumbers {
  double c1 = 0.0, c2 = 0.0, shape = 0.0, scale = 1.0, delay_s = 0.0;
  double optimal_length_m = 0.0, pennation_rad = 0.0, slack_length_m = 0.0, speed = kUsualSpeed, strength_n = 0.0;
};

MuscleNumbers numbers_of(const ProjectMuscle& muscle, double usual_delay_s) {
  const auto number = [&](Quantity quantity, double absent) {
    const auto at = muscle.numbers.find(quantity);
    return at == muscle.numbers.end() ? absent : at->second.value;
  };
  return {.c1 = number(Quantity::c1, 0.0),
          .c2 = number(Quantity::c2, 0.0),
          .shape = number(Quantity::shape_factor, 0.0),
          .scale = number(Quantity::activation_scale, 1.0),
          .delay_s = number(Quantity::delay, usual_delay_s),
          .optimal_length_m = number(Quantity::optimal_fiber_length, 0.0),
          .pennation_rad = number(Quantity::pennation_angle, 0.0),
          .slack_length_m = number(Quantity::tendon_slack_length, 0.0),
          .speed = number(Quantity::max_contraction_velocity, kUsualSpeed),
          .strength_n = number(Quantity::max_isometric_force, 0.0) * number(Quantity::strength_coefficient, 1.0)};
}

/// Returns the weighted mean of the channels of a muscle.
VectorXd excitation_of(const ProjectMuscle& muscle, const TimeSeries& emg, bool within_one) {
  VectorXd excitation = VectorXd::Zero(emg.sample_count());
  for (const ProjectInput& input : muscle.inputs) excitation += input.weight * emg.column(input.channel);
  if (within_one) excitation = excitation.cwiseMax(0.0).cwiseMin(1.0);
  return excitation;
}

VectorXd activation_of(const MuscleNumbers& n, const VectorXd& excitation) {
  VectorXd activation = recursive_activation(excitation, n.c1, n.c2);
  for (double& a : activation) a = n.scale * exponential_shape(a, n.shape);
  return activation;
}

/// Returns values at other times by lines between the samples, constant outside.
VectorXd linear_at(const VectorXd& t, const VectorXd& y, const VectorXd& wanted, double delay_s) {
  VectorXd result(wanted.size());
  for (Index k = 0; k < wanted.size(); ++k) {
    const double at = wanted(k) - delay_s;
    const Index next = std::upper_bound(t.begin(), t.end(), at) - t.begin();
    if (next == 0 || next == t.size()) {
      result(k) = y(next == 0 ? 0 : t.size() - 1);
      continue;
    }
    const double share = (at - t(next - 1)) / (t(next) - t(next - 1));
    result(k) = (1.0 - share) * y(next - 1) + share * y(next);
  }
  return result;
}

class Law {
 public:
  explicit Law(const Project& project)
      : active_(*curve_of(project, "activeForceLength")),
        passive_(*curve_of(project, "passiveForceLength")),
        velocity_(*curve_of(project, "forceVelocity")),
        damping_(project.common.damping.value_or(0.0)),
        lengthening_(project.common.percentage_change.value_or(0.0)),
        is_rt_(project.dialect == Dialect::ceinms_rt) {
    if (is_elastic(project)) tendon_.emplace(*curve_of(project, "tendonForceStrain"));
  }

  [[nodiscard]] VectorXd forces(const MuscleNumbers& n,
                                const VectorXd& time_s,
                                const VectorXd& length_m,
                                const VectorXd& activation) const {
    VectorXd force(time_s.size());
    std::optional<double> before;
    for (Index k = 0; k < time_s.size(); ++k) {
      const double a = activation(k), step = k > 0 ? time_s(k) - time_s(k - 1) : 1.0;
      const auto along_tendon = [&](double fiber) { return at(n, fiber, before ? (fiber - *before) / step : 0.0, a); };
      const double fiber = tendon_ ? balanced(n, length_m(k), along_tendon) : stiff(n, length_m(k), a);
      if (!tendon_ && k == 0 && time_s.size() > 1)  // the speed of the first sample is that of the second
        before = fiber - (stiff(n, length_m(1), activation(1)) - fiber) / (time_s(1) - time_s(0)) * step;
      force(k) = along_tendon(fiber);
      if (is_rt_) force(k) = std::max(force(k), 0.0);
      before = fiber;
    }
    return force;
  }

 private:
  /// Returns the optimal length at an activation.
  [[nodiscard]] double optimal(const MuscleNumbers& n, double a) const {
    return n.optimal_length_m * (1.0 + lengthening_ * (1.0 - a));
  }

  [[nodiscard]] double stiff(const MuscleNumbers& n, double length_m, double a) const {
    const double of = is_rt_ ? optimal(n, a) : n.optimal_length_m;
    return std::hypot(of * std::sin(n.pennation_rad), length_m - n.slack_length_m);
  }

  /// Returns the cosine of the pennation at a fiber length.
  static double cosine(const MuscleNumbers& n, double fiber) {
    const double sine = std::min(1.0, n.optimal_length_m * std::sin(n.pennation_rad) / fiber);
    return std::sqrt(1.0 - sine * sine);
  }

  [[nodiscard]] double at(const MuscleNumbers& n, double fiber, double speed_mps, double a) const {
    const double v = std::clamp(speed_mps / n.optimal_length_m / n.speed, -1.0, 1.0);
    const double total = active_.at(fiber / optimal(n, a)) * velocity_.at(v) * a +
                         passive_.at(fiber / n.optimal_length_m) + damping_ * v;
    return n.strength_n * total * cosine(n, fiber);
  }

  /// Returns the fiber length at which the tendon carries the muscle's force.
  [[nodiscard]] double balanced(const MuscleNumbers& n,
                                double length_m,
                                const std::function<double(double)>& along_tendon) const {
    const double height = n.optimal_length_m * std::sin(n.pennation_rad);
    double longest = std::hypot(height, std::max(0.0, length_m - n.slack_length_m));
    double shortest = std::max(kShortestFiber * n.optimal_length_m, height);
    if (longest <= shortest) return shortest;
    const auto excess = [&](double fiber) {
      const double strain = (length_m - fiber * cosine(n, fiber)) / n.slack_length_m - 1.0;
      return (strain > 0.0 ? n.strength_n * tendon_->at(strain) : 0.0) - along_tendon(fiber);
    };
    if (excess(longest) > 0.0) return longest;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (shortest + longest);
      (excess(middle) > 0.0 ? shortest : longest) = middle;
    }
    return 0.5 * (shortest + longest);
  }

  TableCurve active_, passive_, velocity_;
  std::optional<TableCurve> tendon_;  ///< Empty: stiff.
  double damping_, lengthening_;
  bool is_rt_;
};

}  // namespace

VectorXd recursive_activation(const VectorXd& excitation, double c1, double c2) {
  VectorXd u = excitation;
  const double gain = (1.0 + c1) * (1.0 + c2);
  double last = excitation.size() > 0 ? excitation[0] : 0.0, before_last = last;
  for (Index k = 0; k < u.size(); ++k) {
    u[k] = gain * excitation[k] - (c1 + c2) * last - c1 * c2 * before_last;
    before_last = last;
    last = u[k];
  }
  return u;
}

double exponential_shape(double u, double shape_factor) {
  if (shape_factor == 0.0) return u;
  return std::expm1(shape_factor * u) / std::expm1(shape_factor);
}

std::string missing_of_law(const Project& project) {
  if (project.dialect != Dialect::ceinms && project.dialect != Dialect::ceinms_rt)
    return fmt::format("{} keeps the curves of its muscles in its program", choice_name(project.dialect));
  for (const std::string_view name : {"activeForceLength", "passiveForceLength", "forceVelocity"})
    if (curve_of(project, name) == nullptr) return fmt::format("the subject has no curve {}", name);
  if (is_elastic(project) && curve_of(project, "tendonForceStrain") == nullptr)
    return "the subject has no curve tendonForceStrain, which its elastic tendons need";
  return {};
}

LawForces forces_by_law(const Project& project,
                        const TimeSeries& emg,
                        const TimeSeries& lengths,
                        const std::vector<std::string>& muscles) {
  if (const std::string missing = missing_of_law(project); !missing.empty()) throw InvalidInput(missing);
  const Law law(project);
  const VectorXd& time_s = lengths.time_s();
  std::vector<Channel> channels, of_force;
  Eigen::MatrixXd activation(time_s.size(), static_cast<Index>(muscles.size())), force = activation;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    const ProjectMuscle* muscle = project.find(muscles[i]);
    if (muscle == nullptr) throw InvalidInput(fmt::format("the subject has no muscle '{}'", muscles[i]));
    const MuscleNumbers n = numbers_of(*muscle, project.common.delay_s.value_or(0.0));
    const auto column = static_cast<Index>(i);
    activation.col(column).setZero();
    if (!muscle->inputs.empty()) {
      const VectorXd own = activation_of(n, excitation_of(*muscle, emg, project.dialect == Dialect::ceinms));
      activation.col(column) = linear_at(emg.time_s(), own, time_s, n.delay_s);
    }
    force.col(column) = law.forces(n, time_s, lengths.column(muscles[i]), activation.col(column));
    channels.push_back({muscles[i], Unit::dimensionless});
    of_force.push_back({muscles[i], Unit::newton});
  }
  return {.activation = TimeSeries(time_s, std::move(channels), std::move(activation)),
          .force = TimeSeries(time_s, std::move(of_force), std::move(force))};
}

}  // namespace myoid::opensim
