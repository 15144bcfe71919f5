#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "myoid/ground/files/result_folder.h"
#include "myoid/program/steps/call.h"

#include "keywords.h"

namespace myoid::python {

/// The folder of a command's results; nothing where the user named none.
class ResultOut {
 public:
  ResultOut(const std::string& folder, const program::Call& call, std::string_view unless_only = "") : call_(call) {
    if (folder.empty()) return;
    folder_.emplace(folder, call.command, call.overwrite, unless_only);
    if (!folder_->note().empty()) program::Remarks(call).note(folder_->note());
  }
  void finish() {
    if (!folder_) return;
    folder_->finish();
    program::Remarks remarks(call_);
    for (std::string& note : folder_->take_notes()) remarks.note(std::move(note));
  }

 private:
  program::Call call_;
  std::optional<ResultFolder> folder_;
};

}  // namespace myoid::python
