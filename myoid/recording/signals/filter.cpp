#include "myoid/recording/signals/filter.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {

TimeSeries zero_phase_filter(const TimeSeries& series,
                             math::FilterBand band,
                             double cutoff_hz,
                             const FilterOptions& options) {
  if (!series.is_uniform(0.2)) {
    throw InvalidInput("filter: the samples are not evenly spaced; resample them, or split the trial at its gap");
  }
  const double rate = series.mean_rate_hz();
  const double design = options.corrected ? math::two_pass_cutoff_hz(band, options.order, cutoff_hz, rate) : cutoff_hz;
  const auto sections = math::design_butterworth(band, options.order, design, rate);
  Eigen::MatrixXd values(series.sample_count(), series.channel_count());
  for (Eigen::Index c = 0; c < series.channel_count(); ++c)
    values.col(c) = math::zero_phase(sections, series.values().col(c), options.ends);
  return {series.time_s(), series.channels(), std::move(values)};
}

}  // namespace myoid::recording
