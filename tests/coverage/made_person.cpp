#include "tests/coverage/made_person.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/arm/planar_elbow.h"
#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/density.h"
#include "myoid/ground/math/random.h"

#include "tests/coverage/seen_strength.h"

namespace myoid::test {
namespace {

using namespace fit;

constexpr double kMargin_s = 0.8;  // of the EMG, before and behind the motion
constexpr double kLeastActivation = 0.02, kLogRange = 2.3, kLag_s = 0.15;

/// Draws from the prior of the unknowns within their bounds.
Eigen::VectorXd draw_unknowns(const std::vector<Unknown>& free, math::Random& random) {
  const auto p = static_cast<Eigen::Index>(free.size());
  const Eigen::LLT<Eigen::MatrixXd> precision(
      prior_precision(free, std::exp(beliefs::kUnlikeness.sd * random.normal())));
  for (int i = 0; i < 10000; ++i) {
    Eigen::VectorXd z(p);
    for (Eigen::Index j = 0; j < p; ++j) z[j] = random.normal();
    z = precision.matrixU().solve(z).eval();  // of covariance (U'U)^-1
    bool inside = true;
    for (Eigen::Index j = 0; j < p; ++j) {
      const Unknown& of = free[static_cast<std::size_t>(j)];
      z[j] += of.prior.mean;
      inside = inside && z[j] > of.bounds.lower && z[j] < of.bounds.upper;
    }
    if (inside) return z;
  }
  throw std::runtime_error("no draw of the priors lies within the bounds");
}

/// Weights of a Gaussian low-pass of -3 dB at this frequency.
Eigen::VectorXd gaussian(double cutoff_hz, double rate_hz) {
  const double width = rate_hz * std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * cutoff_hz);
  const auto reach = static_cast<Eigen::Index>(std::ceil(4.0 * width));
  Eigen::VectorXd h(2 * reach + 1);
  for (Eigen::Index i = 0; i < h.size(); ++i)
    h[i] = std::exp(-0.5 * std::pow(static_cast<double>(i - reach) / width, 2));
  return h / h.sum();
}

/// h * x, x longer by the weights' reach on either side.
Eigen::VectorXd filtered(const Eigen::VectorXd& h, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size() - h.size() + 1);
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = h.dot(x.segment(i, h.size()));
  return y;
}

/// A positive process below some hertz, of mean `level` and a relative spread of about a half.
Eigen::VectorXd drive(Eigen::Index n, double level, double cutoff_hz, double rate_hz, math::Random& random) {
  const Eigen::VectorXd h = gaussian(cutoff_hz, rate_hz);
  Eigen::VectorXd shots(n + h.size() - 1);
  const double spread = 0.5 / h.norm();  // of the shots, over their mean
  for (double& s : shots) {
    // Gamma of shape 1/spread^2 < 1, by a rare exponential of the same mean and variance.
    const double share = 2.0 / (1.0 + spread * spread);
    s = random.uniform() < share ? -std::log(1.0 - random.uniform()) / share : 0.0;
  }
  return level * filtered(h, shots);
}

/// Geometry of one trial at its samples.
struct Geometry {
  Eigen::MatrixXd length, velocity, arm;
};

/// The unseen numbers of one muscle.
struct MuscleErrors {
  double arm = 0.0, arm_slope = 0.0, strain = 0.0;
  double shortest = 1e9, longest = -1e9, fastest = 1e-9;  ///< Recorded.
  std::array<double, 7> model{};                          ///< Strength, three of length, effort, speed, lag.
  [[nodiscard]] double place(double l) const { return 2.0 * (l - shortest) / (longest - shortest) - 1.0; }
};

class Maker {
 public:
  explicit Maker(const MadePersonOptions& options)
      : o_(options), random_(options.seed, 17), elbow_(body::planar_elbow()) {
    if (o_.two_muscles) of_arm_ = {0, 3};
  }

  MadePerson make() {
    set_up();
    const ParameterMap map(person_.data, person_.options);
    person_.z = draw_unknowns(map.free(), random_);
    const ModelValues values = map.values(person_.z);
    draw_noise();
    if (o_.of_the_model) {
      crosstalk_ = Eigen::MatrixXd::Identity(muscles(), muscles());
      make_envelopes();
      make_torque_of_the_model(map);
    } else {
      draw_unseen();
      double squares = 0.0, count = 0.0;
      for (std::size_t i = 0; i < person_.data.trials.size(); ++i) {
        make_torque(i, values);
        squares += person_.data.trials[i].torque_nm.squaredNorm();
        count += static_cast<double>(person_.data.trials[i].torque_nm.size());
      }
      finish_torque(std::sqrt(squares / count), values);
      make_envelopes();
    }
    return std::move(person_);
  }

 private:
  [[nodiscard]] Eigen::Index muscles() const { return static_cast<Eigen::Index>(of_arm_.size()); }

  void set_up() {
    const auto start = body::arm4_muscles();
    for (const std::size_t k : of_arm_) {
      MuscleSetup setup;
      setup.name = std::string(elbow_.muscles[k].name);
      setup.emg_channel = setup.name;
      setup.start = start[k];
      setup.priors = literature_priors(start[k]);
      person_.options.state(setup.name).gain_sd = beliefs::kEmgGain.sd;
      person_.options.state(setup.name).bandwidth_hz = o_.emg_bandwidth_hz;
      person_.data.muscles.push_back(setup);
    }
    ParameterRule offset;
    offset.parameter = "joint_torque_offset";
    offset.free = true;
    person_.data.rules.push_back(offset);
    const auto n = static_cast<Eigen::Index>(o_.seconds * o_.rate_hz) + 1;
    const auto margin = static_cast<Eigen::Index>(kMargin_s * o_.rate_hz);
    const Eigen::Index all = n + 2 * margin;
    for (int number = 0; number < o_.trials; ++number) {
      TrialData trial;
      trial.name = "trial" + std::to_string(number + 1);
      trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, o_.seconds);
      trial.torque_nm.setZero(n);
      move(number, trial);
      Eigen::MatrixXd& drives = drives_.emplace_back(all, muscles());
      for (Eigen::Index c = 0; c < muscles(); ++c)
        drives.col(c) = drive(all, 0.12 + 0.25 * random_.uniform(), o_.drive_hz * (1.0 + 2.0 * random_.uniform()) / 3.0,
                              o_.rate_hz, random_);
      trial.activation = record(trial, drives);
      person_.data.trials.push_back(std::move(trial));
    }
  }

  TimeSeries record(const TrialData& trial, const Eigen::MatrixXd& values) const {
    std::vector<Channel> channels;
    for (const MuscleSetup& m : person_.data.muscles) channels.push_back({m.emg_channel, Unit::dimensionless});
    const double more = 0.5 * (static_cast<double>(values.rows() - trial.time_s.size())) / o_.rate_hz;
    return {Eigen::VectorXd::LinSpaced(values.rows(), -more, o_.seconds + more), channels, values};
  }

  /// An elbow between 10 and 125 degrees, at up to some 7 rad/s.
  void move(int number, TrialData& trial) {
    const Eigen::Index n = trial.time_s.size();
    const double w1 = 2.0 * std::numbers::pi * (0.3 + 0.25 * number + 0.1 * random_.uniform());
    const double w2 = 2.0 * std::numbers::pi * (1.0 + 0.3 * random_.uniform());
    const double phase = 2.0 * std::numbers::pi * random_.uniform();
    trial.length_m.resize(n, muscles());
    trial.velocity_mps.resize(n, muscles());
    trial.moment_arm_m.resize(n, muscles());
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = trial.time_s[i];
      const double q = 1.18 + 0.75 * std::sin(w1 * t + phase) + 0.25 * std::sin(w2 * t);
      const double rate = 0.75 * w1 * std::cos(w1 * t + phase) + 0.25 * w2 * std::cos(w2 * t);
      for (Eigen::Index k = 0; k < muscles(); ++k) {
        const body::MuscleTravel travel = body::travel(elbow_.muscles[of_arm_[static_cast<std::size_t>(k)]], q);
        trial.length_m(i, k) = travel.length_m;
        trial.moment_arm_m(i, k) = travel.moment_arm_m;
        trial.velocity_mps(i, k) = -travel.moment_arm_m * rate;
      }
    }
  }

  void draw_noise() {
    NoiseValues& noise = person_.noise;
    noise.setZero(kNoiseFieldCount + o_.trials);
    for (double& log_share : noise.tail(o_.trials)) log_share = beliefs::kTrialTorqueNoise.sd * random_.normal();
    noise[kTorqueSd] =
        std::log(beliefs::kTorqueNoise.value) + beliefs::kTorqueNoise.sd * random_.normal();  // over the torque's size
    noise[kTorqueTime] = std::log(beliefs::kTorqueNoiseTime.value) + beliefs::kTorqueNoiseTime.sd * random_.normal();
    noise[kEmgFactor] = beliefs::kEmgNoise.sd * random_.normal();
    for (int size = kModelErrorSize; size < kNoiseFieldCount; ++size)
      noise[size] = std::log(std::abs(random_.normal()));
    noise[kModelErrorSize] += std::log(beliefs::kModelError.sd);
  }

  void draw_unseen() {
    const auto size = [&](NoiseField field) { return std::exp(person_.noise[field]); };
    const double s = size(kModelErrorSize);
    for (std::size_t k = 0; k < of_arm_.size(); ++k) {
      MuscleErrors& e = errors_.emplace_back();
      const auto column = static_cast<Eigen::Index>(k);
      for (const TrialData& trial : person_.data.trials) {
        e.shortest = std::min(e.shortest, trial.length_m.col(column).minCoeff());
        e.longest = std::max(e.longest, trial.length_m.col(column).maxCoeff());
        e.fastest = std::max(e.fastest, trial.velocity_mps.col(column).cwiseAbs().maxCoeff());
      }
      const double more =
          std::max(0.0, 0.5 * person_.data.muscles[k].start.optimal_fiber_length_m - (e.longest - e.shortest));
      e.shortest -= 0.5 * more;
      e.longest += 0.5 * more;
      e.arm = beliefs::kMomentArm.sd * random_.normal();
      e.arm_slope = size(kArmSlopeSize) * beliefs::kMomentArmSlope.sd * random_.normal();
      e.strain = std::hypot(beliefs::kTendonStretch.value, beliefs::kTendonStretch.sd) * random_.normal();
      for (double& x : e.model) x = s * random_.normal();
      e.model[3] *= 0.5;
      drift_.push_back(size(kGainDriftSize) * beliefs::kGainDrift.sd * random_.normal());
      effort_.push_back(1.0 + beliefs::kVoluntaryEffort.sd * random_.normal());
      rise_and_fall_s_.push_back(size(kRiseAndFallSize) * beliefs::kRiseAndFall.sd * random_.normal());
    }
    crosstalk_ = Eigen::MatrixXd::Identity(muscles(), muscles());
    for (Eigen::Index c = 0; c < muscles(); ++c) {
      for (Eigen::Index other = 0; other < muscles(); ++other)
        if (other != c) crosstalk_(other, c) = size(kCrosstalkSize) * beliefs::kCrossTalk.sd * random_.normal();
    }
  }

  /// Torque of one muscle at one instant.
  static double torque(const TrialData& trial,
                       Eigen::Index i,
                       Eigen::Index k,
                       const Activation& a,
                       const MuscleErrors& e,
                       MuscleValues values) {
    const double l = trial.length_m(i, k), x = e.place(l), span = e.longest - e.shortest;
    const double grown = 1.0 + e.arm + e.arm_slope * x;
    const double length =
        l + e.arm * (l - 0.5 * (e.shortest + e.longest)) + e.arm_slope * 0.25 * span * (x * x - 1.0 / 3.0);
    const double velocity = trial.velocity_mps(i, k) * grown;
    double force = tension_n(a.value, length, velocity, values);
    // The tendon that is held rigid stretches: the fixed point of force and strain.
    for (int pass = 0; pass < 8; ++pass) {
      const double stretch =
          values[kSlack] * e.strain * std::log(1.0 + 5.0 * std::max(0.0, force) / values[kMaxForce]) / std::log(6.0);
      force = 0.5 * (force + tension_n(a.value, length - stretch, velocity, values));
    }
    const double level = std::max(a.value, kLeastActivation);
    const std::array<double, 7> shape{1.0,
                                      x,
                                      1.5 * x * x - 0.5,
                                      2.5 * x * x * x - 1.5 * x,
                                      1.0 + std::log(level) / kLogRange,
                                      trial.velocity_mps(i, k) / e.fastest,
                                      -kLag_s * a.by_field[kDelay] / level};
    double wrong = 1.0;
    for (std::size_t j = 0; j < shape.size(); ++j) wrong += e.model[j] * shape[j];
    return trial.moment_arm_m(i, k) * grown * force * wrong;
  }

  void make_torque(std::size_t number, const ModelValues& values) {
    TrialData& trial = person_.data.trials[number];
    const double place = (static_cast<double>(number) + 0.5) / o_.trials - 0.5;
    const Eigen::VectorXd clock = trial.activation.time_s();
    for (std::size_t k = 0; k < of_arm_.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      ChannelValues channel = values.channels[k];
      channel[kGain] *= effort_[k] * (1.0 + drift_[k] * place);
      std::vector<Activation> a =
          activation(Envelope(clock, drives_[number].col(column)), trial.time_s, channel, EmgLag::delay);
      for (Activation& at : a) at.value = std::max(0.0, at.value + rise_and_fall_s_[k] * std::abs(at.by_field[kDelay]));
      for (Eigen::Index i = 0; i < trial.time_s.size(); ++i)
        trial.torque_nm[i] += torque(trial, i, column, a[static_cast<std::size_t>(i)], errors_[k], values.muscles[k]);
    }
  }

  /// Adds the joint's own torque and the torque's error of relative size, and scales.
  void finish_torque(double size_nm, const ModelValues& values) {
    person_.noise[kTorqueSd] += std::log(size_nm);
    const double s = std::exp(person_.noise[kModelErrorSize]);
    const double slope_nm = s * size_nm * random_.normal();
    const double scale = 1.0 + beliefs::kTorqueScale.sd * random_.normal();
    for (TrialData& trial : person_.data.trials) {
      for (Eigen::Index i = 0; i < trial.time_s.size(); ++i)
        trial.torque_nm[i] = scale * (trial.torque_nm[i] + values.joints[0][kOffset]) +
                             slope_nm * errors_[0].place(trial.length_m(i, 0));
    }
    add_torque_errors();
  }

  void add_torque_errors() {
    const double kept = std::exp(-1.0 / (o_.rate_hz * std::exp(person_.noise[kTorqueTime])));
    for (std::size_t i = 0; i < person_.data.trials.size(); ++i) {
      const double sd =
          std::exp(person_.noise[kTorqueSd] + person_.noise[kNoiseFieldCount + static_cast<Eigen::Index>(i)]);
      double e = sd * random_.normal();
      for (double& t : person_.data.trials[i].torque_nm) {
        t += e;
        e = kept * e + sd * std::sqrt(1.0 - kept * kept) * random_.normal();
      }
    }
  }

  /// The torque of the model at the true unknowns, and every error by the model's own covariance.
  void make_torque_of_the_model(const ParameterMap& map) {
    StudyData& data = person_.data;
    person_.options.max_rate_hz = o_.rate_hz;
    person_.options.unseen.independent_rows = 0.0;  // the made errors are independent
    const std::vector<TrialRun> runs = trial_runs(data, person_.options, map);
    const ModelValues values = map.values(person_.z);
    std::vector<RunEvaluation> at;
    at.reserve(runs.size());
    double squares = 0.0, count = 0.0;
    for (const TrialRun& run : runs) {
      at.emplace_back(run, map, EmgLag::delay, values, nullptr);
      torque_of(run) = at.back().signals().torque_nm;
      squares += at.back().signals().torque_nm.squaredNorm();
      count += static_cast<double>(run.time_s.size());
    }
    person_.noise[kTorqueSd] += 0.5 * std::log(squares / count);
    // The shapes of the joint have the size of the torque: the runs know it now.
    const std::vector<TrialRun> measured = trial_runs(data, person_.options, map);
    const Unseen unseen =
        unseen_quantities(data, person_.options, map, recorded(measured, map.held().muscles), measured, values, at);
    Eigen::VectorXd x(static_cast<Eigen::Index>(unseen.quantities.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const UnseenQuantity& q = unseen.quantities[static_cast<std::size_t>(i)];
      x[i] = q.weight * (q.size ? std::exp(person_.noise[*q.size]) : 1.0) * random_.normal();
    }
    x.array() *= (unseen.growth * log_strength(map, runs, at, unseen, x)).array().exp();
    for (std::size_t r = 0; r < runs.size(); ++r)
      torque_of(runs[r]) += unseen.columns[r] * x + envelope_error(runs[r], at[r]);
    add_torque_errors();
    // The least error, independent behind L: white before.
    const double least_nm = Likelihood::kLeastTorqueError * std::sqrt(squares / count);
    for (const TrialRun& run : runs) {
      for (double& t : torque_of(run)) t += least_nm / run.reduction.weights().norm() * random_.normal();
    }
  }

  /// The samples of the run in the torque of its trial.
  Eigen::VectorBlock<Eigen::VectorXd> torque_of(const TrialRun& run) {
    TrialData& trial = person_.data.trials[static_cast<std::size_t>(run.trial)];
    return trial.torque_nm.segment(first_of(run, trial), run.time_s.size());
  }

  /// e_u: white noise times the sensitivity behind each envelope's filter.
  Eigen::VectorXd envelope_error(const TrialRun& run, const RunEvaluation& at) {
    const Eigen::Index n = run.time_s.size();
    Eigen::VectorXd error = Eigen::VectorXd::Zero(n);
    for (Eigen::Index c = 0; c < run.envelope_sd.size(); ++c) {
      const EnvelopeError& of = run.errors[static_cast<std::size_t>(c)];
      const Eigen::VectorXd h = of.from_white(run.interval_s);
      const Eigen::Index reach = h.size() / 2;
      Eigen::VectorXd white(n + 2 * reach);
      for (Eigen::Index j = 0; j < white.size(); ++j)
        white[j] = random_.normal() * at.signals().by_noise(std::clamp<Eigen::Index>(j - reach, 0, n - 1), c);
      error += std::exp(person_.noise[kEmgFactor]) * run.envelope_sd[c] * std::sqrt(of.share()) * filtered(h, white);
    }
    return error;
  }

  static Eigen::Index first_of(const TrialRun& run, const TrialData& trial) {
    return std::lower_bound(trial.time_s.begin(), trial.time_s.end(), run.time_s[0] - 1e-9) - trial.time_s.begin();
  }

  /// Cross-talk, and white noise times the envelope behind the envelope's filter.
  void make_envelopes() {
    const EnvelopeError error(person_.options.envelope_cutoff_hz, {0.0, 0.0});
    const Eigen::VectorXd h = error.from_white(1.0 / o_.rate_hz);
    const double sd = std::exp(person_.noise[kEmgFactor]) * 0.7555 /
                      std::sqrt(2.0 * o_.emg_bandwidth_hz * 0.4815 / person_.options.envelope_cutoff_hz);
    const Eigen::Index reach = h.size() / 2;
    for (std::size_t i = 0; i < person_.data.trials.size(); ++i) {
      const Eigen::MatrixXd mixed = (drives_[i] * crosstalk_).cwiseMax(1e-4);
      const Eigen::Index n = mixed.rows();
      Eigen::MatrixXd recorded = mixed;
      for (Eigen::Index c = 0; c < mixed.cols(); ++c) {
        Eigen::VectorXd white(n + 2 * reach);
        for (Eigen::Index j = 0; j < white.size(); ++j)
          white[j] = random_.normal() * mixed(std::clamp<Eigen::Index>(j - reach, 0, n - 1), c);
        recorded.col(c) += sd * filtered(h, white);
      }
      person_.data.trials[i].activation = record(person_.data.trials[i], recorded.cwiseMax(0.0));
    }
  }

  MadePersonOptions o_;
  math::Random random_;
  body::PlanarElbow elbow_;
  std::vector<std::size_t> of_arm_ = {0, 1, 2, 3};  ///< The muscles of the arm that are made.
  MadePerson person_;
  std::vector<Eigen::MatrixXd> drives_;  ///< Per trial, instants x channels.
  std::vector<MuscleErrors> errors_;
  std::vector<double> drift_, effort_, rise_and_fall_s_;
  Eigen::MatrixXd crosstalk_;
};

}  // namespace

MadePerson made_person(const MadePersonOptions& options) { return Maker(options).make(); }

}  // namespace myoid::test
