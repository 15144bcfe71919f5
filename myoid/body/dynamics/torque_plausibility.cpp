#include "myoid/body/dynamics/torque_plausibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/model/model_plausibility.h"

namespace myoid::body {

double usual_peak(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<double> sizes;
  for (const double v : values) {
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  }
  if (sizes.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + at, sizes.end());
  return sizes[static_cast<std::size_t>(at)];
}

std::string too_much_torque(const std::string& coordinate,
                            double peak_nm,
                            double greatest_nm,
                            const std::string& what_it_is,
                            TorqueSource source) {
  if (!(peak_nm > greatest_nm)) return {};
  const char* remedy = source == TorqueSource::computed
                           ? ""
                           : (peak_nm < 1000.0 * greatest_nm
                                  ? "; is it in N mm? Divide by 1000, or correct the unit in its column's name "
                                    "(Myoid's torques are in N m)"
                                  : "; correct its unit (N m)");
  return fmt::format(
      "{} reaches {:.4g} N m at {}, beyond what the strongest person's muscles and weight do there "
      "in this model, {:.3g} N m{}",
      what_it_is, peak_nm, coordinate, greatest_nm, remedy);
}

std::vector<Remark> implausible_torques(const body::BodyModel& model,
                                        const TimeSeries& generalized_forces,
                                        double body_mass_kg) {
  // Masses in grams must not raise the limit.
  if (!(body_mass_kg > 0.0)) body_mass_kg = std::clamp(body::mass_kg(model), kLightBody_kg, kHeavyBody_kg);
  body::BodyModel without_muscles = model;
  without_muscles.muscles.clear();
  std::vector<std::pair<double, Remark>> found;
  for (const body::Coordinate& coordinate : model.coordinates) {
    const auto column = coordinate.motion == body::MotionType::rotational
                            ? generalized_forces.find(generalized_force_name(coordinate))
                            : std::nullopt;
    if (!column) continue;
    const double peak_nm = usual_peak(generalized_forces.values().col(*column));
    // The paths of muscles take time: most torques are below the limit by weight alone.
    if (peak_nm <= joint_capacity(without_muscles, coordinate.name, body_mass_kg).greatest_nm()) continue;
    const double greatest_nm = joint_capacity(model, coordinate.name, body_mass_kg).greatest_nm();
    std::string says = too_much_torque(coordinate.name, peak_nm, greatest_nm, "the torque", TorqueSource::computed);
    if (says.empty()) continue;
    found.emplace_back(peak_nm / std::max(greatest_nm, 1e-300),
                       Remark{.code = RemarkCode::torque_impossible,
                              .severity = Severity::error,
                              .about = coordinate.name,
                              .value = peak_nm,
                              .says = std::move(says),
                              .remedy = "correct the masses, the loads, their units, or the clock of the motion"});
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<double, Remark>::first);
  std::vector<Remark> remarks;
  for (auto& [over, remark] : found) remarks.push_back(std::move(remark));
  return remarks;
}

}  // namespace myoid::body
