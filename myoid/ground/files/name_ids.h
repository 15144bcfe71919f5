#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Ids of things that users name: trials, muscles, persons, joints. A name is any text that can be seen; an id is made
/// from it, for the names of files and folders, the anchors of pages, and fields of other programs.
namespace myoid::inline ground {

/// The place that an id is for, which decides about its characters.
enum class IdFor {
  file,     ///< Letters, digits, '_', '-', '.'; at most 60, the first a letter, a digit or '_'. No name of a device of
            ///< Windows, no '.' at the end.
  label,    ///< Letters and digits, as BIDS has them; at most 60.
  variable  ///< Letters, digits, '_', the first a letter; at most 63, as fields of MATLAB have them.
};

/// Returns an id for each name. Names alone decide about the ids, not their order. No two ids are equal or differ in
/// capitals only, and none is one of `reserved` in whatever capitals. A name that is an id already is kept. In other
/// names runs of other characters become one '_' ("slow 2 kg": "slow_2_kg"; no character in a label). Where this leaves
/// nothing, is too long, reserved, or the id of another name, the id ends in the beginning of the name's SHA-256.
[[nodiscard]] std::vector<std::string> ids_of(const std::vector<std::string>& names,
                                              IdFor place = IdFor::file,
                                              const std::vector<std::string_view>& reserved = {});

/// The ids of names that are unique, by the name.
class NameIds {
 public:
  NameIds() = default;
  explicit NameIds(const std::vector<std::string>& names,
                   IdFor place = IdFor::file,
                   const std::vector<std::string_view>& reserved = {});
  /// Returns the id of one of the names; of another text its id alone.
  [[nodiscard]] std::string of(const std::string& name) const;

 private:
  IdFor place_ = IdFor::file;
  std::map<std::string, std::string> ids_;
};

/// Returns why a text cannot be a name: "found nothing", "found the control character U+0007"; empty if it can be one.
[[nodiscard]] std::string name_refusal(std::string_view text);

/// Returns why a text cannot be shown as it is: a control character or bytes that are no UTF-8; empty if it can.
[[nodiscard]] std::string text_refusal(std::string_view text);

}  // namespace myoid::inline ground
