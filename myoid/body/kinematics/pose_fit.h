#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/ik_options.h"
#include "myoid/body/kinematics/range_barrier.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::body {

/// The least-squares problem of one frame of inverse kinematics, set up once per model and solved
/// frame after frame without much allocation. The unknowns are the free coordinates, which are not
/// locked, not prescribed and not dependent in a coupler.
class PoseFit {
 public:
  /// One marker that both the model and the file have.
  struct Pair {
    std::size_t model = 0;
    Eigen::Index file = 0;
    double weight = 1.0;
  };
  struct Pose {
    Eigen::VectorXd q;
    double cost = 0.0;  ///< 2 J, with the barrier if one acts.
    bool converged = false;
  };

  /// Prepares the problem. Model and options must outlive the object.
  PoseFit(const body::BodyModel& model, const IkOptions& options, std::vector<Pair> pairs);

  void set_targets(const MarkerSeries& markers, Eigen::Index frame);
  /// Returns one over the sum of the weights of the markers seen, by which J is scaled.
  [[nodiscard]] double scale() const { return targets_.scale; }
  /// Sets another scale until the next set_targets: that of a whole of which this model is a part.
  void set_scale(double scale) { targets_.scale = scale; }
  /// Returns where a marker was seen in the frame; nothing if it was not.
  [[nodiscard]] std::optional<Vec3> target(std::size_t pair) const {
    return targets_.seen[pair] ? std::optional(targets_.place_m[pair]) : std::nullopt;
  }
  [[nodiscard]] int seen_count() const { return targets_.count; }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] const std::vector<Eigen::Index>& free() const { return free_; }

  /// A search under way.
  struct Search {
    Pose pose;
    double damping = 0.0;
  };

  /// Returns the nearest minimum of J. The start first meets locks, ranges and constraints.
  [[nodiscard]] Pose solve(Eigen::VectorXd start);
  /// Begins a search for the nearest minimum at a start, which first meets locks, ranges and constraints.
  [[nodiscard]] Search begin(Eigen::VectorXd start);
  /// Makes up to so many iterations, fewer if the search converges.
  void advance(Search& search, int iterations);
  /// Returns the minimum of J plus a barrier at the ends of the ranges (range_barrier.h), found
  /// through the minima with stronger barriers, whose path stays near the middle of the ranges.
  [[nodiscard]] Pose solve_inside(Eigen::VectorXd start, double barrier);

  /// Brings coordinates outside their range back into it, or nearer, by whole turns that leave pose and cost unchanged.
  void unwind(Pose& pose);
  /// Brings coordinates nearer to those of a neighboring posture by such turns.
  void unwind_towards(const Eigen::VectorXd& neighbor, Pose& pose);

  /// Sets the posture for the functions below; returns 2 J there.
  double place(const Eigen::VectorXd& q);
  /// The same with q brought to locks, ranges and constraints.
  double place_within(Eigen::VectorXd q);
  /// Returns the part of 2 J of some markers.
  [[nodiscard]] double part_of(const std::vector<std::size_t>& pairs) const;
  /// Returns the mean square distance of some markers from their targets, over those seen; 0 if none is.
  [[nodiscard]] double mean_square(const std::vector<std::size_t>& pairs) const;
  [[nodiscard]] const body::BodyState& state() const { return state_; }
  /// The model has changed: the next posture is computed even if its coordinates are equal.
  void forget_posture() { posed_ = false; }
  /// Returns the work so far: postures evaluated, times bodies and coordinates of the model.
  [[nodiscard]] double work() const;
  /// Marks the free coordinates with a part in directions that markers and tasks leave open.
  void collect_undetermined(std::vector<bool>& undetermined);
  /// Returns the first-order second derivatives of J by some coordinates, at the posture of the latest step if q lies
  /// near it, else at q. Coordinates that are not free have the unit matrix.
  [[nodiscard]] Eigen::MatrixXd curvature(const Eigen::VectorXd& q, const std::vector<Eigen::Index>& coordinates);
  /// Returns the distance of a marker from its target; NaN for a marker that was not seen.
  [[nodiscard]] double error(std::size_t pair) const;
  /// Writes the places of the model's markers into a row of a table, x y z of each.
  void locate(Eigen::MatrixXd& table, Eigen::Index row) const;

 private:
  /// The coordinates that move a body, ground first, translations of a joint before its rotations.
  struct Chain {
    std::vector<int> coordinates;
    std::vector<std::size_t> body_of;  ///< Child body of each one's joint.
  };

  /// Per rate of a free coordinate: turn, and velocity of the point at the origin of ground.
  struct Motion {
    Vec3 w = Vec3::Zero(), v = Vec3::Zero();
  };

  /// Sums over the markers of a body and of the bodies that it carries: weights times 1, p and p
  /// p', the pulls f = weight (p - target), and p f', about the origin of ground.
  struct Pull {
    double weight = 0.0;
    Vec3 first = Vec3::Zero(), force = Vec3::Zero();
    Mat3 second = Mat3::Zero(), lever = Mat3::Zero();
    Pull& operator+=(const Pull& other);
  };

  /// The markers of one frame.
  struct Targets {
    Eigen::Index frame = 0;
    double time_s = 0.0;
    double scale = 0.0;         ///< One over the sum of the weights of the markers seen.
    int count = 0;              ///< Number of the markers seen.
    std::vector<bool> seen;     ///< Per pair.
    std::vector<Vec3> place_m;  ///< Per pair.
  };

  /// Derivatives of J by the free coordinates.
  struct Slopes {
    Eigen::VectorXd stepped;  ///< Posture of the latest step in this frame; empty before the first.
    Eigen::MatrixXd hessian;  ///< Of the latest step, then its factor.
    Eigen::VectorXd gradient;
    Eigen::MatrixXd gauss;  ///< First-order part of the second derivatives.
    Eigen::MatrixXd bend;   ///< Remaining second derivatives, from the turning of the chains.
  };

  void obey(Eigen::VectorXd& q) const;
  double cost_at(const Eigen::VectorXd& q);
  void update_motions();
  void gather_pulls();
  void add_coordinate(const Chain& chain, std::size_t b, const Pull& pull);
  void linearize(const Eigen::VectorXd& q);
  [[nodiscard]] std::vector<bool> held_at_ends(const Eigen::VectorXd& q) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> damped_step(const Eigen::VectorXd& q,
                                                           const std::vector<bool>& held,
                                                           const Eigen::MatrixXd& N,
                                                           bool second_order,
                                                           double shift);
  void descend(Search& search);
  void update_gains(const Eigen::VectorXd& q);
  [[nodiscard]] std::optional<Eigen::VectorXd> turned_whole(const Pose& pose, std::size_t k, double turns);
  [[nodiscard]] Eigen::VectorXd moved(const Eigen::VectorXd& q, const Eigen::VectorXd& step) const;
  [[nodiscard]] double farthest_turn(const Eigen::VectorXd& step) const;
  [[nodiscard]] Eigen::MatrixXd allowed_directions(const Eigen::VectorXd& q) const;
  [[nodiscard]] double target_of(std::size_t task) const;

  const body::BodyModel& model_;
  const IkOptions& options_;
  std::vector<Pair> pairs_;
  std::vector<Eigen::Index> free_;
  RangeBarrier barrier_;
  std::vector<int> reduced_;  ///< Per coordinate: the free coordinate that moves it, or -1.
  Eigen::VectorXd gain_;      ///< Per coordinate: its rate per rate of that free coordinate.
  std::vector<int> coupler_of_;
  std::vector<Chain> chains_;  ///< Per body.
  std::vector<int> task_index_;
  body::BodyState state_;
  Targets targets_;
  bool posed_ = false;  ///< The bodies of state_ stand as its coordinates say.
  double evaluations_ = 0.0;
  std::vector<Vec3> place_;      ///< Per pair: the marker's place in the posture of state_.
  std::vector<Motion> motions_;  ///< Per coordinate.
  Slopes slopes_;
  std::vector<Pull> pulls_;  ///< Per body.
};

}  // namespace myoid::body
