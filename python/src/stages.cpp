#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/commands/run_tool.h"
#include "myoid/program/steps/emg.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"
#include "myoid/program/steps/paths.h"
#include "myoid/program/steps/so.h"
#include "myoid/program/steps/sweep.h"

#include "bindings.h"
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
  Work work("emg", std::move(given));
  auto o = work.options<program::EmgOptions>();
  o.keep_envelopes = true;
  program::EmgResult result = work.run([&] {
    const program::EmgFiles files = program::emg_files(o);
    program::EmgResult r = program::emg(o);
    program::write_emg(r, files);
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
  Work work("ik", std::move(given));
  const auto o = work.options<program::IkOptions>();
  program::IkResult result = work.run([&] {
    if (!o.out.empty()) {
      check_output(o.out, {o.model, o.markers}, o.call.overwrite);
      check_companion(program::marker_errors_path(o.out), {o.model, o.markers}, o.call.overwrite,
                      program::kMarkerErrorsBegin);
    }
    program::IkResult r = program::ik(o);
    if (!o.out.empty()) program::write_ik(r, o.out);
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
  Work work("id", std::move(given));
  const auto o = work.options<program::IdOptions>();
  program::IdResult result = work.run([&] {
    if (!o.out.empty()) check_output(o.out, {o.model, o.motion, o.speeds, o.accelerations, o.loads}, o.call.overwrite);
    program::IdResult r = program::id(o);
    if (!o.out.empty()) program::write_id(r, o.out);
    return r;
  });
  py::dict d;
  d["forces"] = to_python(std::move(result.forces));
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict paths(py::dict given) {
  Work work("paths", std::move(given));
  const auto o = work.options<program::PathsOptions>();
  program::PathsResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    if (!o.out.empty()) protect_files(o.out, program::kPathsFiles, {o.model, o.motion, o.surrogates});
    program::PathsResult r = program::paths(o);
    if (!o.out.empty()) program::write_paths(r, o.out);
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
  Work work("sweep", std::move(given));
  const auto o = work.options<program::SweepOptions>();
  program::SweepResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    if (!o.out.empty()) protect_files(o.out, program::kSweepFiles, {o.model});
    program::SweepResult r = program::sweep(o);
    if (!o.out.empty()) (void)program::write_sweep(r, o.out);
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
  Work work("so", std::move(given));
  const auto o = work.options<program::SoOptions>();
  program::SoResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    if (!o.out.empty()) protect_files(o.out, program::kSoFiles, {o.model, o.motion, o.emg, o.loads});
    program::SoResult r = program::so(o);
    if (!o.out.empty()) program::write_so(r, o.out);
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
  Work work("run_tool", std::move(given));
  const auto o = work.options<program::RunToolOptions>();
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
