#include "myoid/commands/so.h"

#include <optional>

#include "myoid/commands/stage_input.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/dynamics/torque_plausibility.h"
#include "myoid/forces/sharing_input.h"
#include "myoid/forces/sharing_plausibility.h"
#include "myoid/results/stage_files.h"
#include "myoid/signals/resample.h"
#include "myoid/simulation/muscle_force_law.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::commands {
namespace {

forces::SharingOptions sharing_options(const SoOptions& o,
                                       const model::BodyModel& model,
                                       const forces::SharingInput& input,
                                       Remarks& remarks) {
  forces::SharingOptions options{.objective = *choice_named<forces::SharingObjective>(o.objective),
                                 .exponent = o.exponent,
                                 .reserve_nm = o.reserve_nm};
  if (!o.emg.empty()) {
    const recording::Storage emg = recording::read_storage(o.emg);
    warn_of_repairs(o.emg, emg.repairs, remarks);
    options.emg = signals::resample(emg.data, input.torques.time_s());
    options.emg_weight = o.emg_weight;
  }
  const bool elastic = o.tendon == "elastic";
  if (elastic || o.passive) {
    options.law =
        simulation::muscle_force_law(model, input.muscles, {.elastic_tendon = elastic, .passive_force = o.passive});
  }
  return options;
}

}  // namespace

SoResult so(const SoOptions& o) {
  check_word("--objective", o.objective, {"activation", "force", "stress"});
  check_word("--tendon", o.tendon, {"rigid", "elastic"});
  Remarks remarks(o.call);
  const model::BodyModel model = load_model(o.model, o.compat, remarks);
  if (o.compare_with_opensim) warn_of_path_differences(model, o.model, remarks);
  const kinematics::JointMotion motion =
      load_motion(model, o.motion, o.cutoff_hz, o.call, remarks, kinematics::HeldValues::of_model);
  std::optional<dynamics::ExternalLoads> loads;
  if (!o.loads.empty()) loads = load_external_loads(model, o.loads, motion, remarks);
  if (const auto weight = dynamics::unsupported_weight(model);
      weight && !loads && dynamics::stands(model, motion.q.values().row(0).transpose()))
    remarks.warn(weight->sentence("--loads"));
  const forces::SharingInput input = forces::sharing_input(model, motion, kinematics::muscle_kinematics(model, motion),
                                                           o.coordinates, loads ? &*loads : nullptr);
  for (const std::string& note : input.notes) remarks.warn(note);
  SoResult result;
  remarks.add(dynamics::implausible(model, input.torques), o.motion);
  result.shared = forces::share(input, sharing_options(o, model, input, remarks));
  remarks.add(forces::reserves_act(input, result.shared), o.motion);
  result.remarks = remarks.list();
  return result;
}

void write_so(const SoResult& result, const std::filesystem::path& folder) {
  write_shared_forces(result.shared, folder);
}

}  // namespace myoid::commands
