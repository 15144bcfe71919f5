#include "myoid/opensim/setup_elements.h"

#include <algorithm>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {
namespace {

using Names = std::vector<std::string>;

/// Returns the elements of OpenSim's classes, older versions included.
ElementTable make_elements() {
  const std::string set = "objects groups defaults";
  const std::string folders = "results_directory input_directory ";
  const std::string run =
      folders +
      "model_file replace_force_set replace_actuator_set force_set_files actuator_set_files output_precision "
      "initial_time final_time solve_for_equilibrium_for_auxiliary_states maximum_number_of_integrator_steps "
      "maximum_integrator_step_size minimum_integrator_step_size integrator_error_tolerance integrator_fine_tolerance "
      "AnalysisSet ControllerSet controls_file states_file pseudo_states_file external_loads_file "
      "external_loads_model_kinematics_file external_loads_body1 external_loads_body2 body1_linear_velocity_file "
      "lowpass_cutoff_frequency_for_load_kinematics ";
  const std::string fit =
      folders +
      "model_file constraint_weight accuracy time_range output_motion_file report_errors report_marker_locations ";
  const std::string marker_fit =
      fit + "IKTaskSet IKTrialSet marker_file coordinate_file optimizer_algorithm model_marker_set";
  const std::string analysis = "on start_time end_time step_interval in_degrees ";
  const std::string files =
      "output_model_file output_motion_file output_marker_file output_scale_file output_joint_file output_muscle_file ";
  return {
      {"InverseKinematicsTool", marker_fit},
      {"IKTool", marker_fit},
      {"InverseDynamicsTool", folders + "model_file time_range forces_to_exclude external_loads_file coordinates_file "
                                        "lowpass_cutoff_frequency_for_coordinates output_gen_force_file "
                                        "joints_to_report_body_forces output_body_forces_file"},
      {"AnalyzeTool", run + "coordinates_file speeds_file lowpass_cutoff_frequency_for_coordinates print_level"},
      {"ForwardTool", run + "use_specified_dt"},
      {"ScaleTool", folders + "mass height age notes GenericModelMaker ModelScaler MarkerPlacer use_model_marker_set"},
      {"IMUPlacer", folders + "model_file base_imu_label base_heading_axis sensor_to_opensim_rotations "
                              "orientation_file_for_calibration output_model_file"},
      {"IMUInverseKinematicsTool",
       fit + "sensor_to_opensim_rotations orientations_file orientation_weights OrientationWeightSet"},
      {"orientation_weights", set + " OrientationWeightSet"},
      {"OrientationWeightSet", set},
      {"OrientationWeight", "weight"},
      {"GenericModelMaker", "model_file marker_set_file"},
      {"ModelScaler",
       files + "apply scaling_order MeasurementSet ScaleSet marker_file time_range preserve_mass_distribution"},
      {"MarkerPlacer",
       files + "apply IKTaskSet marker_file coordinate_file time_range max_marker_movement optimizer_algorithm"},
      {"MeasurementSet", set},
      {"Measurement", "apply MarkerPairSet BodyScaleSet"},
      {"MarkerPairSet", set},
      {"MarkerPair", "markers"},
      {"BodyScaleSet", set},
      {"BodyScale", "axes"},
      {"ScaleSet", set},
      {"Scale", "scales segment apply"},
      {"IKTaskSet", set},
      {"IKMarkerTask", "apply weight"},
      {"IKCoordinateTask", "apply weight value_type value"},
      {"AnalysisSet", set},
      {"ControllerSet", set},
      {"Kinematics", analysis + "coordinates"},
      {"BodyKinematics", analysis + "bodies express_results_in_body_local_frame"},
      {"PointKinematics", analysis + "body_name relative_to_body_name point_name point"},
      {"MuscleAnalysis", analysis + "muscle_list moment_arm_coordinate_list compute_moments"},
      {"StaticOptimization", analysis +
                                 "use_model_force_set use_model_actuator_set activation_exponent use_muscle_physiology "
                                 "optimizer_convergence_criterion optimizer_max_iterations optimizer_algorithm"},
      {"JointReaction", analysis + "forces_file joint_names apply_on_bodies express_in_frame"},
      {"InverseDynamics", analysis + "use_model_force_set use_model_actuator_set"},
      {"ForceReporter", analysis + "include_constraint_forces"},
      {"OutputReporter", analysis + "output_paths"},
      {"Actuation", analysis},
  };
}

using Known = std::map<std::string, Names, std::less<>>;

void look_into(pugi::xml_node parent, const Known& table, std::vector<UnknownElement>& unknown) {
  const auto known = table.find(std::string_view(parent.name()));
  const Names* names = known == table.end() ? nullptr : &known->second;
  for (const pugi::xml_node child : parent.children()) {
    if (child.type() != pugi::node_element) continue;
    if (names != nullptr && std::find(names->begin(), names->end(), child.name()) == names->end()) {
      unknown.push_back({parent, child, nearest_word(child.name(), *names)});
    } else if (names != nullptr || std::string_view(parent.name()) == "objects") {
      look_into(child, table, unknown);
    }
  }
}

}  // namespace

std::vector<UnknownElement> unknown_elements(pugi::xml_node tool, const ElementTable& table) {
  Known known;
  for (const auto& [name, text] : table) {
    Names& names = known[name];
    for (const std::string_view word : split_words(text)) names.emplace_back(word);
  }
  std::vector<UnknownElement> unknown;
  look_into(tool, known, unknown);
  return unknown;
}

std::vector<std::string> unknown_elements(const body::OsimXml& xml, pugi::xml_node tool) {
  static const ElementTable kElements = make_elements();
  Names sentences;
  for (const UnknownElement& each : unknown_elements(tool, kElements)) {
    sentences.push_back(fmt::format("{}: <{}> has no element <{}>{}; OpenSim and this program ignore the element",
                                    xml.place_of(each.element), each.parent.name(), each.element.name(),
                                    each.nearest ? fmt::format(" (did you mean <{}>?)", *each.nearest) : ""));
  }
  return sentences;
}

}  // namespace myoid::opensim
