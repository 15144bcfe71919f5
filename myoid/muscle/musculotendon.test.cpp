#include "myoid/muscle/musculotendon.h"

#include <cmath>
#include <string>
#include <vector>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/musculotendon_inl.h"

namespace myoid::muscle {
namespace {

constexpr HillParameters<double> kBicepsLong{.max_isometric_force_n = 624.3,
                                             .optimal_fiber_length_m = 0.1157,
                                             .force_length_width_m = 0.0818,
                                             .concentric_curvature = 0.3,
                                             .eccentric_curvature_product = 0.04615,
                                             .eccentric_plateau = 1.4,
                                             .max_shortening_speed_mps = 1.157,
                                             .tendon_slack_length_m = 0.2723};

struct Case {
  std::string name;
  MusculotendonLaws laws;
  double pennation_rad = 0.0;
  double damping = 0.1;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const TendonMode mode : {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass}) {
    const std::string suffix = mode == TendonMode::rigid         ? ", rigid"
                               : mode == TendonMode::equilibrium ? ", equilibrium"
                                                                 : ", mass";
    for (const double pennation : {0.0, 0.3}) {
      all.push_back({"paper" + suffix, paper_laws(mode), pennation});
      all.push_back({"Thelen" + suffix, thelen_laws(mode), pennation});
      all.push_back({"De Groote" + suffix, de_groote_laws(mode), pennation});
      all.push_back({"Millard" + suffix, millard_laws(mode), pennation});
      all.push_back({"van Soest" + suffix, soest_laws(mode), pennation});
    }
  }
  all.push_back({"paper, undamped", paper_laws(TendonMode::equilibrium), 0.2, 0.0});
  all.push_back({"Thelen, undamped", thelen_laws(), 0.2, 0.0});
  return all;
}

MusculotendonParameters<double> parameters_of(const Case& c) {
  MusculotendonParameters<double> p = published_defaults(kBicepsLong, c.laws);
  p.pennation_at_optimal_rad = c.pennation_rad;
  p.damping = c.damping;
  p.optimal_length_shift = 0.15;
  return p;
}

using Input = MusculotendonInput<double>;
using UnitState = MusculotendonState<double>;

TEST(Musculotendon, TendonAndFiberPullAlikeInTheSteadyState) {
  for (const Case& c : cases()) {
    const Musculotendon<double> unit(parameters_of(c), c.laws);
    for (const double a : {0.0, 0.02, 0.3, 1.0}) {
      for (const double length : {0.33, 0.37, 0.40, 0.44}) {
        const Input input{a, length, 0.0};
        const UnitState state = equilibrium_state(unit, input);
        const MusculotendonOutput<double> o = musculotendon_output(unit, input, state);
        // Round-off: the tendon's length 0.3 m to half an ulp, 3e-17, times 2e5 N/m is 1e-11 N.
        if (o.slack) {
          EXPECT_LE(o.fiber_force_n * o.cos_pennation, 1e-9) << c.name << " a " << a;
        } else {
          EXPECT_NEAR(o.tendon_force_n, o.fiber_force_n * o.cos_pennation, 1e-9)
              << c.name << " a " << a << " l " << length;
        }
        const MusculotendonRate<double> rate = musculotendon_rate(unit, input, state);
        EXPECT_NEAR(rate.fiber_length_rate_mps, 0.0, 1e-9) << c.name << " a " << a;
        EXPECT_NEAR(rate.fiber_velocity_rate_mps2, 0.0, 1e-8) << c.name;
        EXPECT_EQ(rate.tendon_force_n, o.tendon_force_n);
        EXPECT_EQ(tendon_force_n(unit, input, state), o.tendon_force_n);
      }
    }
  }
}

TEST(Musculotendon, AFiberThatPushesLiesBeyondTheSlackLength) {
  // De Groote's passive force is negative below 0.2 l0: the fiber rests there, the tendon hangs.
  const Musculotendon<double> unit(published_defaults(kBicepsLong, de_groote_laws()), de_groote_laws());
  const Input input{0.0, 0.2723 + 0.15 * 0.1157, 0.0};
  const UnitState state = equilibrium_state(unit, input);
  EXPECT_NEAR(state.fiber_length_m, 0.2 * 0.1157, 1e-12);
  EXPECT_TRUE(musculotendon_output(unit, input, state).slack);
}

TEST(Musculotendon, PowersOfAllElementsAddUpToThatOfThePath) {
  for (const Case& c : cases()) {
    const Musculotendon<double> unit(parameters_of(c), c.laws);
    for (const double a : {0.0, 0.3, 1.0}) {
      for (const double velocity : {-1.3, -0.4, 0.0, 0.3, 2.0}) {
        for (const double fiber : {0.06, 0.11, 0.14, 0.19}) {
          const Input input{a, 0.40, velocity};
          const MusculotendonOutput<double> o = musculotendon_output(unit, input, {fiber, 0.7 * velocity});
          const double sum =
              o.power_w.active + o.power_w.passive + o.power_w.viscous + o.power_w.tendon + o.power_w.kinetic;
          const double scale = std::abs(o.power_w.active) + std::abs(o.power_w.passive) + std::abs(o.power_w.viscous) +
                               std::abs(o.power_w.tendon) + std::abs(o.power_w.kinetic) + 1.0;
          EXPECT_NEAR(sum, o.power_w.musculotendon, 1e-12 * scale) << c.name << " a " << a;
        }
      }
    }
  }
}

TEST(Musculotendon, EquilibriumVelocityBalancesTheForcesWhereverTheFiberIs) {
  // From fibers far too short (tendon stretched to twice F_max and more: the eccentric plateau) to
  // slack tendons, at no, little and full activation.
  for (const Case& c : cases()) {
    if (c.laws.mode != TendonMode::equilibrium) continue;
    const Musculotendon<double> unit(parameters_of(c), c.laws);
    for (const double a : {0.0, 1e-6, 0.01, 0.5, 1.0}) {
      for (double fiber = 0.04; fiber < 0.2; fiber += 0.0037) {
        const Input input{a, 0.41, 0.0};
        const MusculotendonOutput<double> o = musculotendon_output(unit, input, {fiber, 0.0});
        const double scale = 1.0 + std::abs(o.active_force_n) + std::abs(o.viscous_force_n) +
                             std::abs(o.passive_force_n) + o.tendon_force_n;
        EXPECT_NEAR(o.tendon_force_n / o.cos_pennation, o.fiber_force_n, 1e-11 * scale)
            << c.name << " a " << a << " fiber " << fiber << " v " << o.fiber_velocity_mps;
      }
    }
  }
}

TEST(Musculotendon, DerivativesByStatesInputsAndParametersAreExact) {
  constexpr int kInputs = 5;
  using Jet = ceres::Jet<double, kInputs + kMusculotendonParameterCount>;
  for (const Case& c : cases()) {
    const MusculotendonParameters<double> p = parameters_of(c);
    for (const double a : {0.2, 0.9}) {
      for (const double velocity : {-0.31, 0.22}) {
        const double inputs[kInputs] = {a, 0.405, velocity, 0.1273, 0.8 * velocity};
        const auto value = [&](const MusculotendonParameters<double>& q, const double* x) {
          const Musculotendon<double> unit(q, c.laws);
          const auto r = musculotendon_rate<double>(unit, {x[0], x[1], x[2]}, {x[3], x[4]});
          return std::array<double, 3>{r.fiber_length_rate_mps, r.fiber_velocity_rate_mps2, r.tendon_force_n};
        };
        MusculotendonParameters<Jet> lifted_p = lifted<Jet>(p);
        int k = kInputs;
        visit_parameters(lifted_p, [&](std::string_view, Unit, Jet& field) { field.v[k++] = 1.0; });
        const Musculotendon<Jet> unit(lifted_p, c.laws);
        Jet x[kInputs];
        for (int i = 0; i < kInputs; ++i) x[i] = Jet(inputs[i], i);
        const auto r = musculotendon_rate<Jet>(unit, {x[0], x[1], x[2]}, {x[3], x[4]});
        const Jet exact[3] = {r.fiber_length_rate_mps, r.fiber_velocity_rate_mps2, r.tendon_force_n};
        for (int i = 0; i < kInputs + kMusculotendonParameterCount; ++i) {
          MusculotendonParameters<double> up = p, down = p;
          double x_up[kInputs], x_down[kInputs];
          std::copy(inputs, inputs + kInputs, x_up);
          std::copy(inputs, inputs + kInputs, x_down);
          double size = 0.0;
          if (i < kInputs) {
            size = std::abs(inputs[i]);
            x_up[i] += 1e-6 * size;
            x_down[i] -= 1e-6 * size;
          } else {
            int n = kInputs;
            visit_parameters(up, [&](std::string_view, Unit, double& f) {
              if (n++ == i) f += 1e-6 * (size = std::abs(f));
            });
            n = kInputs;
            visit_parameters(down, [&](std::string_view, Unit, double& f) {
              if (n++ == i) f -= 1e-6 * std::abs(f);
            });
          }
          if (size == 0.0) continue;  // no pennation, no damping: one-sided
          const auto hi = value(up, x_up);
          const auto lo = value(down, x_down);
          for (std::size_t out = 0; out < 3; ++out) {
            // Relative change by a relative step 1e-6: truncation 1e-12 times third derivatives (the tendon's, about
            // (l_t / 0.01 m)^3 = 3e4), rounding 1e-16 / 1e-6 times the stiffness amplification of the same 30.
            const double difference = (hi[out] - lo[out]) / 2e-6;
            const double scale = std::abs(exact[out].v[i] * size) + std::abs(value(p, inputs)[out]) + 1e-3;
            EXPECT_NEAR(exact[out].v[i] * size / scale, difference / scale, 2e-6)
                << c.name << " output " << out << " by " << i << " a " << a << " v " << velocity;
          }
        }
      }
    }
  }
}

/// Runge-Kutta of order four with a fixed step over `duration`; the path moves as
/// l(t) = middle + swing sin(w t). Returns the state and the works of all elements.
struct Drive {
  double middle_m = 0.4;
  double swing_m = 0.0;
  double frequency_radps = 0.0;
  double activation = 0.5;
  [[nodiscard]] Input at(double t) const {
    return {activation, middle_m + swing_m * std::sin(frequency_radps * t),
            swing_m * frequency_radps * std::cos(frequency_radps * t)};
  }
};

template <typename Observe>
UnitState integrate(const Musculotendon<double>& unit,
                    const Drive& drive,
                    UnitState state,
                    double duration_s,
                    int steps,
                    const Observe& observe) {
  const double h = duration_s / steps;
  const auto rate = [&](double t, const UnitState& s) { return musculotendon_rate(unit, drive.at(t), s); };
  const auto moved = [](const UnitState& s, const MusculotendonRate<double>& r, double dt) {
    return UnitState{s.fiber_length_m + dt * r.fiber_length_rate_mps,
                     s.fiber_velocity_mps + dt * r.fiber_velocity_rate_mps2};
  };
  observe(0.0, state);
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    const auto k1 = rate(t, state);
    const auto k2 = rate(t + 0.5 * h, moved(state, k1, 0.5 * h));
    const auto k3 = rate(t + 0.5 * h, moved(state, k2, 0.5 * h));
    const auto k4 = rate(t + h, moved(state, k3, h));
    for (const auto& [r, weight] : {std::pair(k1, 1.0), {k2, 2.0}, {k3, 2.0}, {k4, 1.0}}) {
      state = moved(state, r, weight * h / 6.0);
    }
    observe((k + 1) * h, state);
  }
  return state;
}

TEST(Musculotendon, MassOnItsTendonRingsAtTheRootOfStiffnessOverMass) {
  // Passive, undamped: F_t = k (x - slack) alone moves the mass: omega = sqrt(k / M), 667 rad/s for
  // the long head of the biceps (science: 670).
  MusculotendonParameters<double> p = published_defaults(kBicepsLong, paper_laws());
  p.damping = 0.0;
  const Musculotendon<double> unit(p, paper_laws());
  const double stiffness = 624.3 / (0.033 * 0.2723);
  const double omega = std::sqrt(stiffness / p.muscle_mass_kg);
  EXPECT_NEAR(omega, 670.0, 20.0);
  // Released with the tendon 3 mm long: x reaches the slack length after a quarter period.
  const Drive drive{.middle_m = 0.3900, .activation = 0.0};
  const double start = 0.3900 - 0.2723 - 0.003;
  const double quarter = 0.5 * kPi / omega;
  const UnitState end = integrate(unit, drive, {start, 0.0}, quarter, 2000, [](double, const UnitState&) {});
  EXPECT_NEAR(end.fiber_length_m, 0.3900 - 0.2723, 1e-9);  // RK4: (pi/4000)^4 of 3 mm
  EXPECT_NEAR(end.fiber_velocity_mps, 0.003 * omega, 1e-7);
}

TEST(Musculotendon, WorkOfAllElementsClosesWithTheStoredEnergies) {
  for (const Case& c : cases()) {
    if (c.laws.mode == TendonMode::rigid || c.damping == 0.0) continue;
    const Musculotendon<double> unit(parameters_of(c), c.laws);
    const Drive drive{.middle_m = 0.41, .swing_m = 0.01, .frequency_radps = 6.0};
    double path = 0.0, active = 0.0, viscous = 0.0, size = 0.0;
    double before = 0.0, stored_at_start = 0.0, stored = 0.0;
    MusculotendonOutput<double> last;
    // A massive fiber's fastest rate is a F_max 2 (1 + 1/V_sh) / (v_max M) = 15000 1/s.
    const int steps = c.laws.mode == TendonMode::mass ? 30000 : 6000;
    const double duration = 1.5;
    const double h = duration / steps;
    integrate(unit, drive, equilibrium_state(unit, drive.at(0.0)), duration, steps, [&](double t, const UnitState& s) {
      const auto o = musculotendon_output(unit, drive.at(t), s);
      stored = o.energy_j.passive + o.energy_j.tendon + o.energy_j.kinetic;
      if (t == 0.0) {
        stored_at_start = stored;
      } else {
        path += 0.5 * h * (last.power_w.musculotendon + o.power_w.musculotendon);
        active += 0.5 * h * (last.power_w.active + o.power_w.active);
        viscous += 0.5 * h * (last.power_w.viscous + o.power_w.viscous);
        size += h * std::abs(o.power_w.active);
      }
      last = o;
      before = t;
    });
    EXPECT_NEAR(before, duration, 1e-9);
    // Trapezoids: h^2/12 w^2 relative 2e-7 where smooth, and a little at the kinks of v = 0.
    EXPECT_NEAR(active + viscous - (stored - stored_at_start), path, 1e-5 * size) << c.name;
  }
}

TEST(Musculotendon, ThreeTendonModesAgreeInSlowMovement) {
  // A stiff tendon (short, 1 % strain) in a 0.1 Hz movement: force within one per cent.
  HillParameters<double> hill = kBicepsLong;
  hill.tendon_slack_length_m = 0.05;
  const Drive drive{.middle_m = 0.165, .swing_m = 0.01, .frequency_radps = 0.6, .activation = 0.4};
  double force[3];
  for (const TendonMode mode : {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass}) {
    MusculotendonParameters<double> p = published_defaults(hill, paper_laws(mode));
    p.tendon_strain = 0.01;
    const Musculotendon<double> unit(p, paper_laws(mode));
    const UnitState end =
        integrate(unit, drive, equilibrium_state(unit, drive.at(0.0)), 1.0, 20000, [](double, const UnitState&) {});
    force[static_cast<int>(mode)] = musculotendon_output(unit, drive.at(1.0), end).tendon_force_n;
  }
  EXPECT_NEAR(force[1] / force[0], 1.0, 0.01);
  EXPECT_NEAR(force[2] / force[0], 1.0, 0.01);
  EXPECT_NEAR(force[2] / force[1], 1.0, 1e-3);
}

TEST(Musculotendon, OptimalLengthGrowsAsTheActivationFalls) {
  // l_opt(a) = l0 (1 + gamma (1 - a)): the peak of f_l at a = 0.2, gamma = 0.15 lies at 1.12 l0.
  for (const MusculotendonLaws& laws :
       {paper_laws(), de_groote_laws(TendonMode::mass), millard_laws(TendonMode::mass)}) {
    MusculotendonParameters<double> p = published_defaults(kBicepsLong, laws);
    const Musculotendon<double> plain(p, laws);
    p.optimal_length_shift = 0.15;
    const Musculotendon<double> shifted(p, laws);
    for (const double l : {0.8, 1.0, 1.2}) {
      const double fiber = l * 0.1157;
      EXPECT_NEAR(musculotendon_output(shifted, Input{0.2, 0.4, 0.0}, UnitState{1.12 * fiber, 0.0}).length_multiplier,
                  musculotendon_output(plain, Input{0.2, 0.4, 0.0}, UnitState{fiber, 0.0}).length_multiplier, 1e-14);
    }
    EXPECT_EQ(musculotendon_output(shifted, Input{1.0, 0.4, 0.0}, UnitState{0.1, 0.0}).length_multiplier,
              musculotendon_output(plain, Input{1.0, 0.4, 0.0}, UnitState{0.1, 0.0}).length_multiplier);
  }
}

TEST(Musculotendon, ARigidTendonDoesNotPushAndLosesNoEnergyWhenItGoesSlack) {
  // A stretched, shortening fiber: the damper would push. Its passive spring still gives its
  // energy, and the damper takes it.
  const MusculotendonLaws laws = thelen_laws(TendonMode::rigid);
  const Musculotendon<double> unit(published_defaults(kBicepsLong, laws), laws);
  const double length = 0.2723 + 1.1 * 0.1157, velocity = -1.1, h = 1e-7;
  const auto at = [&](double path) { return musculotendon_output(unit, Input{0.01, path, velocity}, UnitState{}); };
  const auto o = at(length);
  EXPECT_TRUE(o.slack);
  EXPECT_EQ(o.tendon_force_n, 0.0);
  EXPECT_GT(o.passive_force_n, 0.0);
  EXPECT_EQ(o.fiber_force_n, 0.0);
  EXPECT_LT(o.power_w.viscous, 0.0);
  const double slope = (at(length + h).energy_j.passive - at(length - h).energy_j.passive) / (2 * h);
  EXPECT_NEAR(o.power_w.passive, -slope * velocity, 1e-6);  // truncation and 1e-16 / h
}

TEST(Musculotendon, TendonTakesWhatTheFiberGivesAlsoBelowTheShortestLength) {
  // dl_t/dl_m = -1 / cos(alpha), so that no power is lost; at 0.3 rad the shortest fiber is 0.0344 m.
  MusculotendonParameters<double> p = published_defaults(kBicepsLong, paper_laws());
  p.pennation_at_optimal_rad = 0.3;
  const Musculotendon<double> unit(p, paper_laws());
  EXPECT_NEAR(unit.shortest_fiber_m(), 0.1157 * std::sin(0.3) / std::sqrt(0.99), 1e-15);
  const double h = 1e-7;
  for (const double l : {0.031, 0.0343, 0.04, 0.12}) {
    const auto tendon = [&](double fiber) {
      return musculotendon_output(unit, Input{0.5, 0.4, 0.0}, UnitState{fiber, 0.0});
    };
    const double slope = (tendon(l + h).tendon_length_m - tendon(l - h).tendon_length_m) / (2 * h);
    // Truncation h^2 / 6 times 1 / (l cos^5) at most 1e8 / m^2; rounding 1e-17 / h.
    EXPECT_NEAR(slope, -1.0 / tendon(l).cos_pennation, 1e-5) << l;
    EXPECT_EQ(tendon(l).at_shortest, l < 0.0344);
  }
  // Pressed below, it pushes back.
  EXPECT_LT(musculotendon_output(unit, Input{0.0, 0.4, 0.0}, UnitState{0.030, 0.0}).passive_force_n, 0.0);
}

TEST(Musculotendon, EventsChangeSignAtTheKinks) {
  const Musculotendon<double> unit(published_defaults(kBicepsLong, paper_laws()), paper_laws());
  const Input input{0.5, 0.39, 0.0};
  const auto taut = musculotendon_events(unit, input, {0.1170, 0.01});
  const auto slack = musculotendon_events(unit, input, {0.1180, -1.2});
  EXPECT_GT(taut[0], 0.0);
  EXPECT_LT(slack[0], 0.0);
  EXPECT_GT(taut[1], 0.0);
  EXPECT_LT(slack[1], 0.0);
  EXPECT_GT(taut[2], 0.0);
  EXPECT_LT(slack[2], 0.0);
}

TEST(Musculotendon, RefusesWhatMakesNoUnit) {
  const auto refuses = [](auto change, const MusculotendonLaws& laws) {
    MusculotendonParameters<double> p = published_defaults(kBicepsLong, laws);
    change(p);
    EXPECT_THROW(Musculotendon<double>(p, laws), InvalidInput);
  };
  refuses([](auto& p) { p.tendon_strain = 0.0; }, paper_laws());
  refuses([](auto& p) { p.damping = -0.1; }, paper_laws());
  refuses([](auto& p) { p.muscle_mass_kg = 0.0; }, paper_laws());
  refuses([](auto& p) { p.pennation_at_optimal_rad = 1.6; }, paper_laws());
  refuses([](auto& p) { p.hill.tendon_slack_length_m = 0.0; }, paper_laws());
  refuses([](auto& p) { p.damping = 0.0; }, millard_laws());
  refuses([](auto& p) { p.damping = 0.0; }, de_groote_laws());
  refuses([](auto& p) { p.hill.eccentric_plateau = 0.9; }, paper_laws(TendonMode::equilibrium));
  refuses([](auto& p) { p.hill.eccentric_plateau = 1.04; }, thelen_laws());
  refuses([](auto& p) { p.hill.max_isometric_force_n = std::nan(""); }, paper_laws());
}

}  // namespace
}  // namespace myoid::muscle
