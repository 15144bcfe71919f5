#pragma once

#include <string_view>

namespace myoid::page {

/// Returns the meaning of a number for people, one sentence, by its name in the files ("length_activation"). Endings of
/// a joint's numbers do not matter. Empty for a name that the table does not know.
[[nodiscard]] std::string_view parameter_meaning(std::string_view parameter);

}  // namespace myoid::page
