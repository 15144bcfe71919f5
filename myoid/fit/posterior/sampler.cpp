#include "myoid/fit/posterior/sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/random.h"

namespace myoid::fit {
namespace {

constexpr Eigen::Index kChains = 4;
constexpr int kTuning = 60;         // proposals, twice
constexpr double kOfLaplace = 0.3;  // Laplace's share of the final covariance
constexpr double kTarget = 0.8;     // share of proposals taken
constexpr double kFirstStep = 0.4;  // standard deviations
constexpr int kMostSteps = 20;      // of a proposal

/// A point in the coordinates of Laplace's approximation.
struct Place {
  Eigen::VectorXd u, gradient;
  double log_density = 0.0;
};

/// The step of a chain. It grows after accepted proposals and shrinks after others, by less and
/// less; the final step is the mean over the later half of the proposals.
class Step {
 public:
  [[nodiscard]] double size() const { return std::exp(log_size_); }
  void learn(double accepted) {
    ++count_;
    log_size_ += (accepted - kTarget) / std::sqrt(static_cast<double>(count_));
    log_size_ = std::clamp(log_size_, std::log(0.02), std::log(1.0));
    if (2 * count_ > kTuning) mean_ += 2.0 * log_size_ / kTuning;
  }
  void settle() { log_size_ = mean_; }

 private:
  int count_ = 0;
  double log_size_ = std::log(kFirstStep), mean_ = 0.0;
};

class Chain {
 public:
  Chain(const LogDensity& density, const Mode& mode, math::Random random)
      : density_(density), random_(random), x_(mode.x) {
    // Begins at a draw from the approximation, or nearer to the mode where the density is near 0.
    const Eigen::VectorXd off = mode.covariance.llt().matrixL() * random_.normals(x_.size());
    Eigen::VectorXd gradient;
    for (double share = 1.0; share > 0.05; share *= 0.5) {
      const double there = density_(mode.x + share * off, gradient);
      if (there < mode.log_density - static_cast<double>(off.size()) || std::isnan(there)) continue;
      x_ = mode.x + share * off;
      return;
    }
  }

  /// Takes the coordinates x = origin + root u, whose origin is the chain's place.
  void begin(const Eigen::MatrixXd& root) {
    root_ = &root;
    origin_ = x_;
    at_ = place(Eigen::VectorXd::Zero(x_.size()));
  }

  /// Makes one proposal, moves the chain to its end, and returns the share of acceptance.
  double move(double step) {
    Eigen::VectorXd momentum = random_.normals(x_.size());
    const double size = step * (0.9 + 0.2 * random_.uniform());
    const double turn = 0.5 * std::numbers::pi * (0.8 + 0.4 * random_.uniform());
    const int steps = std::clamp(static_cast<int>(std::lround(turn / size)), 1, kMostSteps);
    const double before = at_.log_density - 0.5 * momentum.squaredNorm();
    Place here = at_;
    for (int i = 0; i < steps && std::isfinite(here.log_density); ++i) {
      momentum += 0.5 * size * here.gradient;
      here = place(here.u + size * momentum);
      if (std::isfinite(here.log_density)) momentum += 0.5 * size * here.gradient;
    }
    const double change = here.log_density - 0.5 * momentum.squaredNorm() - before;
    const double accepted = std::isfinite(change) ? std::min(1.0, std::exp(change)) : 0.0;
    if (random_.uniform() < accepted) {
      at_ = std::move(here);
      x_ = origin_ + *root_ * at_.u;
    }
    return accepted;
  }

  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }

 private:
  [[nodiscard]] Place place(const Eigen::VectorXd& u) const {
    Place found{u, {}, 0.0};
    Eigen::VectorXd by_x;
    found.log_density = density_(origin_ + *root_ * u, by_x);
    if (std::isfinite(found.log_density)) found.gradient = root_->transpose() * by_x;
    return found;
  }

  const LogDensity& density_;
  math::Random random_;
  Eigen::VectorXd x_, origin_;
  const Eigen::MatrixXd* root_ = nullptr;
  Place at_;
};

/// Returns the greatest split R-hat of the rows, whose values stand chain after chain.
double greatest_rhat(const Eigen::MatrixXd& x) {
  const Eigen::Index halves = 2 * kChains, n = x.cols() / halves;
  if (n < 2) return 1.0;
  double greatest = 1.0;
  for (Eigen::Index j = 0; j < x.rows(); ++j) {
    Eigen::VectorXd mean(halves), variance(halves);
    for (Eigen::Index h = 0; h < halves; ++h) {
      const auto part = x.row(j).segment(h * n, n).array();
      mean[h] = part.mean();
      variance[h] = (part - mean[h]).square().sum() / static_cast<double>(n - 1);
    }
    const double within = variance.mean();
    const double between = (mean.array() - mean.mean()).square().sum() / static_cast<double>(halves - 1);
    if (within > 0.0) greatest = std::max(greatest, std::sqrt(1.0 - 1.0 / static_cast<double>(n) + between / within));
  }
  return greatest;
}

}  // namespace

Sampled sample_density(
    const LogDensity& density, const Mode& mode, Eigen::Index count, std::uint64_t seed, const Progress& progress) {
  const Eigen::Index each = std::max<Eigen::Index>(1, (count + kChains - 1) / kChains);
  Sampled result;
  result.draws.resize(mode.x.size(), each * kChains);
  Eigen::VectorXd accepted = Eigen::VectorXd::Zero(kChains);
  std::vector<Chain> chains;
  for (Eigen::Index c = 0; c < kChains; ++c)
    chains.emplace_back(density, mode, math::Random(seed, static_cast<std::uint64_t>(c)));
  const auto each_chain = [&](const auto& run) {
    parallel_ranges(kChains, Eigen::Index{1}, [&](const auto& range) {
      for (Eigen::Index c = range.begin(); c < range.end(); ++c) {
        run(chains[static_cast<std::size_t>(c)], c);
      }
    });
  };
  // First Laplace's covariance, then the density's own, with which the draws are taken.
  Eigen::MatrixXd covariance = mode.covariance;
  for (const bool last : {false, true}) {
    const Eigen::MatrixXd root = covariance.llt().matrixL();
    Eigen::MatrixXd seen(mode.x.size(), kTuning / 2 * kChains);
    each_chain([&](Chain& chain, Eigen::Index c) {
      chain.begin(root);
      Step step;
      for (int i = 0; i < kTuning; ++i) {
        progress.check();
        step.learn(chain.move(step.size()));
        if (2 * i >= kTuning) seen.col(c * (kTuning / 2) + i - kTuning / 2) = chain.x();
      }
      step.settle();
      for (Eigen::Index i = 0; last && i < each; ++i) {
        progress.check();
        accepted[c] += chain.move(step.size()) / static_cast<double>(each);
        result.draws.col(c * each + i) = chain.x();
      }
    });
    const Eigen::MatrixXd off = seen.colwise() - seen.rowwise().mean().eval();
    covariance =
        (1.0 - kOfLaplace) * off * off.transpose() / static_cast<double>(seen.cols()) + kOfLaplace * mode.covariance;
  }
  result.accepted = accepted.mean();
  result.rhat = greatest_rhat(result.draws);
  return result;
}

}  // namespace myoid::fit
