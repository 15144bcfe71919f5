#include "myoid/intervals/score.h"

#include <cmath>

#include "myoid/core/time_series.h"
#include "myoid/signals/filter.h"

namespace myoid::identification {

double coefficient_of_determination(const Eigen::VectorXd& reference,
                                    const Eigen::VectorXd& predicted) {
  const double total = (reference.array() - reference.mean()).square().sum();
  return total > 0.0 ? 1.0 - (reference - predicted).squaredNorm() / total : 0.0;
}

Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  Score s;
  if (measured.size() == 0) return s;
  const Eigen::VectorXd error = predicted - measured;
  const auto n = static_cast<double>(measured.size());
  s.rmse_nm = std::sqrt(error.squaredNorm() / n);
  const double range = measured.maxCoeff() - measured.minCoeff();
  s.nrmse_range = range > 0.0 ? s.rmse_nm / range : 0.0;
  s.r2 = coefficient_of_determination(measured, predicted);
  const double variance = (measured.array() - measured.mean()).square().sum();
  s.nrmse_sd = variance > 0.0 ? s.rmse_nm / std::sqrt(variance / n) : 0.0;
  s.vaf = variance > 0.0 ? 1.0 - (error.array() - error.mean()).square().sum() / variance : 0.0;
  return s;
}

Eigen::VectorXd below(const Eigen::VectorXd& time_s,
                      const Eigen::VectorXd& torque_nm,
                      double cutoff_hz) {
  const Eigen::Index n = time_s.size();
  if (n < 8 || !(cutoff_hz > 0.0)) return torque_nm;
  const TimeSeries series(time_s, {{"torque", Unit::newton_meter}}, torque_nm);
  if (cutoff_hz > 0.4 * series.mean_rate_hz() || !series.is_uniform()) return torque_nm;
  return signals::zero_phase_filter(series, math::FilterBand::low_pass, cutoff_hz,
                                    {.order = 2, .corrected = true})
      .values()
      .col(0);
}

}  // namespace myoid::identification
