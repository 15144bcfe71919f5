#include "myoid/results/simulation_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/muscle/force_length.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"
#include "myoid/page/json_values.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/results/stage_files.h"

namespace myoid::results {
namespace {

using body::Simulation;

std::string made_by(const Provenance& provenance) {
  return fmt::format("{} {}: {}", provenance.program, provenance.version, provenance.command);
}

std::size_t coordinate_count(const Simulation& s) { return static_cast<std::size_t>(s.motion.channel_count()) / 3; }
std::string coordinate_name(const Simulation& s, std::size_t k) { return s.motion.channels()[3 * k].name; }

/// Returns columns first, first + stride, ... under names without `ending`.
TimeSeries every(const TimeSeries& series, Eigen::Index first, Eigen::Index stride, std::string_view ending) {
  SeriesColumns columns;
  for (Eigen::Index c = first; c < series.channel_count(); c += stride) {
    const Channel& channel = series.channels()[at(c)];
    columns.add(channel.name.substr(0, channel.name.size() - ending.size()), channel.unit, series.values().col(c));
  }
  return columns.series(series.time_s());
}

TimeSeries with_held(const TimeSeries& q, const HeldCoordinates& held) {
  SeriesColumns columns;
  for (const auto& [name, value] : held)
    columns.add(name, Unit::radian, Eigen::VectorXd::Constant(q.sample_count(), value));
  for (Eigen::Index c = 0; c < q.channel_count(); ++c)
    columns.add(q.channels()[at(c)].name, q.channels()[at(c)].unit, q.values().col(c));
  return columns.series(q.time_s());
}

/// Begins with the torques of inverse dynamics: muscles, joint, external and device together.
TimeSeries torques(const Simulation& s) {
  SeriesColumns columns;
  for (std::size_t k = 0; k < coordinate_count(s); ++k) {
    const Unit unit = s.torque.channels()[5 * k].unit;
    const std::string name = coordinate_name(s, k) + (unit == Unit::newton_meter ? "_moment" : "_force");
    const auto& parts = s.torque.values().middleCols(5 * static_cast<Eigen::Index>(k), 5);
    columns.add(name, unit, parts.col(0) + parts.col(2) + parts.col(3) + parts.col(4));
    Eigen::Index part = 0;
    for (const char* what : {"_muscles", "_gravity", "_joint", "_external", "_device"})
      columns.add(name + what, unit, parts.col(part++));
  }
  return columns.series(s.torque.time_s());
}

TimeSeries states(const Simulation& s) {
  SeriesColumns columns;
  const auto add = [&](const std::string& name, const TimeSeries& from, Eigen::Index c) {
    columns.add(name, from.channels()[at(c)].unit, from.values().col(c));
  };
  for (std::size_t k = 0; k < coordinate_count(s); ++k) {
    const std::string name = coordinate_name(s, k);
    add(name + "/value", s.motion, 3 * static_cast<Eigen::Index>(k));
    add(name + "/speed", s.motion, 3 * static_cast<Eigen::Index>(k) + 1);
  }
  for (Eigen::Index i = 0; i < s.activation.channel_count(); ++i) {
    const std::string& name = s.activation.channels()[at(i)].name;
    add(name + "/activation", s.activation, i);
    add(name + "/fiber_length", s.fiber_length, i);
    add(name + "/fiber_velocity", s.fiber_velocity, i);
  }
  return columns.series(s.motion.time_s());
}

void add(page::Panel& target,
         const TimeSeries& series,
         Eigen::Index column,
         std::string name,
         page::Role role,
         double scale = 1.0) {
  target.series.push_back({.name = std::move(name),
                           .x = page::to_vector(series.time_s()),
                           .y = page::to_vector(scale * series.values().col(column)),
                           .role = role});
}

constexpr page::Role kRoles[] = {page::Role::reference, page::Role::identified, page::Role::literature,
                                 page::Role::truth};

/// Returns a panel of one quantity of at most four muscles: colors and dashes tell the roles apart.
page::Panel muscle_panel(
    std::string title, std::string label, std::string unit, const TimeSeries& series, double scale = 1.0) {
  page::Panel panel = page::time_panel(std::move(title), std::move(label), std::move(unit));
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(series.channel_count(), 4); ++i) {
    const auto k = static_cast<std::size_t>(i);
    add(panel, series, i, series.channels()[k].name, kRoles[k], scale);
  }
  return panel;
}

page::Figure curves_figure() {
  page::Figure figure{.id = "figure2",
                      .title = "Force over velocity and force over length",
                      .caption =
                          "Figure 2 of the source paper: equations (4) and (3) with its initial values V_sh 0.3, "
                          "V_sh V_shl 0.12, V_ml 1.3 and the widths of its tables; v over v_max, l_m over l_m0.",
                      .columns = 2};
  page::Panel velocity{
      .title = "f_v", .x = {.label = "fiber velocity / v_max"}, .y = {.label = "f_v", .lower = 0.0, .upper = 1.4}};
  const muscle::VelocityHyperbola<double> law{muscle::kPaperCurvature, muscle::kPaperCurvatureProduct,
                                              muscle::kPaperPlateau};
  page::Series curve{.name = "", .role = page::Role::reference};
  for (int k = -120; k <= 120; ++k) {
    curve.x.push_back(0.01 * k);
    curve.y.push_back(muscle::force_velocity(law, 0.01 * k).value);
  }
  velocity.series.push_back(std::move(curve));
  page::Panel length{
      .title = "f_l", .x = {.label = "fiber length / l_m0"}, .y = {.label = "f_l", .lower = 0.0, .upper = 1.1}};
  std::size_t role = 0;
  for (const muscle::PaperMuscle& m : muscle::kPaperMuscles) {
    page::Series line{.name = std::string(m.name), .role = kRoles[role++]};
    for (int k = 40; k <= 160; ++k) {
      line.x.push_back(0.01 * k);
      line.y.push_back(
          muscle::force_length(0.01 * k * m.optimal_fiber_length_m, m.optimal_fiber_length_m, m.force_length_width_m));
    }
    length.series.push_back(std::move(line));
  }
  figure.panels = {std::move(velocity), std::move(length)};
  return figure;
}

/// Simulates flexors and extensor in turn, half a second each, so that the elbow flexes and extends.
Simulation paper_movement() {
  body::ArmSetup setup;
  setup.horizontal = true;
  setup.model.mode = muscle::TendonMode::mass;
  const body::Burst flex[] = {{0.2, 0.3, 0.06}, {1.7, 0.3, 0.06}};
  const body::Burst extend[] = {{0.55, 0.3, 0.09}, {1.1, 0.3, 0.05}, {2.05, 0.3, 0.09}};
  body::SimulationInput input;
  const body::Signal flexor = body::bursts(flex, 0.01);
  input.excitation = {flexor, flexor, flexor, body::bursts(extend, 0.01)};
  return body::simulate(body::make_arm_model(setup), input, {.q = {0.7}}, {.end_s = 3.0});
}

}  // namespace

page::Figure movement_figure(const Simulation& s) {
  page::Figure figure{.id = "movement",
                      .title = "Simulated movement",
                      .caption =
                          "Excitations of the muscles, motion of the joints, and lengths and forces of the muscles; "
                          "at most four of each quantity.",
                      .columns = 2};
  page::Panel angle = page::time_panel("Joint angle", "angle", "deg");
  page::Panel speed = page::time_panel("Joint speed", "speed", "deg/s");
  page::Panel torque = page::time_panel("Torque of the muscles", "torque", "N m");
  std::size_t shown = 0;
  for (std::size_t k = 0; k < coordinate_count(s) && shown < 4; ++k) {
    const auto c = static_cast<Eigen::Index>(k);
    const auto& column = s.motion.values().col(3 * c);
    const bool moves = column.maxCoeff() - column.minCoeff() > 1e-6;
    if (s.motion.channels()[3 * k].unit != Unit::radian || (!moves && coordinate_count(s) > 1)) continue;
    const std::string name = coordinate_count(s) == 1 ? "" : coordinate_name(s, k);
    add(angle, s.motion, 3 * c, name, kRoles[shown], 1.0 / kDegree);
    add(speed, s.motion, 3 * c + 1, name, kRoles[shown], 1.0 / kDegree);
    add(torque, s.torque, 5 * c, name, kRoles[shown]);
    ++shown;
  }
  figure.panels = {muscle_panel("Neural input", "excitation", "", s.excitation),
                   muscle_panel("Muscle activity", "activation", "", s.activation),
                   std::move(angle),
                   std::move(speed),
                   std::move(torque),
                   muscle_panel("Tendon force", "force", "N", s.tendon_force),
                   muscle_panel("Fiber length", "length", "cm", s.fiber_length, 100.0),
                   muscle_panel("Fiber velocity", "velocity", "cm/s", s.fiber_velocity, 100.0)};
  std::erase_if(figure.panels, [](const page::Panel& p) { return p.series.empty(); });
  return figure;
}

std::vector<page::Figure> paper_figures() {
  page::Figure movement = movement_figure(paper_movement());
  movement.id = "figure4";
  movement.title = "Simulation of the flexion and extension of the elbow";
  movement.caption =
      "Figure 4 of the source paper: the built-in arm in the horizontal plane, four muscles with mass and elastic "
      "tendons, under steps of neural input.";
  return {curves_figure(), std::move(movement)};
}

std::string simulation_json(const Simulation& s, const Provenance& provenance) {
  nlohmann::ordered_json json = page::provenance_json(provenance);
  json.update({{"finished", s.status == math::OdeStatus::done},
               {"message", s.message},
               {"reached_s", s.reached_s},
               {"samples", s.motion.sample_count()},
               {"steps", s.statistics.steps},
               {"rejected_steps", s.statistics.rejected},
               {"rate_evaluations", s.statistics.rate_evaluations},
               {"kinks_located", s.statistics.events},
               {"jumps_passed", s.jumps_passed}});
  if (s.energy.sample_count() > 1) {
    const body::EnergyBalance balance = body::energy_balance(s);
    json["energy"] = {
        {"turned_over_j", balance.turned_over_j}, {"worst_relative_gap", balance.worst}, {"where", balance.where}};
  }
  return json_text(json) + "\n";
}

void write_simulation(const Simulation& s,
                      const body::BodyModel& body,
                      const HeldCoordinates& held,
                      const Provenance& provenance,
                      const std::filesystem::path& folder) {
  const std::vector<std::string> comments = {made_by(provenance)};
  const auto write = [&](const std::string& file, const TimeSeries& series, std::string title) {
    if (series.channel_count() == 0) return;
    recording::write_storage(folder / file, series, {.title = std::move(title), .comments = comments});
  };
  write_motion(body, with_held(every(s.motion, 0, 3, ""), held), folder / "motion.mot", comments);
  write("speeds.sto", every(s.motion, 1, 3, "_speed"), "Speeds");
  write("accelerations.sto", every(s.motion, 2, 3, "_acceleration"), "Accelerations");
  write("excitation.sto", s.excitation, "controls");
  write("activation.sto", s.activation, "Activations");
  write("forces.sto", s.tendon_force, "TendonForces");
  write("fiber_forces.sto", s.fiber_force, "FiberForces");
  write("MuscleAnalysis_Length.sto", s.musculotendon_length, "Length");
  write("MuscleAnalysis_MuscleTendonVelocity.sto", s.musculotendon_velocity, "MuscleTendonVelocity");
  write("MuscleAnalysis_FiberLength.sto", s.fiber_length, "FiberLength");
  write("MuscleAnalysis_FiberVelocity.sto", s.fiber_velocity, "FiberVelocity");
  write("MuscleAnalysis_TendonLength.sto", s.tendon_length, "TendonLength");
  const Eigen::Index n = s.fiber_length.channel_count();
  std::vector<std::string> coordinates;
  for (std::size_t k = 0; k < coordinate_count(s); ++k) coordinates.push_back(coordinate_name(s, k));
  const std::vector<std::string> ids = ids_of(coordinates);
  for (std::size_t k = 0; k < coordinate_count(s) && n > 0; ++k) {
    write("MuscleAnalysis_MomentArm_" + ids[k] + ".sto",
          {s.moment_arm.time_s(), s.fiber_length.channels(),
           s.moment_arm.values().middleCols(static_cast<Eigen::Index>(k) * n, n)},
          "MomentArm_" + coordinate_name(s, k));
  }
  write("torques.sto", torques(s), "Generalized Forces");
  write("states.sto", states(s), "ModelStates");
  write("energy.sto", s.energy, "Energy");
  write_file(folder / "simulation.json", simulation_json(s, provenance));
}

void write_sensitivities(const body::Sensitivities& s,
                         const Provenance& provenance,
                         const std::filesystem::path& folder) {
  std::vector<Channel> channels;
  for (const std::string& name : s.parameters) channels.push_back({name, Unit::dimensionless});
  std::vector<std::string> quantities;
  for (const body::Sensitivity& sensitivity : s.of) quantities.push_back(sensitivity.quantity);
  const std::vector<std::string> ids = ids_of(quantities);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    recording::write_storage(
        folder / "sensitivities" / (ids[k] + ".sto"), {s.time_s, channels, s.of[k].by_parameter},
        {.title = fmt::format("d({})/d(parameter), SI", quantities[k]), .comments = {made_by(provenance)}});
  }
}

}  // namespace myoid::results
