#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/forces/sharing_plausibility.h"
#include "myoid/body/forces/static_optimization.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/analysis_reports.h"

namespace myoid::opensim {
namespace {

/// Returns the controls as piecewise linear functions of time, as forward simulations read them.
std::string controls_text(const TimeSeries& controls) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40500\">\n"
      "\t<ControlSet name=\"Static Optimization\">\n\t\t<objects>\n";
  std::vector<std::string> times;
  for (const double t : controls.time_s()) times.push_back(format_number(t));
  for (Eigen::Index c = 0; c < controls.channel_count(); ++c) {
    text += fmt::format(
        "\t\t\t<ControlLinear name=\"{}\">\n\t\t\t\t<is_model_control>true</is_model_control>\n"
        "\t\t\t\t<extrapolate>true</extrapolate>\n\t\t\t\t<default_min>0.02</default_min>\n"
        "\t\t\t\t<default_max>1</default_max>\n\t\t\t\t<filter_on>false</filter_on>\n"
        "\t\t\t\t<use_steps>false</use_steps>\n\t\t\t\t<x_nodes>\n",
        controls.channels()[at(c)].name);
    for (Eigen::Index i = 0; i < controls.sample_count(); ++i) {
      text += "\t\t\t\t\t<ControlLinearNode>\n\t\t\t\t\t\t<t>";
      text += times[at(i)];
      text += "</t>\n\t\t\t\t\t\t<value>";
      text += format_number(controls.values()(i, c));
      text += "</value>\n\t\t\t\t\t</ControlLinearNode>\n";
    }
    text +=
        "\t\t\t\t</x_nodes>\n\t\t\t\t<min_nodes />\n\t\t\t\t<max_nodes />\n"
        "\t\t\t\t<kp>100</kp>\n\t\t\t\t<kv>20</kv>\n\t\t\t</ControlLinear>\n";
  }
  return text + "\t\t</objects>\n\t\t<groups />\n\t</ControlSet>\n</OpenSimDocument>\n";
}

}  // namespace

body::BodyModel with_coordinate_actuators(body::BodyModel model) {
  model.muscles.clear();
  std::vector<body::CoordinateActuator> own;
  std::vector<std::string> order;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.is_constrained(static_cast<int>(c))) continue;
    body::CoordinateActuator actuator;
    actuator.name = model.coordinates[c].name;
    actuator.coordinate = static_cast<int>(c);
    order.push_back(actuator.name);
    own.push_back(std::move(actuator));
  }
  model.actuators.insert(model.actuators.begin(), own.begin(), own.end());
  model.force_order.insert(model.force_order.begin(), order.begin(), order.end());
  return model;
}

void run_static_optimization(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const std::string name = analysis_name(node);
  const auto activation_file = claim_result(run, name + "_activation.sto");
  const auto force_file = claim_result(run, name + "_force.sto");
  const auto controls_file = claim_result(run, name + "_controls.xml");
  const bool use_forces = xml.flag(node, "use_model_force_set", xml.flag(node, "use_model_actuator_set", true));
  const body::BodyModel model = use_forces ? run.model : with_coordinate_actuators(run.model);
  const body::StaticOptimizationOptions options{.exponent = xml.number(node, "activation_exponent", 2.0),
                                                .muscle_physiology = xml.flag(node, "use_muscle_physiology", true),
                                                .loads = run.loads_if_any(),
                                                .progress = run.options.progress,
                                                .inspect = run.options.inspect};
  if (!(options.exponent > 1.0)) {
    xml.fail(xml.property(node, "activation_exponent"),
             "<activation_exponent> {}, expected above 1: only then are the activations determined", options.exponent);
  }
  const body::StaticOptimizationResult solved = body::static_optimization(model, run.motion, options);
  run.add_notes(solved.notes);
  run.add_remarks(body::reserves_act(model, run.motion, solved.force, run.loads_if_any()), name);
  write_opensim_storage(activation_file, solved.control,
                        {.title = "Static Optimization",
                         .description = "This file contains static optimization results.\n\n",
                         .decimals = run.decimals});
  write_forces(run, model, force_file, solved.force);
  write_file(controls_file, controls_text(solved.control), Flush::later);
  const auto infeasible = std::count(solved.is_feasible.begin(), solved.is_feasible.end(), false);
  if (infeasible > 0) {
    run.note(
        "in {} frames, from {} s, muscles and actuators cannot make the accelerations; the controls that "
        "come nearest are written. Append stronger reserve actuators (<force_set_files>)",
        infeasible,
        run.motion.q.time_s()[std::find(solved.is_feasible.begin(), solved.is_feasible.end(), false) -
                              solved.is_feasible.begin()]);
  }
  run.result.frames_failed = solved.frames_failed;
  run.result.summary =
      fmt::format("{} frames, {} without certificate; largest KKT residual {:.1e}", run.motion.sample_count(),
                  solved.frames_failed, solved.kkt_residual.size() > 0 ? solved.kkt_residual.maxCoeff() : 0.0);
}

}  // namespace myoid::opensim
