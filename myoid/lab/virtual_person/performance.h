#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "myoid/lab/virtual_person/arm_stepper.h"
#include "myoid/lab/virtual_person/departures.h"
#include "myoid/lab/virtual_person/draw_truth.h"
#include "myoid/lab/virtual_person/trial_script.h"
#include "myoid/lab/virtual_person/true_arm.h"
#include "myoid/lab/virtual_person/virtual_arm.h"
#include "myoid/muscle/fatigue.h"

namespace myoid::lab {

/// Greatest activation that a trial may require.
inline constexpr double kGreatestActivation = 0.95;
/// The failure of a person whose trial requires more.
inline constexpr std::string_view kTooWeak = "the muscles are too weak";

/// The state of the person at one instant of a trial.
struct Instant {
  Moment q;                         ///< Elbow flexion.
  PerMuscle activation{};           ///< Activation of the muscle; for heads, the mean by strength.
  PerMuscle force_n{};              ///< On the skeleton; for heads, the sum.
  PerMuscle fiber_length_m{};       ///< For heads, the mean by strength.
  double muscle_torque_nm = 0.0;    ///< Flexion positive, as all torques.
  double passive_torque_nm = 0.0;   ///< Torque of the joint itself.
  double external_torque_nm = 0.0;  ///< Torque of the dynamometer.
};

/// One person's performance of one trial: the truth at any time, also a little before the beginning and after the end.
class Performance {
 public:
  explicit Performance(TrialScript script) : script_(std::move(script)) {}
  virtual ~Performance() = default;
  Performance(const Performance&) = delete;
  Performance& operator=(const Performance&) = delete;

  [[nodiscard]] const TrialScript& script() const { return script_; }
  [[nodiscard]] virtual Instant at(double time_s) const = 0;
  [[nodiscard]] virtual Moment motion(double time_s) const = 0;
  /// Returns the excitation of each muscle at its electrode, before any delay.
  [[nodiscard]] virtual PerMuscle drive(double time_s) const = 0;
  /// Returns the share of each muscle's strength that fatigue has taken by this time.
  [[nodiscard]] virtual PerMuscle fatigued(double time_s) const = 0;
  /// Returns the reason why the person cannot do the trial; empty if there is none.
  [[nodiscard]] virtual std::string failure() const { return ""; }
  /// Returns the heads at this time; empty if the truth has none.
  [[nodiscard]] virtual std::optional<ArmState> heads(double /*time_s*/) const { return std::nullopt; }

 private:
  TrialScript script_;
};

/// Interpolates by straight lines on an even clock from 0; the end values continue outside.
[[nodiscard]] PerMuscle interpolated(const std::vector<PerMuscle>& values, double step_s, double time_s);

/// Fatigue of N muscles or heads over the trials.
template <std::size_t N>
struct Tiredness {
  std::optional<muscle::FatigueRates<double>> rates;  ///< Empty: no fatigue.
  std::array<muscle::FatigueState<double>, N> state{};

  [[nodiscard]] std::array<double, N> strength() const {
    std::array<double, N> share{};
    for (std::size_t i = 0; i < N; ++i) share[i] = muscle::fatigue_capacity(state[i]);
    return share;
  }
  void work(const std::array<double, N>& activation, double interval_s) {
    if (!rates) return;
    for (std::size_t i = 0; i < N; ++i) state[i] = muscle::step_fatigue(*rates, activation[i], state[i], interval_s);
  }
  /// Rests: active muscle relaxes first; then M_F decays with the rate r R.
  void rest(double interval_s) {
    if (!rates) return;
    constexpr double kRelaxing_s = 2.0;  // leaves e^-20 of the active share
    const double relaxing_s = std::min(interval_s, kRelaxing_s);
    work({}, relaxing_s);
    const double decay = std::exp(-rates->rest_recovery_factor * rates->recovery_per_s * (interval_s - relaxing_s));
    for (muscle::FatigueState<double>& s : state) {
      s.fatigued *= decay;
      s.resting = 1.0 - s.active - s.fatigued;
    }
  }
};

/// Levels L0 and L1: tendons are rigid and the motion is prescribed, so that activations in closed
/// form solve the equation of motion.
class ExactPerformance : public Performance {
 public:
  /// Performs the trial. `tiredness` passes on to the next trial.
  ExactPerformance(const VirtualArm& arm,
                   const HillSet& muscles,
                   TrialScript script,
                   double delay_s,
                   Tiredness<4>& tiredness,
                   const BesideMuscles& beside = {},
                   const Departures& departures = {});

  [[nodiscard]] Instant at(double time_s) const override;
  [[nodiscard]] Moment motion(double time_s) const override { return script().motion(time_s); }
  [[nodiscard]] PerMuscle drive(double time_s) const override;
  [[nodiscard]] PerMuscle fatigued(double time_s) const override;

  /// A motion that requires more than kGreatestActivation fails.
  [[nodiscard]] std::string failure() const override;

 private:
  [[nodiscard]] PerMuscle strength(double time_s) const;

  const VirtualArm* arm_;
  const HillSet* muscles_;
  BesideMuscles beside_;
  DepartedMuscles body_;
  bool elastic_;
  double delay_s_;
  std::vector<PerMuscle> strength_;  ///< On an even clock from 0; empty: 1.
};

/// Returns the greatest activation that a person at level L2 would foresee for a trial; 0 against a dynamometer.
[[nodiscard]] double foreseen_activation(const TrueArm& arm, const TrialScript& script);

/// Level L2: a nervous system drives the arm forward in time (ArmStepper). It knows the intended
/// motion and approximately its muscles' capacity, corrects errors by the felt angle and speed, and
/// has a noisy drive. The motion is the result.
class SimulatedPerformance : public Performance {
 public:
  SimulatedPerformance(
      const TrueArm& arm, TrialScript script, double motor_noise, Tiredness<7>& tiredness, std::uint64_t seed);

  [[nodiscard]] Instant at(double time_s) const override;
  [[nodiscard]] Moment motion(double time_s) const override;
  [[nodiscard]] PerMuscle drive(double time_s) const override;
  [[nodiscard]] PerMuscle fatigued(double time_s) const override;
  [[nodiscard]] std::optional<ArmState> heads(double time_s) const override;

  [[nodiscard]] std::string failure() const override { return failure_; }

  struct Sample {
    double time_s = 0.0;
    ArmState arm;
    PerHead excitation{};  ///< The command that arrives, after the delay.
    PerMuscle electrode{};
  };
  /// Returns the simulated course, for simulations of the same trial by other means.
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

 private:
  /// The interval that contains a time, and the position inside it, 0..1.
  struct Place {
    std::size_t before;
    double share;
  };
  [[nodiscard]] Place place(double time_s) const;
  void simulate(double motor_noise, Tiredness<7>& tiredness, std::uint64_t seed);
  /// Returns the command that reaches the muscles at a time, from the commands so far.
  [[nodiscard]] PerMuscle delayed_command(double t) const;
  /// Steps the arm from sample k - 1 to sample k.
  void step_to_sample(std::size_t k, ArmStepper& stepper) const;
  /// Adds the work of sample k, and weakens the muscles at every tenth.
  void tire(std::size_t k, PerHead& worked, Tiredness<7>& tiredness, ArmStepper& stepper);

  const TrueArm* arm_;
  std::vector<Sample> samples_;
  std::vector<PerMuscle> commands_;  ///< On the clock of the samples.
  std::vector<PerMuscle> fatigued_;  ///< On an even clock from 0; empty: no fatigue.
  std::string failure_;
};

}  // namespace myoid::lab
