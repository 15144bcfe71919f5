#include "myoid/draft/draft_trials.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "myoid/files/text_file.h"

namespace myoid {
namespace {

/// The EMG file of the same trial: itself, the same stem, or one stem that begins with the other.
FoundRecording* emg_of(FoundRecording& motion, std::vector<FoundRecording>& found) {
  if (!motion.channels.empty()) return &motion;
  for (FoundRecording& f : found) {
    if (!f.channels.empty() && !f.emg_taken && f.stem == motion.stem) return &f;
  }
  FoundRecording* best = nullptr;
  for (FoundRecording& f : found) {
    if (f.channels.empty() || f.emg_taken) continue;
    if (!f.stem.starts_with(motion.stem + "_") && !motion.stem.starts_with(f.stem + "_")) continue;
    if (best == nullptr || f.stem.size() > best->stem.size()) best = &f;
  }
  return best;
}

/// "flex_2.5kg": a mass in the hand, perhaps.
void held_mass(const std::string& stem, bool own_model, DraftText& out) {
  const auto at = stem.find("kg");
  if (at == std::string::npos) return;
  std::size_t begin = at;
  while (begin > 0 && (std::isdigit(static_cast<unsigned char>(stem[begin - 1])) != 0 ||
                       stem[begin - 1] == '.' || stem[begin - 1] == 'p'))
    --begin;
  std::string number = stem.substr(begin, at - begin);
  std::replace(number.begin(), number.end(), 'p', '.');
  const auto mass = recording::parse_number(number);
  if (!mass || !(*mass > 0.0 && *mass <= 100.0)) return;
  out.todo(fmt::format("the name says {} kg: held in the hand?{}", *mass,
                       own_model ? " Then [model] held_mass must say where it acts" : ""));
  out.line(fmt::format("# held_mass_kg = {}", *mass));
}

}  // namespace

void draft_trials(std::vector<FoundRecording>& found,
                  const std::vector<std::filesystem::path>& external_loads,
                  const std::function<std::string(const std::filesystem::path&)>& relative,
                  bool own_model,
                  DraftText& out) {
  std::vector<std::string> notes;
  std::set<std::string> names;
  bool two_clocks = false, any_calibration = false;
  const auto unique = [&](std::string name) {
    while (!names.insert(name).second) name += "_2";
    return name;
  };
  // Joint angles first: a trial that has them needs no markers.
  for (const bool with_angles : {true, false}) {
    for (FoundRecording& f : found) {
      const bool fits = with_angles ? !f.angles.empty() : f.markers.frame_count() > 0;
      if (!fits || f.motion_taken) continue;
      if (!with_angles && std::any_of(found.begin(), found.end(), [&](const FoundRecording& g) {
            return !g.angles.empty() && g.motion_taken && g.stem == f.stem;
          })) {
        notes.push_back(
            fmt::format("# Not used: markers = {} (the trial starts from its joint angles)",
                        in_quotes(relative(f.path))));
        continue;
      }
      f.motion_taken = true;
      FoundRecording* emg = emg_of(f, found);
      std::string use = guessed_use(f.stem);
      if (emg == nullptr && use == "calibration") use = "passive";
      if (emg != nullptr) emg->emg_taken = true;
      out.line("[[trial]]");
      out.line("name = " + in_quotes(unique(f.stem)));
      out.line((with_angles ? "motion = " : "markers = ") + in_quotes(relative(f.path)));
      if (emg != nullptr) out.line("emg = " + in_quotes(relative(emg->path)));
      two_clocks = two_clocks || (emg != nullptr && emg != &f);
      out.line("use = " + in_quotes(use));
      if (use == "calibration") any_calibration = true;
      if (emg == nullptr && use == "passive")
        out.todo(fmt::format("no EMG was found for '{}'; it gives motion and torque only", f.stem));
      for (const std::filesystem::path& loads : external_loads) {
        if (trial_stem(loads) == f.stem) out.line("external_loads = " + in_quotes(relative(loads)));
      }
      if (f.plates > 0) {
        out.line(
            fmt::format("# force_plates = {{ bodies = \"auto\" }}   # {} in this file, if the "
                        "person stood on them",
                        f.plates));
      }
      held_mass(f.stem, own_model, out);
      out.line("");
    }
  }
  for (FoundRecording& f : found) {
    if (f.channels.empty() || f.emg_taken || f.motion_taken) continue;
    const bool mvc = guessed_use(f.stem) == "mvc";
    if (!mvc)
      out.todo(fmt::format(
          "'{}' has EMG and no motion: give it markers or motion; or take the # away if "
          "it is a maximal contraction",
          f.path.filename().string()));
    const std::string remark = mvc ? "" : "# ";
    out.line(remark + "[[trial]]");
    out.line(remark + "name = " + in_quotes(unique(f.stem)));
    out.line(remark + "emg = " + in_quotes(relative(f.path)));
    out.line(remark + "use = \"mvc\"");
    out.line("");
  }
  if (!any_calibration)
    out.todo("no trial has use = \"calibration\", from which parameters are found");
  for (const std::string& note : notes) out.line(note);
  if (two_clocks) {
    out.line("");
    out.line(
        "# EMG and motion are in different files. If they did not start together, or their "
        "clocks run");
    out.line("# apart, say so (docs/guide/study.md, [sync]):");
    out.line("# [sync]");
    out.line("# offset_s = 0.0");
  }
}

}  // namespace myoid
