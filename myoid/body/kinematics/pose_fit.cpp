#include "myoid/body/kinematics/pose_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

constexpr double kLongestTurn_rad = 0.5;  ///< Largest change of a coordinate in one step.
/// The strongest barrier, in units of J [m^2]: as strong as markers 0.4 m off.
constexpr double kFirstBarrier = 0.1;
constexpr double kTurn = 2.0 * kPi;
constexpr double kSame = 1e-9;        ///< A smaller step [rad or m] changes nothing.
constexpr double kNear = 1e-3;        ///< A smaller step [rad or m] leaves the curvature.
constexpr double kLastNewton = 1e-6;  ///< After a smaller step [rad or m] the next is none.

}  // namespace

PoseFit::PoseFit(const body::BodyModel& model, const IkOptions& options, std::vector<Pair> pairs)
    : model_(model), options_(options), pairs_(std::move(pairs)), state_(body::make_state(model)) {
  const std::size_t count = model.coordinates.size();
  coupler_of_.assign(count, -1);
  for (std::size_t k = 0; k < model.couplers.size(); ++k)
    coupler_of_[at(model.couplers[k].dependent)] = static_cast<int>(k);
  reduced_.assign(count, -1);
  gain_.setZero(static_cast<Eigen::Index>(count));
  for (std::size_t c = 0; c < count; ++c) {
    const body::Coordinate& coordinate = model.coordinates[c];
    if (coordinate.locked || coordinate.prescribed || coupler_of_[c] >= 0) continue;
    reduced_[c] = static_cast<int>(free_.size());
    free_.push_back(static_cast<Eigen::Index>(c));
  }
  barrier_ = RangeBarrier(model, free_);
  for (std::size_t c = 0; c < count; ++c) {
    int root = static_cast<int>(c);
    for (std::size_t step = 0; step < count && coupler_of_[at(root)] >= 0; ++step)
      root = model.couplers[at(coupler_of_[at(root)])].independent;
    reduced_[c] = reduced_[at(root)];
  }
  chains_.resize(model.bodies.size());
  pulls_.resize(model.bodies.size());
  for (const body::Joint& joint : model.joints) {
    Chain& chain = chains_[at(joint.child)];
    chain = chains_[at(joint.parent)];
    for (const int c : joint.coordinates)
      if (!turns(joint, c)) chain.coordinates.push_back(c);
    for (const body::TransformAxis& axis : joint.rotation) {
      const auto& added = chain.coordinates;
      if (axis.coordinate >= 0 && std::find(added.begin(), added.end(), axis.coordinate) == added.end())
        chain.coordinates.push_back(axis.coordinate);
    }
    chain.body_of.resize(chain.coordinates.size(), at(joint.child));
  }
  for (const CoordinateTask& task : options.tasks) task_index_.push_back(model.coordinate_index(task.coordinate));
  targets_.seen.assign(pairs_.size(), false);
  targets_.place_m.assign(pairs_.size(), Vec3::Zero());
  place_.assign(pairs_.size(), Vec3::Zero());
  motions_.resize(count);
}

void PoseFit::set_targets(const MarkerSeries& markers, Eigen::Index frame) {
  slopes_.stepped.resize(0);
  targets_.frame = frame;
  targets_.time_s = markers.time_s[frame];
  double sum = 0.0;
  targets_.count = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    targets_.seen[i] = !markers.missing(frame, pairs_[i].file) && pairs_[i].weight > 0.0;
    if (!targets_.seen[i]) continue;
    targets_.place_m[i] = markers.position(frame, pairs_[i].file);
    sum += pairs_[i].weight;
    ++targets_.count;
  }
  targets_.scale = sum > 0.0 ? 1.0 / sum : 0.0;
}

double PoseFit::target_of(std::size_t task) const {
  const CoordinateTask& t = options_.tasks[task];
  return t.values.size() > 0 ? t.values[targets_.frame] : t.value;
}

/// Applies locks, prescriptions, ranges, couplers and constraints.
void PoseFit::obey(Eigen::VectorXd& q) const {
  for (std::size_t c = 0; c < model_.coordinates.size(); ++c) {
    const body::Coordinate& coordinate = model_.coordinates[c];
    double& value = q[static_cast<Eigen::Index>(c)];
    if (coordinate.prescribed) {
      value = evaluate(*coordinate.prescribed, targets_.time_s).value;
    } else if (coordinate.locked) {
      value = coordinate.default_value;
    } else if (coordinate.clamped && coupler_of_[c] < 0) {
      value = std::clamp(value, coordinate.lower, coordinate.upper);
    }
  }
  body::apply_couplers(model_, q);
  if (!model_.constraints.empty()) q = body::assemble(model_, q).q;
}

double PoseFit::cost_at(const Eigen::VectorXd& q) {
  if (!posed_ || state_.q != q) {
    body::compute_poses(model_, q, state_);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const body::Marker& marker = model_.markers[pairs_[i].model];
      place_[i] = state_.X_GB[at(marker.body)] * marker.p_BM;
    }
    posed_ = true;
    ++evaluations_;
  }
  double cost = 0.0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (targets_.seen[i]) cost += pairs_[i].weight * targets_.scale * (place_[i] - targets_.place_m[i]).squaredNorm();
  }
  for (std::size_t j = 0; j < task_index_.size(); ++j) {
    const double off = q[task_index_[j]] - target_of(j);
    cost += options_.tasks[j].weight * off * off;
  }
  if (barrier_.acts()) cost += 2.0 * barrier_.value(q);
  return cost;
}

Eigen::VectorXd PoseFit::moved(const Eigen::VectorXd& q, const Eigen::VectorXd& step) const {
  Eigen::VectorXd next = q;
  for (std::size_t k = 0; k < free_.size(); ++k) next[free_[k]] += step[static_cast<Eigen::Index>(k)];
  obey(next);
  return next;
}

double PoseFit::farthest_turn(const Eigen::VectorXd& step) const {
  double farthest = 0.0;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    if (model_.coordinates[at(free_[k])].motion == body::MotionType::rotational)
      farthest = std::max(farthest, std::abs(step[static_cast<Eigen::Index>(k)]));
  }
  return farthest;
}

/// Returns an orthonormal basis of the steps that keep the constraints other than couplers.
Eigen::MatrixXd PoseFit::allowed_directions(const Eigen::VectorXd& q) const {
  const auto n = static_cast<Eigen::Index>(free_.size());
  const Eigen::MatrixXd all = body::constraint_jacobian(model_, state_);
  const Eigen::MatrixXd loops = all.bottomRows(all.rows() - static_cast<Eigen::Index>(model_.couplers.size()));
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(loops.rows(), n);
  for (Eigen::Index c = 0; c < q.size(); ++c) {
    if (reduced_[at(c)] >= 0) rows.col(reduced_[at(c)]) += gain_[c] * loops.col(c);
  }
  return math::null_space(rows);
}

/// Returns the free coordinates at an end of their range whose descent leads outside: they are held.
std::vector<bool> PoseFit::held_at_ends(const Eigen::VectorXd& q) const {
  std::vector<bool> held(free_.size(), false);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const auto& coordinate = model_.coordinates[at(free_[k])];
    const double value = q[free_[k]];
    const double slope = slopes_.gradient[static_cast<Eigen::Index>(k)];
    held[k] = coordinate.clamped &&
              ((value <= coordinate.lower && slope > 0.0) || (value >= coordinate.upper && slope < 0.0));
  }
  return held;
}

/// Returns the damped step of the free coordinates from q; empty where the matrix is not positive definite. `N` spans
/// the allowed steps (no columns: all). Held coordinates have no step and no gradient.
std::optional<Eigen::VectorXd> PoseFit::damped_step(const Eigen::VectorXd& q,
                                                    const std::vector<bool>& held,
                                                    const Eigen::MatrixXd& N,
                                                    bool second_order,
                                                    double shift) {
  slopes_.hessian = slopes_.gauss;
  if (second_order) slopes_.hessian += slopes_.bend;
  for (Eigen::Index k = 0; k < slopes_.hessian.rows(); ++k) {
    if (!held[at(k)]) continue;
    slopes_.gradient[k] = 0.0;
    slopes_.hessian.row(k).setZero();
    slopes_.hessian.col(k).setZero();
    slopes_.hessian(k, k) = 1.0;
  }
  Eigen::VectorXd step = -slopes_.gradient;
  if (N.size() > 0) {
    slopes_.hessian = (N.transpose() * slopes_.hessian.selfadjointView<Eigen::Lower>() * N).eval();
    step = (N.transpose() * step).eval();
  }
  slopes_.hessian.diagonal().array() += shift;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(slopes_.hessian);
  if (factor.info() != Eigen::Success) return std::nullopt;
  factor.solveInPlace(step);
  if (N.size() > 0) step = (N * step).eval();
  // Two nearly parallel axes determine only the sum of their angles: a full step could turn them
  // against each other by many turns.
  const double farthest = farthest_turn(step);
  if (farthest > kLongestTurn_rad) step *= kLongestTurn_rad / farthest;
  if (barrier_.acts()) step *= barrier_.longest_share(q, step);
  return step;
}

/// Makes one iteration: increases the damping until the cost falls or no step changes the pose.
void PoseFit::descend(Search& search) {
  Pose& pose = search.pose;
  double& damping = search.damping;
  linearize(pose.q);
  const std::vector<bool> held = held_at_ends(pose.q);
  const Eigen::MatrixXd N = model_.constraints.empty() ? Eigen::MatrixXd() : allowed_directions(pose.q);
  const double size = std::max(slopes_.gauss.diagonal().maxCoeff(), 1e-300);
  bool second_order = true;
  for (;;) {
    const auto step = damped_step(pose.q, held, N, second_order, (damping + 1e-13) * size);
    if (!step) {
      // J is not convex here: its first-order part is, with some damping.
      if (second_order) {
        second_order = false;
      } else {
        damping = std::max(10.0 * damping, 1e-10);
      }
      continue;
    }
    Eigen::VectorXd q = moved(pose.q, *step);
    const double distance = (q - pose.q).cwiseAbs().maxCoeff();
    const double cost = cost_at(q);
    if (cost <= pose.cost) {
      // A full Newton step leaves an error of the order of its square.
      const bool newton = second_order && damping == 0.0 && N.size() == 0 && !barrier_.acts();
      pose.converged = distance <= (newton ? kLastNewton : kSame);
      pose.q = std::move(q);
      pose.cost = cost;
      damping = damping < 1e-9 ? 0.0 : 0.1 * damping;
      return;
    }
    if (distance <= 1e-8 || damping > 1e12) {
      // The costs are equal to round-off.
      pose.converged = true;
      (void)cost_at(pose.q);
      return;
    }
    if (second_order && damping > 1e-6) second_order = false;
    damping = std::max(10.0 * damping, 1e-8);
  }
}

PoseFit::Search PoseFit::begin(Eigen::VectorXd start) {
  obey(start);
  if (barrier_.acts()) {
    barrier_.move_inside(start, 0.01);
    obey(start);
  }
  Search search{{std::move(start), 0.0, false}, 0.0};
  search.pose.cost = cost_at(search.pose.q);
  return search;
}

void PoseFit::advance(Search& search, int iterations) {
  (void)cost_at(search.pose.q);
  for (int iteration = 0; iteration < iterations && !search.pose.converged; ++iteration) descend(search);
}

PoseFit::Pose PoseFit::solve(Eigen::VectorXd start) {
  Search search = begin(std::move(start));
  advance(search, options_.max_iterations);
  (void)cost_at(search.pose.q);
  return std::move(search.pose);
}

PoseFit::Pose PoseFit::solve_inside(Eigen::VectorXd start, double barrier) {
  Pose pose{std::move(start), 0.0, false};
  for (double weight = std::max(barrier, kFirstBarrier);; weight = std::max(barrier, 0.1 * weight)) {
    barrier_.set_weight(weight);
    pose = solve(std::move(pose.q));
    if (weight == barrier) break;
  }
  barrier_.set_weight(0.0);
  return pose;
}

/// Returns the posture with a coordinate moved by whole turns if that leaves the cost unchanged: functions, couplers
/// and tasks of the coordinate may change it.
std::optional<Eigen::VectorXd> PoseFit::turned_whole(const Pose& pose, std::size_t k, double turns) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free_.size()));
  step[static_cast<Eigen::Index>(k)] = turns * kTurn;
  Eigen::VectorXd q = moved(pose.q, step);
  if (std::abs(cost_at(q) - pose.cost) <= 1e-9 * pose.cost + 1e-15) return q;
  return std::nullopt;
}

void PoseFit::unwind(Pose& pose) {
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const body::Coordinate& coordinate = model_.coordinates[at(free_[k])];
    const double value = pose.q[free_[k]];
    if (coordinate.motion != body::MotionType::rotational || (value >= coordinate.lower && value <= coordinate.upper))
      continue;
    const auto q = turned_whole(pose, k, std::round((0.5 * (coordinate.lower + coordinate.upper) - value) / kTurn));
    const auto outside = [&](double x) { return std::max({0.0, coordinate.lower - x, x - coordinate.upper}); };
    if (q && outside((*q)[free_[k]]) < outside(value)) pose.q = *q;
  }
}

void PoseFit::unwind_towards(const Eigen::VectorXd& neighbor, Pose& pose) {
  for (std::size_t k = 0; k < free_.size(); ++k) {
    if (model_.coordinates[at(free_[k])].motion != body::MotionType::rotational) continue;
    const double turns = std::round((neighbor[free_[k]] - pose.q[free_[k]]) / kTurn);
    if (turns == 0.0) continue;
    if (const auto q = turned_whole(pose, k, turns)) pose.q = *q;
  }
}

double PoseFit::place(const Eigen::VectorXd& q) { return cost_at(q); }

double PoseFit::place_within(Eigen::VectorXd q) {
  obey(q);
  return cost_at(q);
}

double PoseFit::part_of(const std::vector<std::size_t>& pairs) const {
  double part = 0.0;
  for (const std::size_t i : pairs)
    if (targets_.seen[i]) part += pairs_[i].weight * targets_.scale * (place_[i] - targets_.place_m[i]).squaredNorm();
  return part;
}

double PoseFit::mean_square(const std::vector<std::size_t>& pairs) const {
  double sum = 0.0;
  int seen = 0;
  for (const std::size_t i : pairs) {
    if (!targets_.seen[i]) continue;
    sum += (place_[i] - targets_.place_m[i]).squaredNorm();
    ++seen;
  }
  return seen > 0 ? sum / seen : 0.0;
}

double PoseFit::work() const {
  return evaluations_ * static_cast<double>(model_.bodies.size() + model_.coordinates.size());
}

void PoseFit::collect_undetermined(std::vector<bool>& undetermined) {
  linearize(state_.q);
  const math::SymmetricEigen eigen =
      math::symmetric_eigen(Eigen::MatrixXd(slopes_.gauss.selfadjointView<Eigen::Lower>()));
  const double largest = eigen.values.size() > 0 ? eigen.values[eigen.values.size() - 1] : 0.0;
  for (Eigen::Index k = 0; k < slopes_.gauss.cols(); ++k) {
    // Eigenvalues are squared singular values of the Jacobian: the limit is 1e-7 of the largest singular value.
    if (eigen.values[k] > 1e-14 * largest) continue;
    for (Eigen::Index j = 0; j < slopes_.gauss.cols(); ++j) {
      if (std::abs(eigen.vectors(j, k)) > 1e-3) undetermined[at(j)] = true;
    }
  }
}

Eigen::MatrixXd PoseFit::curvature(const Eigen::VectorXd& q, const std::vector<Eigen::Index>& coordinates) {
  if (slopes_.stepped.size() == 0 || (q - slopes_.stepped).cwiseAbs().maxCoeff() > kNear) {
    (void)cost_at(q);
    linearize(q);
  }
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  const auto free_index = [&](Eigen::Index i) {
    const int k = reduced_[at(coordinates[at(i)])];
    return k >= 0 && free_[at(k)] == coordinates[at(i)] ? k : -1;
  };
  Eigen::MatrixXd block = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const int a = free_index(i), b = free_index(j);
      if (a >= 0 && b >= 0) block(i, j) = slopes_.gauss(std::max(a, b), std::min(a, b));
    }
  }
  return block;
}

double PoseFit::error(std::size_t pair) const {
  if (!targets_.seen[pair]) return std::numeric_limits<double>::quiet_NaN();
  return (place_[pair] - targets_.place_m[pair]).norm();
}

void PoseFit::locate(Eigen::MatrixXd& table, Eigen::Index row) const {
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    table.block<1, 3>(row, static_cast<Eigen::Index>(3 * i)) = place_[i].transpose();
}

}  // namespace myoid::body
