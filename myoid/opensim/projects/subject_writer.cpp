#include "myoid/opensim/projects/subject_writer.h"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/subject_words.h"

namespace myoid::opensim {
namespace {

void append_number(pugi::xml_node parent, const char* name, double value) {
  append_text(parent, name, fmt::format("{}", value));
}

void append_defaults(pugi::xml_node subject, const SubjectWords& words, const Project& project) {
  pugi::xml_node defaults = subject.append_child(words.defaults);
  if (words.dialect == Dialect::ceinms) append_number(defaults, "emDelay", project.common.delay_s.value_or(0.0));
  append_number(defaults, "percentageChange", project.common.percentage_change.value_or(0.0));
  append_number(defaults, "damping", project.common.damping.value_or(0.0));
  for (const ProjectCurve& curve : project.curves) {
    pugi::xml_node node = defaults.append_child(words.curve);
    append_text(node, "name", curve.name);
    append_text(node, "xPoints", fmt::format("{}", fmt::join(curve.x, " ")));
    append_text(node, "yPoints", fmt::format("{}", fmt::join(curve.y, " ")));
  }
}

void append_muscle(pugi::xml_node parent,
                   const SubjectWords& words,
                   const Project& project,
                   const ProjectMuscle& muscle) {
  pugi::xml_node node = parent.append_child(words.muscle);
  append_text(node, "name", muscle.name);
  for (const NumberWord& word : words.numbers) {
    const auto own = muscle.numbers.find(word.quantity);
    if (own == muscle.numbers.end()) continue;
    double value = own->second.value;
    if (word.quantity == MuscleQuantity::delay && value == project.common.delay_s) continue;
    if (word.quantity == MuscleQuantity::pennation_angle) value /= words.angle_unit;
    append_number(node, word.element, value);
  }
}

void append_channels(pugi::xml_node subject, const Project& project) {
  std::map<std::string, std::vector<std::string>> muscles;
  for (const ProjectMuscle& muscle : project.muscles)
    for (const ProjectInput& input : muscle.inputs) muscles[input.channel].push_back(muscle.name);
  pugi::xml_node channels = subject.append_child("Channels");
  for (const auto& [channel, names] : muscles) {
    pugi::xml_node node = channels.append_child("Channel");
    append_text(node, "name", channel);
    append_text(node, "muscleSequence", fmt::format("{}", fmt::join(names, " ")));
  }
}

void append_calibration(pugi::xml_node subject, const Project& project) {
  pugi::xml_node info = subject.append_child("calibrationInfo");
  if (project.is_calibrated) {
    pugi::xml_node calibrated = info.append_child("calibrated");
    append_text(calibrated, "startSubjectFile", project.start.generic_string());
    append_text(calibrated, "calibrationSequence", "myoid");
  } else {
    pugi::xml_node uncalibrated = info.append_child("uncalibrated");
    append_text(uncalibrated, "subjectID", project.model.empty() ? "myoid" : project.model.stem().string());
    append_text(uncalibrated, "additionalInfo", "the numbers before the calibration");
  }
  if (!project.model.empty()) append_text(subject, "opensimModelFile", project.model.generic_string());
}

}  // namespace

std::string ceinms_subject_text(const Project& project) {
  const SubjectWords& words = subject_words(project.dialect);
  pugi::xml_document document;
  pugi::xml_node subject = document.append_child("subject");
  append_defaults(subject, words, project);
  pugi::xml_node muscles = subject.append_child(words.muscles);
  for (const ProjectMuscle& muscle : project.muscles) {
    if (split_words(muscle.name).size() != 1)
      throw InvalidInput(fmt::format("muscle '{}': a name without blanks expected", muscle.name));
    append_muscle(muscles, words, project, muscle);
  }
  pugi::xml_node dofs = subject.append_child(words.dofs);
  for (const ProjectDof& dof : project.dofs) {
    pugi::xml_node node = dofs.append_child(words.dof);
    append_text(node, "name", dof.name);
    append_text(node, words.dof_muscles, fmt::format("{}", fmt::join(dof.muscles, " ")));
  }
  if (words.dialect == Dialect::ceinms) append_calibration(subject, project);
  if (words.dialect == Dialect::ceinms_rt) append_channels(subject, project);
  return document_text(document);
}

}  // namespace myoid::opensim
