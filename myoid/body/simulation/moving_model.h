#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "myoid/body/simulation/activation_signal.h"
#include "myoid/body/simulation/simulation.h"
#include "myoid/body/simulation/simulation_record.h"
#include "myoid/body/simulation/skeleton.h"

namespace myoid::body {

/// A model under its inputs: the functions of time and states that an integrator evaluates. States: q, qdot, and for
/// each muscle those of its tendon mode (none; l_m; l_m and dl_m/dt). It reads model, input and options, which must
/// outlive it. Not to be shared by threads.
class MovingModel {
 public:
  /// Throws InvalidInput, naming the fault, unless inputs, start and options fit the model.
  MovingModel(const SimulationModel& model,
              const SimulationInput& input,
              const SimulationStart& start,
              const SimulationOptions& options);
  MovingModel(const MovingModel&) = delete;
  MovingModel& operator=(const MovingModel&) = delete;

  [[nodiscard]] const std::vector<double>& start_state() const { return start_; }
  [[nodiscard]] std::size_t state_count() const { return offsets_.back(); }
  [[nodiscard]] std::size_t coordinate_count() const { return nq_; }
  [[nodiscard]] std::size_t event_count() const;
  [[nodiscard]] std::size_t work_count() const { return works_; }
  [[nodiscard]] bool all_rigid() const { return offsets_.back() == 2 * nq_; }

  /// Begins the stretch that ends at this time. Inputs may jump there: they are taken from the stretch before the jump.
  void begin_stretch(double end_s) { limit_left_ = std::nextafter(end_s, -1e300); }

  void rate(double t, const double* y, double* ydot);
  /// Computes the powers of the elements, in the order of the energy's columns.
  void powers(double t, const double* y, double* p);
  /// Computes the values whose sign changes are kinks of the right-hand side.
  void events(double t, const double* y, double* g);

  /// Returns room for this number of rows.
  [[nodiscard]] SimulationRecord make_record(std::size_t rows) const;
  /// Records a row; `work` holds the integrated powers.
  void record(double t, const double* y, const double* work, Eigen::Index row, SimulationRecord& r);

 private:
  [[nodiscard]] std::size_t size(std::size_t i) const { return offsets_[i + 1] - offsets_[i]; }
  [[nodiscard]] muscle::MusculotendonState<double> fiber(std::size_t i, const double* y) const;
  [[nodiscard]] muscle::MusculotendonInput<double> input_of(std::size_t i) const;
  [[nodiscard]] double clamped(double t) const { return std::min(t, limit_left_); }
  [[nodiscard]] double external(std::size_t k, double t) const;
  void set(double t, const double* y);
  void pull(std::size_t i, double tendon_force_n);
  void begin_muscles(const SimulationStart& start);

  const SimulationModel& model_;
  const SimulationInput& input_;
  const SimulationOptions& options_;
  Skeleton skeleton_;
  std::size_t nq_, n_, works_ = 0;
  std::vector<std::size_t> offsets_;
  std::vector<ActivationSignal> signals_;
  std::vector<std::size_t> hints_;
  std::vector<double> start_, activation_, tau_, qddot_, device_;
  std::vector<char> prescribed_;
  double limit_left_;
};

}  // namespace myoid::body
