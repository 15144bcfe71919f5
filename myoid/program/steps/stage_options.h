#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/opensim_defects/compat.h"
#include "myoid/study/setting.h"

/// The options that several commands share, each described once.
namespace myoid::program {

/// A mass that the person or the model holds.
struct HeldMass {
  double mass_kg = 0.0;
  std::string body;                         ///< Empty: the hand of arm4, else no body.
  std::vector<double> at_m{0.0, 0.0, 0.0};  ///< Point on that body; for arm4's hand its grip.
};
void visit(HeldMass& held, study::SettingVisitor& v);

void visit_model(std::string& model, study::SettingVisitor& v);
void visit_compat(body::Compatibility& compat, study::SettingVisitor& v);
void visit_motion(std::string& motion, study::SettingVisitor& v, std::string_view required = "a file");
void visit_lowpass(std::optional<double>& cutoff_hz, study::SettingVisitor& v);
void visit_loads(std::string& loads, study::SettingVisitor& v);
/// Visits the vertical of a laboratory; `about` says what for, and which one counts without it.
void visit_up(std::string& up, study::SettingVisitor& v, study::About about);

}  // namespace myoid::program
