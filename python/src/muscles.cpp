#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/commands/muscle.h"
#include "myoid/program/commands/simulate.h"

#include "bindings.h"
#include "keywords.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

py::list estimate_rows(const muscle::IsolatedFit& fit) {
  py::list rows;
  for (const muscle::IsolatedEstimate& e : fit.estimates) {
    py::dict d;
    d["parameter"] = e.parameter;
    d["unit"] = std::string(symbol(e.unit));
    d["start"] = e.start;
    d["estimate"] = e.value;
    d["std_error"] = e.std_error;
    d["at_bound"] = e.at_bound;
    d["told"] = e.told;
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

program::MuscleOptions muscle_options(Keywords& k) {
  program::MuscleOptions o;
  k.take("muscle", o.muscle);
  k.take("length", o.lengths);
  k.take("column", o.column);
  k.take("scale", o.scales);
  k.take("offset", o.offset_m);
  const auto number_or_file = [&](const char* name, std::string& value) {
    const auto given = k.object(name);
    if (given && PyNumber_Check(given->ptr()) != 0) {
      value = py::str(py::float_(*given));
    } else {
      k.take(name, value);
    }
  };
  const auto numbers_or_files = [&](const char* name, std::vector<std::string>& values) {
    const auto given = k.object(name);
    if (given && PyNumber_Check(given->ptr()) != 0) {
      values = {py::str(py::float_(*given))};
    } else {
      k.take(name, values);
    }
  };
  numbers_or_files("activation", o.activation);
  numbers_or_files("excitation", o.excitation);
  k.take("drive_column", o.drive_column);
  number_or_file("initial_activation", o.initial_activation);
  k.take("measured", o.measured);
  k.take("measured_column", o.measured_column);
  k.take("fit", o.fit);
  k.take("isometric_force", o.isometric_n);
  k.within("tolerance", o.tolerance, 1e-13, 1e-3);
  return o;
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
    d["estimates"] = estimate_rows(result.fit->all);
    d["errors"] = error_rows(result.fit->errors);
    d["finished"] = result.fit->converged;
    d["message"] = result.fit->all.message;
  }
  return d;
}

py::dict muscle_command(py::dict given) {
  Keywords k("muscle", std::move(given));
  Work work(k);
  program::MuscleOptions o = muscle_options(k);
  std::string out;
  bool overwrite = false;
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  return muscle_dict(work.run([&] {
    if (!out.empty()) {
      std::vector<std::string> inputs{o.muscle};
      for (const auto* files : {&o.lengths, &o.activation, &o.excitation, &o.measured})
        inputs.insert(inputs.end(), files->begin(), files->end());
      check_output(out, inputs, overwrite);
    }
    program::MuscleResult r = program::muscle(o);
    if (!out.empty()) program::write_muscle(r, out);
    return r;
  }));
}

program::SimulateOptions simulate_options(Keywords& k) {
  program::SimulateOptions o;
  k.take("model", o.model);
  k.take("excitations", o.excitations);
  k.take("excite", o.excite);
  k.take("rest", o.rest);
  k.take("tendon", o.tendon);
  k.take("curves", o.curves);
  k.take("activation", o.activation);
  k.take("initial", o.initial);
  k.take("initial_speed", o.initial_speed);
  k.take("lock", o.lock);
  k.take("horizontal", o.horizontal);
  k.take("held_mass", o.held_mass_kg);
  k.take("held_body", o.held_body);
  take_point(k, "held_at", o.held_at_m);
  k.take("rate", o.rate_hz);
  k.take("tolerance", o.tolerance);
  k.take("energy", o.energy);
  k.take("sensitivity", o.sensitivity);
  k.take("figures", o.figures);
  return o;
}

py::dict sensitivity_dict(body::Sensitivities s) {
  py::dict d;
  d["parameters"] = s.parameters;
  d["time"] = to_array(std::move(s.time_s));
  for (body::Sensitivity& of : s.of) d[py::str(of.quantity)] = to_array(std::move(of.by_parameter));
  return d;
}

py::dict simulate(py::dict given) {
  Keywords k("simulate", std::move(given));
  Work work(k);
  program::SimulateOptions o = simulate_options(k);
  std::string out;
  bool overwrite = false;
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  program::SimulateResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    if (!out.empty()) protect_files(out, program::kSimulateFiles, {o.model, o.excitations});
    program::SimulateResult r = program::simulate(o);
    if (!out.empty()) program::write_simulate(r, out);
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
