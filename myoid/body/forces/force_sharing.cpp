#include "myoid/body/forces/force_sharing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/body/forces/optimality.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {
namespace {

void check(const SharingProblem& problem) {
  const Eigen::Index n = problem.optimal_force.size();
  const Eigen::Index m = problem.torque.size();
  const auto optional_size = [n](const Eigen::VectorXd& v) { return v.size() == 0 || v.size() == n; };
  if (problem.moment_arm.rows() != m || problem.moment_arm.cols() != n || problem.lower.size() != n ||
      problem.upper.size() != n || problem.reserve.size() != m || !optional_size(problem.weight) ||
      !optional_size(problem.emg)) {
    throw InvalidInput(fmt::format("force sharing: sizes disagree for {} muscles and {} coordinates", n, m));
  }
  if (!(problem.exponent > 1.0))
    throw InvalidInput(fmt::format("force sharing: exponent {}, expected above 1", problem.exponent));
  if (!(problem.reserve.array() > 0.0).all())
    throw InvalidInput("force sharing: every coordinate needs a reserve above 0");
  if (problem.emg.size() > 0 && problem.exponent != 2.0)
    throw InvalidInput("force sharing: an EMG term needs exponent 2");
}

/// x(lambda) of one muscle and its slope: the optimum for given multipliers.
struct Response {
  double x = 0.0;
  double slope = 0.0;  ///< dx / d(pull)
};

Response respond(double pull, double w, double p, double lower, double upper, double emg_weight, double emg) {
  Response r;
  if (emg_weight > 0.0) {
    r.slope = 1.0 / (2.0 * (w + emg_weight));
    r.x = (pull + 2.0 * emg_weight * emg) * r.slope;
  } else if (p == 2.0) {
    r.slope = 1.0 / (2.0 * w);
    r.x = pull * r.slope;
  } else {
    const double size = std::pow(std::abs(pull) / (p * w), 1.0 / (p - 1.0));
    r.x = std::copysign(size, pull);
    // For p > 2 the slope is unbounded near 0. The limit only shortens steps.
    r.slope = std::min(size / ((p - 1.0) * std::max(std::abs(pull), 1e-300)), 1e6);
  }
  if (r.x <= lower) return {lower, 0.0};
  if (r.x >= upper) return {upper, 0.0};
  return r;
}

}  // namespace

std::string_view name(SharingStatus status) {
  switch (status) {
    case SharingStatus::optimal:
      return "optimal";
    case SharingStatus::reserve_used:
      return "reserve_used";
    case SharingStatus::not_solved:
      return "not_solved";
    case SharingStatus::not_finite:
      return "not_finite";
  }
  return "?";
}

SharingSolution solve_sharing(const SharingProblem& problem) {
  check(problem);
  const Eigen::Index n = problem.optimal_force.size();
  const Eigen::Index m = problem.torque.size();
  SharingSolution solution;
  solution.activation = problem.lower;
  solution.reserve_torque = Eigen::VectorXd::Zero(m);
  solution.multiplier = Eigen::VectorXd::Zero(m);
  if (!problem.moment_arm.allFinite() || !problem.optimal_force.allFinite() || !problem.torque.allFinite()) {
    solution.status = SharingStatus::not_finite;
    return solution;
  }
  const Eigen::MatrixXd a = problem.moment_arm * problem.optimal_force.asDiagonal();
  const double p = problem.exponent;
  const double infinity = std::numeric_limits<double>::infinity();
  struct Point {
    Eigen::VectorXd x, y, slope_x, slope_y, gap;
    double dual = 0.0;
  };
  const auto evaluate = [&](const Eigen::VectorXd& lambda) {
    Point point{Eigen::VectorXd(n), Eigen::VectorXd(m), Eigen::VectorXd(n),
                Eigen::VectorXd(m), problem.torque,     lambda.dot(problem.torque)};
    const Eigen::VectorXd pull = a.transpose() * lambda;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double w = problem.weight.size() > 0 ? problem.weight[i] : 1.0;
      const double e = problem.emg.size() > 0 ? problem.emg[i] : 0.0;
      const double big_w = problem.emg.size() > 0 ? problem.emg_weight : 0.0;
      const Response r = respond(pull[i], w, p, problem.lower[i], problem.upper[i], big_w, e);
      point.x[i] = r.x;
      point.slope_x[i] = r.slope;
      point.dual += w * std::pow(std::abs(r.x), p) + big_w * (r.x - e) * (r.x - e) - pull[i] * r.x;
    }
    for (Eigen::Index k = 0; k < m; ++k) {
      const double reserve_pull = lambda[k] * problem.reserve[k];
      const Response r = respond(reserve_pull, 1.0, p, -infinity, infinity, 0.0, 0.0);
      point.y[k] = r.x;
      point.slope_y[k] = r.slope;
      point.dual += std::pow(std::abs(r.x), p) - reserve_pull * r.x;
    }
    point.gap -= a * point.x + problem.reserve.cwiseProduct(point.y);
    return point;
  };
  // A first guess away from 0, where the response for p > 2 has no finite slope.
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(m);
  if (p != 2.0) {
    for (Eigen::Index k = 0; k < m; ++k) {
      const double strength = a.row(k).cwiseAbs().sum() + problem.reserve[k];
      const double level = std::min(1.0, std::abs(problem.torque[k]) / strength) + 1e-6;
      lambda[k] =
          std::copysign(p * std::pow(level, p - 1.0) / std::max(a.row(k).cwiseAbs().maxCoeff(), problem.reserve[k]),
                        problem.torque[k]);
    }
  }
  Point now = evaluate(lambda);
  const double scale =
      std::max({problem.torque.cwiseAbs().maxCoeff(), a.size() > 0 ? a.cwiseAbs().maxCoeff() * 1e-3 : 0.0, 1e-9});
  for (solution.iterations = 0; solution.iterations < 300; ++solution.iterations) {
    if (now.gap.cwiseAbs().maxCoeff() <= 1e-14 * scale) break;
    Eigen::MatrixXd hessian = a * now.slope_x.asDiagonal() * a.transpose();
    hessian.diagonal() += problem.reserve.cwiseAbs2().cwiseProduct(now.slope_y);
    const Eigen::VectorXd step = hessian.ldlt().solve(now.gap);
    const double rise = now.gap.dot(step);
    bool moved = false;
    for (double share = 1.0; share > 1e-12; share *= 0.5) {
      Point next = evaluate(lambda + share * step);
      const bool better = next.dual >= now.dual + 1e-4 * share * rise ||
                          (next.gap.cwiseAbs().maxCoeff() < now.gap.cwiseAbs().maxCoeff() &&
                           next.dual >= now.dual - 1e-12 * std::abs(now.dual));
      if (better) {
        lambda += share * step;
        now = std::move(next);
        moved = true;
        break;
      }
    }
    if (!moved) break;
  }
  solution.activation = now.x;
  solution.reserve_torque = problem.reserve.cwiseProduct(now.y);
  solution.multiplier = lambda;
  solution.kkt_residual = kkt_residual(problem, solution);
  solution.status = solution.kkt_residual <= 1e-9 ? SharingStatus::optimal : SharingStatus::not_solved;
  return solution;
}

SharingSolution solve_sharing(const SharingProblem& problem,
                              const std::function<ForceAtActivation(Eigen::Index muscle, double activation)>& law,
                              const Eigen::VectorXd& start) {
  constexpr int kMostTangents = 100;
  const Eigen::Index n = problem.optimal_force.size();
  Eigen::VectorXd x = start;
  const auto tangent_at = [&](const Eigen::VectorXd& activation) {
    SharingProblem tangent = problem;
    Eigen::VectorXd rest(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const ForceAtActivation f = law(i, activation[i]);
      tangent.optimal_force[i] = f.slope_n;
      rest[i] = f.force_n - f.slope_n * activation[i];
    }
    tangent.torque -= problem.moment_arm * rest;
    return tangent;
  };
  SharingProblem tangent = tangent_at(x);
  SharingSolution solution;
  double moved = 0.0;
  int count = 0;
  do {
    solution = solve_sharing(tangent);
    if (solution.status == SharingStatus::not_finite) return solution;
    moved = (solution.activation - x).cwiseAbs().maxCoeff();
    // Full steps converge where the laws bend little; half steps also where full steps oscillate.
    x = count < 10 || moved <= 1e-11 ? solution.activation : (0.5 * (x + solution.activation)).eval();
    tangent = tangent_at(x);
  } while (moved > 1e-11 && ++count < kMostTangents);
  solution.iterations = count + 1;
  solution.kkt_residual = kkt_residual(tangent, solution);
  solution.status = solution.kkt_residual <= 1e-9 ? SharingStatus::optimal : SharingStatus::not_solved;
  return solution;
}

namespace {

/// Throws InvalidInput unless the tables have one clock and the same muscles.
void check_tables(const std::vector<TimeSeries>& moment_arms,
                  const TimeSeries& torques,
                  const Eigen::MatrixXd& optimal_force_n,
                  const Eigen::VectorXd& max_isometric_force_n) {
  const Eigen::Index frames = torques.sample_count();
  if (static_cast<Eigen::Index>(moment_arms.size()) != torques.channel_count() || moment_arms.empty()) {
    throw InvalidInput(
        fmt::format("force sharing: {} moment-arm tables for {} torques", moment_arms.size(), torques.channel_count()));
  }
  const Eigen::Index muscles = moment_arms[0].channel_count();
  for (const TimeSeries& arms : moment_arms) {
    if (arms.sample_count() != frames || arms.channel_count() != muscles) {
      throw InvalidInput("force sharing: moment arms and torques are not on one clock");
    }
  }
  if (optimal_force_n.rows() != frames || optimal_force_n.cols() != muscles ||
      max_isometric_force_n.size() != muscles) {
    throw InvalidInput("force sharing: forces and moment arms disagree in size");
  }
}

/// Returns the EMG of these muscles, frames x muscles; empty without an EMG term.
Eigen::MatrixXd emg_of(const std::vector<Channel>& muscles, Eigen::Index frames, const SharingOptions& options) {
  if (options.emg.empty() || !(options.emg_weight > 0.0)) return {};
  std::vector<std::string> names;
  for (const Channel& channel : muscles) names.push_back(channel.name);
  Eigen::MatrixXd emg = options.emg.select(names).values();
  if (emg.rows() != frames)
    throw InvalidInput("force sharing: the EMG is not on the clock of the motion; resample it first");
  return emg;
}

/// Returns the weights of the objectives `force` and `stress`: (F_i)^p or (F_i / F_max)^p instead
/// of (F_i / F_opt)^p, divided by their mean so that reserves keep their weight.
Eigen::VectorXd sharing_weights(const Eigen::VectorXd& optimal_force_n,
                                const Eigen::VectorXd& max_isometric_force_n,
                                const SharingOptions& options) {
  const Eigen::VectorXd weight = options.objective == SharingObjective::force
                                     ? optimal_force_n
                                     : optimal_force_n.cwiseQuotient(max_isometric_force_n).eval();
  const double mean = std::max(weight.mean(), 1e-12);
  return (weight / mean).cwiseMax(1e-6).array().pow(options.exponent);
}

std::vector<Channel> reserve_channels(const TimeSeries& torques) {
  std::vector<Channel> channels = torques.channels();
  for (Channel& channel : channels) {
    for (const std::string_view suffix : {"_moment", "_force"}) {
      if (channel.name.ends_with(suffix)) channel.name.erase(channel.name.size() - suffix.size());
    }
    channel.name += "_reserve";
  }
  return channels;
}

}  // namespace

MuscleForces share(const std::vector<TimeSeries>& moment_arms,
                   const TimeSeries& torques,
                   const Eigen::MatrixXd& optimal_force_n,
                   const Eigen::VectorXd& max_isometric_force_n,
                   const SharingOptions& options) {
  const Eigen::Index frames = torques.sample_count();
  const Eigen::Index coordinates = torques.channel_count();
  check_tables(moment_arms, torques, optimal_force_n, max_isometric_force_n);
  const Eigen::Index muscles = moment_arms[0].channel_count();
  const Eigen::MatrixXd emg = emg_of(moment_arms[0].channels(), frames, options);
  Eigen::MatrixXd activation(frames, muscles);
  Eigen::MatrixXd force(frames, muscles);
  Eigen::MatrixXd reserve(frames, coordinates);
  MuscleForces result;
  result.status.resize(static_cast<std::size_t>(frames));
  result.kkt_residual.resize(frames);
  parallel_ranges<Eigen::Index>(frames, 128, [&](const auto& range) {
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
      SharingProblem problem;
      problem.moment_arm.resize(coordinates, muscles);
      for (Eigen::Index k = 0; k < coordinates; ++k)
        problem.moment_arm.row(k) = moment_arms[static_cast<std::size_t>(k)].values().row(frame);
      problem.optimal_force = optimal_force_n.row(frame).transpose();
      problem.torque = torques.values().row(frame).transpose();
      problem.lower = Eigen::VectorXd::Constant(muscles, options.min_activation);
      problem.upper = Eigen::VectorXd::Ones(muscles);
      problem.reserve = Eigen::VectorXd::Constant(coordinates, options.reserve_nm);
      problem.exponent = options.exponent;
      if (options.objective != SharingObjective::activation)
        problem.weight = sharing_weights(problem.optimal_force, max_isometric_force_n, options);
      if (emg.size() > 0) {
        problem.emg = emg.row(frame).transpose();
        problem.emg_weight = options.emg_weight;
      }
      SharingSolution solution = solve_sharing(problem);
      if (options.law) {
        const auto law = [&](Eigen::Index muscle, double x) { return options.law(frame, muscle, x); };
        solution = solve_sharing(problem, law, solution.activation);
        for (Eigen::Index i = 0; i < muscles; ++i) force(frame, i) = law(i, solution.activation[i]).force_n;
      } else {
        force.row(frame) = solution.activation.cwiseProduct(problem.optimal_force).transpose();
      }
      activation.row(frame) = solution.activation.transpose();
      reserve.row(frame) = solution.reserve_torque.transpose();
      result.status[static_cast<std::size_t>(frame)] = solution.status;
      result.kkt_residual[frame] = solution.kkt_residual;
    }
  });
  const Eigen::RowVectorXd greatest = torques.values().cwiseAbs().colwise().maxCoeff();
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    SharingStatus& status = result.status[static_cast<std::size_t>(frame)];
    if (status == SharingStatus::optimal &&
        (reserve.row(frame).array().abs() > 0.05 * greatest.array().max(1e-9)).any()) {
      status = SharingStatus::reserve_used;
    }
    if (status == SharingStatus::reserve_used) ++result.frames_with_reserve;
    if (status == SharingStatus::not_solved || status == SharingStatus::not_finite) ++result.frames_not_solved;
  }
  const auto channels = [&](Unit unit) {
    std::vector<Channel> list = moment_arms[0].channels();
    for (Channel& channel : list) channel.unit = unit;
    return list;
  };
  result.force = TimeSeries(torques.time_s(), channels(Unit::newton), std::move(force));
  result.activation = TimeSeries(torques.time_s(), channels(Unit::dimensionless), std::move(activation));
  result.reserve = TimeSeries(torques.time_s(), reserve_channels(torques), std::move(reserve));
  return result;
}

}  // namespace myoid::body
