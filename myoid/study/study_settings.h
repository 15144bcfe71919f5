#pragma once

#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Visit every setting of a table once: key, allowed values, default (the struct's), one sentence
/// of the reference, and the rules that relate it to other settings.
void visit(SubjectSpec& subject, SettingVisitor& v);
void visit(HeldMassSpec& held, SettingVisitor& v);
void visit(ModelSpec& model, SettingVisitor& v);
void visit(MotionSpec& motion, SettingVisitor& v);
void visit(MarkerSpec& markers, SettingVisitor& v);
void visit(CalibrationSpec& calibrate, SettingVisitor& v);
void visit(IkSpec& ik, SettingVisitor& v);
void visit(EmgSpec& emg, SettingVisitor& v);
void visit(LoadCellSpec& cell, SettingVisitor& v);
void visit(SharingSpec& sharing, SettingVisitor& v);
void visit(PhasesSpec& phases, SettingVisitor& v);
void visit(IdentifySpec& identify, SettingVisitor& v);
void visit(fit::UnseenSpreads& beliefs, SettingVisitor& v);
void visit(NormSpec& norm, SettingVisitor& v);

/// Visits every table of a study.
void visit(Study& study, SettingVisitor& v);

}  // namespace myoid::study
