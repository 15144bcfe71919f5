#include "myoid/fit/measurement/fiber.h"

#include <algorithm>
#include <cmath>

namespace myoid::fit {

Fiber fiber(double force_n, double length_m, const MuscleValues& p) {
  static const double kRise = std::log(6.0);
  const double slack = p[kSlack], greatest = p[kMaxForce];
  const double share = std::max(force_n / greatest, 0.0);
  const bool elastic = p[kTendonStrain] > 0.0 && slack > 0.0;
  const double shape = elastic ? std::log1p(5.0 * share) / kRise : 0.0;  // strain over that at F_max
  const double by_share = elastic ? slack * p[kTendonStrain] * 5.0 / (kRise * (1.0 + 5.0 * share)) : 0.0;
  const double strain = shape * p[kTendonStrain];
  const double sine = std::sin(p[kPennation]), across = p[kFiberLength] * sine;
  const double along = std::max(length_m - slack * (1.0 + strain), 0.0);
  Fiber f;
  f.length_m = std::hypot(along, across);
  if (!(f.length_m > 0.0)) return f;
  const double cosine = along / f.length_m, of_across = across / f.length_m;
  f.by_field[kFiberLength] = of_across * sine;
  f.by_field[kPennation] = of_across * p[kFiberLength] * std::cos(p[kPennation]);
  f.by_length = cosine;
  f.by_force = -cosine * by_share / greatest;
  f.by_field[kMaxForce] = cosine * by_share * share / greatest;
  f.by_field[kSlack] = -cosine * (1.0 + strain);
  f.by_field[kTendonStrain] = -cosine * slack * shape;
  return f;
}

FiberRows fiber_rows(const MuscleRows& rows,
                     const Eigen::Ref<const Eigen::VectorXd>& length_m,
                     const MuscleValues& values,
                     const std::vector<ParameterMap::Chain>& of_muscle) {
  const Eigen::Index n = length_m.size();
  FiberRows found{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), rows.by_variable};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Fiber here = fiber(rows.force_n[i], length_m[i], values);
    found.length_m[i] = here.length_m;
    found.by_force[i] = here.by_force;
    found.by_length[i] = here.by_length;
    found.by_variable.col(i) *= here.by_force;
    for (std::size_t v = 0; v < of_muscle.size(); ++v)
      found.by_variable(static_cast<Eigen::Index>(v), i) +=
          here.by_field[static_cast<std::size_t>(of_muscle[v].field)] * of_muscle[v].slope;
  }
  return found;
}

}  // namespace myoid::fit
