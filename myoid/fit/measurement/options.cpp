#include "myoid/fit/measurement/options.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/normal.h"

namespace myoid::fit {

ChannelSource ActivationSource::of(std::string_view channel) const {
  const auto found = std::ranges::find(channels, channel, &ChannelSource::channel);
  return found != channels.end() ? *found : ChannelSource{.channel = std::string(channel)};
}

ChannelSource& ActivationSource::state(const std::string& channel) {
  const auto found = std::ranges::find(channels, channel, &ChannelSource::channel);
  return found != channels.end() ? *found : channels.emplace_back(ChannelSource{.channel = channel});
}

double ActivationSource::rest_level(const std::string& channel) const {
  const ChannelSource source = of(channel);
  return source.bandwidth_hz > 0.0 ? source.rest : 0.0;
}

EstimatorOptions estimator_options(const EstimatorSettings& settings,
                                   const ActivationSource& source,
                                   const Progress& progress) {
  EstimatorOptions options;
  static_cast<EstimatorSettings&>(options) = settings;
  static_cast<ActivationSource&>(options) = source;
  options.progress = progress;
  options.choose_lag = settings.lag == LagChoice::automatic;
  if (settings.lag == LagChoice::shared) options.law = EmgLag::shared;
  if (settings.lag != LagChoice::equation_1) return options;
  options.law = EmgLag::equation_1;
  options.delay_prior_mean_s = beliefs::kEmgDelayBesideLags.value;
  options.delay_prior_sd_s = beliefs::kEmgDelayBesideLags.sd;
  return options;
}

double envelope_spread(const EstimatorOptions& options, const std::string& channel) {
  const double known_hz = options.of(channel).bandwidth_hz;
  const double bandwidth_hz = known_hz > 0.0 ? known_hz : beliefs::kEmgBandwidth.value;
  return kRectifiedSpread / std::sqrt(2.0 * bandwidth_hz * 0.4815 / options.envelope_cutoff_hz);
}

}  // namespace myoid::fit
