#include "myoid/opensim/projects/ceinms_subject.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/subject_words.h"

namespace myoid::opensim {
namespace {

using Quantity = MuscleQuantity;
using body::OsimXml;

ElementTable elements_of(const SubjectWords& words) {
  std::string numbers = "name";
  for (const NumberWord& number : words.numbers) numbers += fmt::format(" {}", number.element);
  return {{"subject", fmt::format("{} {} {} Channels calibrationInfo opensimModelFile contactModelFile", words.defaults,
                                  words.muscles, words.dofs)},
          {words.defaults, fmt::format("emDelay percentageChange damping {}", words.curve)},
          {words.curve, "name xPoints yPoints"},
          {words.muscles, words.muscle},
          {words.muscle, numbers},
          {words.dofs, words.dof},
          {words.dof, fmt::format("name {}", words.dof_muscles)},
          {"Channels", "Channel"},
          {"Channel", "name muscleSequence"},
          {"calibrationInfo", "calibrated uncalibrated"}};
}

ProjectCurve read_curve(const OsimXml& xml, pugi::xml_node node) {
  ProjectCurve curve{required_word(xml, node, "name"), xml.numbers(node.child("xPoints")),
                     xml.numbers(node.child("yPoints"))};
  if (curve.x.size() < 2 || curve.x.size() != curve.y.size())
    xml.fail(node, "curve '{}': expected as many xPoints as yPoints, found {} and {}", curve.name, curve.x.size(),
             curve.y.size());
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!std::isfinite(curve.x[k]) || !std::isfinite(curve.y[k]))
      xml.fail(node, "curve '{}' is not finite", curve.name);
    if (k > 0 && !(curve.x[k] > curve.x[k - 1]))
      xml.fail(node, "curve '{}': expected xPoints that increase, found {} after {}", curve.name, curve.x[k],
               curve.x[k - 1]);
  }
  return curve;
}

double angle_unit(const OsimXml& xml, pugi::xml_node angle, const SubjectWords& words) {
  const std::string_view unit = trim(angle.attribute("unit").value());
  if (unit.empty()) return words.angle_unit;
  if (unit == "deg") return std::numbers::pi / 180.0;
  if (unit == "rad") return 1.0;
  xml.fail(angle, "expected the unit 'deg' or 'rad', found '{}'", unit);
}

ProjectMuscle read_muscle(const OsimXml& xml, pugi::xml_node node, const SubjectWords& words) {
  ProjectMuscle muscle{required_word(xml, node, "name"), {}, {}};
  for (const NumberWord& word : words.numbers) {
    std::optional<double> value = finite_number(xml, node, word.element);
    if (word.is_positive && !value) xml.fail(node, "muscle '{}': <{}> expected, found none", muscle.name, word.element);
    if (!value) continue;
    const pugi::xml_node element = node.child(word.element);
    if (word.is_positive && !(*value > 0.0))
      xml.fail(element, "muscle '{}': <{}>: expected a number above 0, found {}", muscle.name, word.element, *value);
    if (word.quantity == Quantity::pennation_angle) *value *= angle_unit(xml, element, words);
    muscle.numbers[word.quantity].value = *value;
  }
  return muscle;
}

/// Adds a remark for lengths and angles whose size suggests another unit.
void note_doubtful_units(CeinmsSubject& subject) {
  struct Limit {
    Quantity quantity;
    double most;
    const char* expected;
  };
  for (const Limit& limit : {Limit{Quantity::optimal_fiber_length, 2.0, "lengths in m"},
                             Limit{Quantity::tendon_slack_length, 2.0, "lengths in m"},
                             Limit{Quantity::pennation_angle, 0.5 * std::numbers::pi, "angles below 90 degrees"}}) {
    std::vector<std::string> names;
    double first = 0.0;
    for (const ProjectMuscle& muscle : subject.muscles) {
      const auto number = muscle.numbers.find(limit.quantity);
      if (number == muscle.numbers.end() || !(std::abs(number->second.value) > limit.most)) continue;
      if (names.empty()) first = number->second.value;
      names.push_back(muscle.name);
    }
    if (names.empty()) continue;
    subject.remarks.push_back(
        {.code = RemarkCode::unit_doubtful,
         .severity = Severity::warning,
         .where = subject.path.filename().string(),
         .about = std::string(choice_name(limit.quantity)),
         .value = first,
         .says = fmt::format("{} of {} (first {}) has {:.4g}; expected {}", choice_name(limit.quantity),
                             counted(names.size(), "muscle"), names.front(), first, limit.expected)});
  }
}

void read_dofs(const OsimXml& xml, pugi::xml_node root, const SubjectWords& words, CeinmsSubject& subject) {
  std::set<std::string> known, unknown;
  for (const ProjectMuscle& muscle : subject.muscles) known.insert(muscle.name);
  for (const pugi::xml_node node : root.child(words.dofs).children(words.dof)) {
    ProjectDof dof{required_word(xml, node, "name"), xml.words(node, words.dof_muscles)};
    for (const std::string& name : dof.muscles)
      if (!known.contains(name)) unknown.insert(name);
    subject.dofs.push_back(std::move(dof));
  }
  if (!unknown.empty())
    note_reading(subject.remarks, subject.path,
                 fmt::format("degrees of freedom name muscles that the subject lacks: {}", name_list(unknown)));
}

/// Gives each muscle the mean of the channels that name it.
void read_channels(const OsimXml& xml, pugi::xml_node root, CeinmsSubject& subject) {
  const pugi::xml_node channels = root.child("Channels");
  subject.has_channels = static_cast<bool>(channels);
  std::map<std::string, std::vector<std::string>> named;
  for (const pugi::xml_node node : channels.children("Channel")) {
    const std::string name = required_word(xml, node, "name");
    for (const std::string& muscle : xml.words(node, "muscleSequence")) named[muscle].push_back(name);
  }
  for (ProjectMuscle& muscle : subject.muscles) {
    const auto found = named.extract(muscle.name);
    if (found.empty()) continue;
    for (const std::string& channel : found.mapped())
      muscle.inputs.push_back({channel, 1.0 / static_cast<double>(found.mapped().size())});
  }
  if (named.empty()) return;
  note_reading(subject.remarks, subject.path,
               fmt::format("channels name muscles that the subject lacks: {}",
                           name_list(named, [](const auto& each) { return each.first; })));
}

}  // namespace

CeinmsSubject read_ceinms_subject(const std::filesystem::path& path) {
  const OsimXml xml = read_document(path);
  const pugi::xml_node root = xml.root().child("subject");
  if (!root) throw ReadError(path, 1, "expected <subject> as the root");
  const SubjectWords& words = subject_words(root.child("muscles") ? Dialect::ceinms_rt : Dialect::ceinms);
  CeinmsSubject subject{.path = path, .dialect = words.dialect};
  const pugi::xml_node defaults = root.child(words.defaults);
  subject.common.delay_s = finite_number(xml, defaults, "emDelay");
  subject.common.damping = finite_number(xml, defaults, "damping");
  subject.common.percentage_change = finite_number(xml, defaults, "percentageChange");
  for (const pugi::xml_node node : defaults.children(words.curve)) subject.curves.push_back(read_curve(xml, node));
  std::set<std::string> names;
  constexpr std::size_t kMostMuscles = 5000;
  for (const pugi::xml_node node : root.child(words.muscles).children(words.muscle)) {
    ProjectMuscle muscle = read_muscle(xml, node, words);
    if (!names.insert(muscle.name).second) xml.fail(node, "two muscles have the name '{}'", muscle.name);
    if (names.size() > kMostMuscles) xml.fail(node, "more than {} muscles", kMostMuscles);
    if (subject.common.delay_s)
      muscle.numbers.try_emplace(Quantity::delay, ProjectNumber{.value = *subject.common.delay_s});
    subject.muscles.push_back(std::move(muscle));
  }
  if (subject.muscles.empty()) xml.fail(root, "<{}> with a <{}> expected, found none", words.muscles, words.muscle);
  read_dofs(xml, root, words, subject);
  read_channels(xml, root, subject);
  const pugi::xml_node calibrated = root.child("calibrationInfo").child("calibrated");
  subject.says_calibrated = static_cast<bool>(calibrated);
  subject.start_file = xml.word(calibrated, "startSubjectFile");
  subject.model_file = xml.word(root, "opensimModelFile");
  note_doubtful_units(subject);
  note_unknown_elements(xml, root, elements_of(words), subject.remarks);
  return subject;
}

std::optional<MuscleQuantity> ceinms_quantity(std::string_view element) {
  for (const NumberWord& word : subject_words(Dialect::ceinms).numbers)
    if (element == word.element) return word.quantity;
  return std::nullopt;
}

Project project_of(CeinmsSubject subject) {
  Project project{.dialect = subject.dialect,
                  .subject = subject.path,
                  .is_calibrated = subject.says_calibrated,
                  .common = subject.common,
                  .curves = std::move(subject.curves),
                  .muscles = std::move(subject.muscles),
                  .dofs = std::move(subject.dofs),
                  .has_mapping = subject.has_channels,
                  .remarks = std::move(subject.remarks)};
  return project;
}

}  // namespace myoid::opensim
