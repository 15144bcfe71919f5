#pragma once

#include <string>
#include <vector>

#include "myoid/study/setting.h"
#include "myoid/study/setting_rows.h"
#include "myoid/virtual_person/protocol.h"

namespace myoid::twin {

/// The keys of [truth] in the order of the reference: of the person, then those in which a world is
/// other than the identification believes.
void visit(TruthSpec& truth, SettingVisitor& v);

/// The keys of the second kind only.
void visit_world(TruthSpec& truth, SettingVisitor& v);

/// The reference of [truth].
[[nodiscard]] SettingTable truth_reference();

/// A number of the world that is not the level's default.
struct WorldSetting {
  std::string key;
  std::string unit;   ///< "1" where there is none.
  std::string value;  ///< "0.15", "0.08 to 0.08", "millard"
};
[[nodiscard]] std::vector<WorldSetting> stated_world(const Protocol& protocol);

}  // namespace myoid::twin
