#include "myoid/kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::kinematics {
namespace {

/// One marker that both the model and the file have.
struct Pair {
  std::size_t model = 0;
  Eigen::Index file = 0;
  double weight = 1.0;
};

/// Steps of Gauss-Newton before second derivatives are worth their price; most frames need 5.
constexpr int kNewtonFrom = 20;

class Solver {
 public:
  Solver(const model::BodyModel& model, const IkOptions& options, std::vector<Pair> pairs)
      : model_(model),
        options_(options),
        pairs_(std::move(pairs)),
        state_(model::make_state(model)) {
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
      if (!model.coordinates[c].locked) free_.push_back(static_cast<Eigen::Index>(c));
    }
    const auto n = static_cast<Eigen::Index>(free_.size());
    const auto rows = static_cast<Eigen::Index>(3 * pairs_.size() + options.tasks.size());
    residual_.setZero(rows);
    jacobian_.setZero(rows, n);
    for (const CoordinateTask& task : options.tasks)
      task_index_.push_back(model.coordinate_index(task.coordinate));
    seen_.assign(pairs_.size(), false);
    target_.assign(pairs_.size(), Vec3::Zero());
  }

  void set_targets(const recording::MarkerSeries& markers, Eigen::Index frame) {
    double sum = 0.0;
    seen_count_ = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      seen_[i] = !markers.missing(frame, pairs_[i].file) && pairs_[i].weight > 0.0;
      if (!seen_[i]) continue;
      target_[i] = markers.position(frame, pairs_[i].file);
      sum += pairs_[i].weight;
      ++seen_count_;
    }
    scale_ = sum > 0.0 ? 1.0 / sum : 0.0;
  }
  [[nodiscard]] int seen_count() const { return seen_count_; }

  /// 2 J(q); fills residual and Jacobian by the free coordinates.
  double linearize(const Eigen::VectorXd& q) {
    model::compute_poses(model_, q, state_);
    residual_.setZero();
    jacobian_.setZero();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (!seen_[i]) continue;
      const model::Marker& marker = model_.markers[pairs_[i].model];
      const double root = std::sqrt(pairs_[i].weight * scale_);
      const auto row = static_cast<Eigen::Index>(3 * i);
      const Vec3 p_GM = state_.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
      residual_.segment<3>(row) = root * (p_GM - target_[i]);
      const Eigen::Matrix3Xd full =
          model::station_jacobian(model_, state_, marker.body, marker.p_BM);
      for (std::size_t k = 0; k < free_.size(); ++k) {
        jacobian_.block<3, 1>(row, static_cast<Eigen::Index>(k)) = root * full.col(free_[k]);
      }
    }
    for (std::size_t j = 0; j < task_index_.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(3 * pairs_.size() + j);
      const double root = std::sqrt(options_.tasks[j].weight);
      residual_[row] = root * (q[task_index_[j]] - options_.tasks[j].value);
      for (std::size_t k = 0; k < free_.size(); ++k) {
        if (free_[k] == task_index_[j]) jacobian_(row, static_cast<Eigen::Index>(k)) = root;
      }
    }
    return residual_.squaredNorm();
  }

  [[nodiscard]] Eigen::VectorXd clipped(Eigen::VectorXd q) const {
    for (const Eigen::Index c : free_) {
      const model::Coordinate& coordinate = model_.coordinates[static_cast<std::size_t>(c)];
      if (coordinate.clamped) q[c] = std::clamp(q[c], coordinate.lower, coordinate.upper);
    }
    return q;
  }

  /// Derivative of J'r by the free coordinates, by central differences: J'J and the curvature of
  /// the markers' paths that it leaves out. That part counts where markers lie far from the
  /// model's.
  Eigen::MatrixXd curvature(const Eigen::VectorXd& q) {
    constexpr double kStep = 1e-6;  // near the cube root of the machine's precision
    const auto n = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd result(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::VectorXd moved = q;
      moved[free_[static_cast<std::size_t>(k)]] += kStep;
      linearize(moved);
      result.col(k) = jacobian_.transpose() * residual_;
      moved[free_[static_cast<std::size_t>(k)]] -= 2.0 * kStep;
      linearize(moved);
      result.col(k) = (result.col(k) - jacobian_.transpose() * residual_) / (2.0 * kStep);
    }
    return 0.5 * (result + result.transpose());
  }

  struct Pose {
    Eigen::VectorXd q;
    double cost = 0.0;
    bool converged = false;
  };

  Pose solve(Eigen::VectorXd start) {
    Pose pose{clipped(std::move(start)), 0.0, false};
    pose.cost = linearize(pose.q);
    const auto n = static_cast<Eigen::Index>(free_.size());
    double damping = 1e-8;
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      Eigen::VectorXd gradient = jacobian_.transpose() * residual_;
      Eigen::MatrixXd normal = jacobian_.transpose() * jacobian_;
      if (iteration >= kNewtonFrom) {
        // Gauss-Newton is slow where residuals are large; Newton is not.
        const Eigen::MatrixXd full = curvature(pose.q);
        if (full.llt().info() == Eigen::Success) normal = full;
      }
      // Clamped coordinates at their end that are pushed beyond stay.
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto& coordinate =
            model_.coordinates[static_cast<std::size_t>(free_[static_cast<std::size_t>(k)])];
        const double value = pose.q[free_[static_cast<std::size_t>(k)]];
        if (coordinate.clamped && ((value <= coordinate.lower && gradient[k] > 0.0) ||
                                   (value >= coordinate.upper && gradient[k] < 0.0))) {
          gradient[k] = 0.0;
          normal.row(k).setZero();
          normal.col(k).setZero();
          normal(k, k) = 1.0;
        }
      }
      const double size = std::max(normal.diagonal().maxCoeff(), 1e-300);
      if (gradient.cwiseAbs().maxCoeff() <= 1e-15 * std::sqrt(size)) {
        pose.converged = true;
        return pose;
      }
      bool accepted = false;
      while (!accepted) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal().array() += damping * size;
        const Eigen::VectorXd step = damped.ldlt().solve(-gradient);
        Eigen::VectorXd q = pose.q;
        for (Eigen::Index k = 0; k < n; ++k) q[free_[static_cast<std::size_t>(k)]] += step[k];
        q = clipped(std::move(q));
        const double moved = (q - pose.q).cwiseAbs().maxCoeff();
        const double cost = linearize(q);
        if (cost <= pose.cost) {
          accepted = true;
          const bool done = moved <= 1e-12;
          pose.q = q;
          pose.cost = cost;
          damping = std::max(damping * 0.1, 1e-14);
          if (done) {
            pose.converged = true;
            return pose;
          }
        } else {
          if (moved <= 1e-10 || damping > 1e12) {
            // Round-off decides between equal costs.
            pose.cost = linearize(pose.q);
            pose.converged = true;
            return pose;
          }
          damping *= 10.0;
        }
      }
    }
    pose.cost = linearize(pose.q);
    return pose;
  }

  /// Free coordinates with a part in directions that the frame's markers and tasks leave open.
  void collect_undetermined(std::vector<bool>& undetermined) const {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian_, Eigen::ComputeFullV);
    const double largest = svd.singularValues().size() > 0 ? svd.singularValues()[0] : 0.0;
    for (Eigen::Index k = 0; k < jacobian_.cols(); ++k) {
      const double value = k < svd.singularValues().size() ? svd.singularValues()[k] : 0.0;
      if (value > 1e-7 * largest) continue;
      for (Eigen::Index j = 0; j < jacobian_.cols(); ++j) {
        if (std::abs(svd.matrixV()(j, k)) > 1e-3) undetermined[static_cast<std::size_t>(j)] = true;
      }
    }
  }

  /// Distance of a marker from its target at the last pose; NaN if it was not seen.
  [[nodiscard]] double error(std::size_t i) const {
    if (!seen_[i]) return std::numeric_limits<double>::quiet_NaN();
    const model::Marker& marker = model_.markers[pairs_[i].model];
    return (state_.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM - target_[i]).norm();
  }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] const std::vector<Eigen::Index>& free() const { return free_; }

 private:
  const model::BodyModel& model_;
  const IkOptions& options_;
  std::vector<Pair> pairs_;
  std::vector<Eigen::Index> free_;
  std::vector<int> task_index_;
  model::BodyState state_;
  std::vector<bool> seen_;
  std::vector<Vec3> target_;
  double scale_ = 0.0;
  int seen_count_ = 0;
  Eigen::VectorXd residual_;
  Eigen::MatrixXd jacobian_;
};

std::vector<Pair> pair_markers(const model::BodyModel& model,
                               const recording::MarkerSeries& markers,
                               const IkOptions& options,
                               std::vector<std::string>& notes) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < model.markers.size(); ++i) {
    const std::string& name = model.markers[i].name;
    const auto it = std::find(markers.names.begin(), markers.names.end(), name);
    if (it == markers.names.end()) {
      notes.push_back(fmt::format("marker '{}' of the model is not in the recording", name));
      continue;
    }
    const auto weight = options.marker_weights.find(name);
    const double w = weight == options.marker_weights.end() ? 1.0 : weight->second;
    if (!(w >= 0.0))
      throw InvalidInput(fmt::format("marker '{}': weight {}, expected 0 or more", name, w));
    pairs.push_back({i, it - markers.names.begin(), w});
  }
  for (const auto& [name, weight] : options.marker_weights) {
    if (model.find_marker(name)) continue;
    std::vector<std::string> names;
    for (const model::Marker& marker : model.markers) names.push_back(marker.name);
    throw InvalidInput(fmt::format("marker weight: the model has no marker '{}'; there are {}",
                                   name, fmt::join(names, ", ")));
  }
  for (const std::string& name : markers.names) {
    if (!model.find_marker(name))
      notes.push_back(fmt::format("marker '{}' of the recording is not in the model", name));
  }
  if (pairs.empty()) {
    std::vector<std::string> names;
    for (const model::Marker& marker : model.markers) names.push_back(marker.name);
    const auto some = [](const std::vector<std::string>& all) {
      const std::vector<std::string> head(
          all.begin(),
          all.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(all.size(), 12)));
      return fmt::format("{}{}", fmt::join(head, ", "), all.size() > head.size() ? ", ..." : "");
    };
    throw InvalidInput(
        fmt::format("no marker of the recording ({}) is in the model ({}); rename them ([markers] "
                    "rename in a study)",
                    some(markers.names), some(names)));
  }
  return pairs;
}

}  // namespace

IkResult inverse_kinematics(const model::BodyModel& model,
                            const recording::MarkerSeries& markers,
                            const IkOptions& options) {
  IkResult result;
  Solver solver(model, options, pair_markers(model, markers, options, result.notes));
  if (solver.free().empty())
    throw ModelError("inverse kinematics: every coordinate of the model is locked");
  const Eigen::Index frames = markers.frame_count();
  const auto coordinates = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd q(frames, coordinates);
  Eigen::MatrixXd errors =
      Eigen::MatrixXd::Constant(frames, 3 + static_cast<Eigen::Index>(solver.pairs().size()), 0.0);
  Eigen::VectorXd posture = model.default_q();
  std::vector<bool> undetermined(solver.free().size(), false);
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    if (frame % 256 == 0) {
      options.progress.check();
      options.progress.tell(static_cast<double>(frame) / static_cast<double>(frames),
                            "inverse kinematics");
    }
    solver.set_targets(markers, frame);
    if (solver.seen_count() == 0) {
      result.status.push_back(FrameStatus::no_markers);
      result.objective.push_back(0.0);
      ++result.frames_without_markers;
      q.row(frame) = posture;
      errors.row(frame).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    Solver::Pose pose = solver.solve(posture);
    if (frame == 0 || !pose.converged) {
      // A second start guards against a stall; the better of the two counts.
      const Solver::Pose again =
          solver.solve(frame == 0 ? Eigen::VectorXd(posture.array() + 0.3) : model.default_q());
      if ((again.converged && !pose.converged) || again.cost < pose.cost * (1.0 - 1e-9))
        pose = again;
    }
    solver.linearize(pose.q);
    if (frame % 16 == 0 || frame + 1 == frames) solver.collect_undetermined(undetermined);
    posture = pose.q;
    q.row(frame) = posture;
    result.status.push_back(pose.converged ? FrameStatus::converged : FrameStatus::not_converged);
    if (!pose.converged) ++result.frames_not_converged;
    result.objective.push_back(0.5 * pose.cost);
    double total = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < solver.pairs().size(); ++i) {
      const double error = solver.error(i);
      errors(frame, 3 + static_cast<Eigen::Index>(i)) = error;
      if (!std::isfinite(error)) continue;
      total += error * error;
      largest = std::max(largest, error);
    }
    errors(frame, 0) = total;
    errors(frame, 1) = std::sqrt(total / solver.seen_count());
    errors(frame, 2) = largest;
  }
  std::vector<Channel> channels;
  for (const model::Coordinate& coordinate : model.coordinates)
    channels.push_back({coordinate.name, coordinate_unit(coordinate, 0)});
  result.q = TimeSeries(markers.time_s, std::move(channels), std::move(q));
  std::vector<Channel> error_channels{{"total_squared_error", Unit::dimensionless},
                                      {"marker_error_RMS", Unit::meter},
                                      {"marker_error_max", Unit::meter}};
  for (const Pair& pair : solver.pairs())
    error_channels.push_back({model.markers[pair.model].name, Unit::meter});
  result.errors = TimeSeries(markers.time_s, std::move(error_channels), std::move(errors));
  for (std::size_t k = 0; k < undetermined.size(); ++k) {
    if (undetermined[k])
      result.undetermined.push_back(
          model.coordinates[static_cast<std::size_t>(solver.free()[k])].name);
  }
  return result;
}

}  // namespace myoid::kinematics
