#include "myoid/identification/options.h"

#include <cmath>

#include "myoid/core/normal.h"

namespace myoid::identification {

double EstimatorOptions::bandwidth_hz(const std::string& channel) const {
  const auto known = emg_bandwidth_hz.find(channel);
  return known != emg_bandwidth_hz.end() && known->second > 0.0 ? known->second : 0.0;
}

double EstimatorOptions::rest_level(const std::string& channel) const {
  const auto rest = emg_rest.find(channel);
  return rest != emg_rest.end() && bandwidth_hz(channel) > 0.0 ? rest->second : 0.0;
}

double envelope_spread(const EstimatorOptions& options, const std::string& channel) {
  const double known_hz = options.bandwidth_hz(channel);
  const double bandwidth_hz = known_hz > 0.0 ? known_hz : beliefs::kEmgBandwidth.value;
  return kRectifiedSpread / std::sqrt(2.0 * bandwidth_hz * 0.4815 / options.envelope_cutoff_hz);
}

}  // namespace myoid::identification
