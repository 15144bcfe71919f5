#include "myoid/lab/virtual_person/effective_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/least_squares.h"

namespace myoid::lab {
namespace {

using Hill = muscle::HillParameters<double>;

constexpr std::array kAngles_deg = {15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 130.0};
constexpr std::array kSpeeds_radps = {-5.0, -2.5, -1.0, 0.0, 1.0, 2.5, 5.0};
constexpr std::array kActivations = {0.1, 0.3, 0.6, 0.9};

/// A steady state of a muscle, with the model's kinematics in this state.
struct SteadyPoint {
  double activation, path_m, path_mps, arm_m, torque_nm;
};

/// The heads of one muscle of a person.
class TrueMuscle {
 public:
  TrueMuscle(const TrueArm& person, std::size_t m) {
    for (const TrueHead& head : person.heads) {
      if (head.muscle != m) continue;
      heads_.push_back(&head);
      units_.emplace_back(head.parameters, person.laws, person.millard);
    }
  }

  /// Returns the torque at a steady speed of the joint, with fibers and tendons in equilibrium. `driven`: each head is
  /// active by its own drive.
  [[nodiscard]] double torque_nm(double muscle_activation,
                                 double angle_rad,
                                 double speed_radps,
                                 bool driven = false) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      const double activation = driven ? std::min(1.0, muscle_activation * heads_[i]->drive) : muscle_activation;
      const body::MuscleTravel path = body::travel(heads_[i]->path, angle_rad);
      const muscle::MusculotendonInput<double> input{activation, path.length_m, -path.moment_arm_m * speed_radps};
      const auto state = muscle::equilibrium_state(units_[i], input);
      sum += path.moment_arm_m * muscle::musculotendon_rate(units_[i], input, state).tendon_force_n;
    }
    return sum;
  }

 private:
  std::vector<const TrueHead*> heads_;
  std::vector<muscle::Musculotendon<double>> units_;
};

std::vector<SteadyPoint> steady_points(const TrueArm& person, const VirtualArm& modelled, std::size_t m) {
  const TrueMuscle muscle(person, m);
  std::vector<SteadyPoint> points;
  for (const double angle_deg : kAngles_deg) {
    const double q_rad = angle_deg * kDegree;
    const body::MuscleTravel model = modelled.modelled_travel(m, q_rad);
    for (const double speed_radps : kSpeeds_radps) {
      const double resting_nm = muscle.torque_nm(0.0, q_rad, speed_radps);
      for (const double a : kActivations) {
        points.push_back({a, model.length_m, -model.moment_arm_m * speed_radps, model.moment_arm_m,
                          muscle.torque_nm(a, q_rad, speed_radps) - resting_nm});
      }
    }
  }
  return points;
}

/// A fitted parameter, by the index in muscle::kHillFields and in a tension's fields.
struct Fitted {
  fit::MuscleField field;
  double tether;  ///< Weight of (value / literature - 1) in the residual.
  [[nodiscard]] const muscle::HillField& row() const { return muscle::kHillFields[static_cast<std::size_t>(field)]; }
};
constexpr std::array<Fitted, 6> kFitted = {{{fit::kMaxForce, 0.0},
                                            {fit::kFiberLength, 0.0},
                                            {fit::kWidth, 0.0},
                                            {fit::kCurvature, 0.1},
                                            {fit::kProduct, 0.1},
                                            {fit::kPlateau, 0.3}}};

}  // namespace

HillSet effective_muscles(const TrueArm& person, const VirtualArm& modelled, PerMuscle* misfit) {
  constexpr auto kPerMuscle = static_cast<Eigen::Index>(kFitted.size());
  const HillSet literature = modelled.literature;
  const auto muscles = static_cast<Eigen::Index>(literature.size());
  std::vector<std::vector<SteadyPoint>> points;
  std::vector<double> largest_nm;
  Eigen::Index count = 0;
  for (std::size_t m = 0; m < literature.size(); ++m) {
    points.push_back(steady_points(person, modelled, m));
    double largest = 0.0;
    for (const SteadyPoint& p : points.back()) largest = std::max(largest, std::abs(p.torque_nm));
    largest_nm.push_back(largest);
    count += static_cast<Eigen::Index>(points.back().size());
  }
  // The solver's variables are the parameters over the literature's values, and at the end gamma.
  const Eigen::Index gamma = kPerMuscle * muscles;
  const auto hill_of = [&literature](const Eigen::VectorXd& x, Eigen::Index m) {
    Hill p = literature[static_cast<std::size_t>(m)];
    for (std::size_t i = 0; i < kFitted.size(); ++i)
      p.*(kFitted[i].row().member) *= x(kPerMuscle * m + static_cast<Eigen::Index>(i));
    return p;
  };
  math::LeastSquaresProblem problem;
  problem.residual_count = count + gamma;  // the tethers come last
  problem.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    if (J != nullptr) J->setZero();
    Eigen::Index row = 0;
    for (Eigen::Index m = 0; m < muscles; ++m) {
      const auto muscle = static_cast<std::size_t>(m);
      const fit::MuscleValues values = fit::muscle_values(hill_of(x, m), {.length_activation = x(gamma)});
      fit::Tension t;
      const Eigen::Index first = kPerMuscle * m;
      for (const SteadyPoint& point : points[muscle]) {
        fit::plain_tension(point.activation, point.path_m, point.path_mps, values, t);
        const double scale = point.arm_m / largest_nm[muscle];
        r(row) = scale * t.force_n - point.torque_nm / largest_nm[muscle];
        if (J != nullptr) {
          for (std::size_t i = 0; i < kFitted.size(); ++i) {
            const double by_value = scale * t.by_field[static_cast<std::size_t>(kFitted[i].field)];
            (*J)(row, first + static_cast<Eigen::Index>(i)) = by_value * literature[muscle].*(kFitted[i].row().member);
          }
          (*J)(row, gamma) = scale * t.by_field[fit::kLengthActivation];
        }
        ++row;
      }
      for (std::size_t i = 0; i < kFitted.size(); ++i) {
        const Eigen::Index c = first + static_cast<Eigen::Index>(i);
        r(count + c) = kFitted[i].tether * (x(c) - 1.0);
        if (J != nullptr) (*J)(count + c, c) = kFitted[i].tether;
      }
    }
  };
  Eigen::VectorXd start = Eigen::VectorXd::Ones(gamma + 1);
  problem.lower.setZero(gamma + 1);
  problem.upper.resize(gamma + 1);
  problem.upper(gamma) = 0.5;
  start(gamma) = 0.1;
  for (Eigen::Index m = 0; m < muscles; ++m) {
    for (std::size_t i = 0; i < kFitted.size(); ++i) {
      const Eigen::Index c = kPerMuscle * m + static_cast<Eigen::Index>(i);
      const muscle::HillField& field = kFitted[i].row();
      const double value = literature[static_cast<std::size_t>(m)].*(field.member);
      problem.lower(c) = field.bounds.lower / value;
      problem.upper(c) = field.bounds.upper / value;
    }
  }
  const math::LeastSquaresResult fit = math::minimize(problem, start, {.max_iterations = 100, .step_tolerance = 1e-8});
  HillSet result;
  Eigen::Index row = 0;
  for (Eigen::Index m = 0; m < muscles; ++m) {
    const auto muscle = static_cast<std::size_t>(m);
    result[muscle] = hill_of(fit.x, m);
    const auto here = static_cast<Eigen::Index>(points[muscle].size());
    if (misfit != nullptr) {
      double torque2 = 0.0;
      for (const SteadyPoint& p : points[muscle]) torque2 += p.torque_nm * p.torque_nm;
      (*misfit)[muscle] = largest_nm[muscle] * fit.residual.segment(row, here).norm() / std::sqrt(torque2);
    }
    row += here;
  }
  return result;
}

double resting_torque_nm(const TrueArm& person,
                         std::size_t muscle,
                         double elbow_flexion_rad,
                         double elbow_flexion_speed_radps) {
  return TrueMuscle(person, muscle).torque_nm(0.0, elbow_flexion_rad, elbow_flexion_speed_radps);
}

std::vector<double> active_torque_nm(const TrueArm& person,
                                     std::size_t muscle,
                                     double activation,
                                     const std::vector<double>& elbow_flexion_rad,
                                     double elbow_flexion_speed_radps) {
  const TrueMuscle of(person, muscle);
  std::vector<double> torque_nm;
  for (const double angle_rad : elbow_flexion_rad)
    torque_nm.push_back(of.torque_nm(activation, angle_rad, elbow_flexion_speed_radps, true) -
                        of.torque_nm(0.0, angle_rad, elbow_flexion_speed_radps));
  return torque_nm;
}

PerMuscle anatomical_strength_n(const TrueArm& person) {
  PerMuscle strength_n = {};
  for (const TrueHead& head : person.heads)
    strength_n[head.muscle] +=
        head.parameters.hill.max_isometric_force_n * std::cos(head.parameters.pennation_at_optimal_rad);
  return strength_n;
}

}  // namespace myoid::lab
