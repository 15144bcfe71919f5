#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/provenance.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// The methods section of a paper about a run, in the past tense of papers.
struct MethodsText {
  std::string paragraph;          ///< Cites as "(Lu and O'Connor 1999)".
  std::vector<std::string> keys;  ///< Keys of the cited references, in the order of the text.
  std::string version;            ///< Version of the program.
};

/// Describes the processing of this run's data: trials, motion with its cut-off, torque, EMG with its filters and the
/// normalization in the CEDE consensus's terms, law of the muscles, estimator, intervals, validation and version.
[[nodiscard]] MethodsText methods_text(const run::StudyResult& result, const Provenance& provenance);

/// Returns the paragraph and the references as plain text (methods.txt).
[[nodiscard]] std::string methods_file(const MethodsText& text);

/// Returns the cited references and the program as BibTeX (methods.bib).
[[nodiscard]] std::string methods_bibtex(const MethodsText& text);

/// Returns the paragraph with the table of references, for the report.
[[nodiscard]] page::Section methods_section(const MethodsText& text);

}  // namespace myoid::results
