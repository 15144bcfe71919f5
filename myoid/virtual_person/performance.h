#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "myoid/muscle/fatigue.h"
#include "myoid/virtual_person/arm_stepper.h"
#include "myoid/virtual_person/departures.h"
#include "myoid/virtual_person/draw_truth.h"
#include "myoid/virtual_person/trial_script.h"
#include "myoid/virtual_person/true_arm.h"
#include "myoid/virtual_person/virtual_arm.h"

namespace myoid::twin {

/// Greatest activation that a trial may require.
inline constexpr double kGreatestActivation = 0.95;

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
  void rest(double interval_s);
};
extern template struct Tiredness<4>;
extern template struct Tiredness<7>;

/// Levels L0 and L1: tendons are rigid and the motion is prescribed, so that activations in closed
/// form solve the equation of motion.
class ExactPerformance : public Performance {
 public:
  /// Performs the trial. `effort`: shares of the greatest activation in an MVC trial. `tiredness`
  /// passes on to the next trial.
  ExactPerformance(const VirtualArm& arm,
                   const HillSet& muscles,
                   TrialScript script,
                   double delay_s,
                   const PerMuscle& effort,
                   Tiredness<4>& tiredness,
                   const BesideMuscles& beside = {},
                   const Departures& departures = {});

  [[nodiscard]] Instant at(double time_s) const override;
  [[nodiscard]] Moment motion(double time_s) const override { return script().motion(time_s); }
  [[nodiscard]] PerMuscle drive(double time_s) const override;
  [[nodiscard]] PerMuscle fatigued(double time_s) const override;

  /// Returns the greatest activation that the motion requires; 0 against a dynamometer.
  [[nodiscard]] double greatest_activation(double rate_hz) const;

 private:
  [[nodiscard]] PerMuscle strength(double time_s) const;
  /// Returns force over activation at these activations and tensions.
  [[nodiscard]] PerMuscle force_per_activation_n(const MuscleGeometry& geometry,
                                                 const PerMuscle& activation,
                                                 const PerMuscle& tension_n) const;

  const VirtualArm* arm_;
  const HillSet* muscles_;
  BesideMuscles beside_;
  DepartedMuscles body_;
  bool elastic_;
  double delay_s_;
  PerMuscle effort_;
  std::vector<PerMuscle> strength_;  ///< On an even clock from 0; empty: 1.
};

/// Returns the greatest activation that a person at level L2 would foresee for a trial; 0 against a dynamometer.
[[nodiscard]] double foreseen_activation(const TrueArm& arm, const TrialScript& script);

/// Level L2: a nervous system drives the arm forward in time (ArmStepper). It knows the intended
/// motion and approximately its muscles' capacity, corrects errors by the felt angle and speed, and
/// has a noisy drive. The motion is the result.
class SimulatedPerformance : public Performance {
 public:
  SimulatedPerformance(const TrueArm& arm,
                       TrialScript script,
                       const PerMuscle& effort,
                       double motor_noise,
                       Tiredness<7>& tiredness,
                       std::uint64_t seed);

  [[nodiscard]] Instant at(double time_s) const override;
  [[nodiscard]] Moment motion(double time_s) const override;
  [[nodiscard]] PerMuscle drive(double time_s) const override;
  [[nodiscard]] PerMuscle fatigued(double time_s) const override;
  [[nodiscard]] std::optional<ArmState> heads(double time_s) const override;

  /// Returns the reason why the person could not do the trial; empty if there is none.
  [[nodiscard]] const std::string& failure() const { return failure_; }

  /// Returns the commands as the muscles' excitations after the delay, on the clock of
  /// `sample_time_s`, for simulations of the same trial by other means.
  [[nodiscard]] std::size_t sample_count() const { return samples_.size(); }
  [[nodiscard]] double sample_time_s(std::size_t k) const;
  [[nodiscard]] const PerHead& excitation(std::size_t k) const { return samples_[k].excitation; }
  [[nodiscard]] const ArmState& sample(std::size_t k) const { return samples_[k].arm; }

 private:
  struct Sample {
    ArmState arm;
    PerHead excitation{};
    PerMuscle command{};
    PerMuscle electrode{};
  };
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
  PerMuscle effort_;
  std::vector<Sample> samples_;
  std::vector<PerMuscle> fatigued_;  ///< On an even clock from 0; empty: no fatigue.
  std::string failure_;
};

}  // namespace myoid::twin
