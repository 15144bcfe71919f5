#include "myoid/body/simulation/simulation_record.h"

#include <utility>

#include <fmt/format.h>

namespace myoid::body {
namespace {

using Record = SimulationRecord;

constexpr const char* kMuscleWorkNames[Record::kMuscleWorks] = {"active", "passive",       "viscous",
                                                                "tendon", "musculotendon", "kinetic"};
constexpr const char* kJointWorkNames[Record::kJointWorks] = {"gravity_work", "joint_elastic_work",
                                                              "joint_viscous_work", "external_work"};
constexpr const char* kTorqueNames[Record::kTorques] = {"muscles", "gravity", "joint", "external", "device"};
constexpr const char* kStoredNames[Record::kStored] = {"passive", "tendon", "kinetic"};
constexpr const char* kStoredTogetherNames[Record::kStoredTogether] = {"skeleton_kinetic_energy", "gravity_energy",
                                                                       "joint_elastic_energy"};

std::vector<Channel> energy_channels(const std::vector<std::string>& muscles) {
  std::vector<Channel> channels;
  const auto add = [&](std::string name) { channels.push_back({std::move(name), Unit::newton_meter}); };
  for (const std::string& muscle : muscles) {
    for (const char* what : kMuscleWorkNames) add(fmt::format("{}_{}_work", muscle, what));
  }
  for (const char* what : kJointWorkNames) add(what);
  for (const std::string& muscle : muscles) {
    for (const char* what : kStoredNames) add(fmt::format("{}_{}_energy", muscle, what));
  }
  for (const char* what : kStoredTogetherNames) add(what);
  return channels;
}

}  // namespace

SimulationRecord::SimulationRecord(std::vector<std::string> muscle_names,
                                   std::vector<Coordinate> coordinates_in_order,
                                   std::size_t rows,
                                   bool with_energy)
    : muscles(std::move(muscle_names)), coordinates(std::move(coordinates_in_order)) {
  const auto row_count = static_cast<Eigen::Index>(rows), n = std::ssize(muscles), nq = std::ssize(coordinates);
  motion.resize(row_count, kMotions * nq);
  torque.resize(row_count, kTorques * nq);
  moment_arm.resize(row_count, nq * n);
  for (auto* m : {&excitation, &activation, &length, &velocity, &fiber_length, &fiber_velocity, &tendon_length,
                  &fiber_force, &tendon_force})
    m->resize(row_count, n);
  if (with_energy) energy.resize(row_count, std::ssize(energy_channels(muscles)));
}

void SimulationRecord::write_to(Simulation& result, const Eigen::VectorXd& time_s) const {
  const auto series = [&](std::vector<Channel> channels, const Eigen::MatrixXd& values) {
    return TimeSeries(time_s, std::move(channels), values.topRows(time_s.size()));
  };
  const auto per_muscle = [&](const Eigen::MatrixXd& values, Unit unit) {
    std::vector<Channel> channels;
    for (const std::string& muscle : muscles) channels.push_back({muscle, unit});
    return series(std::move(channels), values);
  };
  std::vector<Channel> motions, torques, arms;
  for (const auto& [name, turns] : coordinates) {
    const auto of_coordinate = [&, &name = name](std::string_view what) {
      return coordinates.size() == 1 ? std::string(what) : fmt::format("{}/{}", name, what);
    };
    motions.push_back({name, turns ? Unit::radian : Unit::meter});
    motions.push_back({name + "_speed", turns ? Unit::radian_per_second : Unit::meter_per_second});
    motions.push_back({name + "_acceleration", turns ? Unit::radian_per_second2 : Unit::meter_per_second2});
    for (const char* what : kTorqueNames)
      torques.push_back({of_coordinate(what), turns ? Unit::newton_meter : Unit::newton});
    for (const std::string& muscle : muscles) arms.push_back({of_coordinate(muscle), Unit::meter});
  }
  result.motion = series(std::move(motions), motion);
  result.torque = series(std::move(torques), torque);
  result.moment_arm = series(std::move(arms), moment_arm);
  result.excitation = per_muscle(excitation, Unit::dimensionless);
  result.activation = per_muscle(activation, Unit::dimensionless);
  result.musculotendon_length = per_muscle(length, Unit::meter);
  result.musculotendon_velocity = per_muscle(velocity, Unit::meter_per_second);
  result.fiber_length = per_muscle(fiber_length, Unit::meter);
  result.fiber_velocity = per_muscle(fiber_velocity, Unit::meter_per_second);
  result.tendon_length = per_muscle(tendon_length, Unit::meter);
  result.fiber_force = per_muscle(fiber_force, Unit::newton);
  result.tendon_force = per_muscle(tendon_force, Unit::newton);
  if (energy.cols() > 0) result.energy = series(energy_channels(muscles), energy);
}

}  // namespace myoid::body
