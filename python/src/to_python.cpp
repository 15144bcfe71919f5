#include "to_python.h"

#include <memory>
#include <utility>

#include "myoid/recording/recording.h"

namespace myoid::python {
namespace {

constexpr py::ssize_t kDouble = sizeof(double);

/// Keeps a value alive as long as an array shows it.
template <typename Value>
py::capsule keeper(std::shared_ptr<Value> value) {
  return py::capsule(new std::shared_ptr<Value>(std::move(value)),
                     [](void* kept) { delete static_cast<std::shared_ptr<Value>*>(kept); });
}

py::array_t<double> columns(const double* data, Eigen::Index rows, Eigen::Index cols, const py::capsule& owner) {
  return py::array_t<double>({rows, cols}, {kDouble, kDouble * rows}, data, owner);
}

py::object attribute(const char* module, const char* name) { return py::module_::import(module).attr(name); }

}  // namespace

py::array_t<double> to_array(Eigen::VectorXd values) {
  const auto kept = std::make_shared<Eigen::VectorXd>(std::move(values));
  return py::array_t<double>({kept->size()}, {kDouble}, kept->data(), keeper(kept));
}

py::array_t<double> to_array(Eigen::MatrixXd values) {
  const auto kept = std::make_shared<Eigen::MatrixXd>(std::move(values));
  return columns(kept->data(), kept->rows(), kept->cols(), keeper(kept));
}

py::object to_python(TimeSeries series) {
  const auto kept = std::make_shared<TimeSeries>(std::move(series));
  const py::capsule owner = keeper(kept);
  std::vector<std::string> names, units;
  for (const Channel& channel : kept->channels()) {
    names.push_back(channel.name);
    units.emplace_back(symbol(channel.unit));
  }
  return attribute("myoid.series", "TimeSeries")(
      py::array_t<double>({kept->time_s().size()}, {kDouble}, kept->time_s().data(), owner),
      columns(kept->values().data(), kept->values().rows(), kept->values().cols(), owner), names, units);
}

py::object to_python(std::shared_ptr<MarkerSeries> kept) {
  const py::capsule owner = keeper(kept);
  const py::ssize_t frames = kept->frame_count();
  return attribute("myoid.series", "Markers")(
      py::array_t<double>({frames}, {kDouble}, kept->time_s.data(), owner),
      py::array_t<double>({frames, static_cast<py::ssize_t>(kept->marker_count()), py::ssize_t{3}},
                          {kDouble, 3 * frames * kDouble, frames * kDouble}, kept->positions_m.data(), owner),
      kept->names);
}

py::object to_python(const Remark& remark) {
  py::dict d;
  d["severity"] = std::string(name(remark.severity));
  d["code"] = std::string(name(remark.code));
  d["text"] = sentence(remark);
  d["where"] = remark.where;
  d["about"] = remark.about;
  d["begin"] = remark.when ? py::cast(remark.when->begin_s) : py::none();
  d["end"] = remark.when ? py::cast(remark.when->end_s) : py::none();
  d["value"] = remark.value ? py::cast(*remark.value) : py::none();
  return attribute("myoid.remarks", "Remark")(**d);
}

py::list to_python(const std::vector<Remark>& remarks) {
  py::list list;
  for (const Remark& remark : remarks) list.append(to_python(remark));
  return list;
}

std::vector<std::string> to_texts(const std::vector<Repair>& repairs) {
  std::vector<std::string> texts;
  for (const Repair& repair : repairs) texts.push_back(recording::to_string(repair));
  return texts;
}

}  // namespace myoid::python
