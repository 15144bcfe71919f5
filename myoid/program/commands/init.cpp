#include "myoid/program/commands/init.h"

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::program {

InitResult init(const InitOptions& o) {
  study::DraftOptions options;
  for (const std::string& from : o.from) options.from.emplace_back(from);
  if (options.from.empty()) options.from.emplace_back(o.folder);
  if (!o.model.empty()) options.model = o.model;
  options.coordinate = o.coordinate;
  Remarks remarks(o.call);
  InitResult result;
  result.draft = study::draft_study(o.folder, options);
  for (const std::string& note : result.draft.notes) remarks.note(note);
  result.remarks = remarks.list();
  return result;
}

void write_init(const InitResult& result, const std::filesystem::path& path, const Call& call) {
  RecordedFolder held(path.parent_path(), "init");
  write_file(path, result.draft.toml);
  held.finish();
  Remarks remarks(call);
  for (std::string& note : held.take_notes()) remarks.note(std::move(note));
}

}  // namespace myoid::program
