#pragma once

#include "myoid/study/setting.h"

namespace myoid::program {

/// Throws InvalidInput with the option's name for a number or a word of the visit that is not allowed.
void check_visited(const study::SettingVisitor::Inside& visit_all);

/// Throws InvalidInput with the option's name for a number or a word that its `visit` does not allow.
template <typename Options>
void check_options(Options options) {
  check_visited([&](study::SettingVisitor& v) { visit(options, v); });
}

}  // namespace myoid::program
