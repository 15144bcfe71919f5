#include "myoid/posterior/sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/core/parallel.h"
#include "myoid/math/random.h"

namespace myoid::identification {
namespace {

constexpr Eigen::Index kChains = 4;
constexpr int kTuning = 40;         // proposals
constexpr double kTarget = 0.8;     // of proposals taken
constexpr double kFirstStep = 0.4;  // standard deviations
constexpr int kMostSteps = 20;      // of a proposal

/// A place in the coordinates of Laplace's approximation.
struct Place {
  Eigen::VectorXd u, gradient;
  double log_density = 0.0;
};

/// The step that a chain takes, found by dual averaging.
class Step {
 public:
  [[nodiscard]] double size() const { return std::exp(log_size_); }
  void learn(double accepted) {
    count_ += 1.0;
    missed_ += (kTarget - accepted - missed_) / (count_ + 10.0);
    log_size_ = std::log(3.0 * kFirstStep) - std::sqrt(count_) / 0.05 * missed_;
    log_size_ = std::clamp(log_size_, std::log(0.02), std::log(1.0));
    const double weight = std::pow(count_, -0.75);
    mean_ += weight * (log_size_ - mean_);
  }
  void settle() { log_size_ = mean_; }

 private:
  double count_ = 0.0, missed_ = 0.0, log_size_ = std::log(kFirstStep), mean_ = log_size_;
};

class Chain {
 public:
  Chain(const LogDensity& density,
        const Mode& mode,
        const Eigen::MatrixXd& root,
        math::Random random)
      : density_(density), mode_(mode), root_(root), random_(random) {
    // A draw from the approximation, or nearer to the mode where the density is next to nothing.
    Eigen::VectorXd u = normal();
    for (int tries = 0; tries < 6; ++tries, u *= 0.5) {
      at_ = place(u);
      const double d = static_cast<double>(u.size());
      if (std::isfinite(at_.log_density) && at_.log_density > mode.log_density - 3.0 * d) return;
    }
    at_ = place(Eigen::VectorXd::Zero(u.size()));
  }

  /// The share of acceptance of one proposal; the chain is where it ends.
  double move(double step) {
    Eigen::VectorXd momentum = normal();
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
    if (random_.uniform() < accepted) at_ = std::move(here);
    return accepted;
  }

  [[nodiscard]] Eigen::VectorXd x() const { return mode_.x + root_ * at_.u; }

 private:
  Eigen::VectorXd normal() {
    Eigen::VectorXd n(mode_.x.size());
    for (double& v : n) v = random_.normal();
    return n;
  }
  [[nodiscard]] Place place(const Eigen::VectorXd& u) const {
    Place found{u, {}, 0.0};
    Eigen::VectorXd by_x;
    found.log_density = density_(mode_.x + root_ * u, by_x);
    if (std::isfinite(found.log_density)) found.gradient = root_.transpose() * by_x;
    return found;
  }

  const LogDensity& density_;
  const Mode& mode_;
  const Eigen::MatrixXd& root_;
  math::Random random_;
  Place at_;
};

/// Split R-hat of each row, whose values are chain after chain; the greatest.
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
    const double between =
        (mean.array() - mean.mean()).square().sum() / static_cast<double>(halves - 1);
    if (within > 0.0)
      greatest =
          std::max(greatest, std::sqrt(1.0 - 1.0 / static_cast<double>(n) + between / within));
  }
  return greatest;
}

}  // namespace

Sampled sample_density(const LogDensity& density,
                       const Mode& mode,
                       Eigen::Index count,
                       std::uint64_t seed,
                       const Progress& progress) {
  const Eigen::MatrixXd root = mode.covariance.llt().matrixL();
  const Eigen::Index each = std::max<Eigen::Index>(1, (count + kChains - 1) / kChains);
  Sampled result;
  result.draws.x.resize(mode.x.size(), each * kChains);
  Eigen::VectorXd accepted = Eigen::VectorXd::Zero(kChains);
  parallel_ranges(kChains, Eigen::Index{1}, [&](const auto& range) {
    for (Eigen::Index c = range.begin(); c < range.end(); ++c) {
      Chain chain(density, mode, root, math::Random(seed, static_cast<std::uint64_t>(c)));
      Step step;
      for (int i = 0; i < kTuning; ++i) {
        progress.check();
        step.learn(chain.move(step.size()));
      }
      step.settle();
      for (Eigen::Index i = 0; i < each; ++i) {
        progress.check();
        accepted[c] += chain.move(step.size()) / static_cast<double>(each);
        result.draws.x.col(c * each + i) = chain.x();
      }
    }
  });
  result.draws.weight = Eigen::VectorXd::Constant(result.draws.x.cols(),
                                                  1.0 / static_cast<double>(result.draws.x.cols()));
  result.accepted = accepted.mean();
  result.rhat = greatest_rhat(result.draws.x);
  return result;
}

}  // namespace myoid::identification
