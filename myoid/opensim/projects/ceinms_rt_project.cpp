#include "myoid/opensim/projects/ceinms_rt_project.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/calibration_plan.h"
#include "myoid/opensim/projects/ceinms_subject.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/trial_files.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using Quantity = MuscleQuantity;
using body::OsimXml;

const ElementTable& calibration_elements() {
  static const ElementTable kElements{
      {"simulatedAnnealing",
       "EMGProccesing osimFile subjectXML nameOfSubject dofsSpline computeSpline preScaling calibration"},
      {"calibration",
       "use objectiveFunction filterEMG EMD dofToCalibrate trials option inputSubjectXMLName "
       "outputSubjectXMLName"},
      {"dofToCalibrate", "dofs"},
      {"trials", "directory trial"},
      {"trial", "trialName cropMinTimeFromZero cropMaxTimeFromZero"}};
  return kElements;
}

/// A quantity that an objective function varies, with the range that the program has for it.
struct Range {
  Quantity quantity;
  CalibrationBounds bounds;
  bool is_relative = false;
};

constexpr Range share(Quantity quantity, double of_start) { return {quantity, {1.0 - of_start, 1.0 + of_start}, true}; }
constexpr Range kNarrowStrength{Quantity::strength_coefficient, {0.5, 1.5}};
constexpr Range kWideStrength{Quantity::strength_coefficient, {0.5, 2.5}};
constexpr Range kShape{Quantity::shape_factor, {-2.999, -0.001}};
constexpr Range kPositiveShape{Quantity::shape_factor, {1e-7, 0.3}};
constexpr Range kC1{Quantity::c1, {-0.995, -0.005}};
constexpr Range kC2{Quantity::c2, {-0.995, -0.005}};
constexpr Quantity kSlack = Quantity::tendon_slack_length, kFiber = Quantity::optimal_fiber_length;

/// An objective function of the program. Strengths are one unknown for the muscles whose start is equal.
struct Objective {
  std::string_view name;
  std::vector<Range> ranges;
  bool has_one_shape = false;
  bool takes_last_dof = false;
};

const std::vector<Objective>& objectives() {
  static const std::vector<Objective> kObjectives{
      {"ShapeFactor", {kShape}},
      {"StrengthCoefficients_ShapeFactor_TendonSlackLength_single",
       {kNarrowStrength, kShape, share(kSlack, 0.05), share(kFiber, 0.025)}},
      {"StrengthCoefficients_ShapeFactor_TendonSlackLength_single_widerRange",
       {kNarrowStrength, kShape, share(kSlack, 0.15), share(kFiber, 0.25)}},
      {"StrengthCoefficients_ShapeFactor_C1_C2_TendonSlackLength_single",
       {kWideStrength, kShape, kC1, kC2, share(kSlack, 0.15)}},
      {"StrengthCoefficients_Single_ShapeFactor_C1_C2_TendonSlackLength_use_last_Dof_only",
       {kWideStrength, kPositiveShape, kC1, kC2, share(kSlack, 0.15)},
       false,
       true},
      {"GroupedStrengthCoefficients_IndividualLstLom",
       {kNarrowStrength, kShape, share(kSlack, 0.05), share(kFiber, 0.025)},
       true}};
  return kObjectives;
}

/// The ranges from which those of an unknown objective function are taken, the narrowest of a quantity first.
const std::vector<Range>& usual_ranges() {
  static const std::vector<Range> kRanges{kNarrowStrength,
                                          kWideStrength,
                                          kPositiveShape,
                                          kShape,
                                          kC1,
                                          kC2,
                                          share(kSlack, 0.05),
                                          share(kSlack, 0.15),
                                          share(kFiber, 0.025),
                                          share(kFiber, 0.05),
                                          share(kFiber, 0.15),
                                          share(kFiber, 0.25)};
  return kRanges;
}

std::optional<CalibrationBounds> bounds_in(const Range& range, const ProjectNumber& number) {
  if (!range.is_relative) return range.bounds;
  if (!number.start) return std::nullopt;
  return CalibrationBounds{range.bounds.lower * *number.start, range.bounds.upper * *number.start};
}

/// Returns true if the range holds all calibrated numbers of its quantity, to a thousandth of its width.
bool holds_all(const Project& project, const Range& range) {
  constexpr double kSlackOfWidth = 1e-3;
  for (const ProjectMuscle& muscle : project.muscles) {
    const auto at = muscle.numbers.find(range.quantity);
    if (at == muscle.numbers.end() || !at->second.unknown) continue;
    const auto bounds = bounds_in(range, at->second);
    const double slack = bounds ? kSlackOfWidth * (bounds->upper - bounds->lower) : 0.0;
    if (!bounds || at->second.value < bounds->lower - slack || at->second.value > bounds->upper + slack) return false;
  }
  return true;
}

bool names_calibrated(const fs::path& path) {
  const std::string name = body::lower_case(path.stem().string());
  return name.find("calibrated") != std::string::npos && name.find("uncalibrated") == std::string::npos;
}

bool have_equal_muscles(const CeinmsSubject& a, const CeinmsSubject& b) {
  return std::equal(a.muscles.begin(), a.muscles.end(), b.muscles.begin(), b.muscles.end(),
                    [](const auto& one, const auto& other) { return one.name == other.name; });
}

/// A project while it is read.
class CeinmsRtReader {
 public:
  explicit CeinmsRtReader(const ProjectFolder& folder) : folder_(folder) {}

  Project run(const RootedFile& main) {
    if (main.roots.front() == "simulatedAnnealing") {
      const OsimXml xml = read_document(main.path);
      const pugi::xml_node root = xml.root().child("simulatedAnnealing");
      read_subjects(xml, root, {});
      project_.set_up = main.path;
      read_calibration(xml, root);
      note_unknown_elements(xml, root, calibration_elements(), project_.remarks);
    } else {
      const OsimXml none = read_document(main.path);
      read_subjects(none, {}, main.path);
      if (project_.is_calibrated) infer_bounds();
      list_trials({}, {});
    }
    find_model();
    read_executions();
    read_trial_tables(project_);
    return std::move(project_);
  }

 private:
  /// Finds the two subjects: as the calibration names them, else by their names.
  void read_subjects(const OsimXml& xml, pugi::xml_node set_up, const fs::path& main) {
    const pugi::xml_node calibration = set_up.child("calibration");
    const auto named = [&](pugi::xml_node parent, const char* name) -> std::optional<fs::path> {
      const std::string word = xml.word(parent, name);
      if (word.empty()) return std::nullopt;
      const NamedFile found = folder_.find(xml.path(), word);
      return found.exists ? std::optional(found.path) : std::nullopt;
    };
    std::optional<fs::path> after = named(calibration, "outputSubjectXMLName");
    std::optional<fs::path> before = named(calibration, "inputSubjectXMLName");
    if (!before) before = named(set_up, "subjectXML");
    std::vector<fs::path> others;
    for (const RootedFile& each : folder_.with_root("subject")) others.push_back(each.path);
    if (!after) {
      const auto by_name = std::find_if(others.begin(), others.end(), names_calibrated);
      if (by_name != others.end() && (!before || *by_name != *before)) after = *by_name;
    }
    if (!after && !before && !main.empty()) before = main;
    if (!after && !before && !others.empty()) before = others.front();
    if (!after && !before) xml.fail(set_up, "a subject expected in {}, found none", folder_.folder().string());
    take_subjects(after, before, others);
  }

  void take_subjects(const std::optional<fs::path>& after,
                     std::optional<fs::path> before,
                     const std::vector<fs::path>& others) {
    CeinmsSubject subject = read_ceinms_subject(after ? *after : *before);
    if (after && (!before || *before == *after)) before = start_of(subject, others);
    const auto start = after && before ? std::optional(read_ceinms_subject(*before)) : std::nullopt;
    project_ = project_of(std::move(subject));
    project_.is_calibrated = after.has_value();
    if (!start) {
      note_reading(project_.remarks, project_.subject,
                   after ? "the subject from which the calibration started is missing: bounds are not known"
                         : "the calibrated subject is missing: nothing is calibrated yet");
      return;
    }
    project_.start = *before;
    set_starts(project_, start->muscles);
    note_reading(project_.remarks, project_.subject,
                 fmt::format("taken as calibrated, with {} as its start", before->filename().string()));
  }

  /// Returns the subject with the same muscles; of several, one whose name says that it is uncalibrated.
  std::optional<fs::path> start_of(const CeinmsSubject& subject, const std::vector<fs::path>& others) {
    std::optional<fs::path> found;
    for (const fs::path& other : others) {
      if (other == subject.path) continue;
      try {
        if (!have_equal_muscles(read_ceinms_subject(other), subject)) continue;
      } catch (const InvalidInput&) {
        continue;  // a file that no file names
      }
      const bool says_it = body::lower_case(other.stem().string()).find("uncalibrated") != std::string::npos;
      if (!found || says_it) found = other;
      if (says_it) break;
    }
    return found;
  }

  void read_calibration(const OsimXml& xml, pugi::xml_node root) {
    const pugi::xml_node calibration = root.child("calibration");
    project_.objective = xml.word(calibration, "objectiveFunction");
    if (const auto delay = finite_number(xml, calibration, "EMD")) project_.common.delay_s = delay;
    std::vector<std::string> dofs;
    for (const pugi::xml_node node : calibration.child("dofToCalibrate").children("dofs")) {
      const std::string text = OsimXml::text_of(node);
      for (const std::string_view word : split_words(text)) dofs.emplace_back(word);
    }
    for (ProjectDof& dof : project_.dofs)
      dof.is_calibrated = std::find(dofs.begin(), dofs.end(), dof.name) != dofs.end();
    for (const std::string& name : dofs)
      if (std::none_of(project_.dofs.begin(), project_.dofs.end(), [&](const auto& dof) { return dof.name == name; }))
        note_reading(project_.remarks, xml.path(), fmt::format("the subject lacks the degree of freedom '{}'", name));
    if (project_.is_calibrated) plan_objective(dofs);
    list_named_trials(xml, calibration.child("trials"));
    const std::string model = xml.word(root, "osimFile");
    const NamedFile found = folder_.find(xml.path(), model);
    if (found.exists) project_.model = found.path;
  }

  void plan_objective(std::vector<std::string> dofs) {
    const auto known = std::find_if(objectives().begin(), objectives().end(),
                                    [&](const Objective& each) { return each.name == project_.objective; });
    if (known == objectives().end()) return infer_bounds();
    if (known->takes_last_dof && !dofs.empty()) dofs.erase(dofs.begin(), dofs.end() - 1);
    std::vector<std::string> muscles;
    for (const ProjectDof& dof : project_.dofs)
      if (std::find(dofs.begin(), dofs.end(), dof.name) != dofs.end())
        muscles.insert(muscles.end(), dof.muscles.begin(), dof.muscles.end());
    for (const Range& range : known->ranges) {
      PlannedQuantity planned{.quantity = range.quantity, .bounds = range.bounds, .is_relative = range.is_relative};
      if (range.quantity == Quantity::shape_factor && known->has_one_shape) planned.sharing = Sharing::all;
      if (range.quantity == Quantity::strength_coefficient) {
        planned.sharing = Sharing::groups;
        planned.groups = muscles_of_equal_strength();
      }
      plan(project_, planned, muscles);
    }
  }

  [[nodiscard]] std::vector<std::vector<std::string>> muscles_of_equal_strength() const {
    std::map<double, std::vector<std::string>> groups;
    for (const ProjectMuscle& muscle : project_.muscles) {
      const auto strength = muscle.numbers.find(Quantity::strength_coefficient);
      if (strength == muscle.numbers.end()) continue;
      groups[strength->second.start.value_or(strength->second.value)].push_back(muscle.name);
    }
    std::vector<std::vector<std::string>> names;
    for (auto& [strength, group] : groups) names.push_back(std::move(group));
    return names;
  }

  /// Takes the bounds of an unknown objective function from the numbers.
  void infer_bounds() {
    if (project_.start.empty()) return;
    plan_changed_numbers(project_);
    std::set<Quantity> done;
    for (const Range& range : usual_ranges()) {
      if (done.contains(range.quantity) || !holds_all(project_, range)) continue;
      done.insert(range.quantity);
      for (ProjectMuscle& muscle : project_.muscles) {
        const auto at = muscle.numbers.find(range.quantity);
        if (at != muscle.numbers.end() && at->second.unknown) at->second.bounds = bounds_in(range, at->second);
      }
    }
    note_reading(project_.remarks, project_.subject,
                 "no calibration tells the bounds: of each quantity, the narrowest range of CEINMS-RT that holds all "
                 "its numbers is taken");
  }

  /// Lists the trials that the calibration names, then the others.
  void list_named_trials(const OsimXml& xml, pugi::xml_node trials) {
    std::map<std::string, std::optional<Stretch>> named;
    for (const pugi::xml_node node : trials.children("trial")) {
      const auto begin = finite_number(xml, node, "cropMinTimeFromZero");
      const auto end = finite_number(xml, node, "cropMaxTimeFromZero");
      if (begin && end && !(*end > *begin))
        xml.fail(node, "expected a cropMaxTimeFromZero above {}, found {}", *begin, *end);
      named[required_word(xml, node, "trialName")] = begin && end ? std::optional(Stretch{*begin, *end}) : std::nullopt;
    }
    list_trials(named, native_path(folder_.folder(), xml.word(trials, "directory")));
  }

  void list_trials(std::map<std::string, std::optional<Stretch>> named, const fs::path& directory) {
    constexpr std::pair<const char*, TrialRole> kFiles[] = {
        {"emgfilt", TrialRole::emg}, {"ik", TrialRole::motion}, {"id", TrialRole::torques}};
    std::map<fs::path, ProjectTrial> trials;
    for (const fs::path& file : folder_.files()) {
      if (format_of(file) != FileFormat::storage) continue;
      const std::string stem = body::lower_case(file.stem().string());
      for (const auto& [name, role] : kFiles) {
        if (stem != name) continue;
        ProjectTrial& trial = trials[file.parent_path()];
        trial.name = file.parent_path().filename().string();
        trial.files.push_back({.role = role, .path = file, .exists = true});
      }
    }
    for (auto& [folder, trial] : trials) {
      const auto use = named.find(trial.name);
      if (use != named.end()) {
        trial.is_calibrating = true;
        trial.used = use->second;
        named.erase(use);
      }
      project_.trials.push_back(std::move(trial));
    }
    for (const auto& [name, used] : named) {
      ProjectTrial trial{.name = name, .is_calibrating = true, .used = used};
      for (const char* file : {"emgFilt.sto", "ik.sto", "id.sto"})
        trial.files.push_back({.role = std::string_view(file) == "ik.sto"   ? TrialRole::motion
                                       : std::string_view(file) == "id.sto" ? TrialRole::torques
                                                                            : TrialRole::emg,
                               .path = directory / name / file});
      project_.trials.push_back(std::move(trial));
    }
  }

  /// Takes the only model of the folder if no file names one.
  void find_model() {
    if (!project_.model.empty()) return;
    std::vector<fs::path> models;
    for (const fs::path& file : folder_.files())
      if (format_of(file) == FileFormat::model) models.push_back(file);
    if (models.size() == 1) project_.model = models.front();
  }

  void read_executions() {
    for (const RootedFile& each : folder_.with_root("execution")) {
      const OsimXml xml = read_document(each.path);
      const pugi::xml_node law = xml.root().child("execution").child("NMSmodel");
      if (project_.tendon.empty()) project_.tendon = chosen(law, "tendon");
      if (project_.activation.empty()) project_.activation = chosen(law, "activation");
    }
  }

  const ProjectFolder& folder_;
  Project project_;
};

}  // namespace

Project read_ceinms_rt_project(const ProjectFolder& folder, const RootedFile& main) {
  return CeinmsRtReader(folder).run(main);
}

}  // namespace myoid::opensim
