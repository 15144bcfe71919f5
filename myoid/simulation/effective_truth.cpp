#include "myoid/simulation/effective_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "myoid/core/units.h"
#include "myoid/math/least_squares.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::simulation {
namespace {

using Hill = muscle::HillParameters<double>;

constexpr std::array kAngles_deg = {15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 130.0};
constexpr std::array kSpeeds_radps = {-5.0, -2.5, -1.0, 0.0, 1.0, 2.5, 5.0};
constexpr std::array kActivations = {0.1, 0.3, 0.6, 0.9};

/// A steady state of a muscle, and the model's kinematics in it.
struct SteadyPoint {
  double activation, path_m, path_mps, arm_m, torque_nm;
};

std::vector<SteadyPoint> steady_points(const TrueArm& person,
                                       const VirtualArm& modelled,
                                       std::size_t m) {
  std::vector<muscle::Musculotendon<double>> units;
  std::vector<const TrueHead*> heads;
  for (const TrueHead& head : person.heads) {
    if (head.muscle != m) continue;
    heads.push_back(&head);
    units.emplace_back(head.parameters, person.laws, person.millard);
  }
  std::vector<SteadyPoint> points;
  for (const double angle_deg : kAngles_deg) {
    const double q_rad = angle_deg * kDegree;
    const model::MuscleTravel model = modelled.modelled_travel(m, q_rad);
    for (const double speed_radps : kSpeeds_radps) {
      for (const double a : kActivations) {
        SteadyPoint point{a, model.length_m, -model.moment_arm_m * speed_radps, model.moment_arm_m,
                          0.0};
        for (std::size_t i = 0; i < heads.size(); ++i) {
          const model::MuscleTravel path = model::travel(heads[i]->path, q_rad);
          const muscle::MusculotendonInput<double> input{a, path.length_m,
                                                         -path.moment_arm_m * speed_radps};
          const auto state = muscle::equilibrium_state(units[i], input);
          point.torque_nm +=
              path.moment_arm_m * muscle::musculotendon_rate(units[i], input, state).tendon_force_n;
        }
        points.push_back(point);
      }
    }
  }
  return points;
}

/// What is fitted, and how its derivative is found.
struct Fitted {
  double Hill::*value;
  double muscle::HillForce::*derivative;
  double tether;  ///< Weight of (value / literature - 1) in the residual.
};
constexpr std::array<Fitted, 6> kFitted = {
    {{&Hill::max_isometric_force_n, &muscle::HillForce::by_max_isometric_force, 0.0},
     {&Hill::optimal_fiber_length_m, &muscle::HillForce::by_optimal_fiber_length, 0.0},
     {&Hill::force_length_width_m, &muscle::HillForce::by_force_length_width, 0.0},
     {&Hill::concentric_curvature, &muscle::HillForce::by_concentric_curvature, 0.1},
     {&Hill::eccentric_curvature_product, &muscle::HillForce::by_eccentric_curvature_product, 0.1},
     {&Hill::eccentric_plateau, &muscle::HillForce::by_eccentric_plateau, 0.3}}};

double bound_of(double Hill::*value, bool upper) {
  for (const muscle::HillField& field : muscle::kHillFields) {
    if (field.member == value) return upper ? field.bounds.upper : field.bounds.lower;
  }
  return upper ? HUGE_VAL : -HUGE_VAL;
}

}  // namespace

HillSet effective_muscles(const TrueArm& person, const VirtualArm& modelled, PerMuscle* misfit) {
  HillSet result = modelled.literature();
  for (std::size_t m = 0; m < result.size(); ++m) {
    const Hill literature = result[m];
    const std::vector<SteadyPoint> points = steady_points(person, modelled, m);
    double largest_nm = 0.0;
    for (const SteadyPoint& p : points) largest_nm = std::max(largest_nm, std::abs(p.torque_nm));
    // The solver sees each parameter over the literature's value.
    const auto hill_of = [&literature](const Eigen::VectorXd& x) {
      Hill p = literature;
      for (std::size_t i = 0; i < kFitted.size(); ++i)
        p.*(kFitted[i].value) *= x(static_cast<Eigen::Index>(i));
      return p;
    };
    math::LeastSquaresProblem problem;
    const auto count = static_cast<Eigen::Index>(points.size());
    problem.residual_count = count + static_cast<Eigen::Index>(kFitted.size());
    problem.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
      const Hill p = hill_of(x);
      for (Eigen::Index k = 0; k < count; ++k) {
        const SteadyPoint& point = points[static_cast<std::size_t>(k)];
        const muscle::HillForce f = muscle::hill_force_derivatives(
            point.activation, point.path_m - p.tendon_slack_length_m, point.path_mps, p);
        r(k) = (point.arm_m * f.force_n - point.torque_nm) / largest_nm;
        if (J == nullptr) continue;
        for (std::size_t i = 0; i < kFitted.size(); ++i)
          (*J)(k, static_cast<Eigen::Index>(i)) = point.arm_m * (f.*(kFitted[i].derivative)) *
                                                  literature.*(kFitted[i].value) / largest_nm;
      }
      if (J != nullptr) J->bottomRows(kFitted.size()).setZero();
      for (std::size_t i = 0; i < kFitted.size(); ++i) {
        const auto c = static_cast<Eigen::Index>(i);
        r(count + c) = kFitted[i].tether * (x(c) - 1.0);
        if (J != nullptr) (*J)(count + c, c) = kFitted[i].tether;
      }
    };
    problem.lower.resize(kFitted.size());
    problem.upper.resize(kFitted.size());
    for (std::size_t i = 0; i < kFitted.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      problem.lower(k) = bound_of(kFitted[i].value, false) / (literature.*(kFitted[i].value));
      problem.upper(k) = bound_of(kFitted[i].value, true) / (literature.*(kFitted[i].value));
    }
    const math::LeastSquaresResult fit =
        math::minimize(problem, Eigen::VectorXd::Ones(kFitted.size()),
                       {.max_iterations = 100, .step_tolerance = 1e-8});
    result[m] = hill_of(fit.x);
    if (misfit == nullptr) continue;
    double torque2 = 0.0;
    for (const SteadyPoint& p : points) torque2 += p.torque_nm * p.torque_nm;
    (*misfit)[m] = largest_nm * fit.residual.head(count).norm() / std::sqrt(torque2);
  }
  return result;
}

PerMuscle anatomical_strength_n(const TrueArm& person) {
  PerMuscle strength_n = {};
  for (const TrueHead& head : person.heads)
    strength_n[head.muscle] += head.parameters.hill.max_isometric_force_n *
                               std::cos(head.parameters.pennation_at_optimal_rad);
  return strength_n;
}

}  // namespace myoid::simulation
