#include "myoid/results/exports/exported_curves.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/muscle/force_length.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::results {
namespace {

std::vector<double> evenly(double low, double high, double step) {
  std::vector<double> x;
  const std::int64_t last = std::llround(high / step);
  for (std::int64_t k = std::llround(low / step); k <= last; ++k) x.push_back(step * static_cast<double>(k));
  return x;
}

template <typename Law>
opensim::ProjectCurve table(std::string name, std::vector<double> x, const Law& law) {
  opensim::ProjectCurve curve{std::move(name), std::move(x), {}};
  for (const double each : curve.x) curve.y.push_back(law(each));
  return curve;
}

}  // namespace

std::vector<opensim::ProjectCurve> exported_curves(const fit::MuscleValues& unit, double speed, bool with_tendon) {
  const muscle::HillParameters<double> hill = fit::hill_parameters(unit);
  const auto passive = [&](double l) {
    if (l <= 1.0) return 0.0;
    const double k = unit[fit::kPassiveShape];
    return unit[fit::kPassiveForce] * std::expm1(k * (l - 1.0) / unit[fit::kPassiveStrain]) / std::expm1(k);
  };
  std::vector<double> v{-10.0, -5.0, -2.0};
  for (const double each : evenly(-1.2, 1.2, 0.02)) v.push_back(each);
  for (const double each : {2.0, 5.0, 10.0}) v.push_back(each);
  for (double& each : v) each *= speed;
  std::vector<opensim::ProjectCurve> tables{
      table("activeForceLength", evenly(0.0, 2.5, 0.02),
            [&](double l) { return muscle::force_length(l, 1.0, unit[fit::kWidth]); }),
      table("passiveForceLength", evenly(0.0, 2.5, 0.02), passive), table("forceVelocity", std::move(v), [&](double x) {
        return muscle::force_velocity(hill.velocity_law(), x / speed).value;
      })};
  if (with_tendon)
    tables.push_back(table("tendonForceStrain",
                           evenly(0.0, 3.0 * unit[fit::kTendonStrain], unit[fit::kTendonStrain] / 40.0),
                           [&](double s) { return 0.2 * std::expm1(std::log(6.0) * s / unit[fit::kTendonStrain]); }));
  return tables;
}

}  // namespace myoid::results
