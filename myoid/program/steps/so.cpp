#include "myoid/program/steps/so.h"

#include <optional>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/body/forces/sharing_plausibility.h"
#include "myoid/body/simulation/muscle_force_law.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/results/stage_files.h"

namespace myoid::program {
namespace {

body::SharingOptions sharing_options(const SoOptions& o,
                                     const body::BodyModel& model,
                                     const body::SharingInput& input,
                                     Remarks& remarks) {
  body::SharingOptions options{.objective = o.objective, .exponent = o.exponent, .reserve_nm = o.reserve_nm};
  if (!o.emg.empty()) {
    const recording::Storage emg = recording::read_storage(o.emg);
    warn_of_repairs(o.emg, emg.repairs, remarks);
    options.emg = recording::resample(emg.data, input.torques.time_s());
    options.emg_weight = o.emg_weight;
  }
  if (o.elastic_tendon || o.passive)
    options.law =
        body::muscle_force_law(model, input.muscles, {.elastic_tendon = o.elastic_tendon, .passive_force = o.passive});
  return options;
}

}  // namespace

void visit(SoOptions& o, study::SettingVisitor& v) {
  static constexpr std::string_view kTendons[] = {"rigid", "elastic"};
  visit_model(o.model, v);
  visit_motion(o.motion, v);
  v.folder("out", o.out, {.says = "Folder for StaticOptimization_*.", .required = "a folder"});
  v.choice("objective", o.objective, {.says = "What the muscles share sparingly."});
  v.number("exponent", o.exponent, {.says = "Exponent of the sum.", .limits = {.lower = 1.0, .above_lower = true}});
  v.path("emg", o.emg, {.says = "Measured activations by muscle name (.sto), to stay near."});
  v.number("emg-weight", o.emg_weight, {.says = "Weight of that term.", .limits = study::zero_or_more()});
  v.number("reserve", o.reserve_nm,
           {.says = "Optimal torque of the reserve on every coordinate.", .limits = study::above_zero("N m")});
  v.texts("coordinate", o.coordinates,
          {.says = "Coordinate whose torque the muscles balance, repeated.",
           .otherwise = "all that take a value of their own"});
  visit_lowpass(o.cutoff_hz, v);
  visit_loads(o.loads, v);
  v.either("tendon", o.elastic_tendon,
           {.says = "rigid, or elastic: fiber and tendon in balance by the muscle's own curves, in every frame for "
                    "itself: the tendon's own rate is left out.",
            .words = kTendons});
  v.flag("passive", o.passive,
         {.says = "The fibers' passive springs and dampers pull too, and the muscles share the rest."});
  visit_compat(o.compat, v);
}

SoResult so(const SoOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  const auto [model, motion] = load_moved_model(o.model, o.compat, o.motion, o.cutoff_hz, o.call, remarks);
  std::optional<body::ExternalLoads> loads;
  if (!o.loads.empty()) loads = load_external_loads(model, o.loads, motion, remarks);
  if (const auto weight = body::unsupported_weight(model);
      weight && !loads && body::stands(model, motion.q.values().row(0).transpose()))
    remarks.warn(weight->sentence("--loads"));
  const body::SharingInput input = body::sharing_input(model, motion, body::muscle_kinematics(model, motion),
                                                       o.coordinates, loads ? &*loads : nullptr);
  for (std::string& note : sentences(input.notes)) remarks.warn(std::move(note));
  SoResult result;
  remarks.add(body::implausible_torques(model, input.torques), o.motion);
  result.shared = body::share(input, sharing_options(o, model, input, remarks));
  remarks.add(body::reserves_act(input, result.shared), o.motion);
  result.remarks = remarks.list();
  return result;
}

void write_so(const SoResult& result, const std::filesystem::path& folder) {
  results::write_shared_forces(result.shared, folder);
}

}  // namespace myoid::program
