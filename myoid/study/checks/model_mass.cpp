#include "myoid/study/checks/model_mass.h"

#include <fmt/format.h>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

const std::string kToScale = "scale the model to the person (myoid run-tool with a set-up of the Scale tool)";

}  // namespace

std::vector<Remark> unlikely_mass(const Study& study, const body::BodyModel& model) {
  const double mass_kg = body::mass_kg(model);
  const auto finding = [&](Severity severity, std::string says, std::string remedy) {
    return std::vector<Remark>{{.code = RemarkCode::mass_impossible,
                                .severity = severity,
                                .where = "study",
                                .about = "mass",
                                .says = std::move(says),
                                .remedy = std::move(remedy)}};
  };
  const std::string found = fmt::format("the bodies of the model weigh {:.4g} kg", mass_kg);
  const auto& person_kg = study.subject.mass_kg;
  if (mass_kg > body::kModelLimits.heaviest_kg || mass_kg < body::kModelLimits.lightest_kg) return {};
  if (person_kg && mass_kg > kLimits.model.heavier_than * *person_kg)
    return finding(Severity::warning,
                   fmt::format("{}, {:.3g} times the person's {:g} kg ([subject] mass_kg): every torque by weight and "
                               "inertia is too large by that",
                               found, mass_kg / *person_kg, *person_kg),
                   kToScale + ", or correct mass_kg");
  if (person_kg && kLimits.model.heavier_than * mass_kg < *person_kg && body::stands(model, model.default_q()))
    return finding(Severity::warning,
                   fmt::format("{}, {:.3g} times the person's {:g} kg ([subject] mass_kg), though the model is a whole "
                               "person (mass_kg in pounds?)",
                               found, mass_kg / *person_kg, *person_kg),
                   "correct mass_kg, or " + kToScale);
  return {};
}

}  // namespace myoid::study
