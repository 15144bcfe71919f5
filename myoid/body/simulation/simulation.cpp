#include "myoid/body/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {

Device locked() {
  return {[](double) { return 0.0; }, {}};
}

EnergyBalance energy_balance(const Simulation& simulation) {
  const TimeSeries& e = simulation.energy;
  if (e.sample_count() < 2) {
    throw InvalidInput(
        "energy balance: the simulation holds no energies; ask for them with `energy`, and for two "
        "output times at least");
  }
  const Eigen::Index last_row = e.sample_count() - 1;
  const auto change = [&](const std::string& name) {
    const Eigen::Index c = e.index(name);
    return e.values()(last_row, c) - e.values()(0, c);
  };
  EnergyBalance balance;
  double muscles = 0.0;
  std::vector<std::pair<std::string, double>> gaps;
  for (const Channel& channel : simulation.tendon_force.channels()) {
    const std::string& m = channel.name;
    const double active = change(m + "_active_work");
    const double viscous = change(m + "_viscous_work");
    const double whole = change(m + "_musculotendon_work");
    double stored = 0.0;
    for (const std::string_view part : {"passive", "tendon", "kinetic"}) {
      const double gained = change(fmt::format("{}_{}_energy", m, part));
      gaps.emplace_back(fmt::format("{} {}", m, part), gained + change(fmt::format("{}_{}_work", m, part)));
      stored += gained;
    }
    gaps.emplace_back(m, active + viscous - stored - whole);
    muscles += whole;
    balance.turned_over_j += std::abs(active) + std::abs(viscous);
  }
  const double gravity = change("gravity_work");
  const double elastic = change("joint_elastic_work");
  gaps.emplace_back("gravity", gravity + change("gravity_energy"));
  gaps.emplace_back("joints", elastic + change("joint_elastic_energy"));
  gaps.emplace_back("skeleton", muscles + gravity + elastic + change("joint_viscous_work") + change("external_work") -
                                    change("skeleton_kinetic_energy"));
  // Without muscles the works of gravity and the joints are the scale.
  if (balance.turned_over_j == 0.0) {
    balance.turned_over_j = std::abs(gravity) + std::abs(elastic) + std::abs(change("joint_viscous_work")) +
                            e.values().col(e.index("skeleton_kinetic_energy")).maxCoeff();
  }
  for (const auto& [where, gap] : gaps) {
    const double relative = balance.turned_over_j > 0.0 ? std::abs(gap) / balance.turned_over_j : std::abs(gap);
    if (relative >= balance.worst) {
      balance.worst = relative;
      balance.where = where;
    }
  }
  return balance;
}

}  // namespace myoid::body
