#include "keywords.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

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

bool Keywords::holds(const char* name) const {
  return given_.contains(name) && PyObject_IsTrue(given_[name].ptr()) == 1;
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
  long number = static_cast<long>(value);
  take(name, number);
  if (number < 0) throw InvalidInput(fmt::format("{}: found {}, expected 0 or more", name, number));
  value = static_cast<std::uint64_t>(number);
}

void Keywords::take(const char* name, long& value) {
  const auto given = object(name);
  if (!given) return;
  if (py::isinstance<py::bool_>(*given) || PyIndex_Check(given->ptr()) == 0)
    refuse_kind(name, "a whole number", *given);
  int overflow = 0;
  value = PyLong_AsLongAndOverflow(py::int_(*given).ptr(), &overflow);
  if (overflow != 0)
    throw InvalidInput(
        fmt::format("{}: found {}, expected a number that fits 64 bits", name, py::str(*given).cast<std::string>()));
}

namespace {

/// Returns the argument of an option: `held_at` of --held-at.
std::string keyword_of(const study::Setting& setting) {
  std::string name(setting.about.option.keyword.empty() ? setting.key : setting.about.option.keyword);
  std::ranges::replace(name, '-', '_');
  return name;
}

template <typename Value>
study::SettingValue taken(Keywords& keywords, const char* name) {
  Value value{};
  keywords.take(name, value);
  return value;
}

study::SettingValue value_of(const study::Setting& setting, Keywords& keywords, const char* name) {
  using study::SettingKind;
  const bool is_number = setting.about.option.or_number && PyNumber_Check(keywords.object(name)->ptr()) != 0;
  const std::string numeral = is_number ? number_text(*keywords.object(name)) : "";
  long whole = 0;
  switch (setting.kind) {
    case SettingKind::flag:
      return taken<bool>(keywords, name);
    case SettingKind::number:
      return taken<double>(keywords, name);
    case SettingKind::count:
      keywords.take(name, whole);
      return static_cast<double>(whole);
    case SettingKind::numbers:
      return taken<std::vector<double>>(keywords, name);
    case SettingKind::texts:
    case SettingKind::paths:
      return is_number ? std::vector{numeral} : taken<std::vector<std::string>>(keywords, name);
    default:
      return is_number ? numeral : taken<std::string>(keywords, name);
  }
}

}  // namespace

bool KeywordReader::met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& set) {
  const std::string name = keyword_of(setting);
  if (!keywords_->object(name.c_str())) return false;
  study::SettingValue given = value_of(setting, *keywords_, name.c_str());
  if (given == study::SettingValue(false)) return false;
  for (const std::string_view other : split(setting.about.option.excludes, ','))
    if (keywords_->holds(name.c_str()) && keywords_->holds(std::string(other).c_str()))
      throw InvalidInput(fmt::format("{} and {} exclude each other", name, other));
  const auto check = [&](const auto& value) {
    const std::string reason = study::refusal(setting, value);
    if (!reason.empty()) throw InvalidInput(fmt::format("{}: {}", name, reason));
  };
  if (const auto* number = std::get_if<double>(&given)) check(*number);
  if (const auto* word = std::get_if<std::string>(&given)) check(*word);
  if (const auto* words = std::get_if<std::vector<std::string>>(&given)) std::ranges::for_each(*words, check);
  set(std::move(given));
  return true;
}

}  // namespace myoid::python
