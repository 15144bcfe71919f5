#include "myoid/run/design/movement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

constexpr double kRate_hz = 50.0;
constexpr double kLead_s = 0.4;  ///< lead before the trial, longer than the longest delay

double degrees(double rad) { return rad * 180.0 / kPi; }

/// Rises from 0 to 1 with a smooth start and end.
double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

double angle_at(const Movement& m, double t) {
  const double centre = 0.5 * (m.lowest_rad + m.highest_rad);
  const double half = 0.5 * (m.highest_rad - m.lowest_rad);
  switch (m.kind) {
    case MovementKind::isometric:
      return m.lowest_rad;
    case MovementKind::swing:
      return centre - half * std::cos(2.0 * kPi * m.frequency_hz * t);
    case MovementKind::isokinetic: {
      // A triangular wave with its corners rounded: constant speed over most of the range.
      constexpr double kSharpness = 0.98;
      const double phase = kPi * m.speed_radps * t / (m.highest_rad - m.lowest_rad);
      return centre + half * std::asin(kSharpness * std::sin(phase - 0.5 * kPi)) / std::asin(kSharpness);
    }
    case MovementKind::lowering: {
      constexpr double kRaise_s = 1.2;
      constexpr double kLower_s = 2.8;
      const double u = t - std::floor(t / (kRaise_s + kLower_s)) * (kRaise_s + kLower_s);
      const double share = u < kRaise_s ? smooth(u / kRaise_s) : 1.0 - smooth((u - kRaise_s) / kLower_s);
      return m.lowest_rad + 2.0 * half * share;
    }
  }
  return centre;
}

/// Returns the effort of an isometric trial (two ramps of 2 s up, 1 s held, 2 s down) or of an
/// isokinetic one (constant except at the ends).
double effort_at(const Movement& m, double t) {
  if (m.kind == MovementKind::isokinetic) return smooth(t / 0.5) * smooth((m.duration_s - t) / 0.5);
  constexpr double kCycle_s = 5.5;
  const double u = t - std::floor(t / kCycle_s) * kCycle_s;
  return t < 0.0 ? 0.0 : smooth(u / 2.0) * smooth((5.0 - u) / 2.0);
}

std::string_view word(MovementKind kind) {
  switch (kind) {
    case MovementKind::swing:
      return "swing";
    case MovementKind::lowering:
      return "lowering";
    case MovementKind::isometric:
      return "isometric";
    case MovementKind::isokinetic:
      return "isokinetic";
  }
  return "?";
}

bool by_device(MovementKind kind) { return kind == MovementKind::isometric || kind == MovementKind::isokinetic; }

/// Returns (x + sqrt(x^2 + e^2)) / 2 = p(x): positive, smooth, and p(x) - p(-x) = x.
double positive_part(double x, double e) { return 0.5 * (x + std::sqrt(x * x + e * e)); }

/// Returns the EMG channels in the order in which the muscles name them.
std::vector<std::string> channels_of(const std::vector<fit::MuscleSetup>& muscles) {
  std::vector<std::string> channels;
  for (const fit::MuscleSetup& m : muscles) {
    if (m.unseen)
      throw InvalidInput(
          fmt::format("[[muscle]] {}: found without_emg, expected emg: a movement is planned for muscles "
                      "whose activation is known",
                      m.name));
    if (std::ranges::find(channels, m.emg_channel) == channels.end()) channels.push_back(m.emg_channel);
  }
  return channels;
}

/// A channel's proportion of the effort: a constant and a slow change.
struct Share {
  double mean = 0.0, depth = 0.0, frequency_hz = 0.1, phase = 0.0;

  Share(const MovementPerson& person, const std::string& purpose) {
    math::Random random(math::seed_for(person.seed, purpose));
    mean = person.synergy * std::numbers::sqrt2 / 2.0 * random.normal();
    depth = person.synergy;  // a sinusoid of this depth has half the variance
    frequency_hz = random.uniform(0.05, 0.25);
    phase = random.uniform(0.0, 2.0 * kPi);
  }
  [[nodiscard]] double operator()(double t) const {
    return std::exp(mean + depth * std::cos(2.0 * kPi * frequency_hz * t + phase));
  }
};

}  // namespace

std::string Movement::description() const {
  const std::string range = kind == MovementKind::isometric
                                ? fmt::format("{:.0f} deg", degrees(lowest_rad))
                                // A dash before a minus is no range for a reader.
                                : fmt::format("{:.0f}{}{:.0f} deg", degrees(lowest_rad),
                                              degrees(lowest_rad) < 0.0 ? " to " : "-", degrees(highest_rad));
  switch (kind) {
    case MovementKind::swing:
    case MovementKind::lowering:
      return fmt::format("{}{}, {}, {:g} kg, {}", word(kind),
                         kind == MovementKind::swing ? fmt::format(" {:g} Hz", frequency_hz) : "", range, held_mass_kg,
                         horizontal ? "horizontal" : "vertical");
    case MovementKind::isometric:
    case MovementKind::isokinetic:
      return fmt::format("{}{}, {}, {} effort to {:.0f} %", word(kind),
                         kind == MovementKind::isokinetic ? fmt::format(" {:.0f} deg/s", degrees(speed_radps)) : "",
                         range, direction, 100.0 * level);
  }
  return "?";
}

namespace {

/// A joint's range without a tenth at either end.
struct UsedRange {
  double low_rad = 0.0, high_rad = 0.0;
  [[nodiscard]] double middle_rad() const { return 0.5 * (low_rad + high_rad); }
};

/// Returns swings, and slow lowerings of a held mass: movements without a device.
std::vector<Movement> free_movements(const UsedRange& range, const CatalogueOptions& options) {
  const double low = range.low_rad, middle = range.middle_rad(), high = range.high_rad;
  std::vector<Movement> movements;
  for (const bool horizontal : {false, true}) {
    if (horizontal && !options.planes) continue;
    for (const double mass : options.held_masses_kg) {
      for (const double f : options.frequencies_hz) {
        for (const auto& [from, to] : {std::pair{low, high}, std::pair{low, middle}, std::pair{middle, high}}) {
          movements.push_back({.kind = MovementKind::swing,
                               .horizontal = horizontal,
                               .held_mass_kg = mass,
                               .lowest_rad = from,
                               .highest_rad = to,
                               .frequency_hz = f,
                               .duration_s = std::max(10.0, 3.0 / f)});
        }
      }
      if (!(mass > 0.0) || horizontal) continue;
      for (const double from : {low, low + 0.3 * (high - low)}) {
        movements.push_back({.kind = MovementKind::lowering,
                             .held_mass_kg = mass,
                             .lowest_rad = from,
                             .highest_rad = high,
                             .duration_s = 12.0});
      }
    }
  }
  return movements;
}

/// Returns isometric contractions and, with a dynamometer, movements of constant speed, in one direction.
std::vector<Movement> movements_on_device(bool positive, const UsedRange& range, const CatalogueOptions& options) {
  const double low = range.low_rad, high = range.high_rad;
  const std::string direction = direction_name(options.coordinate, positive);
  std::vector<Movement> movements;
  for (const double level : {0.4, 0.8}) {
    for (int i = 0; i < options.angles; ++i) {
      const double angle = options.angles == 1 ? range.middle_rad() : low + (high - low) * i / (options.angles - 1);
      movements.push_back({.kind = MovementKind::isometric,
                           .lowest_rad = angle,
                           .highest_rad = angle,
                           .level = level,
                           .positive = positive,
                           .direction = direction,
                           .duration_s = 11.0});
    }
  }
  if (!options.dynamometer) return movements;
  for (const double speed : {0.52, 1.57, 3.14}) {  // 30, 90, 180 deg/s
    movements.push_back({.kind = MovementKind::isokinetic,
                         .lowest_rad = low,
                         .highest_rad = high,
                         .speed_radps = speed,
                         .level = 0.6,
                         .positive = positive,
                         .direction = direction,
                         .duration_s = std::max(4.0, 2.0 * (high - low) / speed)});
  }
  return movements;
}

}  // namespace

std::vector<Movement> movement_catalogue(double lowest_rad, double highest_rad, const CatalogueOptions& options) {
  if (!(highest_rad > lowest_rad))
    throw InvalidInput(
        fmt::format("design: the joint's range is {} to {} rad: nothing can move", lowest_rad, highest_rad));
  const double margin = 0.1 * (highest_rad - lowest_rad);
  const UsedRange range{.low_rad = lowest_rad + margin, .high_rad = highest_rad - margin};
  std::vector<Movement> catalogue = free_movements(range, options);
  for (const bool positive : {true, false}) {
    for (Movement& movement : movements_on_device(positive, range, options)) catalogue.push_back(std::move(movement));
  }
  return catalogue;
}

std::string direction_name(const std::string& coordinate, bool positive) {
  const bool extends = coordinate.find("extension") != std::string::npos;
  if (extends || coordinate.find("flex") != std::string::npos) return positive != extends ? "flexion" : "extension";
  return positive ? "positive" : "negative";
}

MovementModels movement_models(const study::Study& study, const body::BodyModel& given) {
  const bool built_in = study.model.is_arm();
  const auto in_plane = [&](bool horizontal) {
    study::Study posed = study;
    posed.model.horizontal = horizontal;
    const bool as_given = !built_in || horizontal == study.model.horizontal;
    body::BodyModel model = as_given ? given : study::load_model(posed);
    std::erase_if(model.muscles, [&](const body::Muscle& muscle) {
      return std::ranges::none_of(study.muscles, [&](const study::MuscleSpec& spec) {
        return std::ranges::find(spec.osim, muscle.name) != spec.osim.end();
      });
    });
    return model;
  };
  return {.vertical = in_plane(false), .horizontal = in_plane(true)};
}

MovementCourse movement_course(const study::Study& study, const MovementModels& models, const Movement& movement) {
  body::BodyModel model = movement.horizontal ? models.horizontal : models.vertical;
  if (movement.held_mass_kg > 0.0) {
    const study::HeldMassSpec held = study::held_mass_place(study);
    model = body::with_held_mass(std::move(model), held.body, held.p_BP_m, movement.held_mass_kg);
  }
  MovementCourse course;
  course.movement = movement;
  const auto n = static_cast<Eigen::Index>(std::lround((movement.duration_s + kLead_s) * kRate_hz));
  course.time_s = Eigen::VectorXd::LinSpaced(n, -kLead_s, movement.duration_s);
  Eigen::MatrixXd angle(n, 1);
  for (Eigen::Index i = 0; i < n; ++i) angle(i, 0) = angle_at(movement, course.time_s[i]);
  const body::JointMotion motion =
      body::joint_motion(model, TimeSeries(course.time_s, {{study.model.coordinate, Unit::radian}}, angle)).motion;
  course.muscles = body::lumped_muscles(body::muscle_kinematics(model, motion), study::muscle_groups(study, model),
                                        study.model.coordinate);
  if (by_device(movement.kind)) {
    course.effort.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) course.effort[i] = effort_at(movement, course.time_s[i]);
  } else {
    const auto& coordinate =
        model.coordinates[static_cast<std::size_t>(model.coordinate_index(study.model.coordinate))];
    course.required_torque_nm = body::inverse_dynamics(model, motion).column(body::generalized_force_name(coordinate));
  }
  return course;
}

namespace {

/// The EMG channels at one sample of a movement.
struct Demand {
  std::vector<double> capacity_nm;  ///< Torque of each channel's muscles at full activation.
  std::vector<double> share;        ///< Part of each channel in the effort.
  double rest_nm = 0.0;             ///< Required torque beyond the torque of the co-contraction.
  double total_nm = 0.0;            ///< Sum of |capacity|.
  double most_share = 0.0;          ///< Largest share of the agonists.
  double up = 0.0, down = 0.0;      ///< Sums of (share capacity)² in either direction.
};

/// Returns true if a channel pulls in the direction of the movement.
bool is_agonist(double capacity_nm, const MovementCourse& course) {
  return (capacity_nm > 0.0) == course.movement.positive;
}

/// Returns the torque of every channel's muscles at full activation at sample i [N m].
std::vector<double> capacities(const MovementCourse& course,
                               const MovementPerson& person,
                               const std::vector<std::size_t>& channel_of,
                               std::size_t channels,
                               Eigen::Index i) {
  std::vector<double> capacity_nm(channels, 0.0);
  for (std::size_t muscle = 0; muscle < channel_of.size(); ++muscle) {
    const auto k = static_cast<Eigen::Index>(muscle);
    capacity_nm[channel_of[muscle]] +=
        course.muscles.moment_arm_m(i, k) *
        fit::tension(1.0, course.muscles.length_m(i, k), course.muscles.velocity_mps(i, k), person.muscles[muscle])
            .force_n;
  }
  return capacity_nm;
}

Demand demand_of(const MovementCourse& course,
                 const MovementPerson& person,
                 std::vector<double> capacity_nm,
                 std::vector<double> share,
                 Eigen::Index i) {
  Demand d;
  d.rest_nm = course.effort.size() > 0 ? 0.0 : course.required_torque_nm[i];
  for (std::size_t c = 0; c < capacity_nm.size(); ++c) {
    d.rest_nm -= person.co_contraction * capacity_nm[c];
    d.total_nm += std::abs(capacity_nm[c]);
    if (is_agonist(capacity_nm[c], course)) d.most_share = std::max(d.most_share, share[c]);
    (capacity_nm[c] > 0.0 ? d.up : d.down) += std::pow(share[c] * capacity_nm[c], 2);
  }
  d.capacity_nm = std::move(capacity_nm);
  d.share = std::move(share);
  return d;
}

/// Returns the activation of channel c at sample i that meets the demand.
double activation_of(
    const Demand& d, std::size_t c, const MovementCourse& course, const MovementPerson& person, Eigen::Index i) {
  const double capacity = d.capacity_nm[c];
  double a = person.co_contraction;
  if (course.effort.size() > 0) {
    if (is_agonist(capacity, course)) {
      a += (course.movement.level - person.co_contraction) * course.effort[i] * d.share[c] / d.most_share;
    }
    return a;
  }
  const double smoothness = d.up > 0.0 && d.down > 0.0 ? 0.01 * d.total_nm : 0.0;
  const double pull = capacity > 0.0 ? positive_part(d.rest_nm, smoothness) : positive_part(-d.rest_nm, smoothness);
  const double power = capacity > 0.0 ? d.up : d.down;
  if (power > 0.0) a += d.share[c] * d.share[c] * std::abs(capacity) * pull / power;
  return a;
}

/// Returns the samples from time 0 on as a trial; the EMG leads the torque by the person's delay.
fit::TrialData recorded_trial(const MovementCourse& course,
                              const MovementPerson& person,
                              const std::vector<std::string>& channels,
                              const Eigen::MatrixXd& activation,
                              const Eigen::VectorXd& torque_nm) {
  const Eigen::Index n = course.time_s.size();
  const Eigen::Index first =
      std::lower_bound(course.time_s.data(), course.time_s.data() + n, 0.0) - course.time_s.data();
  const Eigen::Index length = n - first;
  fit::TrialData trial;
  trial.name = course.movement.description();
  trial.time_s = course.time_s.tail(length);
  trial.length_m = course.muscles.length_m.bottomRows(length);
  trial.velocity_mps = course.muscles.velocity_mps.bottomRows(length);
  trial.moment_arm_m = course.muscles.moment_arm_m.bottomRows(length);
  trial.torque_nm = torque_nm.tail(length);
  // A device that measures the torque carries the limb's weight.
  if (by_device(course.movement.kind)) trial.dynamics_nm.setZero(length);
  std::vector<Channel> columns;
  for (const std::string& channel : channels) columns.push_back({channel, Unit::dimensionless});
  trial.activation = TimeSeries(course.time_s.array() - person.emg_delay_s, columns, activation);
  return trial;
}

}  // namespace

std::optional<fit::TrialData> perform(const MovementCourse& course,
                                      const std::vector<fit::MuscleSetup>& muscles,
                                      const MovementPerson& person) {
  const Eigen::Index n = course.time_s.size();
  const std::vector<std::string> channels = channels_of(muscles);
  std::vector<std::size_t> channel_of;
  for (const fit::MuscleSetup& setup : muscles) {
    channel_of.push_back(static_cast<std::size_t>(std::ranges::find(channels, setup.emg_channel) - channels.begin()));
  }
  std::vector<Share> shares;
  const std::string description = course.movement.description();
  for (const std::string& channel : channels) shares.emplace_back(person, description + channel);

  Eigen::MatrixXd activation(n, static_cast<Eigen::Index>(channels.size()));
  Eigen::VectorXd torque_nm = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<double> share;
    for (const Share& of : shares) share.push_back(of(course.time_s[i]));
    const Demand demand =
        demand_of(course, person, capacities(course, person, channel_of, channels.size(), i), std::move(share), i);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const double a = activation_of(demand, c, course, person, i);
      if (!(a <= person.most_activation + 1e-12)) return std::nullopt;
      activation(i, static_cast<Eigen::Index>(c)) = a;
      torque_nm[i] += a * demand.capacity_nm[c];
    }
    // Without an antagonist or an agonist the muscles cannot produce the required torque.
    if (course.effort.size() == 0 &&
        std::abs(torque_nm[i] - course.required_torque_nm[i]) > 1e-6 * (1.0 + demand.total_nm))
      return std::nullopt;
  }
  return recorded_trial(course, person, channels, activation, torque_nm);
}

}  // namespace myoid::run
