#include "myoid/fit/intervals/score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/zero_phase.h"

namespace myoid::fit {

double Score::rmse_nm() const { return n > 0.0 ? std::sqrt(sse / n) : 0.0; }

double Score::nrmse_range() const { return range_nm > 0.0 ? rmse_nm() / range_nm : 0.0; }

double Score::nrmse_sd() const { return sst > 0.0 ? rmse_nm() / std::sqrt(sst / n) : 0.0; }

double Score::r2() const { return sst > 0.0 ? 1.0 - sse / sst : 0.0; }

double Score::vaf() const { return sst > 0.0 ? 1.0 - error_spread_nm2 / sst : 0.0; }

Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  if (measured.size() == 0) return {};
  const Eigen::VectorXd error = predicted - measured;
  const double sst = (measured.array() - measured.mean()).square().sum();
  // The arithmetic alone spreads a constant torque by less than this.
  constexpr double kRounding = 1e-9;
  const bool is_constant = sst <= kRounding * kRounding * measured.squaredNorm();
  return {.n = static_cast<double>(measured.size()),
          .sse = error.squaredNorm(),
          .sst = is_constant ? 0.0 : sst,
          .mean_nm = measured.mean(),
          .range_nm = measured.maxCoeff() - measured.minCoeff(),
          .error_spread_nm2 = (error.array() - error.mean()).square().sum()};
}

double FiberScore::rms_m() const { return n > 0.0 ? std::sqrt(sse_m2 / n) : std::numeric_limits<double>::quiet_NaN(); }

void FiberScores::add(const FiberScores& more) {
  for (const FiberScore& of : more.fibers) {
    auto at = std::ranges::find(fibers, of.muscle, &FiberScore::muscle);
    if (at == fibers.end()) at = fibers.insert(at, FiberScore{.muscle = of.muscle});
    at->n += of.n;
    at->sse_m2 += of.sse_m2;
  }
}

std::string r2_text(double r2) {
  if (r2 < -9999.0) return fmt::format("{:.1e}", r2);
  return fmt::format("{:.{}f}", r2, r2 < -99.0 ? 0 : 3);
}

Eigen::VectorXd below(const Eigen::VectorXd& time_s, const Eigen::VectorXd& torque_nm, double cutoff_hz) {
  const Eigen::Index n = time_s.size();
  if (n < 8 || !(cutoff_hz > 0.0)) return torque_nm;
  const TimeSeries series(time_s, {{"torque", Unit::newton_meter}}, torque_nm);
  const double rate = series.mean_rate_hz();
  if (cutoff_hz > 0.4 * rate || !series.is_uniform()) return torque_nm;
  constexpr int kOrder = 2;
  const double design = math::two_pass_cutoff_hz(math::FilterBand::low_pass, kOrder, cutoff_hz, rate);
  return math::zero_phase(math::design_butterworth(math::FilterBand::low_pass, kOrder, design, rate), torque_nm);
}

}  // namespace myoid::fit
