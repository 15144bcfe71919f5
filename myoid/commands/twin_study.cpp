#include "myoid/commands/twin_study.h"

#include <fmt/format.h>

#include "myoid/commands/twin.h"
#include "myoid/virtual_person/demo_protocol.h"

namespace myoid::commands {

TwinStudyResult twin_study(const TwinStudyOptions& o) {
  Remarks remarks(o.call);
  twin::Protocol protocol = twin::protocol_named(o.protocol, level_named(o.level));
  twin::set_truth(protocol, o.truth);
  if (o.offset) protocol.truth.offset = *o.offset;
  twin::TwinStudyOptions options = o.study;
  options.first_seed = o.call.seed;
  options.progress = o.call.progress;
  TwinStudyResult result;
  result.study = twin::twin_study(protocol, options);
  for (const twin::TwinFailure& f : result.study.failures) remarks.warn(fmt::format("seed {}: {}", f.seed, f.message));
  result.summaries = twin::summarize(result.study);
  result.provenance.command = o.call.command;
  result.provenance.inputs.push_back({o.protocol, sha256(twin::protocol_text(o.protocol))});
  result.remarks = remarks.list();
  return result;
}

void write_twin_study(const TwinStudyResult& result, const std::filesystem::path& folder) {
  twin::write_twin_study(result.study, result.provenance, folder);
}

}  // namespace myoid::commands
