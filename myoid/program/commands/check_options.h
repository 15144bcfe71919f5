#pragma once

#include "myoid/study/setting.h"

namespace myoid::program {

/// Throws InvalidInput for a number or a word that an option does not allow.
class OptionCheck : public study::FlatSettingVisitor {
 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& set) override;
};

/// Throws InvalidInput with the option's name for a number or a word that its `visit` does not allow.
template <typename Options>
void check_options(Options options) {
  OptionCheck check;
  visit(options, check);
}

}  // namespace myoid::program
