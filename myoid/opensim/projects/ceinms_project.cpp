#include "myoid/opensim/projects/ceinms_project.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/calibration_plan.h"
#include "myoid/opensim/projects/ceinms_subject.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/trial_files.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using body::OsimXml;

const ElementTable& set_up_elements() {
  static const ElementTable kElements{
      {"ceinmsCalibration", "subjectFile excitationGeneratorFile emgGeneratorFile calibrationFile outputSubjectFile"},
      {"ceinms", "subjectFile inputDataFile executionFile excitationGeneratorFile emgGeneratorFile outputDirectory"},
      {"calibration", "algorithm NMSmodel samplingFrequency calibrationSteps trialSet"},
      {"NMSmodel", "type tendon activation"},
      {"calibrationSteps", "step"},
      {"step", "dofs objectiveFunction parameterSet strengthCoefficients_ShapeFactor_C1_C2_TendonSLackLength_single"},
      {"parameterSet", "parameter"},
      {"parameter", "name single global muscleGroups absolute relativeToSubjectValue"},
      {"muscleGroups", "muscles"},
      {"absolute", "range"},
      {"relativeToSubjectValue", "range"},
      {"inputData",
       "muscleTendonLengthFile excitationsFile emgFile momentArmsFiles externalTorquesFile "
       "externalLoadsFile motionFile startStopTime"},
      {"momentArmsFiles", "momentArmsFile"},
      {"excitationGenerator", "inputSignals mapping"},
      {"emgGenerator", "experimental mapping output"},
      {"mapping", "excitation emg"},
      {"excitation", "input"},
      {"execution", "NMSmodel online offline elaboratedDoFs samplingFrequency logging"}};
  return kElements;
}

/// Reads two numbers of which the second is greater.
CalibrationBounds range_of(const OsimXml& xml, pugi::xml_node node) {
  const std::vector<double> ends = xml.numbers(node);
  if (ends.size() != 2 || !std::isfinite(ends[0]) || !std::isfinite(ends[1]) || !(ends[1] > ends[0]))
    xml.fail(node, "<{}>: expected two numbers that increase, found '{}'", node.name(), OsimXml::text_of(node));
  return {ends[0], ends[1]};
}

/// Reads the channels of an <excitation>, each with its weight.
std::vector<ProjectInput> weighed_inputs(const OsimXml& xml, pugi::xml_node node, const std::string& muscle) {
  std::vector<ProjectInput> inputs;
  for (const pugi::xml_node input : node.children("input")) {
    const std::string channel = OsimXml::text_of(input);
    const auto weight = parse_number(input.attribute("weight").value());
    if (channel.empty() || !weight || !std::isfinite(*weight))
      xml.fail(input, "muscle '{}': expected a channel with a weight, found '{}' with '{}'", muscle, channel,
               input.attribute("weight").value());
    inputs.push_back({channel, *weight});
  }
  return inputs;
}

/// Reads the channels of an <emg> of <emgGenerator>, which are assigned, averaged or none ("nil").
std::vector<ProjectInput> inputs_of_operation(const OsimXml& xml, pugi::xml_node node, const std::string& muscle) {
  const std::string_view operation = trim(node.attribute("operation").value());
  const std::string text = OsimXml::text_of(node);
  const std::vector<std::string_view> channels = split_words(text);
  const bool fits = operation == "assign" ? channels.size() == 1
                    : operation == "mean" ? !channels.empty()
                                          : operation == "nil" && channels.empty();
  if (!fits)
    xml.fail(node,
             "muscle '{}': expected operation 'assign' of one channel, 'mean' of several or 'nil', found '{}' of {}",
             muscle, operation, channels.size());
  std::vector<ProjectInput> inputs;
  for (const std::string_view channel : channels)
    inputs.push_back({std::string(channel), 1.0 / static_cast<double>(channels.size())});
  return inputs;
}

/// A project while it is read.
class CeinmsReader {
 public:
  explicit CeinmsReader(const ProjectFolder& folder) : folder_(folder) {}

  Project run(const RootedFile& main) {
    const std::string& root = main.roots.front();
    if (root == "subject") {
      read_subject_alone(main.path);
    } else {
      const OsimXml xml = read_document(main.path);
      const pugi::xml_node set_up = xml.root().child(root.c_str());
      if (root == "ceinmsCalibration") {
        read_calibration_set_up(xml, set_up);
      } else {
        read_run_set_up(xml, set_up);
      }
      project_.set_up = main.path;
      project_.version = set_up.child("emgGeneratorFile")          ? "0.9"
                         : set_up.child("excitationGeneratorFile") ? "0.21"
                                                                   : "";
      note_unknown_elements(xml, set_up, set_up_elements(), project_.remarks);
    }
    read_executions();
    read_other_trials();
    read_trial_tables(project_);
    return std::move(project_);
  }

 private:
  /// Returns the file that an element names; empty without such an element. A file that is required must exist.
  fs::path file(const OsimXml& xml, pugi::xml_node parent, const char* name, bool is_required) {
    const std::string named = xml.word(parent, name);
    if (named.empty()) {
      if (is_required) xml.fail(parent, "<{}> expected in <{}>, found none", name, parent.name());
      return {};
    }
    const NamedFile found = folder_.find(xml.path(), named);
    if (found.exists) return found.path;
    if (is_required)
      xml.fail(parent.child(name), "<{}> {}: {}", name, named, missing_file(xml.path().parent_path(), named));
    return {};
  }

  void take_subject(CeinmsSubject subject) {
    const std::string model = subject.model_file;
    std::vector<Remark> remarks = std::move(project_.remarks);
    project_ = project_of(std::move(subject));
    project_.remarks.insert(project_.remarks.begin(), remarks.begin(), remarks.end());
    if (model.empty()) return;
    const NamedFile found = folder_.find(project_.subject, model);
    if (found.exists) {
      project_.model = found.path;
    } else {
      note_reading(project_.remarks, project_.subject, fmt::format("the model '{}' is not beside the subject", model));
    }
  }

  void read_subject_alone(const fs::path& path) {
    CeinmsSubject subject = read_ceinms_subject(path);
    const std::string start = subject.start_file;
    take_subject(std::move(subject));
    if (!project_.is_calibrated || start.empty()) return;
    const NamedFile found = folder_.find(path, start);
    if (!found.exists || fs::equivalent(found.path, path)) return;
    project_.start = found.path;
    set_starts(project_, read_ceinms_subject(found.path).muscles);
    plan_changed_numbers(project_);
  }

  void read_generator(const OsimXml& xml, pugi::xml_node set_up) {
    for (const char* name : {"excitationGeneratorFile", "emgGeneratorFile"}) {
      const fs::path path = file(xml, set_up, name, false);
      if (!path.empty()) return read_mapping(path);
      const std::string named = xml.word(set_up, name);
      if (!named.empty()) note_reading(project_.remarks, xml.path(), fmt::format("<{}> '{}' is missing", name, named));
    }
  }

  /// Reads which channels drive each muscle.
  void read_mapping(const fs::path& path) {
    const OsimXml xml = read_document(path);
    const pugi::xml_node root = OsimXml::first_element(xml.root());
    const pugi::xml_node mapping = root.child("mapping");
    if (!mapping) xml.fail(root, "<mapping> expected in <{}>, found none", root.name());
    project_.has_mapping = true;
    std::vector<std::string> unknown, unlisted;
    std::vector<std::string> signals = xml.words(root, "inputSignals");
    for (const pugi::xml_node node : root.child("experimental").children("emg"))
      signals.emplace_back(trim(node.attribute("id").value()));
    for (const pugi::xml_node node : mapping.children()) {
      const bool weighs = std::string_view(node.name()) == "excitation";
      if (!weighs && std::string_view(node.name()) != "emg") continue;
      const std::string id(trim(node.attribute("id").value()));
      ProjectMuscle* muscle = project_.find(id);
      if (muscle == nullptr) {
        unknown.push_back(id);
        continue;
      }
      for (ProjectInput& input : weighs ? weighed_inputs(xml, node, id) : inputs_of_operation(xml, node, id)) {
        if (std::find(signals.begin(), signals.end(), input.channel) == signals.end())
          unlisted.push_back(input.channel);
        if (input.weight != 0.0) muscle->inputs.push_back(std::move(input));
      }
    }
    if (!unknown.empty())
      note_reading(project_.remarks, path,
                   fmt::format("excitations of muscles that the subject lacks: {}", name_list(unknown)));
    if (!unlisted.empty())
      note_reading(project_.remarks, path, fmt::format("channels that <inputSignals> lacks: {}", name_list(unlisted)));
    note_unknown_elements(xml, root, set_up_elements(), project_.remarks);
  }

  void read_calibration_set_up(const OsimXml& xml, pugi::xml_node set_up) {
    const fs::path start = file(xml, set_up, "subjectFile", true);
    const fs::path calibrated = file(xml, set_up, "outputSubjectFile", false);
    const bool is_calibrated = !calibrated.empty() && !fs::equivalent(calibrated, start);
    CeinmsSubject before = read_ceinms_subject(start);
    if (is_calibrated) {
      take_subject(read_ceinms_subject(calibrated));
      set_starts(project_, before.muscles);
      project_.start = start;
    } else {
      take_subject(std::move(before));
      note_reading(project_.remarks, xml.path(), "the calibrated subject is missing: nothing is calibrated yet");
    }
    project_.is_calibrated = is_calibrated;
    read_generator(xml, set_up);
    read_calibration(file(xml, set_up, "calibrationFile", true));
  }

  void read_run_set_up(const OsimXml& xml, pugi::xml_node set_up) {
    read_subject_alone(file(xml, set_up, "subjectFile", true));
    read_generator(xml, set_up);
  }

  void read_calibration(const fs::path& path) {
    const OsimXml xml = read_document(path);
    const pugi::xml_node root = xml.root().child("calibration");
    if (!root) throw ReadError(path, 1, "expected <calibration> as the root");
    const pugi::xml_node law = root.child("NMSmodel");
    project_.tendon = chosen(law, "tendon");
    project_.activation = chosen(law, "activation");
    for (const pugi::xml_node step : root.child("calibrationSteps").children("step")) read_step(xml, step);
    read_trial_set(xml, root.child("trialSet"));
    note_unknown_elements(xml, root, set_up_elements(), project_.remarks);
  }

  void read_step(const OsimXml& xml, pugi::xml_node step) {
    const std::vector<std::string> dofs = xml.words(step, "dofs");
    std::vector<std::string> muscles;
    for (const std::string& name : dofs) {
      const auto dof =
          std::find_if(project_.dofs.begin(), project_.dofs.end(), [&](const auto& d) { return d.name == name; });
      if (dof == project_.dofs.end()) {
        note_reading(project_.remarks, xml.path(), fmt::format("the subject lacks the degree of freedom '{}'", name));
        continue;
      }
      dof->is_calibrated = true;
      muscles.insert(muscles.end(), dof->muscles.begin(), dof->muscles.end());
    }
    project_.objective = chosen(step, "objectiveFunction");
    if (!project_.is_calibrated) return;
    if (!step.child("parameterSet")) plan_changed_numbers(project_);
    for (const pugi::xml_node node : step.child("parameterSet").children("parameter"))
      read_parameter(xml, node, muscles);
  }

  void read_parameter(const OsimXml& xml, pugi::xml_node node, const std::vector<std::string>& muscles) {
    const std::string name = required_word(xml, node, "name");
    const auto quantity = ceinms_quantity(name);
    if (!quantity) {
      note_reading(project_.remarks, xml.path(), fmt::format("'{}' is calibrated and is no number of a muscle", name));
      return;
    }
    PlannedQuantity planned{.quantity = *quantity};
    if (node.child("global")) planned.sharing = Sharing::all;
    for (const pugi::xml_node group : node.child("muscleGroups").children("muscles")) {
      planned.sharing = Sharing::groups;
      const std::string text = OsimXml::text_of(group);
      planned.groups.emplace_back();
      for (const std::string_view word : split_words(text)) planned.groups.back().emplace_back(word);
    }
    planned.is_relative = static_cast<bool>(node.child("relativeToSubjectValue"));
    const pugi::xml_node range = node.child(planned.is_relative ? "relativeToSubjectValue" : "absolute").child("range");
    if (!range) xml.fail(node, "parameter '{}': <range> expected, found none", name);
    planned.bounds = range_of(xml, range);
    plan(project_, planned, muscles);
  }

  /// Adds the trials that the calibration lists: as text, or as an element each.
  void read_trial_set(const OsimXml& xml, pugi::xml_node set) {
    std::vector<std::string> names;
    for (const pugi::xml_node child : set.children())
      if (child.type() == pugi::node_element) names.push_back(OsimXml::text_of(child));
    const std::string text = OsimXml::text_of(set);
    if (folder_.find(xml.path(), text).exists) {
      names.push_back(text);
    } else {
      for (const std::string_view word : split_words(text)) names.emplace_back(word);
    }
    for (const std::string& name : names) {
      const NamedFile found = folder_.find(xml.path(), name);
      if (found.exists) {
        add_trial(found.path, true);
        continue;
      }
      project_.remarks.push_back({.code = RemarkCode::refused,
                                  .severity = Severity::warning,
                                  .where = xml.path().filename().string(),
                                  .about = name,
                                  .says = fmt::format("{}: trial {}: {}", xml.place_of(set), name,
                                                      missing_file(xml.path().parent_path(), name))});
    }
  }

  void add_trial(const fs::path& path, bool is_calibrating) {
    if (!trials_.insert(fs::weakly_canonical(path)).second) return;
    const OsimXml xml = read_document(path);
    const pugi::xml_node root = xml.root().child("inputData");
    if (!root) throw ReadError(path, 1, "expected <inputData> as the root");
    ProjectTrial trial{.name = path.stem().string(), .is_calibrating = is_calibrating};
    const auto add = [&](TrialRole role, pugi::xml_node node) {
      const std::string named = OsimXml::text_of(node);
      if (named.empty()) return;
      const NamedFile found = folder_.find(path, named);
      trial.files.push_back({.role = role,
                             .path = found.path,
                             .exists = found.exists,
                             .dof = std::string(trim(node.attribute("dofName").value()))});
    };
    add(TrialRole::lengths, root.child("muscleTendonLengthFile"));
    add(TrialRole::emg, body::either_child(root, "excitationsFile", "emgFile"));
    for (const pugi::xml_node node : root.child("momentArmsFiles").children("momentArmsFile"))
      add(TrialRole::moment_arms, node);
    add(TrialRole::torques, root.child("externalTorquesFile"));
    add(TrialRole::loads, root.child("externalLoadsFile"));
    add(TrialRole::motion, root.child("motionFile"));
    if (const pugi::xml_node used = xml.property(root, "startStopTime")) {
      const CalibrationBounds range = range_of(xml, used);
      trial.used = Stretch{range.lower, range.upper};
    }
    project_.trials.push_back(std::move(trial));
    note_unknown_elements(xml, root, set_up_elements(), project_.remarks);
  }

  /// Adds the trials in the folder that the calibration does not use.
  void read_other_trials() {
    for (const RootedFile& each : folder_.with_root("inputData")) add_trial(each.path, false);
  }

  /// Reads from the set-ups of runs which muscles are synthesized, and the law where the calibration does not tell it.
  void read_executions() {
    std::set<std::string> synthesized;
    for (const RootedFile& each : folder_.with_root("execution")) {
      const OsimXml xml = read_document(each.path);
      const pugi::xml_node law = xml.root().child("execution").child("NMSmodel");
      if (project_.tendon.empty()) project_.tendon = chosen(law, "tendon");
      if (project_.activation.empty()) project_.activation = chosen(law, "activation");
      const pugi::xml_node hybrid = law.child("type").child("hybrid");
      for (const std::string& name : xml.words(hybrid, "synthMTUs")) synthesized.insert(name);
      take_weights(xml, hybrid);
    }
    project_.synthesized.assign(synthesized.begin(), synthesized.end());
  }

  /// Takes the weights of the first hybrid run, and tells if another has others.
  void take_weights(const OsimXml& xml, pugi::xml_node hybrid) {
    const auto torque = finite_number(xml, hybrid, "alpha"), sum = finite_number(xml, hybrid, "beta");
    const auto emg = finite_number(xml, hybrid, "gamma");
    if (!torque || !sum || !emg) return;
    const HybridWeights weights{*torque, *sum, *emg};
    if (project_.hybrid && *project_.hybrid != weights)
      note_reading(project_.remarks, xml.path(),
                   fmt::format("hybrid runs differ: alpha {}, beta {}, gamma {} here", *torque, *sum, *emg));
    if (!project_.hybrid) project_.hybrid = weights;
  }

  const ProjectFolder& folder_;
  Project project_;
  std::set<fs::path> trials_;
};

}  // namespace

Project read_ceinms_project(const ProjectFolder& folder, const RootedFile& main) {
  return CeinmsReader(folder).run(main);
}

}  // namespace myoid::opensim
