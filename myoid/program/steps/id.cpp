#include "myoid/program/steps/id.h"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/series_file.h"
#include "myoid/study/study_model.h"

namespace myoid::program {
namespace {

body::BodyModel holding(body::BodyModel model, const IdOptions& o) {
  if (o.held.mass_kg == 0.0) return model;
  Vec3 p_BP_m(o.held.at_m[0], o.held.at_m[1], o.held.at_m[2]);
  std::string body = o.held.body;
  if (body.empty() && o.model == "arm4") {
    body = "forearm_hand";
    if (p_BP_m.isZero()) p_BP_m = body::arm4_held_at_m();
  }
  if (body.empty())
    throw InvalidInput(fmt::format("--held-mass {} needs --held-body, the body that carries it, one of {}",
                                   o.held.mass_kg, fmt::join(study::body_names(model), ", ")));
  return body::with_held_mass(std::move(model), body, p_BP_m, o.held.mass_kg);
}

}  // namespace

void visit(IdOptions& o, study::SettingVisitor& v) {
  visit_model(o.model, v);
  visit_motion(o.motion, v);
  v.path("out", o.out, {.says = "Generalized forces (.sto, .mot, .csv) [N m, N].", .required = "a file"});
  visit_lowpass(o.cutoff_hz, v);
  v.path("speeds", o.speeds,
         {.says = "Speeds of the coordinates at the times of --motion (.sto), instead of its derivatives."});
  v.path("accelerations", o.accelerations, {.says = "Accelerations, likewise."});
  visit_loads(o.loads, v);
  visit(o.held, v);
  visit_compat(o.compat, v);
}

IdResult id(const IdOptions& o) {
  check_options(o);
  if (o.cutoff_hz && !(o.speeds.empty() && o.accelerations.empty()))
    throw InvalidInput(
        "--lowpass smooths angles that are differentiated: leave it out with --speeds or --accelerations");
  Remarks remarks(o.call);
  const body::BodyModel model = holding(load_model(o.model, o.compat, remarks), o);
  const body::JointMotion motion = with_derivatives(load_motion(model, o.motion, o.cutoff_hz, o.call, remarks), model,
                                                    o.speeds, o.accelerations, o.call, remarks);
  std::optional<body::ExternalLoads> loads;
  if (!o.loads.empty()) loads = load_external_loads(model, o.loads, motion, remarks);
  IdResult result;
  result.forces = body::inverse_dynamics(model, motion, {.loads = loads ? &*loads : nullptr});
  if (const auto weight = body::unsupported_weight(model, result.forces);
      weight && !(loads && body::wrong_support(model, *loads, motion.q.time_s())) &&
      body::stands(model, motion.q.values().row(0).transpose()))
    remarks.warn(weight->sentence(loads ? "" : "--loads"));
  remarks.add(body::implausible_torques(model, result.forces), o.motion);
  result.remarks = remarks.list();
  return result;
}

void write_id(const IdResult& result, const std::filesystem::path& path) {
  recording::write_series(path, result.forces, "Inverse Dynamics Generalized Forces");
}

}  // namespace myoid::program
