#include "myoid/study/study_json.h"

#include <nlohmann/json.hpp>

#include "myoid/core/json_text.h"
#include "myoid/study/trial_up.h"

namespace myoid {
namespace {

using nlohmann::ordered_json;

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json or_null(const std::optional<std::filesystem::path>& path) {
  return path ? ordered_json(path->string()) : ordered_json(nullptr);
}

template <typename Enumeration>
ordered_json names_of(const std::vector<Enumeration>& values) {
  ordered_json names = ordered_json::array();
  for (const Enumeration value : values) names.push_back(choice_name(value));
  return names;
}

ordered_json model_json(const ModelSpec& model) {
  ordered_json j = {{"file", or_null(model.file)},
                    {"builtin", model.builtin},
                    {"upper_arm_length_m", or_null(model.upper_arm_length_m)},
                    {"forearm_length_m", or_null(model.forearm_length_m)},
                    {"horizontal", model.horizontal},
                    {"forearm_rotations", model.forearm_rotations},
                    {"coordinate", study_coordinates(model)},
                    {"held_mass", nullptr}};
  if (model.held_mass) {
    const Vec3& p = model.held_mass->p_BP_m;
    j["held_mass"] = {{"body", model.held_mass->body}, {"point_m", {p.x(), p.y(), p.z()}}};
  }
  return j;
}

ordered_json ik_json(const IkSpec& ik) {
  ordered_json j = {{"unlock", ik.unlock}, {"lock", ik.lock}, {"calibrate", nullptr}};
  if (ik.calibrate) {
    j["calibrate"] = {{"window_s", ik.calibrate->window_s},
                      {"free", ik.calibrate->free},
                      {"hold", ik.calibrate->hold}};
  }
  return j;
}

ordered_json emg_json(const EmgSpec& emg) {
  ordered_json j = {{"kind", choice_name(emg.kind)},
                    {"unit", emg.unit},
                    {"rectify", emg.rectify},
                    {"notch", emg.notch ? "auto" : "none"},
                    {"whitening", emg.whitening},
                    {"highpass_hz", emg.highpass_hz},
                    {"lowpass_hz", emg.lowpass_hz},
                    {"as_published", emg.as_published},
                    {"normalise_window_s", emg.normalise_window_s},
                    {"mvc_effort", emg.mvc_effort},
                    {"mvc_effort_sd", emg.mvc_effort_sd}};
  j["delay_s"] = emg.delay_s ? ordered_json(*emg.delay_s) : ordered_json("estimate");
  return j;
}

ordered_json sync_json(const std::optional<SyncSpec>& sync) {
  if (!sync) return nullptr;
  ordered_json j = {
      {"offset_s", or_null(sync->offset_s)},    {"offset_sd_s", or_null(sync->offset_sd_s)},
      {"drift_ppm", sync->drift_ppm},           {"emg_trigger", sync->emg_trigger},
      {"motion_trigger", sync->motion_trigger}, {"trigger_file", or_null(sync->trigger_file)},
      {"match", choice_name(sync->match)},      {"search_s", sync->search_s},
      {"loads_offset_s", sync->loads_offset_s}, {"loads_drift_ppm", sync->loads_drift_ppm}};
  if (sync->estimate) j["offset_s"] = "estimate";
  return j;
}

ordered_json plates_json(const std::optional<PlateSpec>& plates) {
  if (!plates) return nullptr;
  return {{"file", plates->file.string()},
          {"bodies", plates->bodies},
          {"least_force_n", plates->least_force_n},
          {"lowpass_hz", or_null(plates->lowpass_hz)}};
}

ordered_json trial_json(const TrialSpec& trial) {
  return {{"name", trial.name},
          {"markers", or_null(trial.markers)},
          {"motion", or_null(trial.motion)},
          {"emg", or_null(trial.emg)},
          {"external_torque", or_null(trial.external_torque)},
          {"external_loads", or_null(trial.external_loads)},
          {"load_cell", or_null(trial.load_cell)},
          {"force_plates", plates_json(trial.plates)},
          {"use", choice_name(trial.use)},
          {"held_mass_kg", trial.held_mass_kg},
          {"condition", trial.condition},
          {"start_s", or_null(trial.start_s)},
          {"end_s", or_null(trial.end_s)},
          {"sync", sync_json(trial.sync)}};
}

}  // namespace

std::string study_json(const Study& study) {
  ordered_json j;
  j["subject"] = {{"name", study.subject.name},
                  {"mass_kg", or_null(study.subject.mass_kg)},
                  {"sex", choice_name(study.subject.sex)},
                  {"notes", study.subject.notes}};
  j["model"] = model_json(study.model);
  j["motion"] = {{"smoothing", choice_name(study.motion.smoothing)},
                 {"cutoff_hz", study.motion.cutoff_hz},
                 {"rate_hz", study.motion.rate_hz}};
  j["markers"] = {
      {"rename", study.markers.rename},
      {"weight", study.markers.weight},
      {"up", study.markers.up == kUpOfTheFile ? "auto" : std::string(1, study.markers.up)},
      {"undo_swaps", study.markers.undo_swaps},
      {"fill_gaps", study.markers.fill_gaps}};
  j["ik"] = ik_json(study.ik);
  j["emg"] = emg_json(study.emg);
  j["sync"] = sync_json(study.sync);
  j["load_cell"] = nullptr;
  if (const auto& cell = study.load_cell) {
    j["load_cell"] = {{"channels", cell->channels},
                      {"calibration", cell->calibration.string()},
                      {"sign", cell->sign},
                      {"zero_s", cell->zero_s},
                      {"instrument", or_null(cell->instrument)},
                      {"frame", cell->frame},
                      {"body", cell->body},
                      {"lowpass_hz", or_null(cell->lowpass_hz)}};
  }
  j["sharing"] = {{"objective", choice_name(study.sharing.objective)},
                  {"exponent", study.sharing.exponent},
                  {"reserve_nm", study.sharing.reserve_nm}};
  j["phases"] = {{"search", study.phases.search}, {"exclude", names_of(study.phases.exclude)}};
  j["identify"] = {{"method", names_of(study.identify.methods)},
                   {"force_loop", study.identify.force_loop},
                   {"muscles", study.identify.muscles},
                   {"priors", study.identify.priors},
                   {"gain", study.identify.gain},
                   {"max_rate_hz", study.identify.max_rate_hz},
                   {"cross_validate", study.identify.cross_validate},
                   {"next_movements", study.identify.next_movements},
                   {"starts", study.identify.starts},
                   {"folds", choice_name(study.identify.folds)},
                   {"bootstrap", study.identify.bootstrap},
                   {"profile", study.identify.profile},
                   {"loss", choice_name(study.identify.loss)},
                   {"eccentric", choice_name(study.identify.eccentric)},
                   {"normalised", study.identify.normalised},
                   {"lag", choice_name(study.identify.lag)},
                   {"dynamics", study.identify.dynamics},
                   {"muscle_law", study.identify.model_muscles ? "model" : "paper"},
                   {"tendon", study.identify.elastic_tendon ? "elastic" : "rigid"},
                   {"delay_per_channel", study.identify.delay_per_channel},
                   {"angle_sd_rad", study.identify.angle_sd_rad},
                   {"angle_rate_sd_radps", study.identify.angle_rate_sd_radps}};
  for (const identification::ParameterRule& r : study.parameters) {
    j["parameter"].push_back({{"name", r.parameter},
                              {"of", r.owners},
                              {"free", or_null(r.free)},
                              {"value", or_null(r.value)},
                              {"lower", or_null(r.lower)},
                              {"upper", or_null(r.upper)},
                              {"prior_mean", or_null(r.prior_mean)},
                              {"prior_sd", or_null(r.prior_sd)},
                              {"tie", r.tie}});
  }
  for (const MuscleSpec& m : study.muscles) {
    j["muscle"].push_back({{"name", m.name},
                           {"osim", m.osim},
                           {"emg", m.emg},
                           {"same_as", or_null(m.same_as)},
                           {"start", m.start},
                           {"fixed", m.fixed}});
  }
  for (const TrialSpec& t : study.trials) j["trial"].push_back(trial_json(t));
  j["truth"] = or_null(study.truth);
  return json_text(j, -1);
}

}  // namespace myoid
