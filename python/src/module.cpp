#include <filesystem>
#include <system_error>

#include <pybind11/pybind11.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"

#include "bindings.h"
#include "work.h"

namespace myoid::python {
namespace {

py::object error_class(const char* name) { return py::module_::import("myoid.errors").attr(name); }

void raise(const char* name, const char* message) { PyErr_SetString(error_class(name).ptr(), message); }

}  // namespace

void bind_errors() {
  py::register_exception_translator([](std::exception_ptr failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const ReadError& error) {
      std::error_code ignored;
      const bool is_there = std::filesystem::exists(error.path(), ignored);
      const py::object type = error_class(is_there ? "ReadError" : "MissingFileError");
      PyErr_SetObject(type.ptr(), type(error.what(), error.path().string(), error.line()).ptr());
    } catch (const ModelError& error) {
      raise("ModelError", error.what());
    } catch (const InvalidInput& error) {
      raise("InvalidInput", error.what());
    } catch (const InternalError& error) {
      raise("InternalError", error.what());
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
}

}  // namespace myoid::python

PYBIND11_MODULE(_native, module) {
  module.doc() = "The library behind the module myoid.";
  module.attr("__version__") = std::string(myoid::version());
  myoid::python::bind_errors();
  myoid::python::bind_recordings(module);
  myoid::python::bind_model(module);
  myoid::python::bind_stages(module);
  myoid::python::bind_muscles(module);
  myoid::python::bind_studies(module);
  myoid::python::bind_twins(module);
  myoid::python::bind_cohorts(module);
}
