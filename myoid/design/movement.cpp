#include "myoid/design/movement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "myoid/arm/arm4.h"
#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/simulation/random.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

constexpr double kRate_hz = 50.0;
constexpr double kLead_s = 0.4;  ///< Before the trial: more than the longest delay.

double degrees(double rad) { return rad * 180.0 / kPi; }

/// From 0 to 1 with a smooth start and end.
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
      return centre +
             half * std::asin(kSharpness * std::sin(phase - 0.5 * kPi)) / std::asin(kSharpness);
    }
    case MovementKind::lowering: {
      constexpr double kRaise_s = 1.2;
      constexpr double kLower_s = 2.8;
      const double u = t - std::floor(t / (kRaise_s + kLower_s)) * (kRaise_s + kLower_s);
      const double share =
          u < kRaise_s ? smooth(u / kRaise_s) : 1.0 - smooth((u - kRaise_s) / kLower_s);
      return m.lowest_rad + 2.0 * half * share;
    }
  }
  return centre;
}

/// Effort of an isometric trial: two ramps of 2 s up, 1 s held, 2 s down; of an isokinetic one: all
/// the time but for its ends.
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

bool by_device(MovementKind kind) {
  return kind == MovementKind::isometric || kind == MovementKind::isokinetic;
}

/// (x + sqrt(x^2 + e^2)) / 2: positive, smooth, and p(x) - p(-x) = x.
double positive_part(double x, double e) { return 0.5 * (x + std::sqrt(x * x + e * e)); }

/// The EMG channels in the order in which the muscles name them.
std::vector<std::string> channels_of(const std::vector<identification::MuscleSetup>& muscles) {
  std::vector<std::string> channels;
  for (const identification::MuscleSetup& m : muscles) {
    if (std::find(channels.begin(), channels.end(), m.emg_channel) == channels.end())
      channels.push_back(m.emg_channel);
  }
  return channels;
}

/// The proportion in which a channel takes part: a constant and a slow change.
struct Share {
  double mean = 0.0, depth = 0.0, frequency_hz = 0.1, phase = 0.0;

  Share(const MovementPerson& person, const std::string& purpose) {
    simulation::Random random(simulation::seed_for(person.seed, purpose));
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
  const std::string range =
      kind == MovementKind::isometric
          ? fmt::format("{:.0f} deg", degrees(lowest_rad))
          : fmt::format("{:.0f}-{:.0f} deg", degrees(lowest_rad), degrees(highest_rad));
  switch (kind) {
    case MovementKind::swing:
    case MovementKind::lowering:
      return fmt::format("{}{}, {}, {:g} kg, {}", word(kind),
                         kind == MovementKind::swing ? fmt::format(" {:g} Hz", frequency_hz) : "",
                         range, held_mass_kg, horizontal ? "horizontal" : "vertical");
    case MovementKind::isometric:
    case MovementKind::isokinetic:
      return fmt::format("{}{}, {}, {} effort to {:.0f} %", word(kind),
                         kind == MovementKind::isokinetic
                             ? fmt::format(" {:.0f} deg/s", degrees(speed_radps))
                             : "",
                         range, direction, 100.0 * level);
  }
  return "?";
}

std::vector<Movement> movement_catalogue(double lowest_rad,
                                         double highest_rad,
                                         const CatalogueOptions& options) {
  if (!(highest_rad > lowest_rad))
    throw InvalidInput(fmt::format("design: the joint's range is {} to {} rad: nothing can move",
                                   lowest_rad, highest_rad));
  const double margin = 0.1 * (highest_rad - lowest_rad);
  const double low = lowest_rad + margin;
  const double high = highest_rad - margin;
  const double middle = 0.5 * (low + high);
  std::vector<Movement> catalogue;
  for (const bool horizontal : {false, true}) {
    if (horizontal && !options.planes) continue;
    for (const double mass : options.held_masses_kg) {
      for (const double f : options.frequencies_hz) {
        for (const auto& [from, to] :
             {std::pair{low, high}, std::pair{low, middle}, std::pair{middle, high}}) {
          catalogue.push_back({.kind = MovementKind::swing,
                               .horizontal = horizontal,
                               .held_mass_kg = mass,
                               .lowest_rad = from,
                               .highest_rad = to,
                               .frequency_hz = f,
                               .duration_s = std::max(10.0, 3.0 / f)});
        }
      }
      if (mass > 0.0 && !horizontal) {
        for (const double from : {low, low + 0.3 * (high - low)}) {
          catalogue.push_back({.kind = MovementKind::lowering,
                               .held_mass_kg = mass,
                               .lowest_rad = from,
                               .highest_rad = high,
                               .duration_s = 12.0});
        }
      }
    }
  }
  for (const bool positive : {true, false}) {
    for (const double level : options.isometric_levels) {
      for (int i = 0; i < options.angles; ++i) {
        const double angle =
            options.angles == 1 ? middle : low + (high - low) * i / (options.angles - 1);
        catalogue.push_back({.kind = MovementKind::isometric,
                             .lowest_rad = angle,
                             .highest_rad = angle,
                             .level = level,
                             .positive = positive,
                             .direction = direction_name(options.coordinate, positive),
                             .duration_s = 11.0});
      }
    }
    if (!options.dynamometer) continue;
    for (const double speed : options.isokinetic_speeds_radps) {
      catalogue.push_back({.kind = MovementKind::isokinetic,
                           .lowest_rad = low,
                           .highest_rad = high,
                           .speed_radps = speed,
                           .level = options.isokinetic_level,
                           .positive = positive,
                           .direction = direction_name(options.coordinate, positive),
                           .duration_s = std::max(4.0, 2.0 * (high - low) / speed)});
    }
  }
  return catalogue;
}

std::string direction_name(const std::string& coordinate, bool positive) {
  const bool extends = coordinate.find("extension") != std::string::npos;
  if (extends || coordinate.find("flex") != std::string::npos)
    return positive != extends ? "flexion" : "extension";
  return positive ? "positive" : "negative";
}

MovementModels movement_models(const Study& study, const model::BodyModel& given) {
  const bool built_in = !study.model.file && study.model.text.empty();
  const auto in_plane = [&](bool horizontal) {
    Study posed = study;
    posed.model.horizontal = horizontal;
    const bool as_given = !built_in || horizontal == study.model.horizontal;
    model::BodyModel model = as_given ? given : load_model(posed);
    std::erase_if(model.muscles, [&](const model::Muscle& muscle) {
      return std::none_of(study.muscles.begin(), study.muscles.end(), [&](const MuscleSpec& spec) {
        return std::find(spec.osim.begin(), spec.osim.end(), muscle.name) != spec.osim.end();
      });
    });
    return model;
  };
  return {.vertical = in_plane(false), .horizontal = in_plane(true)};
}

MovementCourse movement_course(const Study& study,
                               const MovementModels& models,
                               const Movement& movement) {
  model::BodyModel model = movement.horizontal ? models.horizontal : models.vertical;
  if (movement.held_mass_kg > 0.0) {
    const HeldMassSpec held = held_mass_place(study);
    model =
        dynamics::with_held_mass(std::move(model), held.body, held.p_BP_m, movement.held_mass_kg);
  }
  MovementCourse course;
  course.movement = movement;
  const auto n = static_cast<Eigen::Index>(std::lround((movement.duration_s + kLead_s) * kRate_hz));
  course.time_s = Eigen::VectorXd::LinSpaced(n, -kLead_s, movement.duration_s);
  Eigen::MatrixXd angle(n, 1);
  for (Eigen::Index i = 0; i < n; ++i) angle(i, 0) = angle_at(movement, course.time_s[i]);
  const kinematics::JointMotion motion =
      kinematics::joint_motion(
          model, TimeSeries(course.time_s, {{study.model.coordinate, Unit::radian}}, angle))
          .motion;
  course.muscles = kinematics::lumped_muscles(kinematics::muscle_kinematics(model, motion),
                                              muscle_groups(study, model), study.model.coordinate);
  if (by_device(movement.kind)) {
    course.effort.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) course.effort[i] = effort_at(movement, course.time_s[i]);
  } else {
    const auto& coordinate =
        model.coordinates[static_cast<std::size_t>(model.coordinate_index(study.model.coordinate))];
    course.required_torque_nm = dynamics::inverse_dynamics(model, motion)
                                    .column(dynamics::generalized_force_name(coordinate));
  }
  return course;
}

std::optional<identification::TrialData> perform(
    const MovementCourse& course,
    const std::vector<identification::MuscleSetup>& muscles,
    const MovementPerson& person) {
  const Eigen::Index n = course.time_s.size();
  const auto m = static_cast<Eigen::Index>(muscles.size());
  const std::vector<std::string> channels = channels_of(muscles);
  const auto count = channels.size();
  std::vector<std::size_t> channel_of;
  for (const identification::MuscleSetup& setup : muscles) {
    channel_of.push_back(static_cast<std::size_t>(
        std::find(channels.begin(), channels.end(), setup.emg_channel) - channels.begin()));
  }
  std::vector<Share> shares;
  const std::string description = course.movement.description();
  for (const std::string& channel : channels) shares.emplace_back(person, description + channel);

  Eigen::MatrixXd activation(n, static_cast<Eigen::Index>(count));
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(n);
  std::vector<double> capacity(count);  // torque of a channel at full activation [N m]
  std::vector<double> share(count);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::fill(capacity.begin(), capacity.end(), 0.0);
    for (Eigen::Index k = 0; k < m; ++k) {
      capacity[channel_of[static_cast<std::size_t>(k)]] +=
          course.muscles.moment_arm_m(i, k) *
          identification::tension(1.0, course.muscles.length_m(i, k),
                                  course.muscles.velocity_mps(i, k),
                                  person.muscles[static_cast<std::size_t>(k)])
              .force_n;
    }
    double most_share = 0.0;
    double up = 0.0;  // sum of squares of what the channels can do in either direction
    double down = 0.0;
    double rest = course.effort.size() > 0 ? 0.0 : course.required_torque_nm[i];
    double total = 0.0;
    for (std::size_t c = 0; c < count; ++c) {
      share[c] = shares[c](course.time_s[i]);
      rest -= person.co_contraction * capacity[c];
      total += std::abs(capacity[c]);
      const bool agonist = (capacity[c] > 0.0) == course.movement.positive;
      if (agonist) most_share = std::max(most_share, share[c]);
      (capacity[c] > 0.0 ? up : down) += std::pow(share[c] * capacity[c], 2);
    }
    const double smoothness = up > 0.0 && down > 0.0 ? 0.01 * total : 0.0;
    for (std::size_t c = 0; c < count; ++c) {
      double a = person.co_contraction;
      if (course.effort.size() > 0) {
        const bool agonist = (capacity[c] > 0.0) == course.movement.positive;
        if (agonist) {
          a += (course.movement.level - person.co_contraction) * course.effort[i] * share[c] /
               most_share;
        }
      } else {
        const double pull =
            capacity[c] > 0.0 ? positive_part(rest, smoothness) : positive_part(-rest, smoothness);
        const double power = capacity[c] > 0.0 ? up : down;
        if (power > 0.0) a += share[c] * share[c] * std::abs(capacity[c]) * pull / power;
      }
      if (!(a <= person.most_activation + 1e-12)) return std::nullopt;
      activation(i, static_cast<Eigen::Index>(c)) = a;
      torque[i] += a * capacity[c];
    }
    // Without an antagonist or an agonist the torque asked for is not there.
    if (course.effort.size() == 0 &&
        std::abs(torque[i] - course.required_torque_nm[i]) > 1e-6 * (1.0 + total))
      return std::nullopt;
  }
  const Eigen::Index first =
      std::lower_bound(course.time_s.data(), course.time_s.data() + n, 0.0) - course.time_s.data();
  const Eigen::Index length = n - first;
  identification::TrialData trial;
  trial.name = description;
  trial.time_s = course.time_s.tail(length);
  trial.length_m = course.muscles.length_m.bottomRows(length);
  trial.velocity_mps = course.muscles.velocity_mps.bottomRows(length);
  trial.moment_arm_m = course.muscles.moment_arm_m.bottomRows(length);
  trial.torque_nm = torque.tail(length);
  std::vector<Channel> columns;
  for (const std::string& channel : channels) columns.push_back({channel, Unit::dimensionless});
  trial.activation = TimeSeries(course.time_s.array() - person.emg_delay_s, columns, activation);
  return trial;
}

}  // namespace myoid
