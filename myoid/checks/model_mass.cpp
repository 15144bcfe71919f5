#include "myoid/checks/model_mass.h"

#include <fmt/format.h>

#include "myoid/dynamics/ground_support.h"
#include "myoid/intake/limits.h"

namespace myoid {
namespace {

const std::string kToScale = "scale the model to the person (myoid run-tool with a set-up of the Scale tool)";

}  // namespace

std::vector<Remark> unlikely_mass(const Study& study, const model::BodyModel& model) {
  double mass_kg = 0.0;
  for (const model::Body& body : model.bodies) mass_kg += body.mass_kg;
  const auto finding = [&](Severity severity, std::string says, std::string remedy) {
    return std::vector<Remark>{{.code = RemarkCode::general,
                                .severity = severity,
                                .where = "study",
                                .about = "mass",
                                .says = std::move(says),
                                .remedy = std::move(remedy)}};
  };
  const std::string found = fmt::format("the bodies of the model weigh {:.4g} kg", mass_kg);
  const auto& person_kg = study.subject.mass_kg;
  if (mass_kg > kLimits.heaviest_kg)
    return finding(Severity::error,
                   fmt::format("{}, more than any person{}: are its masses in grams?", found,
                               person_kg ? fmt::format(" (this one weighs {:g} kg)", *person_kg) : ""),
                   "write the masses and inertias in kg and kg m2, or " + kToScale);
  if (mass_kg < kLimits.lightest_kg)
    return finding(Severity::warning,
                   fmt::format("{}: weight and inertia of the limb are missing from its torque", found),
                   "give the bodies their masses [kg]");
  if (person_kg && mass_kg > kLimits.heavier_than * *person_kg)
    return finding(Severity::warning,
                   fmt::format("{}, {:.3g} times the person's {:g} kg ([subject] mass_kg): every torque by weight and "
                               "inertia is too large by that",
                               found, mass_kg / *person_kg, *person_kg),
                   kToScale + ", or correct mass_kg");
  if (person_kg && kLimits.heavier_than * mass_kg < *person_kg && dynamics::stands(model, model.default_q()))
    return finding(Severity::warning,
                   fmt::format("{}, {:.3g} times the person's {:g} kg ([subject] mass_kg), though the model is a whole "
                               "person (mass_kg in pounds?)",
                               found, mass_kg / *person_kg, *person_kg),
                   "correct mass_kg, or " + kToScale);
  return {};
}

}  // namespace myoid
