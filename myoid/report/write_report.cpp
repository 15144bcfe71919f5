#include "myoid/report/write_report.h"

#include "myoid/files/atomic_file.h"
#include "myoid/report/html.h"
#include "myoid/report/json.h"
#include "myoid/report/strip_grid.h"
#include "myoid/report/svg_plot.h"
#include "myoid/report/tables.h"

namespace myoid::report {

void write_report(const Report& report, const std::filesystem::path& directory, const Workbench* workbench) {
  validate(report);
  for (const Section& section : report.sections) {
    for (const Table& table : section.tables) {
      recording::write_file(directory / "tables" / (table.id + ".csv"), table_csv(table));
    }
    for (const StripGrid& grid : section.grids) {
      recording::write_file(directory / "tables" / (grid.id + ".csv"), strip_grid_csv(grid));
    }
    for (const Figure& figure : section.figures) {
      recording::write_file(directory / "figures" / (figure.id + ".svg"), svg_plot(figure));
      recording::write_file(directory / "figures" / (figure.id + ".csv"), figure_csv(figure));
    }
  }
  recording::write_file(directory / "report.json", report_json(report));
  recording::write_file(directory / "report.html", html(report, workbench));
}

}  // namespace myoid::report
