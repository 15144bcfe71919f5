#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/steps/muscle.h"
#include "myoid/program/steps/simulate.h"

#include "bindings.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

py::list estimate_rows(const program::MuscleFit& fit) {
  py::list rows;
  for (std::size_t i = 0; i < fit.all.estimates.size(); ++i) {
    const muscle::IsolatedEstimate& e = fit.all.estimates[i];
    py::dict d;
    d["parameter"] = e.parameter;
    d["unit"] = std::string(symbol(e.unit));
    d["start"] = e.start;
    d["estimate"] = e.value;
    d["std_error"] = e.std_error;
    d["at_bound"] = e.at_bound;
    d["told"] = e.told;
    d["scatter"] = e.scatter;
    d["ci_low"] = fit.judgments[i].low;
    d["ci_high"] = fit.judgments[i].high;
    d["verdict"] = std::string(fit::name(fit.judgments[i].verdict));
    d["reason"] = fit.judgments[i].reason;
    rows.append(d);
  }
  return rows;
}

py::list error_rows(const std::vector<program::RecordingErrors>& errors) {
  py::list rows;
  for (const program::RecordingErrors& error : errors) {
    py::dict d;
    d["recording"] = error.recording;
    d["starting_values"] = error.starting_values;
    d["fitted"] = error.fitted;
    d["predicted"] = error.predicted;
    rows.append(d);
  }
  return rows;
}

py::dict muscle_dict(program::MuscleResult result) {
  py::dict d;
  d["name"] = result.name;
  d["remarks"] = to_python(result.remarks);
  if (result.simulated) {
    muscle::IsolatedMuscleResult& simulated = result.simulated->simulated;
    d["series"] = to_python(std::move(simulated.series));
    d["finished"] = simulated.status == math::OdeStatus::done;
    d["message"] = simulated.message;
    if (const auto& comparison = result.simulated->comparison) {
      d["mean_absolute_error"] = comparison->error_n;
      d["relative_error"] = comparison->share;
    }
  }
  if (result.fit) {
    d["estimates"] = estimate_rows(*result.fit);
    d["errors"] = error_rows(result.fit->errors);
    d["finished"] = result.fit->converged;
    d["message"] = result.fit->all.message;
  }
  return d;
}

py::dict muscle_command(py::dict given) {
  Work work("muscle", std::move(given));
  const auto o = work.options<program::MuscleOptions>();
  return muscle_dict(work.run([&] {
    for (const std::string& path : {o.out, o.fitted})
      if (!path.empty()) check_output(path, o.inputs(), o.call.overwrite);
    program::MuscleResult r = program::muscle(o);
    if (!o.out.empty()) program::write_muscle(r, o.out);
    if (!o.fitted.empty()) program::write_fitted_muscle(r, o.fitted);
    return r;
  }));
}

py::dict sensitivity_dict(body::Sensitivities s) {
  py::dict d;
  d["parameters"] = s.parameters;
  d["time"] = to_array(std::move(s.time_s));
  for (body::Sensitivity& of : s.of) d[py::str(of.quantity)] = to_array(std::move(of.by_parameter));
  return d;
}

py::dict simulate(py::dict given) {
  Work work("simulate", std::move(given));
  const auto o = work.options<program::SimulateOptions>();
  program::SimulateResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    if (!o.out.empty()) protect_files(o.out, program::kSimulateFiles, {o.model, o.excitations});
    program::SimulateResult r = program::simulate(o);
    if (!o.out.empty()) program::write_simulate(r, o.out);
    folder.finish();
    return r;
  });
  py::dict d;
  d["finished"] = result.finished();
  body::Simulation& s = result.simulation;
  d["message"] = s.message;
  d["motion"] = to_python(std::move(s.motion));
  d["excitation"] = to_python(std::move(s.excitation));
  d["activation"] = to_python(std::move(s.activation));
  d["length"] = to_python(std::move(s.musculotendon_length));
  d["velocity"] = to_python(std::move(s.musculotendon_velocity));
  d["fiber_length"] = to_python(std::move(s.fiber_length));
  d["fiber_velocity"] = to_python(std::move(s.fiber_velocity));
  d["tendon_length"] = to_python(std::move(s.tendon_length));
  d["fiber_force"] = to_python(std::move(s.fiber_force));
  d["tendon_force"] = to_python(std::move(s.tendon_force));
  d["moment_arm"] = to_python(std::move(s.moment_arm));
  d["torque"] = to_python(std::move(s.torque));
  d["energy"] = o.energy ? to_python(std::move(s.energy)) : py::none();
  d["sensitivities"] =
      result.sensitivities ? py::object(sensitivity_dict(std::move(*result.sensitivities))) : py::object(py::none());
  d["remarks"] = to_python(result.remarks);
  return d;
}

}  // namespace

void bind_muscles(py::module_& module) {
  module.def("muscle", &muscle_command);
  module.def("simulate", &simulate);
}

}  // namespace myoid::python
