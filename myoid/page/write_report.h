#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/ground/core/choice.h"
#include "myoid/page/report.h"
#include "myoid/page/workbench.h"

namespace myoid::page {

/// The files of a result that are kept.
enum class Kept {
  tables,  ///< Numbers and answers, without pages, pictures and series.
  page,    ///< These, and one page without the moving model.
  all,
};
inline constexpr std::string_view kKeptNames[] = {"tables", "page", "all"};
constexpr ChoiceNames choice_names(Kept) { return kKeptNames; }

/// Returns the report as JSON with the structure and names of `Report`, indented by two blanks.
/// Figures carry id, title and caption only; their numbers are in figures/ID.csv.
[[nodiscard]] std::string report_json(const Report& report);

/// Writes figures/ID.svg and figures/ID.csv.
void write_figure(const Figure& figure, const std::filesystem::path& directory);

/// Writes report.html (one file that works offline: style, drawings and the workbench, if there is
/// one, inside), figures/ID.svg and ID.csv, tables/ID.csv and report.json into the folder; each
/// whole or not at all. Kept::tables writes report.json alone, Kept::page report.html, too. Calls `validate`.
void write_report(Report report,
                  const std::filesystem::path& directory,
                  const Workbench* workbench = nullptr,
                  Kept kept = Kept::all);

}  // namespace myoid::page
