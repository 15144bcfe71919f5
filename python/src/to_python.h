#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::python {

namespace py = pybind11;

/// Arrays own the numbers that they show: the matrix moves into them, and nothing is copied.
[[nodiscard]] py::array_t<double> to_array(Eigen::VectorXd values);
[[nodiscard]] py::array_t<double> to_array(Eigen::MatrixXd values);

/// A `myoid.TimeSeries`.
[[nodiscard]] py::object to_python(TimeSeries series);
/// A `myoid.Markers` that shows this memory: positions are frames x markers x 3 [m].
[[nodiscard]] py::object to_python(std::shared_ptr<MarkerSeries> markers);
/// A `myoid.Remark`.
[[nodiscard]] py::object to_python(const Remark& remark);
[[nodiscard]] py::list to_python(const std::vector<Remark>& remarks);
[[nodiscard]] std::vector<std::string> to_texts(const std::vector<Repair>& repairs);

}  // namespace myoid::python
