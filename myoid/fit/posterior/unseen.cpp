#include "myoid/fit/posterior/unseen.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::fit {
namespace {

constexpr double kLogRange = 2.3;
constexpr double kLag_s = 0.15;            // a model's relative error of 10 % is a lag of 15 ms
constexpr double kLeastActivation = 0.02;  // least activation whose logarithm is taken
constexpr double kNoneActs = 1e-4;         // least activation that force is divided by
constexpr double kSlopeReach = 0.1;        // of the range of an unknown without a prior
constexpr double kStep = 1e-5;             // of an unknown's range: a difference for a derivative

/// Collects quantities one after the other.
struct Collector {
  const StudyData& data_;
  const UnseenSpreads& spreads_;
  const ParameterMap& map_;
  const Recorded& recorded_;
  const std::vector<TrialRun>& runs_;
  const ModelValues& values_;
  const std::vector<RunEvaluation>& at_;
  const std::vector<Stepped>& steps_;
  std::vector<UnseenQuantity> quantities_ = {};
  std::vector<std::size_t> lags_ = {};                              ///< Per muscle: index of its lag's quantity.
  std::vector<std::vector<Eigen::ArrayXd>> columns_{runs_.size()};  ///< Per run, one for each quantity.
  std::vector<Unseen::Slope> slopes_ = {};
  std::vector<std::vector<Eigen::ArrayXd>> by_slope_{runs_.size()};  ///< Per run, one for each slope.

  void add_geometry(std::size_t k) {
    for (int joint = 0; joint < recorded_.parts.joint_count(); ++joint) {
      if (recorded_.parts.crosses(k, joint)) add_moment_arm(k, joint);
    }
    add_tendon(k);
  }

  /// Adds the factors of the parts of an activation without EMG.
  void add_parts_of_activation(std::size_t k) {
    const auto c = static_cast<std::size_t>(map_.channel_of_muscle(k));
    const std::optional<UnseenActivation>& unseen = map_.unseen_activation(c);
    if (!unseen || !(unseen->part_sd > 0.0)) return;
    const double delay_s = values_.channels[c][kDelay];
    for (std::size_t part = 0; part < unseen->parts.size(); ++part) {
      add(fmt::format("{}.activation_{}", data_.muscles[k].name, part + 1), Source::electrodes, unseen->part_sd);
      quantities_.back().of_session = true;
      multiplies_strength_of(k);
      for_runs(k, [&](const OfMuscle& of, auto column) {
        column += of.torque * share_of_part(of.run.parts[c], part, of.run.time_s, delay_s);
      });
    }
  }

  void add_electrodes() {
    const std::size_t channels = map_.channels().size();
    for (std::size_t c = 0; c < channels; ++c) {
      if (map_.unseen_activation(c)) continue;
      add(map_.channels()[c] + ".gain_drift", Source::electrodes, spreads_.gain_drift, kGainDriftSize);
      quantities_.back().of_session = true;
      for_channel(c, [](const OfMuscle& of, auto column) { column += of.torque * of.run.session; });
      if (spreads_.effort > 0.0) {
        add(map_.channels()[c] + ".effort", Source::electrodes, spreads_.effort);
        for_channel(c, [](const OfMuscle& of, auto column) { column += of.torque; });
        for (std::size_t k = 0; k < data_.muscles.size(); ++k)
          if (map_.channel_of_muscle(k) == static_cast<int>(c)) multiplies_strength_of(k);
      }
      add(map_.channels()[c] + ".rise_and_fall", Source::model, beliefs::kRiseAndFall.sd, kRiseAndFallSize);
      for_channel(c, [&](const OfMuscle& of, auto column) { column += of.torque * earlier(of.at, c).abs(); });
      for (std::size_t other = 0; other < channels; ++other) {
        if (other == c || map_.unseen_activation(other)) continue;
        add(fmt::format("{}.crosstalk_of_{}", map_.channels()[c], map_.channels()[other]), Source::electrodes,
            spreads_.crosstalk, kCrosstalkSize);
        for_channel(c, [&](const OfMuscle& of, auto column) { column += of.torque * alien_share(of.at, c, other); });
      }
    }
  }

  void add_torque_scales() {
    for (const bool device : {false, true}) {
      add(device ? "dynamometer_scale" : "torque_scale", Source::torque_scale, spreads_.torque_scale);
      for (std::size_t k = 0; k < data_.muscles.size(); ++k) multiplies_strength_of(k);
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        const Eigen::VectorXd& all = at_[r].signals().torque_nm;
        const Eigen::VectorXd& own = runs_[r].dynamics_nm.size() > 0 ? runs_[r].dynamics_nm : all;
        columns_[r].back().head(runs_[r].row_count()) = (device ? all - own : own).array();
      }
    }
  }

  /// Adds the errors of the k-th muscle's measured fiber lengths.
  void add_fascicles(std::size_t k) {
    if (!measures_fascicles(data_, k)) return;
    const auto for_fascicle = [&](const auto& lengths) {
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        for (std::size_t i = 0; i < runs_[r].fascicles.size(); ++i) {
          if (runs_[r].fascicles[i] == k)
            columns_[r].back().segment(runs_[r].first_row_of_fascicle(i), runs_[r].time_s.size()) =
                lengths(at_[r].fibers(i));
        }
      }
    };
    add(data_.muscles[k].name + ".fascicle_scale", Source::geometry, spreads_.fascicle_scale);
    quantities_.back().of_session = true;
    for_fascicle([](const FiberRows& fibers) { return fibers.length_m.array().eval(); });
    add(data_.muscles[k].name + ".fascicle_offset", Source::geometry, spreads_.fascicle_offset_m);
    quantities_.back().of_session = true;
    for_fascicle([](const FiberRows& fibers) { return Eigen::ArrayXd::Ones(fibers.length_m.size()).eval(); });
  }

  void add_model_errors(std::size_t k) {
    const std::string& name = data_.muscles[k].name;
    const int channel = map_.channel_of_muscle(k);
    const auto c = static_cast<std::size_t>(channel);
    const Recorded::Range& range = recorded_.muscles[k];
    const auto shape = [&](const char* of_what, double weight, const auto& factor) {
      add(name + ".error_" + of_what, Source::model, weight, kModelErrorSize);
      for_runs(k, [&](const OfMuscle& of, auto column) { column += of.torque * factor(of); });
    };
    const auto place = [&](const OfMuscle& of) { return range.place(of.length); };
    shape("strength", 1.0, [](const OfMuscle&) { return 1.0; });
    multiplies_strength_of(k);
    shape("length_1", 1.0, place);
    // Beyond the recorded lengths the higher polynomials stay at their ends: their own growth there
    // is no belief about muscles.
    const auto inside = [&](const OfMuscle& of) { return place(of).max(-1.0).min(1.0).eval(); };
    shape("length_2", 1.0, [&](const OfMuscle& of) { return (1.5 * inside(of).square() - 0.5).eval(); });
    shape("length_3", 0.5, [&](const OfMuscle& of) { return (2.5 * inside(of).cube() - 1.5 * inside(of)).eval(); });
    if (!is_free(Scope::channel, kExponent, channel) && !is_free(Scope::channel, kShape, channel))
      shape("effort", 1.0, [&](const OfMuscle& of) {
        return (1.0 + activation_of(of.at, c).max(kLeastActivation).log() / kLogRange).eval();
      });
    shape("speed", 1.0, [&](const OfMuscle& of) { return (of.velocity / range.fastest_mps).eval(); });
    shape("lag", 1.0, [&](const OfMuscle& of) { return (kLag_s * earlier(of.at, c)).eval(); });
    lags_.push_back(quantities_.size() - 1);
  }

  /// A free delay takes the lag that its muscles have in common; only the differences are errors.
  void center_lags() {
    for (const Unknown& delay : map_.free()) {
      if (!delay.is(Scope::channel, kDelay)) continue;
      std::vector<std::size_t> shared;
      for (std::size_t k = 0; k < lags_.size(); ++k)
        if (delay.acts_on(map_.channel_of_muscle(k))) shared.push_back(lags_[k]);
      for (auto& columns : columns_) {
        Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(columns.front().size());
        for (const std::size_t lag : shared) mean += columns[lag] / static_cast<double>(shared.size());
        for (const std::size_t lag : shared) columns[lag] -= mean;
      }
      // A number of one muscle moves the mean, too. Only the own lag's change is kept.
      const double kept = 1.0 - 1.0 / static_cast<double>(shared.size());
      for (std::size_t s = 0; s < slopes_.size(); ++s) {
        const auto quantity = static_cast<std::size_t>(slopes_[s].quantity);
        if (std::find(shared.begin(), shared.end(), quantity) == shared.end()) continue;
        for (auto& of_run : by_slope_) of_run[s] *= kept;
      }
    }
  }

  /// Adds a constant and a slope of each joint, scaled by the joint's measured torque.
  void add_joint_errors() {
    const int joints = recorded_.parts.joint_count();
    for (int joint = 0; joint < joints; ++joint) {
      const auto j = static_cast<std::size_t>(joint);
      const std::string name = joints == 1 ? "joint" : map_.joints()[j];
      const double size_nm = recorded_.joint_torque_nm[j];
      if (!is_free(Scope::joint, kOffset, joint)) {
        add(name + ".error_constant", Source::model, 1.0, kModelErrorSize);
        for_joint(joint, [&](const TrialRun&, auto column) { column.setConstant(size_nm); });
      }
      if (is_free(Scope::joint, kStiffness, joint)) continue;
      std::size_t k = 0;
      while (k + 1 < data_.muscles.size() && !recorded_.parts.crosses(k, joint)) ++k;
      add(name + ".error_slope", Source::model, 1.0, kModelErrorSize);
      for_joint(joint, [&](const TrialRun& run, auto column) {
        column = size_nm * recorded_.by_joint[j][k].place(recorded_.parts.of(run.length_m, k, joint).array());
      });
    }
  }

  Unseen take() {
    Unseen unseen{std::move(quantities_), {}, std::move(slopes_), {}, {}};
    unseen.growth.setZero(static_cast<Eigen::Index>(unseen.quantities.size()), map_.size());
    for (Eigen::Index i = 0; i < unseen.growth.rows(); ++i) {
      const std::vector<std::size_t>& muscles = unseen.quantities[static_cast<std::size_t>(i)].strength_of;
      for (const std::size_t k : muscles) {
        for (Eigen::Index j = 0; j < map_.size(); ++j) {
          const Unknown& of = map_.free()[static_cast<std::size_t>(j)];
          if (of.is(Scope::muscle, kMaxForce) && of.acts_on(static_cast<int>(k)))
            unseen.growth(i, j) += 0.5 / static_cast<double>(muscles.size());
        }
      }
    }
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      unseen.columns.push_back(joined(columns_[r], runs_[r].all_rows()));
      unseen.by_slope.push_back(joined(by_slope_[r], runs_[r].all_rows()));
    }
    return unseen;
  }

  /// A muscle at one joint of one run: its torque r F, the derivatives of this torque by length and
  /// rate, and length and rate themselves. Of a measured fascicle r is the change of its length by the force.
  struct OfMuscle {
    const TrialRun& run;
    const RunEvaluation& at;
    int joint;  ///< -1: a fascicle.
    Eigen::ArrayXd torque, by_length, by_velocity, length, velocity;
  };

  static Eigen::MatrixXd joined(const std::vector<Eigen::ArrayXd>& columns, Eigen::Index rows) {
    Eigen::MatrixXd all(rows, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = columns[i].matrix();
    return all;
  }

  static Eigen::ArrayXd activation_of(const RunEvaluation& at, std::size_t channel) {
    const std::vector<Activation>& a = at.activations()[channel];
    Eigen::ArrayXd value(static_cast<Eigen::Index>(a.size()));
    for (Eigen::Index i = 0; i < value.size(); ++i) value[i] = a[static_cast<std::size_t>(i)].value;
    return value;
  }

  /// Returns the share of a channel's activation that cross-talk x makes, over x, at the believed x. Two muscles' EMG
  /// is uncorrelated, so the squares of their envelopes add: e^2 = own^2 + x^2 other^2. Where the own muscle acts,
  /// little of x is left; where it rests, all of e may be the other's.
  [[nodiscard]] Eigen::ArrayXd alien_share(const RunEvaluation& at, std::size_t channel, std::size_t other) const {
    const auto exponent = [&](std::size_t c) { return values_.channels[c][kExponent]; };
    const Eigen::ArrayXd e = activation_of(at, channel).max(kNoneActs).pow(1.0 / exponent(channel)),
                         of_other = activation_of(at, other).max(0.0).pow(1.0 / exponent(other));
    const double x = std::max(spreads_.crosstalk, kNoneActs);
    return (1.0 - (1.0 - (x * of_other / e).square()).max(0.0).pow(0.5 * exponent(channel))) / x;
  }

  /// Returns one part's share of the sum of all parts.
  static Eigen::ArrayXd share_of_part(const std::vector<Envelope>& parts,
                                      std::size_t part,
                                      const Eigen::VectorXd& time_s,
                                      double delay_s) {
    Eigen::ArrayXd share(time_s.size());
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      double sum = 0.0;
      for (const Envelope& each : parts) sum += each.at(time_s[i] - delay_s).value;
      share[i] = parts[part].at(time_s[i] - delay_s).value / std::max(sum, kNoneActs);
    }
    return share;
  }

  /// Returns the change of ln a by an activation that comes earlier [1/s].
  static Eigen::ArrayXd earlier(const RunEvaluation& at, std::size_t channel) {
    const std::vector<Activation>& a = at.activations()[channel];
    Eigen::ArrayXd by_time(static_cast<Eigen::Index>(a.size()));
    for (Eigen::Index i = 0; i < by_time.size(); ++i) {
      const Activation& here = a[static_cast<std::size_t>(i)];
      by_time[i] = -here.by_field[kDelay] / std::max(here.value, kNoneActs);
    }
    return by_time;
  }

  void add_moment_arm(std::size_t k, int joint) {
    const std::string name = data_.muscles[k].name + ".moment_arm",
                      of_joint = recorded_.parts.joint_count() == 1
                                     ? std::string()
                                     : "_of_" + map_.joints()[static_cast<std::size_t>(joint)];
    const Recorded::Range& range = recorded_.by_joint[static_cast<std::size_t>(joint)][k];
    const double mean = 0.5 * (range.shortest_m + range.longest_m);
    const auto own = [&](const OfMuscle& of) { return of.joint == joint ? 1.0 : 0.0; };
    const auto part = [&](const Eigen::MatrixXd& all) {
      return Eigen::ArrayXd(recorded_.parts.of(all, k, joint).array());
    };
    add(name + of_joint, Source::geometry, spreads_.moment_arm);
    multiplies_strength_of(k);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      column += own(of) * of.torque + of.by_length * (part(of.run.length_m) - mean) +
                of.by_velocity * part(of.run.velocity_mps);
    });
    add(name + "_slope" + of_joint, Source::geometry, spreads_.moment_arm_slope, kArmSlopeSize);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      const Eigen::ArrayXd x = range.place(part(of.run.length_m));
      column += own(of) * of.torque * x + of.by_length * 0.25 * range.span_m() * (x.square() - 1.0 / 3.0) +
                of.by_velocity * x * part(of.run.velocity_mps);
    });
  }

  void add_tendon(std::size_t k) {
    const int muscle = static_cast<int>(k);
    const MuscleValues& now = values_.muscles[k];
    if (is_free(Scope::muscle, kTendonStrain, muscle) || !(now[kSlack] > 0.0)) return;
    const double elastic = now[kTendonStrain];
    add(data_.muscles[k].name + ".tendon_strain", Source::geometry,
        elastic > 0.0 ? elastic * beliefs::kTendonStrain.sd : spreads_.tendon_strain);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      const Eigen::ArrayXd force = of.at.muscle(k).force_n.array() / now[kMaxForce];
      column -= of.by_length * now[kSlack] * (1.0 + 5.0 * force).log() / std::log(6.0);
    });
  }

  void add(std::string name, Source source, double weight, std::optional<NoiseField> size = {}) {
    quantities_.push_back({std::move(name), source, weight, size, {}});
    for (std::size_t r = 0; r < runs_.size(); ++r) columns_[r].emplace_back(Eigen::ArrayXd::Zero(runs_[r].all_rows()));
  }

  void multiplies_strength_of(std::size_t k) { quantities_.back().strength_of.push_back(k); }

  /// Returns the part of the present quantity's column in one run that the k-th muscle makes.
  template <typename Fill>
  [[nodiscard]] Eigen::ArrayXd part_of(std::size_t k,
                                       const TrialRun& run,
                                       const RunEvaluation& at,
                                       const Fill& fill) const {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Index n = run.time_s.size();
    const MuscleRows& rows = at.muscle(k);
    Eigen::ArrayXd part = Eigen::ArrayXd::Zero(run.all_rows());
    const auto add_rows = [&](Eigen::Index first, int joint, const auto& arm, const Eigen::ArrayXd& by_length) {
      const OfMuscle of{run,
                        at,
                        joint,
                        arm * rows.force_n.array(),
                        by_length,
                        arm * rows.by_velocity.array(),
                        run.length_m.col(column).array(),
                        run.velocity_mps.col(column).array()};
      fill(of, Eigen::Ref<Eigen::ArrayXd>(part.segment(first, n)));
    };
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      const auto arm = run.arm_m.col(column).segment(run.first_row(j), n).array();
      add_rows(run.first_row(j), run.joints[j], arm, arm * rows.by_length.array());
    }
    for (std::size_t i = 0; i < run.fascicles.size(); ++i) {
      const auto by_force = at.fibers(i).by_force.array();
      if (run.fascicles[i] == k)
        add_rows(run.first_row_of_fascicle(i), -1, by_force,
                 at.fibers(i).by_length.array() + by_force * rows.by_length.array());
    }
    return part;
  }

  [[nodiscard]] bool is_free(Scope scope, int field, int owner) const { return map_.find(scope, field, owner) >= 0; }

  /// Returns the place of the present quantity's slope by the unknown, made where it is missing.
  std::size_t slope_of(Eigen::Index unknown) {
    const auto quantity = static_cast<Eigen::Index>(quantities_.size()) - 1;
    for (std::size_t s = slopes_.size(); s > 0 && slopes_[s - 1].quantity == quantity; --s)
      if (slopes_[s - 1].unknown == unknown) return s - 1;
    const Unknown& of = map_.free()[static_cast<std::size_t>(unknown)];
    slopes_.push_back(
        {quantity, unknown, of.prior.sd > 0.0 ? of.prior.sd : kSlopeReach * (of.bounds.upper - of.bounds.lower)});
    for (std::size_t r = 0; r < runs_.size(); ++r) by_slope_[r].emplace_back(Eigen::ArrayXd::Zero(runs_[r].all_rows()));
    return slopes_.size() - 1;
  }

  /// Adds the k-th muscle's part of the present quantity's column, and the slopes of this part.
  template <typename Fill>
  void for_runs(std::size_t k, const Fill& fill) {
    std::vector<Eigen::ArrayXd> parts;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      parts.push_back(part_of(k, runs_[r], at_[r], fill));
      columns_[r].back() += parts[r];
    }
    for (const Stepped& step : steps_) {
      const Eigen::Index unknown = map_.find(Scope::muscle, step.field, static_cast<int>(k));
      if (unknown < 0) continue;
      std::vector<Eigen::ArrayXd> by_unknown;
      double along = 0.0, size = 0.0;
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        by_unknown.push_back((part_of(k, runs_[r], step.at[r], fill) - parts[r]) / step.step[unknown]);
        along += (parts[r] * by_unknown[r]).sum();
        size += parts[r].square().sum();
      }
      if (!(size > 0.0)) continue;
      const std::size_t s = slope_of(unknown);
      for (std::size_t r = 0; r < runs_.size(); ++r) by_slope_[r][s] += by_unknown[r] - along / size * parts[r];
    }
  }

  template <typename Fill>
  void for_joint(int joint, const Fill& fill) {
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const TrialRun& run = runs_[r];
      for (std::size_t j = 0; j < run.joints.size(); ++j) {
        if (run.joints[j] == joint)
          fill(run, Eigen::Ref<Eigen::ArrayXd>(columns_[r].back().segment(run.first_row(j), run.time_s.size())));
      }
    }
  }

  template <typename Fill>
  void for_channel(std::size_t c, const Fill& fill) {
    for (std::size_t k = 0; k < data_.muscles.size(); ++k) {
      if (map_.channel_of_muscle(k) == static_cast<int>(c)) for_runs(k, fill);
    }
  }
};

}  // namespace

std::vector<Stepped> steps_from(const Eigen::VectorXd& z,
                                const ParameterMap& map,
                                EmgLag lag,
                                const std::vector<TrialRun>& runs) {
  std::vector<Stepped> steps;
  for (std::size_t j = 0; j < map.free().size(); ++j) {
    const Unknown& of = map.free()[j];
    if (of.field->scope != Scope::muscle || of.field->field == kMaxForce) continue;
    auto at = std::find_if(steps.begin(), steps.end(), [&](const Stepped& s) { return s.field == of.field->field; });
    if (at == steps.end()) at = steps.insert(at, {of.field->field, Eigen::VectorXd::Zero(z.size()), {}});
    at->step[static_cast<Eigen::Index>(j)] = kStep * (of.bounds.upper - of.bounds.lower);
  }
  parallel_ranges(steps.size(), std::size_t{1}, [&](const auto& range) {
    for (std::size_t s = range.begin(); s < range.end(); ++s) {
      const ModelValues values = map.values(z + steps[s].step);
      for (const TrialRun& run : runs) steps[s].at.emplace_back(run, map, lag, values, nullptr);
    }
  });
  return steps;
}

Unseen unseen_quantities(const StudyData& data,
                         const EstimatorOptions& options,
                         const ParameterMap& map,
                         const Recorded& recorded,
                         const std::vector<TrialRun>& runs,
                         const ModelValues& values,
                         const std::vector<RunEvaluation>& at,
                         const std::vector<Stepped>& steps) {
  Collector collector{data, options.unseen, map, recorded, runs, values, at, steps};
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    collector.add_geometry(k);
    collector.add_model_errors(k);
    collector.add_fascicles(k);
    collector.add_parts_of_activation(k);
  }
  collector.center_lags();
  collector.add_electrodes();
  collector.add_torque_scales();
  collector.add_joint_errors();
  return collector.take();
}

}  // namespace myoid::fit
