#pragma once

#include <string>
#include <vector>

#include "myoid/program/steps/call.h"
#include "myoid/run/design/design_study.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of the choice of movements to record next.
struct DesignOptions {
  Call call;
  std::string study;               ///< study.toml; or `model`.
  std::string model;               ///< The built-in arm: "arm4".
  bool wire = false;               ///< For arm4: the brachialis has a wire electrode of its own.
  std::string after;               ///< Folder of a run whose results count as known; empty: none.
  bool dynamometer = true;         ///< Isokinetic movements are possible.
  run::DesignStudyOptions design;  ///< Its seed, `dynamometer` and `earlier` follow from the above.
};
void visit(DesignOptions& options, study::SettingVisitor& v);

struct DesignResult {
  run::DesignStudyResult design;
  std::vector<Remark> remarks;
};

/// Chooses the movements. Throws InvalidInput if the earlier run is of another study, or no
/// movement of the catalogue is within the muscles' strength.
[[nodiscard]] DesignResult design(const DesignOptions& options);

}  // namespace myoid::program
