#pragma once

#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid {

/// The settings of one [[trial]]: its name is a folder's, files that exclude each other are
/// refused, and the use says which ones are needed.
void visit(TrialSpec& trial, SettingVisitor& v);

/// [sync] of a study or of one of its trials: one way alone (a number, "estimate", a pair of
/// triggers) says how the clocks stand.
void visit(SyncSpec& sync, SettingVisitor& v);

/// Force plates under the person in one trial.
void visit(PlateSpec& plates, SettingVisitor& v);

}  // namespace myoid
