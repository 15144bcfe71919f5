#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "myoid/study/setting.h"

namespace myoid::python {

namespace py = pybind11;

/// The keyword arguments of one call. `take` sets a field of an options struct where the user gave
/// the argument; None counts as not given. The functions throw TypeError for a value of another kind.
class Keywords {
 public:
  Keywords(std::string function, py::dict given) : function_(std::move(function)), given_(std::move(given)) {}

  /// A text, or a path.
  void take(const char* name, std::string& value);
  /// A text or several; of a mapping "KEY=VALUE" for each entry.
  void take(const char* name, std::vector<std::string>& values);
  void take(const char* name, bool& value);
  void take(const char* name, double& value);
  void take(const char* name, std::optional<double>& value);
  void take(const char* name, std::vector<double>& values);
  void take(const char* name, std::uint64_t& value);
  /// A whole number.
  void take(const char* name, long& value);

  /// Returns true if the value is neither missing nor None, False or empty.
  [[nodiscard]] bool holds(const char* name) const;
  /// The value; empty if it was not given.
  [[nodiscard]] std::optional<py::object> object(const char* name);
  /// Throws TypeError if an argument was given that no `take` asked for.
  void refuse_others() const;

 private:
  [[nodiscard]] std::optional<double> number(const char* name);
  [[noreturn]] void refuse_kind(const char* name, const char* expected, py::handle found) const;

  std::string function_;
  py::dict given_;
  std::set<std::string> known_;
};

/// Sets the options of a command from the keyword arguments of their names, with '_' for '-'. Throws InvalidInput for
/// a number or word that the command line refuses too.
class KeywordReader : public study::FlatSettingVisitor {
 public:
  explicit KeywordReader(Keywords& keywords) : keywords_(&keywords) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& set) override;

 private:
  Keywords* keywords_;
};

/// Returns the text of a str or of a path (`os.PathLike`); empty for another object.
[[nodiscard]] std::optional<std::string> text_of(py::handle object);

}  // namespace myoid::python
