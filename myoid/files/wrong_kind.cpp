#include "myoid/files/wrong_kind.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/files/text_file.h"

namespace myoid::recording {

std::string wrong_kind(const std::filesystem::path& path,
                       std::initializer_list<std::string_view> endings,
                       std::string_view wanted) {
  constexpr std::pair<std::string_view, std::string_view> kKinds[] = {
      {".trc", "markers"},     {".c3d", "a recording"},     {".osim", "a model"},
      {".mot", "a motion"},    {".sto", "a time series"},   {".csv", "a table"},
      {".toml", "a study"},    {".xml", "a set-up"},        {".edf", "a recording"},
      {".bdf", "a recording"}, {".anc", "analog channels"},
  };
  const std::string ending = path.extension().string();
  const auto is = [&](std::string_view other) { return equal_ignoring_case(ending, other); };
  if (std::any_of(endings.begin(), endings.end(), is)) return {};
  for (const auto& [known, what] : kKinds) {
    if (is(known))
      return fmt::format(
          "this is a {} file ({}), but {} is expected here: were two options mixed up?", known,
          what, wanted);
  }
  return {};
}

}  // namespace myoid::recording
