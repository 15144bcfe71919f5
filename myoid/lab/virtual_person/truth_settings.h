#pragma once

#include <string>
#include <vector>

#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/study/setting.h"
#include "myoid/study/setting_rows.h"

namespace myoid::lab {

/// Visits the keys of [truth] in the order of the reference: the person's, then the departures of
/// the world from the identification's assumptions.
void visit(TruthSpec& truth, study::SettingVisitor& v);

/// Visits the world's keys only.
void visit_world(TruthSpec& truth, study::SettingVisitor& v);

/// Returns the reference of [truth].
[[nodiscard]] study::SettingTable truth_reference();

/// A number of the world that differs from the level's default.
struct WorldSetting {
  std::string key;
  std::string unit;   ///< "1" if there is none.
  std::string value;  ///< "0.15", "0.08 to 0.08", "millard"
};
[[nodiscard]] std::vector<WorldSetting> stated_world(const Protocol& protocol);

}  // namespace myoid::lab
