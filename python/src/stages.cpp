#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/commands/emg.h"
#include "myoid/program/commands/id.h"
#include "myoid/program/commands/ik.h"
#include "myoid/program/commands/paths.h"
#include "myoid/program/commands/run_tool.h"
#include "myoid/program/commands/so.h"
#include "myoid/program/commands/sweep.h"

#include "bindings.h"
#include "keywords.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

py::list series_list(std::vector<TimeSeries> series) {
  py::list list;
  for (TimeSeries& each : series) list.append(to_python(std::move(each)));
  return list;
}

py::list normalisation_rows(const std::vector<recording::ChannelNormalisation>& channels) {
  py::list rows;
  for (const recording::ChannelNormalisation& n : channels) {
    py::dict d;
    d["channel"] = n.channel;
    d["rests"] = n.rests;
    d["resting_level_v"] = n.resting_level_v;
    d["reference_v"] = n.reference_v;
    d["reference_from"] = n.source_trial;
    d["reference_time_s"] = n.source_time_s;
    d["from_mvc"] = n.from_mvc;
    rows.append(d);
  }
  return rows;
}

py::dict emg(py::dict given) {
  Keywords k("emg", std::move(given));
  Work work(k);
  program::EmgOptions o;
  std::string out, envelope, measures;
  bool overwrite = false, no_notch = false, whitening = false, no_whitening = false;
  k.take("inputs", o.in);
  k.take("out", out);
  k.take("mvc", o.mvc);
  k.take("channel", o.channels);
  k.take("unit", o.unit);
  k.above_zero("highpass", o.chain.highpass_hz);
  k.above_zero("lowpass", o.chain.lowpass_hz);
  k.take("no_notch", no_notch);
  k.take("whitening", whitening);
  k.take("no_whitening", no_whitening);
  k.take("as_published", o.chain.as_published);
  k.take("remove_ecg", o.chain.remove_ecg);
  k.above_zero("window", o.window_s);
  k.take("envelope", envelope);
  k.take("measures", measures);
  k.above_zero("measure_window", o.measure_window_s);
  k.take("overwrite", overwrite);
  k.refuse_others();
  if (whitening && no_whitening) throw InvalidInput("whitening and no_whitening exclude each other");
  o.chain.notch = !no_notch;
  if (whitening || no_whitening) o.chain.whitening = whitening;
  o.keep_envelopes = true;
  o.call = work.call();
  program::EmgResult result = work.run([&] {
    const auto activations = program::emg_files(o.in, out, "out");
    const auto envelopes = program::emg_files(o.in, envelope, "envelope");
    program::check_emg_files(o, activations, envelopes, overwrite);
    if (!measures.empty()) program::check_emg_files(o, {measures}, {}, overwrite);
    program::EmgResult r = program::emg(o);
    if (!activations.empty() || !envelopes.empty()) program::write_emg(r, activations, envelopes);
    if (!measures.empty()) program::write_emg_measures(r, measures);
    return r;
  });
  py::dict d;
  d["activations"] = series_list(std::move(result.activations));
  d["envelopes"] = series_list(std::move(result.envelopes));
  d["normalisation"] = normalisation_rows(result.normalisation);
  d["whitened"] = result.whitening.applied;
  d["whitening_reason"] = result.whitening.reason;
  d["steps"] = result.chain.steps;
  d["methods"] = result.chain.methods;
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict ik(py::dict given) {
  Keywords k("ik", std::move(given));
  Work work(k);
  program::IkOptions o;
  std::string out;
  bool overwrite = false;
  k.take("model", o.model);
  k.take("markers", o.markers);
  k.take("out", out);
  k.word("up", o.up, {"x", "y", "z", "-x", "-y", "-z"});
  k.take("weight", o.weights);
  k.take("lock", o.lock);
  k.take("unlock", o.unlock);
  k.word("compat", o.compat, {"exact", "opensim"});
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::IkResult result = work.run([&] {
    if (!out.empty()) {
      check_output(out, {o.model, o.markers}, overwrite);
      check_companion(program::marker_errors_path(out), {o.model, o.markers}, overwrite, program::kMarkerErrorsBegin);
    }
    program::IkResult r = program::ik(o);
    if (!out.empty()) program::write_ik(r, out);
    return r;
  });
  py::dict d;
  d["angles"] = to_python(std::move(result.solved.q));
  d["marker_errors"] = to_python(std::move(result.solved.errors));
  d["marker_error_rms"] = result.misfit.rms_m;
  d["wrong_unit"] = result.misfit.wrong_unit;
  d["frames_not_converged"] = result.solved.frames_not_converged;
  d["frames_without_markers"] = result.solved.frames_without_markers;
  d["not_converged"] = result.not_converged;
  d["undetermined"] = result.solved.open_coordinates;
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict id(py::dict given) {
  Keywords k("id", std::move(given));
  Work work(k);
  program::IdOptions o;
  std::string out;
  bool overwrite = false;
  k.take("model", o.model);
  k.take("motion", o.motion);
  k.take("out", out);
  k.above_zero("lowpass", o.cutoff_hz);
  k.take("speeds", o.speeds);
  k.take("accelerations", o.accelerations);
  k.take("loads", o.loads);
  k.zero_or_more("held_mass", o.held_mass_kg);
  k.take("held_body", o.held_body);
  take_point(k, "held_at", o.held_at_m);
  k.word("compat", o.compat, {"exact", "opensim"});
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::IdResult result = work.run([&] {
    if (!out.empty()) check_output(out, {o.model, o.motion, o.speeds, o.accelerations, o.loads}, overwrite);
    program::IdResult r = program::id(o);
    if (!out.empty()) program::write_id(r, out);
    return r;
  });
  py::dict d;
  d["forces"] = to_python(std::move(result.forces));
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict paths(py::dict given) {
  Keywords k("paths", std::move(given));
  Work work(k);
  program::PathsOptions o;
  std::string out;
  bool overwrite = false;
  k.take("model", o.model);
  k.take("motion", o.motion);
  k.take("out", out);
  k.above_zero("lowpass", o.cutoff_hz);
  k.take("surrogate", o.surrogates);
  k.above_zero("surrogate_tolerance", o.tolerance_mm);
  k.take("check_jumps", o.check_jumps);
  k.word("compat", o.compat, {"exact", "opensim"});
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::PathsResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    if (!out.empty()) protect_files(out, program::kPathsFiles, {o.model, o.motion, o.surrogates});
    program::PathsResult r = program::paths(o);
    if (!out.empty()) program::write_paths(r, out);
    folder.finish();
    return r;
  });
  py::dict arms;
  for (auto& [coordinate, arm] : result.muscles.moment_arm) arms[py::str(coordinate)] = to_python(std::move(arm));
  py::dict d;
  d["length"] = to_python(std::move(result.muscles.length));
  d["velocity"] = to_python(std::move(result.muscles.velocity));
  d["moment_arm"] = arms;
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict sweep(py::dict given) {
  Keywords k("sweep", std::move(given));
  Work work(k);
  program::SweepOptions o;
  std::string out;
  bool overwrite = false;
  k.take("model", o.model);
  k.take("coordinate", o.coordinate);
  k.take("muscle", o.muscles);
  k.take("out", out);
  k.word("compat", o.compat, {"exact", "opensim"});
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::SweepResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    if (!out.empty()) protect_files(out, program::kSweepFiles, {o.model});
    program::SweepResult r = program::sweep(o);
    if (!out.empty()) (void)program::write_sweep(r, out);
    folder.finish();
    return r;
  });
  py::dict arm, length, full, passive;
  for (body::SweptMuscle& muscle : result.muscles) {
    const py::str name(muscle.name);
    arm[name] = to_array(std::move(muscle.path.arms_m));
    length[name] = to_array(std::move(muscle.path.lengths_m));
    full[name] = to_array(std::move(muscle.full_force_n));
    passive[name] = to_array(std::move(muscle.passive_force_n));
  }
  py::dict d;
  d["coordinate"] = result.coordinate;
  d["unit"] = result.is_angle ? "rad" : "m";
  d["values"] = to_array(std::move(result.muscles.front().path.values));
  d["moment_arm"] = arm;
  d["length"] = length;
  d["full_force"] = full;
  d["passive_force"] = passive;
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict so(py::dict given) {
  Keywords k("so", std::move(given));
  Work work(k);
  program::SoOptions o;
  std::string out;
  bool overwrite = false;
  k.take("model", o.model);
  k.take("motion", o.motion);
  k.take("out", out);
  k.take("objective", o.objective);
  k.take("exponent", o.exponent);
  k.take("emg", o.emg);
  k.take("emg_weight", o.emg_weight);
  k.take("reserve", o.reserve_nm);
  k.take("coordinate", o.coordinates);
  k.above_zero("lowpass", o.cutoff_hz);
  k.take("loads", o.loads);
  k.take("tendon", o.tendon);
  k.take("passive", o.passive);
  k.word("compat", o.compat, {"exact", "opensim"});
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::SoResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    if (!out.empty()) protect_files(out, program::kSoFiles, {o.model, o.motion, o.emg, o.loads});
    program::SoResult r = program::so(o);
    if (!out.empty()) program::write_so(r, out);
    folder.finish();
    return r;
  });
  body::MuscleForces& shared = result.shared;
  std::vector<std::string> status;
  for (const body::SharingStatus each : shared.status) status.emplace_back(body::name(each));
  py::dict d;
  d["force"] = to_python(std::move(shared.force));
  d["activation"] = to_python(std::move(shared.activation));
  d["reserve"] = to_python(std::move(shared.reserve));
  d["status"] = status;
  d["kkt_residual"] = to_array(std::move(shared.kkt_residual));
  d["frames_not_solved"] = shared.frames_not_solved;
  d["frames_with_reserve"] = shared.frames_with_reserve;
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict run_tool(py::dict given) {
  Keywords k("run_tool", std::move(given));
  Work work(k);
  program::RunToolOptions o;
  k.take("setup", o.setup);
  const auto take_path = [&](const char* name, std::filesystem::path& path) {
    std::string text;
    k.take(name, text);
    path = text;
  };
  take_path("model", o.files.model);
  take_path("motion", o.files.motion);
  take_path("external_loads", o.files.external_loads);
  take_path("out", o.files.out);
  k.take("anywhere", o.anywhere);
  k.word("compat", o.compat, {"opensim", "exact"});
  k.refuse_others();
  o.call = work.call();
  const program::RunToolResult result = work.run([&] { return program::run_tool(o); });
  std::vector<std::string> files;
  for (const auto& file : result.tool.files) files.push_back(file.string());
  py::dict d;
  d["tool"] = result.tool.tool;
  d["summary"] = result.tool.summary;
  d["files"] = files;
  d["frames"] = result.tool.frames;
  d["frames_failed"] = result.tool.frames_failed;
  d["good"] = result.good();
  d["notes"] = sentences(result.tool.remarks);
  d["remarks"] = to_python(result.remarks);
  return d;
}

}  // namespace

void bind_stages(py::module_& module) {
  module.def("emg", &emg);
  module.def("ik", &ik);
  module.def("id", &id);
  module.def("paths", &paths);
  module.def("sweep", &sweep);
  module.def("so", &so);
  module.def("run_tool", &run_tool);
}

}  // namespace myoid::python
