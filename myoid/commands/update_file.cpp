#include "myoid/commands/update_file.h"

#include <algorithm>
#include <utility>

#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/model/opensim_defects/compat.h"
#include "myoid/osim/osim_updater.h"

namespace myoid::commands {

UpdateFileResult update_file(const UpdateFileOptions& o) {
  Remarks remarks(o.call);
  model::UpdatedOsim updated = model::updated_osim(recording::read_text_file(o.file), o.file,
                                                   {.six_digits = model::parse_compat(o.compat).six_digit_offsets});
  for (const std::string& note : updated.notes) remarks.warn(note);
  UpdateFileResult result;
  result.text = std::move(updated.text);
  result.old_version = updated.old_version;
  result.version = std::max(updated.old_version, model::kNewestOsimVersion);
  result.remarks = remarks.list();
  return result;
}

void write_update_file(const UpdateFileResult& result, const std::filesystem::path& path) {
  recording::write_file(path, result.text);
}

}  // namespace myoid::commands
