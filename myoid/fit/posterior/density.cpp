#include "myoid/fit/posterior/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/erf.hpp>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/math/bounded.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr double kInside = 0.003;   // of a range: a search begins no nearer to a bound
constexpr double kFarthest = 40.0;  // of x: farther out z equals its bound to round-off
constexpr double kLeastModelError = 1e-6;
constexpr double kStartingTorqueError = 0.3;  // of the torque's root mean square

/// Returns true for the size y of a kind of unseen quantities over its believed spread, half normal.
constexpr bool is_size_of_kind(Eigen::Index field) { return field > kModelErrorSize && field < kNoiseFieldCount; }

constexpr double kExactLength_m = 1e-4;  // error of a tendon that is taken to be exact

constexpr double kFarthestScore = 30.0;  // beyond, the tail of a normal distribution is nearly 0

/// A size s at the normal score x, over the spread of its half normal prior, and d ln s / dx.
struct HalfNormal {
  double size = 0.0, slope = 0.0;
};
HalfNormal half_normal(double score) {
  const double x = std::clamp(score, -kFarthestScore, kFarthestScore);
  const double tail = math::normal_below(-std::abs(x));
  const double y = std::numbers::sqrt2 * (x < 0.0 ? boost::math::erf_inv(tail) : boost::math::erfc_inv(tail));
  return {y, 0.5 * std::exp(0.5 * (y * y - x * x)) / y};
}

/// Returns the normal score of `size`, which is s over the prior's spread.
double score_of(double size) {
  const double within = std::min(size, kFarthestScore);
  return std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * std::erfc(within / std::numbers::sqrt2));
}

}  // namespace

bool is_exact_geometry(const Unknown& of, const StudyData& data) {
  return of.is(Scope::muscle, kSlack) && std::none_of(of.targets.begin(), of.targets.end(), [&](const auto& target) {
           return measures_fascicles(data, static_cast<std::size_t>(target.owner));
         });
}

Density::Density(const StudyData& data, const EstimatorOptions& options)
    : likelihood_(data, options), unlike_(parameters().free()) {
  const std::vector<Unknown>& free = parameters().free();
  const auto p = static_cast<Eigen::Index>(free.size());
  lower_.resize(p);
  range_.resize(p);
  prior_mean_.setZero(p);
  for (const Unknown& of : free) exact_.push_back(fit::is_exact_geometry(of, data));
  take_precision();
  for (Eigen::Index j = 0; j < p; ++j) {
    const Unknown& of = free[static_cast<std::size_t>(j)];
    lower_[j] = of.bounds.lower;
    range_[j] = of.bounds.upper - of.bounds.lower;
    if (of.prior.sd > 0.0) prior_mean_[j] = of.prior.mean;
  }
  bool known = true;
  for (std::size_t c = 0; c < parameters().channels().size(); ++c)
    known = known && (parameters().unseen_activation(c) || options.of(parameters().channels()[c]).bandwidth_hz > 0.0);
  const std::optional<Eigen::Index> fascicle = likelihood_.fascicle_place();
  noise_mean_.setZero(kNoiseFieldCount + likelihood_.trial_count() + (fascicle ? 1 : 0));
  noise_sd_.setConstant(noise_mean_.size(), beliefs::kTrialTorqueNoise.sd);
  if (fascicle) noise_sd_[*fascicle] = beliefs::kFascicleError.sd;
  noise_mean_[kTorqueSd] = std::log(beliefs::kTorqueNoise.value * std::max(likelihood_.torque_size_nm(), 1e-9));
  noise_sd_[kTorqueSd] = beliefs::kTorqueNoise.sd;
  noise_mean_[kTorqueTime] = std::log(beliefs::kTorqueNoiseTime.value);
  noise_sd_[kTorqueTime] = beliefs::kTorqueNoiseTime.sd;
  noise_sd_[kEmgFactor] = (known ? beliefs::kEmgNoise : beliefs::kUnknownEmgNoise).sd;
  noise_sd_[kModelErrorSize] = std::max(options.unseen.model_error, kLeastModelError);
  noise_mean_[kModelErrorSize] = std::log(noise_sd_[kModelErrorSize]);
}

void Density::refer_to(const Eigen::VectorXd& x) {
  const Eigen::VectorXd z = z_of(x);
  likelihood_.refer_to(z);
  if (!unlike_.uncertain()) return;
  const Eigen::MatrixXd of_data = likelihood_.information(z, noise_of(x)).information;
  unlikeness_ = unlike_.expected(of_data, (of_data + precision_) * (z - prior_mean_));
  take_precision();
}

void Density::believe(Believed believed) {
  likelihood_.believe(believed);
  believed_ = believed;
  take_precision();
}

void Density::take_precision() {
  const std::vector<Unknown>& free = parameters().free();
  precision_ = prior_precision(free, unlikeness_);
  if (believed_ == Believed::nothing_exact) return;
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (!exact_[j]) continue;
    precision_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)) = 1.0 / (kExactLength_m * kExactLength_m);
  }
}

double Density::prior(const Eigen::VectorXd& off, Eigen::VectorXd& gradient) const {
  gradient = -precision_ * off;
  double result = 0.5 * off.dot(gradient);
  if (!integrates_) return result;
  const Eigen::VectorXd judged = unlike_.judged().cwiseProduct(off);
  const double squares = off.dot(judged), held = 1.0 / (unlikeness_ * unlikeness_);
  const Unlikeness::Integrated over = unlike_.integrated(squares);
  gradient += (held - over.precision) * judged;
  return result + 0.5 * held * squares + over.log_density;
}

math::Bounded Density::at(Eigen::Index unknown, const Eigen::VectorXd& x) const {
  return math::bounded(x[unknown], parameters().free()[static_cast<std::size_t>(unknown)].bound_shape());
}

Eigen::VectorXd Density::z_of(const Eigen::VectorXd& x) const {
  Eigen::VectorXd z(lower_.size());
  for (Eigen::Index j = 0; j < z.size(); ++j) z[j] = lower_[j] + range_[j] * at(j, x).share;
  return z;
}

NoiseValues Density::noise_of(const Eigen::VectorXd& x) const {
  NoiseValues noise = x.tail(noise_mean_.size());
  double& log_size = noise[kModelErrorSize];
  log_size = std::log(noise_sd_[kModelErrorSize] * half_normal(log_size).size);
  return noise;
}

Eigen::VectorXd Density::slope(const Eigen::VectorXd& x) const {
  Eigen::VectorXd slope(lower_.size());
  for (Eigen::Index j = 0; j < slope.size(); ++j) slope[j] = range_[j] * at(j, x).slope;
  return slope;
}

Eigen::VectorXd Density::x_of(const Eigen::VectorXd& z, const NoiseValues& noise) const {
  Eigen::VectorXd x(size());
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const double share = range_[j] > 0.0 ? std::clamp((z[j] - lower_[j]) / range_[j], kInside, 1.0 - kInside) : 0.5;
    x[j] = math::unbounded(share, parameters().free()[static_cast<std::size_t>(j)].bound_shape());
  }
  x.tail(noise.size()) = noise;
  x[lower_.size() + kModelErrorSize] = score_of(std::exp(noise[kModelErrorSize]) / noise_sd_[kModelErrorSize]);
  return x;
}

Eigen::VectorXd Density::start() const {
  NoiseValues noise = noise_mean_;
  noise[kTorqueSd] = std::log(kStartingTorqueError * std::max(likelihood_.torque_size_nm(), 1e-9));
  return x_of(parameters().start(), noise);
}

Eigen::VectorXd Density::start_at(const FittedUnknowns& at) const {
  NoiseValues noise = noise_of(start());
  const Eigen::Index shared = std::min<Eigen::Index>(kNoiseFieldCount, at.noise.size());
  noise.head(shared) = at.noise.head(shared);
  return x_of(likelihood_.reference(), noise);
}

Eigen::VectorXd Density::longest_step(const Eigen::VectorXd& x) const {
  constexpr double kLongest = 2.0;
  Eigen::VectorXd longest = Eigen::VectorXd::Constant(size(), kLongest);
  const Eigen::VectorXd by_x = slope(x);
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    const double sd = parameters().free()[static_cast<std::size_t>(j)].prior.sd;
    if (sd > 0.0 && by_x[j] > 0.0) longest[j] = std::min(kLongest, sd / by_x[j]);
  }
  return longest;
}

double Density::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const {
  const Eigen::Index p = lower_.size();
  if (!x.allFinite() || x.cwiseAbs().maxCoeff() > kFarthest) return -std::numeric_limits<double>::infinity();
  const Eigen::VectorXd z = z_of(x);
  const NoiseValues noise = noise_of(x);
  Likelihood::Gradient by;
  double result = likelihood_.value(z, noise, gradient != nullptr ? &by : nullptr);
  if (!std::isfinite(result)) return -std::numeric_limits<double>::infinity();
  if (gradient != nullptr) gradient->setZero(size());
  const Eigen::VectorXd by_x = slope(x);
  Eigen::VectorXd pull;
  result += prior(z - prior_mean_, pull);
  for (Eigen::Index j = 0; j < p; ++j) {
    const math::Bounded share = at(j, x);
    result += share.log_slope;
    if (gradient != nullptr) (*gradient)[j] = by_x[j] * (by.by_z[j] + pull[j]) + share.pull;
  }
  for (Eigen::Index field = 0; field < noise.size(); ++field) {
    if (field == kModelErrorSize) continue;
    if (is_size_of_kind(field)) {
      const double square = std::exp(2.0 * noise[field]);
      result += noise[field] - 0.5 * square;
      if (gradient != nullptr) (*gradient)[p + field] = by.by_noise[field] + 1.0 - square;
      continue;
    }
    const double scaled = (noise[field] - noise_mean_[field]) / noise_sd_[field];
    result -= 0.5 * scaled * scaled;
    if (gradient != nullptr) (*gradient)[p + field] = by.by_noise[field] - scaled / noise_sd_[field];
  }
  const Eigen::Index size = p + kModelErrorSize;
  result -= 0.5 * x[size] * x[size];
  if (gradient != nullptr) (*gradient)[size] = by.by_noise[kModelErrorSize] * half_normal(x[size]).slope - x[size];
  return result;
}

Eigen::MatrixXd Density::gauss_newton(const Eigen::VectorXd& x) const {
  const Eigen::Index p = lower_.size();
  const Eigen::VectorXd by_x = slope(x);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(size(), size());
  Eigen::MatrixXd of_z = likelihood_.information(z_of(x), noise_of(x)).information;
  of_z += precision_;
  h.topLeftCorner(p, p) = by_x.asDiagonal() * of_z * by_x.asDiagonal();
  for (Eigen::Index j = 0; j < p; ++j) h(j, j) += at(j, x).curvature;
  h.diagonal().tail(noise_sd_.size()) = noise_sd_.cwiseAbs2().cwiseInverse();
  // The torque's error has the size b sigma_T: ln b and ln sigma_T share a gradient.
  for (std::size_t r = 0; r < likelihood_.runs().size(); ++r) {
    const double rows = 0.5 * likelihood_.row_weight(r) * static_cast<double>(likelihood_.runs()[r].measured_nm.size());
    const Eigen::Index size = p + kTorqueSd, share = p + likelihood_.share_place(r);
    h(size, size) += rows;
    h(share, share) += rows;
    h(size, share) += rows;
    h(share, size) += rows;
    if (const auto fascicle = likelihood_.fascicle_place())
      h(p + *fascicle, p + *fascicle) +=
          0.5 * likelihood_.row_weight(r) * static_cast<double>(likelihood_.runs()[r].measured_m.size());
  }
  h(p + kModelErrorSize, p + kModelErrorSize) = 1.0 + 3.0 * std::pow(half_normal(x[p + kModelErrorSize]).slope, 2);
  for (Eigen::Index field = 0; field < kNoiseFieldCount; ++field)
    if (is_size_of_kind(field)) h(p + field, p + field) = 1.0 + 2.0 * std::exp(2.0 * x[p + field]);
  return h;
}

}  // namespace myoid::fit
