#include "myoid/posterior/unseen.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/beliefs/beliefs.h"
#include "myoid/identification/muscle_law.h"
#include "myoid/intervals/held_tendon.h"

namespace myoid::identification {
namespace {

constexpr double kLogRange = 2.3;
constexpr double kLag_s = 0.15;            // a model's relative error of 10 % is a lag of 15 ms
constexpr double kLeastActivation = 0.02;  // of the logarithm
constexpr double kNoneActs = 1e-4;         // force over activation is finite down to it

bool is_free(const ParameterMap& map, Scope scope, int field, int owner) {
  return std::any_of(map.free().begin(), map.free().end(),
                     [&](const Unknown& p) { return p.is(scope, field) && p.acts_on(owner); });
}

/// Collects quantities one after the other.
class Collector {
 public:
  Collector(const StudyData& data,
            const UnseenSpreads& spreads,
            const ParameterMap& map,
            const Recorded& recorded,
            const std::vector<TrialRun>& runs,
            const ModelValues& values,
            const std::vector<RunEvaluation>& at)
      : data_(data),
        spreads_(spreads),
        map_(map),
        recorded_(recorded),
        runs_(runs),
        values_(values),
        at_(at),
        columns_(runs.size()) {}

  void add_geometry(std::size_t k, bool priors) {
    const std::string& name = data_.muscles[k].name;
    const Recorded::Range& range = recorded_.muscles[k];
    const double mean = 0.5 * (range.shortest_m + range.longest_m);
    add(name + ".moment_arm", Source::geometry, spreads_.moment_arm);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      column += of.torque + of.by_length * (of.length - mean) + of.by_velocity * of.velocity;
    });
    add(name + ".moment_arm_slope", Source::geometry, spreads_.moment_arm_slope);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      const Eigen::ArrayXd x = range.place(of.length);
      column += of.torque * x + of.by_length * 0.25 * range.span_m() * (x.square() - 1.0 / 3.0) +
                of.by_velocity * x * of.velocity;
    });
    add_tendon(k, priors);
  }

  void add_electrodes() {
    const std::size_t channels = map_.channels().size();
    for (std::size_t c = 0; c < channels; ++c) {
      add(map_.channels()[c] + ".gain_drift", Source::electrodes, spreads_.gain_drift);
      for_channel(c, [](const OfMuscle& of, auto column) { column += of.torque * of.run.session; });
      add(map_.channels()[c] + ".rise_and_fall", Source::model, beliefs::kRiseAndFall.sd);
      for_channel(c, [&](const OfMuscle& of, auto column) {
        column += of.torque * earlier(of.at, c).abs();
      });
      for (std::size_t other = 0; other < channels; ++other) {
        if (other == c) continue;
        add(fmt::format("{}.crosstalk_of_{}", map_.channels()[c], map_.channels()[other]),
            Source::electrodes, spreads_.crosstalk);
        for_channel(c, [&](const OfMuscle& of, auto column) {
          column +=
              of.torque * activation_of(of.at, other) / activation_of(of.at, c).max(kNoneActs);
        });
      }
    }
  }

  void add_torque_scale() {
    add("torque_scale", Source::torque_scale, spreads_.torque_scale);
    for (std::size_t r = 0; r < runs_.size(); ++r)
      columns_[r].back() = at_[r].signals().torque_nm.array();
  }

  void add_model_errors(std::size_t k) {
    const std::string& name = data_.muscles[k].name;
    const int channel = map_.channel_of_muscle(k);
    const auto c = static_cast<std::size_t>(channel);
    const Recorded::Range& range = recorded_.muscles[k];
    const auto shape = [&](const char* of_what, double weight, const auto& factor) {
      add(name + ".error_" + of_what, Source::model, weight, true);
      for_runs(k, [&](const OfMuscle& of, auto column) { column += of.torque * factor(of); });
    };
    const auto place = [&](const OfMuscle& of) { return range.place(of.length); };
    shape("strength", 1.0, [](const OfMuscle&) { return 1.0; });
    shape("length_1", 1.0, place);
    shape("length_2", 1.0,
          [&](const OfMuscle& of) { return (1.5 * place(of).square() - 0.5).eval(); });
    shape("length_3", 0.5,
          [&](const OfMuscle& of) { return (2.5 * place(of).cube() - 1.5 * place(of)).eval(); });
    if (!is_free(map_, Scope::channel, kExponent, channel) &&
        !is_free(map_, Scope::channel, kShape, channel))
      shape("effort", 1.0, [&](const OfMuscle& of) {
        return (1.0 + activation_of(of.at, c).max(kLeastActivation).log() / kLogRange).eval();
      });
    shape("speed", 1.0,
          [&](const OfMuscle& of) { return (of.velocity / range.fastest_mps).eval(); });
    shape("lag", 1.0, [&](const OfMuscle& of) { return (kLag_s * earlier(of.at, c)).eval(); });
    lags_.push_back(quantities_.size() - 1);
  }

  /// A delay that is free takes the lag that its muscles have in common: the model errs by the
  /// rest.
  void center_lags() {
    for (const Unknown& delay : map_.free()) {
      if (!delay.is(Scope::channel, kDelay)) continue;
      std::vector<std::size_t> shared;
      for (std::size_t k = 0; k < lags_.size(); ++k)
        if (delay.acts_on(map_.channel_of_muscle(k))) shared.push_back(lags_[k]);
      for (auto& columns : columns_) {
        Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(columns.front().size());
        for (const std::size_t lag : shared)
          mean += columns[lag] / static_cast<double>(shared.size());
        for (const std::size_t lag : shared) columns[lag] -= mean;
      }
    }
  }

  /// A constant and a slope of the joint, of the size of the measured torque.
  void add_joint_errors() {
    const double size_nm = recorded_.torque_nm;
    if (!is_free(map_, Scope::joint, kOffset, 0)) {
      add("joint.error_constant", Source::model, 1.0, true);
      for (auto& columns : columns_) columns.back().setConstant(size_nm);
    }
    if (!is_free(map_, Scope::joint, kStiffness, 0)) {
      add("joint.error_slope", Source::model, 1.0, true);
      for (std::size_t r = 0; r < runs_.size(); ++r)
        columns_[r].back() = size_nm * recorded_.muscles[0].place(runs_[r].length_m.col(0));
    }
  }

  Unseen take() {
    Unseen unseen{std::move(quantities_), {}};
    for (const auto& columns : columns_) {
      Eigen::MatrixXd& s = unseen.columns.emplace_back(columns.front().size(), columns.size());
      for (std::size_t i = 0; i < columns.size(); ++i)
        s.col(static_cast<Eigen::Index>(i)) = columns[i].matrix();
    }
    return unseen;
  }

 private:
  /// A muscle in one run: its torque r F, how that changes with length and rate, and both.
  struct OfMuscle {
    const TrialRun& run;
    const RunEvaluation& at;
    Eigen::ArrayXd torque, by_length, by_velocity, length, velocity;
  };

  static Eigen::ArrayXd activation_of(const RunEvaluation& at, std::size_t channel) {
    const std::vector<Activation>& a = at.activations()[channel];
    Eigen::ArrayXd value(static_cast<Eigen::Index>(a.size()));
    for (Eigen::Index i = 0; i < value.size(); ++i) value[i] = a[static_cast<std::size_t>(i)].value;
    return value;
  }

  /// Change of ln a by an activation that comes earlier [1/s].
  static Eigen::ArrayXd earlier(const RunEvaluation& at, std::size_t channel) {
    const std::vector<Activation>& a = at.activations()[channel];
    Eigen::ArrayXd by_time(static_cast<Eigen::Index>(a.size()));
    for (Eigen::Index i = 0; i < by_time.size(); ++i) {
      const Activation& here = a[static_cast<std::size_t>(i)];
      by_time[i] = -here.by_field[kDelay] / std::max(here.value, kNoneActs);
    }
    return by_time;
  }

  void add_tendon(std::size_t k, bool priors) {
    const int muscle = static_cast<int>(k);
    const MuscleSetup& setup = data_.muscles[k];
    const double slack_sd_m =
        priors && !is_free(map_, Scope::muscle, kSlack, muscle) ? held_slack_sd_m(data_, k) : 0.0;
    if (slack_sd_m > 0.0) {
      add(setup.name + ".tendon_slack_length", Source::geometry, slack_sd_m);
      for_runs(k, [](const OfMuscle& of, auto column) { column -= of.by_length; });
    }
    const MuscleValues& now = values_.muscles[k];
    if (is_free(map_, Scope::muscle, kTendonStrain, muscle) || !(now[kSlack] > 0.0)) return;
    const double elastic = now[kTendonStrain];
    add(setup.name + ".tendon_strain", Source::geometry,
        elastic > 0.0 ? elastic * beliefs::kTendonStrain.sd : spreads_.tendon_strain);
    for_runs(k, [&](const OfMuscle& of, auto column) {
      const Eigen::ArrayXd force = of.at.muscle(k).force_n.array() / now[kMaxForce];
      column -= of.by_length * now[kSlack] * (1.0 + 5.0 * force).log() / std::log(6.0);
    });
  }

  void add(std::string name, Source source, double weight, bool of_the_model = false) {
    quantities_.push_back({std::move(name), source, weight, of_the_model});
    for (std::size_t r = 0; r < runs_.size(); ++r)
      columns_[r].emplace_back(Eigen::ArrayXd::Zero(runs_[r].time_s.size()));
  }

  template <typename Fill>
  void for_runs(std::size_t k, const Fill& fill) {
    const auto column = static_cast<Eigen::Index>(k);
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const MuscleRows& rows = at_[r].muscle(k);
      const auto arm = runs_[r].arm_m.col(column).array();
      const OfMuscle of{runs_[r],
                        at_[r],
                        arm * rows.force_n.array(),
                        arm * rows.by_length.array(),
                        arm * rows.by_velocity.array(),
                        runs_[r].length_m.col(column).array(),
                        runs_[r].velocity_mps.col(column).array()};
      fill(of, Eigen::Ref<Eigen::ArrayXd>(columns_[r].back()));
    }
  }

  template <typename Fill>
  void for_channel(std::size_t c, const Fill& fill) {
    for (std::size_t k = 0; k < data_.muscles.size(); ++k) {
      if (map_.channel_of_muscle(k) == static_cast<int>(c)) for_runs(k, fill);
    }
  }

  const StudyData& data_;
  const UnseenSpreads& spreads_;
  const ParameterMap& map_;
  const Recorded& recorded_;
  const std::vector<TrialRun>& runs_;
  const ModelValues& values_;
  const std::vector<RunEvaluation>& at_;
  std::vector<UnseenQuantity> quantities_;
  std::vector<std::size_t> lags_;                     ///< Per muscle: the quantity of its lag.
  std::vector<std::vector<Eigen::ArrayXd>> columns_;  ///< Per run, one for each quantity.
};

}  // namespace

double Recorded::Range::span_m() const { return std::max(longest_m - shortest_m, 1e-6); }

Eigen::ArrayXd Recorded::Range::place(const Eigen::ArrayXd& length_m) const {
  return 2.0 * (length_m - shortest_m) / span_m() - 1.0;
}

Recorded recorded(const std::vector<TrialRun>& runs, const std::vector<MuscleValues>& muscles) {
  Recorded found{std::vector<Recorded::Range>(muscles.size()), 0.0};
  double sum = 0.0, count = 0.0;
  for (const TrialRun& run : runs) {
    sum += run.measured_nm.squaredNorm();
    count += static_cast<double>(run.measured_nm.size());
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      Recorded::Range& range = found.muscles[k];
      range.shortest_m = std::min(range.shortest_m, run.length_m.col(column).minCoeff());
      range.longest_m = std::max(range.longest_m, run.length_m.col(column).maxCoeff());
      range.fastest_mps =
          std::max(range.fastest_mps, run.velocity_mps.col(column).cwiseAbs().maxCoeff());
    }
  }
  found.torque_nm = std::sqrt(sum / count);
  for (std::size_t k = 0; k < muscles.size(); ++k) {
    Recorded::Range& range = found.muscles[k];
    const double more = std::max(0.0, 0.5 * muscles[k][kFiberLength] - range.span_m());
    range.shortest_m -= 0.5 * more;
    range.longest_m += 0.5 * more;
  }
  return found;
}

Unseen unseen_quantities(const StudyData& data,
                         const EstimatorOptions& options,
                         const ParameterMap& map,
                         const Recorded& recorded,
                         const std::vector<TrialRun>& runs,
                         const ModelValues& values,
                         const std::vector<RunEvaluation>& at) {
  Collector collector(data, options.unseen, map, recorded, runs, values, at);
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    collector.add_geometry(k, options.priors);
    collector.add_model_errors(k);
  }
  collector.center_lags();
  collector.add_electrodes();
  collector.add_torque_scale();
  collector.add_joint_errors();
  return collector.take();
}

}  // namespace myoid::identification
