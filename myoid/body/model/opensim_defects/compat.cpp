#include "myoid/body/model/opensim_defects/compat.h"

namespace myoid::body {

std::string_view name_of(const Compat& compat) { return compat == Compat{} ? "exact" : "opensim"; }

}  // namespace myoid::body
