#include "myoid/study/run_identity.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/body/osim/osim_document.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/study/study_text.h"

namespace myoid::study {
namespace {

using nlohmann::json;

std::string text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Adds the settings of a table by their names. Tables of a list go by their `name`, else by their number.
void add_settings(const json& of, const std::string& name, std::map<std::string, std::string>& settings) {
  const auto below = [&](const std::string& key) { return name.empty() ? key : fmt::format("{} {}", name, key); };
  if (of.is_object()) {
    for (const auto& [key, value] : of.items())
      if (key != "name") add_settings(value, below(key), settings);
    return;
  }
  const bool tables = of.is_array() && std::ranges::any_of(of, [](const json& entry) { return entry.is_object(); });
  if (!tables) {
    settings[name] = json_text(nlohmann::ordered_json(of));
    return;
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::string own = of[i].is_object() ? text(of[i], "name") : "";
    add_settings(of[i], below(own.empty() ? std::to_string(i + 1) : own), settings);
  }
}

/// Reads the identity from the options that study_json writes.
RunIdentity identity_of(const json& options) {
  RunIdentity identity;
  if (!options.is_object() || !options.contains("model")) return identity;
  if (const auto subject = options.find("subject"); subject != options.end()) {
    identity.subject = text(*subject, "name");
    identity.sex = text(*subject, "sex");
    if (const auto mass = subject->find("mass_kg"); mass != subject->end() && mass->is_number())
      identity.mass_kg = mass->get<double>();
  }
  const json& model = options.at("model");
  identity.model = text(model, "file");
  if (identity.model.empty()) identity.model = text(model, "builtin");
  identity.known = identity.model != "none";
  if (const auto names = model.find("coordinate"); names != model.end() && names->is_array())
    identity.coordinates = names->get<std::vector<std::string>>();
  if (const auto muscles = options.find("muscle"); muscles != options.end()) {
    for (const json& muscle : *muscles) identity.muscles.push_back(text(muscle, "name"));
  }
  add_settings(options, "", identity.settings);
  return identity;
}

std::string model_name(const RunIdentity& identity) {
  return std::filesystem::path(identity.model).filename().string();
}

bool same_model(const RunIdentity& a, const RunIdentity& b) {
  if (!a.model_sha256.empty() && !b.model_sha256.empty()) return a.model_sha256 == b.model_sha256;
  return model_name(a) == model_name(b);
}

/// Returns a sentence on recordings that two results both rest on; empty if there are none.
std::string shared_recordings(const RunIdentity& here, const RunIdentity& there) {
  const std::vector<std::string> both = common_recordings(here, there);
  if (both.empty()) return "";
  return fmt::format("both rest on the recording {}{}: is one person there twice?", both.front(),
                     both.size() > 1 ? fmt::format(" and {} more", both.size() - 1) : "");
}

void compare_subjects(const RunIdentity& here, const RunIdentity& there, std::vector<std::string>& found) {
  const auto named = [](const RunIdentity& i) { return !i.subject.empty() && i.subject != SubjectSpec{}.name; };
  if (here.subject != there.subject && named(here) && named(there))
    found.push_back(fmt::format("the subject is '{}' here, '{}' there", here.subject, there.subject));
  if (here.sex != there.sex && !here.sex.empty() && !there.sex.empty())
    found.push_back(fmt::format("the subject is {} here, {} there", here.sex, there.sex));
  constexpr double kSameMass_kg = 5.0;  // variation of one person over months
  if (here.mass_kg && there.mass_kg && std::abs(*here.mass_kg - *there.mass_kg) > kSameMass_kg)
    found.push_back(
        fmt::format("the subject's mass is {:.4g} kg here, {:.4g} kg there", *here.mass_kg, *there.mass_kg));
}

}  // namespace

RunIdentity identity_of(const Study& study) {
  RunIdentity identity = identity_of(parse_json(study_json(study)));
  if (study.model.file) identity.model_sha256 = sha256(body::read_whole_text(*study.model.file));
  return identity;
}

RunIdentity read_run_identity(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "parameters.json";
  try {
    const json content = parse_json(read_text_file(path));
    const auto provenance = content.find("provenance");
    if (provenance == content.end()) return {};
    RunIdentity identity = identity_of(provenance->value("options", json::object()));
    for (const json& input : provenance->value("inputs", json::array())) {
      if (!identity.model.empty() && text(input, "path") == identity.model)
        identity.model_sha256 = text(input, "sha256");
      const auto format = format_of(text(input, "path"));
      if (format && is_recording(*format))
        identity.recordings.push_back(
            {std::filesystem::path(text(input, "path")).filename().string(), text(input, "sha256")});
    }
    return identity;
  } catch (const json::exception& error) {
    throw ReadError(
        path, 0,
        fmt::format("is not the result of a run: {}; run the study (myoid run) and give the folder of its result",
                    json_error_text(error)));
  }
}

std::vector<std::string> common_recordings(const RunIdentity& here, const RunIdentity& there) {
  std::vector<std::string> both;
  for (const RecordedFile& file : here.recordings)
    if (std::ranges::find(there.recordings, file.sha256, &RecordedFile::sha256) != there.recordings.end())
      both.push_back(file.name);
  return both;
}

bool of_one_recording(const RunIdentity& here, const RunIdentity& there) {
  const std::size_t fewer = std::min(here.recordings.size(), there.recordings.size());
  return 2 * std::min(common_recordings(here, there).size(), common_recordings(there, here).size()) > fewer;
}

std::vector<std::string> differing_settings(const RunIdentity& here, const RunIdentity& there) {
  const auto is_path = [](const std::string& text) {
    return text.find('/') != std::string::npos || text.find('\\') != std::string::npos;
  };
  std::vector<std::string> names;
  const auto compare = [&](const RunIdentity& a, const RunIdentity& b, bool both) {
    for (const auto& [name, value] : a.settings) {
      const auto other = b.settings.find(name);
      if (other == b.settings.end() || (both && value != other->second && !(is_path(value) && is_path(other->second))))
        names.push_back(name);
    }
  };
  compare(here, there, true);
  compare(there, here, false);
  std::ranges::sort(names);
  return names;
}

IdentityDifferences differences(const RunIdentity& here, const RunIdentity& there, Whose whose) {
  IdentityDifferences found;
  const bool one_person = whose == Whose::one_person;
  if (here.known && there.known) {
    if (const std::string text = one_person ? "" : shared_recordings(here, there); !text.empty())
      found.grave.push_back(text);
    if (one_person && !same_model(here, there))
      found.grave.push_back(model_name(here) == model_name(there)
                                ? fmt::format("the model {} is another one (its content differs)", model_name(here))
                                : fmt::format("the model is {} here, {} there", model_name(here), model_name(there)));
    if (here.coordinates != there.coordinates)
      found.grave.push_back(fmt::format("the coordinate is {} here, {} there", fmt::join(here.coordinates, ", "),
                                        fmt::join(there.coordinates, ", ")));
    if (one_person) compare_subjects(here, there, found.other);
  }
  std::vector<std::string> only_here, only_there;
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
  };
  for (const std::string& m : here.muscles) {
    if (!has(there.muscles, m)) only_here.push_back(m);
  }
  for (const std::string& m : there.muscles) {
    if (!has(here.muscles, m)) only_there.push_back(m);
  }
  if (here.muscles.empty() || there.muscles.empty()) return found;
  if (only_here.size() == here.muscles.size())
    found.grave.push_back(fmt::format("no muscle is common: {} here, {} there", fmt::join(here.muscles, ", "),
                                      fmt::join(there.muscles, ", ")));
  else if (!only_here.empty() || !only_there.empty())
    found.other.push_back(fmt::format("the muscles are {} here, {} there", fmt::join(here.muscles, ", "),
                                      fmt::join(there.muscles, ", ")));
  return found;
}

}  // namespace myoid::study
