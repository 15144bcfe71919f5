#include "myoid/identification/muscle_law.h"

#include <algorithm>
#include <cmath>

namespace myoid::identification {
namespace {

/// f_v at one rate and its derivatives.
struct ForceVelocity {
  double value = 0.0, by_velocity = 0.0, by_speed = 0.0, by_curvature = 0.0, by_product = 0.0,
         by_plateau = 0.0;
};

/// Equation (4) of the source paper, v positive in lengthening [m/s]; 0 at -v_max and beyond.
ForceVelocity force_velocity(double v, const MuscleValues& p) {
  const double vm = p[kSpeed];
  ForceVelocity f;
  if (v > 0.0) {
    const double below = 1.0 / (p[kProduct] * vm + v);
    f.value = (p[kProduct] * vm + p[kPlateau] * v) * below;
    const double flat = v * (1.0 - p[kPlateau]) * below * below;
    f.by_product = vm * flat;
    f.by_speed = p[kProduct] * flat;
    f.by_plateau = v * below;
    f.by_velocity = p[kProduct] * vm * (p[kPlateau] - 1.0) * below * below;
  } else if (v > -vm) {
    const double vsh = p[kCurvature];
    const double below = 1.0 / (vsh * vm - v);
    f.value = vsh * (vm + v) * below;
    f.by_curvature = -v * (vm + v) * below * below;
    const double bend = vsh * (1.0 + vsh) * below * below;
    f.by_speed = -v * bend;
    f.by_velocity = vm * bend;
  }
  return f;
}

constexpr double kTendonScale = 0.2;               // De Groote's exponential tendon ...
constexpr double kTendonRise = 1.791759469228055;  // ... ln(1 / 0.2 + 1): tension 1 at strain e0

/// Fiber force over F_max, and its derivatives.
struct Fiber {
  double force = 0.0;
  double by_activation = 0.0, by_length = 0.0, by_velocity = 0.0;
  std::array<double, kMuscleFieldCount> by_field{};
};

Fiber fiber(double a, double l, double v, const MuscleValues& p) {
  Fiber f;
  const double l0 = p[kFiberLength];
  const double gamma = p[kLengthActivation];
  const double stretch = 1.0 + gamma * (1.0 - a);
  const double w = p[kWidth];
  const double z = (l - l0 * stretch) / w;
  const double fl = std::exp(-z * z);
  const double fl_l = -2.0 * z / w * fl;

  const auto [fv, fv_v, fv_vm, fv_sh, fv_p, fv_ml] = force_velocity(v, p);
  f.force = a * fl * fv;
  f.by_activation = fl * fv - a * fl_l * fv * (-l0 * gamma);
  f.by_length = a * fl_l * fv;
  f.by_velocity = a * fl * fv_v;
  f.by_field[kFiberLength] = -a * fl_l * fv * stretch;
  f.by_field[kWidth] = a * fv * 2.0 * z * z / w * fl;
  f.by_field[kCurvature] = a * fl * fv_sh;
  f.by_field[kProduct] = a * fl * fv_p;
  f.by_field[kPlateau] = a * fl * fv_ml;
  f.by_field[kSpeed] = a * fl * fv_vm;
  f.by_field[kLengthActivation] = -a * fl_l * fv * l0 * (1.0 - a);

  if (p[kPassiveForce] > 0.0 && l > l0) {
    const double k = p[kPassiveShape];
    const double e = p[kPassiveStrain];
    const double top = std::expm1(k);
    const double x = (l / l0 - 1.0) / e;
    const double rise = std::exp(k * x);
    const double c = p[kPassiveForce];
    f.force += c * (rise - 1.0) / top;
    const double by_x = c * k * rise / top;
    f.by_length += by_x / (l0 * e);
    f.by_field[kFiberLength] -= by_x * l / (l0 * l0 * e);
    f.by_field[kPassiveForce] = (rise - 1.0) / top;
    f.by_field[kPassiveStrain] = -by_x * x / e;
    f.by_field[kPassiveShape] = c * (x * rise * top - (rise - 1.0) * (top + 1.0)) / (top * top);
  } else if (l > l0) {
    // The derivative by the amount exists although there is none yet.
    f.by_field[kPassiveForce] = std::expm1(p[kPassiveShape] * (l / l0 - 1.0) / p[kPassiveStrain]) /
                                std::expm1(p[kPassiveShape]);
  }
  return f;
}

/// Tension over F_max of a pennate muscle whose projected length is `along` = l cos(alpha).
struct Projected {
  double force = 0.0;
  double by_activation = 0.0, by_along = 0.0, by_velocity = 0.0;
  std::array<double, kMuscleFieldCount> by_field{};
};

Projected projected(double a, double along, double v_mt, const MuscleValues& p) {
  Projected r;
  if (p[kPennation] == 0.0) {
    const Fiber f = fiber(a, along, v_mt, p);
    r.force = f.force;
    r.by_activation = f.by_activation;
    r.by_along = f.by_length;
    r.by_velocity = f.by_velocity;
    r.by_field = f.by_field;
    return r;
  }
  if (along <= 0.0) return r;
  const double sine = std::sin(p[kPennation]);
  const double h = p[kFiberLength] * sine;
  const double l = std::hypot(h, along);
  const double c = along / l;
  const double c_along = h * h / (l * l * l);
  const double c_h = -along * h / (l * l * l);
  const Fiber f = fiber(a, l, v_mt * c, p);
  r.force = f.force * c;
  r.by_activation = f.by_activation * c;
  r.by_velocity = f.by_velocity * c * c;
  r.by_along = (f.by_length * c + f.by_velocity * v_mt * c_along) * c + f.force * c_along;
  const double by_h = (f.by_length * h / l + f.by_velocity * v_mt * c_h) * c + f.force * c_h;
  for (std::size_t i = 0; i < r.by_field.size(); ++i) r.by_field[i] = f.by_field[i] * c;
  r.by_field[kFiberLength] += by_h * sine;
  r.by_field[kPennation] = by_h * p[kFiberLength] * std::cos(p[kPennation]);
  return r;
}

/// Strain at which the tendon pulls as the muscle does.
double tendon_strain(double a, double l_mt, double v_mt, const MuscleValues& p, double rise) {
  const double slack = p[kSlack];
  const auto excess = [&](double strain, double* slope) {
    const Projected m = projected(a, l_mt - slack * (1.0 + strain), v_mt, p);
    const double pull = kTendonScale * std::exp(rise * strain);
    if (slope != nullptr) *slope = -m.by_along * slack - rise * pull;
    return m.force - (pull - kTendonScale);
  };
  double low = 0.0;
  double high = std::log1p(projected(a, l_mt - slack, v_mt, p).force / kTendonScale + 1e-3) / rise;
  while (excess(high, nullptr) > 0.0 && high < 10.0) high *= 2.0;
  double strain = 0.5 * high;
  for (int i = 0; i < 100; ++i) {
    double slope = 0.0;
    const double value = excess(strain, &slope);
    (value > 0.0 ? low : high) = strain;
    double next = slope < 0.0 ? strain - value / slope : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - strain) <= 1e-15 * (1.0 + strain)) return next;
    strain = next;
  }
  return strain;
}

}  // namespace

MuscleValues muscle_values(const muscle::HillParameters<double>& hill, const MuscleExtras& extras) {
  MuscleValues values{};
  for (std::size_t i = 0; i < muscle::kHillFields.size() && i <= kSlack; ++i)
    values[i] = hill.*muscle::kHillFields[i].member;
  values[kPennation] = extras.pennation_angle_rad;
  values[kPassiveForce] = extras.passive_force;
  values[kPassiveStrain] = extras.passive_strain;
  values[kPassiveShape] = extras.passive_shape;
  values[kLengthActivation] = extras.length_activation;
  values[kTendonStrain] = extras.tendon_strain;
  values[kShare] = extras.activation_share;
  return values;
}

muscle::HillParameters<double> hill_parameters(const MuscleValues& values) {
  muscle::HillParameters<double> hill;
  for (std::size_t i = 0; i < muscle::kHillFields.size() && i <= kSlack; ++i)
    hill.*muscle::kHillFields[i].member = values[i];
  return hill;
}

MuscleExtras muscle_extras(const MuscleValues& values) {
  return {.pennation_angle_rad = values[kPennation],
          .passive_force = values[kPassiveForce],
          .passive_strain = values[kPassiveStrain],
          .passive_shape = values[kPassiveShape],
          .length_activation = values[kLengthActivation],
          .tendon_strain = values[kTendonStrain],
          .activation_share = values[kShare]};
}

Tension tension(double activation, double length_m, double velocity_mps, const MuscleValues& p) {
  const double a = p[kShare] * activation;
  const double greatest = p[kMaxForce];
  Tension t;
  if (p[kTendonStrain] > 0.0 && p[kSlack] > 0.0) {
    const double rise = kTendonRise / p[kTendonStrain];
    const double strain = tendon_strain(a, length_m, velocity_mps, p, rise);
    const Projected m = projected(a, length_m - p[kSlack] * (1.0 + strain), velocity_mps, p);
    const double grown = kTendonScale * std::exp(rise * strain);
    const double pull = grown - kTendonScale;
    const double pull_slope = rise * grown;
    // G = muscle - tendon = 0 gives d strain / d x = G_x / (m_along l_ts + pull').
    const double stiff = pull_slope / (m.by_along * p[kSlack] + pull_slope);
    t.force_n = greatest * pull;
    for (std::size_t i = 0; i < t.by_field.size(); ++i)
      t.by_field[i] = greatest * stiff * m.by_field[i];
    t.by_field[kSlack] = -greatest * stiff * m.by_along * (1.0 + strain);
    const double by_e0 = -grown * strain * rise / p[kTendonStrain];
    t.by_field[kTendonStrain] = greatest * by_e0 * (1.0 - stiff);
    t.by_field[kMaxForce] = pull;
    t.by_length = greatest * stiff * m.by_along;
    t.by_velocity = greatest * stiff * m.by_velocity;
    t.by_activation = greatest * stiff * m.by_activation;
  } else {
    const Projected m = projected(a, length_m - p[kSlack], velocity_mps, p);
    t.force_n = greatest * m.force;
    for (std::size_t i = 0; i < t.by_field.size(); ++i) t.by_field[i] = greatest * m.by_field[i];
    t.by_field[kSlack] = -greatest * m.by_along;
    t.by_field[kMaxForce] = m.force;
    t.by_length = greatest * m.by_along;
    t.by_velocity = greatest * m.by_velocity;
    t.by_activation = greatest * m.by_activation;
  }
  t.by_field[kShare] = t.by_activation * activation;
  t.by_activation *= p[kShare];
  return t;
}

bool is_plain(const MuscleValues& p) {
  return p[kPennation] == 0.0 && p[kPassiveForce] == 0.0 &&
         (p[kTendonStrain] == 0.0 || p[kSlack] == 0.0);
}

void plain_tension(
    double activation, double length_m, double velocity_mps, const MuscleValues& p, Tension& t) {
  const double a = p[kShare] * activation;
  const double v = velocity_mps;
  const double l0 = p[kFiberLength];
  const double stretch = 1.0 + p[kLengthActivation] * (1.0 - a);
  const double inverse_width = 1.0 / p[kWidth];
  const double z = (length_m - p[kSlack] - l0 * stretch) * inverse_width;
  const double strength = p[kMaxForce] * std::exp(-z * z);  // at full activation, at rest
  const double active = a * strength;
  const auto [fv, fv_v, fv_vm, fv_sh, fv_p, fv_ml] = force_velocity(v, p);
  t.force_n = active * fv;
  t.by_length = -2.0 * z * inverse_width * t.force_n;
  t.by_velocity = active * fv_v;
  const double by_own_activation = strength * fv + t.by_length * l0 * p[kLengthActivation];
  t.by_activation = p[kShare] * by_own_activation;
  t.by_field[kMaxForce] = t.force_n / p[kMaxForce];
  t.by_field[kFiberLength] = -t.by_length * stretch;
  t.by_field[kWidth] = 2.0 * z * z * inverse_width * t.force_n;
  t.by_field[kCurvature] = active * fv_sh;
  t.by_field[kProduct] = active * fv_p;
  t.by_field[kPlateau] = active * fv_ml;
  t.by_field[kSpeed] = active * fv_vm;
  t.by_field[kSlack] = -t.by_length;
  t.by_field[kLengthActivation] = -t.by_length * l0 * (1.0 - a);
  t.by_field[kShare] = by_own_activation * activation;
}

double tension_n(double activation, double length_m, double velocity_mps, const MuscleValues& p) {
  if (!is_plain(p)) return tension(activation, length_m, velocity_mps, p).force_n;
  Tension t;
  plain_tension(activation, length_m, velocity_mps, p, t);
  return t.force_n;
}

}  // namespace myoid::identification
