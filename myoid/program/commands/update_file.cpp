#include "myoid/program/commands/update_file.h"

#include <algorithm>
#include <utility>

#include "myoid/body/model/opensim_defects/compat.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::program {

UpdateFileResult update_file(const UpdateFileOptions& o) {
  Remarks remarks(o.call);
  body::UpdatedOsim updated = body::updated_osim(read_text_file(o.file), o.file,
                                                 {.six_digits = body::parse_compat(o.compat).six_digit_offsets});
  for (const std::string& note : updated.notes) remarks.warn(note);
  UpdateFileResult result;
  result.text = std::move(updated.text);
  result.old_version = updated.old_version;
  result.version = std::max(updated.old_version, body::kNewestOsimVersion);
  result.remarks = remarks.list();
  return result;
}

void write_update_file(const UpdateFileResult& result, const std::filesystem::path& path) {
  write_file(path, result.text);
}

}  // namespace myoid::program
