#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "myoid/ground/core/choice.h"

namespace myoid::python {

namespace py = pybind11;

/// The keyword arguments of one call. `take` sets a field of an options struct where the user gave
/// the argument; None counts as not given. The functions throw TypeError for a value of another
/// kind, and InvalidInput for a number or word that the command line would refuse too.
class Keywords {
 public:
  Keywords(std::string function, py::dict given) : function_(std::move(function)), given_(std::move(given)) {}

  [[nodiscard]] const std::string& function() const { return function_; }

  /// A text, or a path.
  void take(const char* name, std::string& value);
  /// A text or several; of a mapping "KEY=VALUE" for each entry.
  void take(const char* name, std::vector<std::string>& values);
  void take(const char* name, bool& value);
  void take(const char* name, double& value);
  void take(const char* name, std::optional<double>& value);
  void take(const char* name, std::vector<double>& values);
  void take(const char* name, std::uint64_t& value);

  void above_zero(const char* name, double& value);
  void zero_or_more(const char* name, double& value);
  void within(const char* name, double& value, double lower, double upper);
  template <typename Integer>
  void count(const char* name, Integer& value, long lower, long upper) {
    if (const auto given = whole(name, lower, upper)) value = static_cast<Integer>(*given);
  }
  /// Names of enumerators: one or several.
  template <typename Enumeration>
  void choices(const char* name, std::vector<Enumeration>& values) {
    std::vector<std::string> words;
    take(name, words);
    for (const std::string& word : words) {
      const std::optional<Enumeration> value = choice_named<Enumeration>(word);
      if (!value) refuse_word(name, word, choice_names(Enumeration{}));
      values.push_back(*value);
    }
  }
  /// One of the words.
  void word(const char* name, std::string& value, std::initializer_list<std::string_view> words);

  /// The value; empty if it was not given.
  [[nodiscard]] std::optional<py::object> object(const char* name);
  /// Throws TypeError if an argument was given that no `take` asked for.
  void refuse_others() const;

 private:
  [[nodiscard]] std::optional<double> number(const char* name);
  [[nodiscard]] std::optional<long> whole(const char* name, long lower, long upper);
  [[noreturn]] void refuse_word(const char* name, const std::string& word, ChoiceNames words) const;
  [[noreturn]] void refuse_kind(const char* name, const char* expected, py::handle found) const;

  std::string function_;
  py::dict given_;
  std::set<std::string> known_;
};

/// Returns the text of a str or of a path (`os.PathLike`); empty for another object.
[[nodiscard]] std::optional<std::string> text_of(py::handle object);

}  // namespace myoid::python
