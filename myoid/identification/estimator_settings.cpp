#include "myoid/identification/estimator_settings.h"

#include "myoid/beliefs/beliefs.h"

namespace myoid::identification {
namespace {

void follow_emg(LagChoice lag, EstimatorOptions& options) {
  options.choose_lag = lag == LagChoice::automatic;
  if (lag == LagChoice::shared) options.lag = EmgLag::shared;
  if (lag != LagChoice::equation_1) return;
  options.lag = EmgLag::equation_1;
  options.delay_prior_mean_s = beliefs::kEmgDelayBesideLags.value;
  options.delay_prior_sd_s = beliefs::kEmgDelayBesideLags.sd;
}

}  // namespace

EstimatorOptions estimator_options(const EstimatorSettings& settings,
                                   const ActivationSource& source,
                                   const Progress& progress) {
  EstimatorOptions options;
  options.muscles = settings.muscles;
  options.unseen = settings.unseen;
  follow_emg(settings.lag, options);
  options.delay_s = settings.delay_s;
  options.delay_per_channel = settings.delay_per_channel;
  options.angle_sd_rad = settings.angle_sd_rad;
  options.angle_rate_sd_radps = settings.angle_rate_sd_radps;
  options.eccentric = settings.eccentric;
  options.normalised = settings.normalised;
  options.posterior_draws = settings.posterior_draws;
  options.from_mvc = source.from_mvc;
  options.envelope_cutoff_hz = source.envelope_cutoff_hz;
  for (const ChannelSource& c : source.channels) {
    options.emg_bandwidth_hz[c.channel] = c.bandwidth_hz;
    options.emg_rest[c.channel] = c.rest;
    if (!c.gain_sd) continue;
    options.gain_prior_sd[c.channel] = *c.gain_sd;
    options.gain_prior_mean[c.channel] = c.gain_mean;
  }
  options.progress = progress;
  return options;
}

}  // namespace myoid::identification
