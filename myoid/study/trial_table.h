#pragma once

#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Visits the settings of one [[trial]]. Its name must suit a folder, files that exclude each other
/// are refused, and the use determines which ones are needed.
void visit(TrialSpec& trial, SettingVisitor& v);

/// Visits [sync] of a study or of one of its trials: exactly one of a number, "estimate" and a pair
/// of triggers relates the clocks.
void visit(SyncSpec& sync, SettingVisitor& v);

/// Visits the force plates under the person in one trial.
void visit(PlateSpec& plates, SettingVisitor& v);

}  // namespace myoid::study
