#include "myoid/study/study_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pugixml.hpp>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/muscle_laws.h"
#include "myoid/body/osim/osim_document.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/osim/osim_writer.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/muscle/absent_parameters.h"

namespace myoid::study {
namespace {

/// Returns the mean length; empty if the markers do not show it.
std::optional<double> forearm_length(const MarkerSeries& markers) {
  const std::vector<double> lengths_m = forearm_lengths_m(markers);
  if (lengths_m.empty()) return std::nullopt;
  return std::accumulate(lengths_m.begin(), lengths_m.end(), 0.0) / static_cast<double>(lengths_m.size());
}

body::Arm4Options arm_options(const Study& study, const MarkerSeries* markers) {
  constexpr double kUpperArmOverForearm = 0.2817 / 0.2689;  // de Leva (1996), men
  body::Arm4Options options;
  if (study.subject.mass_kg) options.person.mass_kg = *study.subject.mass_kg;
  options.person.female = study.subject.sex == Sex::female;
  options.horizontal = study.model.horizontal;
  options.forearm_rotations = study.model.forearm_rotations;
  if (study.model.forearm_length_m) {
    options.person.forearm_length_m = *study.model.forearm_length_m;
  } else if (markers != nullptr) {
    if (const auto measured = forearm_length(*markers)) {
      options.person.forearm_length_m = *measured;
      options.person.upper_arm_length_m = kUpperArmOverForearm * *measured;
    }
  }
  if (study.model.upper_arm_length_m) options.person.upper_arm_length_m = *study.model.upper_arm_length_m;
  return options;
}

/// Returns the starting values of a muscle without a model: those that the study states, and the literature's.
muscle::HillParameters<double> stated_start(const MuscleSpec& spec) {
  muscle::HillParameters<double> start;
  for (const auto& [name, value] : spec.start) start.*muscle::hill_field(name).member = value;
  muscle::complete_by_literature(start);
  return start;
}

/// Returns a head of such a muscle, without a path: its length is constant, and it has no moment arm.
body::Muscle stated_head(const MuscleSpec& spec, const std::string& name) {
  const muscle::HillParameters<double> start = stated_start(spec);
  const double l0_m = start.optimal_fiber_length_m;
  body::Muscle head{.name = name, .class_name = "Thelen2003Muscle", .properties = {}, .path = {}};
  head.properties = {.max_isometric_force_n = start.max_isometric_force_n / static_cast<double>(spec.osim.size()),
                     .optimal_fiber_length_m = l0_m,
                     .tendon_slack_length_m = start.tendon_slack_length_m,
                     .max_contraction_velocity = start.max_shortening_speed_mps / l0_m,
                     .active_shape = std::pow(start.force_length_width_m / l0_m, 2),
                     .concentric_shape = start.concentric_curvature,
                     .eccentric_plateau = start.eccentric_plateau,
                     .default_fiber_length_m = l0_m,
                     .curves = {}};
  const double length_m = l0_m + start.tendon_slack_length_m;
  head.path.function = {.coordinates = {0}, .length = {.coefficients = {length_m}}, .moment_arms = {}};
  return head;
}

/// Returns the names of a study without a body as a model: massless bodies that turn about each other by the study's
/// coordinates, and muscles without paths.
body::BodyModel names_alone(const Study& study) {
  body::BodyModel model;
  model.name = "none";
  model.bodies.push_back({.name = "ground"});
  for (const std::string& name : study_coordinates(study.model)) {
    const auto c = static_cast<int>(model.coordinates.size());
    body::Joint joint{.name = name, .class_name = "PinJoint", .parent = c, .child = c + 1, .coordinates = {c}};
    joint.rotation[2] = {.axis = Vec3::UnitZ(), .coordinate = c, .function = {body::Linear{}}};
    model.joints.push_back(std::move(joint));
    model.bodies.push_back({.name = name});
    model.coordinates.push_back({.name = name, .joint = c});
  }
  for (const MuscleSpec& spec : study.muscles) {
    for (const std::string& name : spec.osim) model.muscles.push_back(stated_head(spec, name));
  }
  return body::finalize(std::move(model));
}

/// Returns pennation, passive force and tendon of a model's muscle.
fit::MuscleExtras model_extras(const body::Muscle& muscle) {
  const body::MuscleProperties& p = muscle.properties;
  if (std::holds_alternative<body::SchutteCurves>(p.curves)) {
    throw ModelError(
        fmt::format("muscle '{}' is a {}, whose passive force is a free curve; give passive_force and pennation_angle "
                    "by [[parameter]], and in [identify] muscle_law = \"paper\" and tendon = \"rigid\"",
                    muscle.name, muscle.class_name));
  }
  const muscle::MusculotendonLaws laws = body::class_laws(p, muscle::TendonMode::equilibrium);
  const muscle::MusculotendonParameters<double> unit = body::musculotendon_parameters(p, laws);
  if (unit.pennation_at_optimal_rad > fit::parameter_field("pennation_angle").bounds.upper)
    throw ModelError(
        fmt::format("muscle '{}': pennation_angle_at_optimal = {:g} rad, expected 0 to 1 rad; of an angle "
                    "in degrees write {:.4g}",
                    muscle.name, unit.pennation_at_optimal_rad, unit.pennation_at_optimal_rad * kDegree));
  return {.pennation_angle_rad = unit.pennation_at_optimal_rad,
          .passive_force = laws.passive == muscle::PassiveLaw::none ? 0.0 : 1.0,
          .passive_strain = unit.passive_strain,
          .passive_shape = unit.passive_shape,
          .tendon_strain = unit.tendon_strain};
}

/// Returns true if the study bounds V_sh V_shl of the muscle, or has a prior of its own for it.
bool wishes_product(const Study& study, const std::string& muscle) {
  return std::ranges::any_of(study.parameters, [&](const fit::ParameterRule& rule) {
    return rule.parameter == "eccentric_curvature_product" && (rule.lower || rule.upper || rule.prior_sd) &&
           fit::covers(rule.owners, muscle);
  });
}

/// Refuses methods that take the muscles one by one where a muscle has no EMG.
void require_torques(const Study& study) {
  const auto other =
      std::ranges::find_if(study.identify.methods, [](fit::Method m) { return m != fit::Method::torque; });
  const auto without =
      std::ranges::find_if(study.muscles, [](const MuscleSpec& m) { return m.without_emg.has_value(); });
  if (other == study.identify.methods.end() || without == study.muscles.end()) return;
  throw InvalidInput(
      fmt::format("{}: [[muscle]] {}: found without_emg and method = \"{}\", which needs the EMG of every muscle; "
                  "expected [identify] method = \"torque\", or no method, which takes it",
                  study.file.string(), without->name, fit::name(*other)));
}

/// Applies the study's settings to the model, after a check that it has the study's names.
body::BodyModel prepared(const Study& study, body::BodyModel model) {
  body::require_lengths_in_m(model, study.model.file.value_or("arm4.osim"));
  const auto coordinate = [&](std::string_view key, const std::string& name) -> body::Coordinate& {
    try {
      return model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))];
    } catch (const ModelError& error) {
      throw ModelError(fmt::format("{}: {}: {}", study.file.string(), key, error.what()));
    }
  };
  for (const std::string& name : study_coordinates(study.model)) (void)coordinate("[model] coordinate", name);
  for (const MuscleSpec& muscle : study.muscles) {
    for (const std::string& name : muscle.osim) {
      try {
        (void)model.muscle_index(name);
      } catch (const ModelError& error) {
        constexpr std::string_view kOpen = "TODO";  // of a draft
        throw ModelError(fmt::format("{}: [[muscle]] {}: {}{}", study.file.string(), muscle.name,
                                     name == kOpen ? "the draft asks for name, osim and emg of a muscle; " : "",
                                     error.what()));
      }
    }
  }
  for (const std::string& name : study.ik.unlock) coordinate("[ik] unlock", name).locked = false;
  for (const std::string& name : study.ik.lock) coordinate("[ik] lock", name).locked = true;
  for (const auto& [name, weight] : study.markers.weight) {
    if (model.find_marker(name)) continue;
    throw ModelError(fmt::format("{}: [markers.weight] {}: the model has no such marker{}", study.file.string(), name,
                                 not_among(name, model.markers, &body::Marker::name)));
  }
  if (study.model.held_mass && !model.find_body(study.model.held_mass->body))
    throw ModelError(fmt::format("{}: [model] held_mass: the model has no body '{}'{}", study.file.string(),
                                 study.model.held_mass->body,
                                 not_among(study.model.held_mass->body, body_names(model))));
  return model;
}

}  // namespace

std::optional<Remark> without_paper(const Study& study) {
  if (!study.identify.leaves_out_paper) return std::nullopt;
  const auto without =
      std::ranges::find_if(study.muscles, [](const MuscleSpec& m) { return m.without_emg.has_value(); });
  return Remark{.severity = Severity::note,
                .where = "study",
                .says = fmt::format("method paper is left out: it takes each muscle by its EMG, and {} has none",
                                    without == study.muscles.end() ? "a muscle" : without->name)};
}

std::string assumed_starts(const Study& study) {
  if (!study.model.is_none()) return "";
  std::vector<std::string> parts;
  for (const muscle::HillField& field : muscle::kHillFields) {
    const std::string name(field.name);
    if (name == "tendon_slack_length") continue;  // without one the lengths are those of fibers
    std::vector<std::string> muscles;
    for (const MuscleSpec& muscle : study.muscles) {
      if (!muscle.start.contains(name)) muscles.push_back(muscle.name);
    }
    if (muscles.empty()) continue;
    const char* const value = name == "force_length_width"     ? "0.45 l_m0"
                              : name == "concentric_curvature" ? "0.28"
                              : name == "eccentric_plateau"    ? "1.4"
                              : name == "max_shortening_speed"
                                  ? "10 l_m0 per second"
                                  : "by a slope in lengthening of 1.5 times that in shortening";
    parts.push_back(fmt::format("{} = {}", name, value));
    if (muscles.size() < study.muscles.size()) parts.back() += fmt::format(" ({})", fmt::join(muscles, ", "));
  }
  if (parts.empty()) return "";
  return fmt::format("{}: start from the literature's values: {}", study.file.string(), fmt::join(parts, ", "));
}

std::vector<double> forearm_lengths_m(const MarkerSeries& markers) {
  const auto find = [&](std::string_view name) -> Eigen::Index {
    const auto it = std::ranges::find(markers.names, name);
    return it == markers.names.end() ? -1 : it - markers.names.begin();
  };
  const Eigen::Index lateral = find("r_epicondyle_lateral");
  const Eigen::Index medial = find("r_epicondyle_medial");
  const Eigen::Index radial = find("r_styloid_radial");
  const Eigen::Index ulnar = find("r_styloid_ulnar");
  if (lateral < 0 || medial < 0 || radial < 0 || ulnar < 0) return {};
  std::vector<double> lengths_m;
  for (Eigen::Index frame = 0; frame < markers.frame_count(); ++frame) {
    const Vec3 elbow = 0.5 * (markers.position(frame, lateral) + markers.position(frame, medial));
    const Vec3 wrist = 0.5 * (markers.position(frame, radial) + markers.position(frame, ulnar));
    const double length = (wrist - elbow).norm();
    if (std::isfinite(length)) lengths_m.push_back(length);
  }
  return lengths_m;
}

std::string model_text(const Study& study) {
  if (!study.model.text.empty()) return study.model.text;
  if (study.model.file) return body::read_whole_text(*study.model.file);
  if (study.model.is_none()) return "";
  return body::arm4_osim(arm_options(study, nullptr));
}

body::BodyModel load_model(const Study& study, const std::string& text) {
  if (study.model.is_none()) return names_alone(study);
  return prepared(study, body::parse_osim(text, study.model.file.value_or("arm4.osim")));
}

body::BodyModel load_model(const Study& study) { return load_model(study, model_text(study)); }

std::optional<body::BodyModel> arm_of_markers(const Study& study, const MarkerSeries& markers) {
  if (!study.model.is_arm() || study.model.forearm_length_m || !forearm_length(markers)) return std::nullopt;
  return prepared(study, body::parse_osim(body::arm4_osim(arm_options(study, &markers)), "arm4.osim"));
}

std::vector<std::string> body_names(const body::BodyModel& model) {
  std::vector<std::string> names;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) names.push_back(model.bodies[b].name);
  return names;
}

HeldMassSpec held_mass_place(const Study& study) {
  if (study.model.held_mass) return *study.model.held_mass;
  if (study.model.is_arm()) return {"forearm_hand", body::arm4_held_at_m()};
  throw InvalidInput("held_mass_kg is given, but [model] held_mass does not say where it acts");
}

std::vector<body::MuscleGroup> muscle_groups(const Study& study, const body::BodyModel& model) {
  std::vector<body::MuscleGroup> groups;
  for (const MuscleSpec& spec : study.muscles) {
    body::MuscleGroup group;
    double sum = 0.0;
    for (const std::string& name : spec.osim) {
      group.members.push_back(model.muscle_index(name));
      group.weights.push_back(
          model.muscles[static_cast<std::size_t>(group.members.back())].properties.max_isometric_force_n);
      sum += group.weights.back();
    }
    for (double& w : group.weights) w /= sum;
    groups.push_back(std::move(group));
  }
  return groups;
}

bool takes_model_law(const Study& study) {
  if (study.identify.muscle_law == MuscleLaw::automatic) return study.model.file.has_value();
  return study.identify.muscle_law == MuscleLaw::model;
}

std::vector<fit::MuscleSetup> muscle_setups(const Study& study, const body::BodyModel& model) {
  require_torques(study);
  std::vector<fit::MuscleSetup> setups;
  const std::vector<body::MuscleGroup> groups = muscle_groups(study, model);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const MuscleSpec& spec = study.muscles[g];
    fit::MuscleSetup setup;
    setup.name = spec.name;
    setup.emg_channel = spec.without_emg ? spec.name + " without EMG" : spec.emg;
    if (spec.without_emg) setup.unseen = fit::UnseenActivation{.by = *spec.without_emg, .parts = {}};
    setup.start = {};
    for (std::size_t i = 0; i < groups[g].members.size(); ++i) {
      const auto head = body::hill_parameters(model.muscles[static_cast<std::size_t>(groups[g].members[i])].properties);
      for (const muscle::HillField& field : muscle::kHillFields) {
        const double share = field.name == "max_isometric_force" ? 1.0 : groups[g].weights[i];
        setup.start.*field.member += share * head.*field.member;
      }
    }
    if (study.model.is_none()) {
      setup.start = stated_start(spec);
    } else if (takes_model_law(study) || study.identify.elastic_tendon) {
      fit::MuscleExtras mean{.passive_strain = 0.0, .passive_shape = 0.0};
      for (std::size_t i = 0; i < groups[g].members.size(); ++i) {
        const auto head = model_extras(model.muscles[static_cast<std::size_t>(groups[g].members[i])]);
        const double weight = groups[g].weights[i];
        mean.pennation_angle_rad += weight * head.pennation_angle_rad;
        mean.passive_force += weight * head.passive_force;
        mean.passive_strain += weight * head.passive_strain;
        mean.passive_shape += weight * head.passive_shape;
        mean.tendon_strain += weight * head.tendon_strain;
      }
      if (takes_model_law(study)) setup.extras = mean;
      setup.extras.tendon_strain = study.identify.elastic_tendon ? mean.tendon_strain : 0.0;
    }
    for (const auto& [name, value] : spec.start) setup.start.*muscle::hill_field(name).member = value;
    setup.fixed = spec.fixed;
    setup.priors = fit::literature_priors(setup.start);
    // A wish for the product makes it the unknown, in the place of the ratio of slopes.
    if (wishes_product(study, spec.name)) setup.priors.erase("eccentric_slope_ratio");
    muscle::validate(setup.start);
    setups.push_back(std::move(setup));
  }
  return setups;
}

std::string identified_model(const Study& study,
                             const std::string& osim,
                             const std::vector<IdentifiedMuscle>& muscles) {
  const body::BodyModel before = body::parse_osim(osim, "the identified model");
  std::vector<body::OsimChange> changes;
  for (const IdentifiedMuscle& muscle : muscles) {
    const auto spec = std::ranges::find_if(study.muscles, [&](const MuscleSpec& m) { return m.name == muscle.group; });
    if (spec == study.muscles.end()) continue;
    const auto changed = [&](std::string_view name) {
      return std::ranges::find(muscle.changed, name) != muscle.changed.end();
    };
    for (const std::string& name : spec->osim) {
      const auto index = before.find_muscle(name);
      if (!index) continue;
      const body::Muscle& old = before.muscles[static_cast<std::size_t>(*index)];
      const auto set = [&](const char* property, double value) {
        changes.push_back({"ForceSet", name, property, {value}});
      };
      if (changed("max_isometric_force")) {
        set("max_isometric_force", old.properties.max_isometric_force_n *
                                       (muscle.identified.max_isometric_force_n / muscle.start.max_isometric_force_n));
      }
      if (changed("optimal_fiber_length")) {
        set("optimal_fiber_length", old.properties.optimal_fiber_length_m * (muscle.identified.optimal_fiber_length_m /
                                                                             muscle.start.optimal_fiber_length_m));
      }
      // The shape parameters are Thelen's; other classes have curves of their own.
      if (!old.class_name.starts_with("Thelen2003Muscle")) continue;
      // The file's (l_sh / l0)^2 needs both numbers to be identified.
      if (changed("force_length_width") && changed("optimal_fiber_length")) {
        const double ratio = muscle.identified.force_length_width_m / muscle.identified.optimal_fiber_length_m;
        set("KshapeActive", ratio * ratio);
      }
      if (changed("concentric_curvature")) set("Af", muscle.identified.concentric_curvature);
      if (changed("eccentric_plateau")) set("Flen", muscle.identified.eccentric_plateau);
    }
  }
  return body::changed_osim(osim, "the identified model", changes);
}

}  // namespace myoid::study
