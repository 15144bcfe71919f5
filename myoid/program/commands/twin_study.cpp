#include "myoid/program/commands/twin_study.h"

#include <fmt/format.h>

#include "myoid/lab/virtual_person/demo_protocol.h"
#include "myoid/program/commands/twin.h"
#include "myoid/program/steps/check_options.h"

namespace myoid::program {

void visit(TwinStudyOptions& o, study::SettingVisitor& v) {
  visit_protocol(o.protocol, v);
  v.choice("level", o.level, {.says = "Instead of the protocol's own."});
  v.number("offset", o.offset,
           {.says = "Mean of the persons away from the priors', in standard deviations.",
            .limits = study::within(-3.0, 3.0)});
  visit_truth(o.truth, v);
  v.count("subjects", o.study.subjects, {.says = "Virtual persons.", .limits = study::within(1, 1000000)});
  v.choices("method", o.study.methods, {.says = "Several are possible."});
  v.folder("out", o.out, {.says = "Folder for persons.csv, summary.csv, predictions.csv.", .required = "a folder"});
}

TwinStudyResult twin_study(const TwinStudyOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  lab::Protocol protocol = lab::protocol_named(o.protocol, o.level);
  lab::set_truth(protocol, o.truth);
  if (o.offset) protocol.truth.offset = *o.offset;
  lab::TwinStudyOptions options = o.study;
  options.first_seed = o.call.seed;
  options.progress = o.call.progress;
  TwinStudyResult result;
  result.study = lab::twin_study(protocol, options);
  for (const lab::TwinFailure& f : result.study.failures) remarks.warn(fmt::format("seed {}: {}", f.seed, f.message));
  result.summaries = lab::summarize(result.study);
  result.provenance.command = o.call.command;
  result.provenance.inputs.push_back({o.protocol, sha256(lab::protocol_text(o.protocol))});
  result.remarks = remarks.list();
  return result;
}

void write_twin_study(const TwinStudyResult& result, const std::filesystem::path& folder) {
  lab::write_twin_study(result.study, result.provenance, folder);
}

}  // namespace myoid::program
