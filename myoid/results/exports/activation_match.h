#pragma once

#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/parameter_fields.h"

namespace myoid::results {

/// The numbers of CEINMS by which an activation follows an envelope.
struct CeinmsActivation {
  double delay_s = 0.0;
  double c1 = 0.0, c2 = 0.0;
  double shape_factor = 0.0;
  double scale = 1.0;  ///< Our activation over theirs; a factor of the strength.
};

/// Returns the numbers that stand for a channel's. The lags become c1 and c2 at the sampling rate, where a
/// rise is as slow as a fall. Gain, shape and exponent become shape factor and scale: exactly where the exponent is 1,
/// else by least squares over the values of the envelope. A shape factor of 0, by which CEINMS divides, becomes -1e-5.
[[nodiscard]] CeinmsActivation ceinms_activation(const fit::ChannelValues& channel,
                                                 fit::EmgLag lag,
                                                 const std::vector<double>& envelope,
                                                 double rate_hz);

/// The numbers of the NMSM Pipeline by which an activation follows an envelope.
struct NmsmActivation {
  double delay_s = 0.0, time_constant_s = 0.0, nonlinearity = 0.0, emg_scale = 1.0;
};

/// Returns the numbers that stand for a channel's times `share`. The mean lag of delay and dynamics together stays
/// where the delay can give way, with a time constant between 7.5 and 35 ms, the Pipeline's range; scale and
/// nonlinearity are by least squares over the values of the envelope unless our activation is proportional to it.
[[nodiscard]] NmsmActivation nmsm_numbers(const fit::ChannelValues& channel,
                                          fit::EmgLag lag,
                                          double share,
                                          const std::vector<double>& envelope);

}  // namespace myoid::results
