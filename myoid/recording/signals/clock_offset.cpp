#include "myoid/recording/signals/clock_offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/recording/signals/resample.h"

namespace myoid::recording {
namespace {

constexpr double kRate_hz = 50.0;
constexpr double kMotionBelow_hz = 4.0;
constexpr double kUnique = 0.98;
constexpr double kLeastLength_s = 3.0;
constexpr double kLeastCorrelation = 0.6;
constexpr double kMostSd_s = 0.1;
constexpr int kBlocks = 8;
constexpr Eigen::Index kMostEmg = 4;  ///< Principal components of the envelopes.
/// Principal components of the motion, each with its acceleration.
constexpr Eigen::Index kMostMotion = 2;
constexpr int kMostRows = 1 + kMostEmg + 2 * kMostMotion;
/// In slower movements posture correlates with EMG at any delay.
constexpr double kLeastSpeed_hz = 0.5;
constexpr double kLeastMotion = 0.03;  ///< Standard deviation [rad or m]; less is no movement.

/// Returns the first `most` principal components of the columns. `standardized`: every column has the same weight.
Eigen::MatrixXd principal(Eigen::MatrixXd x, Eigen::Index most, bool standardized) {
  x = (x.rowwise() - x.colwise().mean()).eval();
  if (standardized) {
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      const double size = x.col(c).norm();
      if (size > 0.0) x.col(c) /= size;
    }
  }
  const math::SymmetricEigen axes = math::symmetric_eigen(x.transpose() * x);
  const Eigen::Index count = std::min(most, x.cols());
  const double largest = std::max(axes.values[x.cols() - 1], 0.0);
  Eigen::MatrixXd result(x.rows(), 0);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(axes.values[x.cols() - 1 - k] > 1e-6 * largest)) break;
    result.conservativeResize(Eigen::NoChange, k + 1);
    result.col(k) = x * axes.vectors.col(x.cols() - 1 - k);
    result.col(k) /= result.col(k).norm();
  }
  return result;
}

/// Returns position and acceleration of the motion's largest components.
Eigen::MatrixXd demand(const Eigen::MatrixXd& motion) {
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 2, kMotionBelow_hz, kRate_hz);
  const Eigen::MatrixXd position = principal(motion, kMostMotion, false);
  Eigen::MatrixXd result(motion.rows(), 2 * position.cols());
  for (Eigen::Index c = 0; c < position.cols(); ++c) {
    const Eigen::VectorXd q = math::zero_phase(sections, position.col(c));
    const Eigen::Index n = q.size();
    Eigen::VectorXd second = Eigen::VectorXd::Zero(n);
    second.segment(1, n - 2) = q.tail(n - 2) - 2.0 * q.segment(1, n - 2) + q.head(n - 2);
    result.col(2 * c) = q;
    result.col(2 * c + 1) = second / std::max(second.norm(), 1e-300);
  }
  return result;
}

/// Returns the frequency [Hz] of a sine with the movement's ratio of velocity to position; empty
/// for a movement so small or slow that inertia does not show.
std::optional<double> quickness_hz(const Eigen::MatrixXd& motion) {
  const Eigen::MatrixXd centered = motion.rowwise() - motion.colwise().mean();
  const auto n = static_cast<double>(motion.rows());
  if (std::sqrt(centered.squaredNorm() / n) < kLeastMotion) return std::nullopt;
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 2, kMotionBelow_hz, kRate_hz);
  const Eigen::MatrixXd position = principal(motion, 1, false);
  if (position.cols() == 0) return std::nullopt;
  const Eigen::VectorXd q = math::zero_phase(sections, position.col(0));
  const double rate = (q.tail(q.size() - 1) - q.head(q.size() - 1)).norm() * kRate_hz;
  const double frequency_hz = rate / (2.0 * kPi * q.norm());
  return frequency_hz >= kLeastSpeed_hz ? std::optional(frequency_hz) : std::nullopt;
}

/// Sums of products of [1, x(t - d), y(t)] over one block.
using Moments = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;

/// Returns the sums by lag -reach..reach and by block of the `usable` samples after the first `reach`.
std::vector<std::vector<Moments>> moments_by_lag(const Eigen::MatrixXd& x,
                                                 const Eigen::MatrixXd& y,
                                                 Eigen::Index reach,
                                                 Eigen::Index usable) {
  const Eigen::Index nx = 1 + x.cols(), ny = y.cols();
  const auto first_of = [&](int block) { return reach + block * usable / kBlocks; };
  // Running sums of [1, x]: a sum over any block is the difference of two of them.
  Eigen::MatrixXd running = Eigen::MatrixXd::Zero(nx * nx, x.rows() + 1);
  Eigen::VectorXd row(nx);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    row << 1.0, x.row(i).transpose();
    running.col(i + 1) = running.col(i) + (row * row.transpose()).reshaped();
  }
  std::vector<Moments> of_y;  // independent of the lag
  for (int k = 0; k < kBlocks; ++k) {
    const auto rows = y.middleRows(first_of(k), first_of(k + 1) - first_of(k));
    Moments& m = of_y.emplace_back(Moments::Zero(nx + ny, nx + ny));
    m.topRightCorner(1, ny) = rows.colwise().sum();
    m.bottomRightCorner(ny, ny) = rows.transpose() * rows;
  }
  std::vector<std::vector<Moments>> result;
  for (Eigen::Index lag = -reach; lag <= reach; ++lag) {
    std::vector<Moments>& blocks = result.emplace_back(of_y);
    for (int k = 0; k < kBlocks; ++k) {
      const Eigen::Index first = first_of(k), count = first_of(k + 1) - first;
      Moments& m = blocks[static_cast<std::size_t>(k)];
      m.topLeftCorner(nx, nx) = (running.col(first - lag + count) - running.col(first - lag)).reshaped(nx, nx);
      m.block(1, nx, nx - 1, ny) = x.middleRows(first - lag, count).transpose() * y.middleRows(first, count);
      m.bottomLeftCorner(ny, nx) = m.topRightCorner(nx, ny).transpose();
    }
  }
  return result;
}

double canonical_correlation(const Moments& m, Eigen::Index nx) {
  const Eigen::Index ny = m.rows() - 1 - nx;
  const double n = m(0, 0);
  const Moments mean = m.col(0).tail(nx + ny) / n;
  Moments c = m.bottomRightCorner(nx + ny, nx + ny) / n - mean * mean.transpose();
  c.topLeftCorner(nx, nx).diagonal().array() *= 1.0 + 1e-9;
  c.bottomRightCorner(ny, ny).diagonal().array() *= 1.0 + 1e-9;
  const Eigen::LLT<Moments> xx(c.topLeftCorner(nx, nx));
  const Eigen::LLT<Moments> yy(c.bottomRightCorner(ny, ny));
  if (xx.info() != Eigen::Success || yy.info() != Eigen::Success) return 0.0;
  const Moments left = xx.matrixL().solve(c.topRightCorner(nx, ny));
  const Moments both = yy.matrixL().solve(left.transpose());
  const double squared = math::symmetric_eigenvalues(both * both.transpose())[ny - 1];
  return std::sqrt(std::max(0.0, squared));
}

struct Peak {
  double lead_s = 0.0;
  double correlation = 0.0;
  bool inside = false;
  double elsewhere = 0.0;  ///< The largest other maximum, at least 0.25 s away.
};

/// Finds the largest correlation over the lags; a parabola through three lags gives its place.
Peak peak_of(const std::vector<Moments>& by_lag, Eigen::Index nx, double reach_s) {
  std::vector<double> values;
  for (const Moments& m : by_lag) values.push_back(canonical_correlation(m, nx));
  const auto at = std::max_element(values.begin(), values.end()) - values.begin();
  Peak peak;
  peak.correlation = values[static_cast<std::size_t>(at)];
  peak.lead_s = static_cast<double>(at) / kRate_hz - reach_s;
  peak.inside = at > 0 && at + 1 < static_cast<std::ptrdiff_t>(values.size());
  if (peak.inside) {
    const double before = values[static_cast<std::size_t>(at) - 1];
    const double after = values[static_cast<std::size_t>(at) + 1];
    const double curvature = before - 2.0 * peak.correlation + after;
    if (curvature < 0.0) peak.lead_s += 0.5 * (before - after) / curvature / kRate_hz;
  }
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    if (values[k] < values[k - 1] || values[k] < values[k + 1]) continue;
    if (std::abs(static_cast<double>(k) - static_cast<double>(at)) >= 0.25 * kRate_hz)
      peak.elsewhere = std::max(peak.elsewhere, values[k]);
  }
  return peak;
}

Stretch common_time(const TimeSeries& a, const TimeSeries& b) {
  return {std::max(a.time_s()[0], b.time_s()[0]),
          std::min(a.time_s()[a.sample_count() - 1], b.time_s()[b.sample_count() - 1])};
}

TimeSeries third(const TimeSeries& series, int which, double begin_s, double end_s) {
  const double length_s = (end_s - begin_s) / 3.0;
  return series.slice(begin_s + which * length_s, begin_s + (which + 1) * length_s);
}

}  // namespace

std::optional<ClockOffset> estimate_clock_offset(const TimeSeries& envelopes,
                                                 const TimeSeries& motion,
                                                 double reach_s) {
  if (envelopes.sample_count() < 10 || motion.sample_count() < 10) return std::nullopt;
  if (envelopes.channel_count() == 0 || motion.channel_count() == 0) return std::nullopt;
  const auto [begin_s, end_s] = common_time(envelopes, motion);
  if (end_s - begin_s < kLeastLength_s || motion.mean_rate_hz() < 2.5 * kMotionBelow_hz) return std::nullopt;
  const Eigen::VectorXd clock = even_clock(begin_s, end_s, kRate_hz);
  const Eigen::MatrixXd x = principal(resample(envelopes, clock).values(), kMostEmg, true);
  const Eigen::MatrixXd path = resample(motion, clock).values();
  const std::optional<double> frequency_hz = quickness_hz(path);
  if (!frequency_hz) return std::nullopt;
  const Eigen::MatrixXd y = demand(path);
  if (x.cols() == 0 || y.cols() == 0) return std::nullopt;

  const auto reach = static_cast<Eigen::Index>(std::lround(reach_s * kRate_hz));
  const Eigen::Index usable = clock.size() - 2 * reach;
  if (usable < 8 * kBlocks) return std::nullopt;
  const std::vector<std::vector<Moments>> sums = moments_by_lag(x, y, reach, usable);
  std::vector<Moments> whole;
  for (const std::vector<Moments>& blocks : sums) {
    whole.push_back(blocks.front());
    for (std::size_t k = 1; k < blocks.size(); ++k) whole.back() += blocks[k];
  }
  const Peak peak = peak_of(whole, x.cols(), reach_s);
  if (!peak.inside || peak.correlation < kLeastCorrelation) return std::nullopt;
  // A periodic movement such as gait fits at several lags.
  if (peak.elsewhere > kUnique * peak.correlation) return std::nullopt;
  std::array<double, kBlocks> leads{};
  double mean = 0.0;
  for (std::size_t k = 0; k < leads.size(); ++k) {
    std::vector<Moments> without = whole;
    for (std::size_t lag = 0; lag < without.size(); ++lag) without[lag] -= sums[lag][k];
    leads[k] = peak_of(without, x.cols(), reach_s).lead_s;
    mean += leads[k] / kBlocks;
  }
  double squares = 0.0;
  for (const double lead : leads) squares += (lead - mean) * (lead - mean);
  // The variance is the jackknife's; the grid resolves at best a tenth of its step.
  const double scatter_s = std::max(std::sqrt(squares * (kBlocks - 1) / kBlocks), 0.1 / kRate_hz);
  if (scatter_s > kMostSd_s) return std::nullopt;
  const double phase_s = 0.25 / *frequency_hz;
  return ClockOffset{.lead_s = peak.lead_s,
                     .scatter_s = scatter_s,
                     .phase_s = phase_s,
                     .sd_s = std::hypot(scatter_s, phase_s),
                     .correlation = peak.correlation};
}

std::vector<Remark> check_clock_offset(const TimeSeries& envelopes, const TimeSeries& motion) {
  std::vector<Remark> faults;
  const std::optional<ClockOffset> offset = estimate_clock_offset(envelopes, motion);
  if (!offset) return faults;
  const auto [begin_s, end_s] = common_time(envelopes, motion);
  const double unsure_s = offset->phase_s + 2.0 * offset->scatter_s;
  const bool grave = offset->lead_s - unsure_s > kLimits.clocks.latest_offset_s ||
                     offset->lead_s + unsure_s < kLimits.clocks.earliest_offset_s;
  // An offset as uncertain as the expected range says nothing.
  const bool tells = 2.0 * offset->sd_s < kLimits.clocks.latest_offset_s - kLimits.clocks.earliest_offset_s;
  if (grave || tells)
    faults.push_back({.code = RemarkCode::clock_offset,
                      .severity = grave ? Severity::warning : Severity::note,
                      .about = "EMG and motion",
                      .when = Stretch{begin_s, end_s},
                      .value = offset->lead_s,
                      .says = fmt::format("the EMG is {:.0f} ± {:.0f} ms {} the motion that it drives",
                                          1000.0 * std::abs(offset->lead_s), 1000.0 * offset->sd_s,
                                          offset->lead_s < 0.0 ? "behind" : "ahead of"),
                      .remedy = grave ? fmt::format("expected {:.0f} to {:.0f} ms ahead: were the two recordings "
                                                    "started together? Shift the clock of one of them",
                                                    1000.0 * kLimits.clocks.earliest_offset_s,
                                                    1000.0 * kLimits.clocks.latest_offset_s)
                                      : ""});
  constexpr double kLongEnough_s = 30.0;
  if (end_s - begin_s < kLongEnough_s) return faults;
  const auto first = estimate_clock_offset(third(envelopes, 0, begin_s, end_s), third(motion, 0, begin_s, end_s));
  const auto last = estimate_clock_offset(third(envelopes, 2, begin_s, end_s), third(motion, 2, begin_s, end_s));
  if (!first || !last) return faults;
  const double drift_s = last->lead_s - first->lead_s;
  const double sd_s = std::hypot(first->scatter_s, last->scatter_s);
  if (std::abs(drift_s) < kLimits.clocks.drift_s || std::abs(drift_s) < 3.0 * sd_s) return faults;
  faults.push_back({.code = RemarkCode::clock_drift,
                    .severity = Severity::warning,
                    .about = "EMG and motion",
                    .when = Stretch{begin_s, end_s},
                    .value = drift_s,
                    .says = fmt::format(
                        "the EMG's lead over the motion changes by {:.0f} ± {:.0f} ms from the first third to the last",
                        1000.0 * drift_s, 1000.0 * sd_s),
                    .remedy = "do the two clocks run at the same rate? Check the rates that the files state, or cut "
                              "the trial into shorter ones"});
  return faults;
}

std::optional<Remark> check_clock_evenness(const Eigen::Ref<const Eigen::VectorXd>& time_s, const std::string& what) {
  const Eigen::Index n = time_s.size();
  if (n < 10) return std::nullopt;
  const Eigen::VectorXd intervals = time_s.tail(n - 1) - time_s.head(n - 1);
  const double mean = intervals.mean();
  const double sd = std::sqrt((intervals.array() - mean).square().mean());
  if (sd <= kLimits.clocks.uneven_share * mean) return std::nullopt;
  return Remark{.code = RemarkCode::clock_uneven,
                .severity = Severity::note,
                .about = what,
                .when = Stretch{time_s[0], time_s[n - 1]},
                .value = sd / mean,
                .says = fmt::format("{}: the samples are not even, intervals of {:.3g} ± {:.2g} ms", what,
                                    1000.0 * mean, 1000.0 * sd),
                .remedy = "they are put on an even clock by interpolation"};
}

}  // namespace myoid::recording
