#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/program/commands/info.h"
#include "myoid/program/steps/convert.h"
#include "myoid/program/steps/convert_parts.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/tables/result_units.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_writer.h"
#include "myoid/results/mat/results_mat.h"

#include "bindings.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

using ground::AnalogChannels;
using recording::ForcePlate;
using recording::Recording;

/// Runs an action without Python's lock.
template <typename Action>
auto alone(Action action) {
  const py::gil_scoped_release others_may_run;
  return action();
}

py::dict plate_dict(ForcePlate plate) {
  py::dict d;
  d["number"] = plate.number;
  d["type"] = plate.type;
  d["time"] = to_array(std::move(plate.time_s));
  d["force"] = to_array(std::move(plate.force_n));
  d["moment"] = to_array(std::move(plate.moment_nm));
  d["pressure_center"] = to_array(std::move(plate.pressure_center_m));
  d["free_moment"] = to_array(std::move(plate.free_moment_nm));
  d["corners"] = to_array(Eigen::MatrixXd(plate.corners_m.transpose()));
  return d;
}

py::list event_list(const Recording& recording) {
  py::list list;
  for (const Event& event : recording.events) {
    py::dict d;
    d["time"] = event.time_s;
    d["label"] = event.label;
    d["context"] = event.context;
    d["subject"] = event.subject;
    list.append(d);
  }
  return list;
}

std::vector<std::pair<std::string, std::string>> channel_units(const AnalogChannels& channels) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Channel& channel : channels.channels()) list.emplace_back(channel.name, std::string(symbol(channel.unit)));
  return list;
}

const AnalogChannels& clock_of(const Recording& recording, std::size_t clock) {
  const auto clocks = recording.clocks();
  if (clock >= clocks.size()) throw py::index_error("no such clock");
  return *clocks[clock];
}

/// The channels of one clock as numbers; the file's own counts until they are asked for.
TimeSeries series_of(const Recording& recording, std::size_t clock) {
  const AnalogChannels& channels = clock_of(recording, clock);
  return alone([&] { return channels.series(); });
}

using Numbers = py::array_t<double, py::array::f_style | py::array::forcecast>;

Eigen::MatrixXd matrix_of(const Numbers& values) {
  if (values.ndim() != 2) throw py::value_error("expected an array of two dimensions");
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), values.shape(0), values.shape(1));
}

Eigen::VectorXd vector_of(const Numbers& values) {
  if (values.ndim() != 1) throw py::value_error("expected an array of one dimension");
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

/// Writes arrays as a storage file or a table, by the ending of the name, so that a command reads them as it reads
/// other files. `units`: units of the numbers; an empty word is none.
void write_series(const std::string& path,
                  const Numbers& time_s,
                  const Numbers& values,
                  const std::vector<std::string>& names,
                  const std::vector<std::string>& units) {
  Eigen::MatrixXd si = matrix_of(values);
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto unit = units.at(i).empty() ? ScaledUnit{} : parse_unit(units[i]);
    if (!unit) throw InvalidInput("{}: '{}' is no unit that is known", names[i], units[i]);
    const auto column = static_cast<Eigen::Index>(i);
    if (unit->to_si != 1.0 && column < si.cols()) si.col(column) *= unit->to_si;
    channels.push_back({names[i], unit->unit});
  }
  const TimeSeries series(vector_of(time_s), std::move(channels), std::move(si));
  alone([&] { recording::write_series(path, series, "Array"); });
}

/// Writes positions, frames x (3 markers) [m], as a .trc file, with the names that `convert` gives.
void write_markers(const std::string& path,
                   const Numbers& time_s,
                   const Numbers& positions_m,
                   std::vector<std::string> names) {
  MarkerSeries markers{.time_s = vector_of(time_s), .names = std::move(names), .positions_m = matrix_of(positions_m)};
  std::vector<Repair> repairs;
  program::without_blanks(markers, repairs);
  if (markers.positions_m.rows() != markers.frame_count() || markers.positions_m.cols() != 3 * markers.marker_count())
    throw InvalidInput("found {} x {} numbers, expected {} frames of {} markers with x, y, z",
                       markers.positions_m.rows(), markers.positions_m.cols(), markers.frame_count(),
                       markers.marker_count());
  alone([&] { recording::write_trc(path, markers); });
}

/// A JSON document as Python's own objects.
py::object from_json(const nlohmann::ordered_json& json) {
  return py::module_::import("json").attr("loads")(json.dump());
}

py::object info(py::dict given) {
  Work work("info", std::move(given));
  const auto o = work.options<program::InfoOptions>();
  return from_json(work.run([&] { return program::info(o); }));
}

py::object convert(py::dict given) {
  Work work("convert", std::move(given));
  const auto o = work.options<program::ConvertOptions>();
  if (std::filesystem::path(o.out).extension() != ".mat")
    return py::cast(work.run([&] { return program::convert(o); }).files);
  (void)work.run([&] {
    results::check_mat_file(o.out);
    check_output(o.out, {o.in}, o.call.overwrite);
    program::Remarks remarks(o.call);
    program::warn_of_repairs(o.in, results::write_results_mat(o.in, o.out), remarks);
    return true;
  });
  return py::cast(std::vector<std::string>{o.out});
}

}  // namespace

void bind_recordings(py::module_& module) {
  py::class_<Recording, std::shared_ptr<Recording>>(module, "Recording")
      .def("markers",
           [](const std::shared_ptr<Recording>& r) { return to_python(std::shared_ptr<MarkerSeries>(r, &r->markers)); })
      .def("clock_count", [](const Recording& r) { return r.clocks().size(); })
      .def("channels", [](const Recording& r, std::size_t clock) { return channel_units(clock_of(r, clock)); })
      .def("series", [](const Recording& r, std::size_t clock) { return to_python(series_of(r, clock)); })
      .def("emg",
           [](const Recording& r) {
             const auto names = recording::emg_channels(r.analog.channels(), r.plates);
             return to_python(alone([&] { return r.analog.select(names); }));
           })
      .def("plates",
           [](const Recording& r) {
             py::list list;
             for (ForcePlate& plate : alone([&] { return r.force_plates(); }))
               list.append(plate_dict(std::move(plate)));
             return list;
           })
      .def("events", &event_list)
      .def("notes", [](const Recording& r) { return to_texts(r.repairs); });
  module.def("read", [](const std::string& path) {
    return alone([&] { return std::make_shared<Recording>(recording::read_recording(path)); });
  });
  module.def("read_series", [](const std::string& path) {
    if (format_of(path) != FileFormat::storage) {
      recording::SeriesFile file = alone([&] { return recording::read_series(path); });
      return py::make_tuple(to_python(std::move(file.data)), to_texts(file.repairs));
    }
    recording::Storage file = alone([&] { return recording::read_storage(path); });
    const std::vector<Channel> channels = file.data.channels();
    std::vector<bool> degrees;
    for (const Channel& channel : channels) degrees.push_back(recording::is_angle_in_degrees(file, channel.name));
    py::list repairs = py::cast(to_texts(file.repairs));
    py::object series = to_python(std::move(file.data));
    py::list units = series.attr("units");
    for (std::size_t i = 0; i < degrees.size(); ++i)
      if (degrees[i]) units[i] = "deg";
    return py::make_tuple(series, repairs);
  });
  module.def("read_result", [](const std::string& path) {
    recording::Storage file = alone([&] { return recording::read_storage(path); });
    py::list units;
    for (const Channel& channel : file.data.channels())
      units.append(recording::result_unit(std::filesystem::path(path).stem().string(), channel.name, file.in_degrees));
    py::object series = to_python(std::move(file.data));
    series.attr("units") = units;
    return series;
  });
  module.def("laboratory_up", [](const std::string& path) {
    const recording::LaboratoryUp up = alone([&] { return recording::read_laboratory_up(path); });
    return up.up_L ? recording::axis_name(*up.up_L) : std::string();
  });
  module.def("write_series", &write_series);
  module.def("write_markers", &write_markers);
  module.def("info", &info);
  module.def("convert", &convert);
}

}  // namespace myoid::python
