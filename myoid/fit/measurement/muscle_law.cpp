#include "myoid/fit/measurement/muscle_law.h"

#include <algorithm>
#include <cmath>

namespace myoid::fit {
namespace {

/// f_v at one rate and its derivatives.
struct ForceVelocity {
  double value = 0.0, by_velocity = 0.0, by_speed = 0.0, by_curvature = 0.0, by_product = 0.0, by_plateau = 0.0;
};

/// Evaluates equation (4) of the source paper, v positive in lengthening [m/s]; 0 at -v_max and below.
ForceVelocity velocity_factor(double v, const MuscleValues& p) {
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

constexpr double kTendonScale = 0.2;               // scale of De Groote's exponential tendon
constexpr double kTendonRise = 1.791759469228055;  // ln(1 / 0.2 + 1): tension 1 at strain e0
constexpr double kPassiveOnset = 0.05;             // of the optimal length, to either side of it

using Fields = std::array<double, kMuscleFieldCount>;

/// Force over F_max and its derivatives.
struct Pull {
  double force = 0.0;
  double by_activation = 0.0, by_length = 0.0, by_velocity = 0.0;
};

/// A muscle without its tendon at one activation and rate.
class Contraction {
 public:
  Contraction(double a, double v_mt, const MuscleValues& p)
      : p_(p),
        a_(a),
        v_mt_(v_mt),
        stretch_(1.0 + p[kLengthActivation] * (1.0 - a)),
        sine_(p[kPennation] == 0.0 ? 0.0 : std::sin(p[kPennation])),
        passive_top_(std::exp(p[kPassiveShape]) - 1.0) {
    if (p[kPennation] == 0.0) of_velocity_ = velocity_factor(v_mt, p);
  }

  /// Returns the pull along the tendon at the projected length l cos(alpha). Writes the derivatives
  /// by field to `by_field` unless null.
  Pull at(double along, Fields* by_field) const {
    if (by_field != nullptr) by_field->fill(0.0);
    if (p_[kPennation] == 0.0) return fiber(along, of_velocity_, by_field);
    if (along <= 0.0) return {};
    const double h = p_[kFiberLength] * sine_;
    const double l = std::sqrt(h * h + along * along);
    const double c = along / l;
    const double c_along = h * h / (l * l * l);
    const double c_h = -along * h / (l * l * l);
    const Pull f = fiber(l, velocity_factor(v_mt_ * c, p_), by_field);
    Pull r;
    r.force = f.force * c;
    r.by_activation = f.by_activation * c;
    r.by_velocity = f.by_velocity * c * c;
    r.by_length = (f.by_length * c + f.by_velocity * v_mt_ * c_along) * c + f.force * c_along;
    if (by_field == nullptr) return r;
    const double by_h = (f.by_length * h / l + f.by_velocity * v_mt_ * c_h) * c + f.force * c_h;
    for (double& d : *by_field) d *= c;
    (*by_field)[kFiberLength] += by_h * sine_;
    (*by_field)[kPennation] = by_h * p_[kFiberLength] * std::cos(p_[kPennation]);
    return r;
  }

 private:
  Pull fiber(double l, const ForceVelocity& of_velocity, Fields* by_field) const {
    const double l0 = p_[kFiberLength], w = p_[kWidth];
    const double z = (l - l0 * stretch_) / w;
    const double fl = std::exp(-z * z);
    const double fl_l = -2.0 * z / w * fl;
    const double fv = of_velocity.value;
    Pull f;
    f.force = a_ * fl * fv;
    f.by_activation = fl * fv + a_ * fl_l * fv * l0 * p_[kLengthActivation];
    f.by_length = a_ * fl_l * fv;
    f.by_velocity = a_ * fl * of_velocity.by_velocity;
    if (by_field != nullptr) {
      Fields& by = *by_field;
      by[kFiberLength] = -a_ * fl_l * fv * stretch_;
      by[kWidth] = a_ * fv * 2.0 * z * z / w * fl;
      by[kCurvature] = a_ * fl * of_velocity.by_curvature;
      by[kProduct] = a_ * fl * of_velocity.by_product;
      by[kPlateau] = a_ * fl * of_velocity.by_plateau;
      by[kSpeed] = a_ * fl * of_velocity.by_speed;
      by[kLengthActivation] = -a_ * fl_l * fv * l0 * (1.0 - a_);
    }
    if (l > (1.0 - kPassiveOnset) * l0) add_passive(l, f, by_field);
    return f;
  }

  void add_passive(double l, Pull& f, Fields* by_field) const {
    const double c = p_[kPassiveForce];
    if (c == 0.0 && by_field == nullptr) return;
    const double l0 = p_[kFiberLength], k = p_[kPassiveShape], e = p_[kPassiveStrain];
    const double strain = l / l0 - 1.0, within = std::min(strain, kPassiveOnset) + kPassiveOnset;
    const double x = (within * within / (4.0 * kPassiveOnset) + std::max(strain - kPassiveOnset, 0.0)) / e;
    const double slope = within / (2.0 * kPassiveOnset * e);  // dx / d strain
    const double grown = std::exp(k * x) - 1.0;
    const double by_x = c * k * (grown + 1.0) / passive_top_;
    f.force += c * grown / passive_top_;
    f.by_length += by_x * slope / l0;
    if (by_field == nullptr) return;
    Fields& by = *by_field;
    by[kPassiveForce] = grown / passive_top_;  // also where the amount c is 0
    if (c == 0.0) return;
    by[kFiberLength] -= by_x * slope * l / (l0 * l0);
    by[kPassiveStrain] = -by_x * x / e;
    by[kPassiveShape] =
        c * (x * (grown + 1.0) * passive_top_ - grown * (passive_top_ + 1.0)) / (passive_top_ * passive_top_);
  }

  const MuscleValues& p_;
  double a_, v_mt_, stretch_, sine_, passive_top_;
  ForceVelocity of_velocity_;  ///< without pennation the same at every length
};

/// Returns the strain at which tendon and muscle pull equally, the root of
///
///   u(s) = ln(1 + m(s) / 0.2) / rise - s
///
/// where m is the muscle's pull, by Newton's steps within a bracket. u is nearly a line, because the logarithm cancels
/// the tendon's exponential and the remaining slope of m is small beside 1. A step of 3e-9 leaves an error below 1e-16.
/// `muscle` is the muscle's Pull over the projected length l cos(alpha).
template <typename Muscle>
double tendon_strain(const Muscle& muscle, double start, double l_mt, double slack, double rise) {
  constexpr double kLastStep = 3e-9, kLongest = 10.0;
  double low = -1.0, high = kLongest;                             // the tendon does not push: low is 0 once 0 was tried
  double strain = start > 0.0 ? std::min(start, kLongest) : 0.0;  // also where the sample before had none
  for (int i = 0; i < 200; ++i) {
    const Pull m = muscle(l_mt - slack * (1.0 + strain));
    if (strain == 0.0 && m.force <= 0.0) return 0.0;
    const double u = std::log(1.0 + m.force / kTendonScale) / rise - strain;
    const double slope = -m.by_length * slack / (rise * (kTendonScale + m.force)) - 1.0;
    (u > 0.0 ? low : high) = strain;
    double next = slope < 0.0 ? std::max(strain - u / slope, 0.0) : high;
    if (std::abs(next - strain) <= kLastStep) return next;
    if (!(next > low && next < high)) {
      const double from = std::max(low, 0.0);
      next = 0.5 * (from + std::min(high, 2.0 * from + 0.1));
    }
    strain = next;
  }
  return strain;
}

bool is_elastic(const MuscleValues& p) { return p[kTendonStrain] > 0.0 && p[kSlack] > 0.0; }

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

Tension tension(double activation, double length_m, double velocity_mps, const MuscleValues& p) {
  const double a = p[kShare] * activation;
  const double greatest = p[kMaxForce];
  const double slack = p[kSlack];
  const Contraction muscle(a, velocity_mps, p);
  const bool elastic = is_elastic(p);
  const double rise = elastic ? kTendonRise / p[kTendonStrain] : 0.0;
  const auto alone = [&](double along) { return muscle.at(along, nullptr); };
  const auto guess = [&] { return 0.6 * std::log(1.0 + std::max(a, 0.0) / kTendonScale) / rise; };
  const double strain = elastic ? tendon_strain(alone, guess(), length_m, slack, rise) : 0.0;
  Tension t;
  t.strain = strain;
  Pull m = muscle.at(length_m - slack * (1.0 + strain), &t.by_field);
  if (elastic) m.force = std::max(m.force, 0.0);  // a tendon cannot push
  // G = muscle - tendon = 0 gives d strain / d x = G_x / (m_length l_ts + pull').
  const double grown = kTendonScale + m.force;
  const double stiff = elastic ? rise * grown / (m.by_length * slack + rise * grown) : 1.0;
  const double scale = greatest * stiff;
  for (double& d : t.by_field) d *= scale;
  t.force_n = greatest * m.force;
  t.by_field[kMaxForce] = m.force;
  t.by_field[kSlack] = -scale * m.by_length * (1.0 + strain);
  if (elastic) {
    const double by_e0 = -grown * strain * rise / p[kTendonStrain];
    t.by_field[kTendonStrain] = greatest * by_e0 * (1.0 - stiff);
  }
  t.by_length = scale * m.by_length;
  t.by_velocity = scale * m.by_velocity;
  t.by_activation = scale * m.by_activation;
  t.by_field[kShare] = t.by_activation * activation;
  t.by_activation *= p[kShare];
  return t;
}

bool is_plain(const MuscleValues& p) { return p[kPennation] == 0.0 && p[kPassiveForce] == 0.0; }

void plain_tension(double activation, double length_m, double velocity_mps, const MuscleValues& p, Tension& t) {
  const double a = p[kShare] * activation;
  const double v = velocity_mps;
  const double l0 = p[kFiberLength], slack = p[kSlack], greatest = p[kMaxForce];
  const double stretch = 1.0 + p[kLengthActivation] * (1.0 - a);
  const double inverse_width = 1.0 / p[kWidth];
  const auto [fv, fv_v, fv_vm, fv_sh, fv_p, fv_ml] = velocity_factor(v, p);
  const bool elastic = is_elastic(p);
  const double rise = elastic ? kTendonRise / p[kTendonStrain] : 0.0;
  if (elastic) {
    const auto alone = [&, fv = fv](double along) {
      const double z = (along - l0 * stretch) * inverse_width;
      const double force = a * fv * std::exp(-z * z);
      return Pull{.force = force, .by_length = -2.0 * z * inverse_width * force};
    };
    t.strain = tendon_strain(alone, t.strain, length_m, slack, rise);
  } else {
    t.strain = 0.0;
  }
  const double z = (length_m - slack * (1.0 + t.strain) - l0 * stretch) * inverse_width;
  const double gauss = std::exp(-z * z);
  const double force = elastic ? std::max(a * fv * gauss, 0.0) : a * fv * gauss;  // a tendon cannot push
  const double grown = kTendonScale + force;
  const double by_fiber = -2.0 * z * inverse_width * force;
  const double stiff = elastic ? rise * grown / (by_fiber * slack + rise * grown) : 1.0;
  const double strength = greatest * stiff * gauss;  // behind the tendon's stiffness, at full activation, at rest
  const double active = a * strength;
  t.force_n = greatest * force;
  t.by_length = greatest * stiff * by_fiber;
  t.by_velocity = active * fv_v;
  const double by_own_activation = strength * fv + t.by_length * l0 * p[kLengthActivation];
  t.by_activation = p[kShare] * by_own_activation;
  t.by_field[kMaxForce] = force;
  t.by_field[kFiberLength] = -t.by_length * stretch;
  t.by_field[kWidth] = -t.by_length * z;
  t.by_field[kCurvature] = active * fv_sh;
  t.by_field[kProduct] = active * fv_p;
  t.by_field[kPlateau] = active * fv_ml;
  t.by_field[kSpeed] = active * fv_vm;
  t.by_field[kSlack] = -t.by_length * (1.0 + t.strain);
  t.by_field[kLengthActivation] = -t.by_length * l0 * (1.0 - a);
  t.by_field[kTendonStrain] = elastic ? -greatest * grown * t.strain * rise / p[kTendonStrain] * (1.0 - stiff) : 0.0;
  t.by_field[kShare] = by_own_activation * activation;
}

double tension_n(double activation, double length_m, double velocity_mps, const MuscleValues& p) {
  if (!is_plain(p)) return tension(activation, length_m, velocity_mps, p).force_n;
  Tension t;
  plain_tension(activation, length_m, velocity_mps, p, t);
  return t.force_n;
}

}  // namespace myoid::fit
