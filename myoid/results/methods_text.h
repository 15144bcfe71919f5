#pragma once

#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// The methods section of a paper about a run, in the past tense of papers.
struct MethodsText {
  std::string paragraph;          ///< Cites as "(Lu and O'Connor 1999)".
  std::vector<std::string> keys;  ///< Of the cited references, in the order of the text.
  std::string version;            ///< Of the program.
};

/// Says what was done with the data of this run: trials, motion with its cut-off, torque, EMG with
/// its filters and the normalization as the CEDE consensus names it, law of the muscles, estimator,
/// intervals, validation and version.
[[nodiscard]] MethodsText methods_text(const StudyResult& result, const Provenance& provenance);

/// The paragraph and the references as plain text (methods.txt).
[[nodiscard]] std::string methods_file(const MethodsText& text);

/// The cited references and the program as BibTeX (methods.bib).
[[nodiscard]] std::string methods_bibtex(const MethodsText& text);

/// The paragraph with the table of references, for the report.
[[nodiscard]] report::Section methods_section(const MethodsText& text);

}  // namespace myoid
