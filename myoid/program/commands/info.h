#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "myoid/program/contents/model_contents.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// The content of one file.
struct InfoOptions {
  Call call;
  std::string file;                                         ///< A recording, table, model or study; or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths of a model: exact, or opensim.
  ModelQuestions ask;                                       ///< Questions about a model; their seed is the call's.
};
void visit(InfoOptions& options, study::SettingVisitor& v);
/// Visits all options but the file.
void visit_questions(InfoOptions& options, study::SettingVisitor& v);

/// Returns "file", "kind" and the content: channels, units, rates, bodies, muscles, ...
/// `contents_text` formats the content as text. Throws ReadError for a file of no known kind.
[[nodiscard]] nlohmann::ordered_json info(const InfoOptions& options);

/// Returns the endings of the files that `info` knows.
[[nodiscard]] std::string known_endings();

/// Returns true if the name is that of a model: an .osim file, or the built-in "arm4".
[[nodiscard]] bool is_model(const std::string& file);

}  // namespace myoid::program
