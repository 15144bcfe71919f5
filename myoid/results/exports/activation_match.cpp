#include "myoid/results/exports/activation_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/opensim/projects/ceinms_law.h"
#include "myoid/results/exports/foreign_law.h"

namespace myoid::results {
namespace {

using fit::ChannelValues;
using fit::EmgLag;

constexpr double kNearlyLinear = -1e-5;

double pure_delay_s(const ChannelValues& channel, EmgLag lag) {
  return channel[fit::kDelay] * (lag == EmgLag::shared ? fit::LagShares{}.pure : 1.0);
}

std::vector<double> own_activation(const ChannelValues& channel, const std::vector<double>& envelope) {
  std::vector<fit::Envelope::Value> delayed(envelope.size());
  for (std::size_t k = 0; k < envelope.size(); ++k) delayed[k].value = envelope[k];
  std::vector<double> values;
  for (const fit::Activation& each : fit::activation(delayed, channel)) values.push_back(each.value);
  return values;
}

/// Returns where a function is least between two ends: golden sections about the least of a grid.
template <typename Function>
double least(const Function& f, double low, double high) {
  constexpr int kGrid = 24, kSections = 40;
  const double step = (high - low) / kGrid;
  double at = low, value = f(low);
  for (int k = 1; k <= kGrid; ++k) {
    const double next = f(low + step * k);
    if (next < value) {
      value = next;
      at = low + step * k;
    }
  }
  constexpr double kShare = 1.0 / std::numbers::phi;
  double left = std::max(low, at - step), right = std::min(high, at + step);
  double a = right - kShare * (right - left), b = left + kShare * (right - left);
  double fa = f(a), fb = f(b);
  for (int k = 0; k < kSections; ++k) {
    if (fa < fb) {
      right = b;
      b = a;
      fb = fa;
      fa = f(a = right - kShare * (right - left));
    } else {
      left = a;
      a = b;
      fa = fb;
      fb = f(b = left + kShare * (right - left));
    }
  }
  return 0.5 * (left + right);
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b, double factor) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - factor * b[k]) * (a[k] - factor * b[k]);
  return sum;
}

/// The factor of `b` that is nearest to `a`.
double nearest_factor(const std::vector<double>& a, const std::vector<double>& b) {
  const double size = std::inner_product(b.begin(), b.end(), b.begin(), 0.0);
  return size > 0.0 ? std::inner_product(a.begin(), a.end(), b.begin(), 0.0) / size : 1.0;
}

/// Sets shape and scale for an activation that is a power of the envelope.
void match_power(const ChannelValues& channel, const std::vector<double>& envelope, CeinmsActivation& found) {
  constexpr double kMostBent = 5.0;
  const std::vector<double> own = own_activation(channel, envelope);
  const auto theirs = [&](double shape_factor) {
    std::vector<double> values;
    for (const double u : envelope) values.push_back(opensim::exponential_shape(u, shape_factor));
    return values;
  };
  found.shape_factor = least(
      [&](double shape_factor) {
        const std::vector<double> values = theirs(shape_factor);
        return squared_distance(own, values, nearest_factor(own, values));
      },
      -kMostBent, kMostBent);
  found.scale = nearest_factor(own, theirs(found.shape_factor));
}

}  // namespace

CeinmsActivation ceinms_activation(const ChannelValues& channel,
                                   EmgLag lag,
                                   const std::vector<double>& envelope,
                                   double rate_hz) {
  CeinmsActivation found{.delay_s = pure_delay_s(channel, lag)};
  const std::array<double, 2> lags = fit::lag_times_s(channel, lag);
  const auto coefficient = [&](double time_s) { return time_s > 0.0 ? -std::exp(-1.0 / (rate_hz * time_s)) : 0.0; };
  found.c1 = coefficient(lags[0]);
  found.c2 = coefficient(lags[1]);
  const double gain = channel[fit::kGain], shape = channel[fit::kShape];
  if (channel[fit::kExponent] != 1.0) {
    match_power(channel, envelope, found);
  } else if (shape != 0.0) {
    found.shape_factor = shape * gain;
    found.scale = opensim::exponential_shape(gain, shape);
  } else {
    found.scale = gain;
  }
  if (found.shape_factor == 0.0) found.shape_factor = kNearlyLinear;
  return found;
}

NmsmActivation nmsm_numbers(const ChannelValues& channel,
                            EmgLag lag,
                            double share,
                            const std::vector<double>& envelope) {
  constexpr double kShortest = 0.0075, kLongest = 0.035, kMostNonlinear = 0.35;
  NmsmActivation found;
  std::vector<double> own = own_activation(channel, envelope);
  for (double& value : own) value *= share;
  const double usual = share * channel[fit::kGain];
  found.emg_scale = usual;
  if (channel[fit::kExponent] != 1.0 || channel[fit::kShape] != 0.0) {
    const auto distance = [&](double nonlinearity, double scale) {
      double sum = 0.0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        const double e = own[k] - nmsm_activation(scale * envelope[k], nonlinearity);
        sum += e * e;
      }
      return sum;
    };
    const auto scale_of = [&](double nonlinearity) {
      return least([&](double scale) { return distance(nonlinearity, scale); }, 0.05 * usual, 3.0 * usual);
    };
    found.nonlinearity =
        least([&](double nonlinearity) { return distance(nonlinearity, scale_of(nonlinearity)); }, 0.0, kMostNonlinear);
    found.emg_scale = scale_of(found.nonlinearity);
  }
  const std::array<double, 2> lags = fit::lag_times_s(channel, lag);
  const double mean =
      envelope.empty() ? 0.5
                       : std::accumulate(envelope.begin(), envelope.end(), 0.0) / static_cast<double>(envelope.size());
  // The Pipeline's dynamics answer with tau / (0.75 e + 0.25).
  const double slower = 1.0 / (0.75 * std::clamp(found.emg_scale * mean, 0.0, 1.0) + 0.25);
  const double lag_s = lags[0] + lags[1];
  found.time_constant_s = std::clamp(lag_s / slower, kShortest, kLongest);
  found.delay_s = std::max(0.0, pure_delay_s(channel, lag) + lag_s - slower * found.time_constant_s);
  return found;
}

}  // namespace myoid::results
