#pragma once

#include <pybind11/pybind11.h>

namespace myoid::python {

/// Each adds its functions to the module. A command is a function of a dict of arguments, with the
/// names of the command line, that returns a dict with the fields of the result's class.
void bind_errors();
void bind_recordings(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_stages(pybind11::module_& module);
void bind_muscles(pybind11::module_& module);
void bind_studies(pybind11::module_& module);
void bind_twins(pybind11::module_& module);
void bind_cohorts(pybind11::module_& module);

}  // namespace myoid::python
