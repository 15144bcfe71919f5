#include "myoid/body/kinematics/path_surrogate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/multi_polynomial.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/sobol.h"

namespace myoid::body {
namespace {

void add_exponents(int left, int position, Eigen::RowVectorXi& row, Eigen::MatrixXi& all, Eigen::Index& count) {
  if (position + 1 == row.size()) {
    row[position] = left;
    all.row(count++) = row;
    return;
  }
  for (int e = left; e >= 0; --e) {
    row[position] = e;
    add_exponents(left - e, position + 1, row, all, count);
  }
}

void prepare(int dimensions, int degree, SurrogateWorkspace& w) {
  if (w.degree == degree && w.dimensions == dimensions) return;
  w.exponents = exponents(dimensions, degree);
  w.value.resize(degree + 1, dimensions);
  w.slope.resize(degree + 1, dimensions);
  w.nested.resize(static_cast<std::size_t>(w.exponents.rows()));
  std::iota(w.nested.begin(), w.nested.end(), Eigen::Index{0});
  std::sort(w.nested.begin(), w.nested.end(), [&](Eigen::Index a, Eigen::Index b) {
    const auto row_a = w.exponents.row(a), row_b = w.exponents.row(b);
    return std::lexicographical_compare(row_a.begin(), row_a.end(), row_b.begin(), row_b.end());
  });
  w.sums.resize(dimensions + 1, std::max(dimensions, 1));
  w.degree = degree;
  w.dimensions = dimensions;
}

/// Computes T_0 .. T_degree of every coordinate and their derivatives by q.
void fill_tables(const PathSurrogate& s, const Eigen::Ref<const Eigen::VectorXd>& q, SurrogateWorkspace& w) {
  for (Eigen::Index i = 0; i < w.value.cols(); ++i) {
    const double width = s.upper[i] - s.lower[i];
    const double x = (2.0 * q[s.coordinates[at(i)]] - s.lower[i] - s.upper[i]) / width;
    w.value(0, i) = 1.0;
    w.slope(0, i) = 0.0;
    if (s.degree == 0) continue;
    w.value(1, i) = x;
    w.slope(1, i) = 2.0 / width;
    for (Eigen::Index k = 2; k <= s.degree; ++k) {
      w.value(k, i) = 2.0 * x * w.value(k - 1, i) - w.value(k - 2, i);
      w.slope(k, i) = 4.0 / width * w.value(k - 1, i) + 2.0 * x * w.slope(k - 1, i) - w.slope(k - 2, i);
    }
  }
}

/// Sums a part of the polynomial in the coordinates from `level` on: the terms from `term` on,
/// whose exponents of these coordinates sum to `left` at most.
///
///   S_level = sum_e T_e(x_level) S_level+1(left - e)
///
/// This takes one product per term instead of one per term and coordinate. `sum` gets the value and
/// the derivatives by x_level, x_level+1, ... `kBelow` is the number of coordinates after `level`;
/// the compiler then unrolls the usual muscles of up to four coordinates.
template <int kBelow>
void add_up(const PathSurrogate& s,
            const SurrogateWorkspace& w,
            Eigen::Index level,
            int left,
            const Eigen::Index*& term,
            double* sum) {
  const double* const value = w.value.data() + level * w.value.rows();
  const double* const slope = w.slope.data() + level * w.slope.rows();
  std::array<double, kBelow + 2> total{};
  for (int e = 0; e <= left; ++e) {
    if constexpr (kBelow == 0) {
      const double c = s.coefficient_m[*term++];
      total[0] += c * value[e];
      total[1] += c * slope[e];
    } else {
      std::array<double, kBelow + 1> part;
      add_up<kBelow - 1>(s, w, level + 1, left - e, term, part.data());
      total[0] += value[e] * part[0];
      total[1] += slope[e] * part[0];
      for (std::size_t i = 1; i <= kBelow; ++i) total[1 + i] += value[e] * part[i];
    }
  }
  std::copy(total.begin(), total.end(), sum);
}

/// Calls add_up for any number of coordinates.
void add_up_many(
    const PathSurrogate& s, SurrogateWorkspace& w, Eigen::Index level, int left, const Eigen::Index*& term) {
  const Eigen::Index below = w.value.cols() - level - 1;
  double* const sum = w.sums.col(level).data();
  if (below == 3) return add_up<3>(s, w, level, left, term, sum);
  std::fill(sum, sum + below + 2, 0.0);
  for (int e = 0; e <= left; ++e) {
    add_up_many(s, w, level + 1, left - e, term);
    const double* const part = w.sums.col(level + 1).data();
    const double value = w.value(e, level);
    sum[0] += value * part[0];
    sum[1] += w.slope(e, level) * part[0];
    for (Eigen::Index i = 1; i <= below; ++i) sum[1 + i] += value * part[i];
  }
}

/// Computes value and derivatives by all coordinates, in the first column of `sums`.
void add_up_all(const PathSurrogate& s, SurrogateWorkspace& w) {
  const Eigen::Index* term = w.nested.data();
  double* const sum = w.sums.data();
  switch (w.value.cols()) {
    case 1:
      return add_up<0>(s, w, 0, s.degree, term, sum);
    case 2:
      return add_up<1>(s, w, 0, s.degree, term, sum);
    case 3:
      return add_up<2>(s, w, 0, s.degree, term, sum);
    default:
      return add_up_many(s, w, 0, s.degree, term);
  }
}

/// Fills row 0 with every term, row 1 + i with its derivative by coordinate i.
void term_rows(const SurrogateWorkspace& w, Eigen::Ref<Eigen::MatrixXd> rows) {
  const Eigen::Index d = w.value.cols();
  for (Eigen::Index k = 0; k < w.exponents.rows(); ++k) {
    double value = 1.0;
    for (Eigen::Index i = 0; i < d; ++i) value *= w.value(w.exponents(k, i), i);
    rows(0, k) = value;
    for (Eigen::Index i = 0; i < d; ++i) {
      double slope = w.slope(w.exponents(k, i), i);
      for (Eigen::Index j = 0; j < d && slope != 0.0; ++j) {
        if (j != i) slope *= w.value(w.exponents(k, j), j);
      }
      rows(1 + i, k) = slope;
    }
  }
}

/// The true path, with its moment arms by the independent coordinates.
class TruePath {
 public:
  TruePath(const body::BodyModel& model, const body::MusclePath& path)
      : model_(model), path_(path), q_(model.default_q()), state_(body::make_state(model)) {}

  const body::PathResult& at(const PathSurrogate& s, const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < s.coordinates.size(); ++i) q_[s.coordinates[i]] = x[static_cast<Eigen::Index>(i)];
    body::apply_couplers(model_, q_);
    body::compute_poses(model_, q_, state_);
    body::compute_path(model_, path_, state_, workspace_, result_);
    if (!model_.couplers.empty()) {
      // Couplers alone: the loop constraints bind postures, not the path.
      const Eigen::MatrixXd C = coupling(model_, state_);
      result_.moment_arm_m = (C.transpose() * result_.moment_arm_m).eval();
    }
    return result_;
  }

 private:
  /// Returns the rates of all coordinates by every independent one, through the couplers.
  static Eigen::MatrixXd coupling(const body::BodyModel& model, const body::BodyState& state) {
    const auto n = static_cast<Eigen::Index>(model.coordinates.size());
    Eigen::MatrixXd C = Eigen::MatrixXd::Identity(n, n);
    for (const body::CoordinateCoupler& k : model.couplers) C.row(k.dependent).setZero();
    // Chains of couplers: as often as there are couplers.
    for (std::size_t pass = 0; pass < model.couplers.size(); ++pass) {
      for (const body::CoordinateCoupler& k : model.couplers)
        C.row(k.dependent) = body::evaluate(k.function, state.q[k.independent]).first * C.row(k.independent);
    }
    return C;
  }

  const body::BodyModel& model_;
  const body::MusclePath& path_;
  Eigen::VectorXd q_;
  body::BodyState state_;
  body::PathWorkspace workspace_;
  body::PathResult result_;
};

/// Returns postures of the box: rows of numbers in 0..1 scaled to the ranges. Each fifth has one
/// coordinate at an end of its range, where polynomials are worst.
Eigen::MatrixXd scaled(Eigen::MatrixXd unit, const PathSurrogate& s) {
  for (Eigen::Index row = 0; row < unit.rows(); ++row) {
    if (row % 5 == 4) {
      const Eigen::Index which = (row / 5) % (2 * unit.cols());
      unit(row, which / 2) = which % 2 == 0 ? 0.0 : 1.0;
    }
    unit.row(row) = s.lower.transpose() + unit.row(row).cwiseProduct((s.upper - s.lower).transpose());
  }
  return unit;
}

/// Returns length and arms of the true path at every posture: postures x (1 + coordinates).
Eigen::MatrixXd truth_at(TruePath& path, const PathSurrogate& s, const Eigen::MatrixXd& postures) {
  Eigen::MatrixXd truth(postures.rows(), 1 + postures.cols());
  for (Eigen::Index row = 0; row < postures.rows(); ++row) {
    const body::PathResult& result = path.at(s, postures.row(row).transpose());
    truth(row, 0) = result.length_m;
    for (Eigen::Index i = 0; i < postures.cols(); ++i) truth(row, 1 + i) = result.moment_arm_m[s.coordinates[at(i)]];
  }
  return truth;
}

void solve(PathSurrogate& s,
           const Eigen::MatrixXd& postures,
           const Eigen::MatrixXd& truth,
           const Eigen::VectorXd& default_q,
           const SurrogateOptions& options) {
  SurrogateWorkspace w;
  const Eigen::Index d = postures.cols();
  prepare(static_cast<int>(d), s.degree, w);
  const Eigen::Index terms = w.exponents.rows();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
  constexpr Eigen::Index kBlock = 64;
  Eigen::MatrixXd rows(kBlock * (1 + d), terms);
  Eigen::VectorXd wanted(kBlock * (1 + d));
  Eigen::VectorXd q = default_q;
  for (Eigen::Index begin = 0; begin < postures.rows(); begin += kBlock) {
    const Eigen::Index count = std::min(kBlock, postures.rows() - begin);
    for (Eigen::Index k = 0; k < count; ++k) {
      for (Eigen::Index i = 0; i < d; ++i) q[s.coordinates[at(i)]] = postures(begin + k, i);
      fill_tables(s, q, w);
      auto block = rows.middleRows(k * (1 + d), 1 + d);
      term_rows(w, block);
      block.row(0) /= options.length_tolerance_m;
      block.bottomRows(d) /= -options.arm_tolerance_m;
      wanted[k * (1 + d)] = truth(begin + k, 0) / options.length_tolerance_m;
      wanted.segment(k * (1 + d) + 1, d) = truth.row(begin + k).tail(d).transpose() / options.arm_tolerance_m;
    }
    const auto used = rows.topRows(count * (1 + d));
    normal.selfadjointView<Eigen::Lower>().rankUpdate(used.transpose());
    right.noalias() += used.transpose() * wanted.head(count * (1 + d));
  }
  // Chebyshev terms over the box are nearly orthogonal: the normal equations are well conditioned.
  normal.diagonal().array() *= 1.0 + 1e-14;
  s.coefficient_m = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
}

void measure(PathSurrogate& s,
             const Eigen::MatrixXd& postures,
             const Eigen::MatrixXd& truth,
             const Eigen::VectorXd& default_q,
             const SurrogateOptions& options) {
  SurrogateWorkspace w;
  body::PathResult result;
  Eigen::VectorXd q = default_q;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(q.size());
  s.length_error_m = s.length_rms_m = s.arm_error_m = s.arm_rms_m = 0.0;
  for (Eigen::Index row = 0; row < postures.rows(); ++row) {
    for (Eigen::Index i = 0; i < postures.cols(); ++i) q[s.coordinates[at(i)]] = postures(row, i);
    evaluate(s, q, still, w, result);
    const double length = std::abs(result.length_m - truth(row, 0));
    s.length_error_m = std::max(s.length_error_m, length);
    s.length_rms_m += length * length;
    for (Eigen::Index i = 0; i < postures.cols(); ++i) {
      const double arm = std::abs(result.moment_arm_m[s.coordinates[at(i)]] - truth(row, 1 + i));
      s.arm_error_m = std::max(s.arm_error_m, arm);
      s.arm_rms_m += arm * arm;
    }
  }
  s.length_rms_m = std::sqrt(s.length_rms_m / static_cast<double>(postures.rows()));
  s.arm_rms_m =
      std::sqrt(s.arm_rms_m / static_cast<double>(std::max<Eigen::Index>(1, postures.rows() * postures.cols())));
  s.within_tolerance = s.length_error_m <= options.length_tolerance_m && s.arm_error_m <= options.arm_tolerance_m;
}

PathSurrogate fit(const body::BodyModel& model, const body::Muscle& muscle, const SurrogateOptions& options) {
  PathSurrogate s;
  s.muscle = muscle.name;
  const auto append = [](Eigen::VectorXd& list, double value) {
    list.conservativeResize(list.size() + 1);
    list[list.size() - 1] = value;
  };
  const Eigen::VectorXd default_q = model.default_q();
  for (const int c : acting_coordinates(model, muscle.path)) {
    const body::CoordinateRange range = body::usual_range(model.coordinates[at(c)]);
    if (model.is_constrained(c) || !(range.upper > range.lower)) {
      s.held.push_back(c);
      append(s.held_at, default_q[c]);
    } else {
      s.coordinates.push_back(c);
      append(s.lower, range.lower);
      append(s.upper, range.upper);
    }
  }
  TruePath path(model, muscle.path);
  const auto d = static_cast<int>(s.coordinates.size());
  if (d == 0) {
    s.coefficient_m = Eigen::VectorXd::Constant(1, path.at(s, {}).length_m);
    s.within_tolerance = std::isfinite(s.coefficient_m[0]);
    return s;
  }
  math::Random random(options.seed, 77);
  Eigen::MatrixXd unit(400 * d, d);
  for (double& x : unit.reshaped()) x = random.uniform();
  const Eigen::MatrixXd unseen = scaled(std::move(unit), s);
  const Eigen::MatrixXd unseen_truth = truth_at(path, s, unseen);
  PathSurrogate best = s;
  best.coefficient_m = Eigen::VectorXd::Zero(1);
  best.length_error_m = best.arm_error_m = std::numeric_limits<double>::infinity();
  // A path with lengths that are not finite has no polynomial.
  if (!unseen_truth.allFinite()) return best;
  const auto badness = [&](const PathSurrogate& x) {
    return std::max(x.length_error_m / options.length_tolerance_m, x.arm_error_m / options.arm_tolerance_m);
  };
  for (s.degree = 1; s.degree <= options.max_degree; ++s.degree) {
    const double terms = term_count(d, s.degree);
    if (terms > options.max_terms) break;
    options.progress.check();
    const auto count = static_cast<Eigen::Index>(std::max(100.0, 3.0 * terms));
    const Eigen::MatrixXd postures = scaled(math::sobol_points(count, d, {.scramble_seed = options.seed}), s);
    const Eigen::MatrixXd truth = truth_at(path, s, postures);
    if (!truth.allFinite()) break;
    solve(s, postures, truth, default_q, options);
    measure(s, unseen, unseen_truth, default_q, options);
    if (badness(s) < badness(best)) best = s;
    if (s.within_tolerance) break;
  }
  return best;
}

}  // namespace

Eigen::MatrixXi exponents(int coordinates, int degree) {
  if (coordinates == 0) return Eigen::MatrixXi::Zero(1, 0);
  Eigen::MatrixXi all(static_cast<Eigen::Index>(term_count(coordinates, degree)), coordinates);
  Eigen::RowVectorXi row = Eigen::RowVectorXi::Zero(coordinates);
  Eigen::Index count = 0;
  for (int sum = 0; sum <= degree; ++sum) add_exponents(sum, 0, row, all, count);
  return all;
}

std::vector<int> acting_coordinates(const body::BodyModel& model, const body::MusclePath& path) {
  std::set<body::BodyIndex> bodies;
  std::set<int> acting;
  if (path.function) acting.insert(path.function->coordinates.begin(), path.function->coordinates.end());
  for (const body::PathPoint& point : path.points) {
    bodies.insert(point.body);
    if (point.moving) {
      for (const int c : point.moving->coordinates)
        if (c >= 0) acting.insert(c);
    }
    if (point.condition) acting.insert(point.condition->coordinate);
  }
  for (const body::PathWrap& wrap : path.wraps) bodies.insert(model.wrap_objects[at(wrap.wrap_object)].body);
  // Joints above one body but not above another.
  std::vector<std::size_t> times(model.joints.size(), 0);
  for (body::BodyIndex body : bodies) {
    while (body != 0) {
      const auto joint = at(model.joint_of_body[at(body)]);
      ++times[joint];
      body = model.joints[joint].parent;
    }
  }
  for (std::size_t j = 0; j < times.size(); ++j) {
    if (times[j] == 0 || times[j] == bodies.size()) continue;
    acting.insert(model.joints[j].coordinates.begin(), model.joints[j].coordinates.end());
  }
  acting.erase(-1);
  // A dependent coordinate is replaced by the one that it depends on, along chains of couplers.
  for (std::size_t pass = 0; pass < model.couplers.size(); ++pass) {
    for (const body::CoordinateCoupler& k : model.couplers) {
      if (acting.erase(k.dependent) > 0) acting.insert(k.independent);
    }
  }
  return {acting.begin(), acting.end()};
}

std::vector<PathSurrogate> fit_surrogates(const body::BodyModel& model, const SurrogateOptions& options) {
  std::vector<PathSurrogate> all(model.muscles.size());
  std::atomic<std::size_t> done = 0;
  parallel_each(all.size(), [&](std::size_t m) {
    all[m] = fit(model, model.muscles[m], options);
    options.progress.tell(static_cast<double>(++done) / static_cast<double>(all.size()), "path surrogates");
  });
  return all;
}

bool covers(const body::BodyModel& model, const PathSurrogate& surrogate, const Eigen::Ref<const Eigen::VectorXd>& q) {
  for (std::size_t i = 0; i < surrogate.coordinates.size(); ++i) {
    const double value = q[surrogate.coordinates[i]];
    const auto k = static_cast<Eigen::Index>(i);
    if (!(value >= surrogate.lower[k] && value <= surrogate.upper[k])) return false;
  }
  for (std::size_t i = 0; i < surrogate.held.size(); ++i) {
    const double held_at = surrogate.held_at[static_cast<Eigen::Index>(i)];
    if (!(std::abs(q[surrogate.held[i]] - held_at) <= 1e-12)) return false;
  }
  for (const body::CoordinateCoupler& k : model.couplers) {
    if (!(std::abs(q[k.dependent] - body::evaluate(k.function, q[k.independent]).value) <= 1e-6)) return false;
  }
  return true;
}

void evaluate(const PathSurrogate& surrogate,
              const Eigen::Ref<const Eigen::VectorXd>& q,
              const Eigen::Ref<const Eigen::VectorXd>& qdot,
              SurrogateWorkspace& workspace,
              body::PathResult& result) {
  const auto d = static_cast<Eigen::Index>(surrogate.coordinates.size());
  prepare(static_cast<int>(d), surrogate.degree, workspace);
  fill_tables(surrogate, q, workspace);
  result.speed_mps = 0.0;
  result.wrapped = false;
  result.settled = true;
  result.moment_arm_m.setZero(q.size());
  if (d == 0) {
    result.length_m = surrogate.coefficient_m[0];
    return;
  }
  add_up_all(surrogate, workspace);
  result.length_m = workspace.sums(0, 0);
  for (Eigen::Index i = 0; i < d; ++i) {
    const int c = surrogate.coordinates[at(i)];
    const double by_q = workspace.sums(1 + i, 0);
    result.moment_arm_m[c] = -by_q;
    result.speed_mps += by_q * qdot[c];
  }
}

}  // namespace myoid::body
