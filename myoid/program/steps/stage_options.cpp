#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

void visit(HeldMass& held, study::SettingVisitor& v) {
  v.number("held-mass", held.mass_kg, {.says = "Mass held in the hand.", .limits = study::zero_or_more("kg")});
  v.text("held-body", held.body,
         {.says = "Body that holds it.", .otherwise = "the hand of arm4, of other models none"});
  v.numbers("held-at", held.at_m, {.says = "Where on that body, x y z [m].", .count = 3});
}

void visit_model(std::string& model, study::SettingVisitor& v) {
  v.path("model", model, {.says = "OpenSim model (.osim), or arm4.", .required = "a model"});
}

void visit_compat(body::Compatibility& compat, study::SettingVisitor& v) {
  v.choice("compat", compat, {.says = "Muscle paths: exact, or opensim to have OpenSim 4.5.2's with its defects."});
}

void visit_motion(std::string& motion, study::SettingVisitor& v, std::string_view required) {
  v.path("motion", motion, {.says = "Joint angles (.mot, .sto).", .required = required});
}

void visit_lowpass(std::optional<double>& cutoff_hz, study::SettingVisitor& v) {
  v.number("lowpass", cutoff_hz,
           {.says = "Smooth the angles, -3 dB at this frequency.",
            .limits = study::above_zero("Hz"),
            .otherwise = "not smoothed"});
}

void visit_loads(std::string& loads, study::SettingVisitor& v) {
  v.path("loads", loads, {.says = "Forces measured on bodies: an <ExternalLoads> file (.xml) of OpenSim."});
}

void visit_up(std::string& up, study::SettingVisitor& v, study::About about) {
  static constexpr std::string_view kAxes[] = {"x", "y", "z", "-x", "-y", "-z"};
  about.words = kAxes;
  v.text("up", up, about);
}

}  // namespace myoid::program
