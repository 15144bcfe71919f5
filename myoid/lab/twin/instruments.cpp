#include "myoid/lab/twin/instruments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/random.h"
#include "myoid/lab/virtual_person/raw_emg.h"

namespace myoid::lab {
namespace {

/// Resolution of the instruments, as steps per unit: 0.01 mm, 0.1 uV, 0.1 mN m.
constexpr double kMarkerSteps_perm = 1e5;
constexpr double kEmgSteps_perv = 1e7;
constexpr double kTorqueSteps_pernm = 1e4;
constexpr double kArtefactBand_hz = 4.0;
constexpr double kArtefactSpeed_radps = 2.0;  ///< speed at which the artefact has the rms of the protocol
constexpr double kColdGain = 0.15;            ///< excess of EMG at the beginning of a warm-up
constexpr double kEnvelopeRate_hz = 250;      ///< amplitudes are straight lines between its samples
constexpr double kShortestDropout_s = 0.03;
constexpr double kLongestDropout_s = 0.30;
constexpr double kMostOffsetSd = 3.0;

/// Rounds values to multiples of the resolution of an instrument.
template <typename Derived>
void quantize(Eigen::MatrixBase<Derived>& values, double per_unit) {
  values = (values * per_unit).array().round().matrix() / per_unit;
}

math::Random stream(std::uint64_t seed, std::string_view instrument, const std::string& trial) {
  return math::Random(math::seed_for(seed, fmt::format("{}.{}", instrument, trial)));
}

Vec3 random_direction(math::Random& random) {
  Vec3 v = Vec3::Zero();
  do {
    v = Vec3(random.normal(), random.normal(), random.normal());
  } while (v.norm() < 1e-3);
  return v.normalized();
}

std::vector<MarkerError> place_markers(const MarkerNoise& noise, const VirtualArm& arm, math::Random random) {
  std::vector<MarkerError> errors;
  for (const MarkerSegment segment : arm.marker_segments()) {
    MarkerError error;
    error.misplaced_m = noise.misplacement_m / std::sqrt(3.0) * Vec3(random.normal(), random.normal(), random.normal());
    const double upper_m = random.uniform(0.005, 0.010);
    const double forearm_m = random.uniform(0.003, 0.005);
    const Vec3 along = random_direction(random);
    error.phase_rad = random.uniform(0.0, 2.0 * kPi);
    if (segment == MarkerSegment::upper_arm) error.soft_tissue_m = noise.soft_tissue * upper_m * along;
    if (segment == MarkerSegment::forearm) error.soft_tissue_m = noise.soft_tissue * forearm_m * along;
    errors.push_back(error);
  }
  return errors;
}

/// Interpolates values on an even clock by straight lines.
Eigen::VectorXd stretched(const Eigen::VectorXd& values,
                          double first_s,
                          double rate_hz,
                          const Eigen::VectorXd& time_s) {
  Eigen::VectorXd result(time_s.size());
  const double last = static_cast<double>(values.size() - 1);
  for (Eigen::Index k = 0; k < time_s.size(); ++k) {
    const double s = std::clamp((time_s(k) - first_s) * rate_hz, 0.0, last);
    const auto before = std::min(static_cast<Eigen::Index>(s), values.size() - 2);
    result(k) = std::lerp(values(before), values(before + 1), s - static_cast<double>(before));
  }
  return result;
}

/// The activity of a muscle, on the clock of kEnvelopeRate_hz from `first_s`.
struct Source {
  Eigen::VectorXd amplitude;   ///< Rms of the muscle's signal, relative to the greatest.
  Eigen::VectorXd excitation;  ///< 0..1
  Eigen::VectorXd fatigued;    ///< Fatigued share of the muscle's strength.
};

EmgSpectrum scaled(const EmgSpectrum& spectrum, double factor) {
  return {.low_hz = spectrum.low_hz * factor, .high_hz = spectrum.high_hz * factor};
}

/// Returns the muscle's signal: noise whose rms is the amplitude.
Eigen::VectorXd signal_of(const Source& source,
                          double first_s,
                          const Eigen::VectorXd& true_time_s,
                          const EmgNoise& emg,
                          double spectrum,
                          math::Random random) {
  constexpr double kAudible = 0.005;  // least relevant change of frequencies
  const auto over_time = [&](const Eigen::VectorXd& values) {
    return stretched(values, first_s, kEnvelopeRate_hz, true_time_s);
  };
  const Eigen::VectorXd amplitude = over_time(source.amplitude);
  const Eigen::Index count = amplitude.size();
  const double least = source.fatigued.minCoeff();
  const double most = source.fatigued.maxCoeff();
  const EmgSpectrum fresh = scaled({}, spectrum * (1.0 - least));
  const EmgSpectrum tired = scaled({}, spectrum * (1.0 - most));
  const Eigen::Index lead = emg_lead(tired, emg.rate_hz);

  Eigen::VectorXd innovations;
  if (emg.motor_units > 0.0) {
    const Eigen::VectorXd per_second =
        source.excitation.unaryExpr([&](double u) { return discharges_hz(emg.motor_units, u); });
    Eigen::VectorXd rate_hz(lead + count);
    rate_hz.head(lead).setConstant(per_second(0));
    rate_hz.tail(count) = over_time(per_second);
    innovations = discharge_noise(rate_hz, emg.rate_hz, random);
  } else {
    innovations = random.normals(lead + count);
  }
  const Eigen::VectorXd first = emg_from(fresh, emg.rate_hz, innovations, lead);
  if (most - least < kAudible) return amplitude.cwiseProduct(first);

  // Mixes the two spectra by fatigue; the mixture has unit variance, too.
  const Eigen::VectorXd last = emg_from(tired, emg.rate_hz, innovations, lead);
  const double alike = first.dot(last) / (first.norm() * last.norm());
  const Eigen::VectorXd fatigued = over_time(source.fatigued);
  Eigen::VectorXd signal(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double w = (fatigued(k) - least) / (most - least);
    const double variance = (1.0 - w) * (1.0 - w) + w * w + 2.0 * w * (1.0 - w) * alike;
    signal(k) = amplitude(k) * ((1.0 - w) * first(k) + w * last(k)) / std::sqrt(variance);
  }
  return signal;
}

/// Filters in one pass, as an amplifier does.
void limit_bandwidth(Eigen::VectorXd& signal, double cutoff_hz, double rate_hz) {
  for (const math::SecondOrderSection& s :
       math::design_butterworth(math::FilterBand::low_pass, 4, cutoff_hz, rate_hz)) {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
    for (double& value : signal) {
      const double x = value;
      const double y = s.b0 * x + s.b1 * x1 + s.b2 * x2 - s.a1 * y1 - s.a2 * y2;
      x2 = x1, x1 = x;
      y2 = y1, y1 = y;
      value = y;
    }
  }
}

/// Returns drives that wander between 0 and the greatest effort, independent of the muscles.
std::vector<PerMuscle> wandering_drives(Eigen::Index count, math::Random random) {
  constexpr double kMean = 0.3, kSd = 0.2, kCutoff_hz = 1.0;
  std::vector<PerMuscle> drives(static_cast<std::size_t>(count));
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    const Eigen::VectorXd noise = lowpass_noise(kCutoff_hz, kEnvelopeRate_hz, count, random);
    for (std::size_t k = 0; k < drives.size(); ++k)
      drives[k][m] = std::clamp(kMean + kSd * noise(static_cast<Eigen::Index>(k)), 0.0, 1.0);
  }
  return drives;
}

/// Returns noise of amplifier, mains and movement, relative to the greatest rms.
Eigen::VectorXd disturbance(const EmgNoise& emg,
                            double baseline,
                            const Eigen::VectorXd& speed_radps,
                            math::Random random) {
  const Eigen::Index n = speed_radps.size();
  const double phase_rad = random.uniform(0.0, 2.0 * kPi);
  const Eigen::VectorXd artefact = lowpass_noise(kArtefactBand_hz, emg.rate_hz, n, random);
  Eigen::VectorXd signal(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double mains =
        std::sqrt(2.0) * std::sin(2.0 * kPi * emg.hum_hz * static_cast<double>(k) / emg.rate_hz + phase_rad);
    signal(k) = baseline * random.normal() + emg.hum * mains +
                emg.artefact * std::abs(speed_radps(k)) / kArtefactSpeed_radps * artefact(k);
  }
  return signal;
}

}  // namespace

bool has_brachialis_electrode(const Protocol& protocol) { return protocol.control.brachialis_synergy > 0.0; }

Instruments attach_instruments(const Protocol& protocol, const VirtualArm& arm, std::uint64_t seed) {
  Instruments result;
  result.markers = place_markers(protocol.motion, arm, math::Random(math::seed_for(seed, "marker placement")));
  math::Random random(math::seed_for(seed, "electrodes"));
  const EmgNoise& emg = protocol.emg;
  for (std::size_t m = 0; m < 4; ++m) {
    result.greatest_v[m] = std::exp(random.uniform(std::log(emg.mvc_v.lower), std::log(emg.mvc_v.upper)));
    result.exponent[m] = random.uniform(emg.exponent.lower, emg.exponent.upper);
    result.exponent[m] = protocol.truth.sensors.emg_exponent.value_or(result.exponent[m]);
    result.crosstalk[m] = random.uniform(emg.crosstalk.lower, emg.crosstalk.upper);
    const double baseline = random.uniform(2.0 / 3.0, 4.0 / 3.0);
    result.baseline[m] = emg.baseline * (protocol.level == Level::different ? baseline : 1.0);
  }
  math::Random tissue(math::seed_for(seed, "tissue"));
  for (double& factor : result.spectrum) factor = tissue.uniform(emg.spectrum.lower, emg.spectrum.upper);
  const bool drifts = random.uniform() < 0.5;
  result.clock_drift = drifts ? 1e-6 * protocol.sync.drift_ppm : 0.0;
  return result;
}

EmgClock emg_clock(const Protocol& protocol,
                   const Instruments& instruments,
                   const std::string& trial,
                   std::uint64_t seed) {
  math::Random random = stream(seed, "trigger", trial);
  const double z = std::clamp(random.normal(), -kMostOffsetSd, kMostOffsetSd);
  return {.offset_s = protocol.sync.offset_sd_s * z, .drift = instruments.clock_drift};
}

Eigen::VectorXd clock(double duration_s, double rate_hz) {
  const auto count = static_cast<Eigen::Index>(std::floor(duration_s * rate_hz + 1e-9)) + 1;
  Eigen::VectorXd time_s(count);
  for (Eigen::Index k = 0; k < count; ++k) time_s(k) = static_cast<double>(k) / rate_hz;
  return time_s;
}

MarkerSeries record_markers(const Protocol& protocol,
                            const VirtualArm& arm,
                            const Instruments& instruments,
                            const Performance& performance,
                            std::uint64_t seed) {
  const TrialProtocol& trial = performance.script().protocol;
  const MarkerNoise& noise = protocol.motion;
  MarkerSeries markers;
  markers.time_s = clock(performance.script().duration_s, noise.rate_hz);
  markers.names = arm.marker_names();
  const Eigen::Index frames = markers.time_s.size();
  math::Random random = stream(seed, "markers", trial.name);
  math::Random shutter = stream(seed, "shutter", trial.name);
  const bool exact = protocol.level == Level::noise_free;

  Eigen::VectorXd q_rad(frames);
  for (Eigen::Index k = 0; k < frames; ++k) {
    double t = markers.time_s(k);
    if (!exact && noise.frame_jitter_sd_s > 0.0) t += noise.frame_jitter_sd_s * shutter.normal();
    q_rad(k) = performance.motion(t).value;
  }
  if (exact) {
    markers.positions_m = arm.markers_m(q_rad, trial.plane);
    return markers;
  }
  markers.positions_m = arm.markers_m(q_rad, trial.plane, instruments.markers);
  for (Eigen::Index k = 0; k < frames; ++k) {
    markers.positions_m.row(k) += noise.marker_sd_m * random.normals(markers.positions_m.cols()).transpose();
  }
  quantize(markers.positions_m, kMarkerSteps_perm);

  // Gaps are a Poisson process: independent of each other, at a mean rate per minute.
  if (noise.dropouts_per_min > 0.0) {
    math::Random hidden = stream(seed, "dropouts", trial.name);
    const double end_s = markers.time_s(frames - 1);
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      double t = 0.0;
      while (true) {
        t -= std::log(1.0 - hidden.uniform()) * 60.0 / noise.dropouts_per_min;
        if (t >= end_s) break;
        const double until_s = t + hidden.uniform(kShortestDropout_s, kLongestDropout_s);
        const auto first = static_cast<Eigen::Index>(std::ceil(t * noise.rate_hz));
        const auto last = std::min(frames - 1, static_cast<Eigen::Index>(until_s * noise.rate_hz));
        for (Eigen::Index k = first; k <= last; ++k)
          markers.positions_m.block<1, 3>(k, 3 * m).setConstant(std::numeric_limits<double>::quiet_NaN());
        t = until_s;
      }
    }
  }
  return markers;
}

TimeSeries record_emg(const Protocol& protocol,
                      const Instruments& instruments,
                      const Performance& performance,
                      const EmgClock& emg_clock,
                      std::uint64_t seed) {
  const TrialScript& script = performance.script();
  const EmgNoise& emg = protocol.emg;
  const Eigen::VectorXd time_s = clock(script.duration_s, emg.rate_hz);
  const Eigen::Index n = time_s.size();
  std::vector<std::size_t> channels_of;
  for (std::size_t m = 0; m < 4; ++m) {
    if (m != kBrachialis || has_brachialis_electrode(protocol)) channels_of.push_back(m);
  }
  std::vector<Channel> channels;
  Eigen::MatrixXd values(n, static_cast<Eigen::Index>(channels_of.size()));

  if (protocol.level == Level::noise_free) {
    for (const std::size_t m : channels_of) channels.push_back({std::string(kArmMuscles[m]), Unit::dimensionless});
    for (Eigen::Index k = 0; k < n; ++k) {
      const PerMuscle u = performance.drive(time_s(k));
      for (std::size_t c = 0; c < channels_of.size(); ++c) values(k, static_cast<Eigen::Index>(c)) = u[channels_of[c]];
    }
    return {time_s, channels, values};
  }

  // Amplitudes of the sources on a coarser clock: four muscles, and the wrist extensors.
  constexpr std::size_t kWrist = 4;
  const double first_s = emg_clock.true_time_s(0.0);
  const double last_s = emg_clock.true_time_s(time_s(n - 1));
  const auto count = static_cast<Eigen::Index>(std::ceil((last_s - first_s) * kEnvelopeRate_hz)) + 2;
  std::array<Source, 5> sources;
  for (Source& source : sources)
    source = {Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd::Zero(count)};
  Eigen::VectorXd speed(count);
  const SensorTruth& sensors = protocol.truth.sensors;
  std::vector<PerMuscle> wandering;
  if (sensors.emg_noise) wandering = wandering_drives(count, stream(seed, "wandering emg", script.protocol.name));
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = first_s + static_cast<double>(k) / kEnvelopeRate_hz;
    const PerMuscle u = sensors.emg_noise ? wandering[static_cast<std::size_t>(k)] : performance.drive(t);
    const PerMuscle fatigued = performance.fatigued(t);
    const double gain = (1.0 + kColdGain * script.cold(t)) * script.emg_gain(t);
    for (std::size_t m = 0; m < 4; ++m) {
      const double p = instruments.exponent[m];
      // At the beginning of an effort the level is 0 up to round-off of either sign.
      sources[m].amplitude(k) = gain * (p == 1.0 ? u[m] : std::pow(std::max(u[m], 0.0), 1.0 / p));
      sources[m].excitation(k) = u[m];
      sources[m].fatigued(k) = fatigued[m];
    }
    sources[kWrist].amplitude(k) = sources[kWrist].excitation(k) =
        std::min(1.0, 0.5 * u[kBiceps] + 0.05 * script.protocol.held_mass_kg);
    speed(k) = performance.motion(t).first;
  }
  const Eigen::VectorXd true_time_s = time_s.unaryExpr([&](double t) { return emg_clock.true_time_s(t); });
  const bool mixed = *std::max_element(instruments.crosstalk.begin(), instruments.crosstalk.end()) > 0.0;

  std::array<Eigen::VectorXd, 5> signals;
  for (std::size_t m = 0; m < signals.size(); ++m) {
    const bool heard = std::find(channels_of.begin(), channels_of.end(), m) != channels_of.end();
    if (!heard && !mixed) continue;
    const std::string name = m == kWrist ? "ECRL" : std::string(kArmMuscles[m]);
    signals[m] = signal_of(sources[m], first_s, true_time_s, emg,
                           m == kWrist ? instruments.spectrum[kBrachioradialis] : instruments.spectrum[m],
                           stream(seed, "emg", script.protocol.name + "." + name));
  }
  const Eigen::VectorXd speed_radps = stretched(speed, first_s, kEnvelopeRate_hz, true_time_s);
  constexpr std::array<std::size_t, 4> kNeighbour = {kBrachialis, kBiceps, kWrist, kTriceps};
  for (std::size_t c = 0; c < channels_of.size(); ++c) {
    const std::size_t m = channels_of[c];
    const std::string name(kArmMuscles[m]);
    channels.push_back({name, Unit::volt});
    Eigen::VectorXd signal = signals[m] + disturbance(emg, instruments.baseline[m], speed_radps,
                                                      stream(seed, "amplifier", script.protocol.name + "." + name));
    if (mixed && kNeighbour[m] != m) signal += instruments.crosstalk[m] * signals[kNeighbour[m]];
    for (const std::size_t other : channels_of) {
      if (sensors.crosstalk > 0.0 && other != m) signal += sensors.crosstalk * signals[other];
    }
    if (emg.bandwidth_hz > 0.0 && emg.bandwidth_hz < 0.49 * emg.rate_hz)
      limit_bandwidth(signal, emg.bandwidth_hz, emg.rate_hz);
    values.col(static_cast<Eigen::Index>(c)) = instruments.greatest_v[m] * signal;
  }
  quantize(values, kEmgSteps_perv);
  return {time_s, channels, values};
}

TimeSeries record_torque(const Protocol& protocol,
                         const Performance& performance,
                         const Eigen::VectorXd& time_s,
                         const Eigen::VectorXd& external_torque_nm,
                         std::uint64_t seed) {
  const SensorTruth& sensors = protocol.truth.sensors;
  Eigen::VectorXd shown = external_torque_nm;
  if (sensors.torque_scale != 1.0 || sensors.torque_offset_nm != 0.0)
    shown = (sensors.torque_scale * shown.array() + sensors.torque_offset_nm).matrix();
  if (protocol.level != Level::noise_free && protocol.torque.sd_nm > 0.0) {
    math::Random random = stream(seed, "torque", performance.script().protocol.name);
    shown += protocol.torque.sd_nm *
             lowpass_noise(protocol.torque.bandwidth_hz, protocol.motion.rate_hz, shown.size(), random);
    quantize(shown, kTorqueSteps_pernm);
  }
  return {time_s, {{"elbow_flexion_moment", Unit::newton_meter}}, shown};
}

TimeSeries record_fascicles(const Protocol& protocol,
                            const Performance& performance,
                            double duration_s,
                            std::uint64_t seed) {
  using namespace fit::beliefs;
  constexpr double kRate_hz = 30.0, kStepsPerMeter = 1e5;
  const auto n = static_cast<Eigen::Index>(duration_s * kRate_hz) + 1;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / kRate_hz);
  const double kept = std::exp(-1.0 / (kRate_hz * kFascicleErrorTime.value)), added = std::sqrt(1.0 - kept * kept);
  Eigen::MatrixXd length_m(n, std::ssize(kArmMuscles));
  std::vector<Channel> channels;
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    const std::string name(kArmMuscles[m]);
    math::Random probe = stream(seed, "ultrasound", name),
                 frames = stream(seed, "fascicle", performance.script().protocol.name + "." + name);
    const double scale = 1.0 + kFascicleScale.sd * probe.normal(), offset_m = kFascicleOffset.sd * probe.normal();
    double error = frames.normal();
    for (Eigen::Index i = 0; i < n; ++i) {
      length_m(i, static_cast<Eigen::Index>(m)) =
          scale * performance.at(time_s[i]).fiber_length_m[m] + offset_m + protocol.truth.sensors.fascicle_sd_m * error;
      error = kept * error + added * frames.normal();
    }
    channels.push_back({name, Unit::meter});
  }
  quantize(length_m, kStepsPerMeter);
  return {time_s, std::move(channels), std::move(length_m)};
}

}  // namespace myoid::lab
