#include "myoid/program/commands/so.h"

#include <optional>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/body/forces/sharing_plausibility.h"
#include "myoid/body/simulation/muscle_force_law.h"
#include "myoid/program/commands/stage_input.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/results/stage_files.h"

namespace myoid::program {
namespace {

body::SharingOptions sharing_options(const SoOptions& o,
                                     const body::BodyModel& model,
                                     const body::SharingInput& input,
                                     Remarks& remarks) {
  body::SharingOptions options{.objective = *choice_named<body::SharingObjective>(o.objective),
                               .exponent = o.exponent,
                               .reserve_nm = o.reserve_nm};
  if (!o.emg.empty()) {
    const recording::Storage emg = recording::read_storage(o.emg);
    warn_of_repairs(o.emg, emg.repairs, remarks);
    options.emg = recording::resample(emg.data, input.torques.time_s());
    options.emg_weight = o.emg_weight;
  }
  const bool elastic = o.tendon == "elastic";
  if (elastic || o.passive) {
    options.law = body::muscle_force_law(model, input.muscles, {.elastic_tendon = elastic, .passive_force = o.passive});
  }
  return options;
}

}  // namespace

SoResult so(const SoOptions& o) {
  check_word("--objective", o.objective, {"activation", "force", "stress"});
  check_word("--tendon", o.tendon, {"rigid", "elastic"});
  Remarks remarks(o.call);
  const body::BodyModel model = load_model(o.model, o.compat, remarks);
  if (o.compare_with_opensim) warn_of_path_differences(model, o.model, remarks);
  const body::JointMotion motion =
      load_motion(model, o.motion, o.cutoff_hz, o.call, remarks, body::HeldValues::of_model);
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
