#include "keywords.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"

namespace myoid::python {
namespace {

/// A number as text that gives the same number when it is read.
std::string number_text(py::handle value) { return py::repr(py::float_(py::reinterpret_borrow<py::object>(value))); }

}  // namespace

std::optional<std::string> text_of(py::handle object) {
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (!py::hasattr(object, "__fspath__")) return std::nullopt;
  const py::object path = object.attr("__fspath__")();
  if (!py::isinstance<py::str>(path)) return std::nullopt;
  return path.cast<std::string>();
}

void Keywords::refuse_kind(const char* name, const char* expected, py::handle found) const {
  throw py::type_error(fmt::format("{}: {}: expected {}, found {}", function_, name, expected,
                                   py::type::of(found).attr("__name__").cast<std::string>()));
}

std::optional<py::object> Keywords::object(const char* name) {
  known_.insert(name);
  if (!given_.contains(name)) return std::nullopt;
  py::object value = given_[name];
  if (value.is_none()) return std::nullopt;
  return value;
}

void Keywords::refuse_others() const {
  for (const auto& [name, value] : given_) {
    if (!known_.contains(name.cast<std::string>()))
      throw py::type_error(fmt::format("{}: there is no argument '{}'; there are {}", function_,
                                       name.cast<std::string>(), fmt::join(known_, ", ")));
  }
}

void Keywords::take(const char* name, std::string& value) {
  const auto given = object(name);
  if (!given) return;
  const auto text = text_of(*given);
  if (!text) refuse_kind(name, "a text or a path", *given);
  value = *text;
}

void Keywords::take(const char* name, std::vector<std::string>& values) {
  const auto given = object(name);
  if (!given) return;
  values.clear();
  if (const auto text = text_of(*given)) {
    values.push_back(*text);
    return;
  }
  if (py::isinstance<py::dict>(*given)) {
    for (const auto& [key, value] : given->cast<py::dict>()) {
      const auto text = text_of(value);
      values.push_back(fmt::format("{}={}", py::str(key).cast<std::string>(), text ? *text : number_text(value)));
    }
    return;
  }
  if (!py::isinstance<py::iterable>(*given)) refuse_kind(name, "a text or a list of texts", *given);
  for (const py::handle item : given->cast<py::iterable>()) {
    const auto text = text_of(item);
    if (!text) refuse_kind(name, "texts", item);
    values.push_back(*text);
  }
}

void Keywords::take(const char* name, bool& value) {
  const auto given = object(name);
  if (!given) return;
  if (!py::isinstance<py::bool_>(*given)) refuse_kind(name, "True or False", *given);
  value = given->cast<bool>();
}

std::optional<double> Keywords::number(const char* name) {
  const auto given = object(name);
  if (!given) return std::nullopt;
  if (py::isinstance<py::bool_>(*given) || PyNumber_Check(given->ptr()) == 0 || py::isinstance<py::str>(*given))
    refuse_kind(name, "a number", *given);
  const double value = py::float_(*given).cast<double>();
  if (!std::isfinite(value)) throw InvalidInput(fmt::format("{}: found {}, expected a finite number", name, value));
  return value;
}

void Keywords::take(const char* name, double& value) {
  if (const auto given = number(name)) value = *given;
}

void Keywords::take(const char* name, std::optional<double>& value) {
  if (const auto given = number(name)) value = *given;
}

void Keywords::take(const char* name, std::vector<double>& values) {
  const auto given = object(name);
  if (!given) return;
  if (PyNumber_Check(given->ptr()) != 0 && !py::isinstance<py::iterable>(*given)) {
    values = {*number(name)};
    return;
  }
  if (py::isinstance<py::str>(*given) || !py::isinstance<py::iterable>(*given))
    refuse_kind(name, "a number or a list of numbers", *given);
  values.clear();
  for (const py::handle item : given->cast<py::iterable>()) {
    if (PyNumber_Check(item.ptr()) == 0) refuse_kind(name, "numbers", item);
    values.push_back(py::float_(py::reinterpret_borrow<py::object>(item)).cast<double>());
  }
}

void Keywords::take(const char* name, std::uint64_t& value) {
  if (const auto given = whole(name, 0, std::numeric_limits<long>::max())) value = static_cast<std::uint64_t>(*given);
}

void Keywords::above_zero(const char* name, double& value) {
  const auto given = number(name);
  if (given && *given <= 0.0) throw InvalidInput(fmt::format("{}: found {}, expected a number above 0", name, *given));
  if (given) value = *given;
}

void Keywords::zero_or_more(const char* name, double& value) {
  const auto given = number(name);
  if (given && *given < 0.0)
    throw InvalidInput(fmt::format("{}: found {}, expected a number of 0 or more", name, *given));
  if (given) value = *given;
}

void Keywords::within(const char* name, double& value, double lower, double upper) {
  const auto given = number(name);
  if (given && !(*given >= lower && *given <= upper))
    throw InvalidInput(fmt::format("{}: found {}, expected {} to {}", name, *given, lower, upper));
  if (given) value = *given;
}

std::optional<long> Keywords::whole(const char* name, long lower, long upper) {
  const auto given = object(name);
  if (!given) return std::nullopt;
  if (py::isinstance<py::bool_>(*given) || PyIndex_Check(given->ptr()) == 0)
    refuse_kind(name, "a whole number", *given);
  int overflow = 0;
  const long value = PyLong_AsLongAndOverflow(py::int_(*given).ptr(), &overflow);
  if (overflow != 0 || value < lower || value > upper)
    throw InvalidInput(
        fmt::format("{}: found {}, expected {} to {}", name, py::str(*given).cast<std::string>(), lower, upper));
  return value;
}

void Keywords::word(const char* name, std::string& value, std::initializer_list<std::string_view> words) {
  const auto given = object(name);
  if (!given) return;
  take(name, value);
  for (const std::string_view word : words)
    if (value == word) return;
  refuse_word(name, value, {words.begin(), words.size()});
}

void Keywords::refuse_word(const char* name, const std::string& word, ChoiceNames words) const {
  throw InvalidInput(fmt::format("{}: found '{}', expected {}", name, word, fmt::join(words, ", ")));
}

}  // namespace myoid::python
