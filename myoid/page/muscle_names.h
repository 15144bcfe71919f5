#pragma once

#include <string>
#include <string_view>

namespace myoid::page {

/// Returns a muscle's name for people: "Biceps" of BIC, "Biceps femoris long head (right)" of bifemlh_r, "Gluteus
/// medius, part 2" of glmed2. A name that the table does not know stays as it is. For display only: files hold the
/// user's names.
[[nodiscard]] std::string plain_muscle(std::string_view name);

/// Returns the plain name with the user's own behind it, where they differ: "Biceps (BIC)".
[[nodiscard]] std::string plain_muscle_and_name(std::string_view name);

}  // namespace myoid::page
